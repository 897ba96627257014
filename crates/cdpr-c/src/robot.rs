//! The handle of a robot.

use crate::failure::{CdprStatus, Failure};
use cdpr_robot::library::{ROBOTS, named, near};
use cdpr_robot::{Parameter, Pose, Robot};
use std::ffi::{CStr, CString};
use std::sync::Arc;

/// A robot: the handle of `cdpr_robot_named` and `cdpr_robot_from_json`. It does not change, and any number
/// of threads may use it. Trackers and paths remain valid when it is freed.
pub struct CdprRobot {
    pub(crate) robot: Arc<Robot>,
    /// Names of the inputs by which derivatives are taken.
    inputs: Vec<CString>,
}

impl CdprRobot {
    /// The robot of the library with this name.
    pub(crate) fn named(name: &CStr) -> Result<Self, Failure> {
        let name = name.to_string_lossy();
        let Some(file) = named(ROBOTS, &name) else {
            let similar = near(ROBOTS, &name).join(", ");
            let reason = format!(
                "the library has no robot `{name}`{}",
                if similar.is_empty() { String::new() } else { format!(": similar names are {similar}") }
            );
            return Err(Failure::Text { status: CdprStatus::Robot, reason });
        };
        Ok(Self::new(Robot::from_json(file.text)?))
    }

    /// The robot of a file `cdpr-robot/1`.
    pub(crate) fn from_json(text: &[u8]) -> Result<Self, Failure> {
        let text = std::str::from_utf8(text)
            .map_err(|error| Failure::Text { status: CdprStatus::Robot, reason: format!("text: {error}") })?;
        Ok(Self::new(Robot::from_json(text)?))
    }

    fn new(robot: Robot) -> Self {
        let names = Parameter::of(&robot).into_iter().map(|parameter| parameter.to_string());
        let further = ["payload"].into_iter().chain(Pose::COORDINATES).map(str::to_owned);
        let inputs = names.chain(further).map(|name| CString::new(name).unwrap_or_default()).collect();
        Self { robot: Arc::new(robot), inputs }
    }

    pub(crate) fn cables(&self) -> usize {
        self.robot.cables.len()
    }

    pub(crate) fn inputs(&self) -> &[CString] {
        &self.inputs
    }
}
