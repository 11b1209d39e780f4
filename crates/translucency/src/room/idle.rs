//! Parameters and maps that have no say beside the others.

use super::finding;
use super::params::{Bands, Params, Sides, ThicknessFrom};
use crate::map::Spreading;
use foliar_bake::{FloatRaster, Idle, Maps};
use foliar_schema::{Finding, code, names};

/// Parameters of which nothing is read.
pub(super) fn params(params: &Params, maps: &Maps) -> Vec<Idle> {
    let dark = of_the_dark(params.sides);
    let has = |names: &[&str]| names.iter().any(|name| maps.contains_key(*name) && !dark.contains(name));
    let photo = params.thickness_from == ThicknessFrom::Photo;
    let own = params.absorption.is_some() && params.reduced_scattering.is_some();
    let tissue = own || !params.layer.is_empty() || params.fit_rt.is_some();
    let rules: [(bool, &'static [&'static str], &'static str); 10] = [
        // Of all kinds the index of refraction is the same.
        (tissue && !photo && !has(&[names::MAP_ALBEDO]), &["preset"], "the tissue is given"),
        (params.bands == Bands::Rgb, &["wavelength_nm"], "bands = rgb bakes 610, 550 and 450 nm"),
        (params.spread == Spreading::None, &["filters"], "spread = none has no filters"),
        (!photo, &["veins", "thickness_mean_mm"], "it is for thickness_from = photo"),
        (
            photo,
            &["thickness_scale_mm", "thickness_offset_mm"],
            "a photograph holds no thickness; thickness_mean_mm says its mean",
        ),
        (!has(&[names::MAP_HEIGHT_FRONT, names::MAP_HEIGHT_BACK]), &["height_scale_mm"], "no map of heights is given"),
        (!has(&[names::MAP_NORMAL_BACK]), &["normal_frame"], "no normal map of the back is given"),
        (!has(&[names::MAP_NORMAL_FRONT, names::MAP_NORMAL_BACK]), &["normal_y"], "no normal map is given"),
        (!params.layer.is_empty(), &["anisotropy"], "each layer says its own"),
        (params.embed_all, &["exr"], "embed_all writes no EXR"),
    ];
    rules.into_iter().flat_map(|(idle, params, because)| Idle::where_holds(idle, params, because)).collect()
}

/// Maps of the side that no light falls on.
fn of_the_dark(sides: Sides) -> &'static [&'static str] {
    match sides {
        Sides::Both => &[],
        Sides::Front => &[names::MAP_NORMAL_FRONT, names::MAP_HEIGHT_FRONT],
        Sides::Back => &[names::MAP_NORMAL_BACK, names::MAP_HEIGHT_BACK],
    }
}

/// What is said of maps that nothing reads, and of colors where one number a texel is read.
pub(super) fn maps(params: &Params, maps: &Maps) -> Vec<Finding> {
    let (shown, lit) = if params.sides == Sides::Front { ("front", "back") } else { ("back", "front") };
    let message =
        format!("was not read: sides = {shown} bakes what is seen on the {shown}, which is lit from the {lit}");
    let unused = of_the_dark(params.sides).iter().filter(|name| maps.contains_key(**name));
    let unused = unused.map(|name| finding(&code::MAP_UNUSED, name, message.clone()));
    let gray = [names::MAP_THICKNESS, names::MAP_ALPHA, names::MAP_HEIGHT_FRONT, names::MAP_HEIGHT_BACK];
    let photo = params.thickness_from == ThicknessFrom::Photo;
    let read = gray.into_iter().filter(|name| !(photo && *name == names::MAP_THICKNESS));
    let colored = read.filter(|name| maps.get(*name).is_some_and(|map| has_colors(&map.raster)));
    let red = "its channels differ, and red alone is read: one channel holds what it should";
    unused.chain(colored.map(|name| finding(&code::MAP_COLOR, name, red.into()))).collect()
}

/// More than a step of 8 bits: gray that was a JPEG has differences of one.
fn has_colors(raster: &FloatRaster) -> bool {
    let channels = raster.channels as usize;
    let differs = |texel: &[f32]| texel[1..3].iter().any(|v| (v - texel[0]).abs() > 1.5 / 255.0);
    channels > 2 && raster.data.chunks_exact(channels).any(differs)
}
