//! The multipole of Donner and H. W. Jensen 2005, summed in closed form: what Kusternig07 used.
//!
//! The image series itself does not converge without absorption (every symmetric cut of it gives 0); the sum is
//! geometric, so none is needed. Where a mean free path is longer than the leaf is thick, its source lies outside the
//! leaf and the model is wrong by up to .25: it is here to be compared with.

use super::{Boundary, Medium, fresnel_outside};

/// A medium that does nothing has no mean free path: this, 1/mm, keeps the arithmetic finite.
const LEAST_EXTINCTION: f64 = 1e-100;

/// The multipole of one slab.
#[derive(Clone, Copy, Debug)]
pub struct Multipole {
    albedo: f64,
    path: f64,
    offset: f64,
    thickness: f64,
    decay: f64,
    diffusion: f64,
    absorption: f64,
    entered: f64,
}

impl Multipole {
    /// A slab of tissue lit at cosine `outside` in air.
    pub fn new(medium: &Medium, thickness_mm: f64, outside: f64) -> Multipole {
        Multipole::with(medium, thickness_mm, outside, &Boundary::new(medium.index))
    }

    /// The same with moments of the surface at hand.
    pub fn with(medium: &Medium, thickness_mm: f64, outside: f64, boundary: &Boundary) -> Multipole {
        let reduced = medium.reduced_scattering();
        let extinction = (medium.absorption + reduced).max(LEAST_EXTINCTION);
        let diffusion = 1.0 / (3.0 * extinction);
        Multipole {
            albedo: reduced / extinction,
            path: 1.0 / extinction,
            offset: 2.0 * boundary.donner() * diffusion,
            thickness: thickness_mm,
            decay: (3.0 * medium.absorption * extinction).sqrt(),
            diffusion,
            absorption: medium.absorption,
            entered: 1.0 - fresnel_outside(outside, medium.index),
        }
    }

    /// Share of the light that comes out on the far side.
    pub fn transmittance(&self) -> f64 {
        self.entered * self.albedo * self.passed(self.decay)
    }

    /// Share that comes back, the surface's own mirror left out.
    pub fn reflectance(&self) -> f64 {
        let length = self.thickness + 2.0 * self.offset;
        let depth = self.thickness + self.offset - self.path;
        self.entered * self.albedo * ratio(self.decay, depth, self.offset, length)
    }

    /// Transmission of a pattern of `frequency` (radians per mm) over that of uniform light.
    pub fn spread(&self, frequency: f64) -> f64 {
        let decay = (self.absorption / self.diffusion + frequency * frequency).sqrt();
        self.passed(decay) / self.passed(self.decay)
    }

    fn passed(&self, decay: f64) -> f64 {
        ratio(decay, self.path + self.offset, self.offset, self.thickness + 2.0 * self.offset)
    }
}

/// sinh(k a) cosh(k b) / sinh(k c), scaled so that nothing overflows and nothing cancels.
fn ratio(decay: f64, a: f64, b: f64, c: f64) -> f64 {
    if decay * c < f64::EPSILON {
        return a / c;
    }
    let minus = |x: f64| -libm::expm1(-2.0 * decay * x);
    libm::exp(decay * (a + b - c)) * minus(a) * (1.0 + libm::exp(-2.0 * decay * b)) / (2.0 * minus(c))
}
