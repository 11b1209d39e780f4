//! What a photograph of a leaf lets one guess where nothing was measured: how thick it is here and there, and what color
//! light has that came through. Estimates, and called so wherever they are stored.

mod color;
mod thickness;

pub use color::ColorEstimate;
pub use thickness::{Look, Veins, thickness_from_photo};
