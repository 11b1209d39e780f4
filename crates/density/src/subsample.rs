//! A random share of the metaballs (Luft07's way to speed): what it saves is time, what it costs is error.

use crate::Generator;

/// Keeps `share` of the balls, at least one, and scales their weights so that the sum stays. Which stay depends
/// on their number and their order alone: the same on every run and machine.
pub(crate) fn subsample(balls: &mut Vec<Generator>, share: f64) {
    let keep = ((balls.len() as f64 * share).round() as usize).max(1);
    if keep >= balls.len() {
        return;
    }
    let mut drawn: Vec<(u64, usize)> = (0..balls.len()).map(|index| (scrambled(index as u64), index)).collect();
    drawn.select_nth_unstable(keep);
    drawn.truncate(keep);
    drawn.sort_unstable_by_key(|&(_, index)| index);
    let sum = |balls: &[Generator]| balls.iter().map(|ball| f64::from(ball.weight)).sum::<f64>();
    let before = sum(balls);
    *balls = drawn.iter().map(|&(_, index)| balls[index]).collect();
    let after = sum(balls);
    let scale = if after > 0.0 { before / after } else { 1.0 };
    balls.iter_mut().for_each(|ball| ball.weight = (f64::from(ball.weight) * scale) as f32);
}

/// A number without any order, different for each `index` (Steele, Lea and Flood 2014: splitmix64).
fn scrambled(index: u64) -> u64 {
    let mut z = index.wrapping_add(1).wrapping_mul(0x9E37_79B9_7F4A_7C15);
    z = (z ^ z >> 30).wrapping_mul(0xBF58_476D_1CE4_E5B9);
    z = (z ^ z >> 27).wrapping_mul(0x94D0_49BB_1331_11EB);
    z ^ z >> 31
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::DVec3;

    fn balls(count: usize) -> Vec<Generator> {
        let ball = |i| Generator { position: DVec3::X * i as f64, weight: 0.5 + (i % 3) as f32, group: i as u32 };
        (0..count).map(ball).collect()
    }

    #[test]
    fn a_share_keeps_so_many_and_their_sum() {
        for (count, share, kept) in [(1000, 0.5, 500), (1000, 0.1, 100), (3, 0.01, 1), (7, 1.0, 7)] {
            let all = balls(count);
            let mut some = all.clone();
            subsample(&mut some, share);
            assert_eq!(some.len(), kept);
            let sum = |list: &[Generator]| list.iter().map(|b| f64::from(b.weight)).sum::<f64>();
            // Each weight is rounded to f32.
            assert!((sum(&some) / sum(&all) - 1.0).abs() < 1e-6);
            assert!(some.windows(2).all(|w| w[0].group < w[1].group), "order stays");
            let mut again = all.clone();
            subsample(&mut again, share);
            assert_eq!(some, again);
        }
        subsample(&mut Vec::new(), 0.5);
    }

    #[test]
    fn no_stretch_of_the_list_is_preferred() {
        let mut some = balls(10_000);
        subsample(&mut some, 0.2);
        for tenth in 0..10 {
            let count = some.iter().filter(|b| b.group as usize / 1000 == tenth).count() as f64;
            // Hypergeometric: 200 with a deviation of 12; five of them.
            assert!((count - 200.0).abs() < 60.0, "{count} of the tenth number {tenth}");
        }
    }
}
