//! Texture coordinates as the base color texture sees them: its set, and KHR_texture_transform.

use glam::{DMat2, DVec2, Vec2};
use serde_json::Value;

const TRANSFORM: &str = "KHR_texture_transform";

/// Name of the attribute that a texture reads; the first set where there is no texture.
pub(crate) fn set_name(info: Option<&Value>) -> String {
    let own = info.and_then(|i| i.get("texCoord"));
    let set = info.and_then(extension).and_then(|t| t.get("texCoord")).or(own);
    format!("TEXCOORD_{}", set.and_then(Value::as_u64).unwrap_or(0))
}

fn extension(info: &Value) -> Option<&Value> {
    info.get("extensions").and_then(|e| e.get(TRANSFORM))
}

/// Applies offset, rotation and scale. The rotation is counter-clockwise as one sees it, with v down.
pub(crate) fn transform(info: Option<&Value>, uvs: &mut [Vec2]) {
    let Some(values) = info.and_then(extension) else { return };
    let pair = |key: &str, default: f64| {
        let list = values.get(key).and_then(Value::as_array);
        let at = |i: usize| list.and_then(|l| l.get(i)).and_then(Value::as_f64).unwrap_or(default);
        DVec2::new(at(0), at(1))
    };
    let (offset, scale) = (pair("offset", 0.0), pair("scale", 1.0));
    let angle = values.get("rotation").and_then(Value::as_f64).unwrap_or(0.0);
    let (sin, cos) = (libm::sin(angle), libm::cos(angle));
    let rotation = DMat2::from_cols(DVec2::new(cos, -sin), DVec2::new(sin, cos));
    for uv in uvs {
        *uv = (offset + rotation * (scale * uv.as_dvec2())).as_vec2();
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use serde_json::json;

    #[test]
    fn a_quarter_turn_takes_right_to_up_with_v_down() {
        let info = json!({"extensions": {TRANSFORM: {"rotation": std::f64::consts::FRAC_PI_2, "scale": [2.0, 3.0], "offset": [0.5, 0.25]}}});
        let mut uvs = [Vec2::new(1.0, 0.0), Vec2::new(0.0, 1.0)];
        transform(Some(&info), &mut uvs);
        // R (2, 0) = (0, -2); R (0, 3) = (3, 0); then the offset. The f32 results are exact to rounding of pi/2.
        let close = |a: Vec2, b: Vec2| (a - b).abs().max_element() < 1e-6;
        assert!(close(uvs[0], Vec2::new(0.5, -1.75)), "{}", uvs[0]);
        assert!(close(uvs[1], Vec2::new(3.5, 0.25)), "{}", uvs[1]);
    }

    #[test]
    fn the_extension_overrides_the_set() {
        assert_eq!(set_name(None), "TEXCOORD_0");
        assert_eq!(set_name(Some(&json!({"texCoord": 1}))), "TEXCOORD_1");
        assert_eq!(set_name(Some(&json!({"texCoord": 1, "extensions": {TRANSFORM: {"texCoord": 2}}}))), "TEXCOORD_2");
    }
}
