//! The second reader of packed files: what each engine is promised, by the specification and the contract
//! alone.

use super::{ensure, float, items, number};
use foliar_schema::{Engine, names};
use serde_json::Value;
use std::collections::BTreeSet;

/// How far a normal may be from unit length, as the Khronos validator has it.
const UNIT: f64 = 0.00674;
/// Rounding of a vector to three floats, and of its length.
const ROUNDED: f64 = 1e-6;

/// A packed file.
pub(super) struct Packed<'a> {
    pub json: &'a Value,
    pub bin: &'a [u8],
}

impl Packed<'_> {
    /// What the file says it was packed for; `None` where it is no packed file.
    pub fn engine(json: &Value) -> Option<&str> {
        json["asset"]["extras"][names::PACKED]["engine"].as_str()
    }

    /// Verifies it.
    ///
    /// # Errors
    /// What does not hold, with its place.
    pub fn verify(&self, engine: &str) -> Result<(), String> {
        let engine = Engine::ALL.into_iter().find(|e| e.name() == engine).ok_or(format!("engine {engine:?}"))?;
        let classes = &self.json["extensions"][names::STRUCTURAL_METADATA]["schema"]["classes"];
        ensure(classes[names::CLASS_LEAF].is_null(), || "a packed file has no use for tables".into())?;
        let mut carriers = 0;
        for (m, mesh) in items(&self.json["meshes"]) {
            let mut layouts = BTreeSet::new();
            for (p, primitive) in items(&mesh["primitives"]) {
                let attributes = &primitive["attributes"];
                let found =
                    self.primitive(engine, attributes).map_err(|e| format!("/meshes/{m}/primitives/{p}: {e}"))?;
                carriers += found.len();
                layouts.insert(found);
            }
            ensure(layouts.len() <= 1, || {
                format!("/meshes/{m}: its primitives carry different attributes {layouts:?}")
            })?;
        }
        ensure(carriers > 0 || engine == Engine::Core, || "nothing in it was packed".into())
    }

    /// Verifies the attributes of a primitive; those that all primitives of its mesh must have.
    fn primitive(&self, engine: Engine, attributes: &Value) -> Result<Vec<String>, String> {
        let count = number(&self.json["accessors"][number(&attributes["POSITION"])]["count"]);
        let names: Vec<String> = attributes.as_object().into_iter().flatten().map(|(name, _)| name.clone()).collect();
        let custom = || names.iter().filter(|name| name.starts_with('_')).cloned().collect::<Vec<_>>();
        match engine {
            Engine::Core => {
                ensure(!names.contains(&names::AMBIENT.to_string()), || "the coefficient stands there twice".into())?;
                for (name, least, most) in [("NORMAL", 1.0 - UNIT, 1.0 + UNIT), ("COLOR_0", 0.0, f64::INFINITY)] {
                    let Some(rows) = self.numbers(attributes, name, count)? else { continue };
                    let lengths = rows.iter().all(|row| (least..=most).contains(&length(row)));
                    ensure(lengths, || format!("{name} holds a vector of another length than {least} to {most}"))?;
                    let range = rows.iter().flatten().all(|v| name == "NORMAL" || (0.0..=1.0).contains(v));
                    ensure(range, || format!("{name} is outside 0 to 1"))?;
                }
                Ok(names.into_iter().filter(|name| name == "COLOR_0").collect())
            }
            Engine::Blender => {
                for name in custom() {
                    let accessor = &self.json["accessors"][number(&attributes[&name])];
                    let fits = accessor["type"] == "VEC3" && accessor["componentType"] == 5126;
                    ensure(fits, || format!("{name} is no VEC3 of floats, as every custom attribute must be"))?;
                    self.numbers(attributes, &name, count)?;
                }
                Ok(ours(custom(), &[names::AMBIENT, names::SOFT_NORMAL_ZUP, names::PACKED_LEAF_ID]))
            }
            Engine::Luft07 => {
                let rows = self.numbers(attributes, names::NORMAL_AMBIENT, count)?.unwrap_or_default();
                let fits =
                    rows.iter().all(|row| row.len() == 3 && (1e-3 - ROUNDED..=1.0 + ROUNDED).contains(&length(row)));
                ensure(fits, || format!("{} has a length outside 0.001 to 1", names::NORMAL_AMBIENT))?;
                Ok(ours(custom(), &[names::NORMAL_AMBIENT]))
            }
        }
    }

    /// The numbers of an attribute, vertex by vertex; `None` where there is none of that name.
    fn numbers(&self, attributes: &Value, name: &str, count: usize) -> Result<Option<Vec<Vec<f64>>>, String> {
        let Some(accessor) = attributes.get(name).map(|index| &self.json["accessors"][number(index)]) else {
            return Ok(None);
        };
        let view = &self.json["bufferViews"][number(&accessor["bufferView"])];
        // Only what packing wrote is looked at: plain, and in the buffer of the file.
        if accessor["bufferView"].is_null() || !accessor["sparse"].is_null() || view["buffer"] != 0 {
            return Ok(None);
        }
        ensure(number(&accessor["count"]) == count, || format!("{name}: count is not {count}, that of POSITION"))?;
        let width = match accessor["type"].as_str() {
            Some("SCALAR") => 1,
            Some(text) => text.trim_start_matches("VEC").parse().map_err(|_| format!("{name}: type {text}"))?,
            None => return Err(format!("{name} has no type")),
        };
        let size = match accessor["componentType"].as_u64() {
            Some(5126) => 4,
            Some(5122 | 5123) => 2,
            _ => 1,
        };
        let stride = view["byteStride"].as_u64().map_or(width * size, |stride| stride as usize);
        ensure(stride.is_multiple_of(4), || format!("{name}: {stride} bytes per vertex are no multiple of four"))?;
        let start = number(&view["byteOffset"]) + number(&accessor["byteOffset"]);
        let end = number(&view["byteOffset"]) + number(&view["byteLength"]);
        let component = number(&accessor["componentType"]);
        let one = |at: usize| self.number_at(at, component).filter(|_| at + size <= end);
        let row = |v: usize| (0..width).map(|c| one(start + v * stride + c * size)).collect::<Option<Vec<f64>>>();
        let rows: Option<Vec<Vec<f64>>> = (0..count).map(row).collect();
        let rows = rows.ok_or_else(|| format!("{name} reaches past its view"))?;
        ensure(rows.iter().flatten().all(|v| v.is_finite()), || format!("{name} is not finite"))?;
        Ok(Some(rows))
    }

    fn number_at(&self, at: usize, component: usize) -> Option<f64> {
        let byte = |at: usize| self.bin.get(at).copied();
        match component {
            5120 => Some(f64::from(byte(at)? as i8) / 127.0),
            5121 => Some(f64::from(byte(at)?) / 255.0),
            5122 => Some(f64::from(i16::from_le_bytes([byte(at)?, byte(at + 1)?])) / 32_767.0),
            5123 => Some(f64::from(u16::from_le_bytes([byte(at)?, byte(at + 1)?])) / 65_535.0),
            _ => float(self.bin, at),
        }
    }
}

/// Those that packing writes.
fn ours(names: Vec<String>, written: &[&str]) -> Vec<String> {
    names.into_iter().filter(|name| written.contains(&name.as_str())).collect()
}

fn length(vector: &[f64]) -> f64 {
    vector.iter().map(|v| v * v).sum::<f64>().sqrt()
}
