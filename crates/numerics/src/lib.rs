//! Compensated sums, error statistics, direction sets and low-discrepancy points. No glTF, no trees.

mod directions;
mod error_stats;
mod sum;

pub use directions::{fibonacci_sphere, r2_point, radical_inverse};
pub use error_stats::{ErrorStats, spearman};
pub use sum::CompensatedSum;
