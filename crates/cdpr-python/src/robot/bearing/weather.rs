//! `Robot.in_weather`: where the platform rests in wind, in another temperature, with ice or creep.

use crate::convert::{Answer, Columns, Loads, Numbers, Rows, answer, each, plotted};
use crate::robot::Robot;
use crate::robot::inverse::coordinates;
use cdpr_robot::{Parameter, Vector3, Vector6};
use cdpr_statics::weather::{
    RestInWeather as Rest, Weather, WeatherDerivatives, WeatherInput, Wind, WindProfile, in_weather,
    weather_derivatives,
};
use cdpr_statics::{StaticsError, WantedPose};
use pyo3::prelude::*;

answer! {
    /// A platform at rest in weather.
    ///
    /// The answer is of one case, or of m: then every field has a first axis of m, with NaN where there is no
    /// answer, and `reasons` says why.
    #[pyclass(frozen, get_all, module = "cdpr")]
    pub(crate) struct RestInWeather {
        /// Displacement of P from the pose without load and weather [m], (3,).
        displacement: Py<PyAny>,
        /// Its norm [m].
        magnitude: Py<PyAny>,
        /// Rotation vector from the platform without load and weather, in the base frame [rad], (3,).
        rotation: Py<PyAny>,
        /// Pose: x, y, z [m], qw, qx, qy, qz, (7,).
        pose: Py<PyAny>,
        /// Unstrained lengths of the cables [m], (n,).
        lengths: Py<PyAny>,
        /// Tensions at the platform [N], (n,).
        tensions: Py<PyAny>,
        /// Tensions at the exit points [N], (n,).
        exit_tensions: Py<PyAny>,
        /// Force of the wind on each cable [N], (n, 3).
        drags: Py<PyAny>,
        /// Unbalanced force on the platform [N].
        force_residual: Py<PyAny>,
        /// Unbalanced moment about P [N m].
        moment_residual: Py<PyAny>,
        /// Largest distance between the end of a cable and its anchor point [m].
        closure_residual: Py<PyAny>,
        /// Largest error of the integration along a cable [m].
        integration: Py<PyAny>,
        /// Names of the inputs of `slopes`, the parameters of the robot and then the numbers of the weather;
        /// None unless they are requested.
        inputs: Option<Vec<String>>,
        /// Derivatives of the displacement by each input [m per unit], (3, k), with NaN where one does not
        /// exist; None unless they are requested.
        slopes: Py<PyAny>,
        /// Why there is no answer, None if there is one; None for one case.
        reasons: Py<PyAny>,
        /// The kind of each failure, in the same form: `infeasible_tension`, ...
        kinds: Py<PyAny>,
    }
}

plotted!(RestInWeather);

struct Found {
    motion: Vector6<f64>,
    lengths: Vec<f64>,
    rest: Rest,
    slopes: Option<WeatherDerivatives>,
}

#[pymethods]
impl Robot {
    /// Finds where the platform rests in wind, at another temperature, with ice or creep; the winches hold.
    ///
    /// The lengths are those with which it rests at the pose under its own weight, without weather. The drag
    /// is that of round ropes with a coefficient of 1.2 in air of 1.225 kg/m³; with others, take the wind
    /// that is sqrt(density coefficient/1.47) times as fast. Wind on the platform itself is a `force`.
    /// `pose`, `wind` and the load are of one case, or have a first axis of m cases: wind from all directions
    /// is a `wind` with a row for each.
    ///
    /// Parameters
    /// ----------
    /// pose : array_like
    ///     Wanted pose under the platform's own weight, (3,) or (7,).
    /// wind : array_like, optional
    ///     Velocity of the wind in the base frame [m/s], (3,).
    /// warmer : float
    ///     How much warmer it is [K].
    /// cable_expansion, frame_expansion : float
    ///     Thermal expansion of the cables, and of the frame from the origin of the base frame [1/K].
    /// ice : float
    ///     Thickness of the ice around each cable [m], of 900 kg/m³.
    /// creep : float
    ///     Strain by which each cable has crept.
    /// wind_profile : tuple of float, optional
    ///     Roughness length of the ground and height above it at which the wind has its velocity [m],
    ///     such as (0.3, 10), of a wind that grows with height from nothing at the ground,
    ///     `ground_z` or z = 0.
    /// payload : array_like, optional
    ///     Mass added at the platform's centre of mass [kg].
    /// force, moment : array_like, optional
    ///     On the platform in the base frame, about P [N, N m], (3,).
    /// free : sequence of str, optional
    ///     Names of the coordinates of the pose that are found, for a robot with fewer cables than free
    ///     motions, as `Robot.inverse` takes them.
    /// slopes : bool, default False
    ///     Whether the exact derivatives of the displacement are computed, too, also by the numbers of the
    ///     weather. A robot with pulleys has none in wind.
    ///
    /// Returns
    /// -------
    /// RestInWeather
    ///     Displacements, tensions and the force of the wind on each cable.
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
    /// >>> robot.in_weather([0, 0, 2], [15, 0, 0]).drags.shape  # [N]
    /// (8, 3)
    /// >>> bool(robot.in_weather([0, 0, 2], ice=0.005).displacement[2] > 0)  # sag shortens the chords
    /// True
    /// >>> robot.in_weather([0, 0, 2], [15, 0, 0], slopes=True).inputs[-2:]
    /// ['wind', 'wind_direction']
    #[pyo3(signature = (pose, wind=None, *, warmer=0.0, cable_expansion=0.0, frame_expansion=0.0, ice=0.0,
        creep=0.0, wind_profile=None, payload=None, force=None, moment=None, free=None, slopes=false))]
    #[allow(clippy::too_many_arguments)]
    fn in_weather(
        &self,
        py: Python,
        pose: Numbers,
        wind: Option<Numbers>,
        warmer: f64,
        cable_expansion: f64,
        frame_expansion: f64,
        ice: f64,
        creep: f64,
        wind_profile: Option<(f64, f64)>,
        payload: Option<Numbers>,
        force: Option<Numbers>,
        moment: Option<Numbers>,
        free: Option<Vec<String>>,
        slopes: bool,
    ) -> Answer<RestInWeather> {
        let (robot, free) = (&self.robot, coordinates(free)?);
        let poses = Rows::poses("pose", &pose, robot)?;
        let winds = Rows::components::<3>("wind", wind.as_ref())?.finite()?;
        let loads = Loads::new(force.as_ref(), moment.as_ref(), payload.as_ref(), robot)?;
        let cases = loads.cases([&poses, &winds])?;
        let profile = wind_profile.map(|(roughness, reference)| WindProfile { roughness, reference });
        let weather = Weather { wind: Wind::default(), warmer, cable_expansion, frame_expansion, ice, creep };
        let outcomes: Vec<Result<Found, StaticsError>> = each(py, cases.count, |case| {
            let wind = Wind::new(Vector3::from_row_slice(winds.row(case)))?;
            let wind = profile.map_or(Ok(wind), |profile| wind.over_height(profile))?;
            let wanted = poses.pose(case)?;
            let wanted = WantedPose::at(&wanted).free(&free);
            let (load, weather) = (loads.load(case)?, Weather { wind, ..weather });
            let found = slopes.then(|| weather_derivatives(robot, wanted, &load, &weather));
            let (still, rest) = in_weather(robot, wanted, &load, &weather)?;
            let motion = still.unloaded.equilibrium.pose.motion_to(&rest.pose);
            Ok(Found { motion, lengths: still.lengths, rest, slopes: found.transpose()? })
        })?;
        let parameters = Parameter::of(robot);
        let of_weather = WeatherInput::ALL.map(|input| input.name().to_owned());
        let names: Vec<String> = parameters.iter().map(ToString::to_string).chain(of_weather).collect();
        let all = Columns::new(py, cases, &outcomes)?;
        let of_cables = |of: &dyn Fn(&Found) -> Vec<f64>| {
            all.numbers(&[robot.cables.len()], |found, out| out.copy_from_slice(&of(found)))
        };
        Ok(RestInWeather {
            displacement: all.vector(|found| [0, 1, 2].map(|row| found.motion[row]))?,
            magnitude: all.number(|found| found.motion.fixed_rows::<3>(0).norm())?,
            rotation: all.vector(|found| [3, 4, 5].map(|row| found.motion[row]))?,
            pose: all.numbers(&[7], |found, out| {
                out[..3].copy_from_slice(found.rest.pose.position.as_slice());
                out[3..].copy_from_slice(&found.rest.pose.quaternion());
            })?,
            lengths: of_cables(&|found| found.lengths.clone())?,
            tensions: of_cables(&|found| found.rest.tensions())?,
            exit_tensions: of_cables(&|found| found.rest.exit_tensions.clone())?,
            drags: all.numbers(&[robot.cables.len(), 3], |found, out| {
                let each = out.chunks_exact_mut(3).zip(&found.rest.drags);
                each.for_each(|(out, drag)| out.copy_from_slice(drag.as_slice()));
            })?,
            force_residual: all.number(|found| found.rest.residual.force)?,
            moment_residual: all.number(|found| found.rest.residual.moment)?,
            closure_residual: all.number(|found| found.rest.residual.closure)?,
            integration: all.number(|found| found.rest.integration)?,
            slopes: match slopes {
                true => all.numbers(&[3, names.len()], |found, out| {
                    let Some(slopes) = &found.slopes else { return };
                    let columns = slopes.displacement.column_iter().take(parameters.len());
                    let of_robot = columns.map(|column| Some(column.into_owned()));
                    let of_weather = slopes.per_weather.iter().map(|slope| slope.as_ref().ok().copied());
                    for (k, slope) in of_robot.chain(of_weather).enumerate() {
                        (0..3).for_each(|row| {
                            out[row * names.len() + k] = slope.map_or(f64::NAN, |of| of[row]);
                        });
                    }
                })?,
                false => py.None(),
            },
            inputs: slopes.then_some(names),
            reasons: all.reasons(),
            kinds: all.kinds(),
        })
    }
}
