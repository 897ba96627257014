//! Samples of numbers: their summary, intervals of what is estimated from them, and random numbers to draw
//! them.

pub mod interval;
pub(crate) mod random;
pub mod summary;
