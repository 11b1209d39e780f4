//! The motion itself, exactly: what the shader includes do, in f64 (Kusternig07 section 5; each equation in docs/wind.md).

use crate::sway::power;
use foliar_plant::LEVELS;
use glam::{DQuat, DVec2, DVec3};

/// What an application sets each frame. Rest frame, meters, seconds folded into places of the noise.
#[derive(Clone, Debug, PartialEq)]
pub struct Gust {
    /// Displacement of the tip of each level's longest branch where the noise is 1, meters.
    pub amplitude_m: [f64; LEVELS],
    /// Exponents of the weights, as baked.
    pub exponents: [f64; LEVELS],
    /// Longest way from bark to tip at each level, meters, as baked.
    pub longest_m: [f64; LEVELS],
    /// How far each level has traveled through the noise, tiles, folded into [0, 1): see [`travel`].
    pub travel: [DVec2; LEVELS],
    /// Mean offset as a share of the amplitude, along the wind; leaves turn and roll with its horizontal part. 0: no wind.
    pub wind: DVec3,
    /// Whether a branch keeps the distance to its pivot, for strong wind.
    pub keep_length: bool,
    /// Leaves.
    pub leaf: LeafGust,
}

/// How leaves move on their own.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct LeafGust {
    /// Displacement of a tip where the noise is 1, meters.
    pub amplitude_m: f64,
    /// Tiles of the noise per meter.
    pub scale_per_m: f64,
    /// How far the noise has rolled with the wind, tiles, folded into [0, 1).
    pub roll: DVec2,
    /// How far a leaf that stands across a wind of 1 turns into it, radians.
    pub yaw_rad: f64,
}

/// Way through the noise after `seconds` at `tiles_per_second` along a direction. In f32 a shader would lose it within hours:
/// the application folds it in f64. Both coordinates are folded, so any direction goes on without a jump.
pub fn travel(seconds: f64, tiles_per_second: f64, direction: DVec2) -> DVec2 {
    (direction * (seconds * tiles_per_second)).fract_gl()
}

/// A branch as the tables hold it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Branch {
    /// Its level.
    pub level: usize,
    /// Column `frame`: x right, y up, z along it.
    pub frame: DQuat,
    /// Column `phase`.
    pub phase: DVec2,
    /// Where it turns.
    pub pivot: DVec3,
}

/// A vertex at rest, or moved.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Vertex {
    /// Place, meters.
    pub position: DVec3,
    /// Unit.
    pub normal: DVec3,
    /// Unit.
    pub tangent: DVec3,
}

impl Gust {
    /// Still air around a plant whose facts are these.
    pub fn still(exponents: [f64; LEVELS], longest_m: [f64; LEVELS]) -> Gust {
        Gust {
            amplitude_m: [0.0; LEVELS],
            exponents,
            longest_m,
            travel: [DVec2::ZERO; LEVELS],
            wind: DVec3::ZERO,
            keep_length: false,
            leaf: LeafGust::default(),
        }
    }

    /// Where in the noise a branch is.
    pub fn noise_place(&self, branch: &Branch) -> DVec2 {
        (branch.phase + self.travel[branch.level.min(LEVELS - 1)]).fract_gl()
    }

    /// Displacement of the tip of a branch as long as the longest of its level; across the branch.
    pub fn displacement(&self, branch: &Branch, noise: DVec2) -> DVec3 {
        let Some(amplitude) = self.amplitude_m.get(branch.level) else { return DVec3::ZERO };
        let along = branch.frame * DVec3::Z;
        let swing = branch.frame * DVec3::new(noise.x, noise.y, 0.0);
        amplitude * (swing + (self.wind - along * along.dot(self.wind)))
    }

    /// A vertex of a branch: displaced with every branch of its chain, turned by its own. `chain` holds the
    /// displacement at each level, `own` the branch itself where it sways on its own.
    pub fn bend(&self, rest: &Vertex, weights: [f64; LEVELS], chain: [DVec3; LEVELS], own: Option<&Branch>) -> Vertex {
        if chain.iter().all(|d| *d == DVec3::ZERO) {
            return *rest;
        }
        let at = |level: usize| chain[level] * power(weights[level], self.exponents[level]);
        let Some(own) = own.filter(|own| own.level < LEVELS) else {
            return Vertex { position: rest.position + (0..LEVELS).map(at).sum::<DVec3>(), ..*rest };
        };
        let inherited: DVec3 = (0..LEVELS).filter(|level| *level != own.level).map(at).sum();
        let bent = rest.position + at(own.level);
        let bent = if self.keep_length { kept(rest.position, bent, own.pivot) } else { bent };
        let slope = slope(weights[own.level], self.exponents[own.level], self.longest_m[own.level]);
        let (normal, tangent) = sheared(rest, chain[own.level] * slope, own.frame * DVec3::Z);
        Vertex { position: bent + inherited, normal, tangent }
    }

    /// Where in the noise a leaf is: it rolls over the crown with the wind.
    pub fn leaf_noise_place(&self, petiole: DVec3) -> DVec2 {
        (DVec2::new(petiole.x, petiole.z) * self.leaf.scale_per_m - self.leaf.roll).fract_gl()
    }

    /// A vertex of a leaf about its petiole: turned into the wind, its tip moved by the noise. `axis` points from petiole
    /// to tip, as long as that is (meters); `weight` is the leaf's own.
    pub fn flutter(&self, rest: &Vertex, weight: f64, petiole: DVec3, axis: DVec3, noise: DVec2) -> Vertex {
        let angle = self.leaf.yaw_rad * self.turn(axis);
        let way = rest.position - petiole;
        let (swing, reach) = (self.leaf.amplitude_m * self.swing(noise), axis.length_squared());
        let moved = turned(way, angle) - way + swing * weight;
        if moved == DVec3::ZERO && angle.abs() <= 0.0 && swing == DVec3::ZERO {
            return *rest;
        }
        let turn = |v: DVec3| turned(v, angle);
        let upright = Vertex { position: rest.position, normal: turn(rest.normal), tangent: turn(rest.tangent) };
        // Weight grows along the turned axis: d weight / d place = axis / |axis|^2.
        let gradient = if reach > 0.0 { turn(axis) / reach } else { DVec3::ZERO };
        let (normal, tangent) = sheared(&upright, swing, gradient);
        Vertex { position: rest.position + moved, normal, tangent }
    }

    /// Sine of the angle by which an axis misses the wind, times both their horizontal lengths over the axis' own.
    fn turn(&self, axis: DVec3) -> f64 {
        let axis = axis.normalize_or_zero();
        axis.z * self.wind.x - axis.x * self.wind.z
    }

    /// The noise along and above the wind.
    fn swing(&self, noise: DVec2) -> DVec3 {
        let along = DVec3::new(self.wind.x, 0.0, self.wind.z).normalize_or(DVec3::X);
        along * noise.x + DVec3::Y * noise.y
    }
}

/// Slope of displacement along the branch per unit of displacement, 1 / m.
fn slope(weight: f64, exponent: f64, longest: f64) -> f64 {
    if longest <= 0.0 {
        return 0.0;
    }
    // Where weight starts the slope jumps from 0 to what it is beyond if the exponent is 1: halfway between. So no
    // power of 0 is asked for.
    let rising = match weight > 0.0 {
        true => libm::pow(weight, exponent - 1.0),
        false => {
            if exponent <= 1.0 {
                0.5
            } else {
                0.0
            }
        }
    };
    exponent * rising / longest
}

/// The bent place, at the distance from the pivot that it has at rest.
fn kept(rest: DVec3, bent: DVec3, pivot: DVec3) -> DVec3 {
    if bent == rest {
        return rest;
    }
    (bent - pivot).try_normalize().map_or(bent, |way| pivot + way * rest.distance(pivot))
}

/// Normal and tangent under J = I + shift (x) gradient: the normal by the cofactors of J, which need no division.
fn sheared(rest: &Vertex, shift: DVec3, gradient: DVec3) -> (DVec3, DVec3) {
    let normal = rest.normal * (1.0 + shift.dot(gradient)) - gradient * shift.dot(rest.normal);
    let tangent = rest.tangent + shift * gradient.dot(rest.tangent);
    (normal.normalize_or(rest.normal), tangent.normalize_or(rest.tangent))
}

/// Turned about up: a positive angle takes Z toward X.
fn turned(v: DVec3, angle: f64) -> DVec3 {
    let (sin, cos) = (libm::sin(angle), libm::cos(angle));
    DVec3::new(cos * v.x + sin * v.z, v.y, cos * v.z - sin * v.x)
}
