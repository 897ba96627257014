//! What a robot is made of, as arrays.

pub(crate) mod cable;

use crate::robot::Robot;
use cable::Cable;
use cdpr_robot::{CableProperties, Parameter, RobotCable, TensionLimits, Vector3};
use numpy::{PyArray1, PyArray2};
use pyo3::prelude::*;
use pyo3::types::{PyDict, PyFloat};

#[pymethods]
impl Robot {
    /// Name of the robot.
    #[getter]
    fn name(&self) -> &str {
        &self.robot.name
    }

    /// Number of cables n.
    #[getter]
    fn n_cables(&self) -> usize {
        self.robot.cables.len()
    }

    /// The cables, n of them.
    #[getter]
    fn cables(&self, py: Python) -> Vec<Cable> {
        (0..self.robot.cables.len()).map(|i| Cable::of(py, &self.robot, i)).collect()
    }

    /// Points A_i in the platform frame [m], (n, 3).
    #[getter]
    fn anchor_points<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyArray2<f64>>> {
        self.points(py, |cable| &cable.anchor_point)
    }

    /// Points B_i in the base frame [m], (n, 3).
    #[getter]
    fn exit_points<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyArray2<f64>>> {
        self.points(py, |cable| &cable.exit_point)
    }

    /// Mass of the platform [kg].
    #[getter]
    fn mass(&self) -> f64 {
        self.robot.platform.mass
    }

    /// Centre of mass in the platform frame [m], (3,).
    #[getter]
    fn center_of_mass<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray1<f64>> {
        PyArray1::from_slice(py, self.robot.platform.center_of_mass.as_slice())
    }

    /// Section of each cable that carries its tension [m²], (n,).
    #[getter]
    fn section<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray1<f64>> {
        self.properties(py, |cable| cable.section)
    }

    /// Mass of each cable per unstrained length [kg/m], (n,).
    #[getter]
    fn linear_density<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray1<f64>> {
        self.properties(py, |cable| cable.linear_density)
    }

    /// Young's modulus of each cable [Pa], (n,).
    #[getter]
    fn youngs_modulus<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray1<f64>> {
        self.properties(py, |cable| cable.youngs_modulus)
    }

    /// Least and greatest tension of a cable that has no limits of its own [N].
    #[getter]
    fn tension_limits(&self) -> (f64, f64) {
        (self.robot.tension_limits.min, self.robot.tension_limits.max)
    }

    /// Least and greatest tension of each cable [N], (n, 2).
    #[getter]
    fn cable_limits<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyArray2<f64>>> {
        let of_cable = |i| {
            let TensionLimits { min, max } = self.robot.limits(i);
            vec![min, max]
        };
        let rows: Vec<Vec<f64>> = (0..self.robot.cables.len()).map(of_cable).collect();
        Ok(PyArray2::from_vec2(py, &rows)?)
    }

    /// The end at which the greatest tension of each cable is limited: "anchor" or "exit".
    #[getter]
    fn max_at(&self) -> Vec<&'static str> {
        (0..self.robot.cables.len()).map(|i| cable::name_of(self.robot.max_at(i))).collect()
    }

    /// Height of the ground in the base frame [m]; None where it is not known.
    #[getter]
    fn ground_z(&self) -> Option<f64> {
        self.robot.ground_z
    }

    /// Tension of each cable that the inverse model comes as near to as it can [N], (n,); zeros for the least
    /// norm.
    #[getter]
    fn tension_reference<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray1<f64>> {
        PyArray1::from_vec(py, self.robot.reference())
    }

    /// Which tensions the inverse model chooses: "nearest", "least_1_norm", "least_2_norm" or
    /// "least_infinity_norm".
    #[getter]
    fn distribution(&self) -> &'static str {
        self.robot.distribution.name()
    }

    /// Acceleration due to gravity [m/s²] as it was given: a number along -z of the base frame, or a vector
    /// in it, (3,).
    #[getter]
    fn gravity<'py>(&self, py: Python<'py>) -> Bound<'py, PyAny> {
        let gravity = self.robot.gravity;
        if gravity.is_vector() {
            PyArray1::from_slice(py, gravity.vector().as_slice()).into_any()
        } else {
            PyFloat::new(py, gravity.magnitude()).into_any()
        }
    }

    /// All parameters that studies know, by name, with their values in SI units.
    ///
    /// They are mass, linear_density, youngs_modulus, a1.x ..., b1.x ..., cog.x ..., dt1 ... (offsets of
    /// tension set-points, zero), and where the robot has them r1 ... (radii of pulleys), lead1 ..., tilt1.u,
    /// tilt1.v ... (tilts of swivel axes, zero) and gravity.x ... of a vector. All cables share one linear
    /// density and one modulus here: the value is the first cable's.
    #[getter]
    fn parameters<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        let values = PyDict::new(py);
        for parameter in Parameter::of(&self.robot) {
            values.set_item(parameter.to_string(), parameter.nominal(&self.robot))?;
        }
        Ok(values)
    }
}

impl Robot {
    fn points<'py>(
        &self,
        py: Python<'py>,
        point: impl Fn(&RobotCable) -> &Vector3<f64>,
    ) -> PyResult<Bound<'py, PyArray2<f64>>> {
        let rows: Vec<Vec<f64>> =
            self.robot.cables.iter().map(|cable| point(cable).iter().copied().collect()).collect();
        Ok(PyArray2::from_vec2(py, &rows)?)
    }

    fn properties<'py>(
        &self,
        py: Python<'py>,
        property: impl Fn(&CableProperties) -> f64,
    ) -> Bound<'py, PyArray1<f64>> {
        PyArray1::from_iter(py, self.robot.cables.iter().map(|cable| property(&cable.properties)))
    }
}
