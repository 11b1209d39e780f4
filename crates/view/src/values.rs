//! What is shown per vertex: the baked channels that light needs, and any channel or column as false colors.

use crate::key::{Key, Legend, MOST_STEPS};
use crate::{ViewError, colors};
use foliar_bake::{Array, Layer};
use foliar_plant::{Part, Plant};
use foliar_schema::{Channel, channel, column, names};
use glam::Vec3;

/// Linear colors per part and vertex, and what they mean.
pub(crate) struct FalseColors {
    pub colors: Vec<Vec<Vec3>>,
    pub legend: Legend,
}

/// The attribute of every part under this name; checked to fit the plant.
pub(crate) fn attribute<'a>(
    plant: &Plant,
    layers: &[&'a Layer],
    name: &str,
    width: usize,
) -> Result<Vec<Option<&'a [f32]>>, ViewError> {
    let found = |part: &foliar_plant::Part| {
        let Some(array) = layers.iter().find_map(|layer| layer.attribute(part.place, name)) else { return Ok(None) };
        let data = array.as_f32().filter(|_| array.width() == width && array.rows() == part.positions.len());
        data.map(Some).ok_or_else(|| ViewError::Shape {
            name: name.into(),
            part: part.name().into(),
            found: array.rows(),
            width: array.width(),
            expected: format!("{} rows of {width} floats", part.positions.len()),
        })
    };
    plant.parts().iter().map(found).collect()
}

/// Ambient coefficient per part and vertex.
pub(crate) fn ambient<'a>(plant: &Plant, layers: &[&'a Layer]) -> Result<Vec<Option<&'a [f32]>>, ViewError> {
    attribute(plant, layers, names::AMBIENT, 1)
}

/// A channel or column in false colors; `NAME[2]` is its third number alone. By the key of another picture, where there is
/// one.
pub(crate) fn false_colors(
    plant: &Plant,
    layers: &[&Layer],
    name: &str,
    like: Option<&Key>,
) -> Result<FalseColors, ViewError> {
    let plain = |s: &str| s.trim_start_matches('_').to_ascii_lowercase();
    let refuse = || ViewError::Channel { name: name.into(), known: shown_names(plant, layers, true).join(", ") };
    let (whole, component) = split(name).ok_or_else(refuse)?;
    let wanted = plain(whole);
    if component.is_none() && wanted == ROLE {
        return Ok(of_roles(plant));
    }
    if component.is_none() && wanted == PETIOLE_LENGTH && !plant.leaves().is_empty() {
        return Ok(of_petioles(plant, like));
    }
    let channels = layers.iter().flat_map(|layer| layer.attributes.keys()).map(|key| key.name.as_str());
    if let Some(info) = channels.filter_map(channel).find(|info| plain(info.name) == wanted) {
        return match component {
            Some(c) if c >= info.width => Err(refuse()),
            _ => of_channel(plant, layers, info, (component, like)),
        };
    }
    let is_wanted =
        |class: &str, property: &str| plain(property) == wanted || plain(&format!("{class}/{property}")) == wanted;
    let mut columns = layers.iter().flat_map(|layer| &layer.columns).filter(|(key, _)| is_drawn(plant, &key.class));
    match columns.find(|(key, _)| is_wanted(&key.class, &key.property)) {
        Some((_, array)) if component.is_some_and(|c| c >= array.width()) => Err(refuse()),
        Some((key, array)) => of_column(plant, (&key.class, &key.property), array, (component, like)),
        None => Err(refuse()),
    }
}

/// A name and the number of it that is asked for; nothing where the brackets hold no number.
fn split(name: &str) -> Option<(&str, Option<usize>)> {
    match name.split_once('[') {
        None => Some((name, None)),
        Some((whole, rest)) => Some((whole, Some(rest.strip_suffix(']')?.trim().parse().ok()?))),
    }
}

/// A column of the leaves; none where nobody baked it.
pub(crate) fn leaf_column<'a>(
    plant: &Plant,
    layers: &[&'a Layer],
    class: &str,
    property: &str,
) -> Result<Option<&'a [f32]>, ViewError> {
    let mut columns = layers.iter().flat_map(|layer| &layer.columns);
    let Some((_, array)) = columns.find(|(key, _)| key.class == class && key.property == property) else {
        return Ok(None);
    };
    let fits = array.rows() == plant.leaves().len();
    array.as_f32().filter(|_| fits).map(Some).ok_or_else(|| ViewError::Shape {
        name: property.into(),
        part: class.into(),
        found: array.rows(),
        width: array.width(),
        expected: format!("{} rows of floats, one per leaf", plant.leaves().len()),
    })
}

/// Asked for in place of a channel: what each part was taken for.
pub(crate) const ROLE: &str = "role";
/// The same: how far the leaf's center is from where it hangs.
const PETIOLE_LENGTH: &str = "petiole-length";

/// Whether rows of a class belong to leaves or branches, which can be drawn.
fn is_drawn(plant: &Plant, class: &str) -> bool {
    match class {
        names::CLASS_AXIS => false,
        _ if of_leaves(class) => !plant.leaves().is_empty(),
        _ => plant.branches().is_some(),
    }
}

/// Tables hold a row per leaf, but for those of branches.
fn of_leaves(class: &str) -> bool {
    !matches!(class, names::CLASS_BRANCH | names::CLASS_WIND)
}

fn of_petioles(plant: &Plant, like: Option<&Key>) -> FalseColors {
    let lengths: Vec<f32> = plant.leaves().iter().map(|leaf| (leaf.center - leaf.petiole).length()).collect();
    let doc = "distance of the leaf's center from where it hangs".into();
    let legend = |kind| Legend { name: PETIOLE_LENGTH.into(), doc, unit: "m".into(), kind };
    scalars(&rows_of(plant, &lengths, 1, true), None, like, legend)
}

fn of_roles(plant: &Plant) -> FalseColors {
    let part = |(index, part): (usize, &Part)| vec![colors::of_role(plant.role(index)); part.positions.len()];
    let doc = "what each part was taken for".into();
    let legend = Legend { name: ROLE.into(), doc, unit: String::new(), kind: Key::Roles };
    FalseColors { colors: plant.parts().iter().enumerate().map(part).collect(), legend }
}

/// Everything that can be shown, roles first; where several numbers belong to a name, `counted` says which there are.
pub(crate) fn shown_names(plant: &Plant, layers: &[&Layer], counted: bool) -> Vec<String> {
    let numbered = |name: String, width: usize| {
        if counted && width > 1 { format!("{name} (and {name}[0] to [{}])", width - 1) } else { name }
    };
    let attributes = layers.iter().flat_map(|layer| &layer.attributes);
    let mut names: Vec<String> = attributes.map(|(key, array)| numbered(key.name.clone(), array.width())).collect();
    let columns = layers.iter().flat_map(|l| &l.columns).filter(|(key, _)| is_drawn(plant, &key.class));
    names.extend(columns.map(|(k, array)| numbered(format!("{}/{}", k.class, k.property), array.width())));
    names.extend((!plant.leaves().is_empty()).then(|| PETIOLE_LENGTH.into()));
    let mut seen = std::collections::BTreeSet::new();
    let once = std::iter::once(ROLE.to_string()).chain(names);
    once.filter(|name| seen.insert(name.clone())).collect()
}

fn of_channel(
    plant: &Plant,
    layers: &[&Layer],
    info: &Channel,
    (component, like): (Option<usize>, Option<&Key>),
) -> Result<FalseColors, ViewError> {
    let arrays = attribute(plant, layers, info.name, info.width)?;
    let legend =
        |kind| Legend { name: numbered(info.name, component), doc: info.doc.into(), unit: info.unit.into(), kind };
    let is_id = info.step_unit == "id";
    let rows: Vec<Vec<Option<&[f32]>>> = plant
        .parts()
        .iter()
        .zip(&arrays)
        .map(|(part, array)| {
            (0..part.positions.len()).map(|v| array.map(|a| &a[v * info.width..][..info.width])).collect()
        })
        .collect();
    // The ramp spans what a channel may be, or what it is where that has no end.
    let range = (info.max < f32::MAX && info.min > f32::MIN).then_some((info.min, info.max));
    if let Some(c) = component {
        return Ok(scalars(
            &only(&rows, c),
            range.filter(|_| !info.unit_length).or(UNIT.filter(|_| info.unit_length)),
            like,
            legend,
        ));
    }
    let mut shown = if is_id {
        ids(&rows, plant.leaves().len(), legend)
    } else if info.width == 4 {
        let others = rows.iter().map(|part| part.iter().map(|row| row.map(|r| &r[1..])).collect()).collect();
        boxed(&others, LEVELS, like, legend)
    } else if info.unit_length {
        paint(&rows, legend(Key::Direction), |v| colors::of_direction(Vec3::from_slice(v)))
    } else {
        scalars(&rows, range, like, legend)
    };
    if info.unit_length {
        to_rest(plant, &rows, &mut shown);
    }
    Ok(shown)
}

/// Directions of the mesh's frame are shown as they stand in the scene.
fn to_rest(plant: &Plant, rows: &Rows, shown: &mut FalseColors) {
    for ((part, rows), shown) in plant.parts().iter().zip(rows).zip(&mut shown.colors) {
        for (row, color) in rows.iter().zip(shown) {
            if let Some(unit) = row {
                let rest = part.normal_to_rest(Vec3::from_slice(unit).as_dvec3());
                *color = colors::of_direction(rest.as_vec3());
            }
        }
    }
}

fn of_column(
    plant: &Plant,
    (class, property): (&str, &str),
    array: &Array,
    (component, like): (Option<usize>, Option<&Key>),
) -> Result<FalseColors, ViewError> {
    let of_leaf = of_leaves(class);
    let expected =
        if of_leaf { plant.leaves().len() } else { plant.branches().map_or(0, foliar_plant::Branches::count) };
    if array.rows() != expected {
        return Err(ViewError::Shape {
            name: property.into(),
            part: class.into(),
            found: array.rows(),
            width: array.width(),
            expected: format!("{expected} rows, one per {}", if of_leaf { "leaf" } else { "branch" }),
        });
    }
    let width = array.width();
    let integers: Option<Vec<f32>> = array.as_i32().map(|data| data.iter().map(|&i| i as f32).collect());
    let data = array.as_f32().or(integers.as_deref()).unwrap_or_default();
    let rows = rows_of(plant, data, width, of_leaf);
    let info = column(class, property);
    let (unit, doc) = info.map_or(("", ""), |c| (c.unit, c.doc));
    let name = numbered(&format!("{class}/{property}"), component);
    let legend = |kind| Legend { name, doc: doc.into(), unit: unit.into(), kind };
    let is_id = ["id", "row of", "rows of"].iter().any(|word| unit.contains(word));
    Ok(match component {
        Some(c) if is_id => ids(&only(&rows, c), usize::MAX, legend),
        Some(c) => scalars(&only(&rows, c), None, like, legend),
        None if is_id => ids(&only(&rows, 0), usize::MAX, legend),
        None if width == 3 && unit.starts_with("unit vector") => {
            paint(&rows, legend(Key::Direction), |v| colors::of_direction(Vec3::from_slice(v)))
        }
        None if width == 3 => boxed(&rows, AXES, like, legend),
        None if integers.is_some() => whole_numbers(&rows, like, legend),
        None if width == 1 => scalars(&rows, None, like, legend),
        // The first stands for all, and says so.
        None => return of_column(plant, (class, property), array, (Some(0), like)),
    })
}

/// The row of a table that each vertex belongs to.
fn rows_of<'a>(plant: &Plant, data: &'a [f32], width: usize, of_leaf: bool) -> Rows<'a> {
    let id = |part, v| if of_leaf { plant.leaf_of(part, v) } else { branch_of(plant, part, v) };
    let row = |part, v| id(part, v).map(|id| &data[id as usize * width..][..width]);
    let part = |(index, part): (usize, &Part)| (0..part.positions.len()).map(|v| row(index, v)).collect();
    plant.parts().iter().enumerate().map(part).collect()
}

fn numbered(name: &str, component: Option<usize>) -> String {
    component.map_or_else(|| name.into(), |c| format!("{name}[{c}]"))
}

/// Branch of a vertex of wood, or of a leaf's.
fn branch_of(plant: &Plant, part: usize, vertex: usize) -> Option<u32> {
    let branches = plant.branches()?;
    let place = match plant.leaf_of(part, vertex) {
        Some(leaf) => branches.leaves.get(leaf as usize),
        None => branches.vertices[part].get(vertex),
    };
    place.map(|place| place.branch).filter(|&branch| branch != foliar_plant::NO_BRANCH)
}

type Rows<'a> = Vec<Vec<Option<&'a [f32]>>>;

const AXES: [&str; 3] = ["X", "Y", "Z"];
/// The stem's own sway, level 0, is what all have: the others are shown.
const LEVELS: [&str; 3] = ["1:", "2:", "3:"];
/// Components of a unit vector.
const UNIT: Option<(f32, f32)> = Some((-1.0, 1.0));

/// One number of each row.
fn only<'a>(rows: &Rows<'a>, component: usize) -> Rows<'a> {
    let one = |row: &Option<&'a [f32]>| row.map(|r| &r[component..=component]);
    rows.iter().map(|part| part.iter().map(one).collect()).collect()
}

fn paint(rows: &Rows, legend: Legend, color: impl Fn(&[f32]) -> Vec3) -> FalseColors {
    let vertex = |row: &Option<&[f32]>| row.map_or(colors::NO_VALUE, &color);
    FalseColors { colors: rows.iter().map(|part| part.iter().map(vertex).collect()).collect(), legend }
}

fn scalars(
    rows: &Rows,
    range: Option<(f32, f32)>,
    like: Option<&Key>,
    legend: impl FnOnce(Key) -> Legend,
) -> FalseColors {
    let (low, high) = match like {
        Some(Key::Ramp(low, high)) => (*low, *high),
        _ => range.unwrap_or_else(|| {
            let (low, high) = extent(rows);
            (low[0], high[0])
        }),
    };
    let span = if high > low { high - low } else { 1.0 };
    paint(rows, legend(Key::Ramp(low, high)), |v| colors::ramp((v[0] - low) / span))
}

/// Whole numbers that are few enough to be told apart; else as [`scalars`].
fn whole_numbers(rows: &Rows, like: Option<&Key>, legend: impl FnOnce(Key) -> Legend) -> FalseColors {
    let (low, high) = match like {
        Some(Key::Steps(low, high)) => (*low as f32, *high as f32),
        _ => {
            let (low, high) = extent(rows);
            (low[0], high[0])
        }
    };
    if matches!(like, Some(Key::Ramp(..))) || high - low > MOST_STEPS || high <= low {
        return scalars(rows, None, like, legend);
    }
    paint(rows, legend(Key::Steps(low as i32, high as i32)), |v| colors::ramp((v[0] - low) / (high - low)))
}

fn boxed(rows: &Rows, names: [&'static str; 3], like: Option<&Key>, legend: impl FnOnce(Key) -> Legend) -> FalseColors {
    let (low, high) = match like {
        Some(Key::Box(_, low, high)) => (*low, *high),
        _ => extent(rows),
    };
    let span: [f32; 3] = std::array::from_fn(|c| if high[c] > low[c] { high[c] - low[c] } else { 1.0 });
    paint(rows, legend(Key::Box(names, low, high)), |v| {
        Vec3::from_array(std::array::from_fn(|c| colors::to_linear(((v[c] - low[c]) / span[c]).clamp(0.0, 1.0))))
    })
}

/// Ids from `none` on mean no value.
fn ids(rows: &Rows, none: usize, legend: impl FnOnce(Key) -> Legend) -> FalseColors {
    let all = rows.iter().flatten().flatten().map(|v| v[0] as i64 as usize).filter(|&id| id < none);
    let count = all.collect::<std::collections::BTreeSet<_>>().len();
    paint(rows, legend(Key::Ids(count)), |v| {
        if (v[0] as usize) < none { colors::of_id(v[0] as u32) } else { colors::NO_VALUE }
    })
}

/// Least and greatest value of up to three components; zeros where there is none.
fn extent(rows: &Rows) -> ([f32; 3], [f32; 3]) {
    let (mut low, mut high) = ([f32::INFINITY; 3], [f32::NEG_INFINITY; 3]);
    for row in rows.iter().flatten().flatten() {
        for (c, &value) in row.iter().take(3).enumerate() {
            low[c] = low[c].min(value);
            high[c] = high[c].max(value);
        }
    }
    let finite = |v: [f32; 3]| v.map(|x| if x.is_finite() { x } else { 0.0 });
    (finite(low), finite(high))
}
