//! The deflection at a pose.

use crate::answers::failure::Failure;
use crate::answers::state::State;
use crate::question::Hold;
use cdpr_robot::Robot;
use cdpr_statics::limits::limits_at;
use cdpr_statics::{Deflection, Load, WantedPose, deflection};
use serde::Serialize;

/// The platform without and with the load.
#[derive(Serialize)]
pub(crate) struct Held {
    /// Unstrained lengths [m].
    lengths: Vec<f64>,
    /// Least and greatest tension at the platform [N], at this pose.
    limits: Vec<[f64; 2]>,
    /// dp, Eq. (4) [m].
    displacement: [f64; 3],
    /// |dp| [m].
    rms: f64,
    /// Error of dp by rounding [m].
    rounding: f64,
    /// Rotation vector from the unloaded to the loaded platform [rad].
    rotation: [f64; 3],
    unloaded: State,
    loaded: State,
}

pub(crate) fn hold(robot: &Robot, given: &Hold) -> Result<Held, Failure> {
    let (pose, load) = (given.pose.pose()?, given.load.load());
    let found = deflection(robot, WantedPose::at(&pose).free(&given.free), &load)?;
    let motion = found.unloaded.equilibrium.pose.motion_to(&found.loaded.equilibrium.pose);
    let limits = limits_at(robot, &found.unloaded.equilibrium.pose)?;
    let Deflection { lengths, unloaded, loaded } = &found;
    Ok(Held {
        limits: limits.iter().map(|limits| [limits.min, limits.max]).collect(),
        displacement: found.displacement().into(),
        rms: found.magnitude(),
        rounding: found.rounding(robot),
        rotation: [motion[3], motion[4], motion[5]],
        unloaded: State::new(robot, lengths, &Load::none(), unloaded)?,
        loaded: State::new(robot, lengths, &load, loaded)?,
        lengths: lengths.clone(),
    })
}
