//! What each profile writes, and that nothing else changes.

use super::{PLACE, ambient, layers, leaves, master, soft};
use crate::{PackError, Packed, luft07, pack};
use foliar_carrier::Document;
use foliar_carrier::edit::{Stored, attribute};
use foliar_schema::{Engine, names};
use glam::{DVec3, Vec3};

/// Three roundings to f32 of numbers below 1: each off by 2^-25 at most, together well below this.
const ROUNDED: f64 = 2e-7;

pub fn stored(document: &Document, name: &str) -> Stored {
    attribute(document, PLACE, name).unwrap().unwrap_or_else(|| panic!("no {name}"))
}

pub fn vectors(stored: &Stored) -> Vec<DVec3> {
    assert!(stored.width >= 3);
    stored.values.chunks_exact(stored.width).map(|v| Vec3::from_slice(v).as_dvec3()).collect()
}

fn baked() -> Vec<DVec3> {
    soft(4).chunks_exact(3).map(|v| Vec3::from_slice(v).as_dvec3()).collect()
}

fn error<'a>(packed: &'a Packed, channel: &str) -> &'a crate::PackedAttribute {
    packed.report.attributes.iter().find(|a| a.channel == channel).unwrap()
}

#[test]
fn core_holds_the_realigned_normal_and_the_coefficient_as_a_color() {
    let packed = pack(&master(&leaves(), 4), Engine::Core).unwrap();
    let (normals, color) = (stored(&packed.document, "NORMAL"), stored(&packed.document, "COLOR_0"));
    for (found, wanted) in vectors(&normals).into_iter().zip(baked()) {
        assert!((found - wanted).length() <= ROUNDED && (found.length() - 1.0).abs() <= ROUNDED, "{found} {wanted}");
    }
    assert_eq!((color.width, color.component), (3, 5121));
    for (found, k) in vectors(&color).into_iter().zip(ambient(16)) {
        assert!((found - f64::from(k)).abs().max_element() <= 0.5 / 255.0 + ROUNDED, "{found} for {k}");
        assert!(found.max_element() <= 1.0 && found.min_element() > 0.0);
    }
    let report = error(&packed, names::AMBIENT);
    // Rounding to bytes: no vertex is off by more than half a step, and few are exact.
    assert!(report.max_steps <= 0.5 + 1e-4 && report.rms_steps > 0.05, "{report:?}");
    assert_eq!((report.bytes_per_vertex, report.stored.as_str()), (4, "3 x u8"));
    assert!(error(&packed, names::SOFT_NORMAL).max_steps < 1e-4);
}

#[test]
fn the_rest_of_the_base_comes_through_and_the_file_grows_by_the_color_alone() {
    let asset = master(&leaves(), 4);
    let packed = pack(&asset, Engine::Core).unwrap().document;
    assert_eq!(stored(&packed, "POSITION"), stored(&asset.document, "POSITION"));
    let (before, after) = (asset.document.buffers[0].len(), packed.buffers[0].len());
    // Eight triangles of three 16-bit indices; a cut leaves up to 8 bytes, and both ends are padded.
    let wanted = before + 16 * 4 + 8 * 3 * 2;
    assert!((wanted..=wanted + 16).contains(&after), "four bytes per vertex, six per triangle: {after}, {wanted}");
    assert_eq!(packed.list("accessors").len(), asset.document.list("accessors").len() + 1);
    let text = packed.json.to_string();
    for gone in [names::EXTENSION, names::AMBIENT, names::SOFT_NORMAL, names::FEATURE_ID_PREFIX, names::CLASS_LEAF] {
        assert!(!text.contains(gone), "{gone} in {text}");
    }
    assert_eq!(packed.json["asset"]["extras"][names::PACKED]["engine"], "core");
}

#[test]
fn a_color_of_the_base_is_multiplied_in_its_own_precision_and_keeps_its_alpha() {
    for (component, normalized) in [(5121, true), (5123, true), (5126, false)] {
        for width in [3, 4] {
            let mut file = leaves();
            let own = |at: usize| if at % width == 3 { 0.6 } else { 0.2 + 0.05 * (at % 16) as f32 };
            let values: Vec<f32> = (0..16 * width).map(own).collect();
            let bytes: Vec<u8> = match component {
                // Rows of four bytes, as alignment wants: a VEC3 of bytes needs a stride.
                5121 if width == 3 => continue,
                5121 => values.iter().map(|v| (v * 255.0).round() as u8).collect(),
                5123 if width == 3 => continue,
                5123 => values.iter().flat_map(|v| ((v * 65_535.0).round() as u16).to_le_bytes()).collect(),
                _ => values.iter().flat_map(|v| v.to_le_bytes()).collect(),
            };
            file.stored("COLOR_0", width, component, normalized, &bytes, 16);
            let asset = master(&file, 4);
            let before = stored(&asset.document, "COLOR_0");
            let packed = pack(&asset, Engine::Core).unwrap();
            let after = stored(&packed.document, "COLOR_0");
            assert_eq!((after.component, after.width), (u64::from(component), width));
            let step = match component {
                5121 => 0.5 / 255.0,
                5123 => 0.5 / 65_535.0,
                _ => 0.0,
            };
            for (at, (found, base)) in after.values.iter().zip(&before.values).enumerate() {
                let factor = if at % width == 3 { 1.0 } else { f64::from(ambient(16)[at / width]) };
                let wanted = f64::from(*base) * factor;
                assert!((f64::from(*found) - wanted).abs() <= step + ROUNDED, "{component} {width}: {found} {wanted}");
            }
            assert_eq!(packed.report.added_bytes_per_vertex, 0, "in place");
        }
    }
}

#[test]
fn tangents_stay_at_right_angles_and_follow_the_texture() {
    let mut file = leaves();
    file.attribute("TANGENT", 4, &[1.0, 0.0, 0.0, -1.0].repeat(16));
    let packed = pack(&master(&file, 4), Engine::Core).unwrap().document;
    let (normals, tangents) = (vectors(&stored(&packed, "NORMAL")), stored(&packed, "TANGENT"));
    for (v, normal) in normals.into_iter().enumerate() {
        let t = &tangents.values[4 * v..4 * v + 4];
        let tangent = Vec3::from_slice(t).as_dvec3();
        assert!((tangent.length() - 1.0).abs() <= ROUNDED && normal.dot(tangent).abs() <= ROUNDED);
        assert!(tangent.dot(DVec3::X) > 0.5, "it still goes along u");
        // The base's bitangent: cross(z, x) * -1 = -y.
        let bitangent = normal.cross(tangent) * f64::from(t[3]);
        assert!((t[3].abs() - 1.0).abs() <= 0.0 && bitangent.dot(-DVec3::Y) > 0.5, "and {bitangent} along v");
    }
}

#[test]
fn a_tangent_along_the_new_normal_finds_another_way() {
    let x = DVec3::X;
    let made = crate::tangents::realigned(&[1.0, 0.0, 0.0, 1.0], DVec3::Z, x);
    let tangent = Vec3::from_slice(&made).as_dvec3();
    assert!((tangent.length() - 1.0).abs() <= ROUNDED && tangent.dot(x).abs() <= ROUNDED);
    assert!((x.cross(tangent) * f64::from(made[3]) - DVec3::Y).length() <= ROUNDED, "the bitangent stays");
    let lost = crate::tangents::realigned(&[0.0, 0.0, 0.0, 1.0], DVec3::Z, x);
    assert!((Vec3::from_slice(&lost).length() - 1.0).abs() <= 1e-6);
}

fn again(document: &Document) -> foliar_carrier::Asset {
    let glb = document.to_glb().unwrap();
    foliar_carrier::read_bytes(glb, "packed.glb", std::path::Path::new(""), &Default::default()).unwrap()
}

/// Triangles with their first corner first, sorted: whatever order they stand in.
fn wound(asset: &foliar_carrier::Asset) -> Vec<[u32; 3]> {
    let turned = |t: &[u32; 3]| {
        let first = (0..3).min_by_key(|i| t[*i]).unwrap();
        [t[first], t[(first + 1) % 3], t[(first + 2) % 3]]
    };
    let mut list: Vec<[u32; 3]> = asset.base.parts[0].triangles.iter().map(turned).collect();
    list.sort_unstable();
    list
}

#[test]
fn two_sided_leaves_become_two_sheets_and_neither_has_a_back_to_be_turned_over() {
    let asset = master(&leaves(), 4);
    let packed = pack(&asset, Engine::Core).unwrap();
    assert_eq!(packed.report.added_triangles, 8);
    let again = again(&packed.document);
    assert!(!again.base.materials[0].double_sided);
    let front = wound(&asset);
    let mut both = front.clone();
    both.extend(front.iter().map(|[a, b, c]| [*a, *c, *b]));
    both.sort_unstable();
    assert_eq!(wound(&again), both);
    assert_eq!(again.base.parts[0].positions, asset.base.parts[0].positions, "over the same vertices");
}

#[test]
fn one_sided_leaves_stay_as_they_are() {
    let mut file = leaves();
    file.json["materials"][0]["doubleSided"] = false.into();
    let asset = master(&file, 4);
    let packed = pack(&asset, Engine::Core).unwrap();
    assert_eq!(packed.report.added_triangles, 0);
    assert_eq!(again(&packed.document).base.parts[0].triangles, asset.base.parts[0].triangles);
}

#[test]
fn a_material_that_others_need_two_sided_is_copied() {
    let mut file = leaves();
    let other = file.primitive().clone();
    file.primitive()["extensions"]["KHR_materials_variants"]["mappings"] =
        serde_json::json!([{"material": 0, "variants": [0]}]);
    file.json["meshes"][0]["primitives"].as_array_mut().unwrap().push(other);
    let packed = pack(&master(&file, 4), Engine::Core).unwrap().document;
    let [first, second] = [0, 1].map(|p| packed.json["meshes"][0]["primitives"][p].clone());
    assert_eq!((&first["material"], &second["material"]), (&1.into(), &0.into()));
    assert_eq!(first["extensions"]["KHR_materials_variants"]["mappings"][0]["material"], 1);
    let sides: Vec<_> = packed.list("materials").iter().map(|m| m["doubleSided"].as_bool()).collect();
    assert_eq!(sides, [Some(true), None]);
    assert_eq!(packed.json["materials"][0]["name"], packed.json["materials"][1]["name"]);
}

#[test]
fn blender_gets_floats_of_one_width_with_z_up() {
    let packed = pack(&master(&leaves(), 4), Engine::Blender).unwrap();
    let document = &packed.document;
    for name in [names::AMBIENT, names::SOFT_NORMAL_ZUP, names::PACKED_LEAF_ID] {
        let found = stored(document, name);
        assert_eq!((found.width, found.component), (3, 5126), "{name}");
    }
    for (found, n) in vectors(&stored(document, names::SOFT_NORMAL_ZUP)).into_iter().zip(baked()) {
        assert!((found - DVec3::new(n.x, -n.z, n.y)).length() <= ROUNDED);
    }
    let ambient_of = stored(document, names::AMBIENT).values;
    assert!(ambient_of.chunks(3).zip(ambient(16)).all(|(v, k)| v == [k; 3]), "exactly");
    let ids = stored(document, names::PACKED_LEAF_ID).values;
    assert!(ids.chunks(3).enumerate().all(|(v, id)| id == [(v / 4) as f32; 3]));
    assert_eq!(stored(document, "NORMAL"), stored(&master(&leaves(), 4).document, "NORMAL"));
    assert!(packed.report.attributes.iter().all(|a| a.max_steps < 1e-4), "{:?}", packed.report);
    assert_eq!(packed.report.added_bytes_per_vertex, 36);
}

#[test]
fn blender_loses_attributes_that_would_make_it_fail_and_says_so() {
    let mut file = leaves();
    file.attribute("_AGE", 1, &[1.0; 16]);
    file.attribute("_WIND", 3, &[1.0; 48]);
    let packed = pack(&master(&file, 4), Engine::Blender).unwrap();
    let names = foliar_carrier::edit::attribute_names(&packed.document, PLACE);
    assert!(!names.contains(&"_AGE".into()) && names.contains(&"_WIND".into()), "{names:?}");
    assert_eq!(packed.findings.len(), 1);
    assert!(packed.findings[0].message.contains("_AGE") && !packed.findings[0].message.contains("_WIND"));
}

#[test]
fn luft07_is_as_long_as_the_coefficient_and_never_without_direction() {
    let mut coefficients = ambient(16);
    coefficients[3] = 0.0;
    let mut asset = leaves().read();
    asset.layers = layers(4, Some(coefficients.clone()), Some(soft(4)));
    let packed = pack(&asset, Engine::Luft07).unwrap();
    let found = vectors(&stored(&packed.document, names::NORMAL_AMBIENT));
    for ((vector, k), normal) in found.into_iter().zip(coefficients).zip(baked()) {
        assert!((vector.length() - f64::from(k).max(luft07::SHORTEST)).abs() <= ROUNDED);
        assert!((vector.normalize() - normal).length() <= ROUNDED);
    }
    assert_eq!(stored(&packed.document, "NORMAL"), stored(&asset.document, "NORMAL"));
}

#[test]
fn one_channel_is_enough_and_none_is_refused_with_the_remedy() {
    let mut asset = leaves().read();
    asset.layers = layers(4, Some(ambient(16)), None);
    let only_ambient = pack(&asset, Engine::Core).unwrap().document;
    assert_eq!(stored(&only_ambient, "NORMAL"), stored(&asset.document, "NORMAL"));
    asset.layers = layers(4, None, Some(soft(4)));
    let only_soft = pack(&asset, Engine::Core).unwrap().document;
    assert!(attribute(&only_soft, PLACE, "COLOR_0").unwrap().is_none());
    asset.layers = layers(4, None, None);
    let error = pack(&asset, Engine::Core).unwrap_err();
    assert!(matches!(error, PackError::NoLeaves) && error.to_string().contains("--leaf"), "{error}");
    asset.layers.pop();
    let error = pack(&asset, Engine::Core).unwrap_err();
    assert!(matches!(error, PackError::NothingBaked) && error.to_string().contains("foliar-density"), "{error}");
    let error = pack(&again(&only_soft), Engine::Blender).unwrap_err();
    assert!(matches!(&error, PackError::AlreadyPacked { engine } if engine == "core"), "{error}");
}

#[test]
fn a_layer_of_another_base_is_refused() {
    let mut asset = leaves().read();
    asset.layers = layers(4, Some(ambient(15)), None);
    let error = pack(&asset, Engine::Core).unwrap_err();
    assert!(error.to_string().contains("15") && error.to_string().contains("16"), "{error}");
}
