//! Layers on disk: safetensors, `attr/{mesh}/{primitive}/NAME`, `table/{class}/{property}` and `raster/{name}`, with
//! record and roles as JSON under one metadata key (several keys would change order from run to run).

use crate::CarrierError;
use foliar_bake::{Array, AttributeKey, ColumnKey, FloatRaster, Layer, first_broken};
use foliar_plant::Place;
use foliar_schema::{Record, Role, channel, column, names};
use safetensors::tensor::{Dtype, SafeTensors, TensorView};
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;

const BAKE_AGAIN: &str = "bake the layer again";

/// What stands under the metadata key.
#[derive(Serialize, Deserialize)]
struct Header {
    record: Record,
    /// Role by `mesh/primitive`.
    #[serde(default)]
    roles: BTreeMap<String, Role>,
}

/// The bytes of a layer.
pub(crate) fn to_bytes(layer: &Layer) -> Result<Vec<u8>, CarrierError> {
    let fail = |problem: String| CarrierError::input(&layer.record.room, "", problem, "report it: a fault of foliar");
    let mut views = BTreeMap::new();
    for (key, array) in &layer.attributes {
        let name = format!("attr/{}/{}/{}", key.place.mesh, key.place.primitive, key.name);
        views.insert(name, view(array).map_err(|e| fail(e.to_string()))?);
    }
    for (key, array) in &layer.columns {
        let name = format!("table/{}/{}", key.class, key.property);
        views.insert(name, view(array).map_err(|e| fail(e.to_string()))?);
    }
    for (name, raster) in &layer.rasters {
        let shape = [raster.height, raster.width, raster.channels].map(|n| n as usize).to_vec();
        let view = TensorView::new(Dtype::F32, shape, bytemuck::cast_slice(&raster.data));
        views.insert(format!("{}{name}", names::WRITES_RASTER), view.map_err(|e| fail(e.to_string()))?);
    }
    for (name, picture) in &layer.pictures {
        let view = TensorView::new(Dtype::U8, vec![picture.len()], picture).map_err(|e| fail(e.to_string()))?;
        views.insert(format!("{}{name}", names::WRITES_PICTURE), view);
    }
    let roles = layer.roles.iter().map(|(place, role)| (format!("{}/{}", place.mesh, place.primitive), *role));
    let header = Header { record: layer.record.clone(), roles: roles.collect() };
    let header = serde_json::to_string(&header).map_err(|e| fail(e.to_string()))?;
    let metadata = [(names::LAYER_METADATA_KEY.to_string(), header)].into_iter().collect();
    safetensors::serialize(views, Some(metadata)).map_err(|e| fail(e.to_string()))
}

fn view(array: &Array) -> Result<TensorView<'_>, safetensors::SafeTensorError> {
    let shape = if array.width() == 1 { vec![array.rows()] } else { vec![array.rows(), array.width()] };
    let kind = if array.as_f32().is_some() { Dtype::F32 } else { Dtype::I32 };
    TensorView::new(kind, shape, array.bytes())
}

/// Reads a layer back.
pub(crate) fn from_bytes(bytes: &[u8], file: &str) -> Result<Layer, CarrierError> {
    let fail = |place: &str, problem: String| CarrierError::input(file, place, problem, BAKE_AGAIN);
    let no_layer = |e: safetensors::SafeTensorError| {
        let problem = format!("is no layer file (safetensors): {e}");
        CarrierError::input(file, "", problem, "name a .layer file that foliar wrote, or bake the layer again")
    };
    let (_, metadata) = SafeTensors::read_metadata(bytes).map_err(no_layer)?;
    let tensors = SafeTensors::deserialize(bytes).map_err(no_layer)?;
    let header = metadata.metadata().as_ref().and_then(|m| m.get(names::LAYER_METADATA_KEY));
    let header = header.ok_or_else(|| fail("__metadata__", format!("no key {:?}", names::LAYER_METADATA_KEY)))?;
    let header: Header = serde_json::from_str(header).map_err(|e| fail("__metadata__/foliar", e.to_string()))?;
    let mut layer = Layer { record: header.record, ..Layer::default() };
    for (key, role) in header.roles {
        let place = place_of(&key).ok_or_else(|| fail("roles", format!("{key:?} is no mesh/primitive")))?;
        layer.roles.insert(place, role);
    }
    for name in metadata.offset_keys() {
        let tensor = tensors.tensor(&name).map_err(|e| fail(&name, e.to_string()))?;
        if let Some(name) = name.strip_prefix(names::WRITES_RASTER) {
            layer.rasters.insert(name.into(), raster(&tensor).map_err(|problem| fail(name, problem))?);
            continue;
        }
        if let Some(name) = name.strip_prefix(names::WRITES_PICTURE) {
            layer.pictures.insert(name.into(), tensor.data().to_vec());
            continue;
        }
        let array = array(&tensor).map_err(|problem| fail(&name, problem))?;
        if let Some((row, value)) = out_of_range(&name, &array) {
            return Err(fail(&name, format!("row {row} is {value}, outside the range of its channel")));
        }
        put(&mut layer, &name, array).ok_or_else(|| {
            fail(
                &name,
                "no name of a layer's array (attr/MESH/PRIMITIVE/NAME, table/CLASS/PROPERTY or raster/NAME)".into(),
            )
        })?;
    }
    Ok(layer)
}

/// What a column holds that the contract does not know.
const ANY: [f32; 2] = [f32::MIN, f32::MAX];

/// The first row of a known channel or column that no room can have written, or of another that is no number.
fn out_of_range(name: &str, array: &Array) -> Option<(usize, f32)> {
    match name.strip_prefix("attr/").and_then(|rest| rest.rsplit('/').next()).and_then(channel) {
        Some(channel) => first_broken(channel, array),
        None => {
            let known = name.strip_prefix("table/").and_then(|rest| rest.split_once('/'));
            let [least, most] = known.and_then(|(class, name)| column(class, name)).map_or(ANY, |c| c.range);
            let outside = |value: f32| !(value >= least && value <= most);
            let at = (0..array.numbers()).find(|at| outside(array.number(*at)))?;
            Some((at / array.width(), array.number(at)))
        }
    }
}

/// What no room can have written into a layer that was read from a tree; `None` where all of it may be sound.
///
/// Values of vertices may have been rounded on the way, so that a share of their range is let pass; columns come as they
/// were written.
pub(crate) fn damage(layer: &Layer) -> Option<String> {
    const ROUNDED: f32 = 0.01;
    const UNIT: f32 = 1e-6;
    let beyond = |data: &[f32], [least, most]: [f32; 2], slack: f32| {
        let slack = slack * (most - least).min(f32::MAX);
        data.iter().position(|value| !(value.is_finite() && *value >= least - slack && *value <= most + slack))
    };
    let attribute = |(key, array): (&AttributeKey, &Array)| {
        let (channel, data) = (channel(&key.name)?, array.as_f32()?);
        let at = beyond(data, [channel.min, channel.max], ROUNDED)?;
        Some(format!("{} of vertex {} is {}", key.name, at / array.width(), data[at]))
    };
    let in_column = |(key, array): (&ColumnKey, &Array)| {
        let column = column(&key.class, &key.property)?;
        let row = |at: usize| format!("{}/{} of row {} is", key.class, key.property, at / array.width());
        let [least, most] = column.range;
        let outside = |value: f32| !(value >= least && value <= most);
        if let Some(at) = (0..array.numbers()).find(|at| outside(array.number(*at))) {
            return Some(format!("{} {}", row(at), array.number(at)));
        }
        let data = array.as_f32()?;
        let length = |v: &[f32]| v.iter().map(|x| x * x).sum::<f32>().sqrt();
        let is_normal = column.name == "normal" && column.width == 3;
        let bent = data.chunks(3).position(|v| is_normal && (length(v) - 1.0).abs() > UNIT)?;
        Some(format!("{} of length {}", row(3 * bent), length(&data[3 * bent..3 * bent + 3])))
    };
    layer.attributes.iter().find_map(attribute).or_else(|| layer.columns.iter().find_map(in_column))
}

fn place_of(text: &str) -> Option<Place> {
    let (mesh, primitive) = text.split_once('/')?;
    Some(Place { mesh: mesh.parse().ok()?, primitive: primitive.parse().ok()? })
}

fn put(layer: &mut Layer, name: &str, array: Array) -> Option<()> {
    if let Some(rest) = name.strip_prefix("attr/") {
        let (mesh, rest) = rest.split_once('/')?;
        let (primitive, name) = rest.split_once('/')?;
        let place = Place { mesh: mesh.parse().ok()?, primitive: primitive.parse().ok()? };
        layer.attributes.insert(AttributeKey { place, name: name.into() }, array);
    } else {
        let (class, property) = name.strip_prefix("table/")?.split_once('/')?;
        layer.columns.insert(ColumnKey { class: class.into(), property: property.into() }, array);
    }
    Some(())
}

/// A raster of [height, width, channels].
fn raster(tensor: &TensorView) -> Result<FloatRaster, String> {
    let measures: Vec<u32> = tensor.shape().iter().filter_map(|&n| u32::try_from(n).ok()).collect();
    match (measures.as_slice(), tensor.dtype()) {
        (&[height, width, channels], Dtype::F32) => {
            let words = tensor.data().chunks_exact(4).map(|b| f32::from_le_bytes([b[0], b[1], b[2], b[3]]));
            Ok(FloatRaster { width, height, channels, data: words.collect() })
        }
        _ => {
            Err(format!("shape {:?} of {:?} must be [height, width, channels] of F32", tensor.shape(), tensor.dtype()))
        }
    }
}

/// Copies numbers out, so that it does not matter where a writer aligned them.
fn array(tensor: &TensorView) -> Result<Array, String> {
    let width = match tensor.shape() {
        [_] => 1,
        [_, width] if *width > 0 => *width,
        shape => return Err(format!("shape {shape:?} must be [rows] or [rows, width]")),
    };
    let words = tensor.data().chunks_exact(4).map(|b| [b[0], b[1], b[2], b[3]]);
    match tensor.dtype() {
        Dtype::F32 => Ok(Array::F32 { width, data: words.map(f32::from_le_bytes).collect() }),
        Dtype::I32 => Ok(Array::I32 { width, data: words.map(i32::from_le_bytes).collect() }),
        other => Err(format!("numbers of type {other:?} must be F32 or I32")),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    #[test]
    fn numbers_that_no_room_writes_are_damage() {
        let layer = |property: &str, width: usize, data: Vec<f32>| {
            let key = ColumnKey { class: names::CLASS_LEAF.into(), property: property.into() };
            Layer { columns: [(key, Array::F32 { width, data })].into(), ..Layer::default() }
        };
        assert_eq!(damage(&layer("normal", 3, vec![0.0, 1.0, 0.0, 0.6, 0.0, 0.8])), None);
        let bent = damage(&layer("normal", 3, vec![0.0, 1.0, 0.0, 0.6, 0.0, 0.7])).unwrap();
        assert!(bent.contains("row 1") && bent.contains("length"), "{bent}");
        for wild in [f32::NAN, f32::INFINITY, 1e38] {
            assert!(damage(&layer("normal", 3, vec![wild, 0.0, 0.0])).is_some(), "{wild}");
        }
        assert!(damage(&layer("area", 1, vec![0.5, -1.0])).unwrap().contains("row 1 is -1"));
        let key = ColumnKey { class: names::CLASS_LEAF.into(), property: "crownVolume".into() };
        let ids = |data| Layer { columns: [(key.clone(), Array::I32 { width: 1, data })].into(), ..Layer::default() };
        assert_eq!(damage(&ids(vec![0, 1])), None);
        assert!(damage(&ids(vec![0, 7])).unwrap().contains("row 1 is 7"));
        let key = AttributeKey { place: Place { mesh: 0, primitive: 0 }, name: names::AMBIENT.into() };
        let ambient =
            |data| Layer { attributes: [(key.clone(), Array::F32 { width: 1, data })].into(), ..Layer::default() };
        // Eight bits may have rounded it.
        assert_eq!(damage(&ambient(vec![0.0, 1.004])), None);
        assert!(damage(&ambient(vec![0.0, 2.0])).unwrap().contains("vertex 1"));
    }
}
