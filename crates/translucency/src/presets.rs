//! Leaves whose optics are known: PROSPECT-D inverted with adding-doubling, anisotropy .8 assumed (PROSPECT has none, nor
//! a thickness: those are usual ones).

use crate::transport::Medium;

/// Anisotropy of all presets. With 0 the same R and T would make four fifths of the light that passes unscattered.
pub const ANISOTROPY: f64 = 0.8;

/// Optics at one wavelength.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Sample {
    /// Wavelength in air, nm.
    pub wavelength_nm: f64,
    /// Index of refraction.
    pub index: f64,
    /// Absorption, 1/mm.
    pub absorption: f64,
    /// Reduced scattering, 1/mm.
    pub reduced_scattering: f64,
}

/// A kind of leaf.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Preset {
    /// Its name in parameters.
    pub name: &'static str,
    /// Thickness that its coefficients belong to, mm.
    pub thickness_mm: f64,
    /// By rising wavelength.
    pub samples: &'static [Sample],
}

const fn at(wavelength_nm: f64, index: f64, absorption: f64, reduced_scattering: f64) -> Sample {
    Sample { wavelength_nm, index, absorption, reduced_scattering }
}

/// All kinds.
pub const PRESETS: &[Preset] = &[
    Preset {
        name: "typical",
        thickness_mm: 0.2,
        samples: &[
            at(450.0, 1.4955, 28.1134, 2.58751),
            at(510.0, 1.4861, 6.559953, 6.850066),
            at(550.0, 1.4739, 2.341227, 8.353116),
            at(610.0, 1.4533, 6.024504, 6.802931),
            at(680.0, 1.4458, 21.70875, 2.693867),
        ],
    },
    Preset {
        name: "young",
        thickness_mm: 0.12,
        samples: &[
            at(450.0, 1.4955, 26.66700, 4.318174),
            at(510.0, 1.4861, 5.918302, 9.628053),
            at(550.0, 1.4739, 1.937950, 10.52676),
            at(610.0, 1.4533, 4.646564, 9.688553),
            at(680.0, 1.4458, 17.27312, 6.032173),
        ],
    },
    Preset {
        name: "dark",
        thickness_mm: 0.3,
        samples: &[
            at(450.0, 1.4955, 30.46833, 2.493251),
            at(510.0, 1.4861, 8.154144, 5.363929),
            at(550.0, 1.4739, 2.816517, 7.565071),
            at(610.0, 1.4533, 7.456779, 5.398899),
            at(680.0, 1.4458, 24.36186, 2.005441),
        ],
    },
    Preset {
        name: "senescent",
        thickness_mm: 0.2,
        samples: &[
            at(450.0, 1.4955, 10.47239, 10.13627),
            at(510.0, 1.4861, 4.111333, 13.20200),
            at(550.0, 1.4739, 1.361202, 15.17656),
            at(610.0, 1.4533, 1.314877, 14.69548),
            at(680.0, 1.4458, 2.326546, 13.65174),
        ],
    },
];

impl Preset {
    /// The preset of a name.
    pub fn named(name: &str) -> Option<&'static Preset> {
        PRESETS.iter().find(|preset| preset.name == name)
    }

    /// Its tissue at a wavelength, between samples by the logarithms of the coefficients; `None` outside of them.
    pub fn medium(&self, wavelength_nm: f64) -> Option<Medium> {
        let after = self.samples.iter().position(|sample| sample.wavelength_nm >= wavelength_nm)?;
        let high = self.samples[after];
        let low = self.samples[after.saturating_sub(1)];
        if wavelength_nm < low.wavelength_nm {
            return None;
        }
        let width = high.wavelength_nm - low.wavelength_nm;
        let share = if width > 0.0 { (wavelength_nm - low.wavelength_nm) / width } else { 0.0 };
        let mix = |a: f64, b: f64| libm::exp(libm::log(a) * (1.0 - share) + libm::log(b) * share);
        let reduced = mix(low.reduced_scattering, high.reduced_scattering);
        Some(Medium {
            absorption: mix(low.absorption, high.absorption),
            scattering: reduced / (1.0 - ANISOTROPY),
            anisotropy: ANISOTROPY,
            index: low.index * (1.0 - share) + high.index * share,
        })
    }
}
