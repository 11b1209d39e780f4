//! What a leaf's tissue does to light, in numbers per millimeter.

/// Henyey-Greenstein beyond which nothing is known to be right: backward peaks do not occur in tissue.
const LEAST_ANISOTROPY: f64 = -0.95;

/// Tissue: absorption, scattering, its anisotropy (Henyey-Greenstein), and its index of refraction in air.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Medium {
    /// Absorption, 1/mm.
    pub absorption: f64,
    /// Scattering, 1/mm: not the reduced one.
    pub scattering: f64,
    /// Mean cosine of scattering.
    pub anisotropy: f64,
    /// Index of refraction; air outside.
    pub index: f64,
}

/// One layer of a leaf, listed from the lit side. All layers of a leaf share the index of the first.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Layer {
    /// What it is made of.
    pub medium: Medium,
    /// How thick it is, mm.
    pub thickness_mm: f64,
}

/// Why numbers are no tissue.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
#[error("{name} = {value}: must be {rule}")]
#[non_exhaustive]
pub struct MediumError {
    /// Which number.
    pub name: &'static str,
    /// What it is.
    pub value: f64,
    /// What would be right.
    pub rule: &'static str,
}

impl Medium {
    /// Tissue by its reduced scattering, which is what measurements tell.
    ///
    /// # Errors
    /// [`MediumError`] for what no tissue has.
    pub fn reduced(absorption: f64, reduced: f64, anisotropy: f64, index: f64) -> Result<Medium, MediumError> {
        if anisotropy >= 1.0 {
            return Err(MediumError { name: "anisotropy", value: anisotropy, rule: "below 1" });
        }
        Medium { absorption, scattering: reduced / (1.0 - anisotropy), anisotropy, index }.checked()
    }

    /// The same, if it is tissue.
    ///
    /// # Errors
    /// [`MediumError`] for negative or infinite coefficients, an index below 1 and anisotropy outside -0.95 to 1.
    pub fn checked(self) -> Result<Medium, MediumError> {
        let coefficient = |v: f64| v.is_finite() && v >= 0.0;
        let rules = [
            ("absorption", self.absorption, coefficient(self.absorption), "0 or above (1/mm)"),
            ("scattering", self.scattering, coefficient(self.scattering), "0 or above (1/mm)"),
            (
                "anisotropy",
                self.anisotropy,
                (LEAST_ANISOTROPY..=1.0).contains(&self.anisotropy),
                "from -0.95 to 1 (mean cosine of scattering)",
            ),
            ("index", self.index, self.index >= 1.0 && self.index <= 4.0, "from 1 to 4 (leaves: 1.44 to 1.50)"),
        ];
        match rules.into_iter().find(|rule| !rule.2) {
            Some((name, value, _, rule)) => Err(MediumError { name, value, rule }),
            None => Ok(self),
        }
    }

    /// Reduced scattering, 1/mm.
    pub fn reduced_scattering(&self) -> f64 {
        self.scattering * (1.0 - self.anisotropy)
    }
}
