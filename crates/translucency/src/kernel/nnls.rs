//! Least squares with weights that must not be negative (Lawson 1974), for a handful of unknowns.

/// A gradient below this share of the largest product is rounding.
const ROUNDING: f64 = 1e-12;

/// Weights x >= 0 that make |A x - b| least; `columns` are the columns of A.
pub fn nnls(columns: &[Vec<f64>], target: &[f64]) -> Vec<f64> {
    let count = columns.len();
    let dot = |a: &[f64], b: &[f64]| a.iter().zip(b).map(|(x, y)| x * y).sum::<f64>();
    let gram: Vec<Vec<f64>> = columns.iter().map(|a| columns.iter().map(|b| dot(a, b)).collect()).collect();
    let goal: Vec<f64> = columns.iter().map(|a| dot(a, target)).collect();
    let largest = goal.iter().fold(0.0f64, |m, g| m.max(g.abs()));
    let mut x = vec![0.0; count];
    let mut free: Vec<usize> = Vec::new();
    let mut barred = vec![false; count];
    // Each round frees one unknown; none returns often.
    for _ in 0..4 * count {
        let gradient = |i: usize| goal[i] - (0..count).map(|j| gram[i][j] * x[j]).sum::<f64>();
        let best = (0..count)
            .filter(|i| !barred[*i] && !free.contains(i))
            .max_by(|a, b| gradient(*a).total_cmp(&gradient(*b)));
        let Some(best) = best.filter(|i| gradient(*i) > ROUNDING * largest) else { break };
        free.push(best);
        if solve(&gram, &goal, &free).is_none() {
            // What the others say already.
            free.pop();
            barred[best] = true;
            continue;
        }
        while let Some(inside) = solve(&gram, &goal, &free) {
            if inside.iter().all(|value| *value > 0.0) {
                x.fill(0.0);
                free.iter().zip(&inside).for_each(|(i, value)| x[*i] = *value);
                break;
            }
            step_to_wall(&mut x, &mut free, &inside);
        }
    }
    x
}

/// Goes toward `inside` until the first unknown reaches 0, and holds that one there.
fn step_to_wall(x: &mut [f64], free: &mut Vec<usize>, inside: &[f64]) {
    let ratio = |(i, value): (&usize, &f64)| {
        if *value <= 0.0 { x[*i] / (x[*i] - value).max(f64::MIN_POSITIVE) } else { f64::INFINITY }
    };
    let ratios: Vec<f64> = free.iter().zip(inside).map(ratio).collect();
    let share = ratios.iter().copied().fold(1.0, f64::min);
    for (i, value) in free.iter().zip(inside) {
        x[*i] += share * (value - x[*i]);
    }
    let mut at = 0;
    free.retain(|i| {
        let kept = ratios[at] > share;
        at += 1;
        if !kept {
            x[*i] = 0.0;
        }
        kept
    });
}

/// Cholesky of the free part; `None` where its columns are not independent or nothing is free.
fn solve(gram: &[Vec<f64>], goal: &[f64], free: &[usize]) -> Option<Vec<f64>> {
    let n = free.len();
    if n == 0 {
        return None;
    }
    let mut lower = vec![vec![0.0; n]; n];
    for i in 0..n {
        for j in 0..=i {
            let sum = gram[free[i]][free[j]] - (0..j).map(|k| lower[i][k] * lower[j][k]).sum::<f64>();
            if i == j && sum <= ROUNDING * gram[free[i]][free[i]] {
                return None;
            }
            lower[i][j] = if i == j { sum.sqrt() } else { sum / lower[j][j] };
        }
    }
    let mut y = vec![0.0; n];
    for i in 0..n {
        y[i] = (goal[free[i]] - (0..i).map(|k| lower[i][k] * y[k]).sum::<f64>()) / lower[i][i];
    }
    for i in (0..n).rev() {
        y[i] = (y[i] - (i + 1..n).map(|k| lower[k][i] * y[k]).sum::<f64>()) / lower[i][i];
    }
    Some(y)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_exact_mixture_is_found_and_a_negative_one_is_not() {
        let columns: Vec<Vec<f64>> = [0.3, 1.0, 3.0]
            .iter()
            .map(|s| (0..20).map(|q| libm::exp(-s * f64::from(q * q) / 40.0)).collect())
            .collect();
        let mix = |w: [f64; 3]| (0..20).map(|q| (0..3).map(|j| w[j] * columns[j][q]).sum()).collect::<Vec<f64>>();
        let found = nnls(&columns, &mix([0.2, 0.0, 0.7]));
        assert!((found[0] - 0.2).abs() < 1e-9 && found[1].abs() < 1e-9 && (found[2] - 0.7).abs() < 1e-9, "{found:?}");
        let held = nnls(&columns, &mix([1.0, -0.4, 0.5]));
        assert!(held.iter().all(|w| *w >= 0.0) && held[1] < 1e-9, "{held:?}");
    }
}
