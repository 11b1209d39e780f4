//! Whether a scene needs this room, and which of its channels.

use crate::params::{AmbientTerm, Channels};
use foliar_bake::{Facts, Requirement};
use foliar_schema::{Ambient, Budget, Scene, Sky};
use serde_json::{Map, Value, json};

/// Bytes of one `_AMBIENT` value.
const AMBIENT_BYTES: u64 = 4;
/// Bytes of one `_SOFT_NORMAL` value.
const NORMAL_BYTES: u64 = 12;

/// Answers a scene: an ambient term where the scene wants this room's, normals where it wants soft ones.
pub fn require(scene: &Scene, facts: &Facts) -> Requirement {
    let light = &scene.light;
    let (ambient, why_ambient) = match light.ambient {
        Ambient::None => (false, "ambient = none".to_string()),
        Ambient::Traced => (false, "ambient = traced asks for another room's term".to_string()),
        Ambient::Density => {
            (true, format!("ambient = density asks for this room's term, {} unless said otherwise", term()))
        }
        Ambient::Auto if light.sky == Sky::None => (false, "sky = none leaves nothing to attenuate".to_string()),
        Ambient::Auto => (true, format!("ambient = auto takes the cheapest term there is, here {}", term())),
    };
    let normals = light.soft_normals;
    let why_normals = format!("soft_normals = {normals}");
    if !(ambient || normals) {
        return Requirement::NotRequired { because: format!("{why_ambient}, {why_normals}") };
    }
    let bytes = exact_bytes(facts, ambient, normals);
    let because = format!(
        "{why_ambient}, {why_normals}: {} leaf vertices, {} wood vertices, {bytes} bytes",
        facts.leaf_vertices, facts.wood_vertices
    );
    Requirement::Required { params: implied(scene, ambient, normals), because, bytes }
}

/// The ambient term of the defaults, in words.
fn term() -> &'static str {
    match AmbientTerm::default() {
        AmbientTerm::Luft => "k_a of the local density",
        AmbientTerm::Sky => "transmittance to the sky",
    }
}

/// What the layer's arrays add to a file: nothing for a plant without leaves.
fn exact_bytes(facts: &Facts, ambient: bool, normals: bool) -> u64 {
    if facts.leaves == 0 {
        return 0;
    }
    let (leaf, wood) = (facts.leaf_vertices as u64, facts.wood_vertices as u64);
    AMBIENT_BYTES * (leaf + wood) * u64::from(ambient) + NORMAL_BYTES * leaf * u64::from(normals)
}

fn implied(scene: &Scene, ambient: bool, normals: bool) -> Map<String, Value> {
    let channels = match (ambient, normals) {
        (true, false) => Channels::Ambient,
        (false, true) => Channels::Normals,
        _ => Channels::Both,
    };
    let mut params = Map::new();
    if channels != Channels::default() {
        params.insert("channels".into(), json!(channels));
    }
    if scene.budget.quality.total_cmp(&Budget::default().quality).is_ne() {
        params.insert("quality".into(), json!(scene.budget.quality));
    }
    params
}
