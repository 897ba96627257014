//! The models for cables that carry a force, taut or sagging, in the lanes of the vector unit: a robot in
//! each lane, or a cable of one robot.

mod adjoint;
mod branch;
mod cable;
mod chain;
mod freedoms;
mod held;
mod level;
mod load;
mod newton;
mod observer;
mod platform;
mod poses;
mod reason;
mod skew;
mod tracker;

pub use observer::{Observation, ObservationMotion, ObservationSlopes, Observed, Observer};
pub use poses::{Loaded, LoadedPose, PoseSlopes, inverse, loaded_poses};
pub use reason::ScalarReason;
pub use tracker::Tracker;
