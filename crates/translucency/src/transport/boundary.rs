//! The surface between tissue and air: Fresnel's equations and the moments that diffusion needs of them.

use foliar_numerics::gauss_legendre;

/// Below this excess over 1 an index is air's own: what is lost stays below (index^2 - 1), the share of directions that
/// total reflection could keep inside.
const MATCHED: f64 = 1e-6;
/// Fresnel's equations are 0/0 at grazing light, and a beam inside would have no depth.
pub const LEAST_COSINE: f64 = 1e-4;
/// The same for the ray in air.
const GRAZING: f64 = 1e-9;
/// Nodes for the moments: the square root at the critical angle is taken out, so few suffice.
const MOMENT_NODES: usize = 64;

/// Cosine inside of a ray that meets the surface from air at cosine `outside` (Snell).
pub fn refracted(outside: f64, index: f64) -> f64 {
    (1.0 - (1.0 - outside * outside).max(0.0) / (index * index)).max(0.0).sqrt()
}

/// Cosine inside beyond which nothing leaves.
pub fn critical_cosine(index: f64) -> f64 {
    if is_matched(index) { 0.0 } else { (1.0 - 1.0 / (index * index)).max(0.0).sqrt() }
}

/// Whether the surface is none.
pub fn is_matched(index: f64) -> bool {
    index - 1.0 < MATCHED
}

/// Unpolarized reflectance seen from inside, by the cosine inside; 1 beyond the critical angle.
pub fn fresnel_inside(inside: f64, index: f64) -> f64 {
    let radicand = 1.0 - index * index * (1.0 - inside * inside);
    if radicand <= 0.0 {
        return if is_matched(index) { 0.0 } else { 1.0 };
    }
    reflectance(inside, radicand.sqrt(), index)
}

/// Unpolarized reflectance seen from air, by the cosine in air.
pub fn fresnel_outside(outside: f64, index: f64) -> f64 {
    reflectance(refracted(outside, index), outside.max(GRAZING), index)
}

fn reflectance(inside: f64, outside: f64, index: f64) -> f64 {
    if is_matched(index) {
        return 0.0;
    }
    let s = (index * inside - outside) / (index * inside + outside);
    let p = (index * outside - inside) / (index * outside + inside);
    (s * s + p * p) / 2.0
}

/// Reflectance and transmittance of a plate that does not scatter, by the reflectance of its surfaces and the share of
/// light that passes its inside once.
pub fn plate(surface: f64, passed: f64) -> (f64, f64) {
    if surface >= 1.0 {
        return (1.0, 0.0);
    }
    let through = (1.0 - surface) * (1.0 - surface) * passed / (1.0 - surface * surface * passed * passed);
    (surface + surface * passed * through, through)
}

/// Moments of the inner reflectance, and what follows for diffusion.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Boundary {
    /// 2 int F mu dmu: share of diffuse flux that the surface keeps inside.
    pub flux: f64,
    /// 3 int F mu^2 dmu.
    pub net: f64,
}

impl Boundary {
    /// Moments of a surface.
    pub fn new(index: f64) -> Boundary {
        let critical = critical_cosine(index);
        let mut moments = [critical * critical, critical * critical * critical];
        // mu = critical + (1 - critical) t^2 takes out the root at the critical angle.
        for (t, weight) in gauss_legendre(MOMENT_NODES, 0.0, 1.0) {
            let mu = critical + (1.0 - critical) * t * t;
            let part = weight * 2.0 * t * (1.0 - critical) * fresnel_inside(mu, index);
            moments[0] += 2.0 * mu * part;
            moments[1] += 3.0 * mu * mu * part;
        }
        Boundary { flux: moments[0], net: moments[1] }
    }

    /// Mismatch by partial currents (d'Eon's A): what `diffusion` uses.
    pub fn partial_current(&self) -> f64 {
        (1.0 + self.net) / (1.0 - self.flux)
    }

    /// Mismatch as Donner and Jensen have it: what `multipole` uses.
    pub fn donner(&self) -> f64 {
        (1.0 + self.flux) / (1.0 - self.flux)
    }
}
