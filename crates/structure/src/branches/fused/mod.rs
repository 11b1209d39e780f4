//! Wood in one piece that forks: level sets of the way from its foot fall into parts, parts into branches.

mod axes;
mod reeb;

use super::tube::{Graph, Tube, extremes};
use glam::DVec3;

/// Bands per mean edge of length: wider ones run forks together, narrower ones tear rings.
const BAND_EDGES: f64 = 1.5;
/// Nodes so near to an end, as a share of the longest way, tell how thick it is.
const END: f64 = 0.05;

/// One branch of a fused piece.
pub(super) struct Limb {
    pub tube: Tube,
    /// Its nodes in the piece, in the order of the tube's arcs.
    pub nodes: Vec<u32>,
    /// Index of the limb that it forks from; none for the first.
    pub parent: Option<u32>,
}

/// Takes a piece apart; one limb alone says that it does not fork. `whole` is what one tube makes of it.
pub(super) fn split(graph: &Graph, whole: &Tube) -> Vec<Limb> {
    let ways = foot(graph);
    let band = BAND_EDGES * graph.mean_edge();
    let reeb = reeb::Reeb::new(graph, &ways, band);
    let forks = reeb.branches(graph.points);
    axes::limbs(graph, &forks, band, whole)
}

/// The way from the foot to every node: of the ends that may be the foot, the one with most wood around it.
fn foot(graph: &Graph) -> Vec<f64> {
    let lowest = (0..graph.points.len() as u32).min_by(|&a, &b| {
        let [a, b] = [a, b].map(|n| graph.points[n as usize]);
        a.y.total_cmp(&b.y).then(a.x.total_cmp(&b.x)).then(a.z.total_cmp(&b.z))
    });
    let [a, b] = extremes(graph);
    let mut best: Option<(usize, Vec<f64>)> = None;
    for end in [lowest.unwrap_or(a), a, b] {
        let ways = graph.ways(&[end]);
        let longest = ways.iter().copied().filter(|w| w.is_finite()).fold(0.0, f64::max);
        let near = ways.iter().filter(|w| **w <= END * longest).count();
        if best.as_ref().is_none_or(|(most, _)| near > *most) {
            best = Some((near, ways));
        }
    }
    best.map_or(Vec::new(), |(_, ways)| ways)
}

/// Center of some nodes, and their mean distance from it.
fn ring(points: &[DVec3], nodes: &[u32]) -> (DVec3, f64) {
    let count = nodes.len().max(1) as f64;
    let center = nodes.iter().map(|&n| points[n as usize]).sum::<DVec3>() / count;
    (center, nodes.iter().map(|&n| points[n as usize].distance(center)).sum::<f64>() / count)
}
