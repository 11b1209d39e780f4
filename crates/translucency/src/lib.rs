//! Leaf translucency: light that passes through a leaf, as three coefficients per texel (Kusternig07 section 3.5, Habel07).

mod fit_rt;
mod kernel;
pub mod light;
pub mod map;
mod presets;
pub mod room;
#[cfg(test)]
mod tests;
pub mod transport;

pub use fit_rt::{FitError, Measured, fit_rt};
pub use presets::{PRESETS, Preset, Sample};
pub use room::Translucency;
