//! Branches do not depend on the order of the file, on the unit, on where the plant stands or which way it looks;
//! what cannot be told is an error, never a crash.
#![expect(clippy::unwrap_used, reason = "a test that fails here says where")]

use foliar_bake::reframe::{permuted, translated};
use foliar_plant::sample::hard_tree;
use foliar_plant::{Base, Branches, NO_BRANCH, Part, Place, Plant, Structure};
use foliar_schema::Role;
use foliar_structure::StructureError;
use foliar_structure::branches::{BranchParams, Truth, find};
use glam::{DAffine3, DQuat, DVec3, Vec3};

/// Trees with ties, with soup, with gaps, with several stems.
const TREES: [&str; 6] = ["clean", "soup", "gap-1", "palm", "whorls", "shrub-7-stems"];

fn branches(base: &Base, structure: &Structure) -> Branches {
    find(base, structure, &BranchParams::default()).unwrap().branches
}

fn found(plant: &Plant) -> Branches {
    branches(plant.base(), plant.structure())
}

/// Whether both are the same hierarchy over the same vertices (ids may differ).
fn same(name: &str, one: &Branches, other: &Branches) {
    same_tree(name, one, other, 1.0);
}

/// The same hierarchy, and at least this share of the leaves on the same branch.
fn same_tree(name: &str, one: &Branches, other: &Branches, leaves: f64) {
    let truth = Truth {
        parents: one.rows.iter().map(|r| (r.parent != NO_BRANCH).then_some(r.parent)).collect(),
        vertices: one.vertices.iter().map(|list| list.iter().map(|place| place.branch).collect()).collect(),
        leaves: one.leaves.iter().map(|place| place.branch).collect(),
    };
    let accuracy = truth.compare(other);
    assert_eq!(one.count(), other.count(), "{name}");
    let least = accuracy.parent.min(accuracy.level).min(accuracy.chain);
    assert!(least >= 1.0 && accuracy.leaf >= leaves, "{name}: {accuracy:?} {:?}", truth.wrong(other));
}

fn moved(plant: &Plant, change: DAffine3) -> (Base, Structure) {
    let (mut base, mut structure) = (plant.base().clone(), plant.structure().clone());
    base.parts.iter_mut().for_each(|part| part.transform = change * part.transform);
    for leaf in &mut structure.leaves {
        leaf.petiole = change.transform_point3(leaf.petiole.as_dvec3()).as_vec3();
    }
    (base, structure)
}

#[test]
fn the_order_of_vertices_changes_nothing() {
    for name in TREES {
        let plant = hard_tree(name, 3).unwrap().plant;
        let other = permuted(&plant).unwrap();
        let own = found(&plant);
        let renumbered = plant.clone().with_branches(own).unwrap();
        same(name, permuted(&renumbered).unwrap().branches().unwrap(), &found(&other));
    }
}

#[test]
fn the_order_of_faces_changes_nothing() {
    for name in TREES {
        let plant = hard_tree(name, 3).unwrap().plant;
        let mut base = plant.base().clone();
        base.parts.iter_mut().for_each(|part| part.triangles.reverse());
        same(name, &found(&plant), &branches(&base, plant.structure()));
    }
}

#[test]
fn unit_place_and_bearing_change_nothing() {
    for name in TREES {
        let plant = hard_tree(name, 3).unwrap().plant;
        let own = found(&plant);
        for scale in [1e-6, 1e6] {
            let (base, structure) = moved(&plant, DAffine3::from_scale(DVec3::splat(scale)));
            same(name, &own, &branches(&base, &structure));
        }
        let (base, structure) = moved(&plant, DAffine3::from_quat(DQuat::from_rotation_y(1.234)));
        same(name, &own, &branches(&base, &structure));
        same(name, &own, &found(&translated(&plant).unwrap()));
    }
}

#[test]
fn the_same_bits_for_any_number_of_threads() {
    let plant = hard_tree("dense", 1).unwrap().plant;
    let pool = |threads| rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
    let one = pool(1).install(|| found(&plant));
    assert_eq!(one, pool(4).install(|| found(&plant)));
}

/// The plant with its coordinates themselves moved, as a file far from its origin has them.
fn far(plant: &Plant, offset: f32) -> Base {
    let mut base = plant.base().clone();
    base.parts.iter_mut().for_each(|part| part.positions.iter_mut().for_each(|p| p.x += offset));
    base
}

#[test]
fn coordinates_a_little_far_are_fine_and_hopelessly_far_are_refused_by_name() {
    let plant = hard_tree("caps-and-cones", 1).unwrap().plant;
    // Some 14 m across: steps of 2^-23 * 1000 m are 1e-5 of that.
    let near = branches(&far(&plant, 1e3), plant.structure());
    assert_eq!(near.count(), plant.branches().unwrap().count());
    let error = find(&far(&plant, 1e6), plant.structure(), &BranchParams::default()).unwrap_err();
    assert!(matches!(error, StructureError::Coarse { .. }) && error.to_string().contains("\"bark\""), "{error}");
}

fn wood(positions: Vec<Vec3>, triangles: Vec<[u32; 3]>) -> (Base, Structure) {
    let position_ids: Vec<u32> = (0..positions.len() as u32).collect();
    let position_count = position_ids.len() as u32;
    let part = Part { place: Place::default(), positions, triangles, position_ids, ..Part::default() };
    let structure = Structure { roles: vec![Role::Wood], leaf_ids: vec![Vec::new()], ..Structure::default() };
    (Base { parts: vec![part], position_count, ..Base::default() }, structure)
}

#[test]
fn nothing_points_needles_and_flat_wood_give_branches_or_none() {
    let needle = vec![Vec3::ZERO, Vec3::Y, Vec3::Y * 2.0];
    for (name, positions, triangles, count) in [
        ("nothing", Vec::new(), Vec::new(), 0),
        ("a vertex", vec![Vec3::ONE], Vec::new(), 0),
        ("a point", vec![Vec3::ONE], vec![[0, 0, 0]], 1),
        ("three points at one place", vec![Vec3::ONE; 3], vec![[0, 1, 2]], 1),
        ("a line", needle, vec![[0, 1, 2]], 1),
        ("a triangle", vec![Vec3::ZERO, Vec3::X, Vec3::Y], vec![[0, 1, 2]], 1),
        ("two faces back to back", vec![Vec3::ZERO, Vec3::X, Vec3::Y], vec![[0, 1, 2], [0, 2, 1]], 1),
    ] {
        let (base, structure) = wood(positions, triangles);
        let branches = branches(&base, &structure);
        assert_eq!(branches.count(), count, "{name}");
        Plant::new(base, structure).unwrap().with_branches(branches).unwrap();
    }
}

#[test]
fn no_number_in_a_position_is_an_error_that_names_it() {
    let (base, structure) = wood(vec![Vec3::ZERO, Vec3::X, Vec3::NAN], vec![[0, 1, 2]]);
    let error = find(&base, &structure, &BranchParams::default()).unwrap_err();
    assert!(error.to_string().contains("vertex 2"), "{error}");
}

/// A tube of three sides.
fn tube((positions, triangles): &mut (Vec<Vec3>, Vec<[u32; 3]>), from: Vec3, to: Vec3, radius: f32) {
    let first = positions.len() as u32;
    let side = (to - from).any_orthonormal_vector() * radius;
    let other = (to - from).normalize().cross(side);
    for end in [from, to] {
        positions.extend([end + side, end - 0.5 * side + 0.866 * other, end - 0.5 * side - 0.866 * other]);
    }
    for k in 0..3 {
        let (a, b) = (first + k, first + (k + 1) % 3);
        triangles.extend([[a, b, b + 3], [a, b + 3, a + 3]]);
    }
}

/// A level direction.
fn around(turn: f64) -> Vec3 {
    DVec3::new(libm::cos(turn), 0.0, libm::sin(turn)).as_vec3()
}

#[test]
fn more_branches_than_sixteen_bits_count() {
    // A trunk and 70,000 separate spurs along it.
    let mut made = (Vec::new(), Vec::new());
    tube(&mut made, Vec3::ZERO, Vec3::Y * 70.0, 0.5);
    for spur in 0..70_000 {
        let root = Vec3::Y * (0.001 * spur as f32);
        tube(&mut made, root, root + around(2.4 * f64::from(spur)), 0.0002);
    }
    let (base, structure) = wood(made.0, made.1);
    let branches = branches(&base, &structure);
    assert_eq!(branches.count(), 70_001);
    assert!(branches.rows[1..].iter().all(|row| row.parent == 0));
}

#[test]
fn a_trunk_thinner_than_its_boughs_is_the_trunk_all_the_same() {
    let mut made = (Vec::new(), Vec::new());
    tube(&mut made, Vec3::ZERO, Vec3::Y * 10.0, 0.05);
    for bough in 0..6 {
        let root = Vec3::Y * (4.0 + bough as f32);
        tube(&mut made, root, root + 2.0 * around(2.4 * f64::from(bough)), 0.07);
    }
    let (base, structure) = wood(made.0, made.1);
    let branches = branches(&base, &structure);
    assert_eq!(branches.count(), 7);
    assert!(branches.rows[0].length > 9.9 && branches.rows[1..].iter().all(|row| row.parent == 0));
}

#[test]
fn as_far_as_coordinates_tell_tubes_nothing_changes() {
    for name in ["clean", "palm", "shrub-7-stems"] {
        let plant = hard_tree(name, 3).unwrap().plant;
        // A quarter of what is refused: steps of 7.5e-5 of the wood's diagonal.
        let diagonal = plant.size().length() as f32;
        let offset = 7.5e-5 * diagonal / f32::EPSILON;
        let mut structure = plant.structure().clone();
        structure.leaves.iter_mut().for_each(|leaf| leaf.petiole.x += offset);
        // Rounding moves petioles by so much: one that stands midway between two fronds tips to the other. What
        // leaves have to reach against the truth (0.98) is asked of them here.
        same_tree(name, &found(&plant), &branches(&far(&plant, offset), &structure), 0.98);
    }
}
