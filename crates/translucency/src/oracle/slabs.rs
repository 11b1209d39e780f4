//! Flat leaves: totals, layers, the spread of a pencil of light, measured leaves.

use super::{largest, medium, number, numbers};
use crate::kernel::Spread;
use crate::transport::{AddingDoubling, Boundary, Layer, Medium, Totals, fresnel_outside};
use crate::{FitError, Measured, fit_rt};
use foliar_numerics::gauss_legendre;
use serde_json::Value;

/// R and T of a record of slab.json by adding-doubling with so many nodes; where it names no direction, of diffuse light.
pub fn slab_totals(record: &Value, nodes: usize) -> Totals {
    let layer = Layer { medium: medium(record), thickness_mm: number(record, "d") };
    let cosine = record["mu0"].as_f64();
    let leaf = AddingDoubling::solve(&[layer], &[cosine.unwrap_or(1.0)], nodes);
    if cosine.is_some() { leaf.front[0] } else { leaf.front_diffuse }
}

/// Largest miss of R and T of a record of slab.json.
pub fn slab_error(record: &Value, nodes: usize) -> f64 {
    let totals = slab_totals(record, nodes);
    largest([totals.reflectance - number(record, "R"), totals.transmittance - number(record, "T")])
}

/// Largest miss of any total of a case of layers.json, both sides, slanting and diffuse.
pub fn layers_error(case: &Value, nodes: usize) -> f64 {
    let index = number(case, "eta");
    let layer = |l: &[f64]| Layer {
        medium: Medium { absorption: l[0], scattering: l[1], anisotropy: l[2], index },
        thickness_mm: l[3],
    };
    let layers: Vec<Layer> = numbers(&case["layers"]).chunks_exact(4).map(layer).collect();
    let leaf = AddingDoubling::solve(&layers, &numbers(&case["mu0"]), nodes);
    let list = |name: &str, ours: &dyn Fn(usize) -> f64| {
        largest(numbers(&case[name]).iter().enumerate().map(|(i, exact)| ours(i) - exact))
    };
    largest([
        list("R", &|i| leaf.front[i].reflectance),
        list("T", &|i| leaf.front[i].transmittance),
        list("R_back", &|i| leaf.back[i].reflectance),
        list("T_back", &|i| leaf.back[i].transmittance),
        leaf.front_diffuse.reflectance - number(case, "Rdiff"),
        leaf.front_diffuse.transmittance - number(case, "Tdiff"),
        leaf.back_diffuse.reflectance - number(case, "Rdiff_back"),
        leaf.back_diffuse.transmittance - number(case, "Tdiff_back"),
    ])
}

/// Largest miss of the energy within a circle around a pencil of light, a record of radial.json.
pub fn spread_error(record: &Value) -> f64 {
    const NODES: usize = 600;
    /// Waves that are summed, per thickness: what no wave resolves lies at the entry itself.
    const WAVES: f64 = 60.0;
    let (medium, d) = (medium(record), number(record, "d"));
    let spread = Spread::diffusion(&medium, d, &Boundary::new(medium.index));
    let point = spread.at(1e6);
    let part = |(q, w)| (q, w * (spread.at(q) - point));
    let waves: Vec<(f64, f64)> = gauss_legendre(NODES, 0.0, WAVES / d).into_iter().map(part).collect();
    let energy = |r: f64| point + waves.iter().map(|(q, part)| part * r * libm::j1(q * r)).sum::<f64>();
    let (radii, seen) = (numbers(&record["r"]), numbers(&record["E"]));
    largest(radii.iter().zip(seen).map(|(r, seen)| energy(*r) - seen))
}

/// Relative miss of absorption and reduced scattering of a record of leaf_params.json, found from its R and T.
///
/// # Errors
/// [`FitError`] where no tissue is found.
pub fn leaf_error(record: &Value) -> Result<f64, FitError> {
    let measured = Measured { reflectance: number(record, "R"), transmittance: number(record, "T"), with_mirror: true };
    let medium = fit_rt(measured, number(record, "d"), number(record, "g"), number(record, "eta"))?;
    let (absorption, scattering) = (number(record, "sa"), number(record, "ssp"));
    Ok(largest([medium.absorption / absorption - 1.0, medium.reduced_scattering() / scattering - 1.0]))
}

/// A measured leaf of .2 mm at one wavelength: largest miss of R and T of the tissue that is found, and whether R holds the
/// mirror. Some samples were measured without: their R lies below what the surface alone sends back.
///
/// # Errors
/// [`FitError`] where no tissue is found either way.
pub fn measured_leaf_error(reflectance: f64, transmittance: f64, index: f64) -> Result<(f64, bool), FitError> {
    const THICKNESS_MM: f64 = 0.2;
    const NODES: usize = 16;
    let anisotropy = crate::presets::ANISOTROPY;
    let fitted =
        |with_mirror| fit_rt(Measured { reflectance, transmittance, with_mirror }, THICKNESS_MM, anisotropy, index);
    let (medium, mirror) = match fitted(true) {
        Ok(medium) => (medium, true),
        Err(FitError::Mirror { .. } | FitError::NoTissue { .. }) => (fitted(false)?, false),
        Err(error) => return Err(error),
    };
    let totals = AddingDoubling::one(&medium, THICKNESS_MM, 1.0, NODES);
    let surface = if mirror { 0.0 } else { fresnel_outside(1.0, index) };
    Ok((largest([totals.reflectance - surface - reflectance, totals.transmittance - transmittance]), mirror))
}
