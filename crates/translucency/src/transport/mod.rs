//! Light through a flat leaf: what share of it comes back (R), what share comes out on the far side (T).

mod adding;
mod boundary;
mod diffusion;
mod matrix;
mod medium;
mod multipole;

pub use adding::{AddingDoubling, Totals};
pub use boundary::{Boundary, fresnel_inside, fresnel_outside, plate, refracted};
pub use diffusion::DeltaP1;
pub use medium::{Layer, Medium, MediumError};
pub use multipole::Multipole;
