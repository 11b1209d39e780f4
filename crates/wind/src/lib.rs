//! Wind: the noise that moves a tree (Kusternig07 section 5).

pub mod noise;

pub use noise::Noise;
