//! Small plants made by rule.

use foliar_numerics::radical_inverse;
use foliar_plant::{Base, Leaf, NO_LEAF, Part, Place, Plant, Structure};
use foliar_schema::Role;
use glam::{DAffine3, DVec3};

/// Point `index` of a Halton sequence in [-1, 1]^3.
pub fn halton(index: u64) -> DVec3 {
    DVec3::from_array([2, 3, 5].map(|base| 2.0 * radical_inverse(index + 1, base) - 1.0))
}

/// Halton points in the unit ball.
pub fn in_ball(count: usize) -> impl Iterator<Item = DVec3> {
    (0..).map(halton).filter(|p| p.length_squared() < 1.0).take(count)
}

/// One square leaf.
#[derive(Clone, Copy, Debug)]
pub struct Quad {
    pub center: DVec3,
    pub edge: f64,
    pub normal: DVec3,
}

/// A plant of square leaves in one part, and a bar of wood with `wood` vertices in another.
pub fn plant(quads: &[Quad], wood: usize, transform: DAffine3) -> Plant {
    let (mut part, mut leaves, mut ids) = (Part { transform, ..Part::default() }, Vec::new(), Vec::new());
    let to_mesh = transform.inverse();
    for (id, quad) in quads.iter().enumerate() {
        let u = quad.normal.any_orthonormal_vector() * (quad.edge / 2.0);
        let v = quad.normal.cross(u);
        let first = part.positions.len() as u32;
        for (a, b) in [(-1.0, -1.0), (1.0, -1.0), (1.0, 1.0), (-1.0, 1.0)] {
            part.positions.push(to_mesh.transform_point3(quad.center + u * a + v * b).as_vec3());
            part.normals.push(part.normal_to_mesh(quad.normal).as_vec3());
        }
        part.triangles.extend([[first, first + 1, first + 2], [first, first + 2, first + 3]]);
        ids.extend([id as u32; 4]);
        leaves.push(Leaf {
            center: quad.center.as_vec3(),
            normal: quad.normal.as_vec3(),
            area: (quad.edge * quad.edge) as f32,
            group: id as u32,
            petiole: quad.center.as_vec3(),
            crown_volume: false,
        });
    }
    let bar = (0..wood).map(|i| DVec3::new(0.0, i as f64 / wood as f64 * 2.0 - 1.0, 0.01));
    let mut bark = Part { transform, place: Place { mesh: 1, primitive: 0 }, ..Part::default() };
    bark.positions = bar.map(|p| to_mesh.transform_point3(p).as_vec3()).collect();
    bark.triangles = (2..wood as u32).map(|i| [i - 2, i - 1, i]).collect();
    let count = part.positions.len() as u32;
    part.position_ids = (0..count).collect();
    bark.position_ids = (count..count + wood as u32).collect();
    let (roles, leaf_ids) = (vec![Role::Leaf, Role::Wood], vec![ids, vec![NO_LEAF; wood]]);
    let base = Base { parts: vec![part, bark], position_count: count + wood as u32, ..Base::default() };
    Plant::new(base, Structure { roles, leaves, leaf_ids }).unwrap()
}

/// A crown of radius `radius` meters: boughs of 20 leaves each.
pub fn crown(leaves: usize, radius: f64, edge: f64, wood: usize) -> Plant {
    let boughs: Vec<DVec3> = in_ball(leaves.div_ceil(20)).collect();
    let quads: Vec<Quad> = in_ball(leaves)
        .enumerate()
        .map(|(i, p)| Quad {
            center: (boughs[i / 20] * 0.9 + p * 0.1) * radius,
            edge,
            normal: halton(i as u64 * 7 + 3).try_normalize().unwrap_or(DVec3::Y),
        })
        .collect();
    plant(&quads, wood, DAffine3::IDENTITY)
}
