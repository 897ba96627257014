//! `Robot.response`: how a platform that is shaken moves.

use crate::convert::{
    Answer, Array, Columns, Loads, Numbers, Raised, Rows, answer, components, each, plotted,
};
use crate::robot::Robot;
use crate::robot::inverse::coordinates;
use cdpr_dynamics::{Damping, FrequencyResponse};
use cdpr_robot::Vector3;
use cdpr_statics::{DirectProblem, DirectStart, StaticsError, Unstable, WantedPose, inverse};
use numpy::Complex64;
use pyo3::prelude::*;

answer! {
    /// How a platform on cables with mass moves when it is shaken, at k frequencies.
    ///
    /// Complex amplitudes: the absolute value is the size, the angle the phase. The answer is of one pose, or
    /// of m: then every field has a first axis of m, with NaN where there is no answer, and `reasons` says
    /// why.
    #[pyclass(frozen, get_all, module = "cdpr")]
    pub(crate) struct Response {
        /// Frequencies [Hz], (k,).
        frequencies_hz: Py<PyAny>,
        /// Largest amplitude of the point for a force there of any direction [m/N], (k,): the norm of the
        /// motions along x, y and z. Infinite where the force moves it along a motion that nothing resists.
        amplitudes: Py<PyAny>,
        /// Motion of the point along x, y, z for forces there along x, y, z [m/N], (k, 3, 3), complex.
        per_force: Py<PyAny>,
        /// Motion of the point per length that each winch takes in [m/m], (k, n, 3), complex.
        per_shortening: Py<PyAny>,
        /// Translation of P and rotation vector per force at P and moment [m/N, rad/N, m/(N m), rad/(N m)],
        /// (k, 6, 6), complex; at 0 Hz without motions that nothing resists.
        per_wrench: Py<PyAny>,
        /// Why there is no answer, None if there is one; None for one pose.
        reasons: Py<PyAny>,
        /// The kind of each failure, in the same form: `infeasible_tension`, ...
        kinds: Py<PyAny>,
    }
}

plotted!(Response);

/// The response at one pose, and where the point is from P in the base frame [m].
struct Shaken {
    responses: Vec<cdpr_dynamics::Response>,
    lever: Vector3<f64>,
}

#[pymethods]
impl Robot {
    /// Computes how the platform moves when a force or a winch shakes it.
    ///
    /// Cables have mass. The winches hold their lengths but for what shakes. Arguments are of one case, or
    /// have a first axis of m cases; frequencies, damping and marker are those of all cases.
    ///
    /// Parameters
    /// ----------
    /// pose : array_like
    ///     x, y, z [m], or x, y, z, qw, qx, qy, qz, (3,) or (7,).
    /// frequencies : array_like
    ///     Frequencies [Hz], (k,). Peaks are at the natural ones, `Robot.modes(...).frequencies_hz`.
    /// damping : float, default 2e-4
    ///     Ratio of the viscous to the elastic modulus of the cables [s].
    /// drag : float, default 0
    ///     Force of the air on a metre of cable over its mass, for each m/s [1/s]. Nothing else damps cables
    ///     across their stretch.
    /// marker : array_like, optional
    ///     Point of the platform that is shaken and that moves, in its frame [m]; P if left out.
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
    /// Response
    ///     Amplitudes.
    ///
    /// Raises
    /// ------
    /// InputError
    ///     For an invalid value; the message names it and what would be right; also where the robot has no
    ///     inertia, and at a natural frequency that nothing damps.
    /// NoSolutionError
    ///     For one case without an answer; of several, its row has NaN and a reason.
    ///
    /// Examples
    /// --------
    /// >>> import cdpr
    /// >>> import numpy
    /// >>> robot = cdpr.Robot.from_file("cogiro")
    /// >>> natural = robot.modes([0, 0, 2], below=6).frequencies_hz
    /// >>> frequencies = numpy.union1d(numpy.linspace(0, 6, 100), natural)
    /// >>> found = robot.response([0, 0, 2], frequencies, drag=0.5)
    /// >>> bool(found.amplitudes.max() > found.amplitudes[0])  # more than at rest
    /// True
    #[pyo3(signature = (pose, frequencies, *, damping=2e-4, drag=0.0, marker=None, payload=None, force=None,
        moment=None, free=None))]
    #[allow(clippy::too_many_arguments)]
    fn response(
        &self,
        py: Python,
        pose: Numbers,
        frequencies: Numbers,
        damping: f64,
        drag: f64,
        marker: Option<Numbers>,
        payload: Option<Numbers>,
        force: Option<Numbers>,
        moment: Option<Numbers>,
        free: Option<Vec<String>>,
    ) -> Answer<Response> {
        let free = coordinates(free)?;
        let poses = Rows::poses("pose", &pose, &self.robot)?;
        let loads = Loads::new(force.as_ref(), moment.as_ref(), payload.as_ref(), &self.robot)?;
        let cases = loads.cases([&poses])?;
        let marker = marker.map_or(Ok([0.0; 3]), |marker| components("marker", &marker))?;
        let Array { shape, values: frequencies } = Array::new("frequencies", &frequencies)?;
        let highest = frequencies.iter().copied().fold(0.0, f64::max);
        if shape.len() != 1 || highest.is_nan() || highest <= 0.0 {
            let message = "expected a row of frequencies [Hz], of which one is above zero";
            return Err(Raised::Input(format!("frequencies has the shape {shape:?}: {message}")));
        }
        let damping = Damping { stretch: damping, drag };
        let outcomes: Vec<Result<Shaken, StaticsError>> = each(py, cases.count, |case| {
            let (pose, load) = (poses.pose(case)?, loads.load(case)?);
            let held = inverse(&self.robot, WantedPose::at(&pose).free(&free), &load)?;
            let problem = DirectProblem::new(&self.robot, &held.lengths, &load)?;
            let start = DirectStart::Near(&held.equilibrium);
            let rest = problem.with_unstable(Unstable::Accepted).direct(start)?.equilibrium;
            let response = FrequencyResponse::new(&problem, &rest, highest, damping)?;
            let responses = frequencies.iter().map(|frequency| response.at(*frequency));
            let lever = rest.pose.rotation * Vector3::from(marker);
            Ok(Shaken { responses: responses.collect::<Result<_, _>>()?, lever })
        })?;
        let all = Columns::new(py, cases, &outcomes)?;
        let (k, n) = (frequencies.len(), self.robot.cables.len());
        type Fill<'a> = &'a dyn Fn(&cdpr_dynamics::Response, &Vector3<f64>, &mut [Complex64]);
        let complex = |inner: &[usize], fill: Fill| {
            let width = inner.iter().product();
            all.array(Complex64::new(f64::NAN, f64::NAN), &[&[k], inner].concat(), |found: &Shaken, out| {
                let rows = out.chunks_exact_mut(width).zip(&found.responses);
                rows.for_each(|(out, response)| fill(response, &found.lever, out));
            })
        };
        Ok(Response {
            frequencies_hz: all.numbers(&[k], |_, out| out.copy_from_slice(&frequencies))?,
            amplitudes: all.numbers(&[k], |found: &Shaken, out| {
                for (out, response) in out.iter_mut().zip(&found.responses) {
                    *out = response.by_force(&found.lever);
                }
            })?,
            per_force: complex(&[3, 3], &|response, lever, out| {
                let (per_force, _) = response.at_point(lever);
                let rows = per_force.transpose();
                out.iter_mut().zip(rows.iter()).for_each(|(out, z)| *out = Complex64::new(z.re, z.im));
            })?,
            per_shortening: complex(&[n, 3], &|response, lever, out| {
                let (_, per_shortening) = response.at_point(lever);
                out.iter_mut()
                    .zip(per_shortening.iter())
                    .for_each(|(out, z)| *out = Complex64::new(z.re, z.im));
            })?,
            per_wrench: complex(&[6, 6], &|response, _, out| {
                let rows = response.per_wrench.transpose();
                out.iter_mut().zip(rows.iter()).for_each(|(out, z)| *out = Complex64::new(z.re, z.im));
            })?,
            reasons: all.reasons(),
            kinds: all.kinds(),
        })
    }
}
