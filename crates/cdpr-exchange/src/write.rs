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
use cdpr_statics::{Load, inverse};

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

impl Target {
    /// All formats with their names.
    pub const NAMED: [(Self, &'static str); 7] = [
        (Self::Mjcf, "mjcf"),
        (Self::Caspr, "caspr"),
        (Self::Moorpy, "moorpy"),
        (Self::Moordyn, "moordyn"),
        (Self::Klipper, "klipper"),
        (Self::Rrf, "rrf"),
        (Self::Maslow, "maslow"),
    ];
}

/// The robot in the format of another program, at rest at a pose.
///
/// Lengths and stiffnesses are those with which the other program's model rests at the pose: straight cables
/// without weight in MuJoCo, elastic catenaries in MoorPy and MoorDyn. CASPR has the geometry and EA alone.
/// Firmware has the points of straight lines [mm]; [`crate::correction_table`] has its lengths.
///
/// # Errors
/// [`ExchangeError::NoPlace`] for pulleys, leads and laws in formats that have none, and for a plane or a
/// point mass in formats of bodies; [`ExchangeError::Pose`] for a pose that is not held.
pub fn export(robot: &Robot, pose: &Pose, target: Target) -> Result<Exported, ExchangeError> {
    write(robot, pose, target).map_err(|error| match error {
        ExchangeError::NoPlace { field, value, expected, .. } => {
            ExchangeError::NoPlace { field, value, expected, takers: takers(robot, pose) }
        }
        error => error,
    })
}

/// Names of the formats that take a robot at a pose, the table of [`crate::correction_table`] with them.
/// Those that would leave out its leads do not.
pub fn takers(robot: &Robot, pose: &Pose) -> Vec<&'static str> {
    let has_lead = robot.cables.iter().any(|cable| cable.lead > 0.0);
    let takes = |target: Target| (target != Target::Caspr || !has_lead) && write(robot, pose, target).is_ok();
    let named = Target::NAMED.into_iter().filter(|(target, _)| takes(*target)).map(|(_, name)| name);
    let table = inverse(robot, pose, &Load::none()).is_ok().then_some("table");
    named.chain(table).collect()
}

fn write(robot: &Robot, pose: &Pose, target: Target) -> Result<Exported, ExchangeError> {
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
