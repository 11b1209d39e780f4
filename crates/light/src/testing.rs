//! What tests share: the oracle's numbers, directions and depths without pattern.

use crate::model::{Optics, Sides};
use foliar_numerics::radical_inverse;
use glam::DVec3;
use serde_json::Value;

/// Reference values of an independent program; none, with a word, where they are not at hand.
pub(crate) fn oracle() -> Option<Value> {
    let root = std::env::var("FOLIAR_SHARED").unwrap_or(format!("{}/../../../shared", env!("CARGO_MANIFEST_DIR")));
    let Ok(text) = std::fs::read_to_string(format!("{root}/oracles/light.json")) else {
        eprintln!("skipped: {root}/oracles/light.json: no shared data");
        return None;
    };
    Some(serde_json::from_str(&text).unwrap())
}

pub(crate) fn list(value: &Value) -> &[Value] {
    value.as_array().unwrap()
}

pub(crate) fn number(value: &Value) -> f64 {
    value.as_f64().unwrap()
}

pub(crate) fn numbers<const N: usize>(value: &Value) -> [f64; N] {
    std::array::from_fn(|i| number(&value[i]))
}

pub(crate) fn vector(value: &Value) -> DVec3 {
    DVec3::from_array(numbers(value))
}

/// The oracle's order: reflectance front, back, transmittance front, back.
pub(crate) fn optics(value: &Value) -> Optics {
    let [rf, rb, tf, tb] = numbers(value);
    Optics::new(Sides { front: rf, back: rb }, Sides { front: tf, back: tb }).unwrap()
}

/// Unit vectors over the whole sphere, none along an axis.
pub(crate) fn directions(count: u64) -> impl Iterator<Item = DVec3> {
    (0..count).map(move |i| foliar_numerics::fibonacci_sphere(i as usize, count as usize))
}

/// Eight depths from 0 to beyond the cap, without pattern.
pub(crate) fn depths(index: u64) -> [f64; 8] {
    std::array::from_fn(|j| {
        let share = radical_inverse(8 * index + j as u64 + 1, 3);
        20.0 * share * share * share
    })
}
