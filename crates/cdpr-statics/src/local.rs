//! Newton's method in the lanes of the vector unit: a robot in each lane, or the cables of one robot.

pub(crate) mod branch;
pub(crate) mod cable;
pub(crate) mod free;
pub(crate) mod freedoms;
pub(crate) mod guided;
pub(crate) mod load;
pub(crate) mod newton;
pub(crate) mod one_robot;
pub(crate) mod platform;
pub(crate) mod skew;
pub(crate) mod swivel;
