//! Marching cubes over the blocks: which lattice edges the surface crosses, and the triangles between.

use super::blocks::{Block, block, code, sort};
use super::splat::{CORNERS, EDGE};
use super::table::{CASES, Case, axis, lower_corner};
use glam::IVec3;
use rayon::prelude::*;

/// Corners along an edge of a block with the next block's first.
const SIDE: usize = EDGE + 1;
/// Blocks of one task: some thousand vertices.
pub(super) const TASK: usize = 32;
/// Newton steps toward a cubic's zero: the guess need not be better than the cubic.
const POLISH_STEPS: usize = 2;
/// The bits of one row of corners and the next block's first.
const ROW: u16 = (1 << SIDE) - 1;

/// A lattice edge that the surface crosses.
#[derive(Clone, Copy, Debug)]
pub(super) struct Crossing {
    /// Lattice coordinates of its lower corner.
    pub corner: IVec3,
    /// Axis it runs along.
    pub axis: usize,
    /// Whether the lower corner is the one inside.
    pub inside_first: bool,
    /// Where the surface crosses, by interpolation, 0 to 1 from the lower corner; `None` where the densities at
    /// its ends are not known.
    pub at: Option<f64>,
}

/// Densities at the corners of a block, where they are known.
pub(super) type Corner<'a> = dyn Fn(u64) -> Option<&'a [f32; CORNERS]> + Sync + 'a;

/// How crossings are guessed from densities at lattice corners.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Guess {
    /// By the line through an edge's ends.
    Linear,
    /// By the cubic through four corners in a row, where the block holds all of them.
    Cubic,
}

/// A block with cells that the surface passes through.
pub(super) struct Marched {
    /// Morton code.
    code: u64,
    /// Bit x of row [z][y]: corner inside.
    rows: [[u16; SIDE]; SIDE],
    /// Crossed edges that start at this block's corners, by axis and layer, bit x + 8 y.
    crossed: [[u64; EDGE]; 3],
    /// How many crossed edges of the block come before each layer's.
    before: [[u32; EDGE]; 3],
    /// Index of its first crossing.
    first: u32,
    /// How many crossings it has.
    count: u32,
}

/// The mesh without coordinates.
pub(super) struct March {
    codes: Vec<u64>,
    marched: Vec<Marched>,
}

/// The eight blocks from a block on, x fastest.
fn octet(from: IVec3) -> [u64; 8] {
    std::array::from_fn(|k| code(from + IVec3::new(k as i32 & 1, k as i32 >> 1 & 1, k as i32 >> 2)))
}

/// Blocks of the lattice with what they are.
#[derive(Clone, Copy)]
pub(super) struct Blocks<'a> {
    /// Morton codes, rising.
    pub codes: &'a [u64],
    /// What each is.
    pub states: &'a [Block],
}

impl<'a> Blocks<'a> {
    fn get(self, code: u64) -> Option<&'a Block> {
        self.codes.binary_search(&code).ok().map(|at| &self.states[at])
    }

    /// Densities at a block's corners, where the surface passes between them.
    pub fn density(self, code: u64) -> Option<&'a [f32; CORNERS]> {
        match self.get(code) {
            Some(Block::Mixed(corners)) => Some(&corners.density),
            _ => None,
        }
    }
}

impl March {
    /// Finds all cells that the surface passes through.
    pub fn new(blocks: Blocks) -> March {
        let inner = blocks.codes.iter().zip(blocks.states).filter(|(_, state)| !matches!(state, Block::Outside));
        // A cell reaches into the next blocks: the ones below count too.
        let mut candidates: Vec<u64> = inner.flat_map(|(&code, _)| octet(block(code) - 1)).collect();
        sort(&mut candidates);
        let march = |&code: &u64| Marched::new(code, blocks);
        let mut marched: Vec<Marched> = candidates.par_iter().filter_map(march).collect();
        let mut first = 0u32;
        for block in &mut marched {
            block.first = first;
            first = first.saturating_add(block.count);
        }
        March { codes: marched.iter().map(|m| m.code).collect(), marched }
    }

    /// Number of crossings; `u32::MAX` where there are that many or more.
    pub fn vertex_count(&self) -> u32 {
        self.marched.last().map_or(0, |m| m.first.saturating_add(m.count))
    }

    /// Blocks with cells that the surface passes through, in Morton order.
    pub fn blocks(&self) -> &[Marched] {
        &self.marched
    }

    /// All triangles, block by block in Morton order, counter-clockwise from outside.
    pub fn triangles(&self) -> Vec<[u32; 3]> {
        let count = |blocks: &[Marched]| blocks.iter().map(Marched::triangle_count).sum();
        let counts: Vec<usize> = self.marched.par_chunks(TASK).map(count).collect();
        let mut triangles = vec![[0; 3]; counts.iter().sum()];
        let tasks = self.marched.par_chunks(TASK).zip(shares(&mut triangles, counts));
        tasks.for_each(|(blocks, share)| {
            let found = blocks.iter().flat_map(|block| block.triangles(self));
            share.iter_mut().zip(found).for_each(|(to, triangle)| *to = triangle);
        });
        triangles
    }
}

/// A list in parts of these sizes.
pub(super) fn shares<T>(mut list: &mut [T], sizes: impl IntoIterator<Item = usize>) -> Vec<&mut [T]> {
    let mut parts = Vec::new();
    for size in sizes {
        let (part, rest) = list.split_at_mut(size);
        parts.push(part);
        list = rest;
    }
    parts
}

impl Marched {
    fn new(code: u64, blocks: Blocks) -> Option<Marched> {
        let rows = rows(block(code), blocks);
        let mut crossed = [[0u64; EDGE]; 3];
        for z in 0..EDGE {
            for y in 0..EDGE {
                let row = rows[z][y];
                let differ = [row ^ row >> 1, row ^ rows[z][y + 1], row ^ rows[z + 1][y]];
                for (crossed, differ) in crossed.iter_mut().zip(differ) {
                    crossed[z] |= u64::from(differ & 0xFF) << (EDGE * y);
                }
            }
        }
        let mut count = 0;
        let before = crossed.map(|layers| {
            layers.map(|layer| {
                count += layer.count_ones();
                count - layer.count_ones()
            })
        });
        let uniform = rows.iter().flatten().all(|&row| row == rows[0][0]) && (rows[0][0] == 0 || rows[0][0] == ROW);
        (!uniform).then_some(Marched { code, rows, crossed, before, first: 0, count })
    }

    /// Its Morton code.
    pub fn code(&self) -> u64 {
        self.code
    }

    /// How many crossings it has.
    pub fn vertices(&self) -> usize {
        self.count as usize
    }

    /// Its crossings: by axis, z, y, x.
    pub fn crossings(&self, density: &Corner, tau: f64, guess: Guess, found: &mut Vec<Crossing>) {
        let (own, home) = (density(self.code), block(self.code));
        found.clear();
        for axis in 0..3 {
            let next = density(code(home + IVec3::AXES[axis]));
            for z in 0..EDGE {
                let mut left = self.crossed[axis][z];
                while left != 0 {
                    let bit = left.trailing_zeros() as usize;
                    left &= left - 1;
                    let at = [bit % EDGE, bit / EDGE, z];
                    found.push(Crossing {
                        corner: home * EDGE as i32 + IVec3::from_array(at.map(|v| v as i32)),
                        axis,
                        inside_first: self.rows[z][at[1]] >> at[0] & 1 == 1,
                        at: crossed_at([own, next], at, axis, tau, guess),
                    });
                }
            }
        }
    }

    /// Cells that the surface passes through, and their cases: by z, y, x.
    fn cells(&self) -> impl Iterator<Item = ([usize; 3], &'static Case)> + '_ {
        let cases = &*CASES;
        (0..EDGE * EDGE).flat_map(move |row| {
            let (z, y) = (row / EDGE, row % EDGE);
            let rows = [self.rows[z][y], self.rows[z][y + 1], self.rows[z + 1][y], self.rows[z + 1][y + 1]];
            let uniform = rows == [0; 4] || rows == [ROW; 4];
            (0..if uniform { 0 } else { EDGE }).map(move |x| {
                let pattern = (0..4).fold(0, |bits, k| bits | (rows[k] >> x & 3) << (2 * k));
                ([x, y, z], &cases[usize::from(pattern)])
            })
        })
    }

    fn triangle_count(&self) -> usize {
        self.cells().map(|(_, case)| case.triangles().len()).sum()
    }

    fn triangles<'a>(&'a self, march: &'a March) -> impl Iterator<Item = [u32; 3]> + 'a {
        let next = octet(block(self.code)).map(|code| march.codes.binary_search(&code).ok());
        self.cells().flat_map(move |(cell, case)| {
            case.triangles().iter().map(move |triangle| triangle.map(|edge| march.vertex(&next, cell, edge)))
        })
    }

    /// Index of a crossing on the edge that leaves `corner` along `axis`.
    fn vertex(&self, corner: [usize; 3], axis: usize) -> u32 {
        let below = (1u64 << (corner[0] + EDGE * corner[1])) - 1;
        self.first + self.before[axis][corner[2]] + (self.crossed[axis][corner[2]] & below).count_ones()
    }
}

impl March {
    /// Index of the crossing on an edge of a cell; `next` are the eight blocks from the cell's on.
    fn vertex(&self, next: &[Option<usize>; 8], cell: [usize; 3], edge: u8) -> u32 {
        let low = usize::from(lower_corner(edge));
        let corner: [usize; 3] = std::array::from_fn(|k| cell[k] + (low >> k & 1));
        let slot = (0..3).fold(0, |slot, k| slot | (corner[k] / EDGE) << k);
        // Either end of a crossed edge makes the cell at its lower corner one that the surface passes through.
        let owner = next[slot].map(|at| &self.marched[at]);
        owner.map_or(0, |owner| owner.vertex(corner.map(|v| v % EDGE), axis(edge)))
    }
}

/// Inside bits of a block's corners and of the next blocks' first ones.
fn rows(home: IVec3, blocks: Blocks) -> [[u16; SIDE]; SIDE] {
    let inside = octet(home).map(|code| match blocks.get(code) {
        None | Some(Block::Outside) => [0; EDGE],
        Some(Block::Inside) => [u64::MAX; EDGE],
        Some(Block::Mixed(corners)) => corners.inside,
    });
    std::array::from_fn(|z| {
        std::array::from_fn(|y| {
            let slot = (y / EDGE) << 1 | (z / EDGE) << 2;
            let row = |slot: usize| inside[slot][z % EDGE] >> (EDGE * (y % EDGE)) & 0xFF;
            (row(slot) | (row(slot | 1) & 1) << EDGE) as u16
        })
    })
}

fn index([x, y, z]: [usize; 3]) -> usize {
    x + EDGE * (y + EDGE * z)
}

/// Steps along the axes in a block's list of corners.
const STRIDES: [usize; 3] = [1, EDGE, EDGE * EDGE];

/// Where the surface crosses the edge that leaves corner `at` of a block along an axis, by the densities of the
/// block and the next, if they are known.
fn crossed_at(
    [own, next]: [Option<&[f32; CORNERS]>; 2],
    at: [usize; 3],
    axis: usize,
    tau: f64,
    guess: Guess,
) -> Option<f64> {
    let mut to = at;
    to[axis] += 1;
    let (own, end) = (own?, if to[axis] == EDGE { next? } else { own? });
    let line = zero_between([own[index(at)], end[index(to.map(|v| v % EDGE))]].map(|d| f64::from(d) - tau));
    let four = (1..EDGE - 2).contains(&at[axis]) && guess == Guess::Cubic;
    Some(if four { polish(own, index(at), STRIDES[axis], tau, line) } else { line })
}

/// Where a line through two values at 0 and 1 is zero, kept within.
pub(super) fn zero_between([first, second]: [f64; 2]) -> f64 {
    let across = first - second;
    if across.abs() > 0.0 { (first / across).clamp(0.0, 1.0) } else { 0.5 }
}

/// A better zero between corners `first` and the next, from the cubic through them and their neighbors.
fn polish(density: &[f32; CORNERS], first: usize, stride: usize, tau: f64, line: f64) -> f64 {
    let [before, low, high, after] = [0, 1, 2, 3].map(|k| f64::from(density[first + k * stride - stride]) - tau);
    // Newton's form: low + t (b + (t - 1)(c + (t + 1) d)), by divided differences at 0, 1, -1, 2.
    let (b, c) = (high - low, (high - 2.0 * low + before) / 2.0);
    let d = (after - 3.0 * high + 3.0 * low - before) / 6.0;
    let mut at = line;
    for _ in 0..POLISH_STEPS {
        let inner = c + (at + 1.0) * d;
        let value = low + at * (b + (at - 1.0) * inner);
        let slope = b + (2.0 * at - 1.0) * inner + at * (at - 1.0) * d;
        let next = at - value / slope;
        if !(0.0..=1.0).contains(&next) {
            return line;
        }
        at = next;
    }
    at
}

#[cfg(test)]
mod tests {
    use super::super::blocks::Corners;
    use super::super::check_mesh;
    use super::*;
    use proptest::prelude::*;

    /// Blocks with signs as given, 512 bits each.
    fn mesh(signs: &[[u64; EDGE]; 8]) -> March {
        let mut list: Vec<(u64, Block)> = (0..)
            .zip(signs)
            .map(|(k, &inside)| {
                let at = IVec3::new(k & 1, k >> 1 & 1, k >> 2);
                (code(at), Block::Mixed(Box::new(Corners { density: [0.0; CORNERS], inside })))
            })
            .collect();
        list.sort_by_key(|b| b.0);
        let (codes, states): (Vec<u64>, Vec<Block>) = list.into_iter().unzip();
        March::new(Blocks { codes: &codes, states: &states })
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(40))]
        #[test]
        fn any_signs_at_all_give_a_closed_manifold_mesh(signs in any::<[[u64; EDGE]; 8]>()) {
            let march = mesh(&signs);
            let faults = check_mesh(&march.triangles(), march.vertex_count() as usize);
            prop_assert!(faults.is_empty(), "{faults:?}");
        }
    }

    #[test]
    fn a_cubic_is_found_exactly_and_a_line_is_kept_where_it_fails() {
        let mut density = [0.0f32; CORNERS];
        let cubic = |x: f64| (x - 2.3) * (x * x + 1.0);
        density.iter_mut().enumerate().take(EDGE).for_each(|(x, d)| *d = cubic(x as f64) as f32);
        // Two Newton steps from the line's .1 off: quadratic, 1e-4; f32 values add 1e-6.
        let found = polish(&density, 2, 1, 0.0, zero_between([cubic(2.0), cubic(3.0)]));
        assert!((found - 0.3).abs() < 1e-3, "{found}");
        assert!((polish(&[1.0; CORNERS], 2, 1, 0.0, 0.25) - 0.25).abs() < 1e-12);
    }
}
