//! OBJ materials as glTF materials.
//!
//! Rules: `Kd` is taken as linear (Blender and most modellers write their linear color without a
//! transfer curve) and counts only where no color texture does. Shininess becomes roughness as
//! 1 - sqrt(Ns / 1000), the inverse of what Blender writes; black `Ks` or no `Ns` is fully rough.
//! Nothing is metallic, everything is seen from both sides. Alpha in a texture cuts out at one half;
//! `d` below 1 without such a texture blends.

use super::library::{Defined, Libraries, Source};
use super::mtl::{Map, Material};
use super::textures::{Named, Textures};
use crate::CarrierError;
use foliar_schema::{Finding, code};
use serde_json::{Map as Object, Value, json};
use std::path::PathBuf;

/// Gray of a material of which nobody says a color.
const PLAIN: f64 = 0.8;

/// Largest shininess of an MTL.
const MOST_SHININESS: f64 = 1000.0;

/// Where a texture with alpha cuts out.
const ALPHA_CUTOFF: f64 = 0.5;

/// What a glTF material is made from; equal ones are one material.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Wanted {
    /// Name in the OBJ.
    pub name: Option<String>,
    /// Whether its meshes have texture coordinates.
    pub has_uvs: bool,
    /// Color texture that a person named instead.
    pub loose: Option<PathBuf>,
}

/// glTF materials in the making.
pub(crate) struct Materials<'a> {
    /// JSON of each, in the order of first use.
    pub json: Vec<Value>,
    /// Whether each has a normal map.
    pub normal_mapped: Vec<bool>,
    /// Pictures and images.
    pub textures: Textures,
    libraries: &'a Libraries,
    source: Source<'a>,
    wanted: Vec<Wanted>,
}

impl<'a> Materials<'a> {
    /// None yet.
    pub fn new(libraries: &'a Libraries, source: Source<'a>) -> Self {
        let (json, normal_mapped, wanted) = (Vec::new(), Vec::new(), Vec::new());
        Materials { json, normal_mapped, textures: Textures::default(), libraries, source, wanted }
    }

    /// Index of the glTF material.
    pub fn index(&mut self, wanted: Wanted) -> Result<usize, CarrierError> {
        if let Some(known) = self.wanted.iter().position(|w| *w == wanted) {
            return Ok(known);
        }
        let plain = Defined::default();
        let defined = wanted.name.as_ref().and_then(|n| self.libraries.materials.get(n)).unwrap_or(&plain);
        let mut made = self.without_textures(&wanted, &defined.material);
        let normal_mapped = self.add_textures(&mut made, &wanted, defined)?;
        self.json.push(Value::Object(made));
        self.normal_mapped.push(normal_mapped);
        self.wanted.push(wanted);
        Ok(self.json.len() - 1)
    }

    fn without_textures(&mut self, wanted: &Wanted, material: &Material) -> Object<String, Value> {
        let [red, green, blue] = material.kd.unwrap_or([PLAIN; 3]);
        let alpha = self.opacity(material);
        let mut made = Object::new();
        if let Some(name) = &wanted.name {
            made.insert("name".into(), json!(name));
        }
        let surface = json!({
            "baseColorFactor": [red, green, blue, alpha],
            "metallicFactor": 0.0,
            "roughnessFactor": roughness(material),
        });
        made.insert("pbrMetallicRoughness".into(), surface);
        if let Some(emitted) = material.ke.filter(|e| e.iter().any(|&c| c > 0.0)) {
            made.insert("emissiveFactor".into(), json!(emitted));
        }
        if alpha < 1.0 {
            made.insert("alphaMode".into(), json!("BLEND"));
        }
        made.insert("doubleSided".into(), json!(true));
        made
    }

    /// `d`; a material that would be invisible as a whole is taken for opaque, as exporters that
    /// leave opacity to `map_d` write `d 0`.
    fn opacity(&mut self, material: &Material) -> f64 {
        let opacity = material.opacity.unwrap_or(1.0);
        if opacity > 0.0 {
            return opacity;
        }
        if material.map_d.is_none() {
            let message = format!("material {:?} has opacity 0 and was taken for opaque", material.name);
            self.textures.findings.push(Finding::new(&code::IMPORT_MTL, message).at(format!("line {}", material.line)));
        }
        1.0
    }

    /// Adds color and normal textures; says whether there is a normal map.
    fn add_textures(
        &mut self,
        made: &mut Object<String, Value>,
        wanted: &Wanted,
        defined: &Defined,
    ) -> Result<bool, CarrierError> {
        let material = &defined.material;
        let name = wanted.name.as_deref().unwrap_or("");
        let color = match &wanted.loose {
            Some(path) => Some(Named { path: path.clone(), file: self.source.name.into(), place: "--texture".into() }),
            None => self.named(material.map_kd.as_ref(), defined)?,
        };
        let mask = self.named(material.map_d.as_ref(), defined)?;
        let norm = self.named(material.norm.as_ref(), defined)?;
        let bump = self.named(material.bump.as_ref(), defined)?;
        let any = [&color, &mask, &norm, &bump].into_iter().any(Option::is_some);
        if any && !wanted.has_uvs {
            let message = format!("material {name:?} has textures, but its faces have no texture coordinates");
            self.textures.findings.push(Finding::new(&code::IMPORT_TEXTURE, message).in_file(self.source.name));
        }
        if !any || !wanted.has_uvs {
            return Ok(false);
        }
        let [color, mask, norm, bump] =
            [color, mask, norm, bump].map(|named| named.filter(|n| self.textures.read(n, name)).map(|n| n.path));
        let factor = if color.is_some() { [1.0; 3] } else { material.kd.unwrap_or([1.0; 3]) };
        if let Some(image) = self.color_image(color, mask, name)? {
            self.set_color(made, image, factor);
        }
        let normal = self.normal_image(norm, bump, material, name)?;
        if let Some(image) = normal {
            made.insert("normalTexture".into(), json!({ "index": image }));
        }
        Ok(normal.is_some())
    }

    /// Where the picture of a map lies, with a finding where it is moved or scaled.
    fn named(&mut self, map: Option<&Map>, defined: &Defined) -> Result<Option<Named>, CarrierError> {
        let Some(map) = map else { return Ok(None) };
        if map.moved {
            let message = format!("{:?} is moved or scaled (-o, -s, -t): left out", map.file);
            let file = defined.library.display().to_string();
            let finding = Finding::new(&code::IMPORT_IGNORED, message).at(format!("line {}", map.line)).in_file(file);
            self.textures.findings.push(finding);
        }
        self.textures.locate(map, &defined.library, &self.source).map(Some)
    }

    /// Color with alpha: the picture as it is, unless another one holds the alpha.
    fn color_image(
        &mut self,
        color: Option<PathBuf>,
        mask: Option<PathBuf>,
        name: &str,
    ) -> Result<Option<usize>, CarrierError> {
        let textures = &mut self.textures;
        match (color, mask) {
            (None, None) => Ok(None),
            (Some(color), None) => textures.as_it_is(&color).map(Some),
            (Some(color), Some(mask)) if color == mask => {
                if !textures.has_alpha(&color) {
                    let message =
                        format!("map_d of material {name:?} is its color picture, which has no alpha: opaque");
                    let finding = Finding::new(&code::IMPORT_TEXTURE, message).in_file(color.display().to_string());
                    textures.findings.push(finding);
                }
                textures.as_it_is(&color).map(Some)
            }
            (color, Some(mask)) => textures.joined(color.as_deref(), &mask).map(Some),
        }
    }

    fn set_color(&self, made: &mut Object<String, Value>, image: usize, factor: [f64; 3]) {
        let [red, green, blue] = factor;
        let has_alpha = self.textures.images[image].has_alpha;
        let surface = &mut made["pbrMetallicRoughness"];
        // The texture's alpha stands for opacity; `d` beside it would count twice.
        let alpha = if has_alpha { json!(1.0) } else { surface["baseColorFactor"][3].clone() };
        surface["baseColorFactor"] = json!([red, green, blue, alpha]);
        surface["baseColorTexture"] = json!({ "index": image });
        if has_alpha {
            made.insert("alphaMode".into(), json!("MASK"));
            made.insert("alphaCutoff".into(), json!(ALPHA_CUTOFF));
        }
    }

    /// Normals: a picture under `norm`, or one under `bump` that is such, or made from heights.
    fn normal_image(
        &mut self,
        norm: Option<PathBuf>,
        bump: Option<PathBuf>,
        material: &Material,
        name: &str,
    ) -> Result<Option<usize>, CarrierError> {
        if let Some(path) = norm {
            return self.textures.as_it_is(&path).map(Some);
        }
        let Some(path) = bump else { return Ok(None) };
        let is_normal_map = self.textures.is_normal_map(&path);
        let what =
            if is_normal_map { "is a normal map and was taken as it is" } else { "holds heights and was made normals" };
        let message = format!("bump map of material {name:?} {what}");
        let finding = Finding::new(&code::IMPORT_BUMP, message).in_file(path.display().to_string());
        self.textures.findings.push(finding);
        if is_normal_map {
            return self.textures.as_it_is(&path).map(Some);
        }
        let strength = material.bump.as_ref().and_then(|b| b.strength).unwrap_or(1.0);
        self.textures.normals(&path, strength).map(Some)
    }
}

fn roughness(material: &Material) -> f64 {
    let black = material.ks.is_some_and(|ks| ks.iter().all(|&c| c <= 0.0));
    match material.ns {
        Some(ns) if !black => 1.0 - (ns.clamp(0.0, MOST_SHININESS) / MOST_SHININESS).sqrt(),
        _ => 1.0,
    }
}
