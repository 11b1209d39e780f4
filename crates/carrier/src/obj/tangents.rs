//! MikkTSpace tangents for normal-mapped meshes, so that every renderer bends light the same way.

use super::mesh::Mesh;
use bevy_mikktspace::{Geometry, Ops, TangentSpace, generate_tangents};
use glam::{Vec3, Vec4};
use std::collections::BTreeMap;

/// Arithmetic that gives the same bits on every machine.
struct Exact;

impl Ops for Exact {
    fn sqrt(x: f32) -> f32 {
        x.sqrt()
    }

    fn acos(x: f32) -> f32 {
        libm::acos(f64::from(x)) as f32
    }
}

struct Corners<'a> {
    mesh: &'a Mesh,
    tangents: Vec<Option<Vec4>>,
}

impl Corners<'_> {
    fn vertex(&self, face: usize, corner: usize) -> usize {
        self.mesh.indices[face * 3 + corner] as usize
    }
}

impl Geometry<Exact> for Corners<'_> {
    fn num_faces(&self) -> usize {
        self.mesh.indices.len() / 3
    }

    fn num_vertices_of_face(&self, _face: usize) -> usize {
        3
    }

    fn position(&self, face: usize, vert: usize) -> [f32; 3] {
        self.mesh.positions[self.vertex(face, vert)].to_array()
    }

    fn normal(&self, face: usize, vert: usize) -> [f32; 3] {
        self.mesh.normals[self.vertex(face, vert)].to_array()
    }

    fn tex_coord(&self, face: usize, vert: usize) -> [f32; 2] {
        self.mesh.uvs[self.vertex(face, vert)].to_array()
    }

    fn set_tangent(&mut self, tangent_space: Option<TangentSpace>, face: usize, vert: usize) {
        // glTF's v runs downward while its bitangent runs upward: the side is turned.
        self.tangents[face * 3 + vert] = tangent_space.map(|t| {
            let [x, y, z, w] = t.tangent_encoded();
            Vec4::new(x, y, z, -w)
        });
    }
}

/// Gives `mesh` tangents; a vertex whose corners want different ones is doubled at the end.
pub(crate) fn add(mesh: &mut Mesh) {
    if mesh.uvs.len() != mesh.positions.len() {
        return;
    }
    let mut corners = Corners { mesh, tangents: vec![None; mesh.indices.len()] };
    // The error type has no values.
    let _ = generate_tangents(&mut corners);
    let tangents = corners.tangents;
    let mut result: Vec<Option<Vec4>> = vec![None; mesh.positions.len()];
    let mut doubles = BTreeMap::new();
    for (corner, tangent) in tangents.into_iter().enumerate() {
        let vertex = mesh.indices[corner];
        let tangent = unit(tangent, mesh.normals[vertex as usize]);
        match result[vertex as usize] {
            None => result[vertex as usize] = Some(tangent),
            Some(known) if known == tangent => {}
            Some(_) => {
                let bits = tangent.to_array().map(f32::to_bits);
                mesh.indices[corner] = *doubles.entry((vertex, bits)).or_insert_with(|| {
                    result.push(Some(tangent));
                    double(&mut mesh.positions, vertex);
                    double(&mut mesh.normals, vertex);
                    double(&mut mesh.uvs, vertex);
                    double(&mut mesh.position_ids, vertex);
                    result.len() as u32 - 1
                });
            }
        }
    }
    let normals = mesh.normals.iter();
    mesh.tangents = result.into_iter().zip(normals).map(|(t, n)| t.unwrap_or_else(|| unit(None, *n))).collect();
}

fn double<T: Copy>(list: &mut Vec<T>, vertex: u32) {
    list.push(list[vertex as usize]);
}

/// The tangent made unit in f64; any direction across the normal where there is none.
fn unit(tangent: Option<Vec4>, normal: Vec3) -> Vec4 {
    let across = || normal.any_orthonormal_vector();
    let (direction, side) = tangent.map_or_else(|| (across(), 1.0), |t| (t.truncate(), t.w));
    let direction = direction.as_dvec3().try_normalize().map_or_else(across, |d| d.as_vec3());
    direction.extend(side)
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::Vec2;

    fn card(mirrored: bool) -> Mesh {
        let u = if mirrored { [1.0, 0.0, 0.0, 1.0] } else { [0.0, 1.0, 1.0, 0.0] };
        Mesh {
            positions: vec![Vec3::ZERO, Vec3::X, Vec3::new(1.0, 1.0, 0.0), Vec3::Y],
            normals: vec![Vec3::Z; 4],
            // v down: the lower corners have v = 1.
            uvs: (0..4).map(|i| Vec2::new(u[i], [1.0, 1.0, 0.0, 0.0][i])).collect(),
            indices: vec![0, 1, 2, 0, 2, 3],
            position_ids: vec![0, 1, 2, 3],
            ..Mesh::default()
        }
    }

    #[test]
    fn tangent_runs_along_u_and_bitangent_up_the_picture() {
        for (mirrored, along) in [(false, Vec3::X), (true, Vec3::NEG_X)] {
            let mut mesh = card(mirrored);
            add(&mut mesh);
            assert_eq!(mesh.tangents.len(), 4);
            for tangent in mesh.tangents {
                assert!((tangent.truncate() - along).length() < 1e-6, "{tangent}");
                let bitangent = Vec3::Z.cross(tangent.truncate()) * tangent.w;
                assert!((bitangent - Vec3::Y).length() < 1e-6, "{tangent}");
            }
        }
    }

    #[test]
    fn a_mirrored_seam_doubles_its_vertices() {
        // Two triangles share an edge, but u runs the other way in the second.
        let mut mesh = card(false);
        mesh.uvs[3] = Vec2::new(2.0, 0.0);
        add(&mut mesh);
        assert_eq!(mesh.tangents.len(), mesh.positions.len());
        assert_eq!(mesh.position_ids.len(), mesh.positions.len());
        assert!(mesh.positions.len() > 4);
        assert!(mesh.indices.iter().all(|&i| (i as usize) < mesh.positions.len()));
    }

    #[test]
    fn degenerate_uvs_give_unit_tangents() {
        let mut mesh = card(false);
        mesh.uvs = vec![Vec2::ZERO; 4];
        add(&mut mesh);
        assert!(
            mesh.tangents.iter().all(|t| (t.truncate().length() - 1.0).abs() < 1e-6 && (t.w.abs() - 1.0).abs() < 1e-6)
        );
    }
}
