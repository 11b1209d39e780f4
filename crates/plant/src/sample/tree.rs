//! Whole trees by recipe.

use super::build::Build;
use super::{foliage, skeleton, textures, tubes};
use crate::Plant;
use foliar_schema::Role;
use glam::DAffine3;

/// How a tree is made. Two equal recipes give the same bits on every machine.
#[derive(Clone, Debug, PartialEq)]
pub struct Recipe {
    /// Number of leaves: exactly so many pieces and rows.
    pub leaves: u32,
    /// Chooses the tree among its kind.
    pub seed: u64,
    /// Height, meters.
    pub height_m: f64,
    /// Greatest width of the crown, meters.
    pub crown_width_m: f64,
    /// Leaves per point that the branches grow toward: more gives less wood.
    pub leaves_per_branchlet: f64,
    /// Twigs that carry at most so many nodes bear leaves.
    pub bearing_load: f64,
    /// Length of a leaf card, meters.
    pub leaf_size_m: f64,
    /// Quads along a leaf card: 1 is flat, more bend.
    pub leaf_rows: u32,
    /// Sides of the trunk's tube; branches have fewer.
    pub trunk_sides: u32,
    /// Edge of the textures, pixels; 0 makes none.
    pub texture_px: u32,
}

impl Recipe {
    /// The tree that ships in fixtures/: a young linden, 4,800 sprays of leaves, textured.
    pub fn linden() -> Self {
        Recipe {
            leaves: 4800,
            seed: 7,
            height_m: 6.4,
            crown_width_m: 4.6,
            leaves_per_branchlet: 3.4,
            bearing_load: 14.0,
            leaf_size_m: 0.26,
            leaf_rows: 2,
            trunk_sides: 18,
            texture_px: 1024,
        }
    }

    /// 700 leaves: a sapling for tests.
    pub fn small() -> Self {
        Recipe { leaves: 700, height_m: 3.0, crown_width_m: 1.8, leaf_rows: 1, texture_px: 128, ..Recipe::linden() }
    }

    /// 40,000 flat leaves and about 225,000 vertices, 8 m wide: what benchmarks measure.
    pub fn bench_40k() -> Self {
        Recipe {
            leaves: 40_000,
            seed: 3,
            height_m: 10.0,
            crown_width_m: 8.0,
            leaves_per_branchlet: 4.7,
            leaf_size_m: 0.14,
            leaf_rows: 1,
            texture_px: 256,
            ..Recipe::linden()
        }
    }

    /// 200,000 flat leaves, 12 m wide.
    pub fn bench_200k() -> Self {
        Recipe { leaves: 200_000, height_m: 15.0, crown_width_m: 12.0, leaf_size_m: 0.09, ..Recipe::bench_40k() }
    }

    /// The same leaves on less wood: 921,004 vertices.
    pub fn bench_200k_leafy() -> Self {
        Recipe { leaves_per_branchlet: 12.0, ..Recipe::bench_200k() }
    }

    /// A million flat leaves, 20 m wide: 4,169,743 vertices.
    pub fn bench_1m() -> Self {
        Recipe {
            leaves: 1_000_000,
            height_m: 25.0,
            crown_width_m: 20.0,
            leaf_size_m: 0.06,
            leaves_per_branchlet: 40.0,
            ..Recipe::bench_40k()
        }
    }

    /// Five million flat leaves, 34 m wide: more than 20 million vertices.
    pub fn bench_5m() -> Self {
        Recipe { leaves: 5_000_000, height_m: 43.0, crown_width_m: 34.0, ..Recipe::bench_1m() }
    }

    /// Grows the tree: wood first, leaves second, each one part.
    pub fn grow(&self) -> Plant {
        let skeleton = skeleton::grow(self);
        let mut build = Build::default();
        let textured = self.texture_px > 0;
        let bark = build.material("bark", textured.then(|| textures::bark(self.texture_px / 2, self.seed)));
        let picture = textured.then(|| textures::sprays(self.texture_px, self.seed));
        let coverage = picture.as_ref().map_or(vec![1.0], textures::coverage);
        let leaf = build.material("leaf", picture);
        let wood = build.part("wood", Role::Wood, bark, DAffine3::IDENTITY);
        for (chain, parent) in skeleton.chains.iter().zip(skeleton.parents()) {
            let (piece, rings, axis) = tubes::tube(&skeleton, chain, self);
            build.branch(wood, &piece, &rings, &axis, parent);
        }
        let foliage = build.part("leaves", Role::Leaf, leaf, DAffine3::IDENTITY);
        for (piece, truth) in foliage::leaves(&skeleton, self, &coverage) {
            build.leaf(foliage, &piece, &truth);
        }
        build.finish()
    }

    /// Height at which the crown begins, meters.
    pub(super) fn crown_base_m(&self) -> f64 {
        0.17 * self.height_m
    }

    pub(super) fn trunk_radius_m(&self) -> f64 {
        0.021 * self.height_m
    }

    pub(super) fn twig_radius_m(&self) -> f64 {
        (0.0022 * self.height_m.sqrt()).min(0.2 * self.trunk_radius_m())
    }

    pub(super) fn attractors(&self) -> usize {
        (f64::from(self.leaves) / self.leaves_per_branchlet).ceil().max(8.0) as usize
    }

    /// Length of a segment: the points' spacing, so that a branch reaches each on its own.
    pub(super) fn step_m(&self) -> f64 {
        let volume = 0.5 * self.crown_width_m * self.crown_width_m * (self.height_m - self.crown_base_m());
        0.5 * libm::cbrt(volume / self.attractors() as f64)
    }

    pub(super) fn most_nodes(&self) -> usize {
        8 * self.attractors() + 1000
    }
}
