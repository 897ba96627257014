//! The class `Robot`: made from a file, a JSON text or arrays; its parameters.
//!
//! Each model is a method in a file of the folder.

mod arguments;
pub(crate) mod bearing;
pub(crate) mod boundary;
pub(crate) mod certify;
mod content;
pub(crate) mod deflection;
pub(crate) mod derivatives;
pub(crate) mod direct;
pub(crate) mod inverse;
pub(crate) mod motion;
pub(crate) mod observe;
pub(crate) mod path;
pub(crate) mod pose;
pub(crate) mod properties;
pub(crate) mod stiffness;
pub(crate) mod workspace;

use crate::convert::{Answer, Numbers, Raised, components, guarded, question};
use cdpr_robot::{
    CableProperties, Platform, Provenance, RobotCable, TensionDistribution, Vector3, plausible,
};
use pyo3::prelude::*;
use pyo3::types::{PyTuple, PyType};
use std::hash::{DefaultHasher, Hash, Hasher};

/// A cable-driven parallel robot with n cables.
///
/// A robot does not change: `with_parameters` makes another one. Units are SI, and z points up in the base
/// frame. A pose is x, y, z [m], or x, y, z, qw, qx, qy, qz.
///
/// Parameters
/// ----------
/// anchor_points : array_like
///     (n, 3), points A_i in the platform frame [m].
/// exit_points : array_like
///     (n, 3), points B_i in the base frame [m].
/// mass : float
///     Mass of the platform [kg].
/// section : array_like
///     Section that carries the tension [m²]; one number, or one for each cable, as for the next two.
/// linear_density : array_like
///     Mass per unstrained length [kg/m].
/// youngs_modulus : array_like
///     Young's modulus [Pa].
/// tension_limits : array_like
///     Least and greatest tension of a cable [N], (2,), or one row for each cable, (n, 2).
/// center_of_mass : array_like, optional
///     Centre of mass in the platform frame [m]; P if left out.
/// gravity : array_like, optional
///     Acceleration due to gravity [m/s²], a number along -z of the base frame or a vector in it, (3,);
///     9.81 if left out.
/// name : str, optional
///     Name of the robot; "robot" if left out.
/// max_at : str, default 'anchor'
///     The end at which the greatest tension is limited, "anchor", on the platform, or "exit", where
///     the limit is the winch's.
/// tension_reference : array_like or str, optional
///     Tensions that those of the inverse model come as near to as they can: a number for all cables
///     [N], one for each, or "mid", the middle of the limits; the least norm if left out.
/// distribution : str, default 'nearest'
///     Which tensions the inverse model chooses: "nearest" to tension_reference, or of "least_1_norm",
///     "least_2_norm" or "least_infinity_norm". Derivatives, paths and studies refuse the 1-norm and
///     the infinity-norm, whose tensions jump from pose to pose.
/// point : bool, default False
///     Whether the platform is a point mass: its rotation is held.
/// plane : str, optional
///     "xy", "xz" or "yz" for a planar robot, whose platform moves in this plane of the base frame.
/// ground_z : float, optional
///     Height of the ground in the base frame [m]: with free coordinates no cable and no anchor point
///     is below it.
///
/// Raises
/// ------
/// InputError
///     The message names the field, its value and what would be right.
///
/// Examples
/// --------
/// >>> import cdpr
/// >>> robot = cdpr.Robot(
/// ...     [[0, 0, 0], [0, 0, 0], [0, 0, 0]],
/// ...     [[0, 0, 3], [4, 0, 3], [2, 3, 3]],
/// ...     mass=10.0,
/// ...     section=1.26e-5,
/// ...     linear_density=0.1,
/// ...     youngs_modulus=1e11,
/// ...     tension_limits=(1.0, 5000.0),
/// ...     point=True,
/// ... )
/// >>> robot.inverse([2, 1, 1]).tensions.shape  # [N]
/// (3,)
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
