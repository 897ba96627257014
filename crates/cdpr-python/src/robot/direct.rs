//! `Robot.direct`: where the platform stands for given unstrained lengths.

use crate::convert::{Answer, Columns, Loads, Numbers, Rows, answer, each, plotted, question};
use crate::robot::Robot;
use cdpr_assess::doubtful_rest;
use cdpr_robot::plausible;
use cdpr_statics::limits::{Limit, OutOfLimits, out_of_limits};
use cdpr_statics::{DirectStart, StaticsError, check_lengths, direct, rough_pose};
use pyo3::prelude::*;

answer! {
    /// Stable equilibria of the platform.
    ///
    /// The answer is of one case, or of m: then every field has a first axis of m, with NaN (or False, None)
    /// where there is no answer, and `reasons` says why.
    #[pyclass(frozen, get_all, module = "cdpr")]
    pub(crate) struct DirectSolution {
        /// Position of P in the base frame [m], (3,).
        position: Py<PyAny>,
        /// Rotation from the platform to the base frame as a unit quaternion (w, x, y, z), w >= 0, (4,).
        quaternion: Py<PyAny>,
        /// Rotation from the platform to the base frame as a matrix, (3, 3).
        rotation: Py<PyAny>,
        /// Position and quaternion, a pose as other calls take it, (7,).
        pose: Py<PyAny>,
        /// Force (fx, fz) on each cable at its anchor point, in its vertical plane [N], (n, 2).
        cable_forces: Py<PyAny>,
        /// Tension of each cable at the platform [N], (n,).
        tensions: Py<PyAny>,
        /// Tension of each cable at its exit point [N], (n,).
        exit_tensions: Py<PyAny>,
        /// Whether its tension, at either end, is out of limits: 2 above the breaking force, 1 above the
        /// greatest tension, -1 below the least one, 0 within, (n,).
        out_of_limits: Py<PyAny>,
        /// Whether the equilibrium is stable.
        stable: Py<PyAny>,
        /// Motions that nothing resists, a row for each, (6, 6): translation of P and rotation vector; NaN in
        /// the rows beyond.
        neutral: Py<PyAny>,
        /// Stiffness of the softest motion that is resisted [N/m].
        least_stiffness: Py<PyAny>,
        /// Whether each cable carries at its lower end at most its own weight, (n,).
        slack: Py<PyAny>,
        /// Residuals of the 6 + 2n equations: closure of the cables [m], force [N], moment [N m], (3,).
        residual: Py<PyAny>,
        /// Method that found the equilibrium: newton, trust_region or continuation.
        method: Py<PyAny>,
        /// Iterations of that method; 0 where there is no answer.
        iterations: Py<PyAny>,
        /// Why there is no answer, None if there is one; None for one case.
        reasons: Py<PyAny>,
        /// The kind of each failure, in the same form: `infeasible_tension`, ...
        kinds: Py<PyAny>,
    }
}

plotted!(DirectSolution);

/// An equilibrium with its least stiffness, which is computed in parallel.
pub(crate) struct Found {
    solution: cdpr_statics::DirectSolution,
    least_stiffness: f64,
    exit_tensions: Vec<f64>,
    out_of_limits: Vec<OutOfLimits>,
}

impl Found {
    pub(crate) fn new(
        robot: &cdpr_robot::Robot,
        lengths: &[f64],
        solution: cdpr_statics::DirectSolution,
    ) -> Self {
        Self {
            least_stiffness: solution.stability.least_stiffness(),
            exit_tensions: solution.equilibrium.exit_tensions(robot, lengths),
            out_of_limits: out_of_limits(robot, lengths, &[&solution.equilibrium]),
            solution,
        }
    }
}

/// Writes the number of the limit that each cable's tension passes.
pub(crate) fn numbers_of_limits(found: &[OutOfLimits], out: &mut [i8]) {
    for one in found {
        out[one.cable] = match one.limit {
            Limit::BreakingForce | Limit::Strain => 2,
            Limit::Max => 1,
            Limit::MaxElsewhere => 0,
            Limit::Min => -1,
        };
    }
}

#[pymethods]
impl Robot {
    /// Finds where the platform stands for given unstrained lengths: a stable equilibrium.
    ///
    /// Arguments are of one case, or have a first axis of m cases.
    ///
    /// Parameters
    /// ----------
    /// lengths : array_like
    ///     Unstrained lengths of the cables [m], (n,).
    /// force, moment : array_like, optional
    ///     On the platform in the base frame, about P [N, N m], (3,).
    /// payload : array_like, optional
    ///     Mass added at the platform's centre of mass [kg].
    /// start : array_like, optional
    ///     Start of the search, (3,) or (7,); if left out, where straight cables would hold a point.
    ///
    /// Returns
    /// -------
    /// DirectSolution
    ///     The equilibria.
    ///
    /// Raises
    /// ------
    /// InputError
    ///     For an invalid value; the message names it and what would be right.
    /// NoSolutionError
    ///     For one case without an answer; of several, its row has NaN and a reason.
    ///
    /// Examples
    /// --------
    /// >>> import cdpr
    /// >>> robot = cdpr.Robot.from_file("cogiro")
    /// >>> found = robot.direct(robot.inverse([0, 0, 2]).lengths)
    /// >>> (found.position.round(6) + 0).tolist()  # [m]
    /// [0.0, 0.0, 2.0]
    #[pyo3(signature = (lengths, *, force=None, moment=None, payload=None, start=None))]
    fn direct(
        &self,
        py: Python,
        lengths: Numbers,
        force: Option<Numbers>,
        moment: Option<Numbers>,
        payload: Option<Numbers>,
        start: Option<Numbers>,
    ) -> Answer<DirectSolution> {
        let lengths = Rows::of_cables("lengths", &lengths, self.robot.cables.len())?;
        question(lengths.first(|row| plausible::lengths(&self.robot, row)))?;
        let loads = Loads::new(force.as_ref(), moment.as_ref(), payload.as_ref(), &self.robot)?;
        let start = start.map(|start| Rows::poses("start", &start, &self.robot)).transpose()?;
        let cases = loads.cases([&lengths].into_iter().chain(&start))?;
        let robot = &self.robot;
        let one = |case| -> Result<Found, StaticsError> {
            let lengths = lengths.row(case);
            check_lengths(robot, lengths)?;
            let start = match &start {
                Some(start) => start.pose(case)?,
                None => rough_pose(robot, lengths),
            };
            let solution = direct(robot, lengths, &loads.load(case)?, DirectStart::Pose(&start))?;
            Ok(Found::new(robot, lengths, solution))
        };
        let outcomes = each(py, cases.count, one)?;
        let doubt = |(case, outcome): (usize, &Result<Found, StaticsError>)| {
            let (found, load) = (outcome.as_ref().ok()?, loads.load(case).ok()?);
            let stated = start.as_ref().map(|all| all.pose(case)).transpose().ok()?;
            let given = (lengths.row(case), &load);
            doubtful_rest(robot, "the equilibrium", given, &found.solution, stated.as_ref())
        };
        question(outcomes.iter().enumerate().find_map(doubt))?;
        let found = Columns::new(py, cases, &outcomes)?;
        DirectSolution::new(&found, robot.cables.len())
    }
}

impl DirectSolution {
    pub(crate) fn new(all: &Columns<Found>, cables: usize) -> Answer<Self> {
        Ok(Self {
            position: all.vector(|found| found.solution.equilibrium.pose.position.into())?,
            quaternion: all.vector(|found| found.solution.equilibrium.pose.quaternion())?,
            rotation: all.numbers(&[3, 3], |found, out| {
                // Row by row.
                let matrix = found.solution.equilibrium.pose.rotation.matrix().transpose();
                out.copy_from_slice(matrix.as_slice());
            })?,
            pose: all.numbers(&[7], |found, out| {
                let pose = &found.solution.equilibrium.pose;
                out[..3].copy_from_slice(pose.position.as_slice());
                out[3..].copy_from_slice(&pose.quaternion());
            })?,
            cable_forces: all.pairs(cables, |found| &found.solution.equilibrium.cable_forces)?,
            tensions: all.numbers(&[cables], |found, out| {
                out.copy_from_slice(&found.solution.equilibrium.tensions());
            })?,
            exit_tensions: all.numbers(&[cables], |found, out| out.copy_from_slice(&found.exit_tensions))?,
            out_of_limits: all.array(0, &[cables], |found, out: &mut [i8]| {
                numbers_of_limits(&found.out_of_limits, out);
            })?,
            stable: all.array(false, &[], |found, out| out[0] = found.solution.stability.is_stable())?,
            neutral: all.numbers(&[6, 6], |found, out| {
                for (row, mode) in out.chunks_exact_mut(6).zip(found.solution.stability.neutral()) {
                    row[..3].copy_from_slice(mode.translation.as_slice());
                    row[3..].copy_from_slice(mode.rotation.as_slice());
                }
            })?,
            least_stiffness: all.number(|found| found.least_stiffness)?,
            slack: all.array(false, &[cables], |found, out| {
                found.solution.report.slack.iter().for_each(|cable| out[*cable] = true);
            })?,
            residual: all.vector(|found| {
                let residual = &found.solution.report.residual;
                [residual.closure, residual.force, residual.moment]
            })?,
            method: all.words(|found| found.solution.report.method.to_string())?,
            iterations: all.array(0, &[], |found, out: &mut [i64]| {
                out[0] = found.solution.report.iterations as i64;
            })?,
            reasons: all.reasons(),
            kinds: all.kinds(),
        })
    }
}
