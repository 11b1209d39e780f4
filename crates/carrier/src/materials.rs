//! What foliar needs of materials: base color, alpha, sides; and the base color textures, decoded.

use crate::accessor::Source;
use crate::container::read_uri;
use crate::document::index_of;
use crate::images::Format;
use crate::{CarrierError, images};
use foliar_plant::{AlphaMode, Material, Raster};
use foliar_schema::{Finding, Import, code};
use rayon::prelude::*;
use serde_json::Value;
use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

/// Materials and pictures of a document.
#[derive(Default)]
pub(crate) struct Surfaces {
    pub materials: Vec<Material>,
    pub rasters: Vec<Raster>,
}

/// An image that is still to be decoded.
struct Encoded {
    image: usize,
    name: String,
    bytes: Vec<u8>,
}

/// Reads all materials and decodes each base color image once.
pub(crate) fn read(
    source: Source,
    import: &Import,
    findings: &mut Vec<Finding>,
    files: &mut Vec<PathBuf>,
) -> Result<Surfaces, CarrierError> {
    let values = source.document.list("materials");
    let images: Vec<Option<usize>> = values.iter().map(|m| base_color_image(source, m, findings)).collect();
    let mut encoded: BTreeMap<usize, Encoded> = BTreeMap::new();
    for image in images.iter().flatten().copied() {
        if !encoded.contains_key(&image)
            && let Some(found) = load(source, image, import, findings, files)?
        {
            encoded.insert(image, found);
        }
    }
    let encoded: Vec<Encoded> = encoded.into_values().collect();
    let decoded: Vec<_> = encoded.par_iter().map(|e| (e.image, images::decode(&e.bytes, &e.name))).collect();
    let mut surfaces = Surfaces::default();
    let mut raster_of: BTreeMap<usize, u32> = BTreeMap::new();
    for (image, result) in decoded {
        match result {
            Ok(raster) => {
                raster_of.insert(image, surfaces.rasters.len() as u32);
                surfaces.rasters.push(raster);
            }
            Err(error) => findings.push(texture_finding(source, image, &error.to_string())),
        }
    }
    let rasters = images.iter().map(|image| image.and_then(|i| raster_of.get(&i).copied()));
    surfaces.materials = values.iter().zip(rasters).map(|(value, raster)| material(value, raster)).collect();
    Ok(surfaces)
}

fn texture_finding(source: Source, image: usize, problem: &str) -> Finding {
    let message = format!("{problem}; alpha not read, the part is treated as opaque");
    Finding::new(&code::IMPORT_TEXTURE, message).at(format!("/images/{image}")).in_file(source.file)
}

/// The name that links go by: its own, else its number in words.
pub(crate) fn display_name(material: &Value, index: usize) -> String {
    let own = material.get("name").and_then(Value::as_str).filter(|name| !name.is_empty());
    own.map_or_else(|| format!("material {index}"), String::from)
}

pub(crate) fn material(value: &Value, base_color_raster: Option<u32>) -> Material {
    let factor = value.pointer("/pbrMetallicRoughness/baseColorFactor").and_then(Value::as_array);
    let mut base_color = [1.0; 4];
    for (slot, number) in base_color.iter_mut().zip(factor.into_iter().flatten()) {
        *slot = number.as_f64().unwrap_or(1.0) as f32;
    }
    let cutoff = value.get("alphaCutoff").and_then(Value::as_f64).unwrap_or(0.5) as f32;
    Material {
        name: value.get("name").and_then(Value::as_str).map(str::to_string),
        base_color,
        base_color_raster,
        alpha_mode: match value.get("alphaMode").and_then(Value::as_str) {
            Some("MASK") => AlphaMode::Mask(cutoff),
            Some("BLEND") => AlphaMode::Blend,
            _ => AlphaMode::Opaque,
        },
        double_sided: value.get("doubleSided").and_then(Value::as_bool).unwrap_or(false),
    }
}

/// The texture info of a material's base color.
pub(crate) fn base_color_info(material: &Value) -> Option<&Value> {
    material.pointer("/pbrMetallicRoughness/baseColorTexture")
}

/// Index of the core image (PNG, JPEG) of a material's base color; a texture that only an extension
/// can read gives a finding.
fn base_color_image(source: Source, material: &Value, findings: &mut Vec<Finding>) -> Option<usize> {
    let texture = index_of(base_color_info(material)?, "index")?;
    let value = source.document.item("textures", texture)?;
    if let Some(image) = index_of(value, "source") {
        return Some(image);
    }
    let names: Vec<&str> =
        value.get("extensions").and_then(Value::as_object).into_iter().flatten().map(|(k, _)| k.as_str()).collect();
    let what = if names.is_empty() { "a texture without an image".into() } else { names.join(", ") };
    let message = format!("{what}: not decoded by this version; alpha not read, the part is treated as opaque");
    findings.push(Finding::new(&code::IMPORT_TEXTURE, message).at(format!("/textures/{texture}")).in_file(source.file));
    None
}

/// The bytes of an image. A file that is missing is a finding; a URI that leaves the asset is an error.
fn load(
    source: Source,
    image: usize,
    import: &Import,
    findings: &mut Vec<Finding>,
    files: &mut Vec<PathBuf>,
) -> Result<Option<Encoded>, CarrierError> {
    let Some(value) = source.document.item("images", image) else {
        return Err(source.fail(format!("/images/{image}"), "does not exist"));
    };
    let uri = value.get("uri").and_then(Value::as_str);
    let short = uri.filter(|u| !u.starts_with("data:"));
    let name = short.or_else(|| value.get("name").and_then(Value::as_str));
    let name = name.map_or_else(|| format!("/images/{image}"), str::to_string);
    let bytes = match (index_of(value, "bufferView"), uri) {
        (Some(view), _) => Ok(source.view(view)?.to_vec()),
        (None, Some(uri)) => {
            let folder = source.document.folder.as_deref().unwrap_or(Path::new(""));
            read_uri(uri, &format!("/images/{image}"), source.file, folder, import, files)
        }
        (None, None) => Err(source.fail(format!("/images/{image}"), "has neither uri nor bufferView")),
    };
    match bytes {
        Ok(bytes) if matches!(images::sniff(&bytes), Format::Webp | Format::Ktx) => {
            let message = "a WebP or KTX2 picture is not decoded by this version: convert it to PNG";
            findings.push(texture_finding(source, image, message));
            Ok(None)
        }
        Ok(bytes) => Ok(Some(Encoded { image, name, bytes })),
        Err(error @ CarrierError::Open { .. }) => {
            findings.push(texture_finding(source, image, &error.to_string()));
            Ok(None)
        }
        Err(error) => Err(error),
    }
}
