//! What the cables bear: loads, and each other's break.

pub(crate) mod capacity;
pub(crate) mod safety;
