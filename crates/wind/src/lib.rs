//! Wind: weights, phases and frames that let a shader sway a tree, the noise that moves it, and the motion itself
//! on the processor (Kusternig07 section 5).

mod bark;
pub mod fast;
mod frames;
mod joint;
mod leaves;
pub mod motion;
pub mod noise;
mod output;
mod params;
mod player;
pub mod quality;
pub mod reference;
mod requirement;
mod room;
mod sway;
#[cfg(test)]
mod tests;
mod wood;

pub use frames::{frame, phases};
pub use motion::{Gust, LeafGust};
pub use noise::Noise;
pub use params::Params;
pub use player::{Player, TILES_PER_SECOND};
pub use requirement::amplitude;
pub use room::Wind;
pub use sway::{Exit, Rule, Sway, Weights, power};
