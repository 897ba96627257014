//! The models for cables that carry a force, taut or sagging, in the lanes of the vector unit: a robot in
//! each lane, or a cable of one robot.

mod adjoint;
mod algebra;
mod cable;
mod chain;
mod eigen;
mod free;
mod held;
mod level;
mod limits;
mod loaded;
mod minimum;
mod newton;
mod observer;
mod placed;
mod poses;
mod program;
mod reason;
mod shared;
mod simd;
mod tracker;

pub use loaded::{LoadedPose, loaded_poses};
pub use observer::{Observation, ObservationMotion, ObservationSlopes, Observer};
pub use poses::inverse_all;
pub use reason::ScalarReason;
pub use tracker::Tracker;
