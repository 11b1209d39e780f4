//! One leaf by rule, as a form: blade, veins of four orders, thin rim with teeth, blade that bulges between its veins.
//!
//! For tests, benchmarks and pictures: nobody's photograph, so nobody's license.

use glam::DVec2;
use std::f64::consts::PI;

/// Width of the leaf's picture, mm.
pub const LEAF_WIDTH_MM: f64 = 80.0;
/// Share of the thickness that stands out on the front; the rest stands out on the back.
const FRONT_SHARE: f64 = 0.3;

/// A hill of height 1.
fn hill(distance: f64, width: f64) -> f64 {
    libm::exp(-distance * distance / (width * width))
}

/// Distance of a phase from the middle of its period, in periods.
fn from_line(phase: f64) -> f64 {
    phase.rem_euclid(1.0) - 0.5
}

/// A place of the leaf as its parts see it.
struct Place {
    /// From -1 to 1 across; from stalk 0 to tip 1 along.
    across: f64,
    along: f64,
    /// 1 in the middle of the leaf to 0 at its outline.
    within: f64,
    /// 0 at the outline, soon 1.
    rim: f64,
    /// How far from the next side vein, in their distances.
    vein: f64,
    /// Where on the way up the side veins it is.
    rise: f64,
}

impl Place {
    /// `None` outside of the leaf.
    fn of((across, along): (f64, f64)) -> Option<Place> {
        let (stalk, tip) = (0.04, 0.96);
        let share = (along - stalk) / (tip - stalk);
        if !(0.0..=1.0).contains(&share) {
            return None;
        }
        // Widest below the middle; teeth that point to the tip.
        let round = libm::sin(PI * share);
        let teeth = 0.012 * (1.0 - (share * 26.0).rem_euclid(1.0)) * round;
        let outline = 0.62 * libm::sin(PI * libm::pow(share, 0.8)) + teeth;
        let aside = across.abs();
        if outline - aside <= 0.0 {
            return None;
        }
        // Side veins leave the midrib at an angle and bend toward the tip; those of the left stand between those of the right.
        let (wave, shift) = if across < 0.0 { (2.0, 0.028) } else { (0.0, 0.0) };
        let rise = along - 0.42 * aside - 0.3 * aside * aside + 0.008 * libm::sin(9.0 * aside + wave) + shift;
        Some(Place {
            across,
            along,
            within: (1.0 - aside / outline).clamp(0.0, 1.0),
            rim: 1.0 - libm::exp(-(outline - aside) / 0.03),
            vein: from_line(rise * 12.0),
            rise,
        })
    }

    /// Midrib, side veins that thin out, ladders between them, a net between those.
    fn thickness(&self) -> f64 {
        let (aside, along) = (self.across.abs(), self.along);
        let midrib = hill(self.across, 0.010 + 0.018 * (1.04 - along));
        let side = hill(self.vein, 0.05 + 0.07 * self.within) * (0.25 + 0.75 * self.within);
        let rung =
            30.0 * aside + 2.5 * self.vein * libm::sin(7.0 * self.rise + 5.0 * aside) + 0.6 * libm::sin(23.0 * along);
        let ladder = hill(from_line(rung), 0.1) * (1.0 - hill(self.vein, 0.12));
        let bent = [0.5 * libm::sin(31.0 * along), 0.5 * libm::sin(37.0 * self.across)];
        let net = hill(between_cells([38.0 * self.across + bent[0], 38.0 * along + bent[1]]), 0.12);
        let blade = 0.115 + 0.045 * self.rim + 0.022 * net + 0.045 * ladder + 0.1 * side + 0.22 * midrib;
        blade * (0.62 + 0.38 * self.rim)
    }

    /// How far the blade stands up between its side veins, mm: front and back alike.
    fn bulge(&self) -> f64 {
        let between = libm::cos(PI * self.vein);
        let free = 1.0 - hill(self.across, 0.06);
        0.35 * between * between * free * self.rim * self.rim * self.rim * (3.0 * self.within).min(1.0)
    }
}

/// How much farther the second nearest of scattered points is than the nearest: 0 on the walls between their cells
/// (Worley 1996).
fn between_cells([u, v]: [f64; 2]) -> f64 {
    let (column, row) = (u.floor(), v.floor());
    let mut nearest = [f64::INFINITY; 2];
    for (dy, dx) in (-1..=1).flat_map(|dy| (-1..=1).map(move |dx| (f64::from(dy), f64::from(dx)))) {
        let (x, y) = (column + dx, row + dy);
        let place = |k: u32| 0.5 + 0.8 * (scattered(x as i32, y as i32, k) - 0.5);
        let d = ((u - x - place(1)).powi(2) + (v - y - place(2)).powi(2)).sqrt();
        nearest = if d < nearest[0] { [d, nearest[0]] } else { [nearest[0], nearest[1].min(d)] };
    }
    nearest[1] - nearest[0]
}

/// A number in [0, 1) without pattern from cell to cell.
fn scattered(x: i32, y: i32, k: u32) -> f64 {
    let mut h =
        (x as u32).wrapping_mul(0x9E37_79B1) ^ (y as u32).wrapping_mul(0x85EB_CA77) ^ k.wrapping_mul(0xC2B2_AE3D);
    h = (h ^ (h >> 15)).wrapping_mul(0x2C1B_3C6D);
    h = (h ^ (h >> 12)).wrapping_mul(0x297A_2D39);
    f64::from(h ^ (h >> 15)) / 4_294_967_296.0
}

/// Thickness and height of the front, mm, at a place of the picture (u right, v down, 0 to 1): the closed form. Zero where
/// there is no leaf.
pub fn leaf_form(place: DVec2) -> (f64, f64) {
    Place::of((2.0 * place.x - 1.0, 1.0 - place.y)).map_or((0.0, 0.0), |place| {
        let d = place.thickness();
        (d, FRONT_SHARE * d + place.bulge())
    })
}
