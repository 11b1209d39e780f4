//! Statistics of errors, and rank correlation.

use crate::CompensatedSum;

/// What is said of a set of absolute errors.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct ErrorStats {
    /// Number of errors.
    pub count: usize,
    /// Root mean square.
    pub rms: f64,
    /// 99.9th percentile (nearest rank).
    pub p999: f64,
    /// Largest.
    pub max: f64,
}

impl ErrorStats {
    /// Statistics of absolute errors, in any order; all zero where there are none.
    pub fn of(errors: impl IntoIterator<Item = f64>) -> Self {
        let mut sorted: Vec<f64> = errors.into_iter().map(f64::abs).collect();
        if sorted.is_empty() {
            return ErrorStats::default();
        }
        sorted.sort_unstable_by(f64::total_cmp);
        let count = sorted.len();
        let squares = sorted.iter().map(|e| e * e).collect::<CompensatedSum>().value();
        let rank = ((count as f64 * 0.999).ceil() as usize).clamp(1, count);
        ErrorStats { count, rms: (squares / count as f64).sqrt(), p999: sorted[rank - 1], max: sorted[count - 1] }
    }
}

/// Spearman's rank correlation of two lists of equal length, ties at their mean rank; `None` where
/// either list has fewer than two distinct values.
pub fn spearman(a: &[f64], b: &[f64]) -> Option<f64> {
    assert_eq!(a.len(), b.len(), "spearman: lists of {} and {} values", a.len(), b.len());
    let (ranks_a, ranks_b) = (mean_ranks(a), mean_ranks(b));
    let mean = (a.len() as f64 + 1.0) / 2.0;
    let product = |x: &[f64], y: &[f64]| {
        x.iter().zip(y).map(|(p, q)| (p - mean) * (q - mean)).collect::<CompensatedSum>().value()
    };
    let scale = (product(&ranks_a, &ranks_a) * product(&ranks_b, &ranks_b)).sqrt();
    (scale > 0.0).then(|| product(&ranks_a, &ranks_b) / scale)
}

fn mean_ranks(values: &[f64]) -> Vec<f64> {
    let mut order: Vec<usize> = (0..values.len()).collect();
    order.sort_by(|&i, &j| values[i].total_cmp(&values[j]));
    let mut ranks = vec![0.0; values.len()];
    let mut before = 0;
    for tied in order.chunk_by(|&i, &j| values[i].total_cmp(&values[j]).is_eq()) {
        let rank = before as f64 + (tied.len() as f64 + 1.0) / 2.0;
        tied.iter().for_each(|&i| ranks[i] = rank);
        before += tied.len();
    }
    ranks
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn statistics_of_a_known_list() {
        let stats = ErrorStats::of((1..=1000).map(|i| -f64::from(i)));
        assert_eq!((stats.count, stats.p999 as i32, stats.max as i32), (1000, 999, 1000));
        assert!((stats.rms - (1001.0f64 * 2001.0 / 6.0).sqrt()).abs() < 1e-9);
    }

    #[test]
    fn a_falling_function_has_rank_correlation_minus_one() {
        let a = [1.0, 2.0, 5.0, 9.0];
        assert!((spearman(&a, &a.map(|x| -x * x)).unwrap() + 1.0).abs() < 1e-12);
        assert_eq!(spearman(&a, &[3.0; 4]), None);
    }
}
