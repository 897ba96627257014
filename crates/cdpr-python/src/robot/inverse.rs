//! `Robot.inverse`: the unstrained lengths that hold a pose.

use crate::convert::{Answer, Columns, Loads, Numbers, Rows, answer, each, run};
use crate::robot::Robot;
use crate::robot::direct::numbers_of_limits;
use cdpr_statics::{
    Bound, InversePath, InverseSolution as InverseModel, PathSolution, StaticsError, inverse, out_of_limits,
};
use pyo3::prelude::*;
use std::sync::atomic::Ordering::Relaxed;

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
        /// Tension of each cable at its exit point [N], (n,).
        exit_tensions: Py<PyAny>,
        /// Whether its tension, at either end, is out of limits: 2 above the breaking force, 1 above the
        /// greatest tension, 0 within, (n,).
        out_of_limits: Py<PyAny>,
        /// Force (fx, fz) on each cable at its anchor point, in its vertical plane [N], (n, 2).
        cable_forces: Py<PyAny>,
        /// The bound that each tension rests on: -1 the least, 1 the greatest, 0 none, (n,).
        active: Py<PyAny>,
        /// Residuals of the 6 + 2n equations: closure of the cables [m], force [N], moment [N m], (3,).
        residual: Py<PyAny>,
        /// Iterations of distribution and Newton's method; 0 where there is no answer.
        iterations: Py<PyAny>,
        /// Where the lengths may jump, because the branch of the pose before ends; only along a path, ().
        jump: Py<PyAny>,
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
    /// The tensions are those within their limits that come nearest to a reference. Arguments are of one
    /// case, or have a first axis of m cases.
    ///
    /// pose: x, y, z [m], or x, y, z, qw, qx, qy, qz, (3,) or (7,).
    /// force, moment: on the platform in the base frame, about P [N, N m], (3,).
    /// payload: mass added at the platform's centre of mass [kg].
    /// reference: tensions that the tensions are nearest to [N], (n,), in place of the robot's own
    ///     `tension_reference`; zeros for the least norm.
    /// path: whether the cases are a path, so that each keeps to the branch of tensions of the one before as
    ///     long as it exists on the straight way between them.
    ///
    /// Raises InputError; for one case NoSolutionError.
    #[pyo3(signature = (pose, *, force=None, moment=None, payload=None, reference=None, path=false))]
    #[allow(clippy::too_many_arguments)]
    fn inverse(
        &self,
        py: Python,
        pose: Numbers,
        force: Option<Numbers>,
        moment: Option<Numbers>,
        payload: Option<Numbers>,
        reference: Option<Numbers>,
        path: bool,
    ) -> Answer<InverseSolution> {
        let cables = self.robot.cables.len();
        let poses = Rows::poses("pose", &pose)?;
        let loads = Loads::new(force.as_ref(), moment.as_ref(), payload.as_ref())?;
        let reference =
            reference.map(|reference| Rows::of_cables("reference", &reference, cables)).transpose()?;
        let cases = loads.cases([&poses].into_iter().chain(&reference))?;
        let robot = &self.robot;
        let of_case = |case: usize| -> Result<_, StaticsError> {
            let reference = reference.as_ref().map(|reference| reference.row(case));
            Ok((poses.pose(case)?, loads.load(case)?, reference))
        };
        let outcomes: Vec<Result<PathSolution, StaticsError>> = if path {
            let mut path = InversePath::new(robot);
            let mut one = |case| {
                let (pose, load, reference) = of_case(case)?;
                path.solve(&pose, &load, reference)
            };
            run(py, |stop| (0..cases.count).take_while(|_| !stop.load(Relaxed)).map(&mut one).collect())?
        } else {
            each(py, cases.count, |case| {
                let (pose, load, reference) = of_case(case)?;
                Ok(PathSolution { solution: inverse(robot, &pose, &load, reference)?, jump: false })
            })?
        };
        let all = Columns::new(py, cases, &outcomes)?;
        let jump = path.then(|| all.array(false, &[], |found, out: &mut [bool]| out[0] = found.jump));
        Ok(InverseSolution {
            lengths: all.numbers(&[cables], |found, out| out.copy_from_slice(&found.solution.lengths))?,
            tensions: all.numbers(&[cables], |found, out| out.copy_from_slice(&found.solution.tensions))?,
            exit_tensions: all.numbers(&[cables], |found, out| {
                let InverseModel { equilibrium, lengths, .. } = &found.solution;
                out.copy_from_slice(&equilibrium.exit_tensions(robot, lengths));
            })?,
            out_of_limits: all.array(0, &[cables], |found, out: &mut [i8]| {
                let InverseModel { equilibrium, lengths, .. } = &found.solution;
                numbers_of_limits(&out_of_limits(robot, lengths, &[equilibrium]), out);
            })?,
            cable_forces: all.pairs(cables, |found| &found.solution.equilibrium.cable_forces)?,
            active: all.array(0, &[cables], |found, out: &mut [i8]| {
                let found = &found.solution;
                for (out, bound) in out.iter_mut().zip(&found.active) {
                    *out = match bound {
                        Some(Bound::Min) => -1,
                        Some(Bound::Max) => 1,
                        None => 0,
                    };
                }
            })?,
            residual: all.vector(|PathSolution { solution: InverseModel { residual, .. }, .. }| {
                [residual.closure, residual.force, residual.moment]
            })?,
            iterations: all
                .array(0, &[], |found, out: &mut [i64]| out[0] = found.solution.iterations as i64)?,
            jump: jump.transpose()?.unwrap_or_else(|| py.None()),
            reasons: all.reasons(),
            kinds: all.kinds(),
        })
    }
}
