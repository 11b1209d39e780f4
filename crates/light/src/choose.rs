//! How finely the sums are computed: the cheapest engine and opening, by a cost model, that keep the promise of
//! `quality`, as measured against the exact sums over a fixed sample of places. No clock has a say.

use crate::crown::{Crown, EXACT, order_of};
use crate::leaves::{Query, Source};
use crate::octants::OCTANTS;
use crate::params::{DepthEngine, Params};
use crate::profile::Profile;
use crate::reference::{self, transmittance};
use foliar_numerics::ErrorStats;
use foliar_numerics::Isa;
use foliar_schema::{MeasuredError, names};

/// Openings of the tree that are tried, coarsest first.
const OPENINGS: [f64; 6] = [0.8, 0.6, 0.45, 0.33, 0.24, 0.17];
/// Places of a sample: so many leaves, and so many of wood, 4,096 together.
const PLACES: usize = 2048;
/// Most pairs of place and leaf that are summed where nothing is chosen by them, only recorded.
const MOST_PAIRS: usize = 1 << 26;
/// Fewest places of a sample.
const FEWEST: usize = 64;
/// The same for sums in f64.
const MOST_EXACT_PAIRS: usize = 1 << 21;
const FEWEST_EXACT: usize = 8;

/// What a place costs: of a tree, and of a pair in the exact sum, in nanoseconds of one common processor: only their
/// ratio counts.
mod cost {
    /// A pair of leaf and place.
    pub const PAIR: f64 = 1.5;
    /// A place of a tree, times the opening to the power below, and for each doubling of the leaves.
    pub const PLACE: f64 = 124.0;
    /// Nodes that a place meets, by how wide they may be.
    pub const POWER: f64 = -1.4;
}

/// Depths, how they were found, and how far off they are.
pub(crate) struct Chosen {
    pub depths: Vec<[f32; OCTANTS]>,
    /// Of the tree; [`EXACT`] where all pairs were summed.
    pub opening: f64,
    pub errors: Vec<MeasuredError>,
}

/// So many indices of `count`, evenly spread.
pub(crate) fn spread(count: usize, most: usize) -> Vec<usize> {
    let places = most.min(count);
    (0..places).map(|i| i * count / places).collect()
}

/// Who asks: leaves, and after them places of wood.
struct Asking<'a> {
    crown: &'a Crown,
    sources: &'a [Source],
    profile: Profile,
    /// Samples of leaves and of wood, in this order.
    sample: Vec<Query>,
    leaves: usize,
}

impl<'a> Asking<'a> {
    /// Samples in the order of the tree, which is a matter of where places are: renumbering changes no choice.
    fn new(crown: &'a Crown, sources: &'a [Source], queries: &[Query], profile: Profile, most: usize) -> Asking<'a> {
        let (of_leaves, of_wood) = queries.split_at(sources.len());
        let some = |queries: &[Query]| -> Vec<Query> {
            let order = order_of(queries);
            spread(order.len(), most).into_iter().map(|at| queries[order[at] as usize]).collect()
        };
        let mut sample = some(of_leaves);
        let leaves = sample.len();
        sample.extend(some(of_wood));
        Asking { crown, sources, profile, sample, leaves }
    }

    fn depths(&self, opening: f64) -> Vec<[f32; OCTANTS]> {
        self.crown.depths(&self.sample, opening, Isa::best())
    }

    /// Error of each channel.
    fn errors(&self, fast: &[[f32; OCTANTS]], truth: &[[f32; OCTANTS]]) -> Vec<MeasuredError> {
        let (leaves, wood) = (self.leaves.min(fast.len()), fast.len());
        let of = |name: &str, range: std::ops::Range<usize>, octants: std::ops::Range<usize>| {
            let pairs = fast[range.clone()].iter().zip(&truth[range.clone()]);
            let seen = |depth: &f32| transmittance(f64::from(*depth));
            let off = pairs.flat_map(|(a, b)| octants.clone().map(move |j| seen(&a[j]) - seen(&b[j])));
            measured(name, off.collect(), range.len())
        };
        let column = format!("{}/{}", names::CLASS_LIGHT, names::OPTICAL_DEPTH);
        let mut errors = vec![of(&column, 0..leaves, 0..OCTANTS)];
        if wood > leaves {
            errors.push(of(names::LIGHT_DEPTH_0, leaves..wood, 0..OCTANTS / 2));
            errors.push(of(names::LIGHT_DEPTH_1, leaves..wood, OCTANTS / 2..OCTANTS));
        }
        errors
    }

    /// Errors of the exact sums, which are f32, against the reference's f64: at fewer places where there are many
    /// leaves, since nothing is chosen by them.
    fn rounding(&self) -> Vec<MeasuredError> {
        let most = (MOST_EXACT_PAIRS / self.sources.len().max(1)).clamp(FEWEST_EXACT, PLACES);
        let (leaves, wood) = self.sample.split_at(self.leaves);
        let some =
            |queries: &[Query]| spread(queries.len(), most).into_iter().map(|at| queries[at]).collect::<Vec<_>>();
        let mut sample = some(leaves);
        let leaves = sample.len();
        sample.extend(some(wood));
        let sums = reference::sums(self.sources, &sample, self.profile);
        let truth: Vec<_> = sums.iter().map(|sum| sum.depth.map(|depth| depth as f32)).collect();
        let few = Asking { sample, leaves, ..*self };
        few.errors(&few.depths(EXACT), &truth)
    }
}

/// Depths at all queries, leaves first, by the engine that `params` name, or by the cheaper one.
pub(crate) fn depths(crown: &Crown, sources: &[Source], queries: &[Query], params: &Params) -> Chosen {
    let leaves = sources.len();
    let fixed = params.opening.filter(|_| params.engine != DepthEngine::Exact);
    let most = if fixed.is_some() { (MOST_PAIRS / leaves.max(1)).clamp(FEWEST, PLACES) } else { PLACES };
    let asking = Asking::new(crown, sources, queries, params.profile, most);
    let all = |opening: f64| crown.depths(queries, opening, Isa::best());
    let openings: Vec<f64> = fixed.map_or_else(|| OPENINGS.to_vec(), |opening| vec![opening]);
    let tries = |opening: &f64| match params.engine {
        DepthEngine::Exact => false,
        DepthEngine::Auto => fixed.is_some() || cost_of_tree(*opening, leaves) < cost_of_pairs(leaves),
        _ => true,
    };
    let openings: Vec<f64> = openings.into_iter().filter(tries).collect();
    if !openings.is_empty() {
        let truth = asking.depths(EXACT);
        for (rung, &opening) in openings.iter().enumerate() {
            let errors = asking.errors(&asking.depths(opening), &truth);
            // Who asks for the tree gets it; who leaves the choice gets every pair where no tree is good enough.
            let is_last = rung + 1 == openings.len() && (fixed.is_some() || params.engine == DepthEngine::Tree);
            if is_last || worst(&errors) <= params.quality() {
                return Chosen { depths: all(opening), opening, errors };
            }
        }
    }
    Chosen { depths: all(EXACT), opening: EXACT, errors: asking.rounding() }
}

/// The largest of several errors, visible steps.
fn worst(errors: &[MeasuredError]) -> f64 {
    errors.iter().map(|error| error.rms_steps).fold(0.0, f64::max)
}

fn measured(name: &str, errors: Vec<f64>, places: usize) -> MeasuredError {
    let stats = ErrorStats::of(errors);
    let step = foliar_schema::column(names::CLASS_LIGHT, names::OPTICAL_DEPTH).map_or(1.0, |c| c.visible_step);
    MeasuredError {
        channel: name.into(),
        rms_steps: stats.rms / step,
        p999_steps: stats.p999 / step,
        places: places as u32,
    }
}

fn cost_of_tree(opening: f64, leaves: usize) -> f64 {
    cost::PLACE * libm::pow(opening, cost::POWER) * libm::log2(leaves.max(2) as f64)
}

fn cost_of_pairs(leaves: usize) -> f64 {
    cost::PAIR * leaves as f64
}
