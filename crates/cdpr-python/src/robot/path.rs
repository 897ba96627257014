//! `Robot.path`: what a robot does along a path of poses.

use crate::convert::{Answer, Cases, Columns, Loads, Numbers, Raised, Rows, answer, plotted, run};
use crate::robot::Robot;
use crate::robot::direct::{DirectSolution, Found};
use crate::robot::workspace::tolerances;
use cdpr_assess::{Bands, Path, PathPose};
use cdpr_statics::StaticsError;
use pyo3::prelude::*;
use pyo3::types::PyDict;
use std::sync::atomic::Ordering;

answer! {
    /// What a robot does at the m poses of a path, NaN where there is no answer, and `reasons` says why.
    ///
    /// The lengths hold each pose under the platform's own weight, on the branch of the pose before; then the
    /// load comes onto the platform with the lengths kept.
    #[pyclass(frozen, get_all, module = "cdpr")]
    pub(crate) struct PathStates {
        /// Where the lengths may jump, (m,).
        jump: Py<PyAny>,
        /// Unstrained lengths [m], (m, n).
        lengths: Py<PyAny>,
        /// Tensions at the platform without the load [N], (m, n).
        tensions: Py<PyAny>,
        /// Tensions at the exit points without the load [N], (m, n).
        exit_tensions: Py<PyAny>,
        /// Greatest distance of each cable across its chord without the load [m], (m, n).
        sags: Py<PyAny>,
        /// Displacement of P by the load [m], (m, 3).
        displacement: Py<PyAny>,
        /// Its length [m], (m,).
        magnitude: Py<PyAny>,
        /// Stiffness of the softest motion with the load [N/m], (m,).
        least_stiffness: Py<PyAny>,
        /// Frequency with which the platform swings with the load, the mass of cables included [Hz], (m,);
        /// NaN for a robot without `inertia`.
        platform_frequency: Py<PyAny>,
        /// Share of the platform in the kinetic energy of that motion, (m,).
        platform_share: Py<PyAny>,
        /// Lowest natural frequency of platform and cables with the load [Hz], (m,).
        lowest_frequency: Py<PyAny>,
        /// Standard deviations by the uncertainty; None without one.
        std: Option<Py<PathDeviations>>,
        /// The equilibria with the load.
        loaded: Py<DirectSolution>,
        /// Why there is no answer, None if there is one, (m,).
        reasons: Py<PyAny>,
        /// The kind of each failure: `infeasible_tension`, ...
        kinds: Py<PyAny>,
    }
}

plotted!(PathStates);

answer! {
    /// Standard deviations at the m poses of a path, NaN where there are no derivatives.
    #[pyclass(frozen, get_all, module = "cdpr")]
    pub(crate) struct PathDeviations {
        /// Of the unstrained lengths [m], (m, n).
        lengths: Py<PyAny>,
        /// Of the tensions at the platform without the load [N], (m, n).
        tensions: Py<PyAny>,
        /// Of the displacement [m], (m, 3).
        displacement: Py<PyAny>,
        /// Of its magnitude [m], (m,).
        magnitude: Py<PyAny>,
        /// Of the least stiffness [N/m], (m,).
        least_stiffness: Py<PyAny>,
        /// Of the frequency of the platform [Hz], (m,).
        platform_frequency: Py<PyAny>,
        /// Why there is no answer, None if there is one, (m,).
        reasons: Py<PyAny>,
    }
}

plotted!(PathDeviations);

struct Passed {
    at: PathPose,
    loaded: Found,
}

#[pymethods]
impl Robot {
    /// Follows a path of poses, as `cdpr path` does.
    ///
    /// Strongly sagging cables may hold a pose with several sets of tensions. Along a path each pose keeps to
    /// the set of the pose before, as long as it exists. A pose without an answer is left out of the path.
    ///
    /// Parameters
    /// ----------
    /// poses : array_like
    ///     x, y, z [m], or x, y, z, qw, qx, qy, qz, (m, 3) or (m, 7).
    /// payload : array_like, optional
    ///     Mass that the platform carries, at its centre of mass [kg].
    /// force, moment : array_like, optional
    ///     On the platform in the base frame, about P [N, N m], (3,).
    /// uncertainty : dict of float, optional
    ///     Standard deviations of parameters or groups [SI units]: {"a": 0.002, "mass": 0.5}.
    ///
    /// Returns
    /// -------
    /// PathStates
    ///     States along the path.
    ///
    /// Raises
    /// ------
    /// InputError
    ///     For an invalid value; the message names it and what would be right.
    ///
    /// Examples
    /// --------
    /// >>> import cdpr
    /// >>> robot = cdpr.Robot.from_file("cogiro")
    /// >>> states = robot.path([[x, 0, 2] for x in (0, 0.1, 0.2)], payload=50, uncertainty={"a": 0.002})
    /// >>> states.tensions.shape, states.std.magnitude.shape  # [N], [m]
    /// ((3, 8), (3,))
    #[pyo3(signature = (poses, *, payload=None, force=None, moment=None, uncertainty=None))]
    fn path(
        &self,
        py: Python,
        poses: Numbers,
        payload: Option<Numbers>,
        force: Option<Numbers>,
        moment: Option<Numbers>,
        uncertainty: Option<&Bound<PyDict>>,
    ) -> Answer<PathStates> {
        let robot = &self.robot;
        let poses = Rows::poses("poses", &poses, &self.robot)?;
        let loads = Loads::new(force.as_ref(), moment.as_ref(), payload.as_ref(), &self.robot)?;
        if !loads.cases([])?.single {
            let message = "payload, force or moment has several rows: expected one load for the whole path";
            return Err(Raised::Input(message.to_owned()));
        }
        let load = loads.load(0)?;
        let model = uncertainty.map(|named| tolerances(robot, named)).transpose()?;
        let outcomes = run(py, |stop| -> Answer<Vec<Result<Passed, StaticsError>>> {
            let mut path = Path::new(robot, load, model.as_ref())?;
            let mut passed = Vec::new();
            for k in (0..poses.number()).take_while(|_| !stop.load(Ordering::Relaxed)) {
                passed.push(poses.pose(k).and_then(|pose| path.solve(&pose)).map(|at| {
                    let loaded = Found::new(robot, &at.deflection.lengths, at.deflection.loaded.clone());
                    Passed { at, loaded }
                }));
            }
            Ok(passed)
        })??;
        let all = Columns::new(py, Cases { count: outcomes.len(), single: false }, &outcomes)?;
        let cables = robot.cables.len();
        let of_cables = |of: fn(&PathPose) -> &[f64]| {
            all.numbers(&[cables], |passed, out| out.copy_from_slice(of(&passed.at)))
        };
        let std = |width: &[usize], of: fn(&Bands) -> Vec<f64>| {
            all.numbers(width, |passed, out| match passed.at.bands.as_ref().map(of) {
                Some(values) => out.copy_from_slice(&values),
                None => out.fill(f64::NAN),
            })
        };
        let deviations = || -> Answer<Py<PathDeviations>> {
            let deviations = PathDeviations {
                lengths: std(&[cables], |bands| bands.lengths.clone())?,
                tensions: std(&[cables], |bands| bands.tensions.clone())?,
                displacement: std(&[3], |bands| bands.displacement.to_vec())?,
                magnitude: std(&[], |bands| number(bands.magnitude))?,
                least_stiffness: std(&[], |bands| number(bands.least_stiffness))?,
                platform_frequency: std(&[], |bands| number(bands.platform_frequency))?,
                reasons: all.reasons(),
            };
            Ok(Py::new(py, deviations)?)
        };
        Ok(PathStates {
            jump: all.array(false, &[], |passed, out| out[0] = passed.at.jump)?,
            lengths: of_cables(|at| &at.deflection.lengths)?,
            tensions: of_cables(|at| &at.tensions)?,
            exit_tensions: of_cables(|at| &at.exit_tensions)?,
            sags: of_cables(|at| &at.sags)?,
            displacement: all.vector(|passed| passed.at.deflection.displacement().into())?,
            magnitude: all.number(|passed| passed.at.deflection.displacement().norm())?,
            least_stiffness: all.number(|passed| passed.at.deflection.loaded.stability.least_stiffness())?,
            platform_frequency: all
                .number(|passed| passed.at.swing.map_or(f64::NAN, |swing| swing.platform))?,
            platform_share: all
                .number(|passed| passed.at.swing.map_or(f64::NAN, |swing| swing.platform_share))?,
            lowest_frequency: all.number(|passed| passed.at.swing.map_or(f64::NAN, |swing| swing.lowest))?,
            std: model.as_ref().map(|_| deviations()).transpose()?,
            loaded: Py::new(py, DirectSolution::new(&all.part(|passed| &passed.loaded), cables)?)?,
            reasons: all.reasons(),
            kinds: all.kinds(),
        })
    }
}

/// A number that may not exist.
fn number(value: Option<f64>) -> Vec<f64> {
    vec![value.unwrap_or(f64::NAN)]
}
