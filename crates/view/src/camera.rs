//! The camera: perspective, fitted to what it shows. Everything is in the picture's frame: the plant
//! is centered and its longest edge is [`PLANT_EDGE`].

use crate::ViewParams;
use crate::frame::Frame;
use glam::{DVec2, DVec3, Vec2, Vec3};

/// Longest edge of the plant in the picture's frame: comfortable numbers for f32 whatever the plant's unit.
pub(crate) const PLANT_EDGE: f64 = 10.0;
/// Share of the picture that stays free at each border.
const MARGIN: f64 = 0.04;
/// Nearest distance to anything that is fitted, relative to the plant's edge: a plant of one point still has a camera.
const LEAST_DISTANCE: f64 = 0.05 * PLANT_EDGE;

/// Unit vector at `azimuth_deg` from +Z over +X, `elevation_deg` above the horizon.
pub(crate) fn direction(azimuth_deg: f64, elevation_deg: f64) -> DVec3 {
    let (azimuth, elevation) = (azimuth_deg.to_radians(), elevation_deg.to_radians());
    let level = libm::cos(elevation);
    DVec3::new(level * libm::sin(azimuth), libm::sin(elevation), level * libm::cos(azimuth))
}

/// Unit, level: the right of a camera at `azimuth_deg`.
pub(crate) fn right(azimuth_deg: f64) -> DVec3 {
    DVec3::Y.cross(direction(azimuth_deg, 0.0))
}

/// A pinhole.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Camera {
    pub eye: Vec3,
    /// What it looks at: the chosen point, else the middle of what is shown.
    pub focus: Vec3,
    pub right: Vec3,
    up: Vec3,
    forward: Vec3,
    /// Half the picture's width and height at distance 1.
    half: Vec2,
    size: Vec2,
}

impl Camera {
    /// The nearest camera that sees all `points` with the margin around them, centered as a whole; or the one that
    /// was chosen, `frame` taking its place into the picture's frame.
    pub fn fit(points: impl Iterator<Item = Vec3>, frame: &Frame, params: &ViewParams) -> Camera {
        let backward = direction(params.azimuth_deg, params.elevation_deg);
        let right = right(params.azimuth_deg);
        let up = backward.cross(right);
        let size = DVec2::new(f64::from(params.width_px), f64::from(params.height_px));
        let tangent = libm::tan(params.fov_deg.to_radians() / 2.0);
        let half = DVec2::new(tangent * size.x / size.y, tangent);

        // A point (x, y) at depth z toward the camera is seen where |x - c| <= t (d - z): c is the camera's
        // shift, d its distance, t its half width. Least d: t d = (U + L) / 2, c = (U - L) / 2 with
        // U = max(x + t z), L = max(-x + t z).
        let inner = half * (1.0 - 2.0 * MARGIN);
        let (mut upper, mut lower, mut nearest) =
            (DVec2::splat(f64::NEG_INFINITY), DVec2::splat(f64::NEG_INFINITY), 0f64);
        for point in points.map(Vec3::as_dvec3) {
            let across = DVec2::new(point.dot(right), point.dot(up));
            let toward = point.dot(backward);
            upper = upper.max(across + inner * toward);
            lower = lower.max(inner * toward - across);
            nearest = nearest.max(toward);
        }
        if !upper.is_finite() {
            (upper, lower) = (DVec2::splat(PLANT_EDGE), DVec2::splat(PLANT_EDGE));
        }
        let shift = (upper - lower) / 2.0;
        let fitted = ((upper + lower) / 2.0 / inner).max_element().max(nearest + LEAST_DISTANCE);
        let target = match (params.target_m, params.distance_m) {
            (Some(target), _) => frame.place(DVec3::from_array(target)),
            (None, Some(_)) => DVec3::ZERO,
            (None, None) => right * shift.x + up * shift.y,
        };
        let distance = params.distance_m.map_or(fitted, |meters| meters * frame.per_meter());
        let eye = target + backward * distance;
        Camera {
            eye: eye.as_vec3(),
            focus: params.target_m.map_or(Vec3::ZERO, |_| target.as_vec3()),
            right: right.as_vec3(),
            up: up.as_vec3(),
            forward: -backward.as_vec3(),
            half: half.as_vec2(),
            size: size.as_vec2(),
        }
    }

    /// Unit direction through a point of the picture, pixels from the upper left corner.
    pub fn through(&self, pixel: Vec2) -> Vec3 {
        let at = (pixel / self.size * 2.0 - Vec2::ONE) * self.half;
        (self.forward + self.right * at.x - self.up * at.y).normalize()
    }

    /// Where a point stands in the picture, pixels; none for what is not in front of the camera.
    pub fn project(&self, point: Vec3) -> Option<Vec2> {
        let offset = point - self.eye;
        let depth = offset.dot(self.forward);
        let at = Vec2::new(offset.dot(self.right), -offset.dot(self.up)) / (depth * self.half);
        (depth > 0.0).then(|| (at + Vec2::ONE) / 2.0 * self.size)
    }
}
