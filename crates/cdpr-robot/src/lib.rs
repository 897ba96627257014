//! A cable-driven parallel robot as data.
//!
//! The robot has exit points, anchor points, a platform, cables and limits of tension. With a pose come its
//! spans, the wrench on it and its wrench matrix. Its uncertain parameters form one vector.
//!
//! Frames: gravity acts along `-z` of the base frame `F_b`, unless it is a vector; the platform frame `F_p`
//! sits at the platform's reference point P. Units are SI throughout. Signs and symbols: `docs/NOTATION.md`
//! of the repository.
//!
//! ```
//! use cdpr_robot::{Parameter, Pose, Robot, deviations};
//!
//! let robot = Robot::from_library("caroca")?;
//! assert_eq!(robot.cables.len(), 8);
//! let span = robot.span(&Pose::at(0.0, 0.0, 1.75), 0); // from B_1 to A_1, Eq. (1) of the paper
//! assert!((span.norm() - 4.4444).abs() < 1e-4);
//! assert_eq!(Parameter::of(&robot).len(), 62);
//! let heavier = deviations(&robot, &[("mass", 18.0), ("b1.z", 0.03)])?;
//! assert_eq!(robot.perturbed(&heavier)?.robot.platform.mass, 198.0);
//! # Ok::<(), cdpr_robot::RobotError>(())
//! ```
//!
//! The crate does no input or output: it reads and writes text in memory.

mod axis;
mod error;
mod format;
mod freedoms;
mod gravity;
mod json;
mod law;
mod limits;
mod number;
mod parameter;
pub mod plausible;
mod pose;
mod robot;
mod shown;
mod wrench;

pub use axis::Axis;
pub use cdpr_cable::{PiecewiseLaw, Segment};
pub use cdpr_cable::{counted, short, shortened};
pub use error::RobotError;
pub use format::cable_file::{CABLE_FORMAT, CatalogueCable, cable_schema};
pub use format::library;
pub use format::{FORMAT, json_schema};
pub use freedoms::{Coordinate, Freedoms, Plane};
pub use gravity::Gravity;
pub use json::{JsonError, from_json, numbered, place_of};
pub use law::LawSegment;
pub use limits::{CableEnd, NamedReference, OwnLimits, TensionDistribution, TensionLimits, TensionReference};
pub use nalgebra::{Matrix3, Matrix6xX, Rotation3, UnitQuaternion, Vector2, Vector3, Vector6};
pub use number::{decimal, decimals_of, rounded, significant, visible};
pub use parameter::deviations::Deviations;
pub use parameter::layout::ParameterLayout;
pub use parameter::perturbed::{Perturbed, deviations};
pub use parameter::{Parameter, TiltAxis};
pub use plausible::{Doubt, Doubts, frame};
pub use pose::quaternion::{QuaternionError, rotation_by_angles, rotation_in_order, rotation_of};
pub use pose::{Pose, orthonormalized};
pub use robot::provenance::{Grade, Provenance};
pub use robot::{CableProperties, Platform, Pulley, Robot, RobotCable};
pub use shown::{COLUMNS, broken, listing, shown, shown_lines, wrapped};
pub use wrench::Wrench;
