//! `Robot.inverse`: the unstrained lengths that hold a pose.

use crate::convert::{Answer, Cases, Columns, Loads, Numbers, Raised, Rows, answer, each, plotted, run};
use crate::robot::Robot;
use crate::robot::direct::numbers_of_limits;
use cdpr_robot::{Coordinate, Pose, RobotError};
use cdpr_statics::free_coordinates::{FreeSolution, FreeSolutions, free_solutions};
use cdpr_statics::limits::out_of_limits;
use cdpr_statics::{
    Bound, Equilibrium, InversePath, InverseSolution as InverseModel, PathSolution, Residual, StaticsError,
    WantedPose, inverse,
};
use numpy::PyArray1;
use pyo3::prelude::*;
use pyo3::types::PyList;
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
        /// Pose at which the platform rests, (7,): the given one but for `free` coordinates.
        pose: Py<PyAny>,
        /// Whether the platform stays there with these lengths; only with `free` coordinates.
        stable: Py<PyAny>,
        /// Further solutions with `free` coordinates, those within the limits first: a list of
        /// `OtherSolution`, or for m poses a list of m such lists.
        others: Py<PyAny>,
        /// Why there is no answer, None if there is one; None for one pose.
        reasons: Py<PyAny>,
        /// The kind of each failure, in the same form: `infeasible_tension`, ...
        kinds: Py<PyAny>,
    }
}

plotted!(InverseSolution);

answer! {
    /// A further rest of a platform with `free` coordinates.
    #[pyclass(frozen, get_all, module = "cdpr")]
    pub(crate) struct OtherSolution {
        /// Pose at which the platform rests, (7,).
        pose: Py<PyAny>,
        /// Unstrained length of each cable [m], (n,).
        lengths: Py<PyAny>,
        /// Tension of each cable at the platform [N], (n,).
        tensions: Py<PyAny>,
        /// Whether its tension, at either end, is out of limits, as in `InverseSolution`, (n,).
        out_of_limits: Py<PyAny>,
        /// Whether the platform stays there with these lengths.
        stable: bool,
    }
}

plotted!(OtherSolution);

/// A pose that is held, or at which the platform rests.
struct Solved {
    lengths: Vec<f64>,
    tensions: Vec<f64>,
    active: Vec<Option<Bound>>,
    equilibrium: Equilibrium,
    residual: Residual,
    iterations: usize,
    jump: bool,
    stable: bool,
    others: Vec<FreeSolution>,
}

impl From<PathSolution> for Solved {
    fn from(PathSolution { solution, jump }: PathSolution) -> Self {
        let InverseModel { lengths, tensions, active, equilibrium, iterations, residual, .. } = solution;
        let (stable, others) = (false, Vec::new());
        Self { lengths, tensions, active, equilibrium, residual, iterations, jump, stable, others }
    }
}

impl From<FreeSolutions> for Solved {
    fn from(FreeSolutions { first, others }: FreeSolutions) -> Self {
        let FreeSolution { lengths, tensions, equilibrium, stability, residual, iterations } = first;
        let (active, stable) = (vec![None; lengths.len()], stability.is_stable());
        Self { lengths, tensions, active, equilibrium, residual, iterations, jump: false, stable, others }
    }
}

/// The coordinates of these names.
pub(crate) fn coordinates(names: Option<Vec<String>>) -> Answer<Vec<Coordinate>> {
    let names = names.unwrap_or_default();
    Ok(names.iter().map(|name| name.parse()).collect::<Result<_, RobotError>>()?)
}

/// Further solutions: a list, or one for each case; None where no coordinate is free.
fn others_of(
    py: Python,
    robot: &cdpr_robot::Robot,
    outcomes: &[Result<Solved, StaticsError>],
    single: bool,
    free: bool,
) -> Answer<Py<PyAny>> {
    if !free {
        return Ok(py.None());
    }
    let made = |other: &FreeSolution| -> PyResult<Py<OtherSolution>> {
        let Pose { position, .. } = other.equilibrium.pose;
        let quaternion = other.equilibrium.pose.quaternion();
        let array = |values: &[f64]| PyArray1::from_slice(py, values).into_any().unbind();
        let mut limits = vec![0_i8; other.lengths.len()];
        numbers_of_limits(&out_of_limits(robot, &other.lengths, &[&other.equilibrium]), &mut limits);
        let solution = OtherSolution {
            pose: array(&[position.as_slice(), &quaternion].concat()),
            lengths: array(&other.lengths),
            tensions: array(&other.tensions),
            out_of_limits: PyArray1::from_vec(py, limits).into_any().unbind(),
            stable: other.stability.is_stable(),
        };
        Py::new(py, solution)
    };
    let lists = outcomes.iter().map(|outcome| -> PyResult<_> {
        let others = outcome.as_ref().map_or(&[][..], |solved| &solved.others);
        PyList::new(py, others.iter().map(made).collect::<PyResult<Vec<_>>>()?)
    });
    let mut lists = lists.collect::<PyResult<Vec<_>>>()?;
    match lists.pop() {
        Some(list) if single => Ok(list.into_any().unbind()),
        Some(list) => {
            lists.push(list);
            Ok(PyList::new(py, lists)?.into_any().unbind())
        }
        None => Ok(PyList::empty(py).into_any().unbind()),
    }
}

impl InverseSolution {
    /// The answers to all cases, of a path or with free coordinates.
    fn of(
        py: Python,
        robot: &cdpr_robot::Robot,
        cases: Cases,
        outcomes: &[Result<Solved, StaticsError>],
        [is_path, is_free]: [bool; 2],
    ) -> Answer<Self> {
        let others = others_of(py, robot, outcomes, cases.single, is_free)?;
        let all = Columns::new(py, cases, outcomes)?;
        let cables = robot.cables.len();
        let jump = is_path.then(|| all.array(false, &[], |found, out: &mut [bool]| out[0] = found.jump));
        Ok(Self {
            lengths: all.numbers(&[cables], |found, out| out.copy_from_slice(&found.lengths))?,
            tensions: all.numbers(&[cables], |found, out| out.copy_from_slice(&found.tensions))?,
            exit_tensions: all.numbers(&[cables], |found, out| {
                let Solved { equilibrium, lengths, .. } = found;
                out.copy_from_slice(&equilibrium.exit_tensions(robot, lengths));
            })?,
            out_of_limits: all.array(0, &[cables], |found, out: &mut [i8]| {
                let Solved { equilibrium, lengths, .. } = found;
                numbers_of_limits(&out_of_limits(robot, lengths, &[equilibrium]), out);
            })?,
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
                .vector(|Solved { residual, .. }| [residual.closure, residual.force, residual.moment])?,
            iterations: all.array(0, &[], |found, out: &mut [i64]| out[0] = found.iterations as i64)?,
            jump: jump.transpose()?.unwrap_or_else(|| py.None()),
            pose: all.numbers(&[7], |found, out| {
                let Pose { position, .. } = found.equilibrium.pose;
                out[..3].copy_from_slice(position.as_slice());
                out[3..].copy_from_slice(&found.equilibrium.pose.quaternion());
            })?,
            stable: match is_free {
                true => all.array(false, &[], |found, out: &mut [bool]| out[0] = found.stable)?,
                false => py.None(),
            },
            others,
            reasons: all.reasons(),
            kinds: all.kinds(),
        })
    }
}

#[pymethods]
impl Robot {
    /// Computes the unstrained lengths that hold the platform at a pose under its weight and a load.
    ///
    /// The tensions are those within their limits that come nearest to a reference. Arguments are of one
    /// case, or have a first axis of m cases.
    ///
    /// Parameters
    /// ----------
    /// pose : array_like
    ///     x, y, z [m], or x, y, z, qw, qx, qy, qz, (3,) or (7,).
    /// force, moment : array_like, optional
    ///     On the platform in the base frame, about P [N, N m], (3,).
    /// payload : array_like, optional
    ///     Mass added at the platform's centre of mass [kg].
    /// reference : array_like, optional
    ///     Tensions that the tensions are nearest to [N], (n,), instead of the robot's own
    ///     `tension_reference`; zeros for the least norm.
    /// path : bool, default False
    ///     Whether the cases are a path, so that each keeps to the branch of tensions of the one before as
    ///     long as it exists on the straight way between them.
    /// tension_change : float, optional
    ///     Greatest change of a tension from one pose of a path to the next [N].
    /// free : sequence of str, optional
    ///     Names of the coordinates of the pose that are found, for a robot with fewer cables than free
    ///     motions: as many of x, y, z, roll, pitch, yaw as cables are missing, with R = Rz(yaw) Ry(pitch)
    ///     Rx(roll). They start from the pose and end where the platform rests, within the limits, with no
    ///     cable longer than three chords or below `ground_z`; a reference does not matter.
    ///
    /// Returns
    /// -------
    /// InverseSolution
    ///     Lengths and tensions.
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
    /// >>> robot.inverse([0, 0, 2]).lengths.shape  # [m]
    /// (8,)
    /// >>> robot.inverse([[0, 0, 2], [1, 0, 2]], payload=50).lengths.shape
    /// (2, 8)
    #[pyo3(signature = (pose, *, force=None, moment=None, payload=None, reference=None, path=false,
        tension_change=None, free=None))]
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
        tension_change: Option<f64>,
        free: Option<Vec<String>>,
    ) -> Answer<InverseSolution> {
        let cables = self.robot.cables.len();
        let free = coordinates(free)?;
        if let Some(change) = tension_change.filter(|_| !path) {
            let expected = "None without path=True";
            return Err(Raised::Input(format!("tension_change is {change}: expected {expected}")));
        }
        let poses = Rows::poses("pose", &pose, &self.robot)?;
        let loads = Loads::new(force.as_ref(), moment.as_ref(), payload.as_ref(), &self.robot)?;
        let reference =
            reference.map(|reference| Rows::of_cables("reference", &reference, cables)).transpose()?;
        let cases = loads.cases([&poses].into_iter().chain(&reference))?;
        let robot = &self.robot;
        let of_case = |case: usize| -> Result<_, StaticsError> {
            let tension_reference = reference.as_ref().map(|reference| reference.row(case));
            let pose = poses.pose(case)?;
            Ok((WantedPose { tension_reference, free: &free, ..pose.into() }, loads.load(case)?))
        };
        let outcomes: Vec<Result<Solved, StaticsError>> = if path {
            let mut path = InversePath::new(robot);
            tension_change.map_or(Ok(()), |change| path.limit_change(change))?;
            let mut one = |case| {
                let (wanted, load) = of_case(case)?;
                path.solve(wanted, &load).map(Solved::from)
            };
            run(py, |stop| (0..cases.count).take_while(|_| !stop.load(Relaxed)).map(&mut one).collect())?
        } else {
            each(py, cases.count, |case| {
                let (wanted, load) = of_case(case)?;
                if !free.is_empty() {
                    return free_solutions(robot, wanted, &load).map(Solved::from);
                }
                let solution = inverse(robot, wanted, &load)?;
                Ok(Solved::from(PathSolution { solution, jump: false }))
            })?
        };
        InverseSolution::of(py, robot, cases, &outcomes, [path, !free.is_empty()])
    }
}
