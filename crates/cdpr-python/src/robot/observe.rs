//! `Robot.observe`: the deflections of robots that deviate from the nominal one, which every study observes.

use crate::convert::{Answer, Cases, Columns, Loads, Numbers, Raised, Rows, answer, run};
use crate::robot::Robot;
use cdpr_robot::Parameter;
use cdpr_statics::{Observation, Observer};
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
        rms: Py<PyAny>,
        /// Why there is no answer, None where there is one; None for one robot.
        reasons: Py<PyAny>,
        /// The kind of each failure, in the same form: `infeasible_tension`, ...
        kinds: Py<PyAny>,
    }
}

/// Number of robots that a thread takes at a time.
const PART: usize = 256;

#[pymethods]
impl Robot {
    /// Computes the deflections under a load of robots whose k parameters deviate from those of this robot.
    ///
    /// This is what a study observes; each robot has its cables wound for the pose. Several robots go through
    /// the vector unit at once: the answers agree with `deflection` to rounding, and each depends on its own
    /// row alone.
    ///
    /// pose: wanted pose under the platform's own weight, (3,) or (7,).
    /// deviations: deviations of the parameters, in the order of `parameters` [SI units], (k,) or (m, k).
    /// payload, force, moment: one load for all, as in `deflection`.
    ///
    /// Raises InputError; for one robot NoSolutionError.
    #[pyo3(signature = (pose, deviations, *, payload=None, force=None, moment=None))]
    fn observe(
        &self,
        py: Python,
        pose: Numbers,
        deviations: Numbers,
        payload: Option<Numbers>,
        force: Option<Numbers>,
        moment: Option<Numbers>,
    ) -> Answer<Observations> {
        let pose = Rows::poses("pose", &pose)?;
        let loads = Loads::given(force.as_ref(), moment.as_ref(), payload.as_ref())?;
        if !loads.cases([&pose])?.single {
            return Err(Raised::Input(
                "pose or load has a row for each case: expected one of each for all robots".to_owned(),
            ));
        }
        let parameters = Parameter::of(&self.robot).len();
        let rows = Rows::vectors("deviations", &deviations)?;
        if rows.width() != parameters {
            let width = rows.width();
            return Err(Raised::Input(format!(
                "deviations has {width} numbers a row: expected {parameters}, as `parameters`"
            )));
        }
        let cases = Cases::of(&[&rows])?;
        let observer = Observer::new(&self.robot, &pose.pose(0)?, &loads.load(0)?)?;
        let outcomes = run(py, |stop| {
            let part = |part: &[f64]| {
                if stop.load(Ordering::Relaxed) { Vec::new() } else { observer.observe_all(part) }
            };
            rows.all().par_chunks(PART * parameters).flat_map_iter(part).collect::<Vec<_>>()
        })?;
        let all = Columns::new(py, cases, &outcomes)?;
        Ok(Observations {
            displacement: all.vector(|found| found.displacement.into())?,
            rms: all.number(Observation::rms)?,
            reasons: all.reasons(),
            kinds: all.kinds(),
        })
    }
}
