//! How two bakes differ, channel by channel: statistics in visible steps and the worst places.

use foliar_bake::{Array, Layer};
use foliar_numerics::ErrorStats;
use foliar_plant::Place;
use foliar_schema::{Channel, Column, Role, channel, column, names, raster};
use schemars::JsonSchema;
use serde::Serialize;
use std::borrow::Cow;
use std::collections::{BTreeMap, BTreeSet};

/// Places that are listed at most.
const WORST: usize = 3;
/// A column has no visible step: its greatest number over this stands in for one.
const COLUMN_STEPS: f64 = 1000.0;
/// What stands before the name of a map.
const MAP: &str = "map ";
/// A map of which the contract knows no step has that of 8 bits.
const MAP_STEP: f64 = 1.0 / 255.0;
/// One that is a direction has the step of normals.
const DIRECTION_STEP_DEG: f64 = 1.0;

/// One place where two bakes differ.
#[derive(Clone, Debug, PartialEq, Serialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Spot {
    /// `mesh 0 primitive 1 vertex 17`, or `foliarLeaf row 3`.
    pub place: String,
    /// Value in the first.
    pub a: Vec<f64>,
    /// Value in the second.
    pub b: Vec<f64>,
    /// How far apart, in steps.
    pub steps: f64,
}

/// How one channel or column differs.
#[derive(Clone, Debug, PartialEq, Serialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Difference {
    /// Room that wrote it.
    pub room: String,
    /// Channel, or `class/property`.
    pub name: String,
    /// Values that were compared.
    pub count: usize,
    /// Why they cannot be compared: only in one of the files, other counts.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub problem: Option<String>,
    /// Root mean square, steps.
    pub rms_steps: f64,
    /// 99.9th percentile, steps.
    pub p999_steps: f64,
    /// Largest, steps.
    pub max_steps: f64,
    /// The worst places, worst first.
    pub worst: Vec<Spot>,
}

impl Difference {
    /// Nothing compared yet.
    fn of(key: &Key, problem: Option<String>) -> Self {
        let (room, name) = key.clone();
        let (rms_steps, p999_steps, max_steps) = (0.0, 0.0, 0.0);
        Difference { room, name, count: 0, problem, rms_steps, p999_steps, max_steps, worst: Vec::new() }
    }

    /// The bases that two files were baked from, by their hashes: everything but what foliar wrote.
    pub fn of_bases(a: &str, b: &str) -> Self {
        let problem = (a != b).then(|| "another base: its geometry, materials or pictures are not the same".to_owned());
        Difference { count: 1, ..Difference::of(&("base".into(), "base".into()), problem) }
    }

    /// Whether it is beyond a tolerance in steps.
    pub fn exceeds(&self, tolerance: f64) -> bool {
        self.problem.is_some() || self.max_steps > tolerance
    }
}

/// How the layers of two files differ: every channel and column of either, by room and name.
pub fn diff(a: &[Layer], b: &[Layer]) -> Vec<Difference> {
    let layers = (a, b);
    let (a, b) = (by_name(a), by_name(b));
    let names: BTreeSet<&Key> = a.keys().chain(b.keys()).collect();
    let none = BTreeMap::new();
    let of = |all: &'_ BTreeMap<Key, _>, key| all.get(key).is_some();
    let mut all: Vec<Difference> = roles(layers.0, layers.1).into_iter().collect();
    all.extend(pictures(layers.0, layers.1));
    for key in names {
        let only = |file: &str| Some(format!("only in {file}"));
        let problem = match (of(&a, key), of(&b, key)) {
            (true, false) => only("the first file"),
            (false, true) => only("the second file"),
            _ => None,
        };
        all.push(one(key, problem, a.get(key).unwrap_or(&none), b.get(key).unwrap_or(&none)));
    }
    all
}

/// Roles of parts, where either file tells any.
fn roles(a: &[Layer], b: &[Layer]) -> Option<Difference> {
    let of = |layers: &[Layer]| -> BTreeMap<Place, Role> {
        layers.iter().flat_map(|layer| layer.roles.iter().map(|(place, role)| (*place, *role))).collect()
    };
    let (a, b) = (of(a), of(b));
    let places: BTreeSet<Place> = a.keys().chain(b.keys()).copied().collect();
    let name = |role: Option<&Role>| role.map_or_else(|| "nothing".into(), ToString::to_string);
    let other = places.iter().find(|place| a.get(place) != b.get(place));
    let problem = other.map(|place| {
        let (mesh, primitive) = (place.mesh, place.primitive);
        format!("mesh {mesh} primitive {primitive}: {}, {}", name(a.get(place)), name(b.get(place)))
    });
    let key = (names::ROOM_STRUCTURE.into(), "role".into());
    (!places.is_empty()).then(|| Difference { count: places.len(), ..Difference::of(&key, problem) })
}

/// Pictures that are passed on: the same bytes, or others.
fn pictures(a: &[Layer], b: &[Layer]) -> Vec<Difference> {
    fn of(layers: &[Layer]) -> BTreeMap<Key, &Vec<u8>> {
        let all =
            layers.iter().flat_map(|layer| layer.pictures.iter().map(move |picture| (&layer.record.room, picture)));
        all.map(|(room, (name, bytes))| ((room.clone(), format!("picture {name}")), bytes)).collect()
    }
    let (a, b) = (of(a), of(b));
    let keys: BTreeSet<&Key> = a.keys().chain(b.keys()).collect();
    let problem = |key| match (a.get(key), b.get(key)) {
        (Some(a), Some(b)) if a == b => None,
        (Some(_), Some(_)) => Some("another picture".to_owned()),
        (Some(_), None) => Some("only in the first file".to_owned()),
        _ => Some("only in the second file".to_owned()),
    };
    keys.into_iter().map(|key| Difference { count: 1, ..Difference::of(key, problem(key)) }).collect()
}

/// Room and name.
type Key = (String, String);
/// Arrays by the words for their place.
type Arrays<'a> = BTreeMap<String, Cow<'a, Array>>;

fn by_name(layers: &[Layer]) -> BTreeMap<Key, Arrays<'_>> {
    let mut all: BTreeMap<Key, Arrays> = BTreeMap::new();
    for layer in layers {
        let room = &layer.record.room;
        for (key, array) in &layer.attributes {
            let place = format!("mesh {} primitive {} vertex", key.place.mesh, key.place.primitive);
            all.entry((room.clone(), key.name.clone())).or_default().insert(place, Cow::Borrowed(array));
        }
        for (name, raster) in &layer.rasters {
            let size = format!("{} x {} texel", raster.width, raster.height);
            let array = Array::F32 { width: raster.channels.max(1) as usize, data: raster.data.clone() };
            all.entry((room.clone(), format!("{MAP}{name}"))).or_default().insert(size, Cow::Owned(array));
        }
        for (key, array) in &layer.columns {
            let name = format!("{}/{}", key.class, key.property);
            all.entry((room.clone(), name)).or_default().insert(format!("{} row", key.class), Cow::Borrowed(array));
        }
    }
    all
}

fn one(key: &Key, problem: Option<String>, a: &Arrays, b: &Arrays) -> Difference {
    let problem =
        problem.or_else(|| a.iter().find_map(|(place, array)| unlike(place, array, b.get(place).map(AsRef::as_ref))));
    let problem = problem.or_else(|| {
        let place = b.keys().find(|place| !a.contains_key(*place))?;
        Some(format!("{place}: only in the second file"))
    });
    let mut difference = Difference::of(key, problem);
    if difference.problem.is_some() {
        return difference;
    }
    let pairs: Vec<(&String, &Array, &Array)> =
        a.iter().map(|(place, array)| (place, array.as_ref(), b[place].as_ref())).collect();
    let measure = Measure::of(&key.1, &pairs);
    let mut spots = Vec::new();
    let mut steps = Vec::new();
    for (place, one, other) in pairs {
        for row in 0..one.rows() {
            let (p, q) = (values(one, row), values(other, row));
            let apart = measure.steps(&p, &q);
            steps.push(apart);
            if apart > 0.0 {
                spots.push((apart, place, row, p, q));
            }
        }
    }
    spots.sort_by(|x, y| y.0.total_cmp(&x.0));
    spots.truncate(WORST);
    difference.worst = spots
        .into_iter()
        .map(|(steps, place, row, a, b)| Spot { place: format!("{place} {row}"), a, b, steps })
        .collect();
    let stats = ErrorStats::of(steps);
    (difference.count, difference.rms_steps) = (stats.count, stats.rms);
    (difference.p999_steps, difference.max_steps) = (stats.p999, stats.max);
    difference
}

/// Why two arrays cannot be compared.
fn unlike(place: &str, a: &Array, b: Option<&Array>) -> Option<String> {
    let Some(b) = b else { return Some(format!("{place}: only in the first file")) };
    let (p, q) = ((a.rows(), a.width()), (b.rows(), b.width()));
    let is_float = |array: &Array| matches!(array, Array::F32 { .. });
    if p != q {
        return Some(format!("{place}: {} rows of {} in the first file, {} of {} in the second", p.0, p.1, q.0, q.1));
    }
    (is_float(a) != is_float(b)).then(|| format!("{place}: floats in one file, integers in the other"))
}

fn values(array: &Array, row: usize) -> Vec<f64> {
    let range = row * array.width()..(row + 1) * array.width();
    match array {
        Array::F32 { data, .. } => data[range].iter().copied().map(f64::from).collect(),
        Array::I32 { data, .. } => data[range].iter().copied().map(f64::from).collect(),
    }
}

fn is_direction(name: &str) -> bool {
    of_column(name).is_some_and(|column| column.unit.starts_with("unit vector"))
}

/// How a distance becomes steps.
enum Measure {
    /// Angle between unit vectors, a step in radians.
    Angle(f64),
    /// Length of the difference.
    Length(f64),
    /// Greatest difference of the transmittances of optical depths.
    Depth(f64),
}

impl Measure {
    fn of(name: &str, pairs: &[(&String, &Array, &Array)]) -> Self {
        match channel(name) {
            Some(Channel { unit_length: true, step_unit: "degree", visible_step, .. }) => {
                Measure::Angle(visible_step.to_radians())
            }
            Some(channel) if channel.optical_depth => Measure::Depth(channel.visible_step),
            Some(channel) => Measure::Length(channel.visible_step),
            None if name.starts_with(MAP) => {
                let own = name.strip_prefix(MAP).and_then(|name| name.rsplit('/').next());
                let step = own.and_then(raster).map(|info| info.visible_step);
                Measure::Length(step.filter(|step| *step > 0.0).unwrap_or(MAP_STEP))
            }
            None if of_column(name).is_some_and(|column| column.optical_depth) => {
                Measure::Depth(of_column(name).map_or(1.0, |column| column.visible_step))
            }
            None if is_direction(name) => Measure::Angle(DIRECTION_STEP_DEG.to_radians()),
            // A number that names a row is the same or another.
            None if pairs.iter().any(|(_, array, _)| matches!(array, Array::I32 { .. })) => Measure::Length(1.0),
            None => {
                let rows = |array: &Array| (0..array.rows()).flat_map(|row| values(array, row)).collect::<Vec<_>>();
                let all = pairs.iter().flat_map(|(_, a, b)| rows(a).into_iter().chain(rows(b)));
                let greatest = all.fold(0.0, |most: f64, v| most.max(v.abs()));
                Measure::Length(greatest.max(f64::MIN_POSITIVE) / COLUMN_STEPS)
            }
        }
    }

    fn steps(&self, a: &[f64], b: &[f64]) -> f64 {
        let sum = |f: fn(f64, f64) -> f64| a.iter().zip(b).map(|(x, y)| f(*x, *y)).sum::<f64>();
        let apart = sum(|x, y| (x - y) * (x - y)).sqrt();
        match self {
            // Half the chord is the sine of half the angle, which is the angle to within 1 % below 28 degrees.
            Measure::Angle(step) => 2.0 * (apart / 2.0).min(1.0) / step,
            Measure::Length(step) => apart / step,
            Measure::Depth(step) => {
                let seen = |(x, y): (&f64, &f64)| (libm::exp(-x) - libm::exp(-y)).abs();
                a.iter().zip(b).map(seen).fold(0.0, f64::max) / step
            }
        }
    }
}

/// The column of a name as it stands here: class and property.
fn of_column(name: &str) -> Option<&'static Column> {
    name.split_once('/').and_then(|(class, property)| column(class, property))
}

#[cfg(test)]
mod tests {
    use super::*;
    use foliar_bake::{AttributeKey, ColumnKey};

    fn layer(values: &[f32]) -> Layer {
        let mut layer = Layer::default();
        layer.record.room = names::ROOM_DENSITY.into();
        let key = AttributeKey { place: Place::default(), name: names::AMBIENT.into() };
        layer.attributes.insert(key, Array::scalars(values.to_vec()));
        layer
    }

    #[test]
    fn a_bake_is_the_same_as_itself() {
        let same = diff(&[layer(&[0.5, 0.25])], &[layer(&[0.5, 0.25])]);
        assert!(same.len() == 1 && !same[0].exceeds(0.0) && same[0].worst.is_empty(), "{same:?}");
    }

    #[test]
    fn the_worst_place_comes_first_with_both_values_and_its_steps() {
        let found = diff(&[layer(&[0.5, 0.25, 0.75])], &[layer(&[0.5, 0.25 + 2.0 / 255.0, 0.75 + 4.0 / 255.0])]);
        assert!(
            (found[0].max_steps - 4.0).abs() < 1e-4 && found[0].exceeds(3.9) && !found[0].exceeds(4.1),
            "{found:?}"
        );
        assert_eq!(found[0].worst[0].place, "mesh 0 primitive 0 vertex 2");
        assert_eq!(found[0].worst.len(), 2);
    }

    #[test]
    fn optical_depths_differ_by_what_is_seen_of_them() {
        let layer = |depth: f32| {
            let mut layer = Layer::default();
            let key = AttributeKey { place: Place::default(), name: names::LIGHT_DEPTH_0.into() };
            layer.attributes.insert(key, Array::F32 { width: 4, data: vec![0.0, 1.0, depth, 3.0] });
            layer
        };
        let (dark, bright) = (diff(&[layer(9.0)], &[layer(12.0)]), diff(&[layer(0.1)], &[layer(0.2)]));
        assert!(!dark[0].exceeds(0.05) && bright[0].exceeds(20.0), "{dark:?} {bright:?}");
    }

    #[test]
    fn directions_are_compared_by_angles_and_roles_by_name() {
        let with = |normal: [f32; 3], role: Role| {
            let mut layer = layer(&[0.5]);
            let key = ColumnKey { class: names::CLASS_LEAF.into(), property: "normal".into() };
            layer.columns.insert(key, Array::F32 { width: 3, data: normal.to_vec() });
            layer.roles.insert(Place::default(), role);
            layer
        };
        let (up, aside) = ([0.0, 1.0, 0.0], [0.0, 0.999_847_7, 0.017_452_406]);
        let found = diff(&[with(up, Role::Leaf)], &[with(aside, Role::Wood)]);
        let of = |name: &str| found.iter().find(|d| d.name == name).unwrap();
        assert!((of("foliarLeaf/normal").max_steps - 1.0).abs() < 1e-3, "{found:?}");
        assert_eq!(of("role").problem.as_deref(), Some("mesh 0 primitive 0: leaf, wood"));
        assert!(of("role").exceeds(1e9));
        let same = diff(&[with(up, Role::Leaf)], &[with(up, Role::Leaf)]);
        assert!(same.iter().all(|d| !d.exceeds(0.0)), "{same:?}");
    }

    #[test]
    fn maps_are_compared_texel_by_texel_and_pictures_byte_by_byte() {
        let with = |value: f32, picture: u8| {
            let mut layer = Layer::default();
            layer.record.room = names::ROOM_TRANSLUCENCY.into();
            let data = vec![0.25, 0.25, 0.25, 0.25, value, 0.25, 0.25, 0.25];
            let raster = foliar_bake::FloatRaster { width: 2, height: 1, channels: 4, data };
            layer.rasters.insert(format!("leaf/{}", names::RASTER_TRANSLUCENCY_FRONT), raster);
            layer.pictures.insert("leaf/color".into(), vec![picture]);
            layer
        };
        let same = diff(&[with(0.25, 1)], &[with(0.25, 1)]);
        assert!(same.len() == 2 && same.iter().all(|d| !d.exceeds(0.0)), "{same:?}");
        let found = diff(&[with(0.25, 1)], &[with(0.5, 2)]);
        let map = found.iter().find(|d| d.name.starts_with("map ")).unwrap();
        assert!(map.exceeds(1.0) && map.worst[0].place.ends_with("texel 1"), "{found:?}");
        // A step of a map that belongs to no tree is its own, too.
        let scan = |value: f32| {
            let mut layer = Layer::default();
            let raster = foliar_bake::FloatRaster { width: 1, height: 1, channels: 1, data: vec![value] };
            layer.rasters.insert(names::MAP_THICKNESS.into(), raster);
            layer
        };
        let step = raster(names::MAP_THICKNESS).unwrap().visible_step;
        let found_scan = diff(&[scan(0.2)], &[scan(0.2 + 3.0 * step as f32)]);
        assert!((found_scan[0].max_steps - 3.0).abs() < 1e-2, "{found_scan:?}");
        let picture = found.iter().find(|d| d.name.starts_with("picture ")).unwrap();
        assert_eq!(picture.problem.as_deref(), Some("another picture"));
    }

    #[test]
    fn what_stands_in_one_file_only_or_in_other_numbers_differs_at_any_tolerance() {
        assert!(diff(&[layer(&[0.5])], &[])[0].exceeds(1e9));
        let found = diff(&[layer(&[0.5])], &[layer(&[0.5, 0.5])]);
        assert!(found[0].problem.as_ref().is_some_and(|p| p.contains("1 rows")), "{found:?}");
    }
}
