//! The models for cables that carry a force, taut or sagging, in the lanes of the vector unit: a robot in
//! each lane, or a cable of one robot.

mod adjoint;
mod chain;
mod fixed_ends;
mod level;
mod observer;
mod poses;
mod reason;
mod tracker;

pub use observer::{Observation, ObservationMotion, ObservationSlopes, Observed, Observer};
pub use poses::{Loaded, LoadedPose, PoseSlopes, inverse, loaded_poses};
pub use reason::ScalarReason;
pub use tracker::{Tracker, TrackerStep};
