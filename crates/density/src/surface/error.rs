//! Why a surface cannot be meshed.

use super::{Balls, SurfaceParams};

/// Why a surface cannot be meshed.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum SurfaceError {
    /// A parameter is out of range.
    #[error("{name} = {value}: must be finite and {rule}")]
    Parameter {
        /// Which.
        name: &'static str,
        /// What it is.
        value: f64,
        /// What would be right.
        rule: &'static str,
    },
    /// A ball is out of range.
    #[error("ball {index}: position and weight must be finite and the weight 0 or above, not {weight}")]
    Ball {
        /// Which.
        index: usize,
        /// Its weight.
        weight: f32,
    },
    /// Cells so small, or balls so far apart, that the mesh would not fit.
    #[error("cell_m = {cell_m}: the mesh would not fit into memory_mb = {memory_mb}; {}", remedy(*.fits))]
    Memory {
        /// Edge of a cell, meters.
        cell_m: f64,
        /// What is allowed, megabytes.
        memory_mb: f64,
        /// A cell that would do.
        fits: Option<f64>,
    },
}

fn remedy(fits: Option<f64>) -> String {
    match fits {
        Some(cell) => format!("cell_m = {cell} would"),
        None => "no cell up to the radius would: allow more memory_mb, or a larger radius_m".into(),
    }
}

impl SurfaceError {
    /// Refuses what no surface can be made of.
    pub(super) fn check(balls: &Balls, params: &SurfaceParams) -> Result<(), SurfaceError> {
        let radius = balls.radius_m;
        let cell = params.cell_m.unwrap_or(radius);
        let rules: [(&str, f64, bool, &str); 4] = [
            ("radius_m", radius, radius > 0.0, "above 0 (a leaf's influence, Luft07 eq. 2)"),
            (
                "threshold",
                balls.threshold,
                balls.threshold > 0.0,
                "above 0: at 0 the surface is the very edge of the balls, where the gradient vanishes and no normal exists (Luft07 eq. 3)",
            ),
            (
                "cell_m",
                cell,
                cell > 0.0 && cell <= radius,
                "above 0 and at most radius_m: larger cells miss whole balls",
            ),
            ("memory_mb", params.memory_mb, params.memory_mb > 0.0, "above 0"),
        ];
        if let Some((name, value, _, rule)) =
            rules.into_iter().find(|(_, value, holds, _)| !(value.is_finite() && *holds))
        {
            return Err(SurfaceError::Parameter { name, value, rule });
        }
        let sound = |g: &crate::Generator| g.position.is_finite() && g.weight.is_finite() && g.weight >= 0.0;
        match balls.generators.iter().position(|g| !sound(g)) {
            Some(index) => Err(SurfaceError::Ball { index, weight: balls.generators[index].weight }),
            None => Ok(()),
        }
    }
}
