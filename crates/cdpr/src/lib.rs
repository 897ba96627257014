//! Elasto-statics and motion of cable-driven parallel robots with sagging, elastic cables: all libraries of
//! the project under one name.
//!
//! | module | what it is for |
//! |---|---|
//! | [`cable`] | one sagging, elastic cable: Irvine's catenary, its stiffness, its laws |
//! | [`robot`] | a robot: its file, geometry, cables, platform and uncertain parameters |
//! | [`tension`] | tension distribution: feasible tensions, greatest payload, margins |
//! | [`statics`] | inverse and direct model, deflection, stiffness, exact derivatives |
//! | [`dynamics`] | natural frequencies, frequency response, motion, moves that do not swing |
//! | [`sensitivity`] | Sobol points, laws, effects, indices |
//! | [`study`], [`assess`] | studies of uncertain parameters; tables, tolerances |
//! | [`calibration`] | poses to measure, identifiability, calibration, cable moduli |
//! | [`observer`] | payload, centre of mass and modulus from measured tensions, sample by sample |
//! | [`exchange`] | robots of CASPR, WireX and others; MoorDyn |
//!
//! The program `cdpr` is the module [`program`], behind the feature of this name. Leave it out for the
//! libraries alone: `cdpr = { version = "0.1", default-features = false }`.
//!
//! ```
//! use cdpr::robot::Robot;
//!
//! let robot = Robot::from_library("caroca")?;
//! assert_eq!(robot.cables.len(), 8);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

pub use cdpr_assess as assess;
pub use cdpr_cable as cable;
pub use cdpr_calibration as calibration;
pub use cdpr_dynamics as dynamics;
pub use cdpr_exchange as exchange;
pub use cdpr_observer as observer;
pub use cdpr_robot as robot;
pub use cdpr_sensitivity as sensitivity;
pub use cdpr_statics as statics;
pub use cdpr_study as study;
pub use cdpr_tension as tension;

#[cfg(feature = "program")]
pub mod program;
