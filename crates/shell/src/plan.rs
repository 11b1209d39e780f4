//! The plan: what will be baked, why, with which parameters, at what cost. Printed before work starts.

use crate::Failure;
use crate::config::Settings;
use crate::limbs::Limbs;
use crate::said::Bakes;
use foliar_bake::{Baker, Facts, Requirement, resolve_params};
use foliar_schema::{LATER_ROOMS, Scene, names};
use serde_json::{Map, Value};

/// How fast rooms write, roughly: two cores write about this many bytes of layer a second. An
/// estimate, for information.
const BYTES_PER_SECOND: f64 = 15e6;

/// One line of the plan.
pub struct Row<'a> {
    /// Who.
    pub baker: &'a dyn Baker,
    /// Whether it will be baked.
    pub needed: bool,
    /// Why, or why not.
    pub because: String,
    /// What the scene implies.
    pub implied: Map<String, Value>,
    /// Every parameter.
    pub params: Map<String, Value>,
    /// Bytes that it adds to the file, where the room can tell.
    pub bytes: Option<u64>,
}

impl Row<'_> {
    /// Seconds that it will take, roughly.
    pub fn seconds(&self) -> f64 {
        self.bytes.map_or(0.0, |bytes| bytes as f64 / BYTES_PER_SECOND)
    }

    /// Every parameter; one that the room settles itself says by what, as its doc comment has it after
    /// "nothing said".
    fn shown_params(&self) -> Value {
        let schema = self.baker.schema();
        let settled = |name: &str| {
            let doc = schema["properties"][name]["description"].as_str().unwrap_or_default();
            let doc = doc.split_whitespace().collect::<Vec<_>>().join(" ");
            let says = doc.split_once("nothing said: ").map_or("by the room", |(_, says)| says);
            says.split_once(". ").map_or(says, |(says, _)| says).trim_end_matches('.').to_owned()
        };
        let shown = |(name, value): (&String, &Value)| {
            let value = if value.is_null() { settled(name).into() } else { value.clone() };
            (name.clone(), value)
        };
        Value::Object(self.params.iter().map(shown).collect())
    }

    /// The row for machines.
    pub fn told(&self) -> Bakes {
        Bakes {
            baker: self.baker.room().into(),
            needed: self.needed,
            because: self.because.clone(),
            parameters: self.shown_params(),
            bytes: self.bytes,
            seconds_estimated: Some(self.seconds()),
            from: None,
        }
    }
}

/// Asks every baker what the scene needs of it. Without a scene each is baked that has what it needs,
/// at its defaults; a room in `only` is baked whatever the scene says.
///
/// # Errors
/// [`Failure::Usage`] for a parameter that a room refuses.
pub fn make<'a>(
    bakers: &[&'a dyn Baker],
    settings: &Settings,
    only: Option<&[String]>,
    facts: &Facts,
) -> Result<Vec<Row<'a>>, Failure> {
    let scene: Scene = settings.section("scene")?;
    let has_scene = settings.has_section("scene");
    let of_trees = bakers.iter().filter(|baker| !baker.needs().nothing());
    of_trees.map(|baker| row(*baker, settings, only, has_scene.then_some(&scene), facts)).collect()
}

fn row<'a>(
    baker: &'a dyn Baker,
    settings: &Settings,
    only: Option<&[String]>,
    scene: Option<&Scene>,
    facts: &Facts,
) -> Result<Row<'a>, Failure> {
    let asked = only.is_some_and(|rooms| rooms.iter().any(|room| room == baker.room()));
    let (required, implied, because, bytes) = answer(baker, scene, facts);
    let (needed, because) = match only {
        Some(_) if asked => (true, "asked for".into()),
        Some(_) => (false, "not asked for".into()),
        None => (required, because),
    };
    let params = resolve_params(baker, &implied, &settings.given(baker.room()))?;
    Ok(Row { baker, needed, because, implied, params, bytes })
}

fn answer(baker: &dyn Baker, scene: Option<&Scene>, facts: &Facts) -> (bool, Map<String, Value>, String, Option<u64>) {
    match (baker.require(scene.unwrap_or(&Scene::default()), facts), scene) {
        (Requirement::Required { params, because, bytes }, Some(_)) => (true, params, because, Some(bytes)),
        (Requirement::Required { bytes, .. }, None) => {
            (true, Map::new(), "no [scene] given: every room, at its defaults".into(), Some(bytes))
        }
        (Requirement::NotRequired { because }, _) => (false, Map::new(), because, None),
    }
}

/// The step that finds branches, where the plan has it.
pub struct Branches {
    /// Why.
    pub because: String,
    /// Bytes of its arrays.
    pub bytes: u64,
}

/// Why branches are there, and how many bytes they are.
pub fn branches(rows: &[Row], limbs: &Limbs) -> Branches {
    let asking: Vec<&str> =
        rows.iter().filter(|row| row.needed && row.baker.needs().branches).map(|row| row.baker.room()).collect();
    let because = if asking.is_empty() { "asked for".into() } else { format!("{} needs them", asking.join(", ")) };
    let arrays = limbs.layer.attributes.values().chain(limbs.layer.columns.values());
    Branches { because, bytes: arrays.map(|array| array.bytes().len() as u64).sum() }
}

/// The plan as a table for people, rooms of later versions included.
pub fn table(rows: &[Row], limbs: Option<&Limbs>) -> String {
    let mut cells = vec![["baker", "needed", "bytes", "seconds", "because"].map(String::from)];
    if let Some(Branches { because, bytes }) = limbs.map(|limbs| branches(rows, limbs)) {
        let name = names::ROOM_BRANCHES.into();
        cells.push([name, "yes".into(), bytes.to_string(), "done".into(), because]);
    }
    for row in rows {
        cells.push([
            row.baker.room().into(),
            if row.needed { "yes" } else { "no" }.into(),
            row.bytes.map_or("-".into(), |bytes| bytes.to_string()),
            format!("~{:.2}", row.seconds()),
            row.because.clone(),
        ]);
    }
    let mut text = columns(&cells);
    for row in rows.iter().filter(|row| row.needed) {
        text.push_str(&format!("{}: {}\n", row.baker.room(), row.shown_params()));
    }
    for room in LATER_ROOMS {
        text.push_str(&format!("{room}: not in this version\n"));
    }
    text.trim_end().into()
}

/// Rows of cells in columns, two spaces apart.
pub fn columns<const N: usize>(rows: &[[String; N]]) -> String {
    let width = |column: usize| rows.iter().map(|row| row[column].chars().count()).max().unwrap_or(0);
    let widths: Vec<usize> = (0..N).map(width).collect();
    let line = |row: &[String; N]| {
        let cells: Vec<String> = row.iter().zip(&widths).map(|(cell, width)| format!("{cell:width$}")).collect();
        format!("{}\n", cells.join("  ").trim_end())
    };
    rows.iter().map(line).collect()
}
