//! Maps of leaves: one per set as diffuse transmission of its materials (KHR_materials_diffuse_transmission), in 8 bits with
//! scale and bias; the exact numbers as EXR beside the file. A material that says itself how light passes through keeps
//! its word: its map is in the file under its name, and the extension alone links it.

use super::builder::{Builder, Content};
use crate::document::{Side, index_of};
use crate::materials::base_color_info;
use crate::notes::view_name;
use crate::{CarrierError, coefficients, images};
use foliar_bake::{FloatRaster, Layer};
use foliar_schema::{ColorLink, Finding, MapLink, RASTERS, SheetLinks, code, names};
use rayon::prelude::*;
use serde_json::{Map, Value, json};
use std::collections::BTreeMap;

const EXPORT_AGAIN: &str = "export it again";
const MIRRORED: &str = "KHR_texture_transform";

/// A layer's maps of one set, by the name of the raster.
type Rasters<'a> = BTreeMap<&'a str, &'a FloatRaster>;

/// One map, encoded.
pub(crate) struct Encoded {
    /// What to make of its numbers.
    pub link: MapLink,
    /// In 8 bits.
    pub png: Option<Vec<u8>>,
    /// Exactly.
    pub exr: Option<Vec<u8>>,
}

/// Writes the maps of all layers; gives the links for the root extension.
pub(super) fn write(builder: &mut Builder, layers: &[&Layer]) -> Result<BTreeMap<String, SheetLinks>, CarrierError> {
    let mut links = BTreeMap::new();
    for layer in layers.iter().filter(|layer| layer.record.room == names::ROOM_TRANSLUCENCY) {
        for (sheet, rasters) in sheets(layer) {
            links.insert(sheet.to_owned(), write_sheet(builder, layer, sheet, &rasters)?);
        }
    }
    Ok(links)
}

/// Rasters by the set that they belong to.
fn sheets(layer: &Layer) -> BTreeMap<&str, Rasters<'_>> {
    let mut sheets: BTreeMap<&str, Rasters> = BTreeMap::new();
    for (name, raster) in &layer.rasters {
        if let Some((sheet, map)) = name.rsplit_once('/') {
            sheets.entry(sheet).or_default().insert(map, raster);
        }
    }
    sheets
}

/// The map that one sees, by the order of the contract: the front in green.
pub(crate) fn shown_of<'a>(rasters: &BTreeMap<&'a str, &FloatRaster>) -> Option<&'a str> {
    let known = RASTERS.iter().find_map(|info| rasters.get_key_value(info.name));
    known.or_else(|| rasters.first_key_value()).map(|(name, _)| *name)
}

fn write_sheet(
    builder: &mut Builder,
    layer: &Layer,
    sheet: &str,
    rasters: &Rasters,
) -> Result<SheetLinks, CarrierError> {
    let facts = layer.record.facts.get(names::FACT_SHEETS).and_then(|sheets| sheets.get(sheet));
    let facts = facts.cloned().unwrap_or_default();
    let materials = facts["materials"].as_array().into_iter().flatten();
    let materials: Vec<String> = materials.filter_map(Value::as_str).map(String::from).collect();
    let shown = shown_of(rasters).unwrap_or_default().to_owned();
    let all = layer.record.resolved.get("embed_all") == Some(&Value::Bool(true));
    let half = layer.record.resolved.get("exr") != Some(&json!("float"));
    let encoded: Result<Vec<(&str, Encoded)>, CarrierError> = rasters
        .par_iter()
        .map(|(name, raster)| match layer.in_8_bits.get(&format!("{sheet}/{name}")) {
            Some(link) => Ok((*name, again(raster, link)?)),
            None => Ok((*name, encode_map(raster, all || **name == shown, (!all).then_some(half))?)),
        })
        .collect();
    let mut links = SheetLinks { materials, shown, ..SheetLinks::default() };
    let users = users(builder, &links.materials);
    let mut shown_texture = None;
    for (name, Encoded { mut link, png, exr }) in encoded? {
        if let Some(png) = png {
            let texture = view_name(&layer.record.room, &format!("{sheet}/{name}"));
            let index = add_texture(builder, &texture, &png, "image/png", users.first().copied())?;
            link.texture = Some(texture);
            shown_texture = shown_texture.or((name == links.shown).then_some((index, link.mean_scale)));
        }
        if let Some(exr) = exr {
            let side = Side::new(&format!("{}-{sheet}-{name}", layer.record.room), "exr", exr);
            link.exr = Some(side.name.clone());
            builder.document.sides.push(side);
        }
        links.maps.insert(name.to_owned(), link);
    }
    builder.findings.extend(rounding(&links).map(|finding| finding.at(format!("map {sheet}"))));
    links.color = color(builder, layer, sheet, &facts, &users)?;
    if let Some(texture) = shown_texture {
        show(builder, &links, &users, texture, &facts)?;
    }
    Ok(links)
}

/// What 8 bits cost the worst of the maps that have them.
pub(crate) fn rounding(links: &SheetLinks) -> Option<Finding> {
    let stored = links.maps.iter().filter(|(_, link)| link.texture.is_some());
    let (name, link) = stored.max_by(|a, b| a.1.rms_error.total_cmp(&b.1.rms_error))?;
    let share = link.rms_error / link.mean_scale.max(f64::MIN_POSITIVE);
    let message = format!(
        "{name} in 8 bits is off by {:.2e}, rms, and {:.2e} at most: {:.2} % of the brightest mean transmission; {}",
        link.rms_error,
        link.max_error,
        100.0 * share,
        if link.exr.is_some() { "the EXR beside it loses nothing that shows" } else { "write an EXR to lose nothing" }
    );
    Some(Finding::new(&code::MAP_ROUNDED, message))
}

/// Both forms of one map, side by side: PNG where asked for, EXR where said whether of half floats.
pub(crate) fn encode_map(raster: &FloatRaster, png: bool, half: Option<bool>) -> Result<Encoded, CarrierError> {
    let (raster, halves) = coefficients::rounded(raster, half.unwrap_or(true));
    let filled = coefficients::filled(&raster);
    let (stored, exr) = rayon::join(
        || {
            let stored = coefficients::stored(&raster, &filled);
            let bytes = png.then(|| coefficients::png(&stored.rgba, raster.width, raster.height)).transpose()?;
            Ok::<_, CarrierError>((stored.link, bytes))
        },
        || half.map(|_| coefficients::exr(&raster, &filled, halves)).transpose(),
    );
    let (link, png) = stored?;
    Ok(Encoded { link, png, exr: exr? })
}

/// A map that is there in 8 bits alone, in the same 8 bits: to fit them anew would lose a little at every bake. What an EXR
/// held that is missing stays missing, and is said to be.
fn again(raster: &FloatRaster, link: &MapLink) -> Result<Encoded, CarrierError> {
    let rgba = coefficients::to_8_bits(raster, link);
    let png = coefficients::png(&rgba, raster.width, raster.height)?;
    Ok(Encoded { link: link.clone(), png: Some(png), exr: None })
}

/// Materials of the document that have one of these names.
fn users(builder: &Builder, wanted: &[String]) -> Vec<usize> {
    let all = builder.document.list("materials").iter().enumerate();
    all.filter(|(index, material)| wanted.contains(&crate::materials::display_name(material, *index)))
        .map(|(index, _)| index)
        .collect()
}

/// Image and texture of a picture, sampled as the material samples its color.
fn add_texture(
    builder: &mut Builder,
    name: &str,
    bytes: &[u8],
    mime: &str,
    like: Option<usize>,
) -> Result<usize, CarrierError> {
    let sampler = like.and_then(|material| {
        let info = base_color_info(builder.document.item("materials", material)?)?;
        index_of(builder.document.item("textures", index_of(info, "index")?)?, "sampler")
    });
    let view = builder.view(name, bytes, Content::Picture)?;
    let image = builder.grow("images", json!({"bufferView": view, "mimeType": mime, "name": name}))?;
    let mut texture = json!({"source": image, "name": name});
    if let Some(sampler) = sampler {
        texture["sampler"] = sampler.into();
    }
    builder.grow("textures", texture)
}

/// The photograph of the leaf against the light, or what its tissue makes of white light.
fn color(
    builder: &mut Builder,
    layer: &Layer,
    sheet: &str,
    facts: &Value,
    users: &[usize],
) -> Result<Option<ColorLink>, CarrierError> {
    let name = format!("{sheet}/{}", names::PICTURE_COLOR);
    if let Some(picture) = layer.pictures.get(&name) {
        let mime = images::sniff(picture).gltf_mime().ok_or_else(|| {
            CarrierError::mismatch(&layer.record.room, &name, "is no PNG or JPEG", "convert the photograph to PNG")
        })?;
        let texture = view_name(&layer.record.room, &name);
        add_texture(builder, &texture, picture, mime, users.first().copied())?;
        return Ok(Some(ColorLink { estimate: false, factor: [1.0; 3], texture: Some(texture) }));
    }
    let factor: Option<Vec<f64>> =
        facts[names::FACT_COLOR_ESTIMATE].as_array().map(|a| a.iter().filter_map(Value::as_f64).collect());
    let factor = factor.and_then(|factor| <[f64; 3]>::try_from(factor).ok());
    Ok(factor.map(|factor| ColorLink { estimate: true, factor, texture: None }))
}

/// Puts the shown map into the materials.
fn show(
    builder: &mut Builder,
    links: &SheetLinks,
    users: &[usize],
    (texture, mean_scale): (usize, f64),
    facts: &Value,
) -> Result<(), CarrierError> {
    let color = links.color.as_ref().and_then(|color| color.texture.as_ref());
    let color = color.and_then(|name| {
        builder.document.list("textures").iter().rposition(|t| t.get("name").is_some_and(|n| n == name))
    });
    // What was divided by a mean is a share of light again times that.
    let mean = facts["maps"][&links.shown]["meanTransmission"].as_f64().unwrap_or(1.0);
    let factor = mean_scale * if facts["normalize"].as_str().is_none_or(|n| n == "none") { 1.0 } else { mean };
    for &material in users {
        let pointer = format!("/materials/{material}");
        let info = builder.document.item("materials", material).and_then(base_color_info);
        let placed = |index: usize| like(info, index);
        let mut value = json!({
            "diffuseTransmissionFactor": factor.clamp(0.0, 1.0),
            "diffuseTransmissionTexture": placed(texture),
        });
        match (&links.color, color) {
            (_, Some(color)) => value["diffuseTransmissionColorTexture"] = placed(color),
            (Some(link), None) => value["diffuseTransmissionColorFactor"] = json!(link.factor),
            (None, None) => {}
        }
        let extensions = builder.material_extensions(material)?;
        if extensions.contains_key(names::DIFFUSE_TRANSMISSION) {
            let text = format!(
                "the material has its own {}: its map is linked by {} alone",
                names::DIFFUSE_TRANSMISSION,
                names::EXTENSION
            );
            builder.findings.push(Finding::new(&code::NAME_TAKEN, text).at(format!("{pointer}/extensions")));
            continue;
        }
        extensions.insert(names::DIFFUSE_TRANSMISSION.into(), value);
        builder.use_extension(names::DIFFUSE_TRANSMISSION)?;
    }
    Ok(())
}

/// A texture info that lies as the base color does.
fn like(base_color: Option<&Value>, index: usize) -> Value {
    let mut info = json!({ "index": index });
    if let Some(set) = base_color.and_then(|info| info.get("texCoord")) {
        info["texCoord"] = set.clone();
    }
    if let Some(transform) = base_color.and_then(|info| info.get("extensions")?.get(MIRRORED)) {
        info["extensions"] = json!({ MIRRORED: transform });
    }
    info
}

impl Builder {
    /// Adds to a list at the root that not every layer lengthens, and notes how long it was: 0 where there was none.
    fn grow(&mut self, list: &str, item: Value) -> Result<usize, CarrierError> {
        let length = self.document.list(list).len();
        self.notes.lengths.entry(format!("/{list}")).or_insert(length);
        self.push(&[], list, item)
    }

    /// The extensions of a material, made where there are none.
    fn material_extensions(&mut self, material: usize) -> Result<&mut Map<String, Value>, CarrierError> {
        let pointer = format!("/materials/{material}");
        let fail =
            || CarrierError::input("base", pointer.clone(), "is no object, or its extensions are none", EXPORT_AGAIN);
        let list = self.document.json.get_mut("materials").and_then(|list| list.get_mut(material));
        let object = list.and_then(Value::as_object_mut).ok_or_else(fail)?;
        if !object.contains_key("extensions") {
            self.notes.created.push(format!("{pointer}/extensions"));
        }
        object.entry("extensions").or_insert_with(|| json!({})).as_object_mut().ok_or_else(fail)
    }
}
