//! Compensated sums, error statistics, quadrature, direction sets, low-discrepancy points, vector instructions. No glTF, no trees.

mod directions;
mod error_stats;
mod exponential;
mod isa;
mod morton;
mod quadrature;
mod search;
mod srgb;
mod sum;

pub use directions::{fibonacci_sphere, r2_point, radical_inverse};
pub use error_stats::{ErrorStats, spearman};
pub use exponential::exp_of_negatives;
pub use isa::Isa;
pub use morton::{MORTON_BITS, morton3, morton3_inverse};
pub use quadrature::{gauss_legendre, legendre};
pub use search::find_first;
pub use srgb::{linear_of_srgb, srgb_of_linear};
pub use sum::CompensatedSum;
