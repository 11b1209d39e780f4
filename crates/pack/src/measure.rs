//! What a packed file costs and what its numbers lost: every vertex is read back from the file and
//! compared with the master.

use crate::blender::{leaf_number, z_up};
use crate::master::{Master, Piece};
use crate::{Carrier, PackError, Plan};
use foliar_carrier::Document;
use foliar_carrier::edit::{Stored, attribute, attribute_names, bytes_per_vertex};
use foliar_numerics::ErrorStats;
use foliar_schema::{Engine, channel, names};
use glam::DVec3;
use schemars::JsonSchema;
use serde::Serialize;

/// How a channel's value is read back from the attribute that carries it.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(crate) enum Decode {
    /// The ambient coefficient as a factor on the base's own color.
    Color,
    /// The ambient coefficient as it is.
    Ambient,
    /// A leaf id.
    Leaf,
    /// Length of the vector.
    Length,
    /// Direction of the vector.
    Direction,
    /// Direction of the vector, whose Z is up.
    DirectionZup,
}

/// One channel in the packed file.
#[derive(Clone, Debug, PartialEq, Serialize, JsonSchema)]
#[serde(rename_all = "camelCase", deny_unknown_fields)]
pub struct PackedAttribute {
    /// Channel of the master.
    pub channel: String,
    /// Attribute that carries it.
    pub attribute: String,
    /// How: numbers per vertex and their type, such as `3 x u8`.
    pub stored: String,
    /// Bytes per vertex of the attribute.
    pub bytes_per_vertex: usize,
    /// Root mean square error against the master, in visible steps of the channel.
    pub rms_steps: f64,
    /// 99.9th percentile of the error, in visible steps.
    pub p999_steps: f64,
    /// Greatest error, in visible steps.
    pub max_steps: f64,
    /// Vertices compared: all that the master has the channel for.
    pub places: usize,
}

/// What a packed file costs and what it lost.
#[derive(Clone, Debug, PartialEq, Serialize, JsonSchema)]
#[serde(rename_all = "camelCase", deny_unknown_fields)]
pub struct PackReport {
    /// What it was packed for.
    pub engine: Engine,
    /// Vertices of all primitives that are drawn.
    pub vertices: usize,
    /// Bytes of all attributes per vertex, on average over the vertices.
    pub bytes_per_vertex: f64,
    /// The same of the base, before anything was baked.
    pub base_bytes_per_vertex: f64,
    /// Most that packing added to a vertex.
    pub added_bytes_per_vertex: usize,
    /// Triangles that two-sided leaves got for their backs, over the same vertices.
    pub added_triangles: usize,
    /// One entry per channel that any primitive has.
    pub attributes: Vec<PackedAttribute>,
}

/// Compares a packed document with its master.
pub(crate) fn report(engine: Engine, master: &Master, plan: &Plan, packed: &Document) -> Result<PackReport, PackError> {
    let mut attributes = Vec::new();
    for carrier in &plan.carriers {
        attributes.extend(compare(carrier, master, packed)?);
    }
    let vertices: usize = master.pieces.iter().map(Piece::count).sum();
    let of = |document: &Document, piece: &Piece| -> usize {
        let place = piece.part.place;
        attribute_names(document, place).iter().map(|name| bytes_per_vertex(document, place, name)).sum()
    };
    let mean = |document: &Document| {
        let bytes: usize = master.pieces.iter().map(|piece| piece.count() * of(document, piece)).sum();
        bytes as f64 / vertices.max(1) as f64
    };
    let sheets = &plan.edits.sheets;
    let added = |piece: &Piece| of(packed, piece).saturating_sub(of(master.document, piece));
    Ok(PackReport {
        engine,
        vertices,
        bytes_per_vertex: mean(packed),
        base_bytes_per_vertex: mean(master.document),
        added_bytes_per_vertex: master.pieces.iter().map(added).max().unwrap_or(0),
        added_triangles: master
            .pieces
            .iter()
            .filter(|p| sheets.contains(&p.part.place))
            .map(|p| p.part.triangles.len())
            .sum(),
        attributes,
    })
}

fn compare(carrier: &Carrier, master: &Master, packed: &Document) -> Result<Option<PackedAttribute>, PackError> {
    let mut errors = Vec::new();
    let mut stored_as = None;
    for piece in master.pieces.iter().filter(|piece| has(piece, carrier.channel)) {
        let place = piece.part.place;
        let Some(stored) = attribute(packed, place, carrier.attribute)? else { continue };
        let base = match carrier.decode {
            Decode::Color => attribute(master.document, place, carrier.attribute)?,
            _ => None,
        };
        errors.extend((0..piece.count()).map(|v| error(carrier.decode, piece, v, &stored, base.as_ref())));
        stored_as = Some((kind(&stored), bytes_per_vertex(packed, place, carrier.attribute)));
    }
    let step = channel(carrier.channel).map_or(1.0, |channel| channel.visible_step);
    let stats = ErrorStats::of(errors);
    Ok(stored_as.map(|(stored, bytes_per_vertex)| PackedAttribute {
        channel: carrier.channel.into(),
        attribute: carrier.attribute.into(),
        stored,
        bytes_per_vertex,
        rms_steps: stats.rms / step,
        p999_steps: stats.p999 / step,
        max_steps: stats.max / step,
        places: stats.count,
    }))
}

fn has(piece: &Piece, channel: &str) -> bool {
    match channel {
        names::AMBIENT => piece.ambient.is_some(),
        names::SOFT_NORMAL => piece.soft.is_some(),
        _ => piece.leaf.is_some(),
    }
}

fn kind(stored: &Stored) -> String {
    let word = match stored.component {
        5121 => "u8",
        5123 => "u16",
        _ => "f32",
    };
    format!("{} x {word}", stored.width)
}

/// Error of one vertex, in the unit of the channel's visible step.
fn error(decode: Decode, piece: &Piece, vertex: usize, stored: &Stored, base: Option<&Stored>) -> f64 {
    let at = |s: &Stored, i: usize| f64::from(s.values[vertex * s.width + i]);
    let vector = || DVec3::new(at(stored, 0), at(stored, 1), at(stored, 2));
    match decode {
        Decode::Color => {
            let wanted = |i| base.map_or(1.0, |b| at(b, i)) * piece.ambient_of(vertex);
            (0..3).map(|i| (at(stored, i) - wanted(i)).abs()).fold(0.0, f64::max)
        }
        Decode::Ambient => at(stored, 0) - piece.ambient_of(vertex),
        Decode::Leaf => at(stored, 0) - f64::from(leaf_number(piece, vertex)),
        Decode::Length => vector().length() - piece.ambient_of(vertex),
        Decode::Direction => degrees(vector(), piece.normal_of(vertex)),
        Decode::DirectionZup => degrees(vector(), z_up(piece.normal_of(vertex))),
    }
}

/// Angle between two vectors, degrees; exact where they are nearly the same.
fn degrees(a: DVec3, b: DVec3) -> f64 {
    libm::atan2(a.cross(b).length(), a.dot(b)).to_degrees()
}
