//! Pictures by the light room's bake, and by paths: one leaf alone, whose light is known, and a crown of two.

use super::{close, frontal, gray, middle};
use crate::leaf_light::PASSES;
use crate::{Shading, ViewError, ViewParams, camera, light_sheet, png_bytes, render, shade};
use foliar_bake::{Array, ColumnKey, Layer};
use foliar_plant::sample::{Quad, quads};
use foliar_plant::{Base, Plant};
use foliar_schema::Record;
use glam::{DVec3, Vec3};

/// Leaves in front of each other, facing the camera, of one color.
fn leaves(distances: &[f64], color: f32) -> Plant {
    let leaf = |&z: &f64| Quad { center: DVec3::Z * z, across: DVec3::X, along: DVec3::Y };
    let plant = quads(&distances.iter().map(leaf).collect::<Vec<_>>());
    let materials = vec![gray(color)];
    Plant::new(Base { materials, ..plant.base().clone() }, plant.structure().clone()).unwrap()
}

fn baked(depths: &[[f32; 8]]) -> Layer {
    let key = ColumnKey { class: "foliarLight".into(), property: "opticalDepth".into() };
    Layer {
        record: Record { room: "light".into(), version: 1, ..Record::default() },
        columns: [(key, Array::F32 { width: 8, data: depths.concat() })].into(),
        ..Layer::default()
    }
}

fn lit_from(azimuth: f64) -> ViewParams {
    ViewParams { width_px: 60, height_px: 60, sun_azimuth_deg: azimuth, sun_elevation_deg: 40.0, ..frontal() }
}

#[test]
fn a_leaf_alone_is_lit_as_its_closed_form_says_by_model_and_paths() {
    let (color, ground) = (0.05, Vec3::new(0.21, 0.20, 0.14));
    let (leaf, layer) = (leaves(&[0.0], color), baked(&[[0.0; 8]]));
    for azimuth in [20.0, 200.0] {
        let params = lit_from(azimuth);
        let cosine = camera::direction(azimuth, 40.0).z as f32;
        // Half of what each side sees is sky, half ground; the leaf passes a share of what falls on its back.
        let around = (shade::SKY + ground) / 2.0;
        let [front, back] = [cosine, -cosine].map(|c| shade::SUN * c.max(0.0) + around);
        let exact = color * (front + PASSES * back);
        let expected = crate::colors::to_bytes(exact, 1.0);
        let found = middle(&render(&leaf, &[&layer], &Shading::Light, &params).unwrap()).0;
        assert!(close(found, expected), "{azimuth}: {found:?}, not {expected:?}");
        let many = ViewParams { width_px: 16, height_px: 16, samples: 1024, ..params };
        let traced = middle(&render(&leaf, &[&layer], &Shading::Traced, &many).unwrap()).0;
        // 1,024 paths, each of which sees sky or ground.
        assert!(traced.iter().zip(expected).all(|(a, b)| a.abs_diff(b) <= 3), "{azimuth}: {traced:?} {expected:?}");
    }
}

#[test]
fn depth_darkens_the_model_and_a_leaf_in_front_the_paths() {
    let two = leaves(&[0.0, -0.4], 0.2);
    let one = leaves(&[0.0], 0.2);
    let params = ViewParams { samples: 64, width_px: 32, height_px: 32, ..lit_from(180.0) };
    let luma = |plant: &Plant, depth: f32, shading: &Shading| {
        let rows = vec![[depth; 8]; plant.leaves().len()];
        f32::from(middle(&render(plant, &[&baked(&rows)], shading, &params).unwrap()).0[1])
    };
    assert!(luma(&one, 2.0, &Shading::Light) < 0.8 * luma(&one, 0.0, &Shading::Light));
    // The sun shines from behind, through the second leaf.
    assert!(luma(&two, 0.0, &Shading::Traced) < 0.95 * luma(&one, 0.0, &Shading::Traced));
}

#[test]
fn what_was_not_baked_or_does_not_fit_is_said() {
    let leaf = leaves(&[0.0], 0.2);
    let error = render(&leaf, &[], &Shading::Light, &lit_from(0.0)).unwrap_err().to_string();
    assert!(error.contains("opticalDepth") && error.contains("bake it first"), "{error}");
    let error = render(&leaf, &[&baked(&[[0.0; 8]; 2])], &Shading::Light, &lit_from(0.0)).unwrap_err();
    assert!(matches!(&error, ViewError::Shape { found: 2, .. }), "{error}");
    let beside = crate::Standing { plant: leaf.clone(), layers: vec![], transform: glam::DAffine3::IDENTITY };
    let error = crate::render_among(&leaf, &[&baked(&[[0.0; 8]])], &[beside], &Shading::Traced, &lit_from(0.0));
    assert!(matches!(error, Err(ViewError::Neighbors)));
}

#[test]
fn a_sheet_shows_two_suns_and_threads_change_no_byte() {
    let (leaf, layer) = (leaves(&[0.0, -0.5], 0.2), baked(&[[0.3; 8]; 2]));
    let params = ViewParams { samples: 4, width_px: 24, height_px: 24, sun_azimuth_deg: 300.0, ..frontal() };
    let draw = |threads: usize| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        pool.install(|| png_bytes(&light_sheet(&leaf, &[&layer], &[], "two", &params).unwrap()).unwrap())
    };
    assert_eq!(draw(1), draw(3));
}
