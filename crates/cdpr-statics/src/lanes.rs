//! Robots and cables with taut cables in the lanes of the vector unit.

mod algebra;
mod cable;
mod chain;
mod newton;
mod observer;
mod simd;
mod tracker;

pub use observer::{Observation, Observer};
pub use tracker::Tracker;
