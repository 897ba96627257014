//! `cdpr.pose`: poses from positions and rotations as people have them.

use crate::convert::{Answer, Cases, Numbers, Raised, Rows, filled};
use cdpr_robot::{Pose, Rotation3, rotation_by_angles, rotation_in_order, rotation_of};
use numpy::{IxDyn, PyArray1, PyArrayMethods};
use pyo3::prelude::*;

/// Makes poses of positions and rotations, as all calls take them.
///
/// Arguments are of one pose, or have a first axis of m poses. The rotation turns the platform frame into the
/// base frame; the platform is level if it is left out.
///
/// Parameters
/// ----------
/// position : array_like
///     x, y, z [m], (3,) or (m, 3).
/// rotation : array_like or Rotation, optional
///     A quaternion qw, qx, qy, qz, (4,) or (m, 4), with the scalar first; or a
///     `scipy.spatial.transform.Rotation`, whose own order does not matter then.
/// rpy_deg : array_like, optional
///     roll, pitch, yaw [degrees], (3,) or (m, 3), instead of a rotation: R = Rz(yaw) Ry(pitch)
///     Rx(roll).
///
/// Returns
/// -------
/// ndarray
///     Poses x, y, z [m], qw, qx, qy, qz, (7,) or (m, 7).
///
/// Raises
/// ------
/// InputError
///     For an invalid value; the message names it and what would be right; also for a quaternion whose
///     scalar seems to be the last component, as SciPy has it.
///
/// Examples
/// --------
/// >>> import cdpr
/// >>> cdpr.pose([0, 0, 2], rpy_deg=[0, 0, 60]).round(3).tolist()
/// [0.0, 0.0, 2.0, 0.866, 0.0, 0.0, 0.5]
#[pyfunction]
#[pyo3(signature = (position, rotation = None, *, rpy_deg = None))]
pub(crate) fn pose(
    py: Python,
    position: Numbers,
    rotation: Option<Numbers>,
    rpy_deg: Option<Numbers>,
) -> Answer<Py<PyAny>> {
    let positions = Rows::components::<3>("position", Some(&position))?.finite()?;
    let rotations = match (&rotation, &rpy_deg) {
        (Some(_), Some(_)) => {
            let message = "rotation and rpy_deg are both given: expected one of them";
            return Err(Raised::Input(message.to_owned()));
        }
        (None, angles) => Rotations::Angles(Rows::components::<3>("rpy_deg", angles.as_ref())?.finite()?),
        (Some(rotation), None) if rotation.hasattr("as_quat")? => Rotations::ScalarLast(
            Rows::components::<4>("rotation", Some(&rotation.call_method0("as_quat")?))?,
        ),
        (Some(rotation), None) => Rotations::ScalarFirst(Rows::components::<4>("rotation", Some(rotation))?),
    };
    let cases = Cases::of(&[&positions, rotations.rows()])?;
    let mut shape = if cases.single { Vec::new() } else { vec![cases.count] };
    shape.push(7);
    let mut values = filled(&shape, 0.0)?;
    for (case, row) in values.chunks_exact_mut(7).enumerate() {
        let pose = Pose { position: positions.vector::<3>(case).into(), rotation: rotations.of(case)? };
        row[..3].copy_from_slice(pose.position.as_slice());
        row[3..].copy_from_slice(&pose.quaternion());
    }
    Ok(PyArray1::from_vec(py, values).reshape(IxDyn(&shape))?.into_any().unbind())
}

/// Rotations in the form in which they were given.
enum Rotations {
    Angles(Rows),
    ScalarFirst(Rows),
    ScalarLast(Rows),
}

impl Rotations {
    fn rows(&self) -> &Rows {
        let (Self::Angles(rows) | Self::ScalarFirst(rows) | Self::ScalarLast(rows)) = self;
        rows
    }

    fn of(&self, case: usize) -> Answer<Rotation3<f64>> {
        match self {
            Self::Angles(rows) => Ok(rotation_by_angles(rows.vector::<3>(case))),
            Self::ScalarFirst(rows) => rotation_in_order(rows.vector::<4>(case)).map_err(|error| {
                let hint = "; a Rotation of SciPy is taken as it is, and angles as rpy_deg";
                Raised::Input(format!("rotation: {error}{hint}"))
            }),
            Self::ScalarLast(rows) => {
                let [x, y, z, w] = rows.vector::<4>(case);
                rotation_of([w, x, y, z]).map_err(|error| Raised::Input(format!("rotation: {error}")))
            }
        }
    }
}
