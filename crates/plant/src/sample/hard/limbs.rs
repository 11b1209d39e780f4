//! Axes of hard trees.

use crate::Axis;
use crate::sample::noise::{signed, unit};
use glam::DVec3;

/// One tube.
#[derive(Clone, Debug)]
pub struct Limb {
    /// Index of its parent, which stands before it.
    pub parent: Option<u32>,
    /// From root to tip.
    pub axis: Axis,
    /// 0 for a stem; deepest bear leaves.
    pub level: usize,
}

/// Where a child's first ring is centered.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Start {
    /// On the parent's axis.
    Axis,
    /// So many of its own radii off the parent's bark.
    Bark(f64),
}

/// How a tree's limbs are made.
#[derive(Clone, Debug)]
pub struct Wood {
    pub seed: u64,
    /// Children per limb at levels 1 to 3.
    pub counts: [u32; 3],
    pub start: Start,
    /// Radians by which each ring turns at random.
    pub crook: f64,
    /// Factor on the radii of children.
    pub fat: f64,
    /// Radius at the tip over that at the root.
    pub tip: f64,
    /// Tubes end to end that make one branch.
    pub pieces: u32,
    /// Children that are born at one height.
    pub whorl: u32,
    /// Rings of a limb beyond the first.
    pub rings: u32,
}

const GOLDEN_ANGLE: f64 = 2.399_963_229_728_653;

impl Wood {
    pub fn new(seed: u64) -> Wood {
        Wood {
            seed,
            counts: [14, 6, 2],
            start: Start::Axis,
            crook: 0.04,
            fat: 1.0,
            tip: 0.3,
            pieces: 1,
            whorl: 1,
            rings: 7,
        }
    }

    /// A trunk of 10 m with boughs, branches and twigs.
    pub fn tree(&self) -> Vec<Limb> {
        let mut limbs = Vec::new();
        self.stem(&mut limbs, DVec3::ZERO, DVec3::Y, 10.0, 0.16);
        limbs
    }

    fn stem(&self, limbs: &mut Vec<Limb>, foot: DVec3, along: DVec3, length: f64, radius: f64) {
        let last = self.push(limbs, None, 0, &Growth { root: foot, along, length, radius });
        self.children(limbs, last, 1);
    }

    fn children(&self, limbs: &mut Vec<Limb>, parent: u32, level: usize) {
        let Some(&count) = self.counts.get(level - 1) else { return };
        // A branch of several tubes bears children on all of them.
        let tubes: Vec<u32> = (0..self.pieces).map(|k| parent + 1 - self.pieces + k).collect();
        let chance = |k: u64| unit(self.seed + 13, u64::from(parent) * 97 + k);
        for child in 0..count {
            let step = (child / self.whorl * self.whorl) as f64 + 0.5 * f64::from(self.whorl);
            let share = 0.28 + 0.66 * (step + 0.3 * (chance(4) - 0.5)) / f64::from(count);
            let place = share * tubes.len() as f64;
            let tube = tubes[(place as usize).min(tubes.len() - 1)];
            let axis = limbs[tube as usize].axis.clone();
            let spot = axis.at((place - place.floor()) * axis.length());
            let tangent = axis.heading_at(spot.arc);
            let turn = GOLDEN_ANGLE * f64::from(child) + 6.0 * chance(u64::from(child) + 40);
            let side = tangent.any_orthonormal_vector();
            let out = side * libm::cos(turn) + tangent.cross(side) * libm::sin(turn);
            let tilt = 0.75 + 0.35 * chance(u64::from(child) + 80);
            let along = (tangent * libm::cos(tilt) + out * libm::sin(tilt)).normalize();
            let total: f64 = tubes.iter().map(|&t| limbs[t as usize].axis.length()).sum();
            let radius = self.fat * spot.radius * 0.42;
            let away = match self.start {
                Start::Axis => 0.0,
                Start::Bark(gap) => (spot.radius + gap * radius) / libm::sin(tilt),
            };
            let growth =
                Growth { root: spot.point + along * away, along, length: total * (0.52 - 0.3 * share), radius };
            let last = self.push(limbs, Some(tube), level, &growth);
            self.children(limbs, last, level + 1);
        }
    }

    /// Adds a branch; the index of its last tube.
    fn push(&self, limbs: &mut Vec<Limb>, parent: Option<u32>, level: usize, growth: &Growth) -> u32 {
        let seed = self.seed + 7 * limbs.len() as u64;
        let rings = if level == 0 { 2 * self.rings } else { self.rings } * self.pieces;
        let (mut points, mut radii) = (vec![growth.root], vec![growth.radius]);
        let mut along = growth.along;
        for ring in 1..=rings {
            let chance = [0, 1, 2].map(|k| signed(seed + 29, u64::from(3 * ring + k)));
            along = (along + DVec3::from(chance) * self.crook).normalize();
            points.push(points[points.len() - 1] + along * (growth.length / f64::from(rings)));
            let share = f64::from(ring) / f64::from(rings);
            radii.push(growth.radius * (1.0 + (self.tip - 1.0) * share));
        }
        let each = (rings / self.pieces) as usize;
        let mut before = parent;
        for piece in 0..self.pieces as usize {
            let range = piece * each..=(piece + 1) * each;
            let axis = Axis::new(points[range.clone()].to_vec(), radii[range].to_vec());
            limbs.push(Limb { parent: before, axis, level });
            before = Some(limbs.len() as u32 - 1);
        }
        limbs.len() as u32 - 1
    }

    /// Stems that lean away from a common place.
    pub fn shrub(&self, stems: u32) -> Vec<Limb> {
        let mut limbs = Vec::new();
        let wood = Wood { counts: [7, 4, 1], ..self.clone() };
        for stem in 0..stems {
            let turn = GOLDEN_ANGLE * f64::from(stem);
            let out = DVec3::new(libm::cos(turn), 0.0, libm::sin(turn));
            let height = 1.0 + 0.4 * unit(self.seed, u64::from(stem));
            wood.stem(&mut limbs, out * (0.04 + 0.01 * f64::from(stem)), DVec3::Y + 0.35 * out, 2.0 * height, 0.02);
        }
        limbs
    }

    /// Roots that leave the trunk's foot along the ground.
    pub fn with_roots(&self, roots: u32) -> Vec<Limb> {
        let mut limbs = self.tree();
        let wood = Wood { counts: [0, 0, 0], ..self.clone() };
        for root in 0..roots {
            let turn = std::f64::consts::TAU * f64::from(root) / f64::from(roots);
            let along = DVec3::new(libm::cos(turn), -0.12, libm::sin(turn)).normalize();
            let foot = DVec3::Y * 0.12;
            wood.push(&mut limbs, Some(0), 1, &Growth { root: foot, along, length: 1.4, radius: 0.08 });
        }
        limbs
    }

    /// A bare trunk, fronds from its top, leaflets on them.
    pub fn palm(&self) -> Vec<Limb> {
        let mut limbs = Vec::new();
        let top =
            self.push(&mut limbs, None, 0, &Growth { root: DVec3::ZERO, along: DVec3::Y, length: 8.0, radius: 0.15 });
        let crown = limbs[0].axis.at(7.9).point;
        let wood = Wood { counts: [0, 18, 0], crook: 0.1, ..self.clone() };
        for frond in 0..22u32 {
            let turn = GOLDEN_ANGLE * f64::from(frond);
            let along = DVec3::new(libm::cos(turn), 0.9 - 0.05 * f64::from(frond), libm::sin(turn)).normalize();
            let last = wood.push(&mut limbs, Some(top), 1, &Growth { root: crown, along, length: 2.4, radius: 0.02 });
            wood.children(&mut limbs, last, 2);
        }
        limbs
    }

    /// Each limb ends where two begin; `shares` are their radii over their parent's tip.
    pub fn forks(&self, shares: [f64; 2]) -> Vec<Limb> {
        let wood = Wood { tip: 0.8, ..self.clone() };
        let mut limbs = Vec::new();
        wood.push(&mut limbs, None, 0, &Growth { root: DVec3::ZERO, along: DVec3::Y, length: 2.5, radius: 0.16 });
        let mut parent = 0;
        while parent < limbs.len() as u32 && limbs.len() < 250 {
            let axis = limbs[parent as usize].axis.clone();
            let end = axis.at(axis.length());
            let (tangent, level) = (-axis.heading(true), limbs[parent as usize].level);
            let turn = GOLDEN_ANGLE * f64::from(parent);
            let side = tangent.any_orthonormal_vector();
            let out = side * libm::cos(turn) + tangent.cross(side) * libm::sin(turn);
            for (share, sign) in shares.into_iter().zip([1.0, -1.0]) {
                let along = (tangent * libm::cos(0.65) + out * (sign * libm::sin(0.65))).normalize();
                let length = 0.8 * axis.length() * (0.8 + 0.2 * share);
                let growth = Growth { root: end.point, along, length, radius: end.radius * share };
                wood.push(&mut limbs, Some(parent), level + 1, &growth);
            }
            parent += 1;
        }
        limbs
    }

    /// Boughs full of needles, a thousandth of the tree thick.
    pub fn needles(&self) -> Vec<Limb> {
        let wood = Wood { counts: [18, 38, 0], ..self.clone() };
        let mut limbs = wood.tree();
        for limb in limbs.iter_mut().filter(|l| l.level == 2) {
            let root = limb.axis.points[0];
            let along = limb.axis.heading(false);
            let points = vec![root, root + along * 0.03, root + along * 0.06];
            limb.axis = Axis::new(points, vec![0.0008, 0.0006, 0.0001]);
        }
        limbs
    }

    /// Twigs in the air, far from everything.
    pub fn with_islands(&self, islands: u32) -> Vec<Limb> {
        let mut limbs = self.tree();
        for island in 0..islands {
            let root = DVec3::new(9.0, 4.0 + 2.0 * f64::from(island), 9.0 - f64::from(island));
            self.push(&mut limbs, None, 1, &Growth { root, along: DVec3::X, length: 0.5, radius: 0.02 });
        }
        limbs
    }

    /// Two trees, the second smaller and eight meters aside.
    pub fn twice(&self) -> Vec<Limb> {
        let mut limbs = self.tree();
        let other = Wood { seed: self.seed + 1000, counts: [8, 4, 2], ..self.clone() };
        other.stem(&mut limbs, DVec3::new(9.0, 0.1, 1.0), DVec3::Y, 6.0, 0.1);
        limbs
    }

    /// A thin stem that is far longer than it is thick, hung with branches.
    pub fn vine(&self) -> Vec<Limb> {
        let wood = Wood { counts: [40, 3, 0], crook: 0.25, rings: 12, ..self.clone() };
        let mut limbs = Vec::new();
        wood.stem(&mut limbs, DVec3::ZERO, DVec3::Y, 14.0, 0.04);
        limbs
    }
}

/// Where a branch starts and how far it goes.
struct Growth {
    root: DVec3,
    along: DVec3,
    length: f64,
    radius: f64,
}

impl Axis {
    /// Unit direction of the segment at an arc length.
    fn heading_at(&self, arc: f64) -> DVec3 {
        let last = self.points.len() - 1;
        let upper = self.arcs.partition_point(|&a| a <= arc).clamp(1, last);
        (self.points[upper] - self.points[upper - 1]).normalize_or(DVec3::Y)
    }
}
