//! Whether a scene needs this room, and how many levels: a level whose largest displacement stays under half a
//! pixel is not baked.

use crate::Params;
use foliar_bake::{Facts, Requirement, pixel_m};
use foliar_plant::LEVELS;
use foliar_schema::{Scene, Strength};
use serde_json::{Map, json};

/// Bytes of the weights of a vertex, of a leaf's own, of a branch's phase and frame.
const WEIGHTS_BYTES: u64 = 16;
const LEAF_BYTES: u64 = 4;
const BRANCH_BYTES: u64 = 24;

/// Answers a scene.
pub fn require(scene: &Scene, facts: &Facts) -> Requirement {
    let share = amplitude(scene.wind.strength);
    if share <= 0.0 {
        return Requirement::NotRequired { because: "wind.strength = none".into() };
    }
    let half_pixel = 0.5 * pixel_m(&scene.camera);
    let Some(branches) = &facts.branches else {
        return required(
            LEVELS,
            format!("the tip of the longest branch moves {:.0} % of its length", 100.0 * share),
            facts,
        );
    };
    let seen = |level: &usize| share * branches.longest_m[*level] > half_pixel;
    // Levels below one that is seen move with it: what counts is the last that is.
    let levels = (0..LEVELS).rfind(seen).map_or(0, |level| level + 1);
    let moves: Vec<String> = branches.longest_m.iter().map(|l| format!("{:.3}", 1e3 * share * l)).collect();
    let why = format!("levels move up to {} mm, half a pixel is {:.3} mm", moves.join(" / "), 1e3 * half_pixel);
    match levels {
        0 if branches.count > 0 => Requirement::NotRequired { because: why },
        0 => required(LEVELS, "leaves move, though there is no wood".into(), facts),
        levels => required(levels, why, facts),
    }
}

fn required(levels: usize, why: String, facts: &Facts) -> Requirement {
    let mut params = Map::new();
    if levels as u32 != Params::default().levels {
        params.insert("levels".into(), json!(levels));
    }
    let bytes = bytes(facts);
    Requirement::Required { params, because: format!("{why}: {levels} levels, {bytes} bytes"), bytes }
}

/// What the layer's arrays add to a file.
fn bytes(facts: &Facts) -> u64 {
    let count = facts.branches.as_ref().map_or(0, |branches| branches.count as u64);
    let (leaf, wood) = (facts.leaf_vertices as u64, facts.wood_vertices as u64);
    // Before branches are known, wood is taken to have some.
    let sways = facts.branches.as_ref().map_or(wood > 0, |branches| branches.count > 0);
    WEIGHTS_BYTES * (leaf + wood) * u64::from(sways) + LEAF_BYTES * leaf + BRANCH_BYTES * count
}

/// Displacement of the tip of the longest branch, as a share of its length.
pub fn amplitude(strength: Strength) -> f64 {
    match strength {
        Strength::None => 0.0,
        Strength::Breeze => 0.02,
        Strength::Strong => 0.07,
        Strength::Storm => 0.15,
    }
}
