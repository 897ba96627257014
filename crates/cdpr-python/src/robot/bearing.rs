//! What the cables bear: loads, each other's break, and weather.

pub(crate) mod capacity;
pub(crate) mod safety;
pub(crate) mod weather;
