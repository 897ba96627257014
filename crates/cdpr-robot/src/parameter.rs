//! The uncertain parameters of a robot as one vector (section 4 of Baklouti, Caro, Courteille 2017).
//!
//! For n cables there are `6 + 7n` parameters (62 for 8 cables): the platform's mass, the cables' linear
//! density and modulus, the coordinates of every anchor and exit point, the centre of mass, and an offset of
//! every tension set-point. A *deviation* is added to the nominal value.
//!
//! After these come, only where the robot has them: the radius of every pulley, the length of every lead, the
//! tilt of the swivel axis of every pulley, and the components of a gravity that is a vector. The axis k of a
//! pulley is tilted about the unit vectors
//!
//! ```text
//! u = (e_z x k)/|e_z x k|,  the x axis for a k along the z axis;   v = k x u
//! ```
//!
//! of the nominal robot, first by the angle about u and then by the one about v: nominally both are zero.

pub(crate) mod deviations;
pub(crate) mod layout;
pub(crate) mod perturbed;

use crate::axis::Axis;
use crate::error::RobotError;
use crate::robot::{Pulley, Robot, VERTICAL};
use nalgebra::Vector3;
use std::fmt;
use std::str::FromStr;

/// One uncertain parameter. Cables count from 0 here and from 1 in names (`a1.x`, as in the literature).
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Parameter {
    /// Mass of the platform [kg]: `mass`.
    Mass,
    /// Mass per length of all cables [kg/m]: `linear_density`.
    LinearDensity,
    /// Young's modulus of all cables [Pa]: `youngs_modulus`.
    YoungsModulus,
    /// Coordinate of an anchor point in the platform frame [m]: `a1.x`.
    AnchorPoint(usize, Axis),
    /// Coordinate of an exit point in the base frame [m]: `b1.x`.
    ExitPoint(usize, Axis),
    /// Coordinate of the centre of mass in the platform frame [m]: `cog.x`.
    CenterOfMass(Axis),
    /// Offset of a cable's tension set-point [N]: `dt1`.
    TensionOffset(usize),
    /// Radius of a cable's pulley [m]: `r1`.
    PulleyRadius(usize),
    /// Length of a cable's lead [m]: `lead1`.
    Lead(usize),
    /// Tilt of the swivel axis of a cable's pulley [rad]: `tilt1.u`.
    Tilt(usize, TiltAxis),
    /// Component of gravity in the base frame [m/s²]: `gravity.x`.
    Gravity(Axis),
}

/// An axis about which the swivel axis k of a pulley is tilted, normal to k and to the other one.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum TiltAxis {
    /// The horizontal one.
    U,
    /// The other one, `k x u`.
    V,
}

impl TiltAxis {
    /// Both axes in their order.
    pub const ALL: [Self; 2] = [Self::U, Self::V];

    /// Letter of the axis: `u` or `v`.
    pub const fn letter(self) -> &'static str {
        match self {
            Self::U => "u",
            Self::V => "v",
        }
    }

    /// The axis with this letter.
    pub fn from_letter(letter: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|axis| axis.letter() == letter)
    }

    /// The unit vector of this axis for a pulley, in the base frame.
    pub fn of(self, pulley: &Pulley) -> Vector3<f64> {
        let k = pulley.axis.normalize();
        let u = Vector3::z().cross(&k).try_normalize(VERTICAL).unwrap_or_else(Vector3::x);
        match self {
            Self::U => u,
            Self::V => k.cross(&u),
        }
    }
}

impl Parameter {
    /// The names of all parameters, as messages list them.
    pub const NAMES: &str = "mass, linear_density, youngs_modulus, a1.x ..., b1.x ... (anchor and exit point of cable 1), \
         cog.x ..., dt1 ...; with pulleys r1 ..., tilt1.u ...; with leads lead1 ...; with gravity as a vector gravity.x ...";

    /// Name of the group that a study can give one law: `a`, `b`, `cog`, `dt`, `r`, `lead`, `tilt` or
    /// `gravity`.
    ///
    /// A scalar is a group of its own and has its own name.
    pub fn group(&self) -> &'static str {
        match self {
            Self::Mass => "mass",
            Self::LinearDensity => "linear_density",
            Self::YoungsModulus => "youngs_modulus",
            Self::AnchorPoint(..) => "a",
            Self::ExitPoint(..) => "b",
            Self::CenterOfMass(_) => "cog",
            Self::TensionOffset(_) => "dt",
            Self::PulleyRadius(_) => "r",
            Self::Lead(_) => "lead",
            Self::Tilt(..) => "tilt",
            Self::Gravity(_) => "gravity",
        }
    }

    /// SI unit.
    pub fn unit(&self) -> &'static str {
        match self {
            Self::Mass => "kg",
            Self::LinearDensity => "kg/m",
            Self::YoungsModulus => "Pa",
            Self::AnchorPoint(..) | Self::ExitPoint(..) | Self::CenterOfMass(_) => "m",
            Self::PulleyRadius(_) | Self::Lead(_) => "m",
            Self::TensionOffset(_) => "N",
            Self::Tilt(..) => "rad",
            Self::Gravity(_) => "m/s\u{b2}",
        }
    }

    /// Nominal value in `robot`, in [`Parameter::unit`].
    ///
    /// It is that of the first cable for what all cables share, and zero for an offset, for a tilt and for
    /// what the robot does not have.
    pub fn nominal(&self, robot: &Robot) -> f64 {
        match *self {
            Self::Mass => robot.platform.mass,
            Self::LinearDensity => robot.cables[0].properties.linear_density,
            Self::YoungsModulus => robot.cables[0].properties.youngs_modulus,
            Self::AnchorPoint(i, axis) => robot.cables[i].anchor_point[axis.index()],
            Self::ExitPoint(i, axis) => robot.cables[i].exit_point[axis.index()],
            Self::CenterOfMass(axis) => robot.platform.center_of_mass[axis.index()],
            Self::TensionOffset(_) | Self::Tilt(..) => 0.0,
            Self::PulleyRadius(i) => robot.cables[i].pulley.map_or(0.0, |pulley| pulley.radius),
            Self::Lead(i) => robot.cables[i].lead,
            Self::Gravity(axis) => robot.gravity.vector()[axis.index()],
        }
    }
}

impl fmt::Display for Parameter {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::AnchorPoint(i, axis) => write!(f, "a{}.{}", i + 1, axis),
            Self::ExitPoint(i, axis) => write!(f, "b{}.{}", i + 1, axis),
            Self::CenterOfMass(axis) => write!(f, "cog.{axis}"),
            Self::TensionOffset(i) => write!(f, "dt{}", i + 1),
            Self::PulleyRadius(i) => write!(f, "r{}", i + 1),
            Self::Lead(i) => write!(f, "lead{}", i + 1),
            Self::Tilt(i, axis) => write!(f, "tilt{}.{}", i + 1, axis.letter()),
            Self::Gravity(axis) => write!(f, "gravity.{axis}"),
            scalar => f.write_str(scalar.group()),
        }
    }
}

impl FromStr for Parameter {
    type Err = RobotError;

    fn from_str(name: &str) -> Result<Self, RobotError> {
        parse(name).ok_or_else(|| RobotError::UnknownParameter {
            name: name.to_owned(),
            expected: Self::NAMES.to_owned(),
        })
    }
}

fn parse(name: &str) -> Option<Parameter> {
    match name {
        "mass" => return Some(Parameter::Mass),
        "linear_density" => return Some(Parameter::LinearDensity),
        "youngs_modulus" => return Some(Parameter::YoungsModulus),
        _ => {}
    }
    let (stem, axis) = name.split_once('.').map_or((name, None), |(stem, axis)| (stem, Some(axis)));
    let (word, number) = stem.split_at(stem.find(|c: char| c.is_ascii_digit()).unwrap_or(stem.len()));
    let cable = || number.parse::<usize>().ok()?.checked_sub(1);
    Some(match (word, axis, number) {
        ("dt", None, _) => Parameter::TensionOffset(cable()?),
        ("r", None, _) => Parameter::PulleyRadius(cable()?),
        ("lead", None, _) => Parameter::Lead(cable()?),
        ("tilt", Some(axis), _) => Parameter::Tilt(cable()?, TiltAxis::from_letter(axis)?),
        ("a", Some(axis), _) => Parameter::AnchorPoint(cable()?, Axis::from_letter(axis)?),
        ("b", Some(axis), _) => Parameter::ExitPoint(cable()?, Axis::from_letter(axis)?),
        ("cog", Some(axis), "") => Parameter::CenterOfMass(Axis::from_letter(axis)?),
        ("gravity", Some(axis), "") => Parameter::Gravity(Axis::from_letter(axis)?),
        _ => return None,
    })
}

#[cfg(test)]
mod tests;
