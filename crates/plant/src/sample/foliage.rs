//! Leaf cards along the twigs: golden-angle phyllotaxis, turned to the light, drooping a little.

use super::build::{LeafTruth, Piece};
use super::noise::{hash, mix, signed, unit};
use super::skeleton::Skeleton;
use super::textures::ATLAS;
use super::tree::Recipe;
use crate::OnBranch;
use glam::{DVec3, Vec2};

/// Every leaf of a tree, in the order of its twigs.
pub fn leaves(skeleton: &Skeleton, recipe: &Recipe, coverage: &[f64]) -> Vec<(Piece, LeafTruth)> {
    let runs = twigs(skeleton, recipe);
    let total: f64 = runs.iter().map(|run| run.from.distance(run.to)).sum();
    let spacing = total / f64::from(recipe.leaves);
    let mut leaves = Vec::with_capacity(recipe.leaves as usize);
    let mut ahead = 0.5 * spacing;
    for Run { from, to, branch, arc } in runs {
        let length = from.distance(to);
        while ahead < length && leaves.len() < recipe.leaves as usize {
            let on = OnBranch { branch, arc: (arc + ahead) as f32 };
            let site = Site { place: from.lerp(to, ahead / length), along: (to - from) / length, on };
            leaves.push(leaf(&site, leaves.len() as u64, recipe, coverage));
            ahead += spacing;
        }
        ahead -= length;
    }
    // Rounding may leave the last leaf just past the last tip.
    while let (true, Some(last)) = (leaves.len() < recipe.leaves as usize, leaves.last().cloned()) {
        leaves.push(last);
    }
    leaves
}

struct Site {
    place: DVec3,
    along: DVec3,
    on: OnBranch,
}

/// A segment of a branch that bears leaves.
struct Run {
    from: DVec3,
    to: DVec3,
    branch: u32,
    /// Arc length at which it starts.
    arc: f64,
}

/// Segments that bear leaves: those that carry little.
fn twigs(skeleton: &Skeleton, recipe: &Recipe) -> Vec<Run> {
    let nodes = &skeleton.nodes;
    let mut runs = Vec::new();
    for (branch, chain) in skeleton.chains.iter().enumerate() {
        let mut arc = 0.0;
        for pair in chain.nodes.windows(2) {
            let (from, to) = (nodes[pair[0]].position, nodes[pair[1]].position);
            if nodes[pair[1]].load <= recipe.bearing_load && from != to {
                runs.push(Run { from, to, branch: branch as u32, arc });
            }
            arc += from.distance(to);
        }
    }
    runs
}

fn leaf(site: &Site, index: u64, recipe: &Recipe, coverage: &[f64]) -> (Piece, LeafTruth) {
    const GOLDEN_ANGLE: f64 = 2.399_963_229_728_653;
    let seed = recipe.seed + 101;
    let chance = |k: u64| signed(seed, 8 * index + k);
    let normal = site.along.any_orthonormal_vector();
    let turn = GOLDEN_ANGLE * index as f64;
    let radial = normal * libm::cos(turn) + site.along.cross(normal) * libm::sin(turn);
    let middle = DVec3::Y * mix(recipe.crown_base_m(), recipe.height_m, 0.35);
    let outward = (site.place - middle).normalize_or(DVec3::Y);
    let along = (0.5 * site.along + 0.75 * radial + 0.35 * outward - 0.12 * DVec3::Y).normalize_or(outward);
    let light = 0.8 * DVec3::Y + 0.5 * outward + 0.45 * DVec3::new(chance(0), chance(1), chance(2));
    let face = (light - along * along.dot(light)).normalize_or(along.any_orthonormal_vector());
    let size = recipe.leaf_size_m * mix(0.75, 1.2, unit(seed, 8 * index + 4));
    let variant = (hash(seed, 8 * index + 5) % coverage.len() as u64) as usize;
    let petiole = site.place - along * (0.04 * size);
    let piece = card(petiole, [along, face], size, &Look { variant, rows: recipe.leaf_rows, droop: 0.35 });
    let truth = LeafTruth { coverage: coverage[variant], petiole: petiole.as_vec3(), group: None, on: site.on };
    (piece, truth)
}

struct Look {
    variant: usize,
    rows: u32,
    /// Radians by which each row bends down from the one before.
    droop: f64,
}

/// A card of equal rows, each bent down from the one before; front toward `face`.
fn card(petiole: DVec3, [along, face]: [DVec3; 2], size: f64, look: &Look) -> Piece {
    let across = along.cross(face) * (size / 2.0);
    let (column, line) = (look.variant as u32 % ATLAS, look.variant as u32 / ATLAS);
    let corner = Vec2::new(column as f32, line as f32) / ATLAS as f32;
    let mut piece = Piece::default();
    let mut middle = petiole;
    for row in 0..=look.rows {
        if row > 0 {
            let bend = look.droop * (f64::from(row) - 0.5 * f64::from(look.rows + 1));
            middle += (along * libm::cos(bend) - face * libm::sin(bend)) * (size / f64::from(look.rows));
            let first = 2 * row - 2;
            piece.triangles.extend([[first, first + 1, first + 3], [first, first + 3, first + 2]]);
        }
        piece.positions.extend([(middle - across).as_vec3(), (middle + across).as_vec3()]);
        let v = 1.0 - row as f32 / look.rows as f32;
        piece.uvs.extend([0.0, 1.0].map(|u| corner + Vec2::new(u, v) / ATLAS as f32));
    }
    piece
}
