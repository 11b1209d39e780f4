//! A look at an OBJ: geometry as import reads it, materials and pictures without decoding them.

use super::picture::{self, Bytes, Found, Picture};
use super::{Problem, Survey, Trouble};
use crate::CarrierError;
use crate::obj::frame::{self, Frame};
use crate::obj::library::{self, Defined, Source};
use crate::obj::mesh::{self, Mesh};
use crate::obj::{Map, ObjFile, notes, parse, textures::Textures};
use foliar_plant::{AlphaMode, Material, Part, Place};
use foliar_schema::{Finding, Import, code};
use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

/// Cutoff of the mask that import makes of a picture's alpha.
const CUTOFF: f32 = 0.5;

pub(super) fn look(
    bytes: &[u8],
    name: &str,
    folder: &Path,
    import: &Import,
    seen: &mut Survey,
) -> Result<(), CarrierError> {
    let file = match parse(bytes, name) {
        Ok(file) => file,
        Err(error) => {
            let problem = Problem::new(Trouble::Broken, error);
            let trouble = if names_no_number(bytes, &problem.place) { Trouble::NotFinite } else { Trouble::Broken };
            seen.problems.push(Problem { trouble, ..problem });
            return Ok(());
        }
    };
    let source = Source { name, folder, import };
    let frame = Frame::choose(&file, import, name)?;
    let (meshes, noticed) = mesh::build(&file, frame);
    seen.unused_positions = noticed.unused_positions;
    seen.findings.extend(frame::findings(&file, import).into_iter().map(|finding| finding.in_file(name)));
    let degenerate = |finding: &Finding| finding.code == code::IMPORT_DEGENERATE.code;
    seen.findings.extend(notes::findings(&file, &noticed, name).into_iter().filter(|finding| !degenerate(finding)));
    seen.base.position_count = file.positions.len() as u32;
    seen.base.parts = meshes.into_iter().enumerate().map(|(index, mesh)| part(index as u32, mesh, &file)).collect();
    let libraries = library::read(&file, &source)?;
    seen.files.extend(libraries.files);
    seen.findings.extend(libraries.findings);
    let mut known = BTreeMap::new();
    for name in &file.materials {
        let plain = Defined::default();
        let defined = libraries.materials.get(name).unwrap_or(&plain);
        material(name, defined, &source, &mut known, seen);
    }
    Ok(())
}

/// Whether the line that a problem names holds a number which is none, or is not finite.
fn names_no_number(bytes: &[u8], place: &str) -> bool {
    let Some(line) = place.strip_prefix("line ").and_then(|n| n.parse::<usize>().ok()) else { return false };
    let text = bytes.split(|b| *b == b'\n').nth(line.saturating_sub(1)).map(String::from_utf8_lossy);
    let bad = |word: &str| word.parse::<f64>().is_ok_and(|v| !v.is_finite()) || word.contains("1.#");
    text.is_some_and(|text| text.split_whitespace().any(|word| bad(&word.to_ascii_lowercase())))
}

fn part(index: u32, mesh: Mesh, file: &ObjFile) -> Part {
    let name = |list: &[String], index: Option<u32>| index.and_then(|i| list.get(i as usize).cloned());
    Part {
        place: Place { mesh: index, primitive: 0 },
        material_name: name(&file.materials, mesh.material),
        object_name: name(&file.objects, mesh.object),
        node_name: name(&file.objects, mesh.object),
        material: mesh.material,
        positions: mesh.positions,
        normals: mesh.normals,
        uvs: mesh.uvs,
        triangles: mesh.indices.chunks_exact(3).map(|t| [t[0], t[1], t[2]]).collect(),
        position_ids: mesh.position_ids,
        ..Part::default()
    }
}

fn material(name: &str, defined: &Defined, source: &Source, known: &mut BTreeMap<PathBuf, usize>, seen: &mut Survey) {
    let said = &defined.material;
    let mut add = |map: &Option<Map>| map.as_ref().and_then(|map| add_picture(map, defined, source, known, seen));
    let color = add(&said.map_kd);
    let mask = add(&said.map_d);
    _ = add(&said.bump);
    _ = add(&said.norm);
    let holds_alpha = |index: usize| matches!(seen.pictures[index].found, Found::Picture { has_alpha: true, .. });
    let masked = mask.is_some() || color.is_some_and(holds_alpha);
    let [red, green, blue] = said.kd.unwrap_or([1.0; 3]).map(|c| c as f32);
    if mask.is_some_and(|mask| color != Some(mask) && matches!(seen.pictures[mask].found, Found::Picture { .. })) {
        seen.own_masks.insert(seen.base.materials.len());
    }
    seen.base_pictures.push(color);
    seen.base.materials.push(Material {
        name: Some(name.into()),
        base_color: [red, green, blue, 1.0],
        base_color_raster: None,
        alpha_mode: if masked { AlphaMode::Mask(CUTOFF) } else { AlphaMode::Opaque },
        double_sided: true,
    });
}

fn add_picture(
    map: &Map,
    defined: &Defined,
    source: &Source,
    known: &mut BTreeMap<PathBuf, usize>,
    seen: &mut Survey,
) -> Option<usize> {
    let located = Textures::default().locate(map, &defined.library, source);
    let named = located.map_err(|error| seen.problems.push(Problem::new(Trouble::Broken, error))).ok()?;
    if let Some(index) = known.get(&named.path) {
        return Some(*index);
    }
    let (found, bytes) = match std::fs::read(&named.path) {
        Ok(bytes) => (picture::look(&bytes), Bytes::File(named.path.clone())),
        Err(error) => (Found::Missing(error.to_string()), Bytes::None),
    };
    let claims = picture::name_claim(&map.file).into_iter().collect();
    let (place, file) = (named.place, named.file);
    if matches!(bytes, Bytes::File(_)) {
        seen.files.push(named.path.clone());
    }
    seen.pictures.push(Picture { name: map.file.clone(), place, file, claims, in_core: false, found, bytes });
    known.insert(named.path, seen.pictures.len() - 1);
    Some(seen.pictures.len() - 1)
}
