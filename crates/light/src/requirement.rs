//! Whether a scene needs this room, and what it adds to the file.

use foliar_bake::{Facts, Requirement};
use foliar_schema::{Budget, Scene, Sky, Sun};
use serde_json::{Map, json};

/// Bytes of eight depths.
const DEPTHS_BYTES: u64 = 32;

/// Answers a scene: it is needed where there is a sun, or a sky that changes.
pub fn require(scene: &Scene, facts: &Facts) -> Requirement {
    let light = &scene.light;
    let none = |because: &str| Requirement::NotRequired { because: because.into() };
    if light.sun == Sun::None && light.sky == Sky::None {
        return none("sun = none and sky = none: there is no light");
    }
    if light.sun == Sun::None && light.sky == Sky::Constant {
        return none("sun = none, sky = constant: light that never changes is an ambient term's");
    }
    let bytes = exact_bytes(facts);
    let (sun, sky) = (json!(light.sun), json!(light.sky));
    let because = format!(
        "sun = {}, sky = {}, indirect = {}: {} leaves, {} wood vertices, {bytes} bytes",
        sun.as_str().unwrap_or_default(),
        sky.as_str().unwrap_or_default(),
        light.indirect,
        facts.leaves,
        facts.wood_vertices
    );
    let mut params = Map::new();
    if scene.budget.quality.total_cmp(&Budget::default().quality).is_ne() {
        params.insert("quality".into(), json!(scene.budget.quality));
    }
    Requirement::Required { params, because, bytes }
}

/// What the layer's arrays add to a file: nothing for a plant without leaves.
fn exact_bytes(facts: &Facts) -> u64 {
    if facts.leaves == 0 { 0 } else { DEPTHS_BYTES * (facts.leaves + facts.wood_vertices) as u64 }
}
