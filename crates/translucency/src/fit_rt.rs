//! From measured reflectance and transmittance to absorption and scattering.

use crate::transport::{AddingDoubling, Medium, MediumError, fresnel_outside};

/// Gauss nodes of the model: against 48 its transmittance is off by 6e-4.
const NODES: usize = 16;
/// Steps of Newton; from the start below seven suffice.
const STEPS: usize = 60;
/// Largest sum of squared differences that counts as found.
const FOUND: f64 = 1e-16;
/// Step of the numeric derivative, in logarithms.
const STEP: f64 = 1e-5;
/// Longest step, in logarithms.
const LONGEST: f64 = 1.0;

/// Why a measurement has no tissue.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum FitError {
    /// More light than came.
    #[error("R + T = {sum}: must be below 1 (R = {reflectance}, T = {transmittance})")]
    TooBright {
        /// Reflectance.
        reflectance: f64,
        /// Transmittance.
        transmittance: f64,
        /// Both together.
        sum: f64,
    },
    /// Not a share.
    #[error("{name} = {value}: must be above 0 and below 1")]
    NoShare {
        /// Which.
        name: &'static str,
        /// What it is.
        value: f64,
    },
    /// Less light comes back than the surface alone sends.
    #[error(
        "R = {reflectance}: below {surface:.4}, what the surface alone mirrors at index {index}; if the measurement \
             left the mirror out, say --mirror excluded"
    )]
    Mirror {
        /// Reflectance.
        reflectance: f64,
        /// The surface's own.
        surface: f64,
        /// Index of refraction.
        index: f64,
    },
    /// No tissue of this anisotropy and index has both numbers.
    #[error(
        "R = {reflectance}, T = {transmittance}: no tissue of anisotropy {anisotropy} and index {index} has both; \
             nearest R = {nearest_r:.4}, T = {nearest_t:.4}: measure again, or say another --index or --anisotropy"
    )]
    NoTissue {
        /// Reflectance asked for.
        reflectance: f64,
        /// Transmittance asked for.
        transmittance: f64,
        /// Anisotropy given.
        anisotropy: f64,
        /// Index given.
        index: f64,
        /// Nearest reflectance.
        nearest_r: f64,
        /// Nearest transmittance.
        nearest_t: f64,
    },
    /// Numbers that no tissue has.
    #[error(transparent)]
    Medium(#[from] MediumError),
}

/// What was measured, for light from straight ahead.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Measured {
    /// Reflectance.
    pub reflectance: f64,
    /// Transmittance.
    pub transmittance: f64,
    /// Whether the surface's own mirror is part of the reflectance.
    pub with_mirror: bool,
}

/// Absorption and scattering of a leaf of this thickness, anisotropy and index that answers as measured.
///
/// # Errors
/// [`FitError`].
pub fn fit_rt(measured: Measured, thickness_mm: f64, anisotropy: f64, index: f64) -> Result<Medium, FitError> {
    let Measured { reflectance, transmittance, with_mirror } = measured;
    for (name, value) in [("R", reflectance), ("T", transmittance)] {
        if !(value > 0.0 && value < 1.0) {
            return Err(FitError::NoShare { name, value });
        }
    }
    Medium::reduced(1.0, 1.0, anisotropy, index)?;
    let surface = fresnel_outside(1.0, index);
    let target = [reflectance + if with_mirror { 0.0 } else { surface }, transmittance];
    if target[0] + target[1] >= 1.0 {
        return Err(FitError::TooBright { reflectance: target[0], transmittance, sum: target[0] + target[1] });
    }
    if target[0] <= surface {
        return Err(FitError::Mirror { reflectance, surface, index });
    }
    let medium = |x: [f64; 2]| Medium::reduced(libm::exp(x[0]), libm::exp(x[1]), anisotropy, index);
    let answer = |x: [f64; 2]| -> Result<[f64; 2], FitError> {
        let totals = AddingDoubling::one(&medium(x)?, thickness_mm, 1.0, NODES);
        Ok([totals.reflectance, totals.transmittance])
    };
    let (x, nearest) = search(target, thickness_mm, answer)?;
    let missed = [nearest[0] - target[0], nearest[1] - target[1]];
    if missed[0] * missed[0] + missed[1] * missed[1] > FOUND {
        let [nearest_r, nearest_t] = nearest;
        return Err(FitError::NoTissue {
            reflectance: target[0],
            transmittance,
            anisotropy,
            index,
            nearest_r,
            nearest_t,
        });
    }
    Ok(medium(x)?)
}

type Pair = [f64; 2];

/// Newton in the logarithms, each step halved until it gets nearer.
fn search(
    target: Pair,
    thickness: f64,
    answer: impl Fn(Pair) -> Result<Pair, FitError>,
) -> Result<(Pair, Pair), FitError> {
    let miss = |value: Pair| {
        // In logarithms too: a dark leaf's T of 1e-3 counts as much as its R.
        let [r, t] = [0, 1].map(|i| libm::log(value[i].max(f64::MIN_POSITIVE) / target[i]));
        [r, t]
    };
    let size = |m: Pair| m[0] * m[0] + m[1] * m[1];
    let mut x = [libm::log(0.5 / thickness), libm::log(1.5 / thickness)];
    let mut value = answer(x)?;
    for _ in 0..STEPS {
        let here = miss(value);
        if size(here) < FOUND * FOUND {
            break;
        }
        let right = miss(answer([x[0] + STEP, x[1]])?);
        let up = miss(answer([x[0], x[1] + STEP])?);
        let [a, c] = [0, 1].map(|i| (right[i] - here[i]) / STEP);
        let [b, d] = [0, 1].map(|i| (up[i] - here[i]) / STEP);
        let determinant = a * d - b * c;
        let step = [-(d * here[0] - b * here[1]) / determinant, -(a * here[1] - c * here[0]) / determinant];
        let mut scale = (LONGEST / step[0].abs().max(step[1].abs())).min(1.0);
        let mut moved = None;
        while scale.is_finite() && scale > f64::EPSILON {
            let next = [x[0] + scale * step[0], x[1] + scale * step[1]];
            let there = answer(next)?;
            if size(miss(there)) < size(here) {
                moved = Some((next, there));
                break;
            }
            scale /= 2.0;
        }
        let Some(found) = moved else { break };
        (x, value) = found;
    }
    Ok((x, value))
}
