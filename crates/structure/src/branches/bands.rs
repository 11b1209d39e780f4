//! Pieces whose rings are no level sets of edges: opposed ways along the surface, cut into bands, then the
//! nodes are brought to the nearest place on the axis and cut anew.

use super::tube::{Graph, Tube, extremes, of_levels};
use foliar_plant::Axis;

/// Rounds of bringing nodes to the axis and cutting anew.
const ROUNDS: usize = 4;
/// Bands per mean edge of length.
const BAND_EDGES: f64 = 1.5;
/// Bands that one piece gets at most.
const MOST_BANDS: usize = 512;

/// Fits a piece by bands; `rough` is what level sets of edges gave.
pub(super) fn fit(graph: &Graph, rough: &Tube) -> Tube {
    let [a, b] = extremes(graph);
    let (from_a, from_b) = (graph.ways(&[a]), graph.ways(&[b]));
    let length = from_a[b as usize];
    if !(length.is_finite() && length > 0.0) {
        return rough.clone();
    }
    // Opposed ways: exact at both ends, a blend between.
    let field: Vec<f64> = from_a
        .iter()
        .zip(&from_b)
        .map(|(&from, &to)| {
            let t = from / (from + to);
            (1.0 - t) * from + t * (length - to)
        })
        .collect();
    let bands = ((length / (BAND_EDGES * graph.mean_edge())).round() as usize).clamp(2, MOST_BANDS);
    let mut tube = cut(graph, &field, length, bands);
    for _ in 0..ROUNDS {
        let axis = tube.axis.clone();
        let field: Vec<f64> = graph.points.iter().map(|&p| axis.nearest(p).arc).collect();
        tube = cut(graph, &field, axis.length(), bands);
    }
    tube
}

/// Rings of nodes whose field lies in the same band; empty bands are left out.
fn cut(graph: &Graph, field: &[f64], length: f64, bands: usize) -> Tube {
    let band = |value: f64| ((value / length * bands as f64) as usize).min(bands - 1);
    let mut used = vec![u32::MAX; bands];
    field.iter().filter(|f| f.is_finite()).for_each(|&f| used[band(f)] = 0);
    let mut count = 0;
    for slot in used.iter_mut().filter(|s| **s == 0) {
        *slot = count;
        count += 1;
    }
    let levels: Vec<u32> = field.iter().map(|&f| if f.is_finite() { used[band(f)] } else { 0 }).collect();
    let tube = of_levels(graph, &levels, count as usize);
    smoothed(tube, graph)
}

/// Arcs of nodes by their own place on the axis, since bands are wide.
fn smoothed(tube: Tube, graph: &Graph) -> Tube {
    let axis: &Axis = &tube.axis;
    let arcs = graph.points.iter().map(|&p| axis.nearest(p).arc).collect();
    Tube { arcs, ..tube }
}
