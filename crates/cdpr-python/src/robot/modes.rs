//! `Robot.modes`: natural frequencies and motions at a pose.

use crate::convert::{Answer, Columns, Loads, Numbers, Rows, answer, each, plotted};
use crate::robot::Robot;
use crate::robot::inverse::coordinates;
use cdpr_robot::Vector3;
use cdpr_statics::WantedPose;
use cdpr_statics::vibration::{NaturalMode, PoseModes, modes_at};
use pyo3::prelude::*;

answer! {
    /// Natural motions of the platform, of unit mass.
    ///
    /// The answer is of one pose, or of m: then every field has a first axis of m, with NaN where there is no
    /// answer, and `reasons` says why.
    #[pyclass(frozen, get_all, module = "cdpr")]
    pub(crate) struct Modes {
        /// Natural frequencies, ascending [Hz], (6,); of a point mass or a planar robot (3,), here and below.
        frequencies_hz: Py<PyAny>,
        /// Translation of P in each motion [1/sqrt(kg)], (6, 3).
        translations: Py<PyAny>,
        /// Rotation in each motion [rad/(m sqrt(kg))], (6, 3).
        rotations: Py<PyAny>,
        /// Share of each cable in the energy of each motion, (6, n).
        cable_shares: Py<PyAny>,
        /// Share of the weight in the energy of each motion, (6,).
        weight_shares: Py<PyAny>,
        /// The lowest frequency of each cable between ends at rest [Hz], (n,); NaN for one without mass. The
        /// motions take cables without mass: they hold where this is at least twice as high.
        cable_frequencies_hz: Py<PyAny>,
        /// Why there is no answer, None where there is one; None for one pose.
        reasons: Py<PyAny>,
        /// The kind of each failure, in the same form: `infeasible_tension`, ...
        kinds: Py<PyAny>,
    }
}

plotted!(Modes);

#[pymethods]
impl Robot {
    /// Computes the natural motions of the platform on cables without mass, the lengths held.
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
    /// free : sequence of str, optional
    ///     Names of the coordinates of the pose that are found, for a robot with fewer cables than free
    ///     motions, as `Robot.inverse` takes them.
    ///
    /// Returns
    /// -------
    /// Modes
    ///     Frequencies and motions.
    ///
    /// Raises
    /// ------
    /// InputError
    ///     For an invalid value; the message names it and what would be right; also where the robot has no
    ///     inertia.
    /// NoSolutionError
    ///     For one case without an answer; of several, its row has NaN and a reason.
    ///
    /// Examples
    /// --------
    /// >>> import cdpr
    /// >>> robot = cdpr.Robot.from_file("cogiro")
    /// >>> robot.modes([0, 0, 2]).frequencies_hz.shape  # [Hz]
    /// (6,)
    #[pyo3(signature = (pose, *, payload=None, force=None, moment=None, free=None))]
    fn modes(
        &self,
        py: Python,
        pose: Numbers,
        payload: Option<Numbers>,
        force: Option<Numbers>,
        moment: Option<Numbers>,
        free: Option<Vec<String>>,
    ) -> Answer<Modes> {
        let free = coordinates(free)?;
        let poses = Rows::poses("pose", &pose, &self.robot)?;
        let loads = Loads::new(force.as_ref(), moment.as_ref(), payload.as_ref(), &self.robot)?;
        let cases = loads.cases([&poses])?;
        let outcomes = each(py, cases.count, |case| {
            modes_at(&self.robot, WantedPose::at(&poses.pose(case)?).free(&free), &loads.load(case)?)
        })?;
        let all = Columns::new(py, cases, &outcomes)?;
        let count = self.robot.freedoms().count();
        let vectors = |vector: fn(&NaturalMode) -> Vector3<f64>| {
            all.numbers(&[count, 3], |PoseModes { modes, .. }: &PoseModes, out| {
                for (out, mode) in out.chunks_exact_mut(3).zip(modes) {
                    out.copy_from_slice(vector(mode).as_slice());
                }
            })
        };
        let cables = self.robot.cables.len();
        let each = |value: fn(&NaturalMode) -> f64| {
            all.numbers(&[count], |PoseModes { modes, .. }: &PoseModes, out| {
                out.iter_mut().zip(modes).for_each(|(out, mode)| *out = value(mode));
            })
        };
        Ok(Modes {
            frequencies_hz: each(|mode| mode.frequency)?,
            translations: vectors(|mode| mode.translation)?,
            rotations: vectors(|mode| mode.rotation)?,
            cable_shares: all.numbers(&[count, cables], |PoseModes { modes, .. }, out| {
                for (out, mode) in out.chunks_exact_mut(cables).zip(modes) {
                    out.copy_from_slice(&mode.cables);
                }
            })?,
            weight_shares: each(|mode| mode.weight)?,
            cable_frequencies_hz: all.numbers(&[cables], |found, out| {
                let each = found.cable_frequencies.iter().map(|of| of.unwrap_or(f64::NAN));
                out.iter_mut().zip(each).for_each(|(out, frequency)| *out = frequency);
            })?,
            reasons: all.reasons(),
            kinds: all.kinds(),
        })
    }
}
