//! Delta-P1 diffusion with partial-current boundaries, in closed form and in forms that neither overflow nor cancel.
//!
//! The phase function keeps a share g^2 of the scattering as unscattered light (delta), the rest is P1: the source is
//! the exponential of the refracted beam, not a point, so a leaf may be thinner than a mean free path.

use super::boundary::{LEAST_COSINE, fresnel_outside, refracted};
use super::{Boundary, Medium};

/// Below this kappa d the quotient of two nearly equal integrals is replaced by its limit; error about 3e-8 at ten times it.
const THIN: f64 = 1e-3;
/// Scattering times thickness below which a leaf is a clear plate.
const CLEAR: f64 = 1e-12;

/// One slab, lit by a beam.
#[derive(Clone, Copy, Debug)]
pub struct DeltaP1 {
    thickness: f64,
    diffusion: f64,
    /// 2 A D: how far beyond the surface the fluence would vanish, mm.
    extrapolation: f64,
    /// Decay of the beam along the slab's axis, 1/mm.
    beam: f64,
    /// Scattering out of the beam, and its forward part.
    source: f64,
    forward: f64,
    absorption: f64,
    surface: f64,
    clear: bool,
}

impl DeltaP1 {
    /// A slab lit at cosine `outside` in air.
    pub fn new(medium: &Medium, thickness_mm: f64, outside: f64) -> DeltaP1 {
        let surface = fresnel_outside(outside, medium.index);
        DeltaP1::with(medium, thickness_mm, outside, surface, &Boundary::new(medium.index))
    }

    /// The same with moments of the surface at hand.
    pub fn shape(medium: &Medium, thickness_mm: f64, boundary: &Boundary) -> DeltaP1 {
        DeltaP1::with(medium, thickness_mm, 1.0, fresnel_outside(1.0, medium.index), boundary)
    }

    fn with(medium: &Medium, thickness: f64, outside: f64, surface: f64, boundary: &Boundary) -> DeltaP1 {
        let g = medium.anisotropy;
        let scattering = medium.scattering * (1.0 - g * g);
        let cosine = refracted(outside, medium.index).max(LEAST_COSINE);
        let reduced = (medium.absorption + medium.reduced_scattering()).max(f64::MIN_POSITIVE);
        let diffusion = 1.0 / (3.0 * reduced);
        let source = scattering / cosine;
        DeltaP1 {
            thickness,
            diffusion,
            extrapolation: 2.0 * boundary.partial_current() * diffusion,
            beam: (medium.absorption + scattering) / cosine,
            source,
            forward: 3.0 * diffusion * g / (1.0 + g) * source * cosine,
            absorption: medium.absorption,
            surface,
            clear: scattering * thickness < CLEAR,
        }
    }

    /// Share of the entered light that passes unscattered.
    pub fn unscattered(&self) -> f64 {
        libm::exp(-self.beam * self.thickness)
    }

    /// (R, T) per unit of light on the outside, the surface's mirror included: unscattered light bounces between the
    /// surfaces as a beam.
    pub fn totals(&self) -> (f64, f64) {
        let (surface, passed) = (self.surface, self.unscattered());
        if surface >= 1.0 {
            return (1.0, 0.0);
        }
        let (back, through) = (self.reflected(0.0), self.transmitted(0.0));
        let bounces = 1.0 / (1.0 - surface * surface * passed * passed);
        let mirrored = surface * passed * bounces;
        let ahead = through + (1.0 - surface) * passed;
        let t = (1.0 - surface) * (bounces * ahead + mirrored * back);
        let r = surface + (1.0 - surface) * (bounces * back + mirrored * ahead);
        (r, t)
    }

    /// Scattered light that leaves the far side, per unit entered, of a pattern of `frequency` (radians per mm).
    pub fn transmitted(&self, frequency: f64) -> f64 {
        if self.clear {
            return 0.0;
        }
        let terms = self.terms(frequency);
        let rim = self.diffusion * (2.0 * terms.lit * terms.decayed - terms.far * terms.rim) / terms.whole;
        ((self.source + self.forward * self.beam) * terms.through / terms.whole
            + rim
            + self.forward * self.unscattered())
        .max(0.0)
    }

    /// Scattered light that comes back, per unit entered.
    pub fn reflected(&self, frequency: f64) -> f64 {
        if self.clear {
            return 0.0;
        }
        let terms = self.terms(frequency);
        let rim = self.diffusion * (terms.lit * terms.rim - 2.0 * terms.far * terms.decayed) / terms.whole;
        (self.source + self.forward * self.beam) * terms.back / terms.whole - (rim + self.forward)
    }

    fn terms(&self, frequency: f64) -> Terms {
        let (d, h, m) = (self.thickness, self.extrapolation, self.beam);
        let kappa = (self.absorption / self.diffusion + frequency * frequency).sqrt();
        let decayed = libm::exp(-kappa * d);
        let ahead = libm::exp(-kappa.min(m) * d) * decay_integral((m - kappa).abs(), d);
        let astern = decayed * decay_integral(m + kappa, d);
        let near = decay_integral(m + kappa, d);
        let far = decayed * ahead;
        let (ahead_slope, near_slope) = if kappa * d < THIN {
            let bracket = (1.0 - (1.0 + m * d) * libm::exp(-m * d)) / (m * m);
            (2.0 * decayed * bracket, 2.0 * decayed * (d * decay_integral(m, d) - bracket))
        } else {
            ((ahead - astern) / kappa, (near - far) / kappa)
        };
        let lit = -h / self.diffusion * self.forward;
        let twice = decayed * decayed;
        Terms {
            decayed,
            whole: (1.0 + h * h * kappa * kappa) * decay_integral(kappa, 2.0 * d) + 2.0 * h * (1.0 + twice),
            through: ahead_slope + h * (ahead + astern),
            back: near_slope + h * (near + far),
            lit,
            far: -lit * libm::exp(-m * d),
            rim: (1.0 + twice) + h * kappa * (1.0 - twice),
        }
    }
}

/// Parts of the closed form that both sides share.
struct Terms {
    decayed: f64,
    whole: f64,
    through: f64,
    back: f64,
    lit: f64,
    far: f64,
    rim: f64,
}

/// int_0^d e^(-x t) dt.
fn decay_integral(x: f64, d: f64) -> f64 {
    const SERIES: f64 = 1e-8;
    if (x * d).abs() < SERIES { d * (1.0 - x * d / 2.0) } else { -libm::expm1(-x * d) / x }
}
