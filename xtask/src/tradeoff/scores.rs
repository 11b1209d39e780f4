//! How near a candidate comes to the traced light.

use super::light::Light;
use foliar_plant::Plant;
use glam::DVec3;
use rayon::prelude::*;

/// Normals of the vertices of each leaf; one for all of them where a method is evaluated per leaf.
pub type LeafNormals = Vec<Vec<DVec3>>;

/// Sums of a weighted correlation.
#[derive(Clone, Copy, Default)]
struct Moments {
    weight: f64,
    x: f64,
    y: f64,
    xx: f64,
    yy: f64,
    xy: f64,
}

impl Moments {
    fn add(&mut self, weight: f64, x: f64, y: f64) {
        self.weight += weight;
        self.x += weight * x;
        self.y += weight * y;
        self.xx += weight * x * x;
        self.yy += weight * y * y;
        self.xy += weight * x * y;
    }

    fn join(self, other: &Moments) -> Moments {
        Moments {
            weight: self.weight + other.weight,
            x: self.x + other.x,
            y: self.y + other.y,
            xx: self.xx + other.xx,
            yy: self.yy + other.yy,
            xy: self.xy + other.xy,
        }
    }

    fn correlation(&self) -> f64 {
        let covariance = |xy: f64, x: f64, y: f64| xy / self.weight - x / self.weight * (y / self.weight);
        let (xx, yy) = (covariance(self.xx, self.x, self.x), covariance(self.yy, self.y, self.y));
        covariance(self.xy, self.x, self.y) / (xx * yy).sqrt()
    }
}

/// Correlation of max(0, N.L) with low-passed visibility over leaves and directions: leaves weighted by how
/// much is seen of them from outside, and all alike.
pub fn shading(light: &Light, normals: &LeafNormals) -> [f64; 2] {
    let leaf = |(leaf, corners): (usize, &Vec<DVec3>)| {
        let mut moments = [Moments::default(); 2];
        for (d, toward) in light.directions.iter().enumerate() {
            let shade = corners.iter().map(|n| n.dot(*toward).max(0.0)).sum::<f64>() / corners.len().max(1) as f64;
            let visible = f64::from(light.low_passed[leaf][d]);
            moments[0].add(light.seen[leaf], shade, visible);
            moments[1].add(1.0, shade, visible);
        }
        moments
    };
    // Collected in order and summed one by one: the same bits on any number of threads.
    let leaves: Vec<[Moments; 2]> = normals.par_iter().enumerate().map(leaf).collect();
    [0, 1].map(|k| leaves.iter().fold(Moments::default(), |sum, leaf| sum.join(&leaf[k])).correlation())
}

/// Share of leaves of which two corners differ by more than each of two angles, percent.
pub fn jumps(normals: &LeafNormals, degrees: [f64; 2]) -> [f64; 2] {
    let widest = |corners: &Vec<DVec3>| {
        let pairs = corners.iter().enumerate().flat_map(|(i, a)| corners[..i].iter().map(move |b| a.dot(*b)));
        pairs.fold(1.0, f64::min)
    };
    let widest: Vec<f64> = normals.par_iter().map(widest).collect();
    degrees.map(|angle| {
        let least = libm::cos(angle.to_radians());
        100.0 * widest.iter().filter(|w| **w < least).count() as f64 / widest.len().max(1) as f64
    })
}

/// Share of the variance of traced ambient light that a term explains, and their rms difference.
pub fn ambient(light: &Light, term: &[f64]) -> [f64; 2] {
    let truth = light.ambient();
    let mut moments = Moments::default();
    truth.iter().zip(term).for_each(|(t, a)| moments.add(1.0, *a, *t));
    let squares: f64 = truth.iter().zip(term).map(|(t, a)| (t - a) * (t - a)).sum();
    let correlation = moments.correlation();
    [correlation * correlation, (squares / truth.len() as f64).sqrt()]
}

/// Values of a channel at the vertices of each leaf.
pub fn by_leaf<T>(plant: &Plant, mut value: impl FnMut(usize, usize) -> T) -> Vec<Vec<T>> {
    let mut leaves: Vec<Vec<T>> = (0..plant.leaves().len()).map(|_| Vec::new()).collect();
    for (index, part) in plant.parts().iter().enumerate() {
        for vertex in 0..part.positions.len() {
            if let Some(leaf) = plant.leaf_of(index, vertex) {
                leaves[leaf as usize].push(value(index, vertex));
            }
        }
    }
    leaves
}
