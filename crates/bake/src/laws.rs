//! The laws of the house that can be tested in memory: 2 (own room), 4 (repeatable), 5 (meets its
//! reference), 6 (in range), 7 (defaults agree), 8 (frame-free). Each room's tests walk them over a list
//! of odd plants. Laws 1, 3 and 9 need bytes and are tested at the top of the workspace.

use crate::reframe::{Permutation, permuted, scaled, translated};
use crate::{Array, Baker, Inputs, Layer, Maps, Quiet, Request, Rung, run};
use foliar_plant::sample::Sample;
use foliar_plant::{Place, Plant};
use foliar_schema::{CHANNELS, COLUMNS, Channel, Column, channel};
use serde_json::{Map, Value};

/// A law that does not hold, and where.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[error("law {law} is broken by {room} on plant {plant:?}: {what}")]
pub struct Breach {
    /// Which law: number and name.
    pub law: &'static str,
    /// The room.
    pub room: String,
    /// Name of the plant.
    pub plant: String,
    /// What was found and what would be right.
    pub what: String,
}

/// A law: holds for a baker and a plant, or says why not.
pub type Law = fn(&dyn Baker, &Sample) -> Result<(), Breach>;

/// Every law that can be tested in memory, by name.
pub const LAWS: &[(&str, Law)] = &[
    (OWN_ROOM, own_room),
    (REPEATABLE, repeatable),
    (MEETS_REFERENCE, meets_reference),
    (IN_RANGE, in_range),
    (DEFAULTS_AGREE, defaults_agree),
    (ORDER_FREE, order_free),
    (TRANSLATION_FREE, translation_free),
    (UNIT_FREE, unit_free),
];

const OWN_ROOM: &str = "2 (own room)";
const REPEATABLE: &str = "4 (repeatable)";
const MEETS_REFERENCE: &str = "5 (meets its reference)";
const IN_RANGE: &str = "6 (in range)";
const DEFAULTS_AGREE: &str = "7 (defaults agree)";
const ORDER_FREE: &str = "8 (frame-free: order)";
const TRANSLATION_FREE: &str = "8 (frame-free: translation)";
const UNIT_FREE: &str = "8 (frame-free: unit)";

/// Thread counts that must give the same bytes.
const THREADS: [usize; 3] = [1, 2, 5];
/// How far a change of order, origin or unit may move a value, in visible steps. Sums in another order
/// and centers rounded elsewhere move f32 results by some 1e-6; a tenth of what can be seen is far above.
const FRAME_STEPS: f64 = 0.1;

/// A test for each law, over the plants that an expression gives: `foliar_bake::law_tests!(Wind, odd_plants());`
#[macro_export]
macro_rules! law_tests {
    ($baker:expr, $samples:expr) => {
        $crate::law_tests! { @each $baker, $samples;
            law_2_own_room own_room,
            law_4_repeatable repeatable,
            law_5_meets_its_reference meets_reference,
            law_6_in_range in_range,
            law_7_defaults_agree defaults_agree,
            law_8_order_free order_free,
            law_8_translation_free translation_free,
            law_8_unit_free unit_free
        }
    };
    (@each $baker:expr, $samples:expr; $($test:ident $law:ident),*) => {
        const _: () = assert!($crate::laws::LAWS.len() == [$(stringify!($law)),*].len(), "a law has no test");
        $(
            #[test]
            fn $test() {
                $crate::laws::hold($crate::laws::$law, &$baker, &$samples);
            }
        )*
    };
}

/// Demands that a law holds on every plant: what a test calls.
///
/// # Panics
/// With every [`Breach`], a line each.
pub fn hold(law: Law, baker: &dyn Baker, samples: &[Sample]) {
    let breaches = samples.iter().filter_map(|sample| law(baker, sample).err());
    let lines: Vec<String> = breaches.map(|breach| breach.to_string()).collect();
    assert!(lines.is_empty(), "{}", lines.join("\n"));
}

/// Walks every law over every plant and returns all breaches.
pub fn check_all(baker: &dyn Baker, samples: &[Sample]) -> Vec<Breach> {
    let walk =
        |(_, holds): &(&str, Law)| samples.iter().filter_map(|sample| holds(baker, sample).err()).collect::<Vec<_>>();
    LAWS.iter().flat_map(walk).collect()
}

/// Law 2: a room writes only the channels and columns that the contract gives it, and only on parts of the
/// roles that a channel applies to, one row for each vertex.
///
/// # Errors
/// [`Breach`].
pub fn own_room(baker: &dyn Baker, sample: &Sample) -> Result<(), Breach> {
    let breach = breaches(OWN_ROOM, baker, sample);
    let layer = layer(baker, &sample.plant, &Map::new()).map_err(&breach)?;
    for (key, array) in &layer.attributes {
        let owned = CHANNELS.iter().find(|c| c.name == key.name && c.room == baker.room());
        let part = sample.plant.parts().iter().position(|p| p.place == key.place);
        let (Some(channel), Some(part)) = (owned, part) else {
            return Err(breach(format!("{} at {:?} is not this room's to write", key.name, key.place)));
        };
        let (role, vertices) = (sample.plant.role(part), sample.plant.parts()[part].positions.len());
        if !channel.roles.contains(&role) || array.rows() != vertices {
            return Err(breach(format!(
                "{} has {} rows on a part of {vertices} vertices, role {role}",
                key.name,
                array.rows()
            )));
        }
    }
    let foreign = |c: &&crate::ColumnKey| {
        !COLUMNS.iter().any(|o| o.class == c.class && o.name == c.property && o.room == baker.room())
    };
    match layer.columns.keys().find(foreign) {
        Some(key) => Err(breach(format!("{}/{} is not this room's to write", key.class, key.property))),
        None => Ok(()),
    }
}

/// Law 4: the same bytes on every run and for any thread count.
///
/// # Errors
/// [`Breach`].
pub fn repeatable(baker: &dyn Baker, sample: &Sample) -> Result<(), Breach> {
    let breach = breaches(REPEATABLE, baker, sample);
    for (rung, params) in settings(baker) {
        let first = layer(baker, &sample.plant, &params).map_err(&breach)?;
        for threads in THREADS {
            let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build();
            let pool = pool.map_err(|error| breach(format!("no pool of {threads} threads: {error}")))?;
            let again = pool.install(|| layer(baker, &sample.plant, &params)).map_err(&breach)?;
            if again.content_hash() != first.content_hash() || again.record != first.record {
                return Err(breach(format!("{rung}: {threads} threads give another layer")));
            }
        }
    }
    Ok(())
}

/// Law 5: at each rung of the ladder, every channel is within the error that the rung promises.
///
/// # Errors
/// [`Breach`].
pub fn meets_reference(baker: &dyn Baker, sample: &Sample) -> Result<(), Breach> {
    let breach = breaches(MEETS_REFERENCE, baker, sample);
    let maps = Maps::new();
    for rung in baker.ladder() {
        let layer = layer(baker, &sample.plant, &rung.params).map_err(&breach)?;
        let params = crate::resolve_params(baker, &Map::new(), &rung.params).map_err(|e| breach(e.to_string()))?;
        let inputs = Inputs { plant: Some(&sample.plant), maps: &maps, neighbors: &[] };
        let reference = baker.reference(&inputs, &params).map_err(|e| breach(e.to_string()))?;
        if !layer.attributes.keys().eq(reference.attributes.keys()) {
            return Err(breach(format!("rung {}: reference and bake write different channels", rung.name)));
        }
        if let Some(off) = rasters_off(&layer, &reference) {
            let within = off.1 <= rung.promise_steps;
            if !within {
                return Err(breach(format!("rung {}: raster {} is off by {} steps rms", rung.name, off.0, off.1)));
            }
        }
        for name in &layer.record.writes {
            let pairs =
                layer.attributes.iter().zip(reference.attributes.values()).filter(|((key, _), _)| key.name == *name);
            let Some(channel) = channel(name) else { continue };
            let errors = pairs.flat_map(|((_, a), b)| steps(channel, a, b));
            kept(&rung, name, errors.collect()).map_err(&breach)?;
        }
        for (key, array) in &layer.columns {
            let exact = reference.columns.get(key);
            let Some((column, exact)) = foliar_schema::column(&key.class, &key.property).zip(exact) else { continue };
            kept(&rung, &key.property, column_steps(column, array, exact)).map_err(&breach)?;
        }
    }
    Ok(())
}

/// Whether a rung's promise is kept by these errors, visible steps.
fn kept(rung: &Rung, name: &str, errors: Vec<f64>) -> Result<(), String> {
    let rms = foliar_numerics::ErrorStats::of(errors).rms;
    if rms.is_nan() || rms > rung.promise_steps {
        return Err(format!("rung {}: {name} is off by {rms} steps rms, promised {}", rung.name, rung.promise_steps));
    }
    Ok(())
}

/// The raster that differs most from the reference, in its steps, rms; not-a-number where one is missing.
fn rasters_off(layer: &Layer, reference: &crate::Baked) -> Option<(String, f64)> {
    let off = |(name, exact): (&String, &crate::FloatRaster)| {
        let step = foliar_schema::raster(name).map_or(f64::NAN, |info| info.visible_step);
        let fast = layer.rasters.get(name).filter(|fast| fast.data.len() == exact.data.len());
        let errors = fast.map(|fast| fast.data.iter().zip(&exact.data).map(|(a, b)| f64::from(a - b) / step));
        (
            name.clone(),
            errors.map_or(f64::NAN, |errors| foliar_numerics::ErrorStats::of(errors.collect::<Vec<_>>()).rms),
        )
    };
    reference.rasters.iter().map(off).max_by(|a, b| a.1.total_cmp(&b.1))
}

/// Law 6: nothing that is no number, nothing outside a channel's declared range, facts included.
///
/// # Errors
/// [`Breach`].
pub fn in_range(baker: &dyn Baker, sample: &Sample) -> Result<(), Breach> {
    let breach = breaches(IN_RANGE, baker, sample);
    for (rung, params) in settings(baker) {
        // `run` itself refuses attributes and columns out of range.
        let layer = layer(baker, &sample.plant, &params).map_err(&breach)?;
        if let Some((name, _)) = layer.record.facts.iter().find(|(_, value)| value.is_null()) {
            return Err(breach(format!("{rung}: fact {name} is no finite number")));
        }
    }
    Ok(())
}

/// The defaults and every rung of the ladder, by name.
fn settings(baker: &dyn Baker) -> Vec<(&'static str, Map<String, Value>)> {
    let rungs = baker.ladder().into_iter().map(|rung| (rung.name, rung.params));
    std::iter::once(("defaults", Map::new())).chain(rungs).collect()
}

/// Law 7: no parameters, and every default said aloud, mean the same.
///
/// # Errors
/// [`Breach`].
pub fn defaults_agree(baker: &dyn Baker, sample: &Sample) -> Result<(), Breach> {
    let breach = breaches(DEFAULTS_AGREE, baker, sample);
    let silent = layer(baker, &sample.plant, &Map::new()).map_err(&breach)?;
    // From the schema itself: what resolves parameters is under test here.
    let schema = baker.schema();
    let properties = schema["properties"].as_object().into_iter().flatten();
    let defaults: Map<String, Value> = properties
        .map(|(name, property)| (name.clone(), property["default"].clone()))
        .filter(|(_, value)| !value.is_null())
        .collect();
    let aloud = layer(baker, &sample.plant, &defaults).map_err(&breach)?;
    if silent.content_hash() != aloud.content_hash() || silent.record.resolved != aloud.record.resolved {
        return Err(breach("defaults said aloud give another layer".into()));
    }
    Ok(())
}

/// Law 8: renumbering vertices and leaves permutes the result.
///
/// # Errors
/// [`Breach`].
pub fn order_free(baker: &dyn Baker, sample: &Sample) -> Result<(), Breach> {
    let other = permuted(&sample.plant);
    let renumbered = |place: Option<Place>, array: &Array| {
        let part = place.and_then(|place| sample.plant.parts().iter().position(|p| p.place == place));
        let vertices = part.map_or(0, |p| sample.plant.parts()[p].positions.len());
        let rows = if place.is_some() { vertices } else { sample.plant.leaves().len() };
        Permutation::of(rows).apply(array)
    };
    same_after(ORDER_FREE, baker, sample, other, renumbered)
}

/// Law 8: a move of the plant changes nothing.
///
/// # Errors
/// [`Breach`].
pub fn translation_free(baker: &dyn Baker, sample: &Sample) -> Result<(), Breach> {
    same_after(TRANSLATION_FREE, baker, sample, translated(&sample.plant), |_, array| array.clone())
}

/// Law 8: a change of unit changes nothing that is not a length.
///
/// # Errors
/// [`Breach`].
pub fn unit_free(baker: &dyn Baker, sample: &Sample) -> Result<(), Breach> {
    same_after(UNIT_FREE, baker, sample, scaled(&sample.plant), |_, array| array.clone())
}

/// Bakes the plant and its changed copy; channels without a unit must agree, and columns of leaves that are
/// seen. `map` gives an array of a place, or of a column, in the copy's order.
fn same_after(
    law: &'static str,
    baker: &dyn Baker,
    sample: &Sample,
    changed: Result<Plant, foliar_plant::PlantError>,
    map: impl Fn(Option<Place>, &Array) -> Array,
) -> Result<(), Breach> {
    let breach = breaches(law, baker, sample);
    let changed = changed.map_err(|error| breach(error.to_string()))?;
    let before = layer(baker, &sample.plant, &Map::new()).map_err(&breach)?;
    let after = layer(baker, &changed, &Map::new()).map_err(&breach)?;
    if !before.attributes.keys().eq(after.attributes.keys()) {
        return Err(breach("other channels were written".into()));
    }
    for ((key, a), b) in before.attributes.iter().zip(after.attributes.values()) {
        let Some(channel) = channel(&key.name) else { continue };
        stays(&key.name, &steps(channel, &map(Some(key.place), a), b)).map_err(&breach)?;
    }
    for (key, a) in &before.columns {
        let (column, b) = (foliar_schema::column(&key.class, &key.property), after.columns.get(key));
        let Some((column, b)) = column.filter(|c| c.visible_step > 0.0).zip(b) else { continue };
        stays(&key.property, &column_steps(column, &map(None, a), b)).map_err(&breach)?;
    }
    Ok(())
}

/// Whether what may not move stays within a part of what is seen.
fn stays(name: &str, errors: &[f64]) -> Result<(), String> {
    let worst = errors.iter().enumerate().max_by(|x, y| x.1.total_cmp(y.1));
    match worst.filter(|(_, worst)| worst.is_nan() || **worst > FRAME_STEPS) {
        Some((row, worst)) => Err(format!("{name} moves by {worst} visible steps at row {row}")),
        None => Ok(()),
    }
}

/// Differences in visible steps, row by row: of values, of transmittances for optical depths, or of angles for unit
/// vectors.
pub fn steps(channel: &Channel, a: &Array, b: &Array) -> Vec<f64> {
    let distances = distances(channel.width, channel.optical_depth, a, b).into_iter();
    // The angle between unit vectors, from their chord: exact where they nearly agree.
    let angle = |chord: f64| if chord.is_nan() { chord } else { 2.0 * libm::asin((chord / 2.0).min(1.0)).to_degrees() };
    let seen = |distance: f64| if channel.unit_length { angle(distance) } else { distance };
    distances.map(|distance| seen(distance) / channel.visible_step).collect()
}

/// The same for a column; nothing for one whose differences are no matter of seeing.
pub fn column_steps(column: &Column, a: &Array, b: &Array) -> Vec<f64> {
    if column.visible_step <= 0.0 {
        return Vec::new();
    }
    let distances = distances(column.width, column.optical_depth, a, b).into_iter();
    distances.map(|distance| distance / column.visible_step).collect()
}

fn distances(width: usize, optical_depth: bool, a: &Array, b: &Array) -> Vec<f64> {
    let (Some(x), Some(y)) = (a.as_f32(), b.as_f32()) else { return vec![f64::NAN] };
    if x.len() != y.len() {
        return vec![f64::NAN];
    }
    let seen = |v: f32| if optical_depth { libm::exp(-f64::from(v)) } else { f64::from(v) };
    let rows = x.chunks_exact(width).zip(y.chunks_exact(width));
    let squares = rows.map(|(p, q)| p.iter().zip(q).map(|(p, q)| (seen(*p) - seen(*q)).powi(2)).sum::<f64>());
    // Depths are numbers of their own, not coordinates of one vector.
    let share = if optical_depth { 1.0 / width as f64 } else { 1.0 };
    squares.map(|square| (square * share).sqrt()).collect()
}

fn layer(baker: &dyn Baker, plant: &Plant, given: &Map<String, Value>) -> Result<Layer, String> {
    let maps = Maps::new();
    let inputs = Inputs { plant: Some(plant), maps: &maps, neighbors: &[] };
    let request = Request { given: given.clone(), ..Request::default() };
    run(baker, &inputs, &request, &Quiet).map(|(layer, _)| layer).map_err(|error| error.to_string())
}

fn breaches<'a>(law: &'static str, baker: &'a dyn Baker, sample: &'a Sample) -> impl Fn(String) -> Breach + 'a {
    move |what| Breach { law, room: baker.room().into(), plant: sample.name.into(), what }
}
