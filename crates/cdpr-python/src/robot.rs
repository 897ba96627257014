//! The class `Robot`: made from a file, a JSON text or arrays; its parameters.
//!
//! Each model is a method in a file of the folder.

mod arguments;
pub(crate) mod boundary;
pub(crate) mod cable;
pub(crate) mod capacity;
pub(crate) mod certify;
pub(crate) mod deflection;
pub(crate) mod derivatives;
pub(crate) mod direct;
pub(crate) mod inverse;
pub(crate) mod modes;
pub(crate) mod observe;
pub(crate) mod path;
pub(crate) mod pose;
pub(crate) mod stiffness;
pub(crate) mod workspace;

use crate::convert::{Answer, Numbers, Raised, components, guarded, json_text, question};
use cable::Cable;
use cdpr_robot::{
    CableProperties, Parameter, Platform, Provenance, RobotCable, TensionDistribution, TensionLimits,
    Vector3, plausible,
};
use cdpr_study::open_robot;
use numpy::{PyArray1, PyArray2};
use pyo3::prelude::*;
use pyo3::types::{PyDict, PyFloat, PyTuple, PyType};
use std::hash::{DefaultHasher, Hash, Hasher};
use std::path::PathBuf;

/// A cable-driven parallel robot with n cables.
///
/// A robot does not change: `with_parameters` makes another one. Units are SI, and z points up in the base
/// frame. A pose is x, y, z [m], or x, y, z, qw, qx, qy, qz.
///
/// anchor_points: (n, 3), points A_i in the platform frame [m].
/// exit_points: (n, 3), points B_i in the base frame [m].
/// mass: mass of the platform [kg].
/// section: section that carries the tension [m²]; one number, or one for each cable, as for the next two.
/// linear_density: mass per unstrained length [kg/m].
/// youngs_modulus: Young's modulus [Pa].
/// tension_limits: least and greatest tension of a cable [N], (2,), or one row for each cable, (n, 2).
/// max_at: the end at which the greatest tension is limited, "anchor", on the platform, or "exit", where the
///     limit is the winch's.
/// tension_reference: tensions that those of the inverse model come as near to as they can: a number for all
///     cables [N], one for each, or "mid", the middle of the limits; the least norm if left out.
/// distribution: which tensions the inverse model chooses: "nearest" to tension_reference, or of "least_1_norm",
///     "least_2_norm" or "least_infinity_norm". Derivatives, paths and studies refuse the 1-norm and the
///     infinity-norm, whose tensions jump from pose to pose.
/// center_of_mass: centre of mass in the platform frame [m]; P if left out.
/// gravity: acceleration due to gravity [m/s²], a number along -z of the base frame or a vector in it, (3,);
///     9.81 if left out.
/// point: whether the platform is a point mass: its rotation is held.
/// plane: "xy", "xz" or "yz" for a planar robot, whose platform moves in this plane of the base frame.
/// ground_z: height of the ground in the base frame [m]: with free coordinates no cable and no anchor point is
///     below it.
///
/// Raises InputError naming the field, its value and what would be right.
#[pyclass(frozen, module = "cdpr")]
pub(crate) struct Robot {
    pub(crate) robot: cdpr_robot::Robot,
}

impl Robot {
    /// The robot; what is improbable of it is asked as warnings.
    fn questioned(robot: cdpr_robot::Robot) -> Answer<Self> {
        question(guarded(|| plausible::robot(&robot))?)?;
        Ok(Self { robot })
    }
}

#[pymethods]
impl Robot {
    #[new]
    #[pyo3(signature = (anchor_points, exit_points, *, mass, section, linear_density, youngs_modulus,
        tension_limits, center_of_mass = None, gravity = None, name = "robot".to_owned(), max_at = "anchor",
        tension_reference = None, distribution = "nearest", point = false, plane = None, ground_z = None))]
    #[allow(clippy::too_many_arguments)]
    fn new(
        anchor_points: Numbers,
        exit_points: Numbers,
        mass: f64,
        section: Numbers,
        linear_density: Numbers,
        youngs_modulus: Numbers,
        tension_limits: Numbers,
        center_of_mass: Option<Numbers>,
        gravity: Option<Numbers>,
        name: String,
        max_at: &str,
        tension_reference: Option<Numbers>,
        distribution: &str,
        point: bool,
        plane: Option<&str>,
        ground_z: Option<f64>,
    ) -> Answer<Self> {
        let (anchors, exits) = (
            arguments::points("anchor_points", &anchor_points)?,
            arguments::points("exit_points", &exit_points)?,
        );
        if anchors.len() != exits.len() {
            let (value, expected) = (exits.len(), anchors.len());
            return Err(Raised::Input(format!(
                "exit_points has {value} rows: expected {expected}, as anchor_points"
            )));
        }
        let sections = arguments::of_cables("section", &section, anchors.len())?;
        let densities = arguments::of_cables("linear_density", &linear_density, anchors.len())?;
        let moduli = arguments::of_cables("youngs_modulus", &youngs_modulus, anchors.len())?;
        let (tension_limits, own_limits) = arguments::limits(&tension_limits, anchors.len())?;
        let cables = (0..anchors.len())
            .map(|i| RobotCable {
                tension_limits: own_limits[i],
                ..RobotCable::between(
                    exits[i],
                    anchors[i],
                    CableProperties::linear(sections[i], densities[i], moduli[i]),
                )
            })
            .collect();
        let center_of_mass = match center_of_mass {
            Some(point) => components("center_of_mass", &point)?.into(),
            None => Vector3::zeros(),
        };
        let robot = cdpr_robot::Robot {
            name,
            provenance: Provenance::default(),
            gravity: gravity.as_ref().map_or(Ok(arguments::EARTH.into()), arguments::gravity)?,
            platform: Platform { point, ..Platform::new(mass, center_of_mass) },
            plane: plane.map(arguments::plane_of).transpose()?,
            ground_z,
            tension_limits,
            max_at: arguments::end_of(max_at)?,
            tension_reference: tension_reference.as_ref().map(arguments::reference).transpose()?,
            distribution: distribution.parse::<TensionDistribution>()?,
            cables,
        };
        robot.validate()?;
        robot.check_units()?;
        Self::questioned(robot)
    }

    /// Reads a robot file (`cdpr-robot/1`), or a robot of the library by its name, `cogiro`.
    ///
    /// Raises FileError, and InputError with line, column, field and what would be right.
    #[staticmethod]
    fn from_file(path: PathBuf) -> Answer<Self> {
        Self::questioned(guarded(|| open_robot(&path))??)
    }

    /// Makes a robot from the text of a robot file.
    #[staticmethod]
    fn from_json(text: &str) -> Answer<Self> {
        Self::questioned(guarded(|| cdpr_robot::Robot::from_json(text))??)
    }

    /// Makes a robot from the dictionary that `json.loads` makes of a robot file.
    ///
    /// It may hold numbers and arrays of NumPy.
    #[staticmethod]
    fn from_dict(content: &Bound<PyDict>) -> Answer<Self> {
        Self::from_json(&json_text("content", content)?)
    }

    /// The robot file as text.
    fn to_json(&self) -> String {
        self.robot.to_json()
    }

    /// The robot file as a dictionary.
    fn to_dict<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        py.import("json")?.call_method1("loads", (self.to_json(),))
    }

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

    /// Makes a robot whose inverse model prefers other tensions.
    ///
    /// reference: a number for all cables [N], one for each, "mid" for the middle of the limits, or None for
    ///     the least norm.
    ///
    /// Raises InputError for a negative tension or another number of them than of cables.
    #[pyo3(signature = (reference))]
    fn with_tension_reference(&self, reference: Option<Numbers>) -> Answer<Self> {
        let tension_reference = reference.as_ref().map(arguments::reference).transpose()?;
        let distribution = TensionDistribution::Nearest;
        let robot = cdpr_robot::Robot { tension_reference, distribution, ..self.robot.clone() };
        robot.validate()?;
        Ok(Self { robot })
    }

    /// Which tensions the inverse model chooses: "nearest", "least_1_norm", "least_2_norm" or
    /// "least_infinity_norm".
    #[getter]
    fn distribution(&self) -> &'static str {
        self.robot.distribution.name()
    }

    /// Makes a robot whose inverse model chooses tensions in another way. A norm drops the tension reference.
    ///
    /// distribution: "nearest", "least_1_norm", "least_2_norm" or "least_infinity_norm".
    ///
    /// Raises InputError for another name.
    #[pyo3(signature = (distribution))]
    fn with_distribution(&self, distribution: &str) -> Answer<Self> {
        let mut robot = self.robot.clone();
        robot.choose(Some(distribution.parse()?), None);
        Ok(Self { robot })
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

    /// Makes a robot with other values of some parameters [SI units]: `{"mass": 185.0, "a1.x": 0.25}`.
    ///
    /// Names are those in `parameters`. `linear_density` and `youngs_modulus` are set for all cables. Offsets
    /// dt belong to a set-point and not to a robot: they can only be zero here; `deflection` takes them as
    /// `tension_offsets`.
    ///
    /// Raises InputError for a name or value that no such robot has.
    fn with_parameters(&self, values: &Bound<PyDict>) -> Answer<Self> {
        let values: Vec<(String, f64)> = values
            .iter()
            .map(|(name, value)| Ok((name.extract()?, value.extract()?)))
            .collect::<PyResult<_>>()?;
        let offsets: Vec<String> = (1..=self.robot.cables.len()).map(|cable| format!("dt{cable}")).collect();
        let (offsets, named): (Vec<_>, Vec<_>) = values
            .iter()
            .map(|(name, value)| (name.as_str(), *value))
            .partition(|(name, _)| offsets.iter().any(|offset| offset == name));
        if let Some((name, value)) = offsets.iter().find(|(_, value)| *value != 0.0) {
            return Err(Raised::Input(format!(
                "{name} is {value}: expected 0, as offsets belong to set-points; give them as tension_offsets"
            )));
        }
        Ok(Self { robot: self.robot.with_values(&named)? })
    }

    /// Makes a robot again for `pickle`, which carries it as its file.
    fn __reduce__<'py>(&self, py: Python<'py>) -> PyResult<(Bound<'py, PyAny>, Bound<'py, PyTuple>)> {
        let class: Bound<PyType> = py.get_type::<Self>();
        Ok((class.getattr("from_json")?, PyTuple::new(py, [self.to_json()])?))
    }

    /// Whether two robots have the same content of a robot file.
    fn __eq__(&self, other: &Self) -> bool {
        self.robot == other.robot
    }

    fn __hash__(&self) -> u64 {
        let mut hasher = DefaultHasher::new();
        self.robot.name.hash(&mut hasher);
        hasher.finish()
    }

    fn __repr__(&self) -> String {
        format!("<cdpr.Robot {}, {} cables>", self.robot.name, self.robot.cables.len())
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
