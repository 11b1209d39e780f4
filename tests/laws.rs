//! The laws that need bytes: base untouched, idempotent, repeatable, all or nothing.

use crate::common::{
    DENSITY, FOLIAR, IMPORT, LIGHT, WIND, command, folder, glb, made_from, open_glb, output, run, run_in, shared, text,
    tree,
};
use serde_json::{Value, json};
use std::path::Path;
use std::process::Stdio;
use std::time::Duration;

fn same(a: &Path, b: &Path) {
    assert!(std::fs::read(a).unwrap() == std::fs::read(b).unwrap(), "{} and {} differ", a.display(), b.display());
}

/// A GLB base with content that foliar does not know.
fn odd_base(name: &str, folder: &Path) -> std::path::PathBuf {
    let (baked, base) = (folder.join("baked.glb"), folder.join(name));
    run(IMPORT, &[text(&tree(folder, 40)), "-o", text(&baked)]).expect(0, &[]);
    run(FOLIAR, &["strip", text(&baked), "-o", text(&base)]).expect(0, &[]);
    let (mut json, binary) = open_glb(&base);
    json["extras"] = json!({"keep": [1, 2.5, null], "0.2": 0.20000000298});
    json["extensionsUsed"] = json!(["EXAMPLE_unknown"]);
    json["extensions"] = json!({"EXAMPLE_unknown": {"a": {"b": []}}});
    json["nodes"][0]["extras"] = json!({"name": "trunk"});
    json["meshes"][0]["primitives"][0]["extras"] = json!({"painted": true});
    json["asset"]["extras"] = json!({"author": "somebody"});
    std::fs::write(&base, glb(&json, &binary)).unwrap();
    base
}

/// Every value of `base` stands in `baked` at its place; lists grow at their end.
fn assert_kept(base: &Value, baked: &Value, place: &str) {
    match (base, baked) {
        (Value::Object(old), Value::Object(new)) => {
            for (key, value) in old.iter().filter(|(key, _)| !(place.starts_with("/buffers/") && *key == "byteLength"))
            {
                assert_kept(value, new.get(key).unwrap_or(&Value::Null), &format!("{place}/{key}"));
            }
        }
        (Value::Array(old), Value::Array(new)) => {
            assert!(new.len() >= old.len(), "{place} lost entries");
            for (index, (old, new)) in old.iter().zip(new).enumerate() {
                assert_kept(old, new, &format!("{place}/{index}"));
            }
        }
        _ => assert_eq!(base, baked, "{place}"),
    }
}

#[test]
fn law_1_the_base_is_untouched() {
    let here = folder();
    let base = odd_base("odd.glb", here.path());
    let (baked, stripped) = (output("law-1.glb"), output("law-1-stripped.glb"));
    made_from(&baked, &base);
    run(FOLIAR, &["bake", text(&base), "-o", text(&baked)]).expect(0, &[]);
    let ((old, old_bytes), (new, new_bytes)) = (open_glb(&base), open_glb(&baked));
    assert_kept(&old, &new, "");
    assert!(new_bytes.starts_with(&old_bytes), "bytes of the base");
    assert!(new_bytes.len() > old_bytes.len(), "a bake that adds nothing tests nothing");
    made_from(&stripped, &base);
    run(FOLIAR, &["strip", text(&baked), "-o", text(&stripped)]).expect(0, &[]);
    let (back, back_bytes) = open_glb(&stripped);
    assert_eq!(back, old);
    assert!(back_bytes == old_bytes, "bytes come back");
}

#[test]
fn law_1_holds_on_a_real_glb() {
    let Some(base) = shared("trees/ez_bush_2/tree.glb") else { return };
    let baked = output("law-1-ez_bush_2.glb");
    made_from(&baked, &base);
    run(FOLIAR, &["bake", text(&base), "-o", text(&baked)]).expect(0, &[]);
    let ((old, old_bytes), (new, new_bytes)) = (open_glb(&base), open_glb(&baked));
    assert_kept(&old, &new, "");
    assert!(new_bytes.starts_with(&old_bytes));
}

#[test]
fn laws_1_and_3_hold_on_every_odd_plant() {
    let here = folder();
    for sample in foliar_plant::sample::odd_plants() {
        let base = here.path().join(format!("{}.glb", sample.name));
        crate::plants::write_glb(sample.plant.base(), &base);
        let (baked, stripped) =
            (output(&format!("odd-{}.glb", sample.name)), output(&format!("odd-{}-base.glb", sample.name)));
        let bake = |input: &Path, word: &str| {
            let run = run(FOLIAR, &["bake", text(input), "-o", text(&baked)]).expect(0, &[]);
            assert!(run.stdout.contains(word), "{}: {run:?}", sample.name);
        };
        bake(&base, "written");
        let ((old, old_bytes), (new, new_bytes)) = (open_glb(&base), open_glb(&baked));
        assert_kept(&old, &new, "");
        assert!(new_bytes.starts_with(&old_bytes), "{}: bytes of the base", sample.name);
        bake(&baked, "unchanged");
        run(FOLIAR, &["strip", text(&baked), "-o", text(&stripped)]).expect(0, &[]);
        assert_eq!(open_glb(&stripped), (old, old_bytes), "{}", sample.name);
    }
}

#[test]
fn law_3_one_process_or_two_in_place_or_not_the_file_is_the_same() {
    let here = folder();
    let obj = tree(here.path(), 60);
    let [once, steps, again] = ["once", "steps", "again"].map(|name| output(&format!("law-3-{name}.glb")));
    run(FOLIAR, &["bake", text(&obj), "-o", text(&once)]).expect(0, &[]);
    run(IMPORT, &[text(&obj), "-o", text(&steps)]).expect(0, &[]);
    run(DENSITY, &[text(&steps), "-o", text(&steps)]).expect(0, &[]);
    run(LIGHT, &[text(&steps), "-o", text(&steps)]).expect(0, &[]);
    run(WIND, &[text(&steps), "-o", text(&steps)]).expect(0, &[]);
    same(&once, &steps);
    // Baking what is baked replaces, never appends.
    run(FOLIAR, &["bake", text(&once), "-o", text(&again)]).expect(0, &[]);
    same(&once, &again);
    run(FOLIAR, &["rebake", text(&again)]).expect(0, &[]);
    same(&once, &again);
}

#[test]
fn law_3_layers_assemble_to_the_same_file_in_any_order() {
    let here = folder();
    let plant = output("law-3-plant.glb");
    run(IMPORT, &[text(&tree(here.path(), 60)), "-o", text(&plant)]).expect(0, &[]);
    let (structure, density) = (here.path().join("structure.layer"), here.path().join("density.layer"));
    run(IMPORT, &[text(&plant), "-o", text(&structure)]).expect(0, &[]);
    run(DENSITY, &[text(&plant), "-o", text(&density)]).expect(0, &[]);
    let (ab, ba) = (output("law-3-ab.glb"), output("law-3-ba.glb"));
    run(FOLIAR, &["assemble", text(&plant), text(&structure), text(&density), "-o", text(&ab)]).expect(0, &[]);
    run(FOLIAR, &["assemble", text(&plant), text(&density), text(&structure), "-o", text(&ba)]).expect(0, &[]);
    same(&ab, &ba);
}

#[test]
fn law_4_any_number_of_threads_gives_the_same_bytes() {
    let here = folder();
    let obj = shared("trees/sapling_default_1k5/tree.obj").unwrap_or_else(|| tree(here.path(), 500));
    let files = ["1", "2", "5"].map(|threads| {
        let out = output(&format!("law-4-{threads}.glb"));
        run(FOLIAR, &["bake", text(&obj), "-o", text(&out), "--threads", threads]).expect(0, &[]);
        out
    });
    same(&files[0], &files[1]);
    same(&files[0], &files[2]);
}

#[test]
fn law_9_an_equal_output_is_left_untouched() {
    let (here, out) = (folder(), output("law-9-untouched.glb"));
    let obj = tree(here.path(), 60);
    let bake = || run(FOLIAR, &["bake", text(&obj), "-o", text(&out)]).expect(0, &[]).stdout;
    let modified = || std::fs::metadata(&out).unwrap().modified().unwrap();
    assert!(bake().contains("written"));
    // Far enough back that no clock's grain can hide a touch.
    let long_ago = modified() - Duration::from_secs(3600);
    std::fs::File::options().write(true).open(&out).unwrap().set_modified(long_ago).unwrap();
    assert!(bake().contains("unchanged"));
    assert_eq!(modified(), long_ago);
    tree(here.path(), 61);
    assert!(bake().contains("written"));
    assert!(modified() > long_ago);
}

/// A smoke test: the write is a small share of the run, so a kill seldom hits it. The proof, a stop at
/// each step of the write, stands in the carrier's tests/writing.rs.
#[test]
fn law_9_killed_at_any_moment_the_output_is_the_old_or_the_new() {
    let here = folder();
    let (old, new) = (output("law-9-old.glb"), output("law-9-new.glb"));
    run(FOLIAR, &["bake", text(&tree(here.path(), 60)), "-o", text(&old)]).expect(0, &[]);
    let big = tree(here.path(), 20_000);
    let start = std::time::Instant::now();
    run(FOLIAR, &["bake", text(&big), "-o", text(&new)]).expect(0, &[]);
    let whole = start.elapsed();
    let (old_bytes, new_bytes) = (std::fs::read(&old).unwrap(), std::fs::read(&new).unwrap());
    let target = here.path().join("target.glb");
    let steps = 12;
    for step in 1..=steps {
        std::fs::write(&target, &old_bytes).unwrap();
        let mut child = command(FOLIAR)
            .args(["bake", text(&big), "-o", text(&target)])
            .stdout(Stdio::null())
            .stderr(Stdio::null())
            .spawn()
            .unwrap();
        std::thread::sleep(whole * step / steps);
        child.kill().unwrap();
        child.wait().unwrap();
        let found = std::fs::read(&target).unwrap();
        assert!(found == old_bytes || found == new_bytes, "half-written after {step}/{steps} of {whole:?}");
    }
}

#[test]
fn law_9_a_failure_leaves_no_trace() {
    let here = folder();
    tree(here.path(), 60);
    std::fs::write(here.path().join("tree.glb"), b"old").unwrap();
    std::fs::write(here.path().join("tree.obj"), "v 0 0 0\nf 1 2 3\n").unwrap();
    let before: Vec<_> = std::fs::read_dir(here.path()).unwrap().map(|f| f.unwrap().file_name()).collect();
    run_in(here.path(), FOLIAR, &["bake", "tree.obj", "-o", "tree.glb"]).expect(3, &["tree.obj", "line 2"]);
    let after: Vec<_> = std::fs::read_dir(here.path()).unwrap().map(|f| f.unwrap().file_name()).collect();
    assert_eq!(before, after);
    assert_eq!(std::fs::read(here.path().join("tree.glb")).unwrap(), b"old");
}
