//! `Robot.boundary`: where the region that the cables hold ends.

use crate::convert::{Answer, Numbers, Raised, answer, plotted, run};
use crate::robot::Robot;
use crate::robot::inverse::coordinates;
use crate::robot::workspace::grid_of;
use cdpr_assess::{Way, workspace_boundary};
use cdpr_robot::{Rotation3, Vector3};
use cdpr_statics::Load;
use numpy::{IxDyn, PyArray1, PyArrayMethods};
use pyo3::prelude::*;
use std::sync::atomic::Ordering;

answer! {
    /// The boundary of the region that the cables hold.
    #[pyclass(frozen, get_all, module = "cdpr")]
    pub(crate) struct Boundary {
        /// Area in a plane [m²], volume in a box [m³].
        measure: f64,
        /// Estimate of its error [m², m³].
        error: f64,
        /// What of it is in doubt, since parts thinner than a step of the grid are not seen [m², m³].
        doubtful: f64,
        /// Closed polygons in a plane, the region on their left [m]: a list of arrays (.., 3).
        polygons: Vec<Py<PyAny>>,
        /// Triangles in a box, the region behind them [m], (t, 3, 3).
        triangles: Py<PyAny>,
        /// Number of positions that were asked for.
        evaluations: usize,
    }
}

plotted!(Boundary);

#[pymethods]
impl Robot {
    /// Finds the boundary of the region that the cables hold under a payload, with the platform level.
    ///
    /// Bisection moves it between the positions of a grid to where it is, so that a coarse grid does; a hole
    /// or an island that lies between the positions is not seen.
    ///
    /// Parameters
    /// ----------
    /// x : float or (float, float, int), optional
    ///     as `Robot.workspace` takes them: a plane or a box.
    /// y : float or (float, float, int), optional
    ///     as `Robot.workspace` takes them: a plane or a box.
    /// z : float or (float, float, int), optional
    ///     as `Robot.workspace` takes them: a plane or a box.
    /// plane : (str, float), optional
    ///     as `Robot.workspace` takes them: a plane or a box.
    /// grid : (int, int), optional
    ///     as `Robot.workspace` takes them: a plane or a box.
    /// payload : float
    ///     Mass added at the platform's centre of mass [kg].
    /// way : str, default 'recomputed'
    ///     How the load is borne: with the tensions "recomputed" by the winches, or the lengths "kept".
    /// free : sequence of str, optional
    ///     Names of the coordinates of the pose that are found, for a robot with fewer cables than free
    ///     motions.
    ///
    /// Returns
    /// -------
    /// Boundary
    ///     Polygons or triangles, and their area or volume.
    ///
    /// Raises
    /// ------
    /// InputError
    ///     For an invalid value; the message names it and what would be right.
    ///
    /// Examples
    /// --------
    /// >>> import cdpr
    /// >>> robot = cdpr.Robot.from_file("cogiro")
    /// >>> region = robot.boundary(plane=("z", 2), grid=(4, 4), payload=50)
    /// >>> region.polygons[0].shape[1], region.measure > 0  # [m], [m²]
    /// (3, True)
    #[pyo3(signature = (
        *, x=None, y=None, z=None, plane=None, grid=None, payload, way="recomputed", free=None
    ))]
    #[allow(clippy::too_many_arguments)]
    fn boundary(
        &self,
        py: Python,
        x: Option<Numbers>,
        y: Option<Numbers>,
        z: Option<Numbers>,
        plane: Option<(String, f64)>,
        grid: Option<(usize, usize)>,
        payload: f64,
        way: &str,
        free: Option<Vec<String>>,
    ) -> Answer<Boundary> {
        let free = coordinates(free)?;
        let way = match way {
            "recomputed" => Way::Recomputed,
            "kept" => Way::Kept,
            _ => return Err(Raised::Input(format!("way is {way:?}: expected recomputed or kept"))),
        };
        let workspace = cdpr_assess::Workspace {
            robot: &self.robot,
            grid: grid_of(&self.robot, x, y, z, plane, grid)?,
            rotation: Rotation3::identity(),
            load: Load::payload(payload),
            tolerances: None,
            free: &free,
            further: cdpr_assess::Further::default(),
        };
        let found = run(py, |stop| workspace_boundary(&workspace, way, &|| stop.load(Ordering::Relaxed)))??;
        let array =
            |points: &mut dyn Iterator<Item = &Vector3<f64>>, shape: &[usize]| -> PyResult<Py<PyAny>> {
                let numbers: Vec<f64> = points.flat_map(|point| point.iter().copied()).collect();
                Ok(PyArray1::from_vec(py, numbers).reshape(IxDyn(shape))?.into_any().unbind())
            };
        let polygons = found.polygons.iter().map(|points| array(&mut points.iter(), &[points.len(), 3]));
        Ok(Boundary {
            measure: found.measure,
            error: found.error,
            doubtful: found.doubtful,
            polygons: polygons.collect::<PyResult<_>>()?,
            triangles: array(&mut found.triangles.iter().flatten(), &[found.triangles.len(), 3, 3])?,
            evaluations: found.evaluations,
        })
    }
}
