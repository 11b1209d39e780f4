//! What the model is given, checked once: a leaf, its optics, sun and sky.

use crate::octants::OCTANTS;
use crate::profile::MOST_DEPTH;
use glam::DVec3;

/// Sums of reflectance and transmittance may pass 1 by this: two roundings of a measured pair.
const ROUNDING: f64 = 1e-9;

/// Why something cannot be lit; each message says what would be right.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum ModelError {
    /// An optical depth is negative or NaN.
    #[error("optical depth {octant} = {value}: must be 0 or above (Boulanger08 eq. 2); bake the light room again")]
    Depth {
        /// Which of the eight.
        octant: usize,
        /// What it is.
        value: f64,
    },
    /// A vector without a direction.
    #[error("{what} = {value}: must be finite and longer than 0; {remedy}")]
    Direction {
        /// Which vector.
        what: &'static str,
        /// What it is.
        value: DVec3,
        /// What to do.
        remedy: &'static str,
    },
    /// A number out of its range.
    #[error("{what} = {value}: must be {range}; {remedy}")]
    Number {
        /// Which number.
        what: &'static str,
        /// What it is.
        value: f64,
        /// What is allowed.
        range: &'static str,
        /// What to do.
        remedy: &'static str,
    },
    /// A side of a leaf gives more light than it gets.
    #[error(
        "{side} of the leaf: reflectance {reflectance} + transmittance {transmittance} = {}: must be at most 1; \
         lower one of them (a green leaf sums to about 0.1 in red and 0.9 in near infrared)",
        reflectance + transmittance
    )]
    Energy {
        /// The lit side.
        side: &'static str,
        /// Its share that comes back.
        reflectance: f64,
        /// Its share that goes through.
        transmittance: f64,
    },
}

/// A number for either side of a leaf; the front is the side that its normal points from.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Sides {
    /// Front.
    pub front: f64,
    /// Back.
    pub back: f64,
}

impl Sides {
    /// Both sides alike.
    pub const fn both(value: f64) -> Self {
        Sides { front: value, back: value }
    }

    /// Of one formula, with the normal of each side.
    pub(crate) fn of(normal: DVec3, value: impl Fn(DVec3) -> f64) -> Self {
        Sides { front: value(normal), back: value(-normal) }
    }
}

impl std::ops::Add for Sides {
    type Output = Sides;
    fn add(self, other: Sides) -> Sides {
        Sides { front: self.front + other.front, back: self.back + other.back }
    }
}

impl std::ops::Mul<f64> for Sides {
    type Output = Sides;
    fn mul(self, factor: f64) -> Sides {
        Sides { front: self.front * factor, back: self.back * factor }
    }
}

/// What a leaf does with light at one wavelength; per side that is lit.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Optics {
    reflectance: Sides,
    transmittance: Sides,
}

impl Optics {
    /// Reflectance and transmittance per lit side, each in [0, 1]: light onto the front comes back from the front, or
    /// out of the back.
    ///
    /// # Errors
    /// [`ModelError::Number`] for a share outside [0, 1], [`ModelError::Energy`] where a side gives more than it gets.
    pub fn new(reflectance: Sides, transmittance: Sides) -> Result<Optics, ModelError> {
        let shares = [
            ("reflectance of the front", reflectance.front),
            ("reflectance of the back", reflectance.back),
            ("transmittance of the front", transmittance.front),
            ("transmittance of the back", transmittance.back),
        ];
        for (what, value) in shares {
            if !(0.0..=1.0).contains(&value) {
                let remedy = "give it as a share of the light, not in per cent";
                return Err(ModelError::Number { what, value, range: "from 0 to 1", remedy });
            }
        }
        let sides = [("front", reflectance.front, transmittance.front), ("back", reflectance.back, transmittance.back)];
        for (side, reflectance, transmittance) in sides {
            if reflectance + transmittance > 1.0 + ROUNDING {
                return Err(ModelError::Energy { side, reflectance, transmittance });
            }
        }
        Ok(Optics { reflectance, transmittance })
    }

    /// Share that comes back, per lit side.
    pub fn reflectance(&self) -> Sides {
        self.reflectance
    }

    /// Share that goes through, per lit side.
    pub fn transmittance(&self) -> Sides {
        self.transmittance
    }

    /// Radiance that leaves either side under an irradiance of both (Boulanger08 eq. 3 to 5): what lights the back
    /// shines through the front.
    pub fn radiance(&self, irradiance: Sides) -> Sides {
        let (r, t) = (self.reflectance, self.transmittance);
        let front = r.front * irradiance.front + t.back * irradiance.back;
        let back = r.back * irradiance.back + t.front * irradiance.front;
        Sides { front, back } * std::f64::consts::FRAC_1_PI
    }

    /// Sum of both reflectances.
    pub(crate) fn reflected(&self) -> f64 {
        self.reflectance.front + self.reflectance.back
    }

    /// Sum of both transmittances.
    pub(crate) fn passed(&self) -> f64 {
        self.transmittance.front + self.transmittance.back
    }

    /// Mean share of the light that a leaf scatters, at most 1.
    pub fn albedo(&self) -> f64 {
        ((self.reflected() + self.passed()) / 2.0).min(1.0)
    }
}

/// The sun.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Sun {
    pub(crate) toward: DVec3,
    pub(crate) irradiance: f64,
}

impl Sun {
    /// A sun that stands `toward` (any length) and gives `irradiance` to a surface that faces it.
    ///
    /// # Errors
    /// [`ModelError::Direction`] for a vector of no length, [`ModelError::Number`] for a negative irradiance.
    pub fn new(toward: DVec3, irradiance: f64) -> Result<Sun, ModelError> {
        let remedy =
            "point it from the tree to the sun, or leave the sun out with an irradiance of 0 and any direction";
        let toward =
            unit(toward).ok_or(ModelError::Direction { what: "direction of the sun", value: toward, remedy })?;
        Ok(Sun { toward, irradiance: light_amount("irradiance of the sun", irradiance)? })
    }

    /// Unit vector to the sun.
    pub fn toward(&self) -> DVec3 {
        self.toward
    }

    /// Irradiance of a surface that faces it.
    pub fn irradiance(&self) -> f64 {
        self.irradiance
    }
}

/// What lies around the tree: mean radiance of each octant.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Sky {
    pub(crate) radiance: [f64; OCTANTS],
}

impl Sky {
    /// Mean radiance of each octant, in the order of [`crate::octants`]: the first four are the ground's.
    ///
    /// # Errors
    /// [`ModelError::Number`] for a radiance that is negative or not finite.
    pub fn new(radiance: [f64; OCTANTS]) -> Result<Sky, ModelError> {
        for value in radiance {
            light_amount("radiance of an octant", value)?;
        }
        Ok(Sky { radiance })
    }

    /// An even sky over an even ground.
    ///
    /// # Errors
    /// As [`Sky::new`].
    pub fn even(sky: f64, ground: f64) -> Result<Sky, ModelError> {
        Sky::new(std::array::from_fn(|octant| if octant < OCTANTS / 2 { ground } else { sky }))
    }

    /// Mean radiance of each octant.
    pub fn radiance(&self) -> [f64; OCTANTS] {
        self.radiance
    }
}

/// A leaf, or any other place with a normal, and how much foliage stands around it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Leaf {
    pub(crate) depths: [f64; OCTANTS],
    pub(crate) transmittances: [f64; OCTANTS],
    pub(crate) normal: DVec3,
}

impl Leaf {
    /// A leaf with its eight optical depths (column `opticalDepth`, capped at [`MOST_DEPTH`]) and its normal (any
    /// length).
    ///
    /// # Errors
    /// [`ModelError::Depth`] for a negative depth or NaN, [`ModelError::Direction`] for a normal of no length.
    pub fn new(depths: [f64; OCTANTS], normal: DVec3) -> Result<Leaf, ModelError> {
        for (octant, &value) in depths.iter().enumerate() {
            if value.is_nan() || value < 0.0 {
                return Err(ModelError::Depth { octant, value });
            }
        }
        let remedy = "a leaf without area has none: take its triangle's, or leave it out";
        let normal = unit(normal).ok_or(ModelError::Direction { what: "normal of the leaf", value: normal, remedy })?;
        let depths = depths.map(|depth| depth.min(MOST_DEPTH));
        Ok(Leaf { depths, transmittances: depths.map(|depth| libm::exp(-depth)), normal })
    }

    /// Optical depth of each octant, capped.
    pub fn depths(&self) -> [f64; OCTANTS] {
        self.depths
    }

    /// Transmittance of each octant: `exp(-depth)` (Boulanger08 eq. 2).
    pub fn transmittances(&self) -> [f64; OCTANTS] {
        self.transmittances
    }

    /// Unit normal of the front.
    pub fn normal(&self) -> DVec3 {
        self.normal
    }

    /// Chance that light which leaves this leaf meets another one. Recollision theory (Mottus 2007) knows one such chance
    /// for a whole tree; a leaf at the rim loses more of its light than one inside.
    pub fn recollision(&self) -> f64 {
        1.0 - self.transmittances.iter().sum::<f64>() / OCTANTS as f64
    }

    /// Light after any number of bounces over light after the first, for leaves that scatter `albedo` of it: the
    /// geometric series 1 / (1 - albedo recollision), as a sum of what is lost so that nothing cancels.
    pub(crate) fn all_bounces(&self, albedo: f64) -> f64 {
        let escape = self.transmittances.iter().sum::<f64>() / OCTANTS as f64;
        1.0 / ((1.0 - albedo) + albedo * escape)
    }
}

/// Unit vector; none without a direction. Scaled first, so that no square is lost or endless.
fn unit(v: DVec3) -> Option<DVec3> {
    let largest = v.abs().max_element();
    (v.is_finite() && largest > 0.0).then(|| (v / largest).normalize())
}

pub(crate) fn light_amount(what: &'static str, value: f64) -> Result<f64, ModelError> {
    if value >= 0.0 && value.is_finite() {
        return Ok(value);
    }
    Err(ModelError::Number { what, value, range: "0 or above, and finite", remedy: "0 leaves it out" })
}
