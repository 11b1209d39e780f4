//! From axes and parents to the whole: order of ids, levels, chains, pivots.

use super::{Attachment, Axis, Branch, Branches, LEVELS, NO_BRANCH};
use glam::DVec3;

/// A branch before it has its id.
#[derive(Clone, Debug)]
pub struct Stalk {
    /// Index of its parent among the stalks; none for a root.
    pub parent: Option<u32>,
    /// Its axis, root first.
    pub axis: Axis,
    /// See [`Branch::margin`].
    pub margin: f64,
    /// Order of its first vertex in the input.
    pub first_vertex: u64,
}

impl Branches {
    /// Branches from stalks, and the id of each stalk. `vertices` and `leaves` are left empty. Parents must
    /// not go in circles.
    pub fn grow(stalks: Vec<Stalk>) -> (Branches, Vec<u32>) {
        let levels = levels(&stalks);
        let mut order: Vec<usize> = (0..stalks.len()).collect();
        order.sort_by_key(|&s| (levels[s], stalks[s].first_vertex, s));
        let mut ids = vec![0; stalks.len()];
        order.iter().enumerate().for_each(|(id, &stalk)| ids[stalk] = id as u32);
        let mut branches = Branches::default();
        let mut stalks: Vec<Option<Stalk>> = stalks.into_iter().map(Some).collect();
        for (id, &index) in order.iter().enumerate() {
            let Some(stalk) = stalks[index].take() else { continue };
            let parent = stalk.parent.map(|p| ids[p as usize]);
            branches.push(id as u32, parent, levels[index], stalk);
        }
        (branches, ids)
    }

    fn push(&mut self, id: u32, parent: Option<u32>, level: u32, stalk: Stalk) {
        let axis = stalk.axis;
        let attachment =
            parent.map_or_else(|| Attachment::root(&axis), |p| Attachment::of(&axis, &self.axes[p as usize]));
        let mut chain = parent.map_or([NO_BRANCH; LEVELS], |p| self.rows[p as usize].chain);
        if let Some(own) = chain.get_mut(level as usize) {
            *own = id;
        }
        let direction = (axis.at(0.5 * axis.length()).point - axis.points[0]).normalize_or(DVec3::Y);
        self.rows.push(Branch {
            parent: parent.unwrap_or(NO_BRANCH),
            level,
            chain,
            pivot: attachment.axis_point.as_vec3(),
            direction: direction.as_vec3(),
            length: axis.length() as f32,
            radius: axis.radii[0] as f32,
            margin: stalk.margin.min(f64::from(super::LARGEST_MARGIN)) as f32,
        });
        self.axes.push(axis);
        self.attachments.push(attachment);
    }
}

/// Depth of each stalk.
fn levels(stalks: &[Stalk]) -> Vec<u32> {
    let mut levels: Vec<Option<u32>> = vec![None; stalks.len()];
    let mut way = Vec::new();
    for start in 0..stalks.len() {
        let mut at = Some(start);
        while let Some(index) = at.filter(|&i| levels[i].is_none()) {
            way.push(index);
            at = stalks[index].parent.map(|p| p as usize);
        }
        let mut level = at.and_then(|i| levels[i]).map_or(0, |l| l + 1);
        while let Some(index) = way.pop() {
            levels[index] = Some(level);
            level += 1;
        }
    }
    levels.into_iter().map(Option::unwrap_or_default).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn stalk(parent: Option<u32>, x: f64, first_vertex: u64) -> Stalk {
        let points = vec![DVec3::new(x, 0.0, 0.0), DVec3::new(x, 2.0, 0.0)];
        Stalk { parent, axis: Axis::new(points, vec![0.1, 0.1]), margin: 1e9, first_vertex }
    }

    #[test]
    fn ids_follow_level_then_first_vertex_and_chains_end_at_level_four() {
        // A run of six branches, given from the last to the first, and a second root.
        let mut stalks: Vec<Stalk> =
            (0..6).map(|i| stalk((i < 5).then_some(i + 1), f64::from(i), 10 - u64::from(i))).collect();
        stalks.push(stalk(None, 9.0, 0));
        let (branches, ids) = Branches::grow(stalks);
        assert_eq!(ids, [6, 5, 4, 3, 2, 1, 0]);
        assert_eq!(branches.roots().collect::<Vec<_>>(), [0, 1]);
        assert_eq!(branches.rows[6].level, 5);
        assert_eq!(branches.rows[6].chain, [1, 2, 3, 4]);
        assert_eq!(branches.rows[1].chain, [1, NO_BRANCH, NO_BRANCH, NO_BRANCH]);
        assert_eq!(branches.rows[6].margin.to_bits(), crate::LARGEST_MARGIN.to_bits());
    }
}
