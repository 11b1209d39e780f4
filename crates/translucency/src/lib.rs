//! Leaf translucency: light that passes through a leaf, as three coefficients per texel (Kusternig07 section 3.5, Habel07).

mod fit_rt;
pub mod light;
mod presets;
#[cfg(test)]
mod tests;
pub mod transport;

pub use fit_rt::{FitError, Measured, fit_rt};
pub use presets::{PRESETS, Preset, Sample};
