//! `Robot.capacity`: what a robot can carry at a pose, and how far its tensions are from their limits.

use crate::convert::{Answer, Array, Columns, Loads, Numbers, Raised, Rows, answer, each, plotted};
use crate::robot::Robot;
use crate::robot::inverse::coordinates;
use cdpr_assess::{Clearance, Figure, Tilt, WrenchSet, capacity_at, clearance_under, tilt_at};
use cdpr_robot::{Vector6, Wrench};
use cdpr_statics::{StaticsError, WantedPose};
use pyo3::prelude::*;

answer! {
    /// What can be carried at a pose, for the wrench that leaves the least.
    ///
    /// The answer is of one pose, or of m: then every field has a first axis of m, with NaN where there is no
    /// answer, and `reasons` says why. A payload is -inf where a limit is passed even without one, and inf
    /// where its weight does not pull at the cables. With `recomputed` the winches compute the tensions
    /// again, with `kept` the lengths are kept.
    #[pyclass(frozen, get_all, module = "cdpr")]
    pub(crate) struct Capacity {
        /// Greatest mass at the centre of mass [kg].
        payload_recomputed: Py<PyAny>,
        /// Greatest mass at the centre of mass until a tension reaches any of its limits [kg].
        payload_kept: Py<PyAny>,
        /// The same, whichever cables become slack [kg].
        payload_kept_slack: Py<PyAny>,
        /// Distance of the tensions from the nearest limit [N].
        margin_recomputed: Py<PyAny>,
        /// Distance of the tensions from the nearest limit [N].
        margin_kept: Py<PyAny>,
        /// What blocks each of these five, in words, or why it does not exist; a list of five.
        blocked_by: Py<PyAny>,
        /// Distance of the surfaces of the nearest two cables [m].
        nearest_cables: Py<PyAny>,
        /// Distance of the cable nearest to the platform's hull [m].
        nearest_to_platform: Py<PyAny>,
        /// How far the platform may tilt towards each azimuth [rad], (tilt,); (0,) if not asked for.
        tilt: Py<PyAny>,
        /// Why there is no answer, None if there is one; None for one pose.
        reasons: Py<PyAny>,
        /// The kind of each failure, in the same form: `infeasible_tension`, ...
        kinds: Py<PyAny>,
    }
}

plotted!(Capacity);

/// Accuracy of the tilt [rad].
const TILT_ACCURACY: f64 = 1e-4;

/// Wrenches, fx to mz one below the other.
fn wrench_set(numbers: &Numbers) -> Answer<WrenchSet> {
    let Array { shape, values } = Array::new("wrenches", numbers)?;
    if !matches!(shape[..], [_, 6]) {
        return Err(Raised::Input(format!("wrenches has the shape {shape:?}: expected (k, 6)")));
    }
    let wrenches = values.chunks_exact(6).map(|row| Wrench::from_vector(&Vector6::from_row_slice(row)));
    Ok(WrenchSet::of(wrenches.collect()))
}

struct Found {
    figures: [Result<Figure, StaticsError>; 5],
    clearance: Option<Clearance>,
    tilt: Option<Tilt>,
}

#[pymethods]
impl Robot {
    /// Finds what the cables can carry at a pose besides the platform, and how far the limits are.
    ///
    /// Arguments are of one case, or have a first axis of m cases.
    ///
    /// Parameters
    /// ----------
    /// pose : array_like
    ///     x, y, z [m], or x, y, z, qw, qx, qy, qz, (3,) or (7,).
    /// payload : array_like, optional
    ///     Mass that the platform carries there, at its centre of mass [kg].
    /// force, moment : array_like, optional
    ///     On the platform in the base frame, about P [N, N m], (3,).
    /// wrenches : array_like, optional
    ///     Wrenches that may act with the load, fx to mz about P [N, N m], (k, 6); all poses have the
    ///     same.
    /// tilt : int, default 0
    ///     Number of azimuths, from x to y, towards which the platform is tilted as far as tensions within
    ///     the limits hold it; 0 leaves it out.
    /// free : sequence of str, optional
    ///     Names of the coordinates of the pose that are found, for a robot with fewer cables than free
    ///     motions, as `Robot.inverse` takes them.
    ///
    /// Returns
    /// -------
    /// Capacity
    ///     Payloads, margins and distances.
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
    /// >>> robot.capacity([[0, 0, 2], [1, 0, 2]]).payload_recomputed.shape  # [kg]
    /// (2,)
    #[pyo3(signature = (pose, *, payload=None, force=None, moment=None, wrenches=None, tilt=0, free=None))]
    #[allow(clippy::too_many_arguments)]
    fn capacity(
        &self,
        py: Python,
        pose: Numbers,
        payload: Option<Numbers>,
        force: Option<Numbers>,
        moment: Option<Numbers>,
        wrenches: Option<Numbers>,
        tilt: usize,
        free: Option<Vec<String>>,
    ) -> Answer<Capacity> {
        let free = coordinates(free)?;
        let poses = Rows::poses("pose", &pose, &self.robot)?;
        let loads = Loads::new(force.as_ref(), moment.as_ref(), payload.as_ref(), &self.robot)?;
        let cases = loads.cases([&poses])?;
        let set = wrenches.as_ref().map(wrench_set).transpose()?.unwrap_or_else(|| WrenchSet::of(Vec::new()));
        let outcomes = each(py, cases.count, |case| {
            let (pose, load) = (poses.pose(case)?, loads.load(case)?);
            let found = capacity_at(&self.robot, WantedPose::at(&pose).free(&free), &load, &set);
            // Whatever else fails, fails with it.
            if let (Err(error), Err(_)) = (&found.payload_kept, &found.margin_recomputed) {
                return Err(error.clone());
            }
            let tilted = || tilt_at(&self.robot, &pose, &load, tilt, TILT_ACCURACY);
            Ok(Found {
                clearance: clearance_under(&self.robot, WantedPose::at(&pose).free(&free), &load).ok(),
                tilt: (tilt > 0).then(tilted).transpose()?,
                figures: [
                    found.payload_recomputed,
                    found.payload_kept,
                    found.payload_kept_slack,
                    found.margin_recomputed,
                    found.margin_kept,
                ],
            })
        })?;
        let directions = outcomes.iter().flatten().filter_map(|found| found.tilt.as_ref());
        let directions = directions.map(|tilt| tilt.directions.len()).max().unwrap_or(0);
        let all = Columns::new(py, cases, &outcomes)?;
        let figure =
            |k: usize| all.number(|found| found.figures[k].as_ref().map_or(f64::NAN, |figure| figure.value));
        let words = |found: &Found| {
            let words = |figure: &Result<Figure, StaticsError>| match figure {
                Ok(figure) => figure.blocked_by(),
                Err(error) => error.to_string(),
            };
            found.figures.iter().map(words).collect()
        };
        Ok(Capacity {
            payload_recomputed: figure(0)?,
            payload_kept: figure(1)?,
            payload_kept_slack: figure(2)?,
            margin_recomputed: figure(3)?,
            margin_kept: figure(4)?,
            blocked_by: all.lists(words)?,
            nearest_cables: all.number(|found| {
                found.clearance.as_ref().and_then(|near| near.cables).map_or(f64::NAN, |near| near.distance)
            })?,
            nearest_to_platform: all.number(|found| {
                found.clearance.as_ref().and_then(|near| near.platform).map_or(f64::NAN, |near| near.distance)
            })?,
            tilt: all.numbers(&[directions], |found, out| {
                let angles = found.tilt.iter().flat_map(|tilt| &tilt.directions);
                out.iter_mut().zip(angles).for_each(|(out, towards)| *out = towards.angle);
            })?,
            reasons: all.reasons(),
            kinds: all.kinds(),
        })
    }
}
