//! How well a moving tree holds together, measured on its triangles: nothing here knows the capsules or the rule that
//! weights were made by.

use crate::motion::{Gust, Vertex};
use crate::noise::Field;
use crate::player::Player;
use foliar_plant::{LEVELS, NO_BRANCH, OnBranch, Plant};
use foliar_schema::Role;
use foliar_space::{Beam, Hit, RayError, Rays, TriangleTree};
use glam::{DVec3, Vec3};
use rayon::prelude::*;

/// How far along a branch its edges may pierce the parent's bark, in radii of both beyond where its axis does: a branch
/// that comes back to its parent elsewhere is not attached there.
const NEAR_ROOT: f64 = 2.0;

/// A place where an edge of a branch pierces a triangle of its parent.
#[derive(Clone, Debug)]
pub struct Joint {
    part: usize,
    /// Ends of the edge, and the share of the second.
    edge: ([u32; 2], f64),
    parent_part: usize,
    /// Corners of the triangle and their shares.
    triangle: ([u32; 3], [f64; 3]),
    /// Radius of the branch where it is pierced, or at its root where that is more: a tip laid to a point has none.
    radius: f64,
}

/// A leaf, and the place on its branch's triangles that is nearest to where it hangs.
#[derive(Clone, Debug)]
struct Hanging {
    leaf: (usize, u32),
    part: usize,
    corners: [u32; 3],
    shares: [f64; 3],
    size: f64,
}

/// A plant's triangles of wood, to shoot at.
#[derive(Debug)]
struct Wood {
    rays: Rays,
    /// Part and corners.
    triangles: Vec<(usize, [u32; 3])>,
}

impl Wood {
    fn new(plant: &Plant) -> Result<Wood, RayError> {
        let (mut shapes, mut triangles) = (Vec::new(), Vec::new());
        for (part, data) in plant.parts().iter().enumerate().filter(|(part, _)| plant.role(*part) == Role::Wood) {
            let places = plant.relative_positions(part);
            shapes.extend(data.triangles.iter().map(|t| t.map(|v| places[v as usize])));
            triangles.extend(data.triangles.iter().map(|t| (part, *t)));
        }
        Ok(Wood { rays: Rays::new(&shapes)?, triangles })
    }
}

/// Every joint of a plant.
///
/// # Errors
/// [`RayError`] where the wood cannot be shot at.
pub fn joints(plant: &Plant) -> Result<Vec<Joint>, RayError> {
    let wood = Wood::new(plant)?;
    let of = |(part, corners): &(usize, [u32; 3])| {
        let [a, b, c] = *corners;
        // An edge between two triangles is met in each direction once.
        let edges = [(a, b), (b, c), (c, a)].into_iter().filter(|(from, to)| from < to);
        edges.flat_map(|edge| of_edge(plant, &wood, *part, edge)).collect::<Vec<_>>()
    };
    Ok(wood.triangles.par_iter().flat_map_iter(of).collect())
}

fn of_edge(plant: &Plant, wood: &Wood, part: usize, (from, to): (u32, u32)) -> Option<Joint> {
    let branches = plant.branches()?;
    let [a, b] = [from, to].map(|v| branches.vertices[part].get(v as usize).copied());
    let (a, b) = (a?, b?);
    let row = branches.rows.get(a.branch as usize).filter(|row| row.parent != NO_BRANCH && a.branch == b.branch)?;
    let attachment = &branches.attachments[a.branch as usize];
    let thick = f64::from(row.radius + branches.rows[row.parent as usize].radius);
    let reach = attachment.bark_arc + NEAR_ROOT * thick;
    if f64::from(a.arc.min(b.arc)) > reach {
        return None;
    }
    let data = &plant.parts()[part];
    let [start, end] = [from, to].map(|v| (data.rest_position(v as usize) - plant.center()).as_vec3());
    let way = end - start;
    let beam = Beam { origin: start, direction: way.try_normalize()?, reach: way.length() };
    let ends = [from, to].map(|v| data.position_ids[v as usize]);
    // What shares a corner with its parent is one surface with it: it cannot come apart.
    let is_apart = |part: usize, v: u32| !ends.contains(&plant.parts()[part].position_ids[v as usize]);
    let of_parent = |triangle: u32| {
        let (part, corners) = wood.triangles[triangle as usize];
        let parents = branches.vertices[part].get(corners[0] as usize).is_some_and(|place| place.branch == row.parent);
        parents && corners.iter().all(|v| is_apart(part, *v))
    };
    let reach_of = |hit: &Hit| f64::from(a.arc + (b.arc - a.arc) * (hit.distance / way.length()));
    let hit = wood.rays.nearest(&beam, None, |hit| of_parent(hit.triangle) && reach_of(hit) <= reach)?;
    let (parent_part, corners) = wood.triangles[hit.triangle as usize];
    let (u, v) = (f64::from(hit.u), f64::from(hit.v));
    Some(Joint {
        part,
        edge: ([from, to], f64::from(hit.distance / way.length())),
        parent_part,
        triangle: (corners, [1.0 - u - v, u, v]),
        radius: branches.axes[a.branch as usize].at(reach_of(&hit)).radius.max(row.radius.into()),
    })
}

impl Joint {
    /// How far the branch's bark and the parent's have come apart, in radii of the branch.
    pub fn slip(&self, rest: &[Vec<Vertex>], moved: &[Vec<Vertex>]) -> f64 {
        let shift = |part: usize, v: u32| moved[part][v as usize].position - rest[part][v as usize].position;
        let ([a, b], share) = self.edge;
        let own = shift(self.part, a).lerp(shift(self.part, b), share);
        let (corners, shares) = self.triangle;
        let of_parent: DVec3 = (0..3).map(|k| shift(self.parent_part, corners[k]) * shares[k]).sum();
        own.distance(of_parent) / self.radius.max(f64::MIN_POSITIVE)
    }

    /// Largest difference of a level's weight between branch and parent.
    pub fn step(&self, weights: &[Vec<[f32; LEVELS]>]) -> f64 {
        let of = |part: usize, v: u32, level: usize| f64::from(weights[part][v as usize][level]);
        let ([a, b], share) = self.edge;
        let (corners, shares) = self.triangle;
        let difference = |level: usize| {
            let own = of(self.part, a, level) * (1.0 - share) + of(self.part, b, level) * share;
            let of_parent: f64 = (0..3).map(|k| of(self.parent_part, corners[k], level) * shares[k]).sum();
            (own - of_parent).abs()
        };
        (0..LEVELS).map(difference).fold(0.0, f64::max)
    }
}

/// Every leaf that hangs on a branch.
fn hangings(plant: &Plant) -> Vec<Hanging> {
    let Some(branches) = plant.branches() else { return Vec::new() };
    let mut triangles = vec![Vec::new(); branches.count()];
    for (part, data) in plant.parts().iter().enumerate().filter(|(part, _)| plant.role(*part) == Role::Wood) {
        for corners in &data.triangles {
            if let Some(list) = branches.vertices[part].get(corners[0] as usize).map(|place| place.branch as usize)
                && list < triangles.len()
            {
                triangles[list].push((part, *corners));
            }
        }
    }
    let mut leaves = vec![None; plant.leaves().len()];
    for (part, data) in plant.parts().iter().enumerate() {
        for vertex in 0..data.positions.len() {
            if let Some(leaf) = plant.leaf_of(part, vertex) {
                leaves[leaf as usize].get_or_insert((part, vertex as u32));
            }
        }
    }
    let mut of_branch = vec![Vec::new(); branches.count()];
    for (leaf, place) in branches.leaves.iter().enumerate().filter(|(_, place)| place.branch != NO_BRANCH) {
        of_branch[place.branch as usize].push((leaf, f64::from(place.arc)));
    }
    let one = |(branch, list): (usize, &Vec<(usize, f64)>)| -> Vec<Hanging> {
        let place = |&(part, corners): &(usize, [u32; 3])| {
            corners.map(|v| (plant.parts()[part].rest_position(v as usize) - plant.center()).as_vec3())
        };
        if list.is_empty() {
            return Vec::new();
        }
        let tree = TriangleTree::new(&triangles[branch].iter().map(place).collect::<Vec<_>>());
        let hang = |&(leaf, arc): &(usize, f64)| {
            let row = plant.leaves()[leaf];
            let spot = branches.axes[branch].at(arc);
            let toward = (row.petiole.as_dvec3() - spot.point).normalize_or(DVec3::Y);
            let bark = spot.point + toward * spot.radius - plant.center();
            let near = tree.closest(bark.as_vec3())?;
            let (part, corners) = triangles[branch][near.triangle as usize];
            Some(Hanging {
                leaf: leaves[leaf]?,
                part,
                corners,
                shares: shares(near.point, place(&(part, corners))),
                size: f64::from(row.area).sqrt().max(f64::from((row.center - row.petiole).length())),
            })
        };
        list.iter().filter_map(hang).collect()
    };
    of_branch.par_iter().enumerate().flat_map_iter(one).collect()
}

/// Shares of a triangle's corners at a place in it.
fn shares(place: Vec3, [a, b, c]: [Vec3; 3]) -> [f64; 3] {
    let [place, a, b, c] = [place, a, b, c].map(|p| p.as_dvec3());
    let area = |p: DVec3, q: DVec3, r: DVec3| (q - p).cross(r - p).length();
    let (of_a, of_b, of_c) = (area(place, b, c), area(place, c, a), area(place, a, b));
    let all = (of_a + of_b + of_c).max(f64::MIN_POSITIVE);
    [of_a / all, of_b / all, of_c / all]
}

/// What was measured over a time of wind.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Quality {
    /// Joints measured.
    pub joints: usize,
    /// 99th percentile over joints of the greatest slip, radii of the branch.
    pub slip_p99: f64,
    /// Greatest slip, radii of the branch.
    pub slip_max: f64,
    /// Greatest difference of weights across a joint.
    pub step_max: f64,
    /// 99th percentile over leaves of the greatest way between a petiole and its bark, in leaf sizes.
    pub leaf_p99: f64,
    /// 99th percentile over vertices of wood of the angle between normals in closed form and recomputed, degrees.
    pub normals_p99_deg: f64,
    /// The same for the normals at rest: what no correction would be off.
    pub uncorrected_p99_deg: f64,
    /// 99.9th percentile of the ratio of an edge's length to that at rest.
    pub stretch_p999: f64,
}

/// The greatest of so many in a hundred.
pub fn percentile(mut values: Vec<f64>, share: f64) -> f64 {
    if values.is_empty() {
        return 0.0;
    }
    let at = ((values.len() as f64 * share).ceil() as usize).clamp(1, values.len()) - 1;
    *values.select_nth_unstable_by(at, f64::total_cmp).1
}

/// Measures a plant in wind at some times: branches by `gusts`, leaves held to their branches.
///
/// # Errors
/// [`RayError`] where the wood cannot be shot at.
pub fn measure(plant: &Plant, player: &Player, gusts: &[Gust], noise: &Field) -> Result<Quality, RayError> {
    let (joints, hangings) = (joints(plant)?, hangings(plant));
    let smooth = Smooth::new(plant);
    let rest = smooth.normals(plant, player.moved(player.still(), noise));
    let seen = seen(plant, &joints);
    let (mut slips, mut leaves) = (vec![0.0f64; joints.len()], vec![0.0f64; hangings.len()]);
    let (mut angles, mut uncorrected, mut stretches) = (Vec::new(), Vec::new(), Vec::new());
    for gust in gusts {
        let gust = Gust { leaf: crate::LeafGust::default(), ..gust.clone() };
        let moved = player.moved_from(&rest, &gust, noise);
        slips.iter_mut().zip(&joints).for_each(|(slip, joint)| *slip = slip.max(joint.slip(&rest, &moved)));
        let shift = |part: usize, v: u32| moved[part][v as usize].position - rest[part][v as usize].position;
        for (worst, h) in leaves.iter_mut().zip(&hangings) {
            let bark: DVec3 = (0..3).map(|k| shift(h.part, h.corners[k]) * h.shares[k]).sum();
            *worst = worst.max(shift(h.leaf.0, h.leaf.1).distance(bark) / h.size.max(f64::MIN_POSITIVE));
        }
        let truth = smooth.normals(plant, moved.clone());
        for part in (0..plant.parts().len()).filter(|&part| plant.role(part) == Role::Wood) {
            let angle = |a: DVec3, b: DVec3| 2.0 * libm::asin((a.distance(b) / 2.0).min(1.0)).to_degrees();
            let seen = (0..moved[part].len()).filter(|v| seen[part][*v]);
            for (truth, moved, rest) in seen.map(|v| (truth[part][v], moved[part][v], rest[part][v])) {
                angles.push(angle(truth.normal, moved.normal));
                uncorrected.push(angle(truth.normal, rest.normal));
            }
            stretches.extend(plant.parts()[part].triangles.iter().map(|t| stretch(&rest[part], &moved[part], *t)));
        }
    }
    Ok(Quality {
        joints: joints.len(),
        slip_p99: percentile(slips.clone(), 0.99),
        slip_max: percentile(slips, 1.0),
        step_max: joints.iter().map(|joint| joint.step(&player.weights)).fold(0.0, f64::max),
        leaf_p99: percentile(leaves, 0.99),
        normals_p99_deg: percentile(angles, 0.99),
        uncorrected_p99_deg: percentile(uncorrected, 0.99),
        stretch_p999: percentile(stretches, 0.999),
    })
}

/// Per part, per vertex: whether it is no part of a branch that is hidden inside its parent.
fn seen(plant: &Plant, joints: &[Joint]) -> Vec<Vec<bool>> {
    let Some(branches) = plant.branches() else { return Vec::new() };
    let mut hidden = vec![-1.0f32; branches.count()];
    for joint in joints {
        let [a, b] = joint.edge.0.map(|v| branches.vertices[joint.part][v as usize]);
        hidden[a.branch as usize] = hidden[a.branch as usize].max(a.arc.min(b.arc));
    }
    let seen = |place: &OnBranch| place.branch != NO_BRANCH && place.arc > hidden[place.branch as usize];
    branches.vertices.iter().map(|list| list.iter().map(seen).collect()).collect()
}

fn stretch(rest: &[Vertex], moved: &[Vertex], [a, b, _]: [u32; 3]) -> f64 {
    let length = |list: &[Vertex]| list[a as usize].position.distance(list[b as usize].position);
    let (before, after) = (length(rest), length(moved));
    // An edge of no length has no ratio.
    if before > 0.0 { (after / before).max(before / after.max(f64::MIN_POSITIVE)) } else { 1.0 }
}

/// Which vertices share a normal: those of a branch at one position, be they copies along a seam or corners of a file whose
/// triangles share nothing.
struct Smooth {
    /// Per part, per vertex.
    slots: Vec<Vec<u32>>,
}

impl Smooth {
    fn new(plant: &Plant) -> Smooth {
        let of = |part: usize| {
            let data = &plant.parts()[part];
            let branch = |v: u32| plant.branches()?.vertices[part].get(v as usize).map(|place| place.branch);
            let key = |v: u32| (branch(v), data.positions[v as usize].to_array().map(f32::to_bits));
            let mut order: Vec<u32> = (0..data.positions.len() as u32).collect();
            order.sort_by_cached_key(|v| key(*v));
            let mut slots = vec![0u32; order.len()];
            for (slot, same) in order.chunk_by(|a, b| key(*a) == key(*b)).enumerate() {
                same.iter().for_each(|&v| slots[v as usize] = slot as u32);
            }
            slots
        };
        Smooth { slots: (0..plant.parts().len()).map(of).collect() }
    }

    /// The same places with normals of their triangles, weighted by area.
    fn normals(&self, plant: &Plant, mut places: Vec<Vec<Vertex>>) -> Vec<Vec<Vertex>> {
        for ((part, list), slots) in plant.parts().iter().zip(&mut places).zip(&self.slots) {
            let mut sums = vec![DVec3::ZERO; slots.len()];
            for &[a, b, c] in &part.triangles {
                let [p, q, r] = [a, b, c].map(|v| list[v as usize].position);
                let cross = (q - p).cross(r - p);
                [a, b, c].into_iter().for_each(|v| sums[slots[v as usize] as usize] += cross);
            }
            list.iter_mut().zip(slots).for_each(|(v, slot)| v.normal = sums[*slot as usize].normalize_or(v.normal));
        }
        places
    }
}
