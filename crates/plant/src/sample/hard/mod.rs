//! Trees that are hard to take apart, one difficulty each, with their true hierarchy: every case in which
//! separate tubes of real files have misled a rule.

mod fused;
mod limbs;
mod skin;

use crate::Plant;
use limbs::{Limb, Start, Wood};
use skin::Skin;

/// A tree with one difficulty.
#[derive(Clone, Debug)]
pub struct HardTree {
    /// What is hard about it.
    pub name: &'static str,
    /// The plant with its true branches.
    pub plant: Plant,
}

/// Names of all hard trees, in the order of tables.
pub const HARD_TREES: [&str; 33] = [
    "clean",
    "seam",
    "seam-doubled",
    "soup",
    "soup-jittered",
    "caps-and-cones",
    "caps-apart",
    "touching",
    "gap-half",
    "gap-1",
    "gap-2",
    "gap-3",
    "dense",
    "very-dense",
    "shrub-7-stems",
    "surface-roots",
    "palm",
    "forks-unequal",
    "forks-equal",
    "crooked",
    "fat-children",
    "three-sided-twigs",
    "needles",
    "one-coincident-vertex",
    "coincident-rings",
    "coincident-rings-soup",
    "collapsed-tips",
    "tips-thicker",
    "islands",
    "two-trees",
    "two-parts",
    "vine",
    "whorls",
];

/// Names of hard trees whose wood, or some of it, is one piece.
pub const FUSED_TREES: [&str; 3] = ["fused", "fused-crooked", "fused-with-twigs"];

/// A tree of [`FUSED_TREES`]; none for an unknown name. The vertices of a fused piece belong to the limb whose bark they
/// lie nearest to.
pub fn fused_tree(name: &str, seed: u64) -> Option<HardTree> {
    let name = FUSED_TREES.into_iter().find(|known| *known == name)?;
    let plain = Wood { counts: [8, 2, 0], tip: 0.5, fat: 1.4, ..Wood::new(seed) };
    let (wood, levels) = match name {
        "fused-crooked" => (Wood { crook: 0.2, counts: [10, 2, 0], ..plain }, 3),
        "fused-with-twigs" => (Wood { counts: [8, 2, 4], ..plain }, 3),
        _ => (plain, 3),
    };
    let skin = Skin { fused: Some(skin::Fused { levels, cell: 0.02 }), ..Skin::default() };
    Some(HardTree { name, plant: skin::plant(&wood.tree(), &skin, seed) })
}

/// The hard tree of this name; none for an unknown one. `seed` chooses among its kind.
pub fn hard_tree(name: &str, seed: u64) -> Option<HardTree> {
    let name = HARD_TREES.into_iter().find(|known| *known == name)?;
    let limbs = limbs(name, seed);
    Some(HardTree { name, plant: skin::plant(&limbs, &skin(name), seed) })
}

/// A tree of the size that Kusternig07 names, or larger: about `branches` branches and eight leaves on each
/// twig, with `rings` rings of `sides` sides on each.
pub fn wood_for_speed(branches: u32, rings: u32, sides: u32) -> Plant {
    let boughs = (f64::from(branches) / 60.0).round() as u32;
    let wood = Wood { counts: [boughs, 9, 6], rings, ..Wood::new(1) };
    let skin = Skin { sides: [sides; 4], leaves_per_twig: 8, ..Skin::default() };
    skin::plant(&wood.tree(), &skin, 1)
}

fn limbs(name: &str, seed: u64) -> Vec<Limb> {
    let plain = Wood::new(seed);
    let starting = |start| Wood { start, ..plain.clone() };
    match name {
        "touching" => starting(Start::Bark(0.0)).tree(),
        "gap-half" => starting(Start::Bark(0.5)).tree(),
        "gap-1" => starting(Start::Bark(1.0)).tree(),
        "gap-2" => starting(Start::Bark(2.0)).tree(),
        "gap-3" => starting(Start::Bark(3.0)).tree(),
        "dense" => Wood { counts: [26, 11, 4], ..plain }.tree(),
        "very-dense" => Wood { counts: [30, 12, 4], ..plain }.tree(),
        "shrub-7-stems" => plain.shrub(7),
        "surface-roots" => plain.with_roots(6),
        "palm" => plain.palm(),
        "forks-unequal" => plain.forks([0.8, 0.55]),
        "forks-equal" => plain.forks([1.0, 1.0]),
        "crooked" => Wood { crook: 0.3, ..plain }.tree(),
        "fat-children" => Wood { fat: 2.2, ..plain }.tree(),
        "needles" => plain.needles(),
        "coincident-rings" | "coincident-rings-soup" => Wood { pieces: 2, ..plain }.tree(),
        "collapsed-tips" => Wood { tip: 0.0, ..plain }.tree(),
        "tips-thicker" => Wood { tip: 1.25, ..plain }.tree(),
        "islands" => plain.with_islands(5),
        "two-trees" => plain.twice(),
        "vine" => plain.vine(),
        "whorls" => Wood { whorl: 4, ..plain }.tree(),
        _ => plain.tree(),
    }
}

fn skin(name: &str) -> Skin {
    let plain = Skin::default();
    match name {
        "seam" => Skin { seam: skin::Seam::SharedIds, ..plain },
        "seam-doubled" => Skin { seam: skin::Seam::Doubled, ..plain },
        "soup" | "coincident-rings-soup" => Skin { soup: true, ..plain },
        "soup-jittered" => Skin { soup: true, jitter: 1e-5, ..plain },
        "caps-and-cones" => Skin { caps: skin::Caps::Joined, ..plain },
        "caps-apart" => Skin { caps: skin::Caps::Apart, seam: skin::Seam::Doubled, ..plain },
        "three-sided-twigs" => Skin { sides: [8, 6, 3, 3], ..plain },
        "needles" => Skin { sides: [10, 8, 3, 3], leaves_per_twig: 0, ..plain },
        "one-coincident-vertex" | "surface-roots" => Skin { shared_vertices: 3, ..plain },
        "two-parts" => Skin { parts: 2, ..plain },
        _ => plain,
    }
}
