//! A layer: what one step makes.

use crate::{Array, FloatRaster};
use foliar_plant::Place;
use foliar_schema::{MapLink, Record, Role};
use std::collections::BTreeMap;

/// Names an attribute: values per vertex of one primitive.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct AttributeKey {
    /// Which primitive.
    pub place: Place,
    /// Channel name, one of [`foliar_schema::CHANNELS`].
    pub name: String,
}

/// Names a column: values per row of one table.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct ColumnKey {
    /// Class of the table.
    pub class: String,
    /// Property of the class.
    pub property: String,
}

/// What one step makes: its arrays and one record. Meshes join when a room makes them.
/// Keys sort by (mesh, primitive, name) and (class, property): the order of every file.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Layer {
    /// Who made it, from what.
    pub record: Record,
    /// Values per vertex.
    pub attributes: BTreeMap<AttributeKey, Array>,
    /// Values per table row.
    pub columns: BTreeMap<ColumnKey, Array>,
    /// Rasters by name; those of one leaf material among several are named `SHEET/NAME`.
    pub rasters: BTreeMap<String, FloatRaster>,
    /// Rasters of a master that are there in 8 bits alone: how they are stored, so that they are stored so again.
    pub in_8_bits: BTreeMap<String, MapLink>,
    /// Pictures that are passed on as they came, PNG or JPEG bytes, named like rasters.
    pub pictures: BTreeMap<String, Vec<u8>>,
    /// Role of each primitive; only the layer of `structure` has them.
    pub roles: BTreeMap<Place, Role>,
}

impl Layer {
    /// The array of an attribute.
    pub fn attribute(&self, place: Place, name: &str) -> Option<&Array> {
        self.attributes.get(&AttributeKey { place, name: name.into() })
    }

    /// The array of a column.
    pub fn column(&self, class: &str, property: &str) -> Option<&Array> {
        self.columns.get(&ColumnKey { class: class.into(), property: property.into() })
    }

    /// blake3 of room, version, facts, roles and every array with its name: what another layer's record
    /// says that it read. Parameters and measured errors do not count: they say how, not what.
    pub fn content_hash(&self) -> String {
        let mut hasher = blake3::Hasher::new();
        let mut text = |s: &str| {
            hasher.update(&(s.len() as u64).to_le_bytes());
            hasher.update(s.as_bytes());
        };
        text(&self.record.room);
        text(&self.record.version.to_string());
        text(&serde_json::Value::Object(self.record.facts.clone()).to_string());
        for (place, role) in &self.roles {
            text(&format!("role/{}/{}={role}", place.mesh, place.primitive));
        }
        let mut array = |name: String, array: &Array| {
            let header = format!("{name}[{},{}]", array.rows(), array.width());
            hasher.update(&(header.len() as u64).to_le_bytes());
            hasher.update(header.as_bytes());
            hasher.update(array.bytes());
        };
        for (key, values) in &self.attributes {
            array(format!("attr/{}/{}/{}", key.place.mesh, key.place.primitive, key.name), values);
        }
        for (key, values) in &self.columns {
            array(format!("table/{}/{}", key.class, key.property), values);
        }
        for (name, raster) in &self.rasters {
            let header = format!("raster/{name}[{},{},{}]", raster.height, raster.width, raster.channels);
            hasher.update(&(header.len() as u64).to_le_bytes());
            hasher.update(header.as_bytes());
            hasher.update(bytemuck::cast_slice(&raster.data));
        }
        for (name, picture) in &self.pictures {
            let header = format!("picture/{name}[{}]", picture.len());
            hasher.update(&(header.len() as u64).to_le_bytes());
            hasher.update(header.as_bytes());
            hasher.update(picture);
        }
        hasher.finalize().to_hex().to_string()
    }
}
