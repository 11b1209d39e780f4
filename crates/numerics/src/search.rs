//! Looking through long lists on all cores.

use rayon::prelude::*;

/// Values that one task looks at: the tasks of rayon's own search ask at every value whether another has found one.
const CHUNK: usize = 1 << 14;

/// Index of the first value that `is` holds for.
pub fn find_first<T: Sync>(values: &[T], is: impl Fn(&T) -> bool + Sync) -> Option<usize> {
    let chunks = values.par_chunks(CHUNK).enumerate();
    chunks.find_map_first(|(chunk, values)| values.iter().position(&is).map(|at| chunk * CHUNK + at))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_first_is_found_wherever_it_lies() {
        let values: Vec<usize> = (0..3 * CHUNK + 5).collect();
        for at in [0, 1, CHUNK - 1, CHUNK, 2 * CHUNK + 7, values.len() - 1] {
            assert_eq!(find_first(&values, |v| *v >= at), Some(at));
        }
        assert_eq!(find_first(&values, |_| false), None);
    }
}
