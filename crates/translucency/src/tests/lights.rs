//! Directions: basis, projections against closed forms, the angular curve against measured numbers.

use crate::light::{BASIS, Curve, Entrance, Entry, Fit, Projection, coefficients, vector};
use crate::transport::{Layer, Medium};
use glam::DVec3;
use std::f64::consts::PI;

fn layer(absorption: f64, scattering: f64, anisotropy: f64, index: f64, thickness_mm: f64) -> [Layer; 1] {
    [Layer { medium: Medium { absorption, scattering, anisotropy, index }, thickness_mm }]
}

#[test]
fn the_basis_is_orthonormal_and_coefficients_come_back() {
    for (i, a) in BASIS.iter().enumerate() {
        for (j, b) in BASIS.iter().enumerate() {
            assert!((a.dot(*b) - f64::from(u8::from(i == j))).abs() < 1e-15);
        }
    }
    let v = DVec3::new(0.3, -0.2, 0.8);
    assert!((vector(coefficients(v)) - v).length() < 1e-15);
}

/// A clamped cosine has closed forms (translucency.md 4.3); quadrature over its kink leaves 5e-4.
#[test]
fn a_tilted_lambert_bump_meets_the_closed_form() {
    let entrance = Entrance::of(&layer(2.341, 41.75, 0.8, 1.474, 0.2), 16);
    for degrees in [0.0, 10.0, 30.0, 60.0] {
        let b: f64 = f64::to_radians(degrees);
        let (s, c) = (libm::sin(b), libm::cos(b));
        let z = 2.0 / PI * (c * ((PI - b) / 2.0 + libm::sin(2.0 * b) / 4.0) + s.powi(3) / 2.0);
        let t = 2.0 / PI * (c * s * s / 2.0 + s * ((PI - b) / 2.0 - libm::sin(2.0 * b) / 4.0));
        // The second form in the spec's words: v_t = (2/pi)[cos b sin^2 b / 2 + sin b ((pi - b)/2 - sin 2b / 4)].
        let area = c.max(0.2);
        let projection = Projection::new(c, Entry::Lambert, Fit::Uniform, Curve::STRAIGHT, entrance.knots(), 1.474);
        let [along, axis] = projection.vector(&entrance, Entry::Lambert);
        assert!(
            (along * area - t).abs() < 5e-4 && (axis * area - z).abs() < 5e-4,
            "{degrees}: {along} {axis}, {t} {z}"
        );
    }
}

/// T(.6) / T(1), v_z of a flat leaf and the curve, as measured on a prototype (translucency.md 4.2, 4.4).
#[test]
fn slanting_light_and_curves_are_as_measured() {
    let leaves = [
        (layer(6.56, 34.25, 0.8, 1.486, 0.2), 0.71, 0.81, [0.307, 0.675]),
        (layer(2.341, 41.75, 0.8, 1.474, 0.2), 0.84, 0.89, [0.544, 0.464]),
        (layer(0.1, 40.0, 0.5, 1.4, 0.4), 0.93, 0.95, [0.71, 0.31]),
    ];
    for (leaf, slanting, axis, curve) in leaves {
        let index = leaf[0].medium.index;
        let entrance = Entrance::of(&leaf, 16);
        // Numbers stand there with two digits.
        assert!((entrance.flat(0.6, index) - slanting).abs() < 0.01, "{}", entrance.flat(0.6, index));
        let flat = |curve| Projection::new(1.0, Entry::Transport, Fit::Uniform, curve, entrance.knots(), index);
        let [along, z] = flat(Curve::STRAIGHT).vector(&entrance, Entry::Transport);
        assert!((z - axis).abs() < 0.01 && along.abs() < 1e-12, "{z} {axis}");
        let fitted = Curve::fit(&entrance, index);
        assert!(
            (fitted.offset - curve[0]).abs() < 0.02 && (fitted.slope - curve[1]).abs() < 0.03,
            "{fitted:?} {curve:?}"
        );
        // With the curve a flat leaf is right from straight ahead.
        let bent = flat(fitted).vector(&entrance, Entry::Transport)[1] * fitted.at(1.0);
        assert!((bent - 1.0).abs() < 0.03, "{bent}");
    }
}

#[test]
fn an_anchored_fit_is_exact_from_straight_ahead() {
    let leaf = layer(6.56, 34.25, 0.8, 1.486, 0.2);
    let entrance = Entrance::of(&leaf, 16);
    let flat = |fit| Projection::new(1.0, Entry::Transport, fit, Curve::STRAIGHT, entrance.knots(), 1.486);
    let [_, anchored] = flat(Fit::Anchor).vector(&entrance, Entry::Transport);
    let [_, cosine] = flat(Fit::Cosine).vector(&entrance, Entry::Transport);
    let [_, uniform] = flat(Fit::Uniform).vector(&entrance, Entry::Transport);
    assert!((anchored - 1.0).abs() < 1e-12);
    assert!(uniform < cosine && cosine < 1.0, "{uniform} {cosine}");
}
