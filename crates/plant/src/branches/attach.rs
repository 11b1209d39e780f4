//! How a branch hangs on its parent. Two places that must not be mixed: on the parent's axis, where it turns,
//! and at the bark, where it comes out of it.

use super::{Axis, Spot};
use glam::{DAffine3, DVec3};

/// Where a branch hangs on its parent.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Attachment {
    /// The point of the parent's axis that the branch's axis, drawn on backward, comes nearest to: its pivot.
    pub axis_point: DVec3,
    /// Arc length of that point on the parent.
    pub axis_arc: f64,
    /// Arc length on the branch where its own axis leaves the parent's bark; 0 where it starts outside.
    pub bark_arc: f64,
    /// Arc length on the parent nearest to where the branch leaves the bark.
    pub bark_parent_arc: f64,
}

/// How much farther along the parent the pivot may lie from the root's foot than the root lies from the axis.
const REACH: f64 = 4.0;
/// Halvings that find where an axis crosses the bark: to 1e-9 of a ring's distance.
const HALVINGS: u32 = 30;

impl Attachment {
    /// How the branch with axis `child` hangs on `parent`.
    pub fn of(child: &Axis, parent: &Axis) -> Attachment {
        let root = child.points[0];
        let foot = parent.nearest(root);
        let pivot = pivot(child, parent, &foot);
        let (bark_arc, at_bark) = leaves_bark(child, parent, &foot);
        Attachment { axis_point: pivot.point, axis_arc: pivot.arc, bark_arc, bark_parent_arc: at_bark.arc }
    }

    /// The attachment of a root: its own foot.
    pub fn root(axis: &Axis) -> Attachment {
        Attachment { axis_point: axis.points[0], ..Attachment::default() }
    }

    pub(super) fn transform(&mut self, change: DAffine3, scale: f64) {
        self.axis_point = change.transform_point3(self.axis_point);
        [&mut self.axis_arc, &mut self.bark_arc, &mut self.bark_parent_arc].into_iter().for_each(|x| *x *= scale);
    }
}

/// The point of the parent's axis nearest to the child's root drawn on backward, at most as far as the
/// root lies from the axis times [`REACH`].
fn pivot(child: &Axis, parent: &Axis, foot: &Spot) -> Spot {
    let reach = REACH * foot.distance;
    let (root, back) = (child.points[0], -child.heading(false));
    let (first, last) = parent.segments(foot.arc - reach, foot.arc + reach);
    let mut best = *foot;
    for low in first..last {
        let (a, b) = (parent.points[low], parent.points[low + 1]);
        let Some((along, share)) = between_lines(root, back, a, b - a) else { continue };
        let on_ray = root + back * along.clamp(0.0, reach);
        let spot = parent.at(parent.arcs[low] + share.clamp(0.0, 1.0) * (parent.arcs[low + 1] - parent.arcs[low]));
        let distance = spot.point.distance(on_ray);
        if distance < best.distance {
            best = Spot { distance, ..spot };
        }
    }
    best
}

/// Parameters of the points where two lines are nearest to each other; none for parallel lines.
fn between_lines(p: DVec3, u: DVec3, q: DVec3, v: DVec3) -> Option<(f64, f64)> {
    let w = p - q;
    let (uu, uv, vv, uw, vw) = (u.dot(u), u.dot(v), v.dot(v), u.dot(w), v.dot(w));
    let determinant = uu * vv - uv * uv;
    // Nearly parallel lines meet nowhere in particular: below a thousandth of a right angle squared.
    if determinant <= 1e-6 * uu * vv {
        return None;
    }
    Some(((uv * vw - vv * uw) / determinant, (uu * vw - uv * uw) / determinant))
}

/// Arc length on the child where it leaves the parent's bark, and the parent's place there.
fn leaves_bark(child: &Axis, parent: &Axis, foot: &Spot) -> (f64, Spot) {
    let outside = |arc: f64, near: f64| {
        let point = child.at(arc).point;
        // The foot moves no farther along the parent than the child has gone, give or take a bend.
        let window = 2.0 * arc + 4.0 * (foot.distance + foot.radius);
        let spot = parent.nearest_between(point, near - window, near + window);
        (spot.distance - spot.radius, spot)
    };
    let (start, spot) = outside(0.0, foot.arc);
    if start >= 0.0 {
        return (0.0, spot);
    }
    for ring in 1..child.points.len() {
        if outside(child.arcs[ring], foot.arc).0 >= 0.0 {
            let (mut inside, mut out) = (child.arcs[ring - 1], child.arcs[ring]);
            for _ in 0..HALVINGS {
                let middle = 0.5 * (inside + out);
                *if outside(middle, foot.arc).0 >= 0.0 { &mut out } else { &mut inside } = middle;
            }
            return (out, outside(out, foot.arc).1);
        }
    }
    (child.length(), outside(child.length(), foot.arc).1)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_slanted_branch_turns_on_the_axis_and_comes_out_at_the_bark() {
        let trunk = Axis::new(vec![DVec3::ZERO, DVec3::Y * 10.0], vec![1.0, 1.0]);
        // From (0, 4, 0) at 45 degrees; its first ring stands half way in the wood.
        let slant = DVec3::new(1.0, 1.0, 0.0).normalize();
        let start = DVec3::new(0.0, 4.0, 0.0) + slant * 0.5;
        let child = Axis::new(vec![start, start + slant * 4.0], vec![0.1, 0.1]);
        let attachment = Attachment::of(&child, &trunk);
        // Rounding of a few operations on numbers near 10.
        assert!(attachment.axis_point.distance(DVec3::Y * 4.0) < 1e-12, "{attachment:?}");
        assert!((attachment.axis_arc - 4.0).abs() < 1e-12);
        assert!((attachment.bark_arc - (2f64.sqrt() - 0.5)).abs() < 1e-8);
        assert!((attachment.bark_parent_arc - 5.0).abs() < 1e-8);
    }

    #[test]
    fn a_branch_that_starts_outside_leaves_the_bark_at_its_root() {
        let trunk = Axis::new(vec![DVec3::ZERO, DVec3::Y * 10.0], vec![1.0, 1.0]);
        let child = Axis::new(vec![DVec3::new(1.5, 5.0, 0.0), DVec3::new(4.0, 5.0, 0.0)], vec![0.1, 0.1]);
        let attachment = Attachment::of(&child, &trunk);
        assert_eq!(attachment.bark_arc.to_bits(), 0.0f64.to_bits());
        assert!((attachment.bark_parent_arc - 5.0).abs() < 1e-12);
    }
}
