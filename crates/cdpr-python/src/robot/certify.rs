//! `Robot.certify`: proofs of how close the exact equilibrium is.

use crate::convert::{Answer, Columns, Loads, Numbers, Rows, answer, each, plotted, question};
use crate::robot::Robot;
use cdpr_robot::plausible;
use cdpr_statics::{
    Certificate as Proof, DirectProblem, DirectStart, StaticsError, check_lengths, rough_pose,
};
use pyo3::prelude::*;

answer! {
    /// Bounds on how far the exact equilibrium is from the one that was found, proved by interval arithmetic.
    ///
    /// The answer is of one case, or of m: then every field has a first axis of m, with NaN (or False) where
    /// there is no proof, and `reasons` says why.
    #[pyclass(frozen, get_all, module = "cdpr")]
    pub(crate) struct Certificate {
        /// Position and quaternion that were found, (7,).
        pose: Py<PyAny>,
        /// Bound on the distance of P from there [m].
        position: Py<PyAny>,
        /// Bound on the angle [rad].
        rotation: Py<PyAny>,
        /// Bound on the error of the force of every cable [N].
        force: Py<PyAny>,
        /// Lower bound of the stiffness of the softest motion [N/m].
        least_stiffness: Py<PyAny>,
        /// Whether the exact equilibrium is proved stable.
        stable: Py<PyAny>,
        /// Why there is no proof, None if there is one; None for one case.
        reasons: Py<PyAny>,
        /// The kind of each failure, in the same form: `not_certified`, ...
        kinds: Py<PyAny>,
    }
}

plotted!(Certificate);

#[pymethods]
impl Robot {
    /// Proves how close the exact equilibrium is to that of `Robot.direct`, and that it is stable.
    ///
    /// It is for six free motions, plain cables and a level base. Arguments are those of `Robot.direct`.
    ///
    /// Parameters
    /// ----------
    /// lengths : array_like
    ///     Unstrained lengths of the cables [m], (n,).
    /// force : array_like, optional
    ///     Force on the platform in the base frame [N], (3,).
    /// moment : array_like, optional
    ///     Moment on the platform in the base frame, about P [N m], (3,).
    /// payload : array_like, optional
    ///     Mass added at the platform's centre of mass [kg].
    /// start : array_like, optional
    ///     Start of the search, (3,) or (7,).
    ///
    /// Returns
    /// -------
    /// Certificate
    ///     Bounds.
    ///
    /// Raises
    /// ------
    /// InputError
    ///     For an invalid value; the message names it and what would be right.
    /// NoSolutionError
    ///     For one case without an answer; of several, its row has NaN and a reason, of the kind
    ///     `not_certified` where nothing is proved.
    ///
    /// Examples
    /// --------
    /// >>> import cdpr
    /// >>> robot = cdpr.Robot.from_file("cogiro")
    /// >>> robot.certify(robot.inverse([0, 0, 2]).lengths).position < 1e-9  # [m]
    /// True
    #[pyo3(signature = (lengths, *, force=None, moment=None, payload=None, start=None))]
    fn certify(
        &self,
        py: Python,
        lengths: Numbers,
        force: Option<Numbers>,
        moment: Option<Numbers>,
        payload: Option<Numbers>,
        start: Option<Numbers>,
    ) -> Answer<Certificate> {
        let robot = &self.robot;
        let lengths = Rows::of_cables("lengths", &lengths, robot.cables.len())?;
        question(lengths.first(|row| plausible::lengths(&self.robot, row)))?;
        let loads = Loads::new(force.as_ref(), moment.as_ref(), payload.as_ref(), &self.robot)?;
        let start = start.map(|start| Rows::poses("start", &start, &self.robot)).transpose()?;
        let cases = loads.cases([&lengths].into_iter().chain(&start))?;
        let one = |case| -> Result<([f64; 7], Proof), StaticsError> {
            let (lengths, load) = (lengths.row(case), loads.load(case)?);
            check_lengths(robot, lengths)?;
            let start = match &start {
                Some(start) => start.pose(case)?,
                None => rough_pose(robot, lengths),
            };
            let problem = DirectProblem::new(robot, lengths, &load)?;
            let solution = problem.direct(DirectStart::Pose(&start))?;
            let mut pose = [0.0; 7];
            pose[..3].copy_from_slice(solution.equilibrium.pose.position.as_slice());
            pose[3..].copy_from_slice(&solution.equilibrium.pose.quaternion());
            Ok((pose, problem.certify(&solution)?))
        };
        let outcomes = each(py, cases.count, one)?;
        let all = Columns::new(py, cases, &outcomes)?;
        Ok(Certificate {
            pose: all.vector(|(pose, _)| *pose)?,
            position: all.number(|(_, proof)| proof.position)?,
            rotation: all.number(|(_, proof)| proof.rotation)?,
            force: all.number(|(_, proof)| proof.force)?,
            least_stiffness: all.number(|(_, proof)| proof.least_stiffness)?,
            stable: all.array(false, &[], |(_, proof), out| out[0] = proof.is_stable())?,
            reasons: all.reasons(),
            kinds: all.kinds(),
        })
    }
}
