//! `Robot.observe`: the deflections of robots that deviate from the nominal one, which every study observes.

use crate::convert::{Answer, Cases, Columns, Loads, Numbers, Raised, Rows, answer, plotted, run};
use crate::robot::Robot;
use crate::robot::inverse::coordinates;
use cdpr_robot::{Deviations, ParameterLayout, Vector3};
use cdpr_statics::batch::Observation;
use cdpr_statics::{Observer, StaticsError, WantedPose};
use pyo3::prelude::*;
use rayon::prelude::*;
use std::sync::atomic::Ordering;

answer! {
    /// Deflections of m robots, or of one; NaN where there is no answer, and `reasons` says why.
    #[pyclass(frozen, get_all, module = "cdpr")]
    pub(crate) struct Observations {
        /// Displacement dp of P [m], (3,).
        displacement: Py<PyAny>,
        /// Norm |dp| of the displacement [m].
        magnitude: Py<PyAny>,
        /// Why there is no answer, None if there is one; None for one robot.
        reasons: Py<PyAny>,
        /// The kind of each failure, in the same form: `infeasible_tension`, ...
        kinds: Py<PyAny>,
    }
}

plotted!(Observations);

/// Number of robots that a thread takes at a time.
const PART: usize = 256;

#[pymethods]
impl Robot {
    /// Computes the deflections under a load of robots whose k parameters deviate from those of this robot.
    ///
    /// This is what a study observes; each robot has lengths set for the pose. Several robots go through
    /// the vector unit at once: the answers agree with `deflection` to rounding, and each depends on its own
    /// row alone.
    ///
    /// Parameters
    /// ----------
    /// pose : array_like
    ///     Wanted pose under the platform's own weight, (3,) or (7,).
    /// deviations : array_like
    ///     Deviations of the parameters, in the order of `parameters` [SI units], (k,) or (m, k).
    /// payload, force, moment : array_like, optional
    ///     One load for all, as in `deflection`.
    /// free : sequence of str, optional
    ///     Names of the coordinates of the pose that this robot finds, as `Robot.inverse` takes them, for
    ///     one with fewer cables than free motions; deviating robots have lengths for the pose that it finds.
    ///
    /// Returns
    /// -------
    /// Observations
    ///     Displacements, a row for each robot.
    ///
    /// Raises
    /// ------
    /// InputError
    ///     For an invalid value; the message names it and what would be right.
    /// NoSolutionError
    ///     For one robot without an answer; of several, its row has NaN and a reason.
    ///
    /// Examples
    /// --------
    /// >>> import cdpr
    /// >>> robot = cdpr.Robot.from_file("cogiro")
    /// >>> deviations = [[0.0] * len(robot.parameters)] * 3
    /// >>> robot.observe([0, 0, 2], deviations, payload=50).displacement.shape  # [m]
    /// (3, 3)
    #[pyo3(signature = (pose, deviations, *, payload=None, force=None, moment=None, free=None))]
    #[allow(clippy::too_many_arguments)]
    fn observe(
        &self,
        py: Python,
        pose: Numbers,
        deviations: Numbers,
        payload: Option<Numbers>,
        force: Option<Numbers>,
        moment: Option<Numbers>,
        free: Option<Vec<String>>,
    ) -> Answer<Observations> {
        let free = coordinates(free)?;
        let pose = Rows::poses("pose", &pose, &self.robot)?;
        let loads = Loads::given(force.as_ref(), moment.as_ref(), payload.as_ref(), &self.robot)?;
        if !loads.cases([&pose])?.single {
            return Err(Raised::Input(
                "pose or load has a row for each case: expected one of each for all robots".to_owned(),
            ));
        }
        let rows = Rows::vectors("deviations", &deviations)?;
        let layout = ParameterLayout::of(&self.robot);
        let deviations = Deviations::new(&layout, rows.width(), rows.all())?;
        let cases = Cases::of(&[&rows])?;
        let (wanted, load) = (pose.pose(0)?, loads.load(0)?);
        let lanes = Observer::new(&self.robot, WantedPose::at(&wanted).free(&free), &load)?;
        let outcomes = run(py, |stop| {
            let part = |part: Deviations| -> Vec<Result<Vector3<f64>, StaticsError>> {
                if stop.load(Ordering::Relaxed) {
                    Vec::new()
                } else {
                    let observed = lanes.observe::<Observation>(&part).into_iter();
                    observed.map(|robot| robot.map(|robot| robot.displacement)).collect()
                }
            };
            let parts: Vec<_> = deviations.parts(PART).collect();
            parts.into_par_iter().flat_map_iter(part).collect::<Vec<_>>()
        })?;
        let all = Columns::new(py, cases, &outcomes)?;
        Ok(Observations {
            displacement: all.vector(|found: &Vector3<f64>| (*found).into())?,
            magnitude: all.number(|found: &Vector3<f64>| found.norm())?,
            reasons: all.reasons(),
            kinds: all.kinds(),
        })
    }
}
