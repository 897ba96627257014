//! `Robot.inverse`: the unstrained lengths that hold a pose.

use crate::convert::{Answer, Columns, Loads, Numbers, Rows, answer, each};
use crate::robot::Robot;
use cdpr_statics::{Bound, StaticsError, inverse};
use pyo3::prelude::*;

answer! {
    /// Unstrained lengths that hold poses.
    ///
    /// The answer is of one pose, or of m: then every field has a first axis of m, with NaN where there is no
    /// answer, and `reasons` says why.
    #[pyclass(frozen, get_all, module = "cdpr")]
    pub(crate) struct InverseSolution {
        /// Unstrained length of each cable [m], (n,).
        lengths: Py<PyAny>,
        /// Tension of each cable at the platform [N], (n,).
        tensions: Py<PyAny>,
        /// Force (fx, fz) on each cable at its anchor point, in its vertical plane [N], (n, 2).
        cable_forces: Py<PyAny>,
        /// The bound that each tension rests on: -1 the least, 1 the greatest, 0 none, (n,).
        active: Py<PyAny>,
        /// Residuals of the 6 + 2n equations: closure of the cables [m], force [N], moment [N m], (3,).
        residual: Py<PyAny>,
        /// Iterations of distribution and Newton's method; 0 where there is no answer.
        iterations: Py<PyAny>,
        /// Why there is no answer, None where there is one; None for one pose.
        reasons: Py<PyAny>,
        /// The kind of each failure, in the same form: `infeasible_tension`, ...
        kinds: Py<PyAny>,
    }
}

#[pymethods]
impl Robot {
    /// Computes the unstrained lengths that hold the platform at a pose under its weight and a load.
    ///
    /// The tensions are those of least norm within the robot's limits. Arguments are of one case, or have a
    /// first axis of m cases.
    ///
    /// pose: x, y, z [m], or x, y, z, qw, qx, qy, qz, (3,) or (7,).
    /// force, moment: on the platform in the base frame, about P [N, N m], (3,).
    /// payload: mass added at the platform's centre of mass [kg].
    /// reference: tensions that the tensions are nearest to, in place of zero [N], (n,).
    ///
    /// Raises InputError; for one case NoSolutionError.
    #[pyo3(signature = (pose, *, force=None, moment=None, payload=None, reference=None))]
    fn inverse(
        &self,
        py: Python,
        pose: Numbers,
        force: Option<Numbers>,
        moment: Option<Numbers>,
        payload: Option<Numbers>,
        reference: Option<Numbers>,
    ) -> Answer<InverseSolution> {
        let cables = self.robot.cables.len();
        let poses = Rows::poses("pose", &pose)?;
        let loads = Loads::new(force.as_ref(), moment.as_ref(), payload.as_ref())?;
        let reference =
            reference.map(|reference| Rows::of_cables("reference", &reference, cables)).transpose()?;
        let cases = loads.cases([&poses].into_iter().chain(&reference))?;
        let robot = &self.robot;
        let outcomes: Vec<Result<_, StaticsError>> = each(py, cases.count, |case| {
            let reference = reference.as_ref().map(|reference| reference.row(case));
            inverse(robot, &poses.pose(case)?, &loads.load(case)?, reference)
        })?;
        let all = Columns::new(py, cases, &outcomes)?;
        Ok(InverseSolution {
            lengths: all.numbers(&[cables], |found, out| out.copy_from_slice(&found.lengths))?,
            tensions: all.numbers(&[cables], |found, out| out.copy_from_slice(&found.tensions))?,
            cable_forces: all.pairs(cables, |found| &found.equilibrium.cable_forces)?,
            active: all.array(0, &[cables], |found, out: &mut [i8]| {
                for (out, bound) in out.iter_mut().zip(&found.active) {
                    *out = match bound {
                        Some(Bound::Min) => -1,
                        Some(Bound::Max) => 1,
                        None => 0,
                    };
                }
            })?,
            residual: all
                .vector(|found| [found.residual.closure, found.residual.force, found.residual.moment])?,
            iterations: all.array(0, &[], |found, out: &mut [i64]| out[0] = found.iterations as i64)?,
            reasons: all.reasons(),
            kinds: all.kinds(),
        })
    }
}
