//! OBJ in, glTF out: every hazard that readers of OBJ stumble over, real trees, hostile bytes.

#![expect(
    clippy::unwrap_used,
    clippy::float_cmp,
    clippy::print_stderr,
    reason = "tests: what fails must fail, numbers are exact"
)]

mod geometry;
mod hostile;
mod materials;
mod textures;
mod trees;

use foliar_carrier::Document;
use foliar_carrier::obj::{Converted, ObjFile, convert, parse};
use foliar_schema::Import;
use std::path::{Path, PathBuf};

/// Reads OBJ text that must be right.
fn read(text: &str) -> ObjFile {
    parse(text.as_bytes(), "tree.obj").unwrap()
}

/// The message that OBJ bytes are refused with; it must name the file.
fn refused(bytes: impl AsRef<[u8]>) -> String {
    let message = parse(bytes.as_ref(), "tree.obj").unwrap_err().to_string();
    assert!(message.starts_with("tree.obj"), "{message}");
    message
}

/// Converts OBJ text that lies in no folder.
fn converted(text: &str, import: &Import) -> Converted {
    convert(text.as_bytes(), "tree.obj", Path::new("/nowhere"), import).unwrap()
}

/// Converts an OBJ file that lies in `folder`.
fn converted_in(folder: &Path, text: &str, import: &Import) -> Converted {
    convert(text.as_bytes(), "tree.obj", folder, import).unwrap()
}

/// Messages of the findings with this code.
fn findings(converted: &Converted, code: &str) -> Vec<String> {
    converted.findings.iter().filter(|f| f.code == code).map(|f| f.message.clone()).collect()
}

/// What the `gltf` crate reads of one primitive.
struct Read {
    positions: Vec<[f32; 3]>,
    normals: Vec<[f32; 3]>,
    uvs: Vec<[f32; 2]>,
    tangents: Vec<[f32; 4]>,
    indices: Vec<u32>,
}

/// Reads every mesh by the `gltf` crate, which shares no code with the writer.
fn second_reader(document: &Document) -> Vec<Read> {
    let json = serde_json::to_vec(&document.json).unwrap();
    let gltf = gltf::Gltf::from_slice(&json).unwrap();
    let primitives = gltf.meshes().flat_map(|m| m.primitives().collect::<Vec<_>>()).collect::<Vec<_>>();
    let buffer = |b: gltf::Buffer| Some(document.buffers[b.index()].as_slice());
    primitives
        .iter()
        .map(|primitive| {
            let reader = primitive.reader(buffer);
            Read {
                positions: reader.read_positions().unwrap().collect(),
                normals: reader.read_normals().unwrap().collect(),
                uvs: reader.read_tex_coords(0).map(|t| t.into_f32().collect()).unwrap_or_default(),
                tangents: reader.read_tangents().map(Iterator::collect).unwrap_or_default(),
                indices: reader.read_indices().unwrap().into_u32().collect(),
            }
        })
        .collect()
}

/// Leaves a GLB for the Khronos validator, which goes over all that tests write.
fn keep(name: &str, document: &Document) {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../target/foliar-test-outputs/obj");
    std::fs::create_dir_all(&folder).unwrap();
    std::fs::write(folder.join(format!("{name}.glb")), document.to_glb().unwrap()).unwrap();
}

/// The folder with shared data, where there is one.
fn shared() -> Option<PathBuf> {
    let named = std::env::var_os("FOLIAR_SHARED").map(PathBuf::from);
    let folder = named.unwrap_or_else(|| Path::new(env!("CARGO_MANIFEST_DIR")).join("../../../shared"));
    if folder.is_dir() {
        return Some(folder);
    }
    eprintln!("skipped: {} is not there, no shared data", folder.display());
    None
}
