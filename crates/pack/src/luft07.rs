//! Profile `luft07`: the encoding of Luft07, one vector per vertex along the realigned normal and as long
//! as the ambient coefficient k_a. glTF demands unit NORMALs, so it stands in an attribute of its own, and
//! NORMAL stays as it was.

use crate::master::Master;
use crate::measure::Decode;
use crate::{Carrier, Plan};
use foliar_schema::names;

/// No vector is shorter: a quarter of the coefficient's visible step, so that the direction is never lost,
/// not even in an engine that packs it into bytes.
pub(crate) const SHORTEST: f64 = 1e-3;

/// What changes.
pub(crate) fn plan(master: &Master) -> Plan {
    let mut plan = Plan {
        carriers: vec![
            Carrier { channel: names::AMBIENT, attribute: names::NORMAL_AMBIENT, decode: Decode::Length },
            Carrier { channel: names::SOFT_NORMAL, attribute: names::NORMAL_AMBIENT, decode: Decode::Direction },
        ],
        ..Plan::default()
    };
    for piece in master.pieces.iter().filter(|piece| piece.mesh.ambient || piece.mesh.soft) {
        let vector = |v: usize| (piece.normal_of(v) * piece.ambient_of(v).max(SHORTEST)).as_vec3().to_array();
        plan.floats(piece.part.place, names::NORMAL_AMBIENT, 3, (0..piece.count()).flat_map(vector).collect());
    }
    plan
}
