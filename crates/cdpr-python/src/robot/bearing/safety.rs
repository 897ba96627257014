//! `Robot.safety`: what becomes of the platform when a cable breaks.

use crate::convert::{Answer, Columns, Loads, Numbers, Raised, Rows, answer, each, plotted};
use crate::robot::Robot;
use crate::robot::inverse::coordinates;
use cdpr_assess::{Breaks, Broken, BrokenRest, Safety as Found, Swing, safety_at};
use cdpr_statics::WantedPose;
use pyo3::prelude::*;

answer! {
    /// What becomes of the platform when cables break, while the winches stand still.
    ///
    /// The k breaks are those of each cable alone, then those of all pairs, if asked for. The answer is of one
    /// pose, or of m: then every field has a first axis of m, with NaN where there is no answer, and `reasons`
    /// says why. Where no rest was found after a break, its numbers are NaN.
    #[pyclass(frozen, get_all, module = "cdpr")]
    pub(crate) struct Safety {
        /// Numbers of the broken cables, from 1: `"3"`, `"3+4"`; a list of k.
        broken: Py<PyAny>,
        /// How each break ends: `held`, `overloaded` (another cable is beyond its greatest tension or breaking
        /// force), `below_ground`, `turned_over` (by more than a right angle), or the kind of failure where no rest
        /// was found; a list of k.
        endings: Py<PyAny>,
        /// How far the platform moves [m], (k,).
        moved: Py<PyAny>,
        /// How far it turns [rad], (k,).
        turned: Py<PyAny>,
        /// Where it comes to rest: x, y, z [m], qw, qx, qy, qz, (k, 7).
        poses: Py<PyAny>,
        /// Tensions at the platform there [N], zero in a broken cable, (k, n).
        tensions: Py<PyAny>,
        /// Tensions at the exit points there [N], (k, n).
        exit_tensions: Py<PyAny>,
        /// Least breaking force over greatest tension, (k,); NaN where no breaking force is known.
        safety_factor: Py<PyAny>,
        /// Greatest distance of the platform from the pose in the motion that follows [m], (k,); NaN unless
        /// `swing` is given.
        swing_moved: Py<PyAny>,
        /// Greatest tension of the other cables in that motion, at either end [N], (k,).
        peak_tension: Py<PyAny>,
        /// Why there is no answer, None where there is one; None for one pose.
        reasons: Py<PyAny>,
        /// The kind of each failure, in the same form: `infeasible_tension`, ...
        kinds: Py<PyAny>,
    }
}

plotted!(Safety);

/// How a break ends, in one word.
fn ending(broken: &Broken) -> String {
    let swing = followed(broken);
    let word = match &broken.rest {
        Err(error) => error.kind(),
        Ok(rest) if rest.is_overloaded() || swing.is_some_and(Swing::is_overloaded) => "overloaded",
        Ok(rest) if rest.below_ground || swing.is_some_and(|swing| swing.below_ground) => "below_ground",
        Ok(rest) if rest.turns_over() => "turned_over",
        Ok(_) => "held",
    };
    word.to_owned()
}

/// The motion, where it is known.
fn followed(broken: &Broken) -> Option<&Swing> {
    broken.swing.as_ref()?.as_ref().ok()
}

fn name(broken: &Broken) -> String {
    broken.cables.iter().map(|i| (i + 1).to_string()).collect::<Vec<_>>().join("+")
}

#[pymethods]
impl Robot {
    /// Finds where the platform comes to rest when a cable breaks, and whether the others bear that.
    ///
    /// The winches keep the lengths that hold the pose. The rest is the equilibrium downhill of the pose; on the
    /// way there the platform swings and tensions are greater; with `swing` that motion is followed, without
    /// damping. Arguments are of one case, or have a first axis of m cases.
    ///
    /// Parameters
    /// ----------
    /// pose : array_like
    ///     x, y, z [m], or x, y, z, qw, qx, qy, qz, (3,) or (7,).
    /// payload : array_like, optional
    ///     Mass that the platform carries there, at its centre of mass [kg].
    /// force, moment : array_like, optional
    ///     On the platform in the base frame, about P [N, N m], (3,).
    /// pairs : bool, default False
    ///     Whether every pair of cables breaks, too.
    /// swing : float, optional
    ///     For how long the motion after each break is followed [s].
    /// free : sequence of str, optional
    ///     Names of the coordinates of the pose that are found, for a robot with fewer cables than free
    ///     motions, as `Robot.inverse` takes them.
    ///
    /// Returns
    /// -------
    /// Safety
    ///     The end of each break.
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
    /// >>> robot.safety([0, 0, 2]).moved.shape  # [m]
    /// (8,)
    #[pyo3(signature = (pose, *, payload=None, force=None, moment=None, pairs=false, swing=None, free=None))]
    #[allow(clippy::too_many_arguments)]
    fn safety(
        &self,
        py: Python,
        pose: Numbers,
        payload: Option<Numbers>,
        force: Option<Numbers>,
        moment: Option<Numbers>,
        pairs: bool,
        swing: Option<f64>,
        free: Option<Vec<String>>,
    ) -> Answer<Safety> {
        let free = coordinates(free)?;
        let poses = Rows::poses("pose", &pose, &self.robot)?;
        let loads = Loads::new(force.as_ref(), moment.as_ref(), payload.as_ref(), &self.robot)?;
        let cases = loads.cases([&poses])?;
        if swing.is_some_and(|time| time.is_nan() || time <= 0.0) {
            let given = swing.unwrap_or_default();
            return Err(Raised::Input(format!("swing is {given}: expected a time above 0 s")));
        }
        if swing.is_some() && self.robot.lacks_inertia() {
            let message = "platform.inertia is not given: a motion, `swing`, needs it";
            return Err(Raised::Input(message.to_owned()));
        }
        let breaks = Breaks { pairs, follow: swing };
        let outcomes = each(py, cases.count, |case| {
            safety_at(&self.robot, WantedPose::at(&poses.pose(case)?).free(&free), &loads.load(case)?, breaks)
        })?;
        let all = Columns::new(py, cases, &outcomes)?;
        let cables = self.robot.cables.len();
        let count = if pairs { cables * (cables + 1) / 2 } else { cables };
        let numbers = |width: usize, of: &dyn Fn(&BrokenRest, &mut [f64])| {
            let inner: &[usize] = if width == 1 { &[count] } else { &[count, width] };
            all.numbers(inner, |found: &Found, out| {
                for (out, broken) in out.chunks_exact_mut(width).zip(&found.broken) {
                    if let Ok(rest) = &broken.rest {
                        of(rest, out);
                    }
                }
            })
        };
        let tensions = |end: usize| {
            numbers(cables, &|rest, out| {
                out.iter_mut().zip(&rest.tensions).for_each(|(out, ends)| *out = ends[end]);
            })
        };
        let of_swing = |of: &dyn Fn(&Swing) -> f64| {
            all.numbers(&[count], |found: &Found, out| {
                for (out, broken) in out.iter_mut().zip(&found.broken) {
                    *out = followed(broken).map_or(f64::NAN, of);
                }
            })
        };
        Ok(Safety {
            broken: all.lists(|found| found.broken.iter().map(name).collect())?,
            endings: all.lists(|found| found.broken.iter().map(ending).collect())?,
            moved: numbers(1, &|rest, out| out[0] = rest.moved)?,
            turned: numbers(1, &|rest, out| out[0] = rest.turned)?,
            poses: numbers(7, &|rest, out| {
                out[..3].copy_from_slice(rest.pose.position.as_slice());
                out[3..].copy_from_slice(&rest.pose.quaternion());
            })?,
            tensions: tensions(0)?,
            exit_tensions: tensions(1)?,
            safety_factor: numbers(1, &|rest, out| {
                out[0] = rest.safety_factor.map_or(f64::NAN, |(factor, _)| factor);
            })?,
            swing_moved: of_swing(&|swing| swing.moved)?,
            peak_tension: of_swing(&|swing| swing.greatest.0)?,
            reasons: all.reasons(),
            kinds: all.kinds(),
        })
    }
}
