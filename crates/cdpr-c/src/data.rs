//! Plain structs that cross the border.

use crate::failure::{CdprStatus, Failure};
use cdpr_robot::{Pose, Vector3, Vector6, Wrench, rotation_of};
use cdpr_statics::{Load, Residual};

/// Pose of the platform in the base frame.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CdprPose {
    /// Position of the reference point P [m].
    pub position: [f64; 3],
    /// Rotation as a unit quaternion (w, x, y, z); (1, 0, 0, 0) where the platform is level.
    pub quaternion: [f64; 4],
}

/// Load on the platform in addition to its own weight.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CdprLoad {
    /// Mass added at the platform's centre of mass [kg].
    pub payload: f64,
    /// Force in the base frame [N].
    pub force: [f64; 3],
    /// Moment about P in the base frame [N m].
    pub moment: [f64; 3],
}

/// Motion of the platform in the base frame.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CdprMotion {
    /// Displacement of P [m].
    pub translation: [f64; 3],
    /// Rotation vector [rad].
    pub rotation: [f64; 3],
}

/// Where a call reads or writes a value of each cable.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct CdprCables {
    /// Number of values of each list: that of the cables.
    pub count: usize,
    /// Unstrained lengths [m].
    pub lengths: *mut f64,
    /// Tensions at the platform [N]. They are not written where this is null.
    pub tensions: *mut f64,
}

/// How exact a result is and how it was found.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CdprReport {
    /// Largest distance between the end of a cable and its anchor point [m].
    pub closure: f64,
    /// Unbalanced force on the platform [N].
    pub force: f64,
    /// Unbalanced moment about P [N m].
    pub moment: f64,
    /// Iterations that were made.
    pub iterations: u32,
    /// 1 where a path has left its branch, so that its lengths may jump, else 0.
    pub jump: u32,
}

/// Stiffness of the platform at a pose.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CdprStiffness {
    /// Matrix of (dp, dphi) [N/m, N/rad, N, N m/rad], row by row.
    pub matrix: [[f64; 6]; 6],
    /// Stiffness of the softest motion [N/m].
    pub least: f64,
    /// 1 where the equilibrium is stable, else 0.
    pub is_stable: u32,
}

/// Where derivatives are written, row by row with a column for each input, per SI unit of the input.
///
/// The inputs are the parameters of the robot, the payload and the six coordinates of the pose. A matrix
/// whose pointer is null is not written. Where the derivatives on both sides differ, because a tension is at
/// its limit, it is that for a decreasing input.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct CdprDerivatives {
    /// Number of columns: that of `cdpr_robot_inputs`.
    pub inputs: usize,
    /// Unstrained lengths, a row for each cable [m per unit].
    pub lengths: *mut f64,
    /// Tensions that set the lengths, a row for each cable [N per unit].
    pub tensions: *mut f64,
    /// Displacement under the load, three rows [m per unit].
    pub displacement: *mut f64,
    /// Norm of the displacement, one row [m per unit].
    pub magnitude: *mut f64,
}

/// A test of values, and what it expects.
pub(crate) type Range = (fn(f64) -> bool, &'static str);

const FINITE: Range = (f64::is_finite, "a finite number");
const LOADS: Range = (|value| value.abs() <= Load::LARGEST, "a number from -1e12 to 1e12");
pub(crate) const LENGTHS: Range =
    (|value| value.is_finite() && value > 0.0, "a finite, positive unstrained length [m]");

/// Refuses values out of a range, without allocation.
pub(crate) fn checked(field: &'static str, values: &[f64], range: Range) -> Result<(), Failure> {
    let (is_valid, expected) = range;
    match values.iter().position(|value| !is_valid(*value)) {
        None => Ok(()),
        Some(index) => Err(Failure::Value { field, index, expected }),
    }
}

/// Refuses another number of values.
pub(crate) fn sized(field: &'static str, given: usize, expected: usize) -> Result<(), Failure> {
    if given == expected { Ok(()) } else { Err(Failure::Size { field, given, expected }) }
}

impl CdprPose {
    pub(crate) fn checked(&self) -> Result<Pose, Failure> {
        checked("pose.position", &self.position, FINITE)?;
        checked("pose.quaternion", &self.quaternion, FINITE)?;
        let rotation = rotation_of(self.quaternion)
            .map_err(|error| Failure::Text { status: CdprStatus::Invalid, reason: error.to_string() })?;
        Ok(Pose { position: Vector3::from(self.position), rotation })
    }
}

impl From<&Pose> for CdprPose {
    fn from(pose: &Pose) -> Self {
        Self { position: pose.position.into(), quaternion: pose.quaternion() }
    }
}

impl CdprLoad {
    pub(crate) fn checked(&self) -> Result<Load, Failure> {
        checked("load.payload", &[self.payload], LOADS)?;
        checked("load.force", &self.force, LOADS)?;
        checked("load.moment", &self.moment, LOADS)?;
        let wrench = Wrench { force: self.force.into(), moment: self.moment.into() };
        Ok(Load { payload: self.payload, wrench })
    }
}

impl From<Vector6<f64>> for CdprMotion {
    fn from(motion: Vector6<f64>) -> Self {
        let [x, y, z, rx, ry, rz] = motion.into();
        Self { translation: [x, y, z], rotation: [rx, ry, rz] }
    }
}

impl CdprReport {
    pub(crate) fn new(residual: Residual, iterations: usize) -> Self {
        let Residual { closure, force, moment } = residual;
        let iterations = u32::try_from(iterations).unwrap_or(u32::MAX);
        Self { closure, force, moment, iterations, jump: 0 }
    }
}
