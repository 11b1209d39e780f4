//! Adding-doubling (van de Hulst): exact but for the number of directions. The model of energy.
//!
//! A layer too thin to scatter twice is doubled until it is the leaf; layers and the two surfaces are joined by the star
//! product. Directions are Gauss nodes inside the tissue, half of them beyond the critical angle, and nodes of weight
//! zero at the refracted cosines that are asked for.

use super::boundary::{LEAST_COSINE, critical_cosine, fresnel_inside, is_matched, plate, refracted};
use super::matrix::Matrix;
use super::{Layer, Medium};
use foliar_numerics::{Isa, gauss_legendre, legendre};
use pulp::{Simd, WithSimd};

/// Scattering times thickness below which a leaf is a clear plate: total reflection makes the star product singular there.
const CLEAR: f64 = 1e-12;
/// Optical thickness of the first layer, and as a share of the least cosine: thinner loses digits, thicker is no single scattering.
const FIRST_LAYER: f64 = 1e-3;
const FIRST_LAYER_SHARE: f64 = 0.02;

/// (R, T) for one direction, per unit of light on the outside; unscattered and mirrored light included.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Totals {
    /// Cosine in air.
    pub cosine: f64,
    /// Reflectance.
    pub reflectance: f64,
    /// Transmittance.
    pub transmittance: f64,
}

/// A leaf solved.
#[derive(Clone, Debug, PartialEq)]
pub struct AddingDoubling {
    /// The cosines asked for, lit from the front.
    pub front: Vec<Totals>,
    /// The same, lit from the back.
    pub back: Vec<Totals>,
    /// Every Gauss node that leaves the tissue, lit from the front; cosines rise.
    pub nodes: Vec<Totals>,
    /// Diffuse light on the front.
    pub front_diffuse: Totals,
    /// Diffuse light on the back.
    pub back_diffuse: Totals,
}

impl AddingDoubling {
    /// Solves layers, listed from the lit side, for light at `cosines` in air, with `count` (even) Gauss nodes.
    /// All layers have the index of the first.
    pub fn solve(layers: &[Layer], cosines: &[f64], count: usize) -> AddingDoubling {
        let index = layers.first().map_or(1.0, |layer| layer.medium.index);
        let nodes = Nodes::new(index, cosines, count);
        let scatters = |layer: &Layer| nodes.scattering(&layer.medium) * layer.thickness_mm >= CLEAR;
        if !layers.iter().any(scatters) {
            return nodes.clear(layers);
        }
        let surface = nodes.surface();
        let inside = layers.iter().map(|layer| nodes.interior(layer));
        let leaf = inside.fold(surface.clone(), |above, below| above.above(&below)).above(&surface);
        nodes.read(&leaf)
    }

    /// One layer at one cosine.
    pub fn one(medium: &Medium, thickness_mm: f64, cosine: f64, count: usize) -> Totals {
        let layers = [Layer { medium: *medium, thickness_mm }];
        AddingDoubling::solve(&layers, &[cosine], count).front[0]
    }
}

/// What a stack does to light of each direction: 1 is above, 2 below.
#[derive(Clone)]
struct Stack {
    r12: Matrix,
    t12: Matrix,
    r21: Matrix,
    t21: Matrix,
}

impl Stack {
    /// The star product: this above `below`.
    fn above(&self, below: &Stack) -> Stack {
        // Light between the two: from above, each round trip meets `below` first.
        let down = self.r21.times(&below.r12).one_less().under(&self.t12);
        let up = below.r12.times(&self.r21).one_less().under(&below.t21);
        Stack {
            r12: self.r12.plus(&self.t21.times(&below.r12).times(&down)),
            t12: below.t12.times(&down),
            r21: below.r21.plus(&below.t12.times(&self.r21).times(&up)),
            t21: self.t21.times(&up),
        }
    }
}

/// A layer laid on its like so many times.
struct Doubling {
    r: Matrix,
    t: Matrix,
    doublings: u32,
}

impl WithSimd for Doubling {
    type Output = (Matrix, Matrix);

    #[inline(always)]
    fn with_simd<S: Simd>(self, _: S) -> (Matrix, Matrix) {
        let Doubling { mut r, mut t, doublings } = self;
        for _ in 0..doublings {
            let between = t.over(&r.times(&r).one_less());
            r = r.plus(&between.times(&r).times(&t));
            t = between.times(&t);
        }
        (r, t)
    }
}

/// Directions inside the tissue: cosine, weight (0 for those asked for), reflectance of the surface.
struct Nodes {
    index: f64,
    inside: Vec<f64>,
    weights: Vec<f64>,
    surface: Vec<f64>,
    asked: Vec<f64>,
    gauss: usize,
}

impl Nodes {
    fn new(index: f64, cosines: &[f64], count: usize) -> Nodes {
        let critical = critical_cosine(index);
        let half = count / 2;
        let mut gauss =
            if is_matched(index) { gauss_legendre(count, 0.0, 1.0) } else { gauss_legendre(half, 0.0, critical) };
        if !is_matched(index) {
            gauss.extend(gauss_legendre(count - half, critical, 1.0));
        }
        let asked: Vec<f64> = cosines.iter().map(|c| c.clamp(LEAST_COSINE, 1.0)).collect();
        let mut nodes = gauss.clone();
        nodes.extend(asked.iter().map(|outside| (refracted(*outside, index), 0.0)));
        Nodes {
            index,
            inside: nodes.iter().map(|n| n.0).collect(),
            weights: nodes.iter().map(|n| n.1).collect(),
            surface: nodes.iter().map(|n| fresnel_inside(n.0, index)).collect(),
            asked,
            gauss: gauss.len(),
        }
    }

    /// Share of the scattering that delta-M (Wiscombe 1977) counts as unscattered.
    fn peak(&self, medium: &Medium) -> f64 {
        if medium.anisotropy >= 1.0 { 1.0 } else { libm::pow(medium.anisotropy.abs(), self.gauss as f64) }
    }

    fn scattering(&self, medium: &Medium) -> f64 {
        medium.scattering * (1.0 - self.peak(medium))
    }

    fn surface(&self) -> Stack {
        let passed: Vec<f64> = self.surface.iter().map(|f| 1.0 - f).collect();
        let (r, t) = (Matrix::diagonal(&self.surface), Matrix::diagonal(&passed));
        Stack { r12: r.clone(), t12: t.clone(), r21: r, t21: t }
    }

    /// A layer without surfaces: doubling.
    fn interior(&self, layer: &Layer) -> Stack {
        let medium = &layer.medium;
        let scattering = self.scattering(medium);
        let extinction = medium.absorption + scattering;
        let depth = extinction * layer.thickness_mm;
        let least = self.inside.iter().copied().fold(1.0, f64::min);
        let mut doublings = 0;
        let mut start = depth;
        while start > FIRST_LAYER.min(FIRST_LAYER_SHARE * least) {
            start /= 2.0;
            doublings += 1;
        }
        let albedo = if extinction > 0.0 { scattering / extinction } else { 0.0 };
        let (r, t) = self.first(medium, albedo, start);
        let (r, t) = Isa::best().dispatch(Doubling { r, t, doublings });
        Stack { r12: r.clone(), t12: t.clone(), r21: r, t21: t }
    }

    /// The first layer, by differences at its middle.
    fn first(&self, medium: &Medium, albedo: f64, depth: f64) -> (Matrix, Matrix) {
        let (ahead, astern) = self.phase(medium);
        let size = self.inside.len();
        let loss = Matrix::from_fn(size, |i, j| {
            let own = f64::from(u8::from(i == j));
            depth / 2.0 / self.inside[i] * (own - albedo / 2.0 * ahead.at(i, j) * self.weights[j])
        });
        let gain = Matrix::from_fn(size, |i, j| {
            depth / 2.0 / self.inside[i] * albedo / 2.0 * astern.at(i, j) * self.weights[j]
        });
        let through = loss.and_one();
        let back = through.under(&gain);
        let twice = back.times(&back);
        let t = twice.one_less().under(&through.under(&loss.one_less()).plus(&twice));
        let r = back.times(&t.and_one());
        (r, t)
    }

    /// Phase function between directions that go on, and that turn back; each row keeps all energy.
    fn phase(&self, medium: &Medium) -> (Matrix, Matrix) {
        let peak = self.peak(medium);
        let g = medium.anisotropy;
        let moment = |l: usize| {
            let power = (0..l).fold(1.0, |power, _| power * g);
            (2 * l + 1) as f64 * if peak < 1.0 { (power - peak) / (1.0 - peak) } else { 0.0 }
        };
        let moments: Vec<f64> = (0..self.gauss).map(moment).collect();
        let shapes: Vec<Vec<f64>> = self.inside.iter().map(|mu| legendre(self.gauss, *mu)).collect();
        let sum = |i: usize, j: usize, turned: f64| {
            let mut sign = 1.0;
            moments.iter().zip(shapes[i].iter().zip(&shapes[j])).fold(0.0, |sum, (moment, (a, b))| {
                let term = sign * moment * a * b;
                sign *= turned;
                sum + term
            })
        };
        let size = self.inside.len();
        let (ahead, astern) =
            (Matrix::from_fn(size, |i, j| sum(i, j, 1.0)), Matrix::from_fn(size, |i, j| sum(i, j, -1.0)));
        let kept: Vec<f64> =
            (0..size).map(|i| (0..size).map(|j| self.weights[j] * (ahead.at(i, j) + astern.at(i, j))).sum()).collect();
        let scaled = |value: f64, i: usize| if i < self.gauss { value } else { value * 2.0 / kept[i] };
        let residual =
            |i: usize, j: usize| if i == j && i < self.gauss { (2.0 - kept[i]) / self.weights[i] } else { 0.0 };
        (
            Matrix::from_fn(size, |i, j| scaled(ahead.at(i, j), i) + residual(i, j)),
            Matrix::from_fn(size, |i, j| scaled(astern.at(i, j), i)),
        )
    }

    /// Whether light of a node leaves the tissue.
    fn leaves(&self, node: usize) -> bool {
        self.surface[node] < 1.0
    }

    fn outside(&self, node: usize) -> f64 {
        if node >= self.gauss {
            return self.asked[node - self.gauss];
        }
        let radicand = 1.0 - self.index * self.index * (1.0 - self.inside[node] * self.inside[node]);
        radicand.max(0.0).sqrt()
    }

    /// By reciprocity a hemisphere's worth of light into one direction is one direction's worth into the hemisphere.
    fn total(&self, matrix: &Matrix, node: usize) -> f64 {
        let scattered: f64 = (0..self.gauss).filter(|i| self.leaves(*i)).map(|i| matrix.at(node, i)).sum();
        if node < self.gauss { scattered } else { scattered + matrix.at(node, node) }
    }

    fn read(&self, leaf: &Stack) -> AddingDoubling {
        let side = |r: &Matrix, t: &Matrix, node: usize| Totals {
            cosine: self.outside(node),
            reflectance: self.total(r, node),
            transmittance: self.total(t, node),
        };
        // T of a lit front is, by reciprocity, what diffuse light from the back sends into the front's direction.
        self.collect(|node| side(&leaf.r12, &leaf.t21, node), |node| side(&leaf.r21, &leaf.t12, node))
    }

    fn collect(&self, front: impl Fn(usize) -> Totals, back: impl Fn(usize) -> Totals) -> AddingDoubling {
        let leaving: Vec<usize> = (0..self.gauss).filter(|i| self.leaves(*i)).collect();
        let asked = self.gauss..self.inside.len();
        let diffuse = |of: &dyn Fn(usize) -> Totals| {
            leaving.iter().fold(Totals { cosine: f64::NAN, ..Totals::default() }, |sum, node| {
                // mu_o dmu_o = index^2 mu_i dmu_i
                let weight = 2.0 * self.index * self.index * self.inside[*node] * self.weights[*node];
                let totals = of(*node);
                Totals {
                    reflectance: sum.reflectance + weight * totals.reflectance,
                    transmittance: sum.transmittance + weight * totals.transmittance,
                    ..sum
                }
            })
        };
        AddingDoubling {
            front_diffuse: diffuse(&front),
            back_diffuse: diffuse(&back),
            front: asked.clone().map(&front).collect(),
            back: asked.map(&back).collect(),
            nodes: leaving.iter().map(|node| front(*node)).collect(),
        }
    }

    /// A leaf that does not scatter.
    fn clear(&self, layers: &[Layer]) -> AddingDoubling {
        let depth: f64 = layers
            .iter()
            .map(|layer| (layer.medium.absorption + self.scattering(&layer.medium)) * layer.thickness_mm)
            .sum();
        let totals = |node: usize| {
            let (reflectance, transmittance) =
                plate(self.surface[node], libm::exp(-depth / self.inside[node].max(f64::MIN_POSITIVE)));
            Totals { cosine: self.outside(node), reflectance, transmittance }
        };
        self.collect(totals, totals)
    }
}
