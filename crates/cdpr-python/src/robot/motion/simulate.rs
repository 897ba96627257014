//! `Robot.simulate`: how a robot moves after events.

use crate::convert::{
    Answer, Array, Cases, Columns, Loads, Numbers, Raised, Rows, answer, json_text, plotted, question, run,
};
use crate::robot::Robot;
use crate::robot::inverse::coordinates;
use cdpr_dynamics::simulate::{
    Command, Discretization, Event, Sample, Series, Settings, events_from_json, simulate_controlled,
};
use cdpr_robot::{Coordinate, Pose, Vector3, Wrench, plausible};
use cdpr_statics::{
    DirectProblem, DirectStart, Equilibrium, Load, StaticsError, WantedPose, check_lengths, inverse,
    rough_pose,
};
use pyo3::exceptions::PyStopIteration;
use pyo3::prelude::*;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Mutex, PoisonError};

answer! {
    /// A motion of a robot at m times.
    #[pyclass(frozen, get_all, module = "cdpr")]
    pub(crate) struct Motion {
        /// Times [s], (m,).
        times: Py<PyAny>,
        /// Poses, x, y, z, qw, qx, qy, qz, (m, 7).
        poses: Py<PyAny>,
        /// Velocity of P in the base frame [m/s], (m, 3).
        velocities: Py<PyAny>,
        /// Angular velocity in the base frame [rad/s], (m, 3).
        angular_velocities: Py<PyAny>,
        /// Tension of each cable at the platform [N], (m, n); zero where it has parted.
        tensions: Py<PyAny>,
        /// Tension of each cable at its exit point [N], (m, n).
        exit_tensions: Py<PyAny>,
        /// What the motion is as a whole, and how exact it is.
        summary: Py<MotionSummary>,
    }
}

plotted!(Motion);

answer! {
    /// A motion as a whole.
    #[pyclass(frozen, get_all, module = "cdpr")]
    pub(crate) struct MotionSummary {
        /// Pose at rest before the first event, (7,).
        pose: Py<PyAny>,
        /// Unstrained lengths there [m], (n,).
        lengths: Py<PyAny>,
        /// Greatest tension of each cable at either end at any step [N], (n,).
        greatest_tensions: Py<PyAny>,
        /// When [s], (n,).
        greatest_times: Py<PyAny>,
        /// Whether each cable carries no tension at a point at some time before it is cut, (n,).
        slack: Py<PyAny>,
        /// Greatest difference of the position of P to a coarser computation [m].
        position_difference: Py<PyAny>,
        /// Greatest difference of the rotation [rad].
        rotation_difference: Py<PyAny>,
        /// Greatest difference of a tension [N].
        tension_difference: Py<PyAny>,
        /// Greatest kinetic energy of platform and cables [J].
        kinetic_energy: Py<PyAny>,
        /// Work of winches and forces, with the energy of what came and went [J].
        given_energy: Py<PyAny>,
        /// Energy that damping took [J].
        lost_energy: Py<PyAny>,
        /// Energy that is missing at the end, or too much [J].
        energy_drift: Py<PyAny>,
        /// Elements of each cable at the end, (n,).
        elements: Py<PyAny>,
        /// Degree of the polynomial on them, (n,).
        degree: Py<PyAny>,
        /// Steps of time.
        steps: usize,
    }
}

answer! {
    /// A robot in motion at a time, as a control sees it.
    #[pyclass(frozen, get_all, module = "cdpr")]
    pub(crate) struct MotionState {
        /// Pose, x, y, z, qw, qx, qy, qz, (7,).
        pose: Py<PyAny>,
        /// Velocity of P in the base frame [m/s], (3,).
        velocity: Py<PyAny>,
        /// Angular velocity in the base frame [rad/s], (3,).
        angular_velocity: Py<PyAny>,
        /// Tension of each cable at the platform [N], (n,).
        tensions: Py<PyAny>,
        /// Tension of each cable at its exit point [N], (n,).
        exit_tensions: Py<PyAny>,
    }
}

#[pymethods]
impl Robot {
    /// Follows the motion of the robot from rest after events, with the mass and the sag of its cables.
    ///
    /// It is computed twice, and the differences are in `summary`.
    ///
    /// Parameters
    /// ----------
    /// pose : array_like, optional
    ///     Where the platform rests, (3,) or (7,); with `lengths`, where the search for the rest starts.
    /// until : float
    ///     End [s].
    /// events : sequence of dict, optional
    ///     What happens, in the words of the event files of `cdpr simulate`, each at a time `t` [s]:
    ///     {"t": 0, "payload": -50} [kg]; {"t": 0, "cut": 1, "at": "anchor"} or "exit"; {"t": 0, "force":
    ///     [100, 0, 0], "moment": [0, 0, 0]} [N, N m]; {"t": 0, "displace": [dx, dy, dz, rx, ry, rz]}
    ///     [m, rad]; {"t": 0, "shorten": {"cable": 1, "by": 0.003, "over": 0.2, "profile": "cosine"}} [m, s];
    ///     {"t": 0, "lengths": {"times": times, "lengths": lengths}} with arrays (k,) and (k, n) [s, m],
    ///     which winches follow.
    /// control : callable, optional
    ///     Called at each sample with the time [s] and a `MotionState`. It returns what acts until the next
    ///     sample besides the load and the events: a force at P in the base frame [N], (3,), a force and a
    ///     moment [N, N m], (6,), or None; `raise StopIteration` ends the motion. It must depend on its
    ///     arguments alone: each of the computations calls it, from the beginning, with its own states, and
    ///     they run at the same time.
    /// rate : float, default 100
    ///     Samples for each second [Hz].
    /// lengths : array_like, optional
    ///     Unstrained lengths of the cables [m], (n,), instead of those that hold `pose`.
    /// payload : float, optional
    ///     Mass that the platform carries at rest, at its centre of mass [kg].
    /// force, moment : array_like, optional
    ///     On the platform in the base frame, about P, at rest and all the time [N, N m], (3,).
    /// free : sequence of str, optional
    ///     Names of the coordinates of the pose that are found, for a robot with fewer cables than free
    ///     motions, as `Robot.inverse` takes them.
    /// damping : float, default 0
    ///     Ratio of the viscous to the elastic modulus of the cables [s].
    /// elements, degree : int, optional
    ///     Elements of each cable, and the degree of the polynomial on each; if left out, few elements of a
    ///     high degree, and many straight ones of a cable from when it goes slack.
    /// tolerance : float, default 5e-9
    ///     Error of a step that is accepted [m].
    ///
    /// Returns
    /// -------
    /// Motion
    ///     Poses, velocities and tensions over time.
    ///
    /// Raises
    /// ------
    /// InputError
    ///     For an invalid value; the message names it and what would be right; also where the robot has no
    ///     inertia.
    /// NoSolutionError
    ///     Where the robot has no rest, or its motion cannot be followed.
    ///
    /// Examples
    /// --------
    /// >>> import cdpr
    /// >>> robot = cdpr.Robot.from_file("cogiro")
    /// >>> motion = robot.simulate([0, 0, 2], until=0.1, events=[{"t": 0, "payload": 50}])
    /// >>> motion.poses.shape, motion.tensions.shape  # [m], [N]
    /// ((11, 7), (11, 8))
    /// >>> brake = lambda t, state: -200 * state.velocity  # [N]
    /// >>> slower = robot.simulate([0, 0, 2], until=0.1, events=[{"t": 0, "payload": 50}], control=brake)
    /// >>> bool(slower.poses[-1, 2] > motion.poses[-1, 2])
    /// True
    #[pyo3(signature = (pose=None, *, until, events=None, control=None, rate=100.0, lengths=None, payload=None,
        force=None, moment=None, free=None, damping=0.0, elements=None, degree=None, tolerance=5e-9))]
    #[allow(clippy::too_many_arguments)]
    fn simulate(
        &self,
        py: Python,
        pose: Option<Numbers>,
        until: f64,
        events: Option<Bound<PyAny>>,
        control: Option<Py<PyAny>>,
        rate: f64,
        lengths: Option<Numbers>,
        payload: Option<Numbers>,
        force: Option<Numbers>,
        moment: Option<Numbers>,
        free: Option<Vec<String>>,
        damping: f64,
        elements: Option<usize>,
        degree: Option<usize>,
        tolerance: f64,
    ) -> Answer<Motion> {
        let robot = &self.robot;
        let free = coordinates(free)?;
        let pose = pose.map(|pose| Rows::poses("pose", &pose, robot)).transpose()?;
        let loads = Loads::new(force.as_ref(), moment.as_ref(), payload.as_ref(), robot)?;
        let lengths =
            lengths.map(|lengths| Rows::of_cables("lengths", &lengths, robot.cables.len())).transpose()?;
        if !loads.cases(pose.iter().chain(&lengths))?.single {
            let message = "pose, lengths or a load has several rows: expected one motion a call";
            return Err(Raised::Input(message.to_owned()));
        }
        if let Some(lengths) = &lengths {
            question(plausible::lengths(robot, lengths.row(0)))?;
        }
        let events = events.map_or(Ok(Vec::new()), |events| -> Answer<Vec<Event>> {
            Ok(events_from_json(&json_text("events", &events)?)?)
        })?;
        let usual = Discretization::TAUT;
        let discretization = (elements.is_some() || degree.is_some()).then(|| Discretization {
            elements: elements.unwrap_or(usual.elements),
            degree: degree.unwrap_or(usual.degree),
        });
        let settings = Settings { until, rate, damping, discretization, tolerance };
        let load = loads.load(0)?;
        let pose = pose.map(|pose| pose.pose(0)).transpose()?;
        let control = control.map(PythonControl::new);
        let found = run(py, |stop| -> Answer<(Vec<f64>, Equilibrium, Series)> {
            let given = (lengths.as_ref().map(|lengths| lengths.row(0)), pose);
            let (lengths, rest) = at_rest(robot, given, &free, &load)?;
            let problem = DirectProblem::new(robot, &lengths, &load)?;
            let decide = |sample: &Sample| match &control {
                _ if stop.load(Ordering::Relaxed) => Command::Stop,
                Some(control) => control.decide(sample),
                None => Command::Wrench(Wrench::none()),
            };
            let series = simulate_controlled(&problem, &rest, &events, &settings, &decide);
            Ok((lengths, rest, series?))
        })?;
        // An exception of the control ends the motion, and comes first.
        control.as_ref().and_then(PythonControl::raised).map_or(Ok(()), Err)?;
        let (lengths, rest, series) = found?;
        question(series.overstrained(robot))?;
        Motion::new(py, &series, MotionSummary::new(py, (&lengths, &rest.pose), &series)?)
    }
}

/// The unstrained lengths [m] and the rest, for lengths or else for a pose.
fn at_rest(
    robot: &cdpr_robot::Robot,
    given: (Option<&[f64]>, Option<Pose>),
    free: &[Coordinate],
    load: &Load,
) -> Answer<(Vec<f64>, Equilibrium)> {
    let (lengths, start) = match given {
        (Some(lengths), pose) => {
            check_lengths(robot, lengths)?;
            (lengths.to_vec(), pose.unwrap_or_else(|| rough_pose(robot, lengths)))
        }
        (None, Some(pose)) => {
            let held = inverse(robot, WantedPose::at(&pose).free(free), load)?;
            (held.lengths, held.equilibrium.pose)
        }
        (None, None) => {
            return Err(Raised::Input("pose and lengths are both missing: expected one of them".to_owned()));
        }
    };
    let found = DirectProblem::new(robot, &lengths, load)?.direct(DirectStart::Pose(&start))?;
    Ok((lengths, found.equilibrium))
}

/// A function of Python that decides at each sample.
struct PythonControl {
    function: Py<PyAny>,
    /// The first exception, which ends all computations.
    raised: Mutex<Option<Raised>>,
    has_raised: AtomicBool,
}

impl PythonControl {
    fn new(function: Py<PyAny>) -> Self {
        Self { function, raised: Mutex::new(None), has_raised: AtomicBool::new(false) }
    }

    fn raised(&self) -> Option<Raised> {
        self.raised.lock().unwrap_or_else(PoisonError::into_inner).take()
    }

    fn decide(&self, sample: &Sample) -> Command {
        if self.has_raised.load(Ordering::Relaxed) {
            return Command::Stop;
        }
        match Python::attach(|py| self.call(py, sample)) {
            Ok(command) => command,
            Err(error) => {
                self.has_raised.store(true, Ordering::Relaxed);
                self.raised.lock().unwrap_or_else(PoisonError::into_inner).get_or_insert(error);
                Command::Stop
            }
        }
    }

    fn call(&self, py: Python, sample: &Sample) -> Answer<Command> {
        let state = MotionState::new(py, sample)?;
        let found = match self.function.bind(py).call1((sample.time, state)) {
            Err(error) if error.is_instance_of::<PyStopIteration>(py) => return Ok(Command::Stop),
            found => found?,
        };
        if found.is_none() {
            return Ok(Command::Wrench(Wrench::none()));
        }
        let name = format!("what control returns at {:?} s", sample.time);
        let Array { shape, values } = Array::new(&name, &found)?;
        let wrench = match values[..] {
            [x, y, z] => Wrench { force: Vector3::new(x, y, z), moment: Vector3::zeros() },
            [x, y, z, mx, my, mz] => {
                Wrench { force: Vector3::new(x, y, z), moment: Vector3::new(mx, my, mz) }
            }
            _ => {
                let expected = "a force (3,), a force and a moment (6,), or None";
                return Err(Raised::Input(format!("{name} has the shape {shape:?}: expected {expected}")));
            }
        };
        match values.iter().find(|value| !value.is_finite()) {
            Some(value) => Err(Raised::Input(format!("{name} has {value}: expected finite numbers"))),
            None => Ok(Command::Wrench(wrench)),
        }
    }
}

const SINGLE: Cases = Cases { count: 1, single: true };

/// The tensions of a sample at one end of each cable: 0 at the exit, 1 at the anchor point.
fn tensions(sample: &Sample, end: usize) -> impl Iterator<Item = f64> {
    sample.tensions.iter().map(move |both| both[end])
}

pub(crate) fn seven(pose: &Pose) -> [f64; 7] {
    let [w, i, j, k] = pose.quaternion();
    let [x, y, z] = pose.position.into();
    [x, y, z, w, i, j, k]
}

impl MotionState {
    fn new(py: Python, sample: &Sample) -> Answer<Self> {
        let outcome: [Result<&Sample, StaticsError>; 1] = [Ok(sample)];
        let all = Columns::new(py, SINGLE, &outcome)?;
        let motion = |first: usize| all.vector::<3>(|sample| [0, 1, 2].map(|k| sample.velocity[first + k]));
        let at_end = |end: usize| {
            all.numbers(&[sample.tensions.len()], |sample, out| {
                out.iter_mut().zip(tensions(sample, end)).for_each(|(out, tension)| *out = tension);
            })
        };
        Ok(Self {
            pose: all.vector(|sample| seven(&sample.pose))?,
            velocity: motion(0)?,
            angular_velocity: motion(3)?,
            tensions: at_end(1)?,
            exit_tensions: at_end(0)?,
        })
    }
}

impl Motion {
    fn new(py: Python, series: &Series, summary: MotionSummary) -> Answer<Self> {
        let outcomes: Vec<Result<&Sample, StaticsError>> = series.samples.iter().map(Ok).collect();
        let all = Columns::new(py, Cases { count: outcomes.len(), single: false }, &outcomes)?;
        let motion = |first: usize| all.vector::<3>(|sample| [0, 1, 2].map(|k| sample.velocity[first + k]));
        let at_end = |end: usize| {
            all.numbers(&[series.peaks.len()], |sample, out| {
                out.iter_mut().zip(tensions(sample, end)).for_each(|(out, tension)| *out = tension);
            })
        };
        Ok(Self {
            times: all.number(|sample| sample.time)?,
            poses: all.vector(|sample| seven(&sample.pose))?,
            velocities: motion(0)?,
            angular_velocities: motion(3)?,
            tensions: at_end(1)?,
            exit_tensions: at_end(0)?,
            summary: Py::new(py, summary)?,
        })
    }
}

impl MotionSummary {
    fn new(py: Python, (lengths, rest): (&[f64], &Pose), series: &Series) -> Answer<Self> {
        let outcome: [Result<&Series, StaticsError>; 1] = [Ok(series)];
        let all = Columns::new(py, SINGLE, &outcome)?;
        let of_cables = |of: &dyn Fn(usize) -> f64| {
            all.numbers(&[lengths.len()], |_, out| (0..out.len()).for_each(|i| out[i] = of(i)))
        };
        let counts = |of: &dyn Fn(usize) -> usize| {
            let fill = |_: &&Series, out: &mut [i64]| (0..out.len()).for_each(|i| out[i] = of(i) as i64);
            all.array(0, &[lengths.len()], fill)
        };
        let (difference, energy) = (&series.difference, &series.energy);
        Ok(Self {
            pose: all.vector(|_| seven(rest))?,
            lengths: of_cables(&|i| lengths[i])?,
            greatest_tensions: of_cables(&|i| series.peaks[i].0)?,
            greatest_times: of_cables(&|i| series.peaks[i].1)?,
            slack: all.array(false, &[lengths.len()], |series, out| out.copy_from_slice(&series.slack))?,
            position_difference: all.number(|_| difference.position)?,
            rotation_difference: all.number(|_| difference.rotation)?,
            tension_difference: all.number(|_| difference.tension)?,
            kinetic_energy: all.number(|_| energy.kinetic)?,
            given_energy: all.number(|_| energy.given)?,
            lost_energy: all.number(|_| energy.lost)?,
            energy_drift: all.number(|_| energy.drift)?,
            elements: counts(&|i| series.discretizations[i].elements)?,
            degree: counts(&|i| series.discretizations[i].degree)?,
            steps: series.work.steps,
        })
    }
}
