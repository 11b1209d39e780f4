//! Wavefront OBJ as text, from a base.

use foliar_plant::{Base, Part};
use std::collections::BTreeMap;
use std::fmt::{Error, Write};

/// What stands in the text beside positions, texture coordinates and faces.
#[derive(Clone, Copy, Debug, Default)]
pub struct Detail {
    /// `vn` lines, one per vertex.
    pub normals: bool,
}

/// The OBJ of a base in which no transform stands; positions to a tenth of a millimeter. Vertices that
/// share a position id are one `v` line, pairs of triangles that make a quad one face.
pub fn write(base: &Base, library: &str, detail: Detail) -> Result<String, Error> {
    let mut text = String::new();
    writeln!(text, "# made by rule: cargo xtask fixtures\nmtllib {library}")?;
    let mut count = Counts::default();
    for part in &base.parts {
        writeln!(text, "o {}", part.object_name.as_deref().unwrap_or("part"))?;
        let corners = vertices(&mut text, part, detail, &mut count)?;
        writeln!(text, "usemtl {}", part.material_name.as_deref().unwrap_or("none"))?;
        for face in faces(&part.triangles) {
            text.push('f');
            for vertex in face {
                text.push(' ');
                text.push_str(&corners[vertex as usize]);
            }
            text.push('\n');
        }
    }
    Ok(text)
}

/// Lines of each kind so far, over the whole file.
#[derive(Default)]
struct Counts {
    positions: usize,
    uvs: usize,
    normals: usize,
}

/// Writes a part's lines; gives each vertex's `v/vt/vn` as faces name it.
fn vertices(text: &mut String, part: &Part, detail: Detail, count: &mut Counts) -> Result<Vec<String>, Error> {
    let (mut of_id, mut of_uv) = (BTreeMap::new(), BTreeMap::new());
    let mut corners = Vec::with_capacity(part.positions.len());
    for (vertex, p) in part.positions.iter().enumerate() {
        let position = *of_id.entry(part.position_ids[vertex]).or_insert(count.positions + 1);
        if position > count.positions {
            count.positions = position;
            writeln!(text, "v {:.4} {:.4} {:.4}", p.x, p.y, p.z)?;
        }
        let uv = part.uvs.get(vertex).map(|uv| format!("vt {:.4} {:.4}\n", uv.x, 1.0 - uv.y));
        let uv = uv.map(|line| {
            let index = *of_uv.entry(line.clone()).or_insert(count.uvs + 1);
            if index > count.uvs {
                count.uvs = index;
                text.push_str(&line);
            }
            index
        });
        let normal = part.normals.get(vertex).filter(|_| detail.normals);
        if let Some(n) = normal {
            count.normals += 1;
            writeln!(text, "vn {:.4} {:.4} {:.4}", n.x, n.y, n.z)?;
        }
        corners.push(match (uv, normal) {
            (Some(uv), Some(_)) => format!("{position}/{uv}/{}", count.normals),
            (Some(uv), None) => format!("{position}/{uv}"),
            (None, Some(_)) => format!("{position}//{}", count.normals),
            (None, None) => position.to_string(),
        });
    }
    Ok(corners)
}

/// Triangles, two that follow each other as `a b c` and `a c d` joined to one quad.
fn faces(triangles: &[[u32; 3]]) -> Vec<Vec<u32>> {
    let mut faces = Vec::new();
    let mut at = 0;
    while let Some(&[a, b, c]) = triangles.get(at) {
        match triangles.get(at + 1) {
            Some(&[a2, c2, d]) if (a2, c2) == (a, c) => {
                faces.push(vec![a, b, c, d]);
                at += 2;
            }
            _ => {
                faces.push(vec![a, b, c]);
                at += 1;
            }
        }
    }
    faces
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn quads_are_joined_again() {
        assert_eq!(faces(&[[0, 1, 2], [0, 2, 3], [4, 5, 6]]), [vec![0, 1, 2, 3], vec![4, 5, 6]]);
    }

    #[test]
    fn a_seam_is_one_position_and_two_texture_coordinates() {
        let plant = foliar_plant::sample::Recipe::small().grow();
        let text = write(plant.base(), "a.mtl", Detail::default()).unwrap();
        let positions = text.lines().filter(|l| l.starts_with("v ")).count();
        assert_eq!(positions, plant.base().position_count as usize);
    }
}
