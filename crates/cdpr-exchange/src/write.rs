//! Robots for other programs.

mod anchors;
mod caspr;
mod klipper;
mod maslow;
mod mjcf;
mod moorpy;
mod rrf;
pub(crate) mod scene;
pub(crate) mod table;

use crate::error::ExchangeError;
use crate::write::moorpy::Reader;
use crate::write::scene::Exported;
use cdpr_robot::{Pose, Robot};

/// Formats that are written.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Target {
    /// MuJoCo: sites, and a spring a cable, straight and without weight.
    Mjcf,
    /// CASPR: bodies and cables, pulleys included.
    Caspr,
    /// MoorPy: elastic catenaries.
    Moorpy,
    /// MoorDyn: lines of straight segments with mass, for motions over time.
    Moordyn,
    /// Klipper's kinematics `winch`: points of straight lines, a section of its configuration a cable.
    Klipper,
    /// RepRapFirmware's Hangprinter: points and flex of straight lines as `M669` and `M666`.
    Rrf,
    /// Maslow's `MaslowKinematics` of FluidNC: corners of a planar robot with four cables (YAML).
    Maslow,
}

/// The robot in the format of another program, at rest at a pose.
///
/// Lengths and stiffnesses are those with which the other program's model rests at the pose: straight cables
/// without weight in MuJoCo, elastic catenaries in MoorPy and MoorDyn. CASPR has the geometry and EA alone.
/// Firmware has the points of straight lines [mm]; [`crate::correction_table`] has its lengths.
///
/// # Errors
/// [`ExchangeError::NoPlace`] for pulleys, leads and laws in formats that have none,
/// [`ExchangeError::HeldMotions`] for a plane or a point mass in formats of bodies;
/// [`ExchangeError::Pose`] for a pose that is not held.
pub fn export(robot: &Robot, pose: &Pose, target: Target) -> Result<Exported, ExchangeError> {
    match target {
        Target::Mjcf => mjcf::write(robot, pose),
        Target::Caspr => caspr::write(robot, pose),
        Target::Moorpy => moorpy::write(robot, pose, Reader::Moorpy),
        Target::Moordyn => moorpy::write(robot, pose, Reader::Moordyn),
        Target::Klipper => klipper::write(robot, pose),
        Target::Rrf => rrf::write(robot, pose),
        Target::Maslow => maslow::write(robot, pose),
    }
}
