//! `Robot.modes` and `Robot.massless_modes`: natural frequencies and motions at a pose.

use crate::convert::{Answer, Columns, Loads, Numbers, Raised, Rows, answer, each, plotted};
use crate::robot::Robot;
use crate::robot::inverse::coordinates;
use cdpr_dynamics::{Mode, Rotor, Wanted};
use cdpr_robot::Vector3;
use cdpr_statics::vibration::{NaturalMode, PoseModes, modes_at};
use cdpr_statics::{StaticsError, WantedPose};
use pyo3::prelude::*;

answer! {
    /// Natural motions of the platform on cables without mass, of unit mass.
    ///
    /// The answer is of one pose, or of m: then every field has a first axis of m, with NaN where there is no
    /// answer, and `reasons` says why.
    #[pyclass(frozen, get_all, module = "cdpr")]
    pub(crate) struct MasslessModes {
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
        /// The lowest frequency of each cable between ends at rest [Hz], (n,); NaN for one without mass.
        /// Where it is less than twice as high, the cables' mass changes the motions: see `Robot.modes`.
        cable_frequencies_hz: Py<PyAny>,
        /// Why there is no answer, None if there is one; None for one pose.
        reasons: Py<PyAny>,
        /// The kind of each failure, in the same form: `infeasible_tension`, ...
        kinds: Py<PyAny>,
    }
}

plotted!(MasslessModes);

answer! {
    /// Natural motions of platform and cables, of unit mass.
    ///
    /// The answer is of one pose, or of m: then every field has a first axis of m, with NaN where there is no
    /// answer, and `reasons` says why. There are k motions, as many as wanted, or as a frequency bounds: then
    /// poses with fewer than others have NaN for those that are missing.
    #[pyclass(frozen, get_all, module = "cdpr")]
    pub(crate) struct Modes {
        /// Natural frequencies, ascending [Hz], (k,).
        frequencies_hz: Py<PyAny>,
        /// Greatest relative error of each frequency that the counts leave, (k,).
        within: Py<PyAny>,
        /// Share of the platform in the kinetic energy of each motion, (k,).
        platform_shares: Py<PyAny>,
        /// Part of it that is the platform's slowest motion on cables without mass, (k,). The platform swings
        /// with the motion that has the largest one of all, which may lie above those that are found.
        swing_shares: Py<PyAny>,
        /// Share of each cable in the kinetic energy of each motion, (k, n).
        cable_shares: Py<PyAny>,
        /// Translation of P in each motion [1/sqrt(kg)], (k, 3).
        translations: Py<PyAny>,
        /// Rotation in each motion [rad/(m sqrt(kg))], (k, 3).
        rotations: Py<PyAny>,
        /// Frequency up to which no motion is missing [Hz].
        complete_below_hz: Py<PyAny>,
        /// Why there is no answer, None if there is one; None for one pose.
        reasons: Py<PyAny>,
        /// The kind of each failure, in the same form: `infeasible_tension`, ...
        kinds: Py<PyAny>,
    }
}

plotted!(Modes);

/// The rotor of each winch, if it has a servo.
fn rotor(servo: Option<f64>, winch: f64) -> Answer<Option<Rotor>> {
    match servo {
        None if winch != 0.0 => {
            let expected = "0, or a servo, too: free rotors hold no platform";
            Err(Raised::Input(format!("winch is {winch}: expected {expected}")))
        }
        stiffness => Ok(stiffness.map(|stiffness| Rotor { mass: winch, stiffness })),
    }
}

#[pymethods]
impl Robot {
    /// Computes the natural motions of platform and cables, the lengths held.
    ///
    /// Cables have mass: where they vibrate about as fast as the platform, they move together with it. None
    /// of the motions is missing, which a count proves. Arguments are of one case, or have a first axis of m
    /// cases.
    ///
    /// Parameters
    /// ----------
    /// pose : array_like
    ///     x, y, z [m], or x, y, z, qw, qx, qy, qz, (3,) or (7,).
    /// number : int, optional
    ///     This many motions, the slowest.
    /// below : float, optional
    ///     All motions up to this frequency [Hz], instead of a number.
    /// servo : float, optional
    ///     Stiffness with which each winch holds its cable at the drum [N/m]; without it winches hold.
    /// winch : float, default 0
    ///     Inertia of the rotor of each winch by the square of the drum's radius [kg], with `servo`. The
    ///     share of a cable contains that of its rotor.
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
    ///     Frequencies, shares and motions.
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
    /// >>> robot.modes([0, 0, 2], below=6).frequencies_hz.shape  # [Hz]
    /// (18,)
    #[pyo3(signature = (pose, *, number=12, below=None, servo=None, winch=0.0, payload=None, force=None,
        moment=None, free=None))]
    #[allow(clippy::too_many_arguments)]
    fn modes(
        &self,
        py: Python,
        pose: Numbers,
        number: usize,
        below: Option<f64>,
        servo: Option<f64>,
        winch: f64,
        payload: Option<Numbers>,
        force: Option<Numbers>,
        moment: Option<Numbers>,
        free: Option<Vec<String>>,
    ) -> Answer<Modes> {
        let free = coordinates(free)?;
        let poses = Rows::poses("pose", &pose, &self.robot)?;
        let loads = Loads::new(force.as_ref(), moment.as_ref(), payload.as_ref(), &self.robot)?;
        let cases = loads.cases([&poses])?;
        let wanted = below.map_or(Wanted::Number(number), Wanted::Below);
        let winches = rotor(servo, winch)?;
        let outcomes: Vec<Result<cdpr_dynamics::Modes, StaticsError>> = each(py, cases.count, |case| {
            let (pose, load) = (poses.pose(case)?, loads.load(case)?);
            let pose = WantedPose::at(&pose).free(&free);
            Ok(cdpr_dynamics::Modes::at(&self.robot, pose, &load, wanted, winches)?)
        })?;
        let count = outcomes.iter().flatten().map(|found| found.modes.len()).max().unwrap_or(0);
        let all = Columns::new(py, cases, &outcomes)?;
        let rows = |width: usize, fill: &dyn Fn(&Mode, &mut [f64])| {
            let inner = if width == 1 { vec![count] } else { vec![count, width] };
            all.numbers(&inner, |found: &cdpr_dynamics::Modes, out| {
                out.fill(f64::NAN);
                out.chunks_exact_mut(width).zip(&found.modes).for_each(|(out, mode)| fill(mode, out));
            })
        };
        Ok(Modes {
            frequencies_hz: rows(1, &|mode, out| out[0] = mode.frequency)?,
            within: rows(1, &|mode, out| out[0] = mode.within)?,
            platform_shares: rows(1, &|mode, out| out[0] = mode.platform_share)?,
            swing_shares: rows(1, &|mode, out| out[0] = mode.swing_share)?,
            cable_shares: rows(self.robot.cables.len(), &|mode, out| {
                out.copy_from_slice(&mode.cable_shares);
            })?,
            translations: rows(3, &|mode, out| out.copy_from_slice(mode.translation.as_slice()))?,
            rotations: rows(3, &|mode, out| out.copy_from_slice(mode.rotation.as_slice()))?,
            complete_below_hz: all.number(|found| found.complete_below)?,
            reasons: all.reasons(),
            kinds: all.kinds(),
        })
    }

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
    /// MasslessModes
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
    /// >>> robot.massless_modes([0, 0, 2]).frequencies_hz.shape  # [Hz]
    /// (6,)
    #[pyo3(signature = (pose, *, payload=None, force=None, moment=None, free=None))]
    fn massless_modes(
        &self,
        py: Python,
        pose: Numbers,
        payload: Option<Numbers>,
        force: Option<Numbers>,
        moment: Option<Numbers>,
        free: Option<Vec<String>>,
    ) -> Answer<MasslessModes> {
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
        Ok(MasslessModes {
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
