//! Spread as transmission of patterns by their frequency (MTF), 1 for uniform light: the shape of diffusion, and a narrow
//! Gaussian for light that delta-P1 counts as unscattered.

use crate::transport::{Boundary, DeltaP1, Layer, Medium, Multipole};

/// Spread of the forward light that delta-P1 takes out: width^2 = this g^2 (reduced scattering) d^3. Measured against
/// counted photons on 12 slabs.
const FORWARD: f64 = 0.1;

/// Where the shape comes from.
#[derive(Clone, Copy, Debug)]
enum Shape {
    Diffusion { scattered: DeltaP1, uniform: f64, beam: f64, width: f64 },
    Multipole(Multipole),
}

/// The spread of one thickness.
#[derive(Clone, Copy, Debug)]
pub struct Spread(Shape);

impl Spread {
    /// Delta-P1's shape.
    pub fn diffusion(medium: &Medium, thickness_mm: f64, boundary: &Boundary) -> Spread {
        let scattered = DeltaP1::shape(medium, thickness_mm, boundary);
        let (uniform, passed) = (scattered.transmitted(0.0), scattered.unscattered());
        let total = uniform + passed;
        let g = medium.anisotropy;
        let square = FORWARD * g * g * medium.reduced_scattering() * thickness_mm;
        Spread(Shape::Diffusion {
            scattered,
            uniform,
            // A leaf that passes nothing spreads nothing.
            beam: if total > 0.0 { passed / total } else { 1.0 },
            width: square * thickness_mm * thickness_mm,
        })
    }

    /// The multipole's shape.
    pub fn multipole(medium: &Medium, thickness_mm: f64) -> Spread {
        Spread(Shape::Multipole(Multipole::new(medium, thickness_mm, 1.0)))
    }

    /// Transmission of a pattern of `frequency` (radians per mm) over that of uniform light.
    pub fn at(&self, frequency: f64) -> f64 {
        match &self.0 {
            Shape::Multipole(multipole) => multipole.spread(frequency),
            Shape::Diffusion { scattered, uniform, beam, width } => {
                let narrow = beam * libm::exp(-frequency * frequency * width / 4.0);
                if *uniform > 0.0 { narrow + (1.0 - beam) * scattered.transmitted(frequency) / uniform } else { narrow }
            }
        }
    }
}

/// One tissue that stands for all layers where only the shape is asked: means by thickness.
pub fn mean_medium(layers: &[Layer]) -> Option<(Medium, f64)> {
    let first = layers.first()?.medium;
    let total: f64 = layers.iter().map(|layer| layer.thickness_mm).sum();
    if layers.len() == 1 || total <= 0.0 {
        return Some((first, total));
    }
    let mean = |of: &dyn Fn(&Medium) -> f64| {
        layers.iter().map(|layer| of(&layer.medium) * layer.thickness_mm).sum::<f64>() / total
    };
    let scattering = mean(&|m| m.scattering);
    let reduced = mean(&Medium::reduced_scattering);
    let anisotropy = if scattering > 0.0 { 1.0 - reduced / scattering } else { 0.0 };
    Some((Medium { absorption: mean(&|m| m.absorption), scattering, anisotropy, index: first.index }, total))
}
