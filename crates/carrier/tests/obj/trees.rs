//! Every OBJ of the shared trees: what `expected.json` says, and what tobj reads.

use super::{converted_in, keep, second_reader, shared};
use foliar_carrier::obj::{Converted, convert, parse};
use foliar_schema::{Import, Up};
use std::collections::{BTreeMap, BTreeSet};
use std::path::{Path, PathBuf};

fn objs(shared: &Path) -> Vec<PathBuf> {
    let mut all: Vec<PathBuf> = std::fs::read_dir(shared.join("trees"))
        .unwrap()
        .filter_map(|entry| std::fs::read_dir(entry.unwrap().path()).ok())
        .flat_map(|folder| folder.map(|entry| entry.unwrap().path()))
        .filter(|path| path.extension().is_some_and(|e| e == "obj"))
        .collect();
    all.sort();
    assert!(all.len() >= 31, "{}", all.len());
    all
}

/// Triangles and connected pieces (over the file's own position indices) of each material.
fn parts(converted: &Converted) -> BTreeMap<String, (u64, u64)> {
    let json = &converted.document.json;
    let mut parts: BTreeMap<String, Vec<[u32; 3]>> = BTreeMap::new();
    for (mesh, read) in second_reader(&converted.document).iter().enumerate() {
        let material = json["meshes"][mesh]["primitives"][0]["material"].as_u64().unwrap() as usize;
        let name = json["materials"][material]["name"].as_str().unwrap_or("").to_string();
        let ids = &converted.position_ids[mesh];
        let triangles = read.indices.chunks_exact(3).map(|t| [t[0], t[1], t[2]].map(|i| ids[i as usize]));
        parts.entry(name).or_default().extend(triangles);
    }
    parts.into_iter().map(|(name, triangles)| (name, (triangles.len() as u64, pieces(&triangles)))).collect()
}

fn pieces(triangles: &[[u32; 3]]) -> u64 {
    let mut parent: BTreeMap<u32, u32> = triangles.iter().flatten().map(|&i| (i, i)).collect();
    fn root(parent: &mut BTreeMap<u32, u32>, mut at: u32) -> u32 {
        while parent[&at] != at {
            let above = parent[&parent[&at]];
            parent.insert(at, above);
            at = above;
        }
        at
    }
    for &[a, b, c] in triangles {
        for other in [b, c] {
            let (from, to) = (root(&mut parent, other), root(&mut parent, a));
            parent.insert(from, to);
        }
    }
    parent.iter().filter(|(at, above)| at == above).count() as u64
}

#[test]
fn every_listed_file_has_its_parts_triangles_and_pieces() {
    let Some(shared) = shared() else { return };
    let expected: serde_json::Value =
        serde_json::from_slice(&std::fs::read(shared.join("trees/expected.json")).unwrap()).unwrap();
    let mut seen = 0;
    for (file, facts) in expected["files"].as_object().unwrap().iter().filter(|(f, _)| f.ends_with(".obj")) {
        let path = shared.join("trees").join(file);
        let up = if facts["up"] == "z" { Up::Z } else { Up::Y };
        let import = Import { up: Some(up), ..Import::default() };
        let bytes = std::fs::read(&path).unwrap();
        let found = parts(&convert(&bytes, file, path.parent().unwrap(), &import).unwrap());
        let wanted: BTreeMap<String, (u64, u64)> = facts["parts"]
            .as_array()
            .unwrap()
            .iter()
            .map(|p| {
                (
                    p["part"].as_str().unwrap().to_string(),
                    (p["triangles"].as_u64().unwrap(), p["pieces"].as_u64().unwrap()),
                )
            })
            .collect();
        assert_eq!(found, wanted, "{file}");
        seen += 1;
    }
    assert!(seen >= 18, "{seen}");
}

#[test]
fn tobj_reads_the_same_triangles_and_positions() {
    let Some(shared) = shared() else { return };
    for path in objs(&shared) {
        let file = parse(&std::fs::read(&path).unwrap(), "tree.obj").unwrap();
        let options = tobj::LoadOptions { triangulate: true, ..Default::default() };
        let (models, _) = tobj::load_obj(&path, &options).unwrap();
        let theirs: usize = models.iter().map(|m| m.mesh.indices.len() / 3).sum();
        assert_eq!(file.triangles.len(), theirs, "{}", path.display());
        let bits = |p: [f32; 3]| p.map(f32::to_bits);
        let ours: BTreeSet<_> =
            file.triangles.iter().flatten().map(|c| bits(file.positions[c.v as usize].map(|x| x as f32))).collect();
        let theirs: BTreeSet<_> = models
            .iter()
            .flat_map(|m| m.mesh.indices.iter().map(|&i| i as usize * 3).map(|i| &m.mesh.positions[i..i + 3]))
            .map(|p| bits([p[0], p[1], p[2]]))
            .collect();
        assert!(ours == theirs, "{}: {} and {} positions", path.display(), ours.len(), theirs.len());
    }
}

#[test]
fn every_tree_converts_to_sound_meshes() {
    let Some(shared) = shared() else { return };
    for path in objs(&shared) {
        let text = String::from_utf8(std::fs::read(&path).unwrap()).unwrap();
        let converted = converted_in(path.parent().unwrap(), &text, &Import::default());
        let name = path.strip_prefix(shared.join("trees")).unwrap().display().to_string().replace('/', "_");
        keep(&name, &converted.document);
        for (mesh, read) in second_reader(&converted.document).iter().enumerate() {
            // glTF's tolerance for unit vectors.
            let unit = |v: &[f32]| (v.iter().map(|c| f64::from(*c).powi(2)).sum::<f64>().sqrt() - 1.0).abs() < 0.00674;
            assert!(read.normals.iter().all(|n| unit(n)) && read.tangents.iter().all(|t| unit(&t[..3])));
            assert!(read.tangents.is_empty() || read.tangents.len() == read.positions.len());
            assert_eq!(converted.position_ids[mesh].len(), read.positions.len());
        }
    }
}

#[test]
fn bark_with_a_normal_map_has_tangents_and_leaves_cut_out() {
    let Some(shared) = shared() else { return };
    let folder = shared.join("trees/ez_bush_2");
    let text = std::fs::read_to_string(folder.join("tree.obj")).unwrap();
    let converted = converted_in(&folder, &text, &Import::default());
    let meshes = second_reader(&converted.document);
    assert!(!meshes[0].tangents.is_empty() && meshes[1].tangents.is_empty());
    let leaves = &converted.document.json["materials"][1];
    assert_eq!((leaves["alphaMode"].as_str(), leaves["doubleSided"].as_bool()), (Some("MASK"), Some(true)));
    // The picture's own bytes stand in the buffer.
    let picture = std::fs::read(folder.join("aspen_color.png")).unwrap();
    let view = &converted.document.json["bufferViews"]
        [converted.document.json["images"][2]["bufferView"].as_u64().unwrap() as usize];
    let start = view["byteOffset"].as_u64().unwrap() as usize;
    assert!(converted.document.buffers[0][start..start + picture.len()] == picture[..]);
    assert_eq!(converted.files.len(), 4);
}
