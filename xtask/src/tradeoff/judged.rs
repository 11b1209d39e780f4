//! One tree judged: every ambient term and every way to realign normals against its traced light.

use super::light::Light;
use super::normals::Subject;
use super::scores::{self, LeafNormals};
use super::{room, trees::Tree};
use anyhow::Result;
use foliar_density::{Foliage, Params};
use foliar_plant::Plant;
use serde_json::{Value, json};

/// Angles between corners from which a leaf counts as torn, degrees.
pub const JUMPS_DEG: [f64; 2] = [30.0, 90.0];

/// How well an ambient term does.
#[derive(Clone, Debug)]
pub struct AmbientScore {
    /// Its name in tables.
    pub name: &'static str,
    /// Share of the variance explained.
    pub explained: f64,
    /// Difference with no fit.
    pub rms: f64,
}

/// How well normals do.
#[derive(Clone, Debug)]
pub struct NormalScore {
    /// Their name in tables.
    pub name: &'static str,
    /// Correlation over leaves as seen from outside, and over all alike.
    pub correlation: [f64; 2],
    /// Leaves torn by more than 30 / 90 degrees, percent.
    pub jumps: [f64; 2],
    /// Seconds of the processor; `None` where nobody would wait for it.
    pub seconds: Option<f64>,
}

/// Everything about one tree.
#[derive(Clone, Debug)]
pub struct Judged {
    /// Its name.
    pub name: &'static str,
    /// What it is like.
    pub what: &'static str,
    /// Leaves.
    pub leaves: usize,
    /// Radius of influence and reach of the low-pass, meters.
    pub lengths: [f64; 2],
    /// Ambient terms.
    pub ambient: Vec<AmbientScore>,
    /// Normals.
    pub normals: Vec<NormalScore>,
}

/// `_AMBIENT` of `sky` is lifted to this floor by default; without it, it is a transmittance.
fn transmittance(ambient: &[f64]) -> Vec<f64> {
    let floor = Params::default().darkest_ambient;
    ambient.iter().map(|a| (a - floor) / (1.0 - floor)).collect()
}

/// Scores of the default: variance that the ambient term explains, and correlation of the normals.
pub fn of_default(plant: &Plant) -> Result<[f64; 2]> {
    let light = Light::trace(plant)?;
    let layer = room::bake(plant, &json!({}))?;
    let [explained, _] = scores::ambient(&light, &transmittance(&room::ambient(plant, &layer)?));
    let [correlation, _] = scores::shading(&light, &room::normals(plant, &layer)?);
    Ok([explained, correlation])
}

/// Judges a tree.
pub fn judge(tree: &Tree) -> Result<Judged> {
    let plant = &tree.plant;
    let light = Light::trace(plant)?;
    let foliage = Foliage::new(plant, &[], &Params::default());
    Ok(Judged {
        name: tree.name,
        what: tree.what,
        leaves: plant.leaves().len(),
        lengths: [foliage.radius, light.reach],
        ambient: ambient(plant, &light)?,
        normals: normals(&Subject { plant, foliage: &foliage }, &light)?,
    })
}

fn ambient(plant: &Plant, light: &Light) -> Result<Vec<AmbientScore>> {
    let score = |name, term: Vec<f64>| {
        let [explained, rms] = scores::ambient(light, &term);
        AmbientScore { name, explained, rms }
    };
    let term = |given: Value| room::ambient(plant, &room::bake(plant, &given)?);
    Ok(vec![
        score("`sky`", transmittance(&term(json!({}))?)),
        score("`luft` (eq. 4)", term(json!({"ambient": "luft"}))?),
    ])
}

fn normals(subject: &Subject, light: &Light) -> Result<Vec<NormalScore>> {
    let score = |name, normals: &LeafNormals, seconds| NormalScore {
        name,
        correlation: scores::shading(light, normals),
        jumps: scores::jumps(normals, JUMPS_DEG),
        seconds,
    };
    let timed = |name, work: &dyn Fn() -> Result<LeafNormals>| -> Result<NormalScore> {
        let (normals, seconds) = room::cpu_seconds(work)?;
        Ok(score(name, &normals, Some(seconds)))
    };
    let sky = || room::normals(subject.plant, &room::bake(subject.plant, &json!({"channels": "normals"}))?);
    let paper = || {
        room::normals(subject.plant, &room::bake(subject.plant, &json!({"channels": "normals", "normals": "surface"}))?)
    };
    Ok(vec![
        timed("**`sky`**, per leaf", &sky)?,
        timed("multi, per leaf", &|| Ok(subject.multi()))?,
        timed("`surface` (the paper's), per leaf", &paper)?,
        timed("the same, per vertex", &|| subject.surface())?,
        timed("against the gradient, per vertex", &|| Ok(subject.gradient(1.0)))?,
        timed("the gradient, radius doubled", &|| Ok(subject.gradient(2.0)))?,
        score("one ellipsoid", &subject.ellipsoid(), None),
        score("original (plain)", &subject.plain(), None),
        score("(mean direction of the traced light)", &subject.bent(light), None),
    ])
}
