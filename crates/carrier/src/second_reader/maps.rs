//! The second reader of maps: links and records name each other, textures are where the links say, a viewer that knows
//! nothing of foliar shows a leaf, and what the 8 bits mean is what the EXR beside the file holds.

use super::{Master, Problem, coded, ensure, items, number};
use exr::prelude::read_first_rgba_layer_from_file;
use foliar_schema::{code, names};
use serde_json::Value;
use std::collections::BTreeSet;
use std::path::Path;

/// How far a number of the EXR may be from what the 8 bits say, beyond the error that the link states: half floats and
/// rounding of the stated numbers.
const ROUNDING: f64 = 1e-3;

/// A texture of the file, decoded.
struct Texture {
    width: usize,
    height: usize,
    rgba: Vec<u8>,
}

impl Master<'_> {
    /// Everything that does not hold about maps.
    pub fn maps(&self, root: &Value, writes: &BTreeSet<&str>) -> Vec<Problem> {
        let mut found = Vec::new();
        let sheets = &root[names::ROOM_TRANSLUCENCY];
        for write in writes.iter().filter_map(|w| w.strip_prefix(names::WRITES_RASTER)) {
            let link = write.rsplit_once('/').map(|(sheet, map)| &sheets[sheet]["maps"][map]);
            let there = ensure(link.is_some_and(Value::is_object), || format!("no link leads to the map {write}"));
            found.extend(coded(&code::CONTRACT_RECORD, there).err());
        }
        for (sheet, links) in sheets.as_object().into_iter().flatten() {
            let place = format!("/extensions/{}/{}/{sheet}", names::EXTENSION, names::ROOM_TRANSLUCENCY);
            found.extend(self.sheet(sheet, links, writes).err().map(|problem| problem.at(&place)));
        }
        found
    }

    fn sheet(&self, sheet: &str, links: &Value, writes: &BTreeSet<&str>) -> Result<(), Problem> {
        let record = |holds, text: String| coded(&code::CONTRACT_RECORD, ensure(holds, || text));
        let maps = links["maps"].as_object();
        for (map, link) in maps.into_iter().flatten() {
            let named = format!("{}{sheet}/{map}", names::WRITES_RASTER);
            record(writes.contains(named.as_str()), format!("no record names the map {sheet}/{map}"))?;
            let scales = items(&link["scale"]).filter_map(|(_, v)| v.as_f64()).filter(|v| *v > 0.0 && v.is_finite());
            coded(&code::CONTRACT_RANGE, ensure(scales.count() == 3, || format!("scale {} of {map}", link["scale"])))?;
            if let Some(name) = link["texture"].as_str() {
                let texture = coded(&code::CONTRACT_CHANNEL, self.texture(name))?;
                let least = texture.rgba.chunks_exact(4).map(|t| t[3]).min();
                let holds = least.is_some_and(|alpha| alpha > 0);
                coded(&code::CONTRACT_RANGE, ensure(holds, || format!("alpha of {name} is 0 somewhere")))?;
            }
        }
        let shown = &links["maps"][links["shown"].as_str().unwrap_or("")];
        record(shown.is_object(), format!("the shown map {} is not among the maps", links["shown"]))?;
        for (_, material) in items(&links["materials"]) {
            coded(&code::CONTRACT_CHANNEL, self.user(material, shown))?;
        }
        Ok(())
    }

    /// A material that uses the map: it is there, and shows the map unless it has something of its own to show.
    fn user(&self, name: &Value, shown: &Value) -> Result<(), String> {
        let is = |(index, material): &(usize, &Value)| {
            material["name"] == *name || (material["name"].is_null() && *name == format!("material {index}"))
        };
        let users: Vec<(usize, &Value)> = items(&self.json["materials"]).filter(is).collect();
        ensure(!users.is_empty(), || format!("there is no material {name}"))?;
        for (index, material) in users {
            let shows = &material["extensions"][names::DIFFUSE_TRANSMISSION];
            ensure(shows.is_object(), || format!("material {index} has no diffuse transmission"))?;
            let texture = &self.json["textures"][number(&shows["diffuseTransmissionTexture"]["index"])];
            let ours = texture["name"] == shown["texture"];
            let factor = shows["diffuseTransmissionFactor"].as_f64().unwrap_or(0.0);
            ensure(!ours || (factor > 0.0 && factor <= 1.0), || format!("material {index}: factor {factor}"))?;
        }
        Ok(())
    }

    /// The one texture of this name.
    fn texture(&self, name: &str) -> Result<Texture, String> {
        let named: Vec<&Value> =
            items(&self.json["textures"]).map(|(_, t)| t).filter(|texture| texture["name"] == name).collect();
        ensure(named.len() == 1, || format!("{} textures are named {name}", named.len()))?;
        let image = &self.json["images"][number(&named[0]["source"])];
        ensure(image["mimeType"] == "image/png", || format!("{name} is no PNG"))?;
        let view = &self.json["bufferViews"][number(&image["bufferView"])];
        let bytes = self.view(view, 4)?;
        let picture = image::load_from_memory_with_format(bytes, image::ImageFormat::Png).map_err(|e| e.to_string())?;
        ensure(picture.color() == image::ColorType::Rgba8, || format!("{name} is no RGBA of 8 bits"))?;
        let (width, height) = (picture.width() as usize, picture.height() as usize);
        Ok(Texture { width, height, rgba: picture.into_rgba8().into_raw() })
    }

    /// What lies beside the file says what the 8 bits in it say, to the error that is stated.
    pub fn sides(&self, path: &Path) -> Result<(), String> {
        let root = &self.json["extensions"][names::EXTENSION];
        for (sheet, map, uri) in maps_beside(root) {
            let link = &root[names::ROOM_TRANSLUCENCY][sheet]["maps"][map];
            let name = percent_encoding::percent_decode_str(uri).decode_utf8_lossy().into_owned();
            let file = path.with_file_name(&name);
            let texels = exact(&file).map_err(|e| format!("{}: {e}", file.display()))?;
            if let Some(texture) = link["texture"].as_str() {
                let texture = self.texture(texture)?;
                let size = (texture.width, texture.height);
                ensure(size == texels.0, || format!("{map}: {size:?} in the file, {:?} beside it", texels.0))?;
                agree(&texture, &texels.1, link).map_err(|e| format!("{map}: {e}"))?;
            }
        }
        Ok(())
    }
}

/// Maps whose numbers lie in an EXR beside the file: set, map, and URI of the EXR, of a root extension or its mirror.
pub fn maps_beside(root: &Value) -> impl Iterator<Item = (&str, &str, &str)> {
    let sheets = root[names::ROOM_TRANSLUCENCY].as_object().into_iter().flatten();
    sheets.flat_map(|(sheet, links)| {
        let maps = links["maps"].as_object().into_iter().flatten();
        maps.filter_map(move |(map, link)| Some((sheet.as_str(), map.as_str(), link["exr"].as_str()?)))
    })
}

type Texels = ((usize, usize), Vec<[f32; 4]>);

/// R, G, B and A of an EXR.
fn exact(file: &Path) -> Result<Texels, String> {
    let make = |size: exr::math::Vec2<usize>, _: &_| (size.x(), vec![[0.0f32; 4]; size.x() * size.y()]);
    let set =
        |(width, texels): &mut (usize, Vec<[f32; 4]>), at: exr::math::Vec2<usize>, texel: (f32, f32, f32, f32)| {
            texels[at.y() * *width + at.x()] = texel.into();
        };
    let image = read_first_rgba_layer_from_file(file, make, set).map_err(|e| e.to_string())?;
    let size = image.layer_data.size;
    Ok(((size.x(), size.y()), image.layer_data.channel_data.pixels.1))
}

fn agree(texture: &Texture, texels: &[[f32; 4]], link: &Value) -> Result<(), String> {
    let part = |key: &str, c: usize| link[key][c].as_f64().unwrap_or(f64::NAN);
    let allowed = link["maxError"].as_f64().unwrap_or(f64::NAN) + ROUNDING;
    for (at, (stored, exact)) in texture.rgba.chunks_exact(4).zip(texels).enumerate().filter(|(_, (_, e))| e[3] > 0.0) {
        for c in 0..3 {
            let back = part("bias", c) + part("scale", c) * f64::from(stored[c]) / 255.0;
            let miss = (back - f64::from(exact[c])).abs();
            ensure(miss <= allowed, || format!("texel {at}: {back} in 8 bits, {} exactly", exact[c]))?;
        }
    }
    Ok(())
}
