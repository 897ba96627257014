//! `Robot.derivatives`: the derivatives of lengths and deflection with respect to each parameter.

use crate::convert::{Answer, Columns, Loads, Numbers, Rows, answer, components, each};
use crate::robot::Robot;
use crate::robot::deflection::{Deflection, Given};
use crate::robot::inverse::coordinates;
use cdpr_dynamics::{AmplitudeAt, AmplitudeDerivatives, Damping, DynamicsError, FrequencyDerivatives};
use cdpr_robot::{Parameter, Pose};
use cdpr_statics::{Load, StaticsError, WantedPose, derivatives};
use pyo3::prelude::*;

answer! {
    /// A deflection with its exact derivatives, per SI unit of the k inputs.
    ///
    /// Where a cable leaves a bound on one side of an input only, the derivatives as the input falls (left)
    /// and as it grows (right) differ: `one_sided` says where. Fields without `right` in their name are left
    /// ones.
    ///
    /// The answer is of one case, or of m: then every field has a first axis of m, with NaN where there is no
    /// answer, and `reasons` says why.
    #[pyclass(frozen, get_all, module = "cdpr")]
    pub(crate) struct Derivatives {
        /// Names of the k inputs: the parameters of the robot, `payload`, and the wanted pose.
        ///
        /// The inputs of the pose are `x`, `y`, `z` [m] and `rx`, `ry`, `rz` [rad].
        inputs: Vec<String>,
        /// Inputs whose left and right derivatives differ, (k,).
        one_sided: Py<PyAny>,
        /// Derivatives of |dp| [m per unit], (k,); NaN where nothing displaces the platform.
        magnitude: Py<PyAny>,
        /// Derivatives of dp [m per unit], (3, k).
        displacement: Py<PyAny>,
        /// Derivatives of the unstrained lengths [m per unit], (n, k).
        lengths: Py<PyAny>,
        /// Derivatives of the tension set-points [N per unit], (n, k).
        set_points: Py<PyAny>,
        /// Derivatives of the tensions with the load [N per unit], (n, k).
        tensions: Py<PyAny>,
        /// Derivatives of the lowest stiffness with the load [N/m per unit], (k,); NaN where two motions have
        /// it.
        least_stiffness: Py<PyAny>,
        /// Derivatives of the frequency of the platform with the load [Hz per unit], (k,): of its motion
        /// with the mass of cables, as long as it changes less than its distance from the next. NaN where two
        /// motions have it, and without inertia of the platform.
        frequency: Py<PyAny>,
        /// Derivatives of the amplitude at the frequency `shaken` with the load, in the worst direction
        /// [m/N per unit], (k,). NaN without `shaken`, where two directions are shaken alike, and without
        /// inertia of the platform.
        amplitude: Py<PyAny>,
        /// Right derivatives of |dp| [m per unit], (k,).
        magnitude_right: Py<PyAny>,
        /// Right derivatives of dp [m per unit], (3, k).
        displacement_right: Py<PyAny>,
        /// Right derivatives of the unstrained lengths [m per unit], (n, k).
        lengths_right: Py<PyAny>,
        /// Right derivatives of the tension set-points [N per unit], (n, k).
        set_points_right: Py<PyAny>,
        /// Right derivatives of the tensions with the load [N per unit], (n, k).
        tensions_right: Py<PyAny>,
        /// Right derivatives of the lowest stiffness [N/m per unit], (k,).
        least_stiffness_right: Py<PyAny>,
        /// Right derivatives of the frequency of the platform [Hz per unit], (k,).
        frequency_right: Py<PyAny>,
        /// Right derivatives of the amplitude [m/N per unit], (k,).
        amplitude_right: Py<PyAny>,
        /// The deflection itself.
        deflection: Py<Deflection>,
        /// Why there is no answer, None if there is one; None for one case.
        reasons: Py<PyAny>,
        /// The kind of each failure, in the same form: `infeasible_tension`, ...
        kinds: Py<PyAny>,
    }
}

/// The derivatives on both sides.
struct Sides {
    left: Slopes,
    right: Slopes,
    one_sided: Vec<usize>,
    given: Given,
}

/// The matrices of derivatives, row by row.
struct Slopes {
    magnitude: Vec<f64>,
    displacement: Vec<f64>,
    lengths: Vec<f64>,
    set_points: Vec<f64>,
    tensions: Vec<f64>,
    least_stiffness: Vec<f64>,
    frequency: Vec<f64>,
    amplitude: Vec<f64>,
}

impl Slopes {
    fn new(
        robot: &cdpr_robot::Robot,
        load: &Load,
        found: &cdpr_statics::Derivatives,
        frequency: Option<&FrequencyDerivatives>,
        amplitude: Option<&AmplitudeDerivatives>,
    ) -> Self {
        let none = || vec![f64::NAN; found.inputs.count()];
        let stiffness = found.least_stiffness(robot, load);
        // nalgebra stores matrices column by column.
        Self {
            magnitude: found.magnitude().unwrap_or_else(|_| none()),
            displacement: found.displacement().transpose().as_slice().to_vec(),
            lengths: found.lengths.transpose().as_slice().to_vec(),
            set_points: found.set_points.transpose().as_slice().to_vec(),
            tensions: found.loaded.tensions.transpose().as_slice().to_vec(),
            least_stiffness: stiffness.map_or_else(|_| none(), |(_, slopes)| slopes),
            frequency: frequency.map_or_else(none, |frequency| frequency.with_lengths(&found.lengths)),
            amplitude: amplitude.map_or_else(none, |amplitude| amplitude.with_lengths(&found.lengths)),
        }
    }
}

/// The derivatives of an amplitude; `None` where it has none.
fn amplitude_of(
    robot: &cdpr_robot::Robot,
    load: &Load,
    found: &cdpr_statics::Derivatives,
    at: &AmplitudeAt,
) -> Result<Option<AmplitudeDerivatives>, StaticsError> {
    match AmplitudeDerivatives::of_deflection(robot, load, found, at) {
        Err(error @ DynamicsError::Invalid { .. }) => Err(error.into()),
        found => Ok(found.ok()),
    }
}

#[pymethods]
impl Robot {
    /// Computes the exact derivatives of lengths, tensions and deflection under a load.
    ///
    /// Arguments are of one case, or have a first axis of m cases.
    ///
    /// Parameters
    /// ----------
    /// pose : array_like
    ///     Wanted pose under the platform's own weight, (3,) or (7,).
    /// payload : array_like, optional
    ///     Mass added at the platform's centre of mass [kg].
    /// force, moment : array_like, optional
    ///     On the platform in the base frame, about P [N, N m], (3,). Without a load there are no derivatives
    ///     of |dp|.
    /// free : sequence of str, optional
    ///     Names of the coordinates of the pose that are found, for a robot with fewer cables than free
    ///     motions, as `Robot.inverse` takes them.
    /// shaken : float, optional
    ///     Frequency of a force that shakes the platform [Hz], for the derivatives of its amplitude.
    /// damping, drag : float
    ///     What damps the cables, as in `Robot.response` [s, 1/s].
    /// marker : array_like, optional
    ///     Point of the platform that is shaken and that moves, in its frame [m]; P if left out.
    ///
    /// Returns
    /// -------
    /// Derivatives
    ///     Derivatives by each input.
    ///
    /// Raises
    /// ------
    /// InputError
    ///     For an invalid value; the message names it and what would be right.
    /// NoSolutionError
    ///     For one case without an answer; of several, its row has NaN and a reason; also where a
    ///     derivative does not exist.
    ///
    /// Examples
    /// --------
    /// >>> import cdpr
    /// >>> robot = cdpr.Robot.from_file("cogiro")
    /// >>> slopes = robot.derivatives([0, 0, 2], payload=50)
    /// >>> slopes.inputs[0], len(slopes.magnitude) == len(slopes.inputs)
    /// ('mass', True)
    /// >>> shaken = robot.derivatives([0, 0, 2], payload=50, shaken=3, drag=0.5).amplitude  # [m/N per unit]
    /// >>> shaken.shape == slopes.magnitude.shape
    /// True
    #[pyo3(signature = (pose, *, payload=None, force=None, moment=None, free=None, shaken=None, damping=2e-4,
        drag=0.0, marker=None))]
    #[allow(clippy::too_many_arguments)]
    fn derivatives(
        &self,
        py: Python,
        pose: Numbers,
        payload: Option<Numbers>,
        force: Option<Numbers>,
        moment: Option<Numbers>,
        free: Option<Vec<String>>,
        shaken: Option<f64>,
        damping: f64,
        drag: f64,
        marker: Option<Numbers>,
    ) -> Answer<Derivatives> {
        let free = coordinates(free)?;
        let poses = Rows::poses("pose", &pose, &self.robot)?;
        let loads = Loads::new(force.as_ref(), moment.as_ref(), payload.as_ref(), &self.robot)?;
        let cases = loads.cases([&poses])?;
        let robot = &self.robot;
        let cables = robot.cables.len();
        let marker = marker.map_or(Ok([0.0; 3]), |marker| components("marker", &marker))?.into();
        let damping = Damping { stretch: damping, drag };
        let at = shaken.map(|frequency| AmplitudeAt { frequency, damping, marker, along: None });
        let outcomes: Vec<Result<Sides, StaticsError>> = each(py, cases.count, |case| {
            let (pose, load) = (poses.pose(case)?, loads.load(case)?);
            let found = derivatives(robot, WantedPose::at(&pose).free(&free), &load)?;
            let frequency = FrequencyDerivatives::of_deflection(robot, &load, &found).ok();
            let amplitude = at.map_or(Ok(None), |at| amplitude_of(robot, &load, &found, &at))?;
            let new = |found: &_| Slopes::new(robot, &load, found, frequency.as_ref(), amplitude.as_ref());
            Ok(Sides {
                left: new(&found),
                right: new(&found.right()),
                one_sided: found.one_sided.iter().map(|input| input.column).collect(),
                given: Given::new(robot, found.deflection),
            })
        })?;
        let all = Columns::new(py, cases, &outcomes)?;
        let parameters = Parameter::of(robot);
        let others = ["payload"].into_iter().chain(Pose::COORDINATES).map(str::to_owned);
        let inputs: Vec<String> = parameters.iter().map(ToString::to_string).chain(others).collect();
        let count = inputs.len();
        let (left, right) = (all.part(|sides| &sides.left), all.part(|sides| &sides.right));
        let numbers = |side: &Columns<Slopes>, shape: &[usize], field: fn(&Slopes) -> &[f64]| {
            side.numbers(shape, |slopes: &Slopes, out| out.copy_from_slice(field(slopes)))
        };
        let magnitude = |side| numbers(side, &[count], |slopes| &slopes.magnitude);
        let displacement = |side| numbers(side, &[3, count], |slopes| &slopes.displacement);
        let lengths = |side| numbers(side, &[cables, count], |slopes| &slopes.lengths);
        let set_points = |side| numbers(side, &[cables, count], |slopes| &slopes.set_points);
        let tensions = |side| numbers(side, &[cables, count], |slopes| &slopes.tensions);
        let least_stiffness = |side| numbers(side, &[count], |slopes| &slopes.least_stiffness);
        let frequency = |side| numbers(side, &[count], |slopes| &slopes.frequency);
        let amplitude = |side| numbers(side, &[count], |slopes| &slopes.amplitude);
        let deflection = Deflection::new(py, &all.part(|sides| &sides.given), cables)?;
        Ok(Derivatives {
            one_sided: all.array(false, &[count], |sides, out| {
                sides.one_sided.iter().for_each(|column| out[*column] = true);
            })?,
            magnitude: magnitude(&left)?,
            displacement: displacement(&left)?,
            lengths: lengths(&left)?,
            set_points: set_points(&left)?,
            tensions: tensions(&left)?,
            least_stiffness: least_stiffness(&left)?,
            frequency: frequency(&left)?,
            amplitude: amplitude(&left)?,
            magnitude_right: magnitude(&right)?,
            displacement_right: displacement(&right)?,
            lengths_right: lengths(&right)?,
            set_points_right: set_points(&right)?,
            tensions_right: tensions(&right)?,
            least_stiffness_right: least_stiffness(&right)?,
            frequency_right: frequency(&right)?,
            amplitude_right: amplitude(&right)?,
            deflection: Py::new(py, deflection)?,
            reasons: all.reasons(),
            kinds: all.kinds(),
            inputs,
        })
    }
}
