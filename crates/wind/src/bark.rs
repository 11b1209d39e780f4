//! The bark rule: where a branch leaves its parent, and what the part that is hidden inside inherits so that the
//! branch's surface and the parent's move as one where they meet.

use crate::sway::{Exit, Sway, Weights};
use foliar_plant::{Axis, Branches, LEVELS, NO_BRANCH, Part, Plant};
use foliar_schema::Role;
use glam::DVec3;
use rayon::prelude::*;

/// How much of the parent's radius a vertex must lie below its bark to count as hidden: f32 coordinates of what
/// touches fall on either side.
pub(crate) const TOUCH: f64 = 1e-3;
/// Most steps of the search for the place where an edge pierces the bark, and the share of the edge that ends it: a
/// weight may change by 1 along an edge, and f32 holds it to 6e-8.
const STEPS: usize = 30;
const CLOSE: f64 = 1e-9;
const NONE: u32 = u32::MAX;

/// A vertex of wood.
type Vertex = (u32, u32);

/// Vertices of wood, branch by branch, along each.
pub(crate) struct Rings {
    starts: Vec<u32>,
    vertices: Vec<Vertex>,
}

impl Rings {
    pub fn new(plant: &Plant, branches: &Branches) -> Rings {
        let mut starts = vec![0u32; branches.count() + 1];
        let each = |visit: &mut dyn FnMut(Vertex, u32)| {
            for (part, list) in branches.vertices.iter().enumerate() {
                let places = list.iter().enumerate().filter(|(_, place)| place.branch != NO_BRANCH);
                if plant.role(part) == Role::Wood {
                    places.for_each(|(vertex, place)| visit((part as u32, vertex as u32), place.branch));
                }
            }
        };
        each(&mut |_, branch| starts[branch as usize + 1] += 1);
        (1..starts.len()).for_each(|i| starts[i] += starts[i - 1]);
        let mut next = starts.clone();
        let mut vertices = vec![(0, 0); starts.last().copied().unwrap_or(0) as usize];
        each(&mut |vertex, branch| {
            vertices[next[branch as usize] as usize] = vertex;
            next[branch as usize] += 1;
        });
        Rings { starts, vertices }
    }

    fn of(&self, branch: usize) -> &[Vertex] {
        &self.vertices[self.starts[branch] as usize..self.starts[branch + 1] as usize]
    }
}

/// Where a branch comes out of its parent.
#[derive(Clone, Debug, Default)]
pub(crate) struct Coming {
    /// Arc length of the first ring wholly outside.
    pub start: f64,
    /// Vertices inside, up to that ring.
    pub hidden: Vec<Vertex>,
}

/// How far outside its parent's bark a place is: below 0 inside. And the arc length there.
struct Bark<'a> {
    parent: &'a Axis,
    near: f64,
}

impl Bark<'_> {
    fn of(branches: &Branches, branch: usize) -> Bark<'_> {
        let parent = &branches.axes[branches.rows[branch].parent as usize];
        Bark { parent, near: branches.attachments[branch].bark_parent_arc }
    }

    fn outside(&self, place: DVec3) -> (f64, f64) {
        // A foot lies no farther along the parent than the place is away, give or take a bend.
        let at = self.parent.at(self.near);
        let window = 2.0 * at.point.distance(place) + 4.0 * at.radius;
        let spot = self.parent.nearest_between(place, self.near - window, self.near + window);
        (spot.distance - spot.radius * (1.0 - TOUCH), spot.arc)
    }
}

/// Where each branch comes out.
pub(crate) fn coming_out(plant: &Plant, branches: &Branches, exit: Exit) -> Vec<Coming> {
    if exit == Exit::Root {
        return vec![Coming::default(); branches.count()];
    }
    let rings = Rings::new(plant, branches);
    let one = |branch: usize| match branches.rows[branch].parent {
        NO_BRANCH => Coming::default(),
        _ => one(plant.parts(), branches, branch, rings.of(branch)),
    };
    (0..branches.count()).into_par_iter().map(one).collect()
}

fn one(parts: &[Part], branches: &Branches, branch: usize, vertices: &[Vertex]) -> Coming {
    let bark = Bark::of(branches, branch);
    let arc = |(part, vertex): Vertex| branches.vertices[part as usize][vertex as usize].arc;
    let mut list = vertices.to_vec();
    list.sort_by(|a, b| arc(*a).total_cmp(&arc(*b)));
    let mut hidden = Vec::new();
    for ring in list.chunk_by(|a, b| arc(*a).total_cmp(&arc(*b)).is_eq()) {
        let before = hidden.len();
        let place = |v: &Vertex| parts[v.0 as usize].rest_position(v.1 as usize);
        hidden.extend(ring.iter().filter(|v| bark.outside(place(v)).0 < 0.0));
        if hidden.len() == before {
            return Coming { start: f64::from(arc(ring[0])), hidden };
        }
    }
    // It never comes out, as a vine on its trunk: its axis says where it starts, and nothing is matched.
    let start = branches.attachments[branch].bark_arc.min(branches.axes[branch].length());
    Coming { start, hidden: Vec::new() }
}

/// An edge from a hidden vertex to one outside.
struct Crossing {
    slot: u32,
    branch: u32,
    hidden: DVec3,
    outside: DVec3,
    arc: f64,
}

/// Weights of hidden vertices, by part and vertex.
pub(crate) struct Hidden {
    /// Per part, per vertex: slot or `NONE`; empty where no vertex is hidden.
    slots: Vec<Vec<u32>>,
    weights: Vec<Weights>,
}

impl Hidden {
    /// What was solved for a vertex, if it is hidden.
    pub fn get(&self, part: usize, vertex: usize) -> Option<&Weights> {
        let slot = *self.slots[part].get(vertex)?;
        self.weights.get(slot as usize)
    }

    /// Solves for every hidden vertex: along each edge that pierces the bark, the interpolated displacement there is
    /// the parent's. Several edges are met as well as they can be together (least squares).
    pub fn solve(plant: &Plant, sway: &Sway, coming: &[Coming]) -> Hidden {
        let (slots, mut weights) = slots(plant, sway, coming);
        let mut sums = vec![([0.0; LEVELS], 0.0); weights.len()];
        let crossings = crossings(plant, sway.branches, &slots);
        let solved: Vec<(f64, Weights)> = crossings.par_iter().map(|c| solve_one(sway, c)).collect();
        for (crossing, (near, wanted)) in crossings.iter().zip(solved) {
            let (sum, total) = &mut sums[crossing.slot as usize];
            *total += near * near;
            (0..LEVELS).for_each(|level| sum[level] += near * wanted[level]);
        }
        for (weights, (sum, total)) in weights.iter_mut().zip(&sums).filter(|(_, (_, total))| *total > 0.0) {
            *weights = sway.roots(std::array::from_fn(|level| sum[level] / total));
        }
        Hidden { slots, weights }
    }
}

/// A slot for each hidden place: copies of a vertex along a texture seam share one. And what a place has whose
/// edges all end inside.
fn slots(plant: &Plant, sway: &Sway, coming: &[Coming]) -> (Vec<Vec<u32>>, Vec<Weights>) {
    let (mut slots, mut weights) = (vec![Vec::new(); plant.parts().len()], Vec::new());
    for (branch, coming) in coming.iter().enumerate() {
        let bits = |v: &Vertex| plant.parts()[v.0 as usize].positions[v.1 as usize].to_array().map(f32::to_bits);
        let mut list = coming.hidden.clone();
        list.sort_by_key(|v| (v.0, bits(v)));
        for same in list.chunk_by(|a, b| a.0 == b.0 && bits(a) == bits(b)) {
            for &(part, vertex) in same {
                let slots: &mut Vec<u32> = &mut slots[part as usize];
                slots.resize(plant.parts()[part as usize].positions.len(), NONE);
                slots[vertex as usize] = weights.len() as u32;
            }
            weights.push(sway.inherited[branch]);
        }
    }
    (slots, weights)
}

/// Every edge that pierces a bark, in the order of the triangles. An edge between two triangles is met in each
/// direction once, so it counts once.
fn crossings(plant: &Plant, branches: &Branches, slots: &[Vec<u32>]) -> Vec<Crossing> {
    let mut crossings = Vec::new();
    for (index, slots) in slots.iter().enumerate().filter(|(_, slots)| !slots.is_empty()) {
        let (part, places) = (&plant.parts()[index], &branches.vertices[index]);
        for &[a, b, c] in &part.triangles {
            for (from, to) in [(a, b), (b, c), (c, a)] {
                let (slot, place) = (slots[from as usize], places[from as usize]);
                if slot != NONE && slots[to as usize] == NONE && places[to as usize].branch == place.branch {
                    crossings.push(Crossing {
                        slot,
                        branch: place.branch,
                        hidden: part.rest_position(from as usize),
                        outside: part.rest_position(to as usize),
                        arc: f64::from(places[to as usize].arc),
                    });
                }
            }
        }
    }
    crossings
}

/// Share of the hidden end where the edge pierces the bark, and what it must contribute there.
fn solve_one(sway: &Sway, crossing: &Crossing) -> (f64, Weights) {
    let bark = Bark::of(sway.branches, crossing.branch as usize);
    let way = crossing.outside - crossing.hidden;
    let at = |share: f64| bark.outside(crossing.hidden + way * share).0;
    let share = pierce(at);
    let arc = bark.outside(crossing.hidden + way * share).1;
    let parent = sway.branches.rows[crossing.branch as usize].parent;
    let of_parent = sway.powers_on_bark(parent, arc);
    let outside = sway.powers(sway.of_ring(crossing.branch, crossing.arc));
    (1.0 - share, std::array::from_fn(|level| of_parent[level] - share * outside[level]))
}

/// Where a function crosses 0 on [0, 1], below 0 at 0 (Illinois' false position).
fn pierce(at: impl Fn(f64) -> f64) -> f64 {
    let (mut low, mut high) = ((0.0, at(0.0)), (1.0, at(1.0)));
    if high.1 <= 0.0 {
        return 1.0;
    }
    let (mut share, mut was_low) = (0.0, None);
    for _ in 0..STEPS {
        let before = share;
        share = low.0 + (high.0 - low.0) * low.1 / (low.1 - high.1);
        if f64::abs(share - before) < CLOSE {
            break;
        }
        let value = at(share);
        let is_low = value < 0.0;
        // The end that stays for a second time is taken for half as far from 0.
        let stays = if was_low == Some(is_low) { 0.5 } else { 1.0 };
        (low, high) = match is_low {
            true => ((share, value), (high.0, high.1 * stays)),
            false => ((low.0, low.1 * stays), (share, value)),
        };
        was_low = Some(is_low);
    }
    share
}
