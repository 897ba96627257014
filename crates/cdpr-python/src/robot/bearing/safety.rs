//! `Robot.safety`: what becomes of the platform when a cable breaks.

use crate::convert::{Answer, Columns, Loads, Numbers, Raised, Rows, answer, each, plotted};
use crate::robot::Robot;
use crate::robot::inverse::coordinates;
use cdpr_assess::{
    Breaks, Broken, BrokenRest, CaseFactors, FactoredCase, PartialFactors, Safety as Held, Swing,
    factored_cases, safety_at,
};
use cdpr_robot::Robot as Model;
use cdpr_statics::{StaticsError, WantedPose};
use pyo3::prelude::*;
use std::collections::BTreeMap;

answer! {
    /// What becomes of the platform when cables break, while the winches stand still.
    ///
    /// The k breaks are those of each cable alone, then those of all pairs, if asked for. The answer is of
    /// one pose, or of m: then every field has a first axis of m, with NaN where there is no answer, and
    /// `reasons` says why. Where no rest was found after a break, its numbers are NaN.
    #[pyclass(frozen, get_all, module = "cdpr")]
    pub(crate) struct Safety {
        /// Numbers of the broken cables, from 1: `"3"`, `"3+4"`; a list of k.
        broken: Py<PyAny>,
        /// How each break ends: `held`, `overloaded` (another cable is beyond its greatest tension or
        /// breaking force), `below_ground`, `turned_over` (by more than a right angle), `unknown` (the motion
        /// is not known, or its peak is too uncertain), or the kind of failure where no rest was found; a
        /// list of k.
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
        /// Least breaking force over greatest tension, (k,); NaN where a breaking force is not known.
        safety_factor: Py<PyAny>,
        /// Greatest distance of the platform from the pose in the motion that follows [m], (k,); NaN unless
        /// `swing` is given.
        swing_moved: Py<PyAny>,
        /// Greatest tension of the other cables in that motion, at either end [N], (k,).
        peak_tension: Py<PyAny>,
        /// Greatest utilization of a cable by partial factors, of the whole robot, then after each break,
        /// (k + 1,): tension under the design loads times the factor of the resistance over breaking force,
        /// at rest and in the motion that follows; NaN unless `factors` is given, and where it is not known.
        utilization: Py<PyAny>,
        /// Why a utilization is not known, empty where it is; a list of k + 1, empty unless `factors` is
        /// given.
        utilization_reasons: Py<PyAny>,
        /// Why there is no answer, None if there is one; None for one pose.
        reasons: Py<PyAny>,
        /// The kind of each failure, in the same form: `infeasible_tension`, ...
        kinds: Py<PyAny>,
    }
}

plotted!(Safety);

/// A factor, or one for the whole robot and one for broken cables, or one for weights and one for other
/// loads.
#[derive(FromPyObject)]
pub(crate) enum Factor {
    One(f64),
    Two(f64, f64),
}

impl Factor {
    fn both(&self) -> [f64; 2] {
        match *self {
            Self::One(factor) => [factor; 2],
            Self::Two(one, other) => [one, other],
        }
    }
}

/// Partial factors by their names: all four of them.
fn partial_factors(given: &BTreeMap<String, Factor>) -> Answer<PartialFactors> {
    const NAMES: [&str; 4] = ["permanent", "variable", "resistance", "accidental"];
    let refused = |name: &str, expected: &str| Raised::Input(format!("factors: {name}: expected {expected}"));
    if let Some(name) = given.keys().find(|name| !NAMES.contains(&name.as_str())) {
        return Err(refused(name, "permanent, variable, resistance and accidental"));
    }
    let of = |name: &str| {
        let missing = || refused(name, "a factor of the norm that you follow; none is assumed");
        given.get(name).ok_or_else(missing)
    };
    let one = |name: &str| match of(name)? {
        Factor::One(factor) => Ok(*factor),
        Factor::Two(..) => Err(refused(name, "one factor")),
    };
    let (permanent, variable) = (one(NAMES[0])?, one(NAMES[1])?);
    let [resistance, of_accident] = of(NAMES[2])?.both();
    let [weights, others] = of(NAMES[3])?.both();
    Ok(PartialFactors {
        persistent: CaseFactors { permanent, variable, resistance },
        accidental: CaseFactors { permanent: weights, variable: others, resistance: of_accident },
    })
}

/// Refuses a time that is not above zero, and a motion without the inertia that it needs.
fn check_swing(robot: &Model, swing: Option<f64>) -> Answer<()> {
    if swing.is_some_and(|time| time.is_nan() || time <= 0.0) {
        let given = swing.unwrap_or_default();
        return Err(Raised::Input(format!("swing is {given}: expected a time above 0 s")));
    }
    if swing.is_some() && robot.lacks_inertia() {
        let message = "platform.inertia is not given: a motion, `swing`, needs it";
        return Err(Raised::Input(message.to_owned()));
    }
    Ok(())
}

/// A robot at a pose, and the cases of its proof: none without factors.
struct Found {
    held: Held,
    cases: Vec<FactoredCase>,
}

impl Found {
    /// The utilization of a case.
    fn utilization(&self, case: usize) -> f64 {
        let most = self.cases.get(case).and_then(FactoredCase::utilization);
        most.map_or(f64::NAN, |most| most.value())
    }

    /// Why it is not known.
    fn reason(case: &FactoredCase) -> String {
        case.open().filter(|_| case.utilization().is_none()).unwrap_or_default()
    }
}

/// How a break ends, in one word.
fn ending(broken: &Broken) -> String {
    let swing = followed(broken);
    let word = match &broken.rest {
        Err(error) => error.kind(),
        Ok(rest) if rest.is_overloaded() || swing.is_some_and(Swing::is_overloaded) => "overloaded",
        Ok(rest) if rest.below_ground || swing.is_some_and(|swing| swing.below_ground) => "below_ground",
        Ok(rest) if rest.turns_over() => "turned_over",
        Ok(_) if broken.swing.is_some() && swing.is_none_or(|swing| swing.may_be_overloaded) => "unknown",
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
    /// The winches keep the lengths that hold the pose. The rest is the equilibrium downhill of the pose; on
    /// the way there the platform swings and tensions are greater; with `swing` that motion is followed,
    /// without damping. Arguments are of one case, or have a first axis of m cases.
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
    /// factors : dict, optional
    ///     Partial factors of a norm, all four: `permanent` multiplies the weight of platform and cables,
    ///     `variable` payload, force and moment, `resistance` divides the breaking forces (a pair: the second
    ///     one for broken cables), `accidental` multiplies the loads where a cable is broken (a pair:
    ///     weights, other loads).
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
    /// >>> factors = {"permanent": 1.35, "variable": 1.5, "resistance": 1.5, "accidental": 1.0}
    /// >>> cdpr.Robot.from_file("caroca").safety([0, 0, 1.75], factors=factors).utilization.shape
    /// (9,)
    #[pyo3(signature = (pose, *, payload=None, force=None, moment=None, pairs=false, swing=None, factors=None,
        free=None))]
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
        factors: Option<BTreeMap<String, Factor>>,
        free: Option<Vec<String>>,
    ) -> Answer<Safety> {
        let free = coordinates(free)?;
        let poses = Rows::poses("pose", &pose, &self.robot)?;
        let loads = Loads::new(force.as_ref(), moment.as_ref(), payload.as_ref(), &self.robot)?;
        let cases = loads.cases([&poses])?;
        check_swing(&self.robot, swing)?;
        let breaks = Breaks { pairs, follow: swing };
        let factors = factors.map(|given| partial_factors(&given)).transpose()?;
        let outcomes = each(py, cases.count, |case| {
            let (robot, load) = (&self.robot, loads.load(case)?);
            let held = safety_at(robot, WantedPose::at(&poses.pose(case)?).free(&free), &load, breaks)?;
            let proved = factors.as_ref().map(|factors| factored_cases(robot, &held, &load, factors, None));
            let cases = proved.transpose()?.unwrap_or_default();
            Ok::<_, StaticsError>(Found { held, cases })
        })?;
        let all = Columns::new(py, cases, &outcomes)?;
        let cables = self.robot.cables.len();
        let count = if pairs { cables * (cables + 1) / 2 } else { cables };
        let numbers = |width: usize, of: &dyn Fn(&BrokenRest, &mut [f64])| {
            let inner: &[usize] = if width == 1 { &[count] } else { &[count, width] };
            all.numbers(inner, |found: &Found, out| {
                for (out, broken) in out.chunks_exact_mut(width).zip(&found.held.broken) {
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
                for (out, broken) in out.iter_mut().zip(&found.held.broken) {
                    *out = followed(broken).map_or(f64::NAN, of);
                }
            })
        };
        Ok(Safety {
            broken: all.lists(|found| found.held.broken.iter().map(name).collect())?,
            endings: all.lists(|found| found.held.broken.iter().map(ending).collect())?,
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
            utilization: all.numbers(&[count + 1], |found: &Found, out| {
                out.iter_mut().enumerate().for_each(|(case, out)| *out = found.utilization(case));
            })?,
            utilization_reasons: all.lists(|found| found.cases.iter().map(Found::reason).collect())?,
            swing_moved: of_swing(&|swing| swing.moved)?,
            peak_tension: of_swing(&|swing| swing.greatest.0)?,
            reasons: all.reasons(),
            kinds: all.kinds(),
        })
    }
}
