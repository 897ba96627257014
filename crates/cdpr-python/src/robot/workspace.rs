//! `Robot.workspace`: where the cables hold the platform, and how far it gives there, over a plane or a box.

use crate::convert::{Answer, Array, Numbers, Raised, answer, components, plotted, question, run};
use crate::robot::Robot;
use crate::robot::inverse::coordinates;
use cdpr_assess::{Shaking, WorkspaceRow, compute_workspace};
use cdpr_dynamics::Damping;
use cdpr_robot::{Axis, Rotation3};
use cdpr_statics::Load;
use cdpr_study::{ErrorModel, Grid, GridAxis, uncertainties};
use numpy::{IxDyn, PyArray1, PyArrayMethods};
use pyo3::prelude::*;
use pyo3::types::PyDict;
use std::sync::atomic::Ordering;

answer! {
    /// Results at level positions on a grid, x slowest and z fastest; NaN where there is no answer.
    #[pyclass(frozen, get_all, module = "cdpr")]
    pub(crate) struct Workspace {
        /// Number of positions along x, y and z.
        shape: (usize, usize, usize),
        /// Positions of P [m], (m, 3).
        positions: Py<PyAny>,
        /// `held`, `beyond_limits`, or the kind of failure; m of them.
        ///
        /// The lengths are kept under the load. A position is `beyond_limits` where the load takes a tension
        /// out of the limits.
        status: Vec<String>,
        /// Why a position is not held, None if it is; m of them.
        reasons: Vec<Option<String>>,
        /// Least tension, without and with the load [N], (m,).
        least_tension: Py<PyAny>,
        /// Greatest tension, without and with the load [N], (m,).
        greatest_tension: Py<PyAny>,
        /// Displacement dp of P under the payload [m], (m, 3).
        displacement: Py<PyAny>,
        /// Norm |dp| of the displacement [m], (m,).
        magnitude: Py<PyAny>,
        /// Stiffness of the softest motion with the load [N/m], (m,).
        least_stiffness: Py<PyAny>,
        /// Frequency with which the platform swings with the load, the mass of cables included [Hz], (m,);
        /// NaN for a robot without inertia.
        platform_frequency: Py<PyAny>,
        /// Share of the platform in the kinetic energy of that motion, (m,).
        platform_share: Py<PyAny>,
        /// Lowest natural frequency of platform and cables with the load [Hz], (m,).
        lowest_frequency: Py<PyAny>,
        /// Uncertain parameter with the largest share of the variance of |dp|, or None; m of them.
        dominant: Vec<Option<String>>,
        /// Share of that parameter, 0 to 1, (m,).
        dominant_share: Py<PyAny>,
        /// Standard deviation of |dp| from all uncertain parameters [m], (m,).
        std: Py<PyAny>,
        /// `held` where tensions recomputed hold the position under the load, or the kind of failure;
        /// None without a load; m of them.
        recomputed_status: Vec<Option<String>>,
        /// Why no tensions recomputed hold a position, None if they do; m of them.
        recomputed_reasons: Vec<Option<String>>,
        /// Least tension, recomputed [N], (m,).
        recomputed_least_tension: Py<PyAny>,
        /// Greatest tension, recomputed [N], (m,).
        recomputed_greatest_tension: Py<PyAny>,
        /// Largest amplitude of the point in the band by a force there, of the worst direction [m/N], (m,);
        /// NaN without `band`.
        amplitude: Py<PyAny>,
        /// Its frequency [Hz], (m,).
        amplitude_frequency: Py<PyAny>,
        /// Largest amplitude of the point in the band by a winch, per length that it takes in [m/m], (m,).
        winch_amplitude: Py<PyAny>,
        /// Its frequency [Hz], (m,).
        winch_frequency: Py<PyAny>,
        /// Why a position that is held has no amplitude, or None; m of them.
        amplitude_reasons: Vec<Option<String>>,
    }
}

plotted!(Workspace);

/// Number of points of a plane along its two axes.
const POINTS: (usize, usize) = (41, 41);

#[pymethods]
impl Robot {
    /// Finds where the cables hold the platform under a payload, and how far it gives there.
    ///
    /// Positions are on a grid, with the platform level.
    ///
    /// Parameters
    /// ----------
    /// x, y, z : float or (float, float, int), optional
    ///     Coordinates along each axis [m]: a number, or (from, to, points).
    /// plane : (str, float), optional
    ///     In place of x, y and z, a plane over the frame of the exit points, ("z", 1.75).
    /// grid : (int, int), optional
    ///     Points of the plane along its two axes; (41, 41) if left out.
    /// payload : float
    ///     Mass added at the platform's centre of mass [kg]; with 0 there is no deflection.
    /// uncertainty : dict of float, optional
    ///     Standard deviations of parameters or groups [SI units]: {"a": 0.002, "mass": 0.5}.
    /// free : sequence of str, optional
    ///     Names of the coordinates of the pose that are found, for a robot with fewer cables than free
    ///     motions, as `Robot.inverse` takes them.
    /// band : (float, float), optional
    ///     The lowest and the highest frequency of what shakes the platform [Hz], for the largest amplitudes.
    ///     An inertia that the robot lacks is assumed: that of a ball as large as the platform.
    /// damping, drag : float
    ///     What damps the cables, as in `Robot.response` [s, 1/s].
    /// marker : array_like, optional
    ///     Point of the platform that is shaken and that moves, in its frame [m]; P if left out.
    ///
    /// Returns
    /// -------
    /// Workspace
    ///     Results at each position of the grid.
    ///
    /// Raises
    /// ------
    /// InputError
    ///     For an invalid value; the message names it and what would be right. A position that is not held
    ///     is no error.
    ///
    /// Examples
    /// --------
    /// >>> import cdpr
    /// >>> robot = cdpr.Robot.from_file("cogiro")
    /// >>> found = robot.workspace(plane=("z", 2), grid=(4, 3), payload=50)
    /// >>> found.shape, found.magnitude.shape  # [m]
    /// ((4, 3, 1), (12,))
    /// >>> shaken = robot.workspace(plane=("z", 2), grid=(3, 3), payload=0, band=(0, 4), drag=0.5)
    /// >>> bool(shaken.amplitude[4] > 0)  # in the middle [m/N]
    /// True
    #[pyo3(signature = (*, x=None, y=None, z=None, plane=None, grid=None, payload, uncertainty=None,
        free=None, band=None, damping=2e-4, drag=0.0, marker=None))]
    #[allow(clippy::too_many_arguments)]
    fn workspace(
        &self,
        py: Python,
        x: Option<Numbers>,
        y: Option<Numbers>,
        z: Option<Numbers>,
        plane: Option<(String, f64)>,
        grid: Option<(usize, usize)>,
        payload: f64,
        uncertainty: Option<&Bound<PyDict>>,
        free: Option<Vec<String>>,
        band: Option<(f64, f64)>,
        damping: f64,
        drag: f64,
        marker: Option<Numbers>,
    ) -> Answer<Workspace> {
        let free = coordinates(free)?;
        let grid = grid_of(&self.robot, x, y, z, plane, grid)?;
        let tolerances = uncertainty.map(|named| tolerances(&self.robot, named)).transpose()?;
        let marker = marker.map_or(Ok([0.0; 3]), |marker| components("marker", &marker))?.into();
        let damping = Damping { stretch: damping, drag };
        let shaking = band.map(|(from, to)| Shaking { band: [from, to], damping, marker });
        let workspace = cdpr_assess::Workspace {
            robot: &self.robot,
            grid,
            rotation: Rotation3::identity(),
            load: Load::payload(payload),
            tolerances: tolerances.as_ref(),
            free: &free,
            further: cdpr_assess::Further { shaking, ..Default::default() },
        };
        let poses = run(py, |stop| compute_workspace(&workspace, &|| (), &|| stop.load(Ordering::Relaxed)))??;
        let rows: Vec<WorkspaceRow> = poses.iter().map(|pose| WorkspaceRow::new(&workspace, pose)).collect();
        let column = |value: &dyn Fn(usize) -> Option<f64>| -> Py<PyAny> {
            let values = (0..rows.len()).map(|row| value(row).unwrap_or(f64::NAN)).collect();
            PyArray1::from_vec(py, values).into_any().unbind()
        };
        let vectors = |value: &dyn Fn(usize) -> Option<[f64; 3]>| -> PyResult<Py<PyAny>> {
            let values = (0..rows.len()).flat_map(|row| value(row).unwrap_or([f64::NAN; 3])).collect();
            Ok(PyArray1::<f64>::from_vec(py, values).reshape(IxDyn(&[rows.len(), 3]))?.into_any().unbind())
        };
        let held = |row: usize| poses[row].outcome.as_ref().ok();
        let loaded = |row: usize| held(row).filter(|_| workspace.load != Load::none());
        let shaken = |row: usize| poses[row].shaken.as_deref()?.as_ref().ok();
        Ok(Workspace {
            shape: Axis::ALL.map(|axis| grid.axis(axis).points).into(),
            positions: vectors(&|row| Some(poses[row].pose.position.into()))?,
            status: rows.iter().map(|row| row.status.to_owned()).collect(),
            reasons: rows.iter().map(|row| row.reason.clone()).collect(),
            least_tension: column(&|row| Some(held(row)?.least_tension)),
            greatest_tension: column(&|row| Some(held(row)?.greatest_tension)),
            displacement: vectors(&|row| Some(loaded(row)?.displacement.into()))?,
            magnitude: column(&|row| Some(loaded(row)?.displacement.norm())),
            least_stiffness: column(&|row| Some(held(row)?.least_stiffness)),
            platform_frequency: column(&|row| Some(held(row)?.swing?.platform)),
            platform_share: column(&|row| Some(held(row)?.swing?.platform_share)),
            lowest_frequency: column(&|row| Some(held(row)?.swing?.lowest)),
            dominant: rows.iter().map(|row| row.dominant.clone()).collect(),
            dominant_share: column(&|row| Some(held(row)?.dominant?.share)),
            std: column(&|row| Some(held(row)?.dominant?.std)),
            recomputed_status: rows.iter().map(|row| row.recomputed_status.map(str::to_owned)).collect(),
            recomputed_reasons: rows.iter().map(|row| row.recomputed_reason.clone()).collect(),
            recomputed_least_tension: column(&|row| rows[row].recomputed_least_tension_n),
            recomputed_greatest_tension: column(&|row| rows[row].recomputed_greatest_tension_n),
            amplitude: column(&|row| Some(shaken(row)?.per_force.amplitude)),
            amplitude_frequency: column(&|row| Some(shaken(row)?.per_force.frequency)),
            winch_amplitude: column(&|row| Some(shaken(row)?.per_shortening.amplitude)),
            winch_frequency: column(&|row| Some(shaken(row)?.per_shortening.frequency)),
            amplitude_reasons: rows.iter().map(|row| row.amplitude_reason.clone()).collect(),
        })
    }
}

/// The positions of a box, or of a plane over the frame of the exit points.
pub(crate) fn grid_of(
    robot: &cdpr_robot::Robot,
    x: Option<Numbers>,
    y: Option<Numbers>,
    z: Option<Numbers>,
    plane: Option<(String, f64)>,
    grid: Option<(usize, usize)>,
) -> Answer<Grid> {
    match (x, y, z, plane, grid) {
        (Some(x), Some(y), Some(z), None, None) => {
            Ok(Grid::new([places("x", &x)?, places("y", &y)?, places("z", &z)?])?)
        }
        (None, None, None, Some((axis, place)), points) => {
            Ok(Grid::over_frame(robot, normal(&axis)?, place, points.unwrap_or(POINTS).into())?)
        }
        _ => Err(Raised::Input("expected x, y and z, or plane with its grid".to_owned())),
    }
}

/// Coordinates along an axis: one, or from, to and their number.
fn places(name: &str, numbers: &Numbers) -> Answer<GridAxis> {
    let Array { shape, values } = Array::new(name, numbers)?;
    match (shape.len(), &values[..]) {
        (0, [place]) => Ok(GridAxis { min: *place, max: *place, points: 1 }),
        // Whole numbers, of which all that memory can hold are exact.
        (1, [min, max, points]) if *points >= 1.0 && points.fract() == 0.0 => {
            Ok(GridAxis { min: *min, max: *max, points: *points as usize })
        }
        _ => Err(Raised::Input(format!(
            "{name} is {numbers}: expected a coordinate [m], or from, to, and a number of points"
        ))),
    }
}

fn normal(axis: &str) -> Answer<Axis> {
    let expected = "expected x, y or z with a coordinate, such as (\"z\", 1.75)";
    Axis::from_letter(axis).ok_or_else(|| Raised::Input(format!("plane is {axis}: {expected}")))
}

/// Normal deviations of the parameters that are named, by themselves or by their group.
pub(crate) fn tolerances(robot: &cdpr_robot::Robot, named: &Bound<PyDict>) -> Answer<ErrorModel> {
    let named: Vec<(String, f64)> =
        named.iter().map(|(name, std)| Ok((name.extract()?, std.extract()?))).collect::<PyResult<_>>()?;
    let model = ErrorModel::normal(robot, &uncertainties(robot, &named)?);
    question(model.doubts(robot))?;
    Ok(model)
}
