//! `Robot.move`: set points of the winches for a move from rest to rest.

use crate::convert::{Answer, Cases, Columns, Loads, Numbers, Raised, Rows, answer, plotted, run};
use crate::robot::Robot;
use crate::robot::motion::simulate::seven;
use cdpr_dynamics::DynamicsError;
use cdpr_dynamics::moves::{Excited, FeedForward, Residual, SetPoint, Shaper, ShaperKind, residual};
use cdpr_dynamics::simulate::Profile;
use cdpr_robot::Pose;
use cdpr_statics::StaticsError;
use pyo3::prelude::*;

answer! {
    /// Set points of the winches for a move of a robot, at m times.
    #[pyclass(frozen, get_all, module = "cdpr")]
    pub(crate) struct Move {
        /// Times [s], (m,).
        times: Py<PyAny>,
        /// Wanted poses, x, y, z, qw, qx, qy, qz, (m, 7).
        poses: Py<PyAny>,
        /// Unstrained lengths [m], (m, n).
        lengths: Py<PyAny>,
        /// Their part for the motion: the differences to those at rest there [m], (m, n).
        feed_forward: Py<PyAny>,
        /// Tension of each cable at the platform in motion [N], (m, n).
        tensions: Py<PyAny>,
        /// Tension of each cable at its exit point in motion [N], (m, n).
        exit_tensions: Py<PyAny>,
        /// The shaper, and what swings.
        summary: Py<MoveSummary>,
    }
}

plotted!(Move);

answer! {
    /// The shaper of a move with k impulses for j natural motions, and what swings after the move.
    #[pyclass(frozen, get_all, module = "cdpr")]
    pub(crate) struct MoveSummary {
        /// Time [s] and amplitude of each impulse of the shaper, (k, 2).
        impulses: Py<PyAny>,
        /// Natural frequencies that the shaper is for [Hz], (j,).
        frequencies_hz: Py<PyAny>,
        /// Share of critical damping of these motions, (j,).
        damping_ratios: Py<PyAny>,
        /// Share of the platform in their kinetic energy, (j,).
        platform_shares: Py<PyAny>,
        /// Greatest distance of P from its rest after the move [m]; NaN without `residual`, as all below.
        amplitude: Py<PyAny>,
        /// The same of the move without shaper and feed-forward [m].
        unshaped_amplitude: Py<PyAny>,
        /// Greatest distance of P from the wanted pose on the way [m].
        deviation: Py<PyAny>,
        /// The same of the move without shaper and feed-forward [m].
        unshaped_deviation: Py<PyAny>,
        /// Greatest difference of the position of P to a coarser computation [m].
        position_difference: Py<PyAny>,
        /// Whether each cable loses its tension in one of both moves, (n,).
        slack: Py<PyAny>,
    }
}

/// A move that was planned.
struct Planned {
    points: Vec<SetPoint>,
    shaper: Shaper,
    modes: Vec<Excited>,
    /// What the move leaves, and the one without shaper and feed-forward.
    after: Option<[Residual; 2]>,
}

#[pymethods]
impl Robot {
    /// Plans a move along poses from rest to rest, as `cdpr path --with seconds=S` does.
    ///
    /// The way is one smooth curve through all poses, a straight one between two. The platform does not swing
    /// where the motion is split by an input shaper, or the lengths account for the inertia.
    ///
    /// Parameters
    /// ----------
    /// poses : array_like
    ///     x, y, z [m], or x, y, z, qw, qx, qy, qz, (m, 3) or (m, 7).
    /// seconds : float
    ///     Duration, that of the shaper included [s].
    /// profile : {"trapezoid", "cosine", "polynomial"}, optional
    ///     How the share of the way changes over time; "polynomial" with feed-forward, otherwise "cosine".
    /// shaper : {"zv", "zvd", "ei"}, optional
    ///     Input shaper, from the shortest to the least sensitive one.
    /// modes : int, default 2
    ///     For how many natural motions at most, those that swing most.
    /// feed_forward : {"platform", "cables"}, optional
    ///     Which inertia the lengths account for; "cables" is that of platform and cables.
    /// rate : float, default 200
    ///     Set points for each second [Hz].
    /// damping : float, default 0
    ///     Ratio of the viscous to the elastic modulus of the cables [s].
    /// residual : float, optional
    ///     Simulates the move and this long after it [s].
    /// payload : float, optional
    ///     Mass that the platform carries, at its centre of mass [kg].
    /// force, moment : array_like, optional
    ///     On the platform in the base frame, about P, all the time [N, N m], (3,).
    ///
    /// Returns
    /// -------
    /// Move
    ///     Set points over time; `lengths` and `times` are an event of `Robot.simulate`.
    ///
    /// Raises
    /// ------
    /// InputError
    ///     For an invalid value; the message names it and what would be right; also where the robot has no
    ///     inertia.
    /// NoSolutionError
    ///     Where a pose is not held, the lengths jump, or the move is too fast.
    ///
    /// Examples
    /// --------
    /// >>> import cdpr
    /// >>> robot = cdpr.Robot.from_file("cogiro")
    /// >>> move = robot.move([[-0.5, 0, 2], [0.5, 0, 2]], 1.0, shaper="zvd", rate=100)
    /// >>> move.lengths.shape, len(move.summary.frequencies_hz)  # [m]
    /// ((101, 8), 2)
    #[pyo3(name = "move", signature = (poses, seconds, *, profile=None, shaper=None, modes=2,
        feed_forward=None, rate=200.0, damping=0.0, residual=None, payload=None, force=None, moment=None))]
    #[allow(clippy::too_many_arguments)]
    fn move_along(
        &self,
        py: Python,
        poses: Numbers,
        seconds: f64,
        profile: Option<&str>,
        shaper: Option<&str>,
        modes: usize,
        feed_forward: Option<&str>,
        rate: f64,
        damping: f64,
        residual: Option<f64>,
        payload: Option<Numbers>,
        force: Option<Numbers>,
        moment: Option<Numbers>,
    ) -> Answer<Move> {
        let robot = &self.robot;
        let poses = Rows::poses("poses", &poses, robot)?;
        let poses = (0..poses.number()).map(|k| poses.pose(k)).collect::<Result<Vec<Pose>, _>>()?;
        let loads = Loads::new(force.as_ref(), moment.as_ref(), payload.as_ref(), robot)?;
        if !loads.cases([])?.single {
            let message = "payload, force or moment has several rows: expected one load for the whole move";
            return Err(Raised::Input(message.to_owned()));
        }
        let feed_forward = chosen("feed_forward", feed_forward, &FeedForward::NAMED)?.unwrap_or_default();
        let plain = cdpr_dynamics::moves::Move {
            robot,
            load: loads.load(0)?,
            poses: &poses,
            seconds,
            profile: chosen("profile", profile, &Profile::SMOOTH)?
                .unwrap_or_else(|| feed_forward.usual_profile()),
            shaper: Shaper::default(),
            feed_forward: FeedForward::None,
            rate,
        };
        let kind = chosen("shaper", shaper, &ShaperKind::NAMED)?;
        let found = run(py, |_| planned(&plain, feed_forward, (kind, modes, damping), residual))??;
        Move::new(py, &found, robot.cables.len())
    }
}

/// The value of a name.
fn chosen<T: Copy>(field: &str, given: Option<&str>, named: &[(&str, T)]) -> Answer<Option<T>> {
    let Some(given) = given else { return Ok(None) };
    let found = named.iter().find(|(name, _)| *name == given);
    let names: Vec<&str> = named.iter().map(|(name, _)| *name).collect();
    let message = || format!("{field} is {given:?}: expected {}", names.join(", "));
    found.map(|(_, value)| Some(*value)).ok_or_else(|| Raised::Input(message()))
}

/// Plans a move, and simulates it for a time after its end [s] where that is wanted.
fn planned(
    plain: &cdpr_dynamics::moves::Move,
    feed_forward: FeedForward,
    (shaper, most, damping): (Option<ShaperKind>, usize, f64),
    after: Option<f64>,
) -> Result<Planned, DynamicsError> {
    let mut wanted = cdpr_dynamics::moves::Move { feed_forward, ..plain.clone() };
    let mut modes = Vec::new();
    if let Some(kind) = shaper {
        (wanted, modes) = wanted.shaped(kind, most, damping)?;
    }
    let points = wanted.plan()?;
    let both = |seconds: f64| -> Result<[Residual; 2], DynamicsError> {
        let settings = wanted.watched(Some(seconds), damping)?;
        let left = |points: &[SetPoint]| residual(plain.robot, &plain.load, points, &[], &settings);
        Ok([left(&points)?, left(&plain.plan()?)?])
    };
    let after = after.map(both).transpose()?;
    Ok(Planned { points, shaper: wanted.shaper, modes, after })
}

impl Move {
    fn new(py: Python, planned: &Planned, cables: usize) -> Answer<Self> {
        let outcomes: Vec<Result<&SetPoint, StaticsError>> = planned.points.iter().map(Ok).collect();
        let all = Columns::new(py, Cases { count: outcomes.len(), single: false }, &outcomes)?;
        let of_cables =
            |of: fn(&SetPoint) -> &[f64]| all.numbers(&[cables], |point, out| out.copy_from_slice(of(point)));
        Ok(Self {
            times: all.number(|point| point.time)?,
            poses: all.vector(|point| seven(&point.pose))?,
            lengths: of_cables(|point| &point.lengths)?,
            feed_forward: of_cables(|point| &point.feed_forward)?,
            tensions: of_cables(|point| &point.tensions)?,
            exit_tensions: of_cables(|point| &point.exit_tensions)?,
            summary: Py::new(py, MoveSummary::new(py, planned, cables)?)?,
        })
    }
}

impl MoveSummary {
    fn new(py: Python, planned: &Planned, cables: usize) -> Answer<Self> {
        let outcome: [Result<&Planned, StaticsError>; 1] = [Ok(planned)];
        let all = Columns::new(py, Cases { count: 1, single: true }, &outcome)?;
        let impulses = &planned.shaper.impulses;
        let of_modes = |of: fn(&Excited) -> f64| {
            all.numbers(&[planned.modes.len()], |planned, out| {
                out.iter_mut().zip(&planned.modes).for_each(|(out, mode)| *out = of(mode));
            })
        };
        let left = |of: &dyn Fn(&[Residual; 2]) -> f64| {
            all.number(|planned| planned.after.as_ref().map_or(f64::NAN, of))
        };
        Ok(Self {
            impulses: all
                .numbers(&[impulses.len(), 2], |_, out| out.copy_from_slice(impulses.as_flattened()))?,
            frequencies_hz: of_modes(|mode| mode.frequency)?,
            damping_ratios: of_modes(|mode| mode.damping_ratio)?,
            platform_shares: of_modes(|mode| mode.platform_share)?,
            amplitude: left(&|both| both[0].amplitude)?,
            unshaped_amplitude: left(&|both| both[1].amplitude)?,
            deviation: left(&|both| both[0].deviation)?,
            unshaped_deviation: left(&|both| both[1].deviation)?,
            position_difference: left(&|both| both[0].difference.max(both[1].difference))?,
            slack: all.array(false, &[cables], |planned, out| {
                let slack = planned.after.iter().flatten().flat_map(|left| &left.slack);
                slack.for_each(|i| out[*i] = true);
            })?,
        })
    }
}
