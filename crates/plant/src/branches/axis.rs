//! The axis of a branch: a chain of capsules, from root to tip.

use glam::{DAffine3, DVec3};

/// Centers and radii of a branch's rings, root first. Rest frame, meters.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Axis {
    /// Centers.
    pub points: Vec<DVec3>,
    /// Radius at each center.
    pub radii: Vec<f64>,
    /// Arc length up to each center, 0 first.
    pub arcs: Vec<f64>,
}

/// A place on an axis.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Spot {
    /// Arc length from the root.
    pub arc: f64,
    /// The point.
    pub point: DVec3,
    /// Radius there.
    pub radius: f64,
    /// Distance from what it was sought for.
    pub distance: f64,
}

impl Axis {
    /// An axis through these rings; its arcs follow.
    pub fn new(points: Vec<DVec3>, radii: Vec<f64>) -> Axis {
        let mut arcs = Vec::with_capacity(points.len());
        let mut arc = 0.0;
        for (index, point) in points.iter().enumerate() {
            arc += if index == 0 { 0.0 } else { point.distance(points[index - 1]) };
            arcs.push(arc);
        }
        Axis { points, radii, arcs }
    }

    /// Length from root to tip.
    pub fn length(&self) -> f64 {
        self.arcs.last().copied().unwrap_or(0.0)
    }

    /// The place at an arc length, clamped to the axis.
    pub fn at(&self, arc: f64) -> Spot {
        let last = self.points.len().saturating_sub(1);
        let upper = self.arcs.partition_point(|&a| a < arc).clamp(last.min(1), last);
        self.on_segment(upper.saturating_sub(1), upper, |low, high| (arc - low) / (high - low))
    }

    fn on_segment(&self, low: usize, high: usize, share: impl Fn(f64, f64) -> f64) -> Spot {
        let share = share(self.arcs[low], self.arcs[high]);
        let share = if share.is_finite() { share.clamp(0.0, 1.0) } else { 0.0 };
        let mix = |values: &[f64]| values[low] + (values[high] - values[low]) * share;
        let point = self.points[low].lerp(self.points[high], share);
        Spot { arc: mix(&self.arcs), point, radius: mix(&self.radii), distance: 0.0 }
    }

    /// The place nearest to `point` among the segments that touch arcs `from` to `to`.
    pub fn nearest_between(&self, point: DVec3, from: f64, to: f64) -> Spot {
        let (first, last) = self.segments(from, to);
        let mut best =
            Spot { distance: self.points[first].distance(point), ..self.on_segment(first, first, |_, _| 0.0) };
        for low in first..last {
            let (a, b) = (self.points[low], self.points[low + 1]);
            let share = (point - a).dot(b - a) / a.distance_squared(b);
            let spot = self.on_segment(low, low + 1, |_, _| share);
            let distance = spot.point.distance(point);
            if distance < best.distance {
                best = Spot { distance, ..spot };
            }
        }
        best
    }

    /// The place nearest to `point`.
    pub fn nearest(&self, point: DVec3) -> Spot {
        self.nearest_between(point, 0.0, self.length())
    }

    /// First point and last point of the run of segments that touch arcs `from` to `to`.
    pub(super) fn segments(&self, from: f64, to: f64) -> (usize, usize) {
        let last = self.points.len().saturating_sub(1);
        let first = self.arcs.partition_point(|&a| a <= from).saturating_sub(1);
        (first.min(last), self.arcs.partition_point(|&a| a < to).clamp(first.min(last), last))
    }

    /// Unit direction at the root (`from_tip`: at the tip, pointing back): over at least one radius of way, so that
    /// a short first ring does not turn it.
    pub fn heading(&self, from_tip: bool) -> DVec3 {
        let last = self.points.len().saturating_sub(1);
        let end = if from_tip { last } else { 0 };
        let way = self.radii[end].min(0.5 * self.length());
        let start = self.points[end];
        let ahead = if from_tip { self.length() - way } else { way };
        let index = if from_tip {
            self.arcs.partition_point(|&a| a < ahead).saturating_sub(1)
        } else {
            self.arcs.partition_point(|&a| a <= ahead).min(last)
        };
        (self.points[index] - start).normalize_or(if from_tip { -DVec3::Y } else { DVec3::Y })
    }

    pub(super) fn transform(&mut self, change: DAffine3, scale: f64) {
        self.points.iter_mut().for_each(|p| *p = change.transform_point3(*p));
        self.radii.iter_mut().chain(&mut self.arcs).for_each(|x| *x *= scale);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn bent() -> Axis {
        Axis::new(vec![DVec3::ZERO, DVec3::Y * 2.0, DVec3::new(2.0, 2.0, 0.0)], vec![0.5, 0.25, 0.0])
    }

    #[test]
    fn arcs_radii_and_places_are_those_of_the_polyline() {
        let axis = bent();
        assert_eq!(axis.arcs, [0.0, 2.0, 4.0]);
        // Halves and quarters are exact.
        assert_eq!(axis.at(3.0), Spot { arc: 3.0, point: DVec3::new(1.0, 2.0, 0.0), radius: 0.125, distance: 0.0 });
        assert_eq!(axis.at(-1.0).point, DVec3::ZERO);
        assert_eq!(axis.at(9.0).point, axis.points[2]);
        let near = axis.nearest(DVec3::new(1.0, 3.0, 0.0));
        assert_eq!((near.arc, near.distance), (3.0, 1.0));
        assert_eq!(axis.heading(false), DVec3::Y);
        assert_eq!(axis.heading(true), -DVec3::X);
    }

    #[test]
    fn a_window_leaves_the_rest_of_the_axis_out() {
        let near = bent().nearest_between(DVec3::new(2.0, 2.5, 0.0), 0.0, 1.0);
        assert_eq!((near.arc, near.point), (2.0, DVec3::Y * 2.0));
    }

    #[test]
    fn a_single_point_is_an_axis_too() {
        let axis = Axis::new(vec![DVec3::X], vec![1.0]);
        assert_eq!(axis.at(5.0).point, DVec3::X);
        assert_eq!(axis.nearest(DVec3::ZERO).distance.to_bits(), 1.0f64.to_bits());
        assert_eq!(axis.heading(false), DVec3::Y);
    }
}
