//! Profile `core`: any glTF viewer shows the baked tree, without a shader of foliar. NORMAL is the
//! realigned one, `COLOR_0` holds the ambient coefficient (Luft07's k_a) times what it held before.

use crate::master::{Master, Piece};
use crate::measure::Decode;
use crate::{Carrier, PackError, Plan, tangents};
use foliar_carrier::edit::{NewAttribute, Numbers, Stored, attribute};
use foliar_schema::names;

const NORMAL: &str = "NORMAL";
const TANGENT: &str = "TANGENT";
const COLOR: &str = "COLOR_0";
/// Component types of normalized integers (glTF 2.0 section 3.6.2.2).
const BYTES: u64 = 5121;
const SHORTS: u64 = 5123;

/// What changes.
pub(crate) fn plan(master: &Master) -> Result<Plan, PackError> {
    let mut plan = Plan {
        carriers: vec![
            Carrier { channel: names::AMBIENT, attribute: COLOR, decode: Decode::Color },
            Carrier { channel: names::SOFT_NORMAL, attribute: NORMAL, decode: Decode::Direction },
        ],
        ..Plan::default()
    };
    for piece in &master.pieces {
        if piece.soft.is_some() {
            realign(master, piece, &mut plan)?;
        }
        if piece.mesh.ambient {
            plan.add(color(piece, attribute(master.document, piece.part.place, COLOR)?));
        }
    }
    Ok(plan)
}

/// NORMAL, and what follows from it: tangents stay at right angles, and leaves have no back whose normal a
/// viewer would turn over.
fn realign(master: &Master, piece: &Piece, plan: &mut Plan) -> Result<(), PackError> {
    let place = piece.part.place;
    let normals: Vec<f32> = (0..piece.count()).flat_map(|v| piece.normal_of(v).as_vec3().to_array()).collect();
    if let Some(old) = attribute(master.document, place, TANGENT)?.filter(|old| old.width == 4) {
        let tangents = (0..piece.count()).flat_map(|v| {
            let own = piece.part.normals.get(v).map_or(piece.normal_of(v), |n| n.as_dvec3());
            tangents::realigned(&old.values[4 * v..4 * v + 4], own, piece.normal_of(v))
        });
        plan.floats(place, TANGENT, 4, tangents.collect());
    }
    plan.floats(place, NORMAL, 3, normals);
    if piece.double_sided {
        plan.edits.sheets.insert(place);
    }
    Ok(())
}

/// `COLOR_0` as the base has it times the ambient coefficient, in the base's own precision; bytes where it
/// has none: they miss by half a visible step of the coefficient at most. Three numbers rather than four:
/// some viewers take an alpha, even of 1, for a wish to be blended.
fn color(piece: &Piece, old: Option<Stored>) -> NewAttribute {
    let width = old.as_ref().map_or(3, |old| old.width);
    let own = |at: usize| old.as_ref().map_or(1.0, |old| f64::from(old.values[at]));
    let product = |at: usize| match at % width {
        3 => own(at),
        _ => own(at) * piece.ambient_of(at / width),
    };
    let values = (0..piece.count() * width).map(|at| product(at).clamp(0.0, 1.0));
    let numbers = match old.as_ref().map_or(BYTES, |old| old.component) {
        BYTES => Numbers::U8(values.map(|v| (v * 255.0).round() as u8).collect()),
        SHORTS => Numbers::U16(values.map(|v| (v * 65_535.0).round() as u16).collect()),
        _ => Numbers::F32(values.map(|v| v as f32).collect()),
    };
    NewAttribute { place: piece.part.place, name: COLOR.into(), width, numbers }
}
