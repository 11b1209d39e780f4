//! What profiles see of a master: per primitive, the base and the channels that were baked for it.

use crate::PackError;
use foliar_bake::Layer;
use foliar_carrier::{Asset, Document};
use foliar_plant::{Part, Place};
use foliar_schema::names;
use glam::{DVec3, Vec3};

/// One primitive with what was baked for it.
pub(crate) struct Piece<'a> {
    pub part: &'a Part,
    pub ambient: Option<&'a [f32]>,
    /// Realigned normals, three numbers each.
    pub soft: Option<&'a [f32]>,
    /// Leaf ids; from `leaves` on they mean none.
    pub leaf: Option<&'a [f32]>,
    pub leaves: usize,
    /// Its material is seen from both sides.
    pub double_sided: bool,
    /// Primitives of its mesh, itself among them, that have each of the three: they get one vertex layout.
    pub mesh: Layout,
}

/// Which channels any primitive of a mesh has.
#[derive(Clone, Copy, Default)]
pub(crate) struct Layout {
    pub ambient: bool,
    pub soft: bool,
    pub leaf: bool,
}

/// A master, taken apart.
pub(crate) struct Master<'a> {
    /// The base.
    pub document: &'a Document,
    pub pieces: Vec<Piece<'a>>,
}

impl<'a> Master<'a> {
    /// Takes an asset apart.
    pub fn of(asset: &'a Asset) -> Result<Master<'a>, PackError> {
        let rows =
            |layer: &Layer| layer.columns.iter().find(|(k, _)| k.class == names::CLASS_LEAF).map(|(_, a)| a.rows());
        let leaves = asset.layers.iter().find_map(rows).unwrap_or(0);
        let mut pieces = Vec::new();
        for part in &asset.base.parts {
            let material = part.material.and_then(|m| asset.base.materials.get(m as usize));
            pieces.push(Piece {
                part,
                ambient: channel(asset, part, names::AMBIENT, 1)?,
                soft: channel(asset, part, names::SOFT_NORMAL, 3)?,
                leaf: channel(asset, part, names::LEAF_ID, 1)?,
                leaves,
                double_sided: material.is_some_and(|m| m.double_sided),
                mesh: Layout::default(),
            });
        }
        if pieces.iter().all(|piece| piece.ambient.is_none() && piece.soft.is_none()) {
            if asset.layers.iter().any(|layer| layer.record.room == names::ROOM_DENSITY) {
                return Err(PackError::NoLeaves);
            }
            let packed = asset.document.json.pointer("/asset/extras").and_then(|e| e.get(names::PACKED));
            let engine = packed.and_then(|p| p.get("engine")?.as_str()).map(str::to_owned);
            return Err(engine.map_or(PackError::NothingBaked, |engine| PackError::AlreadyPacked { engine }));
        }
        let layouts: Vec<Layout> = pieces.iter().map(|piece| layout(&pieces, piece.part.place.mesh)).collect();
        pieces.iter_mut().zip(layouts).for_each(|(piece, layout)| piece.mesh = layout);
        Ok(Master { document: &asset.document, pieces })
    }
}

fn layout(pieces: &[Piece], mesh: u32) -> Layout {
    let any = |has: fn(&Piece) -> bool| pieces.iter().any(|piece| piece.part.place.mesh == mesh && has(piece));
    Layout {
        ambient: any(|piece| piece.ambient.is_some()),
        soft: any(|piece| piece.soft.is_some()),
        leaf: any(|piece| piece.leaf.is_some()),
    }
}

/// A channel's values of one part, from whichever layer has them.
fn channel<'a>(
    asset: &'a Asset,
    part: &Part,
    channel: &'static str,
    width: usize,
) -> Result<Option<&'a [f32]>, PackError> {
    let found = asset.layers.iter().find_map(|layer| layer.attribute(part.place, channel)?.as_f32());
    let Place { mesh, primitive } = part.place;
    match found {
        Some(values) if values.len() != width * part.positions.len() => Err(PackError::Stale {
            channel,
            mesh,
            primitive,
            found: values.len() / width,
            vertices: part.positions.len(),
        }),
        found => Ok(found),
    }
}

impl Piece<'_> {
    /// Vertices.
    pub fn count(&self) -> usize {
        self.part.positions.len()
    }

    /// Ambient coefficient of a vertex; 1 where none was baked.
    pub fn ambient_of(&self, vertex: usize) -> f64 {
        self.ambient.map_or(1.0, |values| f64::from(values[vertex]))
    }

    /// The realigned normal of a vertex, unit; its own where none was baked, and up where it has none.
    pub fn normal_of(&self, vertex: usize) -> DVec3 {
        let baked = self.soft.map(|values| Vec3::from_slice(&values[3 * vertex..]));
        let normal = baked.or_else(|| self.part.normals.get(vertex).copied()).unwrap_or(Vec3::Y);
        normal.as_dvec3().normalize_or(DVec3::Y)
    }

    /// Leaf of a vertex.
    pub fn leaf_of(&self, vertex: usize) -> Option<u32> {
        self.leaf.map(|ids| ids[vertex] as u32).filter(|id| (*id as usize) < self.leaves)
    }
}
