//! Profile `blender`: what Blender's importer takes exactly. It keeps float attributes of names that
//! begin with an underscore, under that very name; where those of one mesh differ in width, Blender 5.0.1
//! fails (it pairs data with names in the order of a hash), so all get three numbers. It turns the
//! base's Y up into its own Z up, custom attributes excepted: vectors are written with Z up.

use crate::master::{Master, Piece};
use crate::measure::Decode;
use crate::{Carrier, PackError, Plan};
use foliar_carrier::edit::{attribute, attribute_names};
use foliar_plant::Place;
use foliar_schema::{Finding, code, names};
use glam::DVec3;

/// Component type of floats (glTF 2.0 section 3.6.2.2).
const FLOAT: u64 = 5126;
/// Numbers per vertex of every attribute.
const WIDTH: usize = 3;
const OURS: [&str; 3] = [names::AMBIENT, names::SOFT_NORMAL_ZUP, names::PACKED_LEAF_ID];

/// What changes.
pub(crate) fn plan(master: &Master) -> Result<Plan, PackError> {
    let mut plan = Plan {
        carriers: vec![
            Carrier { channel: names::AMBIENT, attribute: names::AMBIENT, decode: Decode::Ambient },
            Carrier { channel: names::SOFT_NORMAL, attribute: names::SOFT_NORMAL_ZUP, decode: Decode::DirectionZup },
            Carrier { channel: names::LEAF_ID, attribute: names::PACKED_LEAF_ID, decode: Decode::Leaf },
        ],
        ..Plan::default()
    };
    for piece in &master.pieces {
        let place = piece.part.place;
        let thrice = |value: fn(&Piece, usize) -> f32| -> Vec<f32> {
            (0..piece.count()).flat_map(|v| [value(piece, v); WIDTH]).collect()
        };
        if piece.mesh.ambient {
            plan.floats(place, names::AMBIENT, WIDTH, thrice(|piece, v| piece.ambient_of(v) as f32));
        }
        if piece.mesh.soft {
            let normals = (0..piece.count()).flat_map(|v| z_up(piece.normal_of(v)).as_vec3().to_array());
            plan.floats(place, names::SOFT_NORMAL_ZUP, WIDTH, normals.collect());
        }
        if piece.mesh.leaf {
            plan.floats(place, names::PACKED_LEAF_ID, WIDTH, thrice(leaf_number));
        }
        leave_out(master, place, &mut plan)?;
    }
    Ok(plan)
}

/// A leaf id as Blender gets it: -1 where the vertex belongs to none.
pub(crate) fn leaf_number(piece: &Piece, vertex: usize) -> f32 {
    piece.leaf_of(vertex).map_or(-1.0, |id| id as f32)
}

/// A vector of glTF as Blender has it.
pub(crate) fn z_up(v: DVec3) -> DVec3 {
    DVec3::new(v.x, -v.z, v.y)
}

/// Leaves out attributes of the base that do not fit beside ours.
fn leave_out(master: &Master, place: Place, plan: &mut Plan) -> Result<(), PackError> {
    let mut gone = Vec::new();
    for name in attribute_names(master.document, place).into_iter().filter(|name| name.starts_with('_')) {
        let stored = attribute(master.document, place, &name)?;
        let fits = stored.is_some_and(|s| s.width == WIDTH && s.component == FLOAT);
        if !fits && !OURS.contains(&name.as_str()) {
            plan.edits.removed.push((place, name.clone()));
        }
        if !fits || OURS.contains(&name.as_str()) {
            gone.push(name);
        }
    }
    if !gone.is_empty() {
        let message = format!(
            "{} cannot stand beside foliar's attributes in Blender 5.0.1 (three floats each) and was left out: \
             convert it in the modeller if it is needed",
            gone.join(", ")
        );
        let at = format!("/meshes/{}/primitives/{}", place.mesh, place.primitive);
        plan.findings.push(Finding::new(&code::PACK_LEFT_OUT, message).at(at));
    }
    Ok(())
}
