//! The inertia of a platform as a robot file has it: the whole tensor, or of a planar robot one moment.

use crate::error::RobotError;
use crate::freedoms::Plane;
use nalgebra::{Matrix3, Vector3};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// Three rows of three, or the moment about the axis at right angles to the plane of a planar robot.
#[derive(Clone, Copy, Serialize, Deserialize, JsonSchema)]
#[serde(
    untagged,
    expecting = "expected three rows of three numbers [kg m²], a diagonal matrix is [[a, 0, 0], [0, b, 0], \
                 [0, 0, c]], or of a planar robot the moment about the axis at right angles to its plane"
)]
#[schemars(inline)]
pub(super) enum InertiaEntry {
    Moment(f64),
    Tensor([[f64; 3]; 3]),
}

impl InertiaEntry {
    /// The whole tensor. That of a plate has the moment of a planar robot: no motion in the plane depends on
    /// the others.
    pub(super) fn tensor(self, plane: Option<Plane>) -> Result<Matrix3<f64>, RobotError> {
        let refused = |value: f64, expected: &str| {
            RobotError::invalid("platform.inertia", format!("{value}"), expected.to_owned())
        };
        match (self, plane) {
            (Self::Moment(moment), Some(_)) if !(moment.is_finite() && moment > 0.0) => {
                Err(refused(moment, "a finite, positive moment of inertia about the centre of mass [kg m²]"))
            }
            (Self::Moment(moment), Some(plane)) => Ok(plate(plane, moment)),
            (Self::Moment(moment), None) => Err(refused(
                moment,
                "three rows of three numbers [kg m²]; one moment is enough for a planar robot alone, \
                 which has the field `plane`",
            )),
            (Self::Tensor(rows), plane) => {
                let tensor = Matrix3::from(rows).transpose();
                Ok(plane.and_then(|plane| of_normal(plane, &tensor)).unwrap_or(tensor))
            }
        }
    }
}

/// The tensor of a plate, where a tensor has the moment about the normal of the plane alone.
fn of_normal(plane: Plane, tensor: &Matrix3<f64>) -> Option<Matrix3<f64>> {
    let k = plane.normal();
    let moment = tensor[(k, k)];
    let is_alone = tensor.iter().filter(|entry| **entry != 0.0).count() == 1;
    (moment > 0.0 && is_alone).then(|| plate(plane, moment))
}

/// The inertia of a plate in the plane whose moment about the normal is this one.
fn plate(plane: Plane, moment: f64) -> Matrix3<f64> {
    let of = |axis: usize| if axis == plane.normal() { moment } else { 0.5 * moment };
    Matrix3::from_diagonal(&Vector3::from([0, 1, 2].map(of)))
}
