//! What samples promise.

use super::{Recipe, odd_plants};
use crate::Plant;
use foliar_schema::Role;

fn leaf_areas(plant: &Plant) -> f64 {
    plant.leaves().iter().map(|l| f64::from(l.area)).sum()
}

#[test]
fn odd_plants_have_names_of_their_own() {
    let names: std::collections::BTreeSet<_> = odd_plants().iter().map(|s| s.name).collect();
    assert_eq!(names.len(), odd_plants().len());
    assert!(names.len() >= 16);
}

#[test]
fn odd_plants_are_as_odd_as_their_names() {
    let plants = odd_plants();
    let plant = |name: &str| &plants.iter().find(|s| s.name == name).unwrap().plant;
    assert_eq!(plant("one-leaf").leaves().len(), 1);
    assert_eq!(plant("two-coincident-leaves").leaves()[0].group, plant("two-coincident-leaves").leaves()[1].group);
    assert!(plant("wood-only").leaves().is_empty());
    assert!(plant("leaves-only").structure().roles.iter().all(|r| *r == Role::Leaf));
    assert!(plant("micrometer-tree").size().max_element() < 2e-6);
    assert!(plant("thousand-kilometer-tree").size().max_element() > 5e5);
    assert!(plant("far-from-origin").center().length() > 1e6);
    assert_eq!(plant("zero-area-piece").leaves().len(), 11);
    assert_eq!(plant("transparent-leaf").leaves()[5].area.to_bits(), 0);
}

#[test]
fn a_mirrored_plant_mirrors_the_areas_and_keeps_fronts_outward() {
    let plants = odd_plants();
    let plant = &plants.iter().find(|s| s.name == "mirrored-and-uneven").unwrap().plant;
    let trunk = &plant.parts()[0];
    let axis = trunk.transform.transform_point3(glam::DVec3::Y);
    let outward = |t: &[u32; 3]| {
        let p = t.map(|v| trunk.rest_position(v as usize));
        let up = trunk.transform.transform_vector3(glam::DVec3::Y);
        let from_axis = (p[0] + p[1] + p[2]) / 3.0 - axis;
        (p[1] - p[0]).cross(p[2] - p[0]).dot(from_axis.reject_from(up)) > 0.0
    };
    assert!(trunk.triangles.iter().all(outward));
}

#[test]
fn a_recipe_gives_exactly_its_leaves_and_the_same_bits_twice() {
    let (once, again) = (Recipe::small().grow(), Recipe::small().grow());
    assert_eq!(once.leaves().len(), 700);
    assert_eq!(once.base().parts[0].positions, again.base().parts[0].positions);
    assert_eq!(once.leaves(), again.leaves());
    assert!(leaf_areas(&once) > 0.0);
}

#[test]
fn the_benchmark_tree_has_the_size_that_gates_name() {
    let tree = Recipe { texture_px: 32, ..Recipe::bench_40k() }.grow();
    let vertices: usize = tree.parts().iter().map(|p| p.positions.len()).sum();
    assert_eq!(tree.leaves().len(), 40_000);
    assert!((215_000..235_000).contains(&vertices), "{vertices}");
    assert!((7.0..9.5).contains(&tree.size().x), "{}", tree.size());
}
