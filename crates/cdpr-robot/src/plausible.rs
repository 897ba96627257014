//! Whether a number that somebody typed may be what was meant: the one place that knows which orders of
//! magnitude robots, loads, deviations and measurements have.
//!
//! Two answers are possible. What no robot can have is refused ([`Robot::check_units`]). What is only
//! improbable is a [`Doubt`]: the number is taken as it is, and a question is put to whoever typed it.
//!
//! [`Robot::check_units`]: crate::Robot::check_units

mod cable;
mod doubt;
mod file;
mod inertia;
mod layout;
mod typed;
mod uncertain;
mod units;

pub use cable::{linear_density, span};
pub use doubt::{Doubt, Doubts, frame, more_than_half_failed, nothing_held};
pub use file::{reference, robot};
pub use inertia::Gyration;
pub use layout::FRAME;
pub use typed::{
    angles, in_ground, lengths, lengths_at, load, mass, modulus, on_platform, out_of_plane, position,
    quaternion, times, wrench,
};
pub use uncertain::{deviation, farthest, noise};
