//! Motions of the robot about a rest and over time.

pub(crate) mod modes;
pub(crate) mod moves;
pub(crate) mod response;
pub(crate) mod simulate;
