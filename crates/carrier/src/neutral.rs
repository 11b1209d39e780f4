//! Neutral values: what a vertex carries of a channel that does not apply to it.

use crate::CarrierError;
use crate::accessor::Source;
use crate::document::index_of;
use foliar_schema::{Channel, Neutral};
use glam::{DVec3, Vec3};
use serde_json::Value;

/// Neutral values of `channel` for all `count` vertices of a primitive.
pub(crate) fn fill(
    source: Source,
    primitive: &Value,
    channel: &Channel,
    count: usize,
    null_id: f32,
) -> Result<Vec<f32>, CarrierError> {
    Ok(match channel.neutral {
        Neutral::Value(value) => vec![value; count * channel.width],
        Neutral::NullId => vec![null_id; count],
        Neutral::OwnNormal => {
            let normal = primitive.get("attributes").and_then(|a| index_of(a, "NORMAL"));
            let own = normal.map(|accessor| source.floats(accessor, 3)).transpose()?.unwrap_or_default();
            let mut out: Vec<f32> =
                own.chunks_exact(3).take(count).flat_map(|n| unit(Vec3::from_slice(n)).to_array()).collect();
            while out.len() < count * 3 {
                out.extend(Vec3::Y.to_array());
            }
            out
        }
    })
}

/// Quantized normals are only nearly unit; no direction at all becomes up.
fn unit(normal: Vec3) -> Vec3 {
    let n = normal.as_dvec3();
    if n.is_finite() { n.normalize_or(DVec3::Y).as_vec3() } else { Vec3::Y }
}
