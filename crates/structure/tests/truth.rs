//! Plants made by rule know their structure: what is found is held against it.
#![expect(clippy::unwrap_used, reason = "a test that fails here says where")]

use foliar_plant::sample::{Recipe, odd_plants};
use foliar_plant::{Leaf, NO_LEAF, Plant};
use foliar_schema::Roles;
use foliar_structure::{Analysis, StructureParams, analyze, from_layer};
use std::collections::BTreeMap;

fn find(plant: &Plant) -> Analysis {
    analyze(plant.base(), &Roles::default(), &StructureParams::default()).unwrap()
}

/// Leaves that lie on one another in the truth: a sample gives each of them the whole area.
fn sheets_at(leaves: &[Leaf], leaf: &Leaf) -> f64 {
    let on = |other: &&Leaf| {
        other.group == leaf.group && other.center == leaf.center && other.normal.dot(leaf.normal).abs() > 0.99
    };
    leaves.iter().filter(on).count() as f64
}

fn check_leaves(name: &str, plant: &Plant) {
    let analysis = find(plant);
    let (truth, found) = (plant.leaves(), &analysis.structure.leaves);
    assert_eq!(analysis.structure.roles, plant.structure().roles, "{name}: {:?}", analysis.parts);
    if truth.iter().any(|leaf| leaf.crown_volume) {
        return;
    }
    assert_eq!(found.len(), truth.len(), "{name}");
    let size = f64::from(truth.iter().map(|l| l.center.abs().max_element()).fold(0.0, f32::max));
    let mut groups = BTreeMap::new();
    for (leaf, right) in found.iter().zip(truth) {
        // A few roundings of an f32 coordinate.
        let off = f64::from((leaf.center - right.center).abs().max_element());
        assert!(off <= 4.0 * f64::from(f32::EPSILON) * size, "{name}: {leaf:?} {right:?}");
        assert!(leaf.normal.dot(right.normal) > 0.999_99, "{name}: {leaf:?} {right:?}");
        let area = f64::from(right.area) / sheets_at(truth, right);
        // The gate: 1 % of the analytic coverage.
        assert!((f64::from(leaf.area) - area).abs() <= 0.01 * area, "{name}: {leaf:?} {right:?}");
        assert_eq!(*groups.entry(right.group).or_insert(leaf.group), leaf.group, "{name}: one group torn");
    }
    let mut found_groups: Vec<u32> = groups.values().copied().collect();
    found_groups.sort_unstable();
    found_groups.dedup();
    assert_eq!(found_groups.len(), groups.len(), "{name}: two groups fused");
}

#[test]
fn roles_leaves_groups_and_areas_of_odd_plants_are_found() {
    for sample in odd_plants() {
        check_leaves(sample.name, &sample.plant);
    }
}

#[test]
fn vertices_belong_to_the_leaves_that_they_were_made_for() {
    for sample in odd_plants().iter().filter(|s| s.name != "crown-volume") {
        let found = find(&sample.plant).structure;
        for (part, ids) in found.leaf_ids.iter().enumerate() {
            for (vertex, &id) in ids.iter().enumerate() {
                let id = (id != NO_LEAF).then_some(id);
                assert_eq!(id, sample.plant.leaf_of(part, vertex), "{}: part {part}, vertex {vertex}", sample.name);
            }
        }
    }
}

#[test]
fn petioles_of_a_tree_lie_where_its_leaves_were_hung() {
    let plant = Recipe::small().grow();
    let found = find(&plant).structure;
    let size = Recipe::small().leaf_size_m;
    let near = |(leaf, right): (&Leaf, &Leaf)| f64::from(leaf.petiole.distance(right.petiole)) <= size / 4.0;
    let right = found.leaves.iter().zip(plant.leaves()).filter(|pair| near(*pair)).count();
    // A leaf may hang nearer to another twig than to its own; that is rare.
    assert!(right * 100 >= 95 * found.leaves.len(), "{right} of {}", found.leaves.len());
}

#[test]
fn a_ball_over_a_trunk_is_a_crown_of_virtual_leaves() {
    let samples = odd_plants();
    let plant = &samples.iter().find(|s| s.name == "crown-volume").unwrap().plant;
    let analysis = find(plant);
    let leaves = &analysis.structure.leaves;
    assert_eq!(leaves.len(), 1000);
    assert!(analysis.parts[1].crown_volume && leaves.iter().all(|leaf| leaf.crown_volume));
    let sum = |leaves: &[Leaf]| leaves.iter().map(|l| f64::from(l.area)).sum::<f64>();
    // Sums of a thousand f32.
    assert!((sum(leaves) / sum(plant.leaves()) - 1.0).abs() < 1e-4);
    for leaf in leaves {
        let out = (leaf.center.as_dvec3() - glam::DVec3::Y * 3.0) / 1.2;
        // A ball of 24 by 12 faces: they lie up to 1 - cos(pi / 12) below it and lean as much.
        assert!((0.95..=1.000_001).contains(&out.length()), "{leaf:?}");
        assert!(leaf.normal.as_dvec3().dot(out.normalize()) > 0.96, "{leaf:?}");
    }
    let upper = leaves.iter().filter(|l| l.center.y > 3.0).count();
    // A low-discrepancy set: a few of 1000, not the 16 of a random one.
    assert!(upper.abs_diff(500) <= 12, "{upper}");
}

#[test]
fn vertices_of_a_crown_take_the_nearest_virtual_leaf() {
    let samples = odd_plants();
    let plant = &samples.iter().find(|s| s.name == "crown-volume").unwrap().plant;
    let found = find(plant).structure;
    for (vertex, &id) in found.leaf_ids[1].iter().enumerate() {
        let place = plant.parts()[1].rest_position(vertex);
        let to = |leaf: &Leaf| leaf.center.as_dvec3().distance(place);
        let least = found.leaves.iter().map(to).fold(f64::INFINITY, f64::min);
        assert!(to(&found.leaves[id as usize]) <= least * (1.0 + 1e-5), "vertex {vertex}");
    }
}

#[test]
fn layers_of_odd_plants_give_their_structure_back() {
    for sample in odd_plants() {
        let analysis = find(&sample.plant);
        let back = from_layer(&analysis.layer, sample.plant.base()).unwrap();
        assert_eq!(back.leaves, analysis.structure.leaves, "{}", sample.name);
        assert_eq!(back.leaf_ids, analysis.structure.leaf_ids, "{}", sample.name);
        Plant::new(sample.plant.base().clone(), back).unwrap();
    }
}
