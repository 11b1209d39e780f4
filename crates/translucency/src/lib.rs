//! Leaf translucency: light that passes through a leaf, as three coefficients per texel (Kusternig07 section 3.5, Habel07).

mod fit_rt;
pub mod kernel;
pub mod light;
pub mod map;
pub mod oracle;
pub mod photo;
mod presets;
pub mod room;
pub mod runtime;
pub mod scan;
#[cfg(test)]
mod tests;
pub mod transport;

pub use fit_rt::{FitError, Measured, fit_rt};
pub use presets::{PRESETS, Preset, Sample};
pub use room::Translucency;
pub use scan::Leafscan;
