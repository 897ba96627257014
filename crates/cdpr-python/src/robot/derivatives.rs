//! `Robot.derivatives`: the derivatives of lengths and deflection with respect to each parameter.

use crate::convert::{Answer, Columns, Loads, Numbers, Rows, answer, each};
use crate::robot::Robot;
use crate::robot::deflection::{Deflection, Given};
use cdpr_robot::{Parameter, Pose};
use cdpr_statics::{StaticsError, derivatives};
use pyo3::prelude::*;

answer! {
    /// A deflection with its exact derivatives, per SI unit of the k inputs.
    ///
    /// The answer is of one case, or of m: then every field has a first axis of m, with NaN where there is no
    /// answer, and `reasons` says why.
    #[pyclass(frozen, get_all, module = "cdpr")]
    pub(crate) struct Derivatives {
        /// Names of the k inputs: the parameters of the robot, `payload`, and the wanted pose.
        ///
        /// The inputs of the pose are `x`, `y`, `z` [m] and `rx`, `ry`, `rz` [rad].
        inputs: Vec<String>,
        /// Derivatives of |dp| [m per unit], (k,).
        rms: Py<PyAny>,
        /// Derivatives of dp [m per unit], (3, k).
        displacement: Py<PyAny>,
        /// Derivatives of the unstrained lengths [m per unit], (n, k).
        lengths: Py<PyAny>,
        /// Derivatives of the tension set-points [N per unit], (n, k).
        set_points: Py<PyAny>,
        /// Derivatives of the tensions with the load [N per unit], (n, k).
        tensions: Py<PyAny>,
        /// The deflection itself.
        deflection: Py<Deflection>,
        /// Why there is no answer, None where there is one; None for one case.
        reasons: Py<PyAny>,
        /// The kind of each failure, in the same form: `infeasible_tension`, ...
        kinds: Py<PyAny>,
    }
}

/// The matrices of derivatives, row by row.
struct Slopes {
    rms: Vec<f64>,
    displacement: Vec<f64>,
    lengths: Vec<f64>,
    set_points: Vec<f64>,
    tensions: Vec<f64>,
    given: Given,
}

#[pymethods]
impl Robot {
    /// Computes the exact derivatives of lengths, tensions and deflection under a load.
    ///
    /// Arguments are of one case, or have a first axis of m cases.
    ///
    /// pose: wanted pose under the platform's own weight, (3,) or (7,).
    /// payload: mass added at the platform's centre of mass [kg].
    /// force, moment: on the platform in the base frame, about P [N, N m], (3,).
    ///
    /// Raises InputError; for one case NoSolutionError, also where a derivative does not exist.
    #[pyo3(signature = (pose, *, payload=None, force=None, moment=None))]
    fn derivatives(
        &self,
        py: Python,
        pose: Numbers,
        payload: Option<Numbers>,
        force: Option<Numbers>,
        moment: Option<Numbers>,
    ) -> Answer<Derivatives> {
        let poses = Rows::poses("pose", &pose)?;
        let loads = Loads::new(force.as_ref(), moment.as_ref(), payload.as_ref())?;
        let cases = loads.cases([&poses])?;
        let robot = &self.robot;
        let cables = robot.cables.len();
        let no_offsets = vec![0.0; cables];
        let outcomes: Vec<Result<Slopes, StaticsError>> = each(py, cases.count, |case| {
            let found = derivatives(robot, &poses.pose(case)?, &no_offsets, &loads.load(case)?)?;
            // nalgebra stores matrices column by column.
            Ok(Slopes {
                rms: found.rms()?,
                displacement: found.displacement().transpose().as_slice().to_vec(),
                lengths: found.lengths.transpose().as_slice().to_vec(),
                set_points: found.set_points.transpose().as_slice().to_vec(),
                tensions: found.loaded.tensions.transpose().as_slice().to_vec(),
                given: found.deflection.into(),
            })
        })?;
        let all = Columns::new(py, cases, &outcomes)?;
        let parameters = Parameter::all(cables);
        let others = ["payload"].into_iter().chain(Pose::COORDINATES).map(str::to_owned);
        let inputs: Vec<String> = parameters.iter().map(ToString::to_string).chain(others).collect();
        let count = inputs.len();
        let matrix = |rows: usize, matrix: fn(&Slopes) -> &[f64]| {
            all.numbers(&[rows, count], |slopes: &Slopes, out| out.copy_from_slice(matrix(slopes)))
        };
        let deflection = Deflection::new(py, &all.part(|slopes| &slopes.given), cables)?;
        Ok(Derivatives {
            rms: all.numbers(&[count], |slopes, out| out.copy_from_slice(&slopes.rms))?,
            displacement: matrix(3, |slopes| &slopes.displacement)?,
            lengths: matrix(cables, |slopes| &slopes.lengths)?,
            set_points: matrix(cables, |slopes| &slopes.set_points)?,
            tensions: matrix(cables, |slopes| &slopes.tensions)?,
            deflection: Py::new(py, deflection)?,
            reasons: all.reasons(),
            kinds: all.kinds(),
            inputs,
        })
    }
}
