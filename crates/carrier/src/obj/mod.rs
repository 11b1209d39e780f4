//! OBJ and MTL to a glTF document: one mesh per object and material, whatever its role.
//!
//! [`parse`] reads the geometry as it stands in the file; [`convert`] turns it into meters and Y up,
//! completes normals and tangents, and makes materials and images.

pub(crate) mod build;
mod file;
pub(crate) mod frame;
pub(crate) mod library;
mod materials;
pub(crate) mod mesh;
mod mtl;
mod normals;
pub(crate) mod notes;
mod number;
mod polygon;
mod runs;
mod scan;
mod tangents;
mod text;
pub(crate) mod textures;

pub use file::{Library, ObjFile, parse};
pub use mtl::{Contents, Map, Material, parse_mtl};
pub use runs::Run;
pub use scan::{Corner, NONE};

use crate::{CarrierError, Document};
use build::Piece;
use foliar_schema::{Finding, Import};
use frame::Frame;
use library::Source;
use materials::{Materials, Wanted};
use mesh::Mesh;
use std::path::{Path, PathBuf};

/// What reading an OBJ gives.
#[derive(Clone, Debug, Default)]
pub struct Converted {
    /// The glTF that it becomes: one mesh with one primitive per object and material.
    pub document: Document,
    /// Per mesh, per vertex: index of the file's own `v` line.
    pub position_ids: Vec<Vec<u32>>,
    /// Number of `v` lines.
    pub position_count: u32,
    /// What a person may want to know.
    pub findings: Vec<Finding>,
    /// Files read beside the OBJ: material libraries and textures.
    pub files: Vec<PathBuf>,
}

/// Converts OBJ bytes; `name` stands in messages, libraries and textures are looked for in `folder`.
///
/// # Errors
/// [`CarrierError::Input`] with file and line.
pub fn convert(bytes: &[u8], name: &str, folder: &Path, import: &Import) -> Result<Converted, CarrierError> {
    let source = Source { name, folder, import };
    let file = parse(bytes, name)?;
    let frame = Frame::choose(&file, import, name)?;
    let libraries = library::read(&file, &source)?;
    let (meshes, noticed) = mesh::build(&file, frame);
    let mut findings: Vec<Finding> =
        frame::findings(&file, import).into_iter().map(|finding| finding.in_file(name)).collect();
    findings.extend(notes::findings(&file, &noticed, name));
    let mut materials = Materials::new(&libraries, source);
    let pieces = pieces(meshes, &file, &mut materials, &source)?;
    let Materials { json, textures, .. } = materials;
    let document = build::document(&pieces, json, &textures.images);
    findings.extend(libraries.findings);
    findings.extend(textures.findings);
    Ok(Converted {
        document,
        position_ids: pieces.into_iter().map(|p| p.mesh.position_ids).collect(),
        position_count: file.positions.len() as u32,
        findings,
        files: libraries.files.into_iter().chain(textures.files).collect(),
    })
}

/// Names and materials of meshes, and tangents where a material has a normal map.
fn pieces(
    meshes: Vec<Mesh>,
    file: &ObjFile,
    materials: &mut Materials,
    source: &Source,
) -> Result<Vec<Piece>, CarrierError> {
    let loose = loose_textures(&meshes, file, source)?;
    let mut pieces = Vec::with_capacity(meshes.len());
    for mut mesh in meshes {
        let (object, material) = names(&mesh, file);
        let texture = loose.iter().rev().find(|(part, _)| is_part(part, object, material));
        let wanted = Wanted {
            name: material.map(str::to_string),
            has_uvs: !mesh.uvs.is_empty(),
            loose: texture.map(|(_, path)| path.clone()),
        };
        let name = object.map(str::to_string);
        let material = materials.index(wanted)?;
        if materials.normal_mapped[material] {
            tangents::add(&mut mesh);
        }
        pieces.push(Piece { mesh, name, material });
    }
    Ok(pieces)
}

/// Object and material name of a mesh.
fn names<'a>(mesh: &Mesh, file: &'a ObjFile) -> (Option<&'a str>, Option<&'a str>) {
    let name = |list: &'a [String], index: Option<u32>| index.map(|i| list[i as usize].as_str());
    (name(&file.objects, mesh.object), name(&file.materials, mesh.material))
}

fn is_part(part: &str, object: Option<&str>, material: Option<&str>) -> bool {
    material.or(object).unwrap_or("") == part
}

/// `PART=FILE` of every `--texture`, each PART one of the file's.
fn loose_textures(meshes: &[Mesh], file: &ObjFile, source: &Source) -> Result<Vec<(String, PathBuf)>, CarrierError> {
    let mut loose = Vec::new();
    for given in &source.import.texture {
        let refuse = |problem: &str, remedy: String| CarrierError::input(source.name, "", problem, remedy);
        let Some((part, path)) = given.split_once('=') else {
            return Err(refuse(&format!("--texture {given:?} has no '='"), "write PART=FILE".into()));
        };
        if !meshes.iter().map(|m| names(m, file)).any(|(object, material)| is_part(part, object, material)) {
            let mut known: Vec<_> = meshes.iter().map(|m| names(m, file)).map(|(o, m)| m.or(o).unwrap_or("")).collect();
            known.sort_unstable();
            known.dedup();
            return Err(refuse(
                &format!("--texture names part {part:?}, which is not there"),
                format!("name one of {known:?}"),
            ));
        }
        // A person's own path may lead anywhere; it counts from the current folder, or from the asset's.
        let candidates = [PathBuf::from(path), source.folder.join(path)];
        let Some(found) = candidates.iter().find(|candidate| candidate.is_file()) else {
            return Err(refuse(&format!("--texture {given:?}: there is no such file"), "name a picture".into()));
        };
        loose.push((part.to_string(), found.clone()));
    }
    Ok(loose)
}
