//! The translucency room against oracles/translucency: adding-doubling, counted photons, inverted and measured leaves.

use super::super::Figure;
use crate::repo;
use anyhow::{Context, Result, bail};
use foliar_translucency::light::Fit;
use foliar_translucency::oracle::{
    Golden, bumps_error, largest, layers_error, leaf_error, measured_leaf_error, medium, number, slab_error,
    spread_error,
};
use foliar_translucency::transport::{AddingDoubling, DeltaP1, Layer};
use serde_json::Value;

fn read(path: &str) -> Result<String> {
    let path = repo::shared().join(path);
    std::fs::read_to_string(&path).with_context(|| format!("{}: no shared data", path.display()))
}

/// The records of an oracle.
pub fn records(name: &str) -> Result<Vec<Value>> {
    let file: Value = serde_json::from_str(&read(&format!("oracles/translucency/{name}.json"))?)?;
    let lists = [&file, &file["records"], &file["cases"]];
    let list = lists.iter().find_map(|list| list.as_array()).filter(|list| !list.is_empty());
    list.cloned().with_context(|| format!("{name}.json holds no records"))
}

fn worst(name: &str, error: impl Fn(&Value) -> f64) -> Result<Figure> {
    let records = records(name)?;
    Ok(Figure::new(largest(records.iter().map(error)), format!("{name}.json, {} records", records.len())))
}

/// R and T of every slab with 24 nodes, beyond what the oracle itself does not know.
pub fn slab_24() -> Result<Figure> {
    worst("slab", |record| slab_error(record, 24) - number(record, "ad_err"))
}

/// The same with 16.
pub fn slab_16() -> Result<Figure> {
    worst("slab", |record| slab_error(record, 16) - number(record, "ad_err"))
}

/// Light that is lost in slabs which absorb nothing.
pub fn energy() -> Result<Figure> {
    let lost = |record: &Value| {
        let totals =
            AddingDoubling::one(&medium(record), number(record, "d"), record["mu0"].as_f64().unwrap_or(1.0), 24);
        if number(record, "sigma_a") > 0.0 { 0.0 } else { 1.0 - totals.reflectance - totals.transmittance }
    };
    worst("slab", lost)
}

/// Every total of layered leaves.
pub fn layers() -> Result<Figure> {
    worst("layers", |case| layers_error(case, 24))
}

/// Diffuse transmission of layered leaves from the front less that from the back.
pub fn layers_turned() -> Result<Figure> {
    let turned = |case: &Value| {
        let layer = |l: &Value| Layer {
            medium: foliar_translucency::transport::Medium {
                absorption: at(l, 0),
                scattering: at(l, 1),
                anisotropy: at(l, 2),
                index: number(case, "eta"),
            },
            thickness_mm: at(l, 3),
        };
        let layers: Vec<Layer> = case["layers"].as_array().into_iter().flatten().map(layer).collect();
        let leaf = AddingDoubling::solve(&layers, &[1.0], 24);
        leaf.front_diffuse.transmittance - leaf.back_diffuse.transmittance
    };
    worst("layers", turned)
}

fn at(list: &Value, index: usize) -> f64 {
    list[index].as_f64().unwrap_or(f64::NAN)
}

/// Delta-P1 for light from straight ahead.
pub fn diffusion() -> Result<Figure> {
    worst("slab", |record| if number(record, "mu0") > 0.99 { delta_p1(record) } else { 0.0 })
}

/// Delta-P1 for light from anywhere.
pub fn diffusion_slanting() -> Result<Figure> {
    worst("slab", |record| if record["mu0"].is_number() { delta_p1(record) } else { 0.0 })
}

fn delta_p1(record: &Value) -> f64 {
    DeltaP1::new(&medium(record), number(record, "d"), number(record, "mu0")).totals().1 - number(record, "T")
}

/// Energy within a circle around a pencil of light.
pub fn radial() -> Result<Figure> {
    worst("radial", spread_error)
}

/// Maps by the direct gather.
pub fn golden_direct() -> Result<Figure> {
    worst("golden", |case| Golden::of(case).direct_error())
}

/// Maps by the bank, six texels inside the rim.
pub fn golden_inside() -> Result<Figure> {
    worst("golden", |case| Golden::of(case).bank_errors()[0])
}

/// Maps by the bank, anywhere.
pub fn golden_anywhere() -> Result<Figure> {
    worst("golden", |case| Golden::of(case).bank_errors()[1])
}

/// Records of relief.json with one side lit, by material and shape.
pub fn reliefs<'a>(records: &'a [Value], lit: &str) -> Vec<(String, Vec<&'a Value>)> {
    let mut groups: Vec<(String, Vec<&Value>)> = Vec::new();
    for record in records.iter().filter(|record| record["lit"] == lit) {
        let text = |key: &str| record[key].as_str().unwrap_or("?").to_owned();
        let name = format!("{} {}", text("material"), text("relief"));
        match groups.iter_mut().find(|group| group.0 == name) {
            Some(group) => group.1.push(record),
            None => groups.push((name, vec![record])),
        }
    }
    groups
}

fn relief(lit: &str, fit: Fit, curve: bool) -> Result<Figure> {
    let records = records("relief")?;
    let recipe = |recipe| foliar_translucency::map::Recipe { fit, curve, ..recipe };
    let each: Vec<(String, f64)> =
        reliefs(&records, lit).into_iter().map(|(name, records)| (name, bumps_error(&records, recipe))).collect();
    let words: Vec<String> = each.iter().map(|(name, error)| format!("{name} {error:.3}")).collect();
    Ok(Figure::new(largest(each.iter().map(|each| each.1)), format!("counted photons; {}", words.join(", "))))
}

/// Bumps under five lights, three coefficients.
pub fn relief_linear() -> Result<Figure> {
    relief("relief face", Fit::Uniform, false)
}

/// The same with the curve.
pub fn relief_curve() -> Result<Figure> {
    relief("relief face", Fit::Uniform, true)
}

/// Bumps where light leaves.
pub fn relief_exit() -> Result<Figure> {
    relief("flat face", Fit::Anchor, false)
}

/// Absorption and scattering of inverted leaves.
pub fn leaf_params() -> Result<Figure> {
    worst("leaf_params", |record| leaf_error(record).unwrap_or(f64::NAN))
}

/// R and T of 22 measured leaves in four bands.
pub fn leaves() -> Result<Figure> {
    let text = read("trees/helios_leaf_spectra/leaf_R_T_bands.csv")?;
    // Columns of R, T follows, and the index at that wavelength.
    const BANDS: [(usize, f64); 4] = [(2, 1.4955), (5, 1.4739), (8, 1.4458), (11, 1.43)];
    let rows: Vec<Vec<&str>> = text.lines().skip(1).map(|line| line.split(',').collect::<Vec<_>>()).collect();
    let (mut errors, mut leaves, mut without) = (Vec::new(), 0, 0);
    for row in rows.iter().filter(|row| row.len() == 16) {
        for (column, index) in BANDS {
            let [r, t] = [row[column].trim().parse()?, row[column + 1].trim().parse()?];
            let (error, mirror) = measured_leaf_error(r, t, index).unwrap_or((f64::NAN, true));
            errors.push(error);
            without += usize::from(!mirror);
        }
        leaves += 1;
    }
    if leaves != 22 {
        bail!("{leaves} measured leaves, not 22");
    }
    let text = format!("measured leaves; {} fits, {without} of them measured without the mirror", errors.len());
    Ok(Figure::new(largest(errors), text))
}
