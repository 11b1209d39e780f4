//! Leaves that are one object: doubled sheets and crossed cards.

use crate::shape::{PieceShape, square_norm};

/// Centers within this share of the smaller spread are the same but for rounding ...
const EXACT: f64 = 3e-4;
/// ... and those of cards that were crossed by hand lie within this: about 2 % of a card's edge.
const BY_HAND: f64 = 0.05;
/// Spreads of one object differ by at most this factor.
const SPREADS: f64 = 1.25;
/// Crossed cards show the same picture upright: the cosine between their pictures' up directions is at
/// least this (15 degrees). Twigs that happen to meet at their middles seldom agree so well.
const UPRIGHT: f64 = 0.966;
/// Sheets are doubles where area and second moments agree within this share.
const DOUBLES: f64 = 0.1;
/// Edge of a grid cell in units of the largest distance that two centers of its size class may have.
const CELL: f64 = 8.0;

/// Which leaves go together.
#[derive(Clone, Debug, Default)]
pub(crate) struct Groups {
    /// Per leaf its group, numbered by their first leaves.
    pub of_leaf: Vec<u32>,
    /// Per leaf how many sheets lie on one another there, itself included.
    pub doubles: Vec<u32>,
}

/// Groups leaves by their shapes. First those whose centers are the same; then, of those still alone,
/// crossed cards and sheets within hand's reach (a leaf that has found its partner looks no further:
/// twigs of a dense crown come as near as that by chance). In an order that only geometry decides (so
/// renumbering leaves changes nothing) each joins the first leader that it fits, or leads: groups never
/// grow along a row of neighbors.
pub(crate) fn group(leaves: &[PieceShape]) -> Groups {
    let mut order: Vec<u32> = (0..leaves.len() as u32).collect();
    let key = |i: &u32| {
        let leaf = &leaves[*i as usize];
        [leaf.center.x, leaf.center.y, leaf.center.z, leaf.area]
    };
    order.sort_by(|a, b| {
        key(a).iter().zip(&key(b)).fold(std::cmp::Ordering::Equal, |o, (x, y)| o.then(x.total_cmp(y))).then(a.cmp(b))
    });
    let mut leader_of: Vec<u32> = (0..leaves.len() as u32).collect();
    join(leaves, &order, EXACT, |_, _| true, &mut leader_of);
    let mut members = vec![0u32; leaves.len()];
    leader_of.iter().for_each(|&leader| members[leader as usize] += 1);
    order.retain(|&i| members[leader_of[i as usize] as usize] == 1);
    join(leaves, &order, BY_HAND, |a, b| same_sheet(a, b) || same_up(a, b), &mut leader_of);
    Groups { of_leaf: number(&leader_of), doubles: count_doubles(leaves, &leader_of) }
}

/// Lets each leaf of `order` join a leader whose center is within `reach` of its own and that `fits`.
fn join(
    leaves: &[PieceShape],
    order: &[u32],
    reach: f64,
    fits: impl Fn(&PieceShape, &PieceShape) -> bool,
    leader_of: &mut [u32],
) {
    let mut leaders = Leaders { reach, cells: Default::default() };
    for &index in order {
        let fits = |a: &PieceShape, b: &PieceShape| near(a, b, reach) && fits(a, b);
        leader_of[index as usize] = leaders.find(index, leaves, fits).unwrap_or_else(|| leaders.add(index, leaves));
    }
}

/// A cell of the grid of one size class.
type Cell = (i32, [i64; 3]);

/// Leaders by cell. Cells suit the sizes in them, so leaves of all sizes can stand together.
struct Leaders {
    reach: f64,
    #[expect(clippy::disallowed_types, reason = "looked up, never iterated")]
    cells: std::collections::HashMap<Cell, Vec<u32>>,
}

impl Leaders {
    fn add(&mut self, index: u32, leaves: &[PieceShape]) -> u32 {
        let leaf = &leaves[index as usize];
        let class = libm::ilogb(leaf.spread);
        let cell = leaf.center.to_array().map(|x| self.cell_of(x, class));
        self.cells.entry((class, cell)).or_default().push(index);
        index
    }

    fn find(&self, index: u32, leaves: &[PieceShape], fits: impl Fn(&PieceShape, &PieceShape) -> bool) -> Option<u32> {
        let leaf = &leaves[index as usize];
        let reach = self.reach * leaf.spread;
        let classes = libm::ilogb(leaf.spread / SPREADS)..=libm::ilogb(leaf.spread * SPREADS);
        for class in classes {
            let low = leaf.center.to_array().map(|x| self.cell_of(x - reach, class));
            let high = leaf.center.to_array().map(|x| self.cell_of(x + reach, class));
            for x in low[0]..=high[0] {
                for y in low[1]..=high[1] {
                    for z in low[2]..=high[2] {
                        let leaders = self.cells.get(&(class, [x, y, z])).into_iter().flatten();
                        if let Some(&leader) = leaders.into_iter().find(|&&l| fits(leaf, &leaves[l as usize])) {
                            return Some(leader);
                        }
                    }
                }
            }
        }
        None
    }

    /// Spreads of a class lie between 2^class and 2^(class + 1).
    fn cell_of(&self, x: f64, class: i32) -> i64 {
        (x / (CELL * self.reach * libm::scalbn(2.0, class))).floor() as i64
    }
}

fn near(a: &PieceShape, b: &PieceShape, reach: f64) -> bool {
    let (small, large) = (a.spread.min(b.spread), a.spread.max(b.spread));
    large <= SPREADS * small && a.center.distance(b.center) <= reach * small
}

/// Whether two pictures stand the same way up; yes where one has no texture coordinates to say so.
fn same_up(a: &PieceShape, b: &PieceShape) -> bool {
    let lengths = a.up.length() * b.up.length();
    lengths <= 0.0 || a.up.dot(b.up) >= UPRIGHT * lengths
}

/// Numbers groups by their first leaves.
fn number(leader_of: &[u32]) -> Vec<u32> {
    let mut number_of = vec![u32::MAX; leader_of.len()];
    let mut next = 0;
    leader_of
        .iter()
        .map(|&leader| {
            let number = &mut number_of[leader as usize];
            if *number == u32::MAX {
                *number = next;
                next += 1;
            }
            *number
        })
        .collect()
}

fn count_doubles(leaves: &[PieceShape], leader_of: &[u32]) -> Vec<u32> {
    let mut order: Vec<u32> = (0..leaves.len() as u32).collect();
    order.sort_by_key(|&i| leader_of[i as usize]);
    let mut doubles = vec![1; leaves.len()];
    for members in order.chunk_by(|&a, &b| leader_of[a as usize] == leader_of[b as usize]) {
        // Sheets of one group are compared with the first of each stack, so that stacks stay apart.
        let mut stacks: Vec<Vec<u32>> = Vec::new();
        for &member in members {
            let on = |stack: &&mut Vec<u32>| same_sheet(&leaves[stack[0] as usize], &leaves[member as usize]);
            match stacks.iter_mut().find(on) {
                Some(stack) => stack.push(member),
                None => stacks.push(vec![member]),
            }
        }
        stacks.iter().for_each(|stack| stack.iter().for_each(|&m| doubles[m as usize] = stack.len() as u32));
    }
    doubles
}

fn same_sheet(a: &PieceShape, b: &PieceShape) -> bool {
    let larger = a.area.max(b.area);
    let moments = a.spread.max(b.spread) * a.spread.max(b.spread);
    (a.area - b.area).abs() <= DOUBLES * larger && square_norm(a.moments - b.moments).sqrt() <= DOUBLES * moments
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::{DMat3, DVec3};

    /// A card of edge 1 with its picture's up along `up` and its front to `normal`.
    fn card(center: DVec3, up: DVec3, normal: DVec3) -> PieceShape {
        let outer = |v: DVec3| DMat3::from_cols(v * v.x, v * v.y, v * v.z);
        let moments = (outer(up) + outer(up.cross(normal))) * (1.0 / 12.0);
        let spread = (1.0f64 / 6.0).sqrt();
        PieceShape { area: 1.0, center, normal_sum: normal, moments, spread, up, ..PieceShape::default() }
    }

    #[test]
    fn crossed_cards_are_one_object_and_keep_their_areas() {
        let groups = group(&[card(DVec3::ZERO, DVec3::Y, DVec3::X), card(DVec3::ZERO, DVec3::Y, DVec3::Z)]);
        assert_eq!((groups.of_leaf, groups.doubles), (vec![0, 0], vec![1, 1]));
    }

    #[test]
    fn cards_crossed_by_hand_go_together_only_when_they_stand_the_same_way_up() {
        let off = DVec3::new(0.01, 0.0, 0.005);
        let with = |up: DVec3, normal| group(&[card(DVec3::ZERO, DVec3::Y, DVec3::X), card(off, up, normal)]).of_leaf;
        assert_eq!(with(DVec3::Y, DVec3::Z), [0, 0]);
        assert_eq!(with(DVec3::X, DVec3::Z), [0, 1]);
        assert_eq!(with(DVec3::ZERO, DVec3::Z), [0, 0], "without texture coordinates nothing speaks against it");
    }

    #[test]
    fn what_has_an_exact_partner_looks_no_further() {
        let pair = |x: f64| [DVec3::X, DVec3::NEG_X].map(|normal| card(DVec3::X * x, DVec3::Y, normal));
        let groups = group(&[pair(0.0), pair(0.01)].concat());
        assert_eq!((groups.of_leaf, groups.doubles), (vec![0, 0, 1, 1], vec![2; 4]));
    }

    #[test]
    fn groups_do_not_grow_along_a_row() {
        // Each within reach of the next: a leader takes those around it, no more.
        let row: Vec<PieceShape> =
            (0..100).map(|i| card(DVec3::X * (0.015 * f64::from(i)), DVec3::Y, DVec3::Z)).collect();
        let groups = group(&row).of_leaf;
        let largest = groups.chunk_by(|a, b| a == b).map(<[u32]>::len).max().unwrap();
        assert!(largest <= 3, "{largest}");
    }

    #[test]
    fn leaves_of_very_different_size_stay_apart() {
        let large = card(DVec3::ZERO, DVec3::Y, DVec3::Z);
        let small = PieceShape { area: 0.25, spread: large.spread / 2.0, moments: large.moments * 0.25, ..large };
        assert_eq!(group(&[large, small]).of_leaf, [0, 1]);
    }

    #[test]
    fn a_hundred_thousand_leaves_in_one_place_are_one_group_at_once() {
        let all = vec![card(DVec3::ONE, DVec3::Y, DVec3::Z); 100_000];
        let groups = group(&all);
        assert!(groups.of_leaf.iter().all(|&g| g == 0));
        assert!(groups.doubles.iter().all(|&d| d == 100_000));
    }
}
