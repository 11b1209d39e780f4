//! Writing: complete or not at all, untouched where nothing changed, and files that move.

#![allow(clippy::unwrap_used, clippy::print_stderr, reason = "helpers of tests are tests")]

mod common;
use common::odd::plain;
use common::*;
use foliar_carrier::{
    Document, Outcome, OutputFile, Step, assemble, encode, is_unchanged, read, write, write_files, write_files_with,
};
use foliar_schema::Import;
use serde_json::json;
use std::io::{Error, ErrorKind};
use std::path::{Path, PathBuf};

fn folder() -> tempfile::TempDir {
    tempfile::tempdir().unwrap()
}

fn names_in(folder: &Path) -> Vec<String> {
    let mut names: Vec<String> =
        std::fs::read_dir(folder).unwrap().map(|e| e.unwrap().file_name().to_string_lossy().into_owned()).collect();
    names.sort();
    names
}

fn files(folder: &Path, text: &str) -> Vec<OutputFile> {
    let file = |name: &str| OutputFile { path: folder.join(name), bytes: format!("{text} {name}").into_bytes() };
    vec![file("tree.bin"), file("tree.gltf")]
}

#[test]
fn equal_bytes_leave_a_file_untouched() {
    let folder = folder();
    let path = folder.path().join("tree.glb");
    let document = plain().finish();
    assert_eq!(write(&document, &path).unwrap(), Outcome::Written);
    assert!(is_unchanged(&encode(&document, &path).unwrap()));
    let old = std::fs::File::open(&path).unwrap();
    old.set_modified(std::time::SystemTime::UNIX_EPOCH).unwrap();
    assert_eq!(write(&document, &path).unwrap(), Outcome::Unchanged);
    assert_eq!(std::fs::metadata(&path).unwrap().modified().unwrap(), std::time::SystemTime::UNIX_EPOCH);
    let mut other = document;
    other.json["asset"]["generator"] = json!("other");
    assert!(!is_unchanged(&encode(&other, &path).unwrap()));
    assert_eq!(write(&other, &path).unwrap(), Outcome::Written);
    assert_eq!(names_in(folder.path()), ["tree.glb"]);
}

/// ninja's restat works file by file: a new picture does not make a tree look new.
#[test]
fn of_several_files_only_those_with_new_bytes_are_touched() {
    let folder = folder();
    write_files(&files(folder.path(), "old")).unwrap();
    let [kept, replaced] = ["tree.bin", "tree.gltf"].map(|name| folder.path().join(name));
    std::fs::File::open(&kept).unwrap().set_modified(std::time::SystemTime::UNIX_EPOCH).unwrap();
    let mut next = files(folder.path(), "old");
    next[1].bytes = b"new".to_vec();
    assert_eq!(write_files(&next).unwrap(), Outcome::Written);
    assert_eq!(std::fs::metadata(&kept).unwrap().modified().unwrap(), std::time::SystemTime::UNIX_EPOCH);
    assert_eq!(std::fs::read(&replaced).unwrap(), b"new");
}

/// An error at any step of either file: the error names the file, nothing is left over, and each file
/// is old or new as a whole; the last one, the commit, is old.
#[test]
fn an_error_at_any_step_leaves_the_old_output() {
    for step in [Step::Create, Step::Half, Step::Sync, Step::Rename] {
        for failing in ["tree.bin", "tree.gltf"] {
            let folder = folder();
            write_files(&files(folder.path(), "old")).unwrap();
            let new = files(folder.path(), "new");
            let error = write_files_with(&new, &mut |path, at| {
                let hit = at == step && path.ends_with(failing);
                if hit { Err(Error::from(ErrorKind::StorageFull)) } else { Ok(()) }
            })
            .unwrap_err();
            assert!(error.is_output());
            let text = error.to_string();
            assert!(
                text.contains(failing) && text.contains("cannot be written") && text.contains("free some space"),
                "{text}"
            );
            assert_eq!(names_in(folder.path()), ["tree.bin", "tree.gltf"], "{step:?}");
            let on_disk = |name: &str| std::fs::read_to_string(folder.path().join(name)).unwrap();
            assert_eq!(on_disk("tree.gltf"), "old tree.gltf");
            let renamed = step == Step::Rename && failing == "tree.gltf";
            assert_eq!(
                on_disk("tree.bin"),
                if renamed { "new tree.bin" } else { "old tree.bin" },
                "{step:?} {failing}"
            );
        }
    }
}

/// What a killed process leaves is removed by the next write of the same file, and nothing else is.
#[test]
fn leftovers_of_the_dead_are_removed() {
    if !Path::new("/proc/self").exists() {
        return eprintln!("skipped: no /proc");
    }
    let folder = folder();
    let mine = format!(".tree.glb.foliar-{}-abc.part", std::process::id());
    // No process has the largest 32-bit id: Linux stops at 2^22.
    for name in [".tree.glb.foliar-4294967295-abc.part", ".other.glb.foliar-4294967295-abc.part", &mine] {
        std::fs::write(folder.path().join(name), "half").unwrap();
    }
    write(&plain().finish(), &folder.path().join("tree.glb")).unwrap();
    assert_eq!(names_in(folder.path()), [".other.glb.foliar-4294967295-abc.part", &mine, "tree.glb"]);
}

#[test]
fn files_are_put_in_place_in_order_the_commit_last() {
    let folder = folder();
    let mut seen = Vec::new();
    write_files_with(&files(folder.path(), "new"), &mut |path, step| {
        seen.push((path.file_name().unwrap().to_string_lossy().into_owned(), step));
        Ok(())
    })
    .unwrap();
    let renames: Vec<&str> = seen.iter().filter(|(_, s)| *s == Step::Rename).map(|(n, _)| n.as_str()).collect();
    assert_eq!(renames, ["tree.bin", "tree.gltf"]);
    let last_sync = seen.iter().rposition(|(_, s)| *s == Step::Sync).unwrap();
    let first_rename = seen.iter().position(|(_, s)| *s == Step::Rename).unwrap();
    assert!(last_sync < first_rename, "everything is on the disk before anything is in place");
}

#[test]
fn places_that_cannot_be_written_are_named_with_a_remedy() {
    let folder = folder();
    let document = plain().finish();
    let missing = write(&document, &folder.path().join("no/tree.glb")).unwrap_err();
    assert!(missing.is_output() && missing.to_string().contains("create the folder first"), "{missing}");
    let path = folder.path().join("tree.glb");
    std::fs::write(&path, "old").unwrap();
    let mut mode = std::fs::metadata(&path).unwrap().permissions();
    mode.set_readonly(true);
    std::fs::set_permissions(&path, mode).unwrap();
    let error = write(&document, &path).unwrap_err();
    assert!(error.is_output() && error.to_string().contains("writable"), "{error}");
    assert_eq!(std::fs::read(&path).unwrap(), b"old");
    let error = write(&document, folder.path()).unwrap_err();
    assert!(error.is_output() && error.to_string().contains("name a file, not a folder"), "{error}");
}

#[cfg(unix)]
#[test]
fn the_mode_is_what_the_umask_says_and_links_stay_links() {
    use std::os::unix::fs::PermissionsExt;
    let folder = folder();
    let (plain_file, written) = (folder.path().join("plain"), folder.path().join("tree.glb"));
    std::fs::write(&plain_file, "x").unwrap();
    write(&plain().finish(), &written).unwrap();
    let mode = |path: &Path| std::fs::metadata(path).unwrap().permissions().mode() & 0o777;
    assert_eq!(mode(&written), mode(&plain_file));
    let link = folder.path().join("link.glb");
    std::os::unix::fs::symlink(&plain_file, &link).unwrap();
    write(&plain().finish(), &link).unwrap();
    assert!(std::fs::symlink_metadata(&link).unwrap().is_symlink());
    assert_eq!(std::fs::read(&plain_file).unwrap(), std::fs::read(&written).unwrap());
}

#[test]
fn a_gltf_with_its_bin_gives_the_same_plant_as_a_glb() {
    let folder = folder();
    let asset = from_document(&plain().finish());
    let layers = layers_for(&asset);
    let master = assemble(&asset.document, &layers).unwrap().0;
    let path = folder.path().join("a tree.gltf");
    write(&master, &path).unwrap();
    assert_eq!(names_in(folder.path()), ["a tree.bin", "a tree.gltf"]);
    assert_eq!(foliar_carrier::second_reader::verify_file(&path).unwrap().leaves, ROWS);
    let back = read(&path, &Import::default()).unwrap();
    assert_eq!((back.layers, back.base_hash), (layers, asset.base_hash.clone()));
    // And stripped into the same place: the base, with its shorter .bin.
    write(&back.document, &path).unwrap();
    let base = read(&path, &Import::default()).unwrap();
    assert!(base.document.buffers == asset.document.buffers && base.layers.is_empty());
    assert_eq!(base.base_hash, asset.base_hash);
}

/// A glTF with two buffers in files and a texture, in its own folder.
fn scattered(folder: &Path) -> PathBuf {
    let mut document = plain().finish();
    document.json["buffers"][0]["uri"] = json!("geo%20metry.bin");
    document.json["buffers"].as_array_mut().unwrap().push(json!({"byteLength": 4, "uri": "more.bin"}));
    document.json["images"] = json!([{"uri": "pic%23ture.png"}, {"uri": "data:image/png;base64,AAAA"}]);
    std::fs::create_dir_all(folder).unwrap();
    std::fs::write(folder.join("geo metry.bin"), &document.buffers[0]).unwrap();
    std::fs::write(folder.join("more.bin"), [1, 2, 3, 4, 5]).unwrap();
    std::fs::write(folder.join("in.gltf"), document.json.to_string()).unwrap();
    folder.join("in.gltf")
}

#[test]
fn uris_are_rebased_where_the_file_moves() {
    let folder = folder();
    let asset = read(&scattered(&folder.path().join("in")), &Import::default()).unwrap();
    assert_eq!(asset.document.buffers[1], [1, 2, 3, 4], "cut to byteLength");
    let out = folder.path().join("out");
    std::fs::create_dir(&out).unwrap();
    let files = encode(&asset.document, &out.join("tree.gltf")).unwrap();
    let json: serde_json::Value = serde_json::from_slice(&files[1].bytes).unwrap();
    assert_eq!(json["images"][0]["uri"], "../in/pic%23ture.png", "there is no such file to take along");
    assert_eq!(json["images"][1], asset.document.json["images"][1]);
    assert_eq!(json["buffers"][0]["uri"], "tree.bin");
    assert_eq!(json["buffers"][1]["uri"], "data:application/octet-stream;base64,AQIDBA==", "no way out of the folder");
    write_files(&files).unwrap();
    let moved = read(&out.join("tree.gltf"), &Import::default()).unwrap();
    assert_eq!(moved.base_hash, asset.base_hash);
    // Into a GLB: neither buffer nor picture is left outside; what is no picture is named as it was.
    let glb = encode(&asset.document, &out.join("tree.glb")).unwrap().remove(0).bytes;
    let inside: Document = from_memory_in(&glb, &out);
    assert_eq!(inside.buffers, asset.document.buffers);
    assert_eq!(inside.json["images"][0]["uri"], "../in/pic%23ture.png", "there is no such file");
    let raster = foliar_plant::Raster { name: String::new(), width: 1, height: 1, rgba: vec![9; 4], has_alpha: true };
    let png = foliar_carrier::images::encode_png(&raster).unwrap();
    std::fs::write(folder.path().join("in/pic#ture.png"), png).unwrap();
    let glb = encode(&asset.document, &out.join("tree.glb")).unwrap().remove(0).bytes;
    let inside = from_memory_in(&glb, &out);
    assert_eq!(inside.json["images"][0]["mimeType"], "image/png");
    // With layers on it: they come back, and so does the base with its picture.
    let layers = layers_for(&asset);
    let master = assemble(&asset.document, &layers).unwrap().0;
    let glb = encode(&master, &out.join("tree.glb")).unwrap().remove(0).bytes;
    let back = foliar_carrier::read_bytes(glb, "a.glb", &out, &Import::default()).unwrap();
    assert_eq!((back.layers, back.base_hash), (layers, asset.base_hash));
    assert_eq!(back.document.json.to_string(), inside.json.to_string());
    assert_eq!(back.document.buffers, inside.buffers);
    // Where it stays, nothing changes.
    let same = encode(&asset.document, &folder.path().join("in/geo metry.gltf")).unwrap();
    let json: serde_json::Value = serde_json::from_slice(&same[1].bytes).unwrap();
    assert_eq!(json, asset.document.json);
}

fn from_memory_in(bytes: &[u8], folder: &Path) -> Document {
    foliar_carrier::read_bytes(bytes.to_vec(), "a.glb", folder, &Import::default()).unwrap().document
}

#[test]
fn devices_are_written_straight() {
    if Path::new("/dev/null").exists() {
        write(&plain().finish(), Path::new("/dev/null")).unwrap();
        assert!(!std::fs::metadata("/dev/null").unwrap().is_file());
    }
}
