//! Laws of structure: numbering, frame, unit and tessellation change nothing that they should not.
#![expect(clippy::unwrap_used, reason = "a test that fails here says where")]

use foliar_plant::sample::{Sample, odd_plants};
use foliar_plant::{Base, Leaf, Part};
use foliar_schema::Roles;
use foliar_structure::{Analysis, StructureParams, analyze};
use glam::{DAffine3, DQuat, DVec3};
use std::collections::BTreeMap;

fn find(base: &Base) -> Analysis {
    analyze(base, &Roles::default(), &StructureParams::default()).unwrap()
}

/// Odd plants with leaves whose coordinates an f32 can tell apart.
fn plants() -> impl Iterator<Item = Sample> {
    odd_plants().into_iter().filter(|s| !["nothing", "far-from-origin"].contains(&s.name))
}

/// The same part with its vertices in reverse order.
fn renumbered(part: &Part) -> Part {
    let last = part.positions.len().wrapping_sub(1) as u32;
    let mut part = part.clone();
    part.positions.reverse();
    part.normals.reverse();
    part.uvs.reverse();
    part.position_ids.reverse();
    part.triangles.iter_mut().flatten().for_each(|v| *v = last - *v);
    part
}

#[test]
fn renumbering_vertices_renumbers_leaves_and_nothing_else() {
    for sample in plants() {
        let base = sample.plant.base();
        let turned = Base { parts: base.parts.iter().map(renumbered).collect(), ..base.clone() };
        let (before, after) = (find(base).structure, find(&turned).structure);
        let (mut groups, mut ids) = (BTreeMap::new(), BTreeMap::new());
        for (old, new) in before.leaf_ids.iter().zip(&after.leaf_ids) {
            for (&old, &new) in old.iter().zip(new.iter().rev()) {
                assert_eq!(*ids.entry(old).or_insert(new), new, "{}", sample.name);
            }
        }
        for (old, new) in ids.into_iter().filter(|(old, _)| (*old as usize) < before.leaves.len()) {
            let (old, new) = (before.leaves[old as usize], after.leaves[new as usize]);
            assert_eq!(*groups.entry(old.group).or_insert(new.group), new.group, "{}", sample.name);
            if !old.crown_volume {
                assert_eq!(Leaf { group: 0, ..old }, Leaf { group: 0, ..new }, "{}", sample.name);
            }
        }
    }
}

#[test]
fn moving_and_scaling_move_and_scale_the_leaves() {
    let turn = DQuat::from_rotation_y(0.7) * DQuat::from_rotation_x(0.3);
    let (scale, shift) = (2.5, DVec3::new(3.0, -2.0, 1.0));
    let motion = DAffine3::from_scale_rotation_translation(DVec3::splat(scale), turn, shift);
    for sample in plants() {
        let mut moved = sample.plant.base().clone();
        moved.parts.iter_mut().for_each(|p| p.transform = motion * p.transform);
        let (before, after) = (find(sample.plant.base()).structure, find(&moved).structure);
        assert_eq!(before.roles, after.roles, "{}", sample.name);
        assert_eq!(before.leaf_ids, after.leaf_ids, "{}", sample.name);
        let size = 1.0 + after.leaves.iter().map(|l| f64::from(l.center.length())).fold(0.0, f64::max);
        for (old, new) in before.leaves.iter().zip(&after.leaves) {
            let center = motion.transform_point3(old.center.as_dvec3());
            assert!(center.distance(new.center.as_dvec3()) <= 1e-6 * size, "{}: {old:?} {new:?}", sample.name);
            assert!((turn * old.normal.as_dvec3()).distance(new.normal.as_dvec3()) < 1e-5, "{}", sample.name);
            let area = f64::from(old.area) * scale * scale;
            assert!((f64::from(new.area) - area).abs() <= 1e-5 * area, "{}: {old:?} {new:?}", sample.name);
            assert_eq!(old.group, new.group, "{}", sample.name);
        }
    }
}

/// Every triangle cut into four at the middles of its edges.
fn refined(part: &Part, next_id: &mut u32) -> Part {
    let mut fine = Part { triangles: Vec::new(), normals: Vec::new(), ..part.clone() };
    let mut middles: BTreeMap<(u32, u32), u32> = BTreeMap::new();
    for &[a, b, c] in &part.triangles {
        let [d, e, f] = [(a, b), (b, c), (c, a)].map(|(from, to)| {
            *middles.entry((from.min(to), from.max(to))).or_insert_with(|| {
                let at = |v: u32| fine.positions[v as usize];
                let middle = at(from).midpoint(at(to));
                fine.positions.push(middle);
                if !part.uvs.is_empty() {
                    let uv = fine.uvs[from as usize].midpoint(fine.uvs[to as usize]);
                    fine.uvs.push(uv);
                }
                fine.position_ids.push(*next_id);
                *next_id += 1;
                fine.positions.len() as u32 - 1
            })
        });
        fine.triangles.extend([[a, d, f], [d, b, e], [f, e, c], [d, e, f]]);
    }
    fine
}

#[test]
fn cutting_triangles_smaller_changes_neither_area_nor_center() {
    for sample in plants() {
        let mut fine = sample.plant.base().clone();
        let mut next_id = fine.position_count;
        fine.parts = fine.parts.iter().map(|p| refined(p, &mut next_id)).collect();
        fine.position_count = next_id;
        let (before, after) = (find(sample.plant.base()).structure, find(&fine).structure);
        assert_eq!(before.leaves.len(), after.leaves.len(), "{}", sample.name);
        let size = sample.plant.size().length();
        for (old, new) in before.leaves.iter().zip(&after.leaves).filter(|(old, _)| !old.crown_volume) {
            assert!(f64::from(old.center.distance(new.center)) <= 1e-6 * size, "{}: {old:?} {new:?}", sample.name);
            // The scan lines of a triangle's four parts lie elsewhere: the gate's 1 %.
            assert!((old.area - new.area).abs() <= 0.01 * old.area, "{}: {old:?} {new:?}", sample.name);
            assert_eq!(old.group, new.group, "{}", sample.name);
        }
    }
}

#[test]
fn the_same_base_gives_the_same_bits() {
    for sample in odd_plants() {
        let layers = [0, 1].map(|_| find(sample.plant.base()).layer.content_hash());
        assert_eq!(layers[0], layers[1], "{}", sample.name);
    }
}

#[test]
fn the_number_of_threads_changes_nothing() {
    let plant = foliar_plant::sample::Recipe::small().grow();
    let hash = |threads| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        pool.install(|| find(plant.base()).layer.content_hash())
    };
    assert_eq!(hash(1), hash(3));
}
