//! Plants of parallelograms, as the oracle has them.

use super::oracle::Set;
use foliar_plant::{Base, Leaf, Part, Plant, Structure};
use foliar_schema::Role;
use glam::{DAffine3, DVec3};

/// The leaves of a set as one part without texture, in a frame of their own.
pub fn plant(set: &Set, to_rest: DAffine3) -> Plant {
    let mut part = Part { transform: to_rest, ..Part::default() };
    let (mut leaves, mut ids) = (Vec::new(), Vec::new());
    let factor = to_rest.matrix3.x_axis.length_squared();
    for (id, (source, [u, v])) in (0u32..).zip(set.sources.iter().zip(&set.edges)) {
        let corners = [-u - v, u - v, u + v, v - u].map(|corner| (source.center + corner).as_vec3());
        let first = part.positions.len() as u32;
        part.positions.extend(corners);
        part.triangles.extend([[first, first + 1, first + 2], [first, first + 2, first + 3]]);
        ids.extend([id; 4]);
        let center = to_rest.transform_point3(source.center).as_vec3();
        let (area, normal) = ((source.area * factor) as f32, source.normal.as_vec3());
        leaves.push(Leaf { center, normal, area, group: source.group, petiole: center, crown_volume: false });
    }
    let position_count = part.positions.len() as u32;
    part.position_ids = (0..position_count).collect();
    let base = Base { parts: vec![part], position_count, ..Base::default() };
    Plant::new(base, Structure { roles: vec![Role::Leaf], leaves, leaf_ids: vec![ids] }).unwrap()
}

/// Square leaves turned every way at these places.
pub fn squares(places: impl Iterator<Item = DVec3>, edge: f64) -> Set {
    let mut set = Set { name: "squares".into(), sources: Vec::new(), edges: Vec::new(), unit: 1.0 };
    for (index, center) in places.enumerate() {
        let normal = foliar_numerics::fibonacci_sphere(index * 29 % 97, 97);
        let (u, v) = normal.any_orthonormal_pair();
        set.edges.push([u * edge / 2.0, v * edge / 2.0]);
        set.sources.push(crate::leaves::Source { center, normal, area: edge * edge, group: index as u32 });
    }
    set
}
