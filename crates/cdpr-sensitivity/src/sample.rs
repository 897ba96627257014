//! What a sample of numbers tells, and random numbers to draw one with.

pub mod interval;
pub(crate) mod random;
pub mod summary;
