//! One unknown of a cable from the others: the force at its end, or its unstrained length.

mod end_force;
mod held;
mod in_wind;
mod known;
mod length_for_tension;
mod spatial;

pub use end_force::{Solution, end_force, end_force_near};
pub use held::HeldCable;
pub use in_wind::{CableInWind, HeldInWind, InWindSlopes, WindOverHeight};
pub use known::Known;
pub use length_for_tension::length_for_tension;
pub use spatial::spatial_end_force;
