//! Light of a leaf from eight optical depths, at run time: the paper's model, and one that holds in dense crowns
//! (Boulanger08 sections 3 to 5).
//!
//! Everything is in f64 and is the truth that the shader includes of `crates/light/shaders` are held against. What comes
//! from outside is checked once, by the constructors; after them nothing here can fail or give a number that is not finite.

mod closed;
mod cosines;
mod given;
mod paper;
mod sh;
mod slices;

#[cfg(test)]
mod tests;

pub use closed::{light, light_sh};
pub use cosines::octant_cosines;
pub use given::{Leaf, ModelError, Optics, Sides, Sky, Sun};
pub use paper::{Tree, boulanger08, boulanger08_by};
pub use sh::transmittance as harmonic_transmittance;
pub use slices::{Slant, single_bounce};

/// Light that falls onto the two sides of a leaf, by the way it took. Irradiance in the unit that sun and sky came in.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Light {
    /// Straight from the sun.
    pub sun: Sides,
    /// From the sun by way of other leaves.
    pub sun_indirect: Sides,
    /// Straight from the sky and the ground.
    pub sky: Sides,
    /// From the sky by way of other leaves.
    pub sky_indirect: Sides,
}

impl Light {
    /// All of it.
    pub fn total(&self) -> Sides {
        self.sun + self.sun_indirect + self.sky + self.sky_indirect
    }
}
