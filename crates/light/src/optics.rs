//! What a leaf reflects and lets through, per side and color: kinds of leaves, or a person's own numbers.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// Red, green, blue: of 610, 550 and 450 nm.
pub type Rgb = [f64; 3];

/// A kind of leaf. Reflectances and transmittances are those of PROSPECT-D (Feret 2017) for usual contents of pigment,
/// water and dry matter, the same that the kinds of `foliar-translucency` were inverted from; PROSPECT knows one slab,
/// so both sides are alike.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "lowercase")]
pub enum OpticsKind {
    /// A broad leaf in summer.
    #[default]
    Typical,
    /// A thin leaf in spring.
    Young,
    /// A thick leaf, much chlorophyll.
    Dark,
    /// A leaf in autumn.
    Senescent,
}

/// What the two sides of a leaf do to light. A side is named for the light that falls on it.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
#[serde(rename_all = "camelCase")]
pub struct Optics {
    /// Share of the light on the front that comes back (rho_rf of Boulanger08 eq. 4).
    pub reflectance_front: Rgb,
    /// Share of the light on the back that comes back (rho_rb).
    pub reflectance_back: Rgb,
    /// Share of the light on the front that leaves on the back (rho_tf).
    pub transmittance_front: Rgb,
    /// Share of the light on the back that leaves on the front (rho_tb).
    pub transmittance_back: Rgb,
}

impl OpticsKind {
    /// Its optics.
    pub fn optics(self) -> Optics {
        let (reflectance, transmittance) = match self {
            OpticsKind::Typical => ([0.0712, 0.1512, 0.0413], [0.0626, 0.1503, 0.0014]),
            OpticsKind::Young => ([0.1094, 0.2002, 0.0429], [0.1771, 0.2903, 0.0174]),
            OpticsKind::Dark => ([0.0559, 0.1228, 0.0410], [0.0137, 0.0567, 0.0]),
            OpticsKind::Senescent => ([0.2856, 0.2821, 0.0678], [0.1591, 0.1484, 0.0107]),
        };
        Optics {
            reflectance_front: reflectance,
            reflectance_back: reflectance,
            transmittance_front: transmittance,
            transmittance_back: transmittance,
        }
    }
}

impl Optics {
    /// Refuses a side that gives off more light than falls on it.
    ///
    /// # Errors
    /// Name of the side, what it gives off in which color, and what would be right.
    pub fn check(&self) -> Result<(), (&'static str, String)> {
        let sides = [
            ("reflectance_front", "transmittance_front", self.reflectance_front, self.transmittance_front),
            ("reflectance_back", "transmittance_back", self.reflectance_back, self.transmittance_back),
        ];
        for (name, other, reflectance, transmittance) in sides {
            for (band, (r, t)) in ["red", "green", "blue"].into_iter().zip(reflectance.into_iter().zip(transmittance)) {
                if !(r >= 0.0 && t >= 0.0 && r + t <= 1.0) {
                    let reason = format!(
                        "and {other} are {r} and {t} in {band}, {} together: must each be 0 or above and at most 1 \
                         together (a leaf gives off no more light than falls on it); lower one of them",
                        r + t
                    );
                    return Err((name, reason));
                }
            }
        }
        Ok(())
    }
}
