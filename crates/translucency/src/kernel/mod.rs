//! How far light spreads inside a leaf, and the bank of Gaussians that stands for it.

mod bank;
mod mtf;
mod nnls;
mod taps;

pub use bank::Bank;
pub use mtf::{Spread, mean_medium};
pub use taps::Taps;
