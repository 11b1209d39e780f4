//! Wood in one piece: told by itself, taken apart by the shape of its surface, with thresholds of its own.
#![expect(clippy::unwrap_used, reason = "a test that fails here says where")]

use foliar_plant::Plant;
use foliar_plant::sample::{FUSED_TREES, fused_tree, hard_tree};
use foliar_structure::branches::{Accuracy, BranchParams, Found, Method, RootKind, Truth, find, findings};

fn found(plant: &Plant, method: Method) -> (Found, Accuracy) {
    let found = find(plant.base(), plant.structure(), &BranchParams { method, ..BranchParams::default() }).unwrap();
    let accuracy = Truth::of_sample(plant.branches().unwrap()).compare(&found.branches);
    plant.clone().with_branches(found.branches.clone()).unwrap();
    (found, accuracy)
}

#[test]
fn wood_in_one_piece_is_taken_apart_and_says_so() {
    for name in FUSED_TREES {
        let plant = fused_tree(name, 1).unwrap().plant;
        let truth = plant.branches().unwrap();
        let (own, accuracy) = found(&plant, Method::Robust);
        // Measured on prototypes: .79 to .96 of parents, .91 of vertices (wind.md 2.4). What `cargo xtask accuracy` asks.
        assert!(accuracy.parent >= 0.95 && accuracy.purity >= 0.97, "{name}: {accuracy:?}");
        assert!(accuracy.leaf >= 0.95, "{name}: {accuracy:?}");
        // The trunk is the stem, of its own length and radius, nearly: rings are open where boughs come out.
        let stem = (0..own.reports.len()).find(|&b| own.reports[b].kind == RootKind::Stem).unwrap();
        let (row, right) = (&own.branches.rows[stem], &truth.rows[0]);
        assert!((row.length / right.length - 1.0).abs() < 0.15, "{name}: {} of {} m", row.length, right.length);
        assert!((row.radius / right.radius - 1.0).abs() < 0.15, "{name}: {} of {} m", row.radius, right.radius);
        // Said of the piece, not of each branch of it.
        let said = findings(&own, plant.base());
        let fused = said.iter().find(|finding| finding.code == "BRANCH-FUSED").unwrap();
        assert!(fused.message.contains(&format!("branch {stem} of \"bark\"")), "{}", fused.message);
    }
}

#[test]
fn the_papers_own_words_and_no_others_leave_a_fused_trunk_whole() {
    let plant = fused_tree("fused", 1).unwrap().plant;
    let (whole, accuracy) = found(&plant, Method::Kusternig07);
    assert!(accuracy.parent < 0.1 && whole.branches.count() < 12, "{accuracy:?}");
}

#[test]
fn tubes_are_the_same_whether_forks_are_looked_for_or_not() {
    for name in ["clean", "crooked", "needles", "caps-and-cones", "forks-equal"] {
        let plant = hard_tree(name, 1).unwrap().plant;
        let (robust, fused) = (found(&plant, Method::Robust), found(&plant, Method::Fused));
        assert_eq!(robust.0.branches.count(), fused.0.branches.count(), "{name}");
        assert!(fused.1.parent >= robust.1.parent, "{name}: {:?}", fused.1);
        assert!(findings(&robust.0, plant.base()).iter().all(|finding| finding.code != "BRANCH-FUSED"), "{name}");
    }
}

#[test]
fn threads_change_nothing_in_fused_wood() {
    let plant = fused_tree("fused-with-twigs", 2).unwrap().plant;
    let pool = |threads| rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
    let of = |threads| pool(threads).install(|| found(&plant, Method::Robust).0.branches);
    assert_eq!(of(1), of(3));
}
