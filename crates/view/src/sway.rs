//! The plant in wind: the same picture at several times.

use crate::camera::Camera;
use crate::frame::{Frame, Standing};
use crate::scene::Scene;
use crate::{Panel, Shading, ViewError, ViewParams, contact_sheet, render};
use foliar_bake::{Baker, Inputs, Layer, Maps, Quiet, resolve_params};
use foliar_plant::Plant;
use foliar_schema::{Strength, names};
use foliar_wind::noise::Field;
use foliar_wind::{Noise, Player, amplitude};
use glam::{DVec2, Vec3};
use image::RgbaImage;
use serde_json::Map;

/// Seconds between pictures of an animation, and between those of a sheet.
pub const FRAME_S: f64 = 1.0 / 24.0;
const SHEET_S: f64 = 0.8;
/// Mean push of the wind, as a share of its amplitude.
const PUSH: f64 = 0.3;
/// Where the wind blows to: across the default view.
const TOWARD: DVec2 = DVec2::new(0.8, -0.6);

/// `frames` pictures of the plant in wind, so many seconds apart; what stands around it stands still. The plant must have
/// its branches and `layers` the wind room's.
///
/// # Errors
/// [`ViewError::Channel`] where nothing was baked that moves; else as [`crate::render()`].
pub fn swaying(
    plant: &Plant,
    layers: &[&Layer],
    around: &[Standing],
    shading: &Shading,
    params: &ViewParams,
    (strength, frames, apart_s): (Strength, u32, f64),
) -> Result<Vec<RgbaImage>, ViewError> {
    params.check()?;
    let none = || ViewError::Channel { name: names::WIND_WEIGHTS.into(), known: "no wind: bake it first".into() };
    let layer = layers.iter().find(|layer| layer.record.room == names::ROOM_WIND).ok_or_else(none)?;
    let player = Player::new(plant, layer).ok_or_else(none)?;
    let noise = noise().ok_or_else(none)?;
    let at = |frame: u32| player.gust(amplitude(strength), f64::from(frame) * apart_s, TOWARD, PUSH);
    let still = Frame::around(plant, around);
    // One scene at a time: hundreds fill any memory.
    let each = |seen: &mut dyn FnMut(&Scene) -> Result<(), ViewError>| {
        (0..frames.max(1)).try_for_each(|frame| {
            let moved = player.moved_plant(&at(frame), &noise).ok_or_else(none)?;
            seen(&Scene::within(&still, (&moved, layers), around, (shading, None), None)?)
        })
    };
    // One camera for all, or the plant would stand still and the world sway.
    let (mut points, mut pictures): (Vec<Vec3>, Vec<RgbaImage>) = Default::default();
    each(&mut |scene| {
        points.extend(&scene.fitted);
        Ok(())
    })?;
    let camera = Camera::fit(points.iter().copied(), &still, params);
    each(&mut |scene| {
        pictures.push(render::draw(scene, camera, shading, params)?);
        Ok(())
    })?;
    Ok(pictures)
}

/// A sheet: weights of the levels, phases, and the plant in wind at several times.
///
/// # Errors
/// As [`swaying`].
pub fn sway_sheet(
    plant: &Plant,
    layers: &[&Layer],
    around: &[Standing],
    title: &str,
    params: &ViewParams,
) -> Result<RgbaImage, ViewError> {
    let mut panels = Vec::new();
    for (channel, caption) in [
        ("foliarBranch/level", "level of each branch"),
        (names::WIND_WEIGHTS, "weights of levels 1, 2, 3 as red, green, blue"),
        ("foliarWind/phase", "phase of each branch (first coordinate)"),
    ] {
        let picture = crate::render_among(plant, layers, around, &Shading::Channel(channel.into()), params)?;
        panels.push(Panel::new(caption, picture));
    }
    let times = swaying(plant, layers, around, &params.shading(), params, (Strength::Storm, 6, SHEET_S))?;
    for (index, picture) in times.into_iter().enumerate() {
        panels.push(Panel::new(format!("storm, {:.1} s", index as f64 * SHEET_S), picture));
    }
    Ok(contact_sheet(&panels, &[title.into()], 3))
}

/// The default texture.
fn noise() -> Option<Field> {
    let params = resolve_params(&Noise, &Map::new(), &Map::new()).ok()?;
    let inputs = Inputs { plant: None, maps: &Maps::new(), neighbors: &[] };
    let baked = Noise.bake(&inputs, &params, &Quiet).ok()?;
    Field::new(baked.rasters.values().next()?)
}

#[cfg(test)]
mod tests {
    use super::*;
    use foliar_bake::{Request, run};
    use foliar_plant::sample::Recipe;
    use foliar_wind::Wind;

    fn small() -> (Plant, Layer) {
        let plant = Recipe::small().grow();
        let inputs = Inputs { plant: Some(&plant), maps: &Maps::new(), neighbors: &[] };
        let layer = run(&Wind, &inputs, &Request::default(), &Quiet).unwrap().0;
        (plant, layer)
    }

    fn params() -> ViewParams {
        ViewParams { width_px: 80, height_px: 80, samples: 1, ..ViewParams::default() }
    }

    #[test]
    fn a_storm_moves_the_picture_and_still_air_does_not() {
        let (plant, layer) = small();
        let draw = |strength| swaying(&plant, &[&layer], &[], &Shading::Plain, &params(), (strength, 3, 0.7)).unwrap();
        let storm = draw(Strength::Storm);
        assert!(storm[0] != storm[1] && storm[1] != storm[2]);
        let still = draw(Strength::None);
        assert!(still[0] == still[2]);
        assert!(swaying(&plant, &[], &[], &Shading::Plain, &params(), (Strength::Storm, 2, 0.1)).is_err());
    }

    #[test]
    fn a_sheet_shows_levels_weights_phases_and_six_times() {
        let (plant, layer) = small();
        let branches = Layer {
            columns: [(
                foliar_bake::ColumnKey { class: names::CLASS_BRANCH.into(), property: "level".into() },
                foliar_bake::Array::integers(plant.branches().unwrap().rows.iter().map(|b| b.level as i32).collect()),
            )]
            .into(),
            ..Layer::default()
        };
        let sheet = sway_sheet(&plant, &[&layer, &branches], &[], "small", &params()).unwrap();
        assert!(sheet.width() > 3 * 80 && sheet.height() > 3 * 80);
    }
}
