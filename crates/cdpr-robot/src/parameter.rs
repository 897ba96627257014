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

use crate::axis::Axis;
use crate::error::RobotError;
use crate::robot::{Pulley, Robot, RobotCable, VERTICAL};
use nalgebra::{Rotation3, Unit, Vector3};
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

/// The order of the parameters in the vector of a robot.
///
/// A point stands as three coordinates one after the other: its methods give the index of the first.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct ParameterLayout {
    cables: usize,
    /// The parameters after those that every robot has.
    further: Vec<Parameter>,
}

impl ParameterLayout {
    /// The layout of a robot.
    pub fn of(robot: &Robot) -> Self {
        let cables = &robot.cables;
        let with = |has: fn(&RobotCable) -> bool| (0..cables.len()).filter(move |i| has(&cables[*i]));
        let pulleys = || with(|cable| cable.pulley.is_some());
        // A vector of zeros has no direction that could deviate.
        let directed = robot.gravity.is_vector() && robot.gravity.magnitude() > 0.0;
        let gravity = Axis::ALL.into_iter().filter(|_| directed);
        let further = pulleys()
            .map(Parameter::PulleyRadius)
            .chain(with(|cable| cable.lead != 0.0).map(Parameter::Lead))
            .chain(pulleys().flat_map(|i| TiltAxis::ALL.map(|axis| Parameter::Tilt(i, axis))))
            .chain(gravity.map(Parameter::Gravity))
            .collect();
        Self { cables: cables.len(), further }
    }

    /// Number of parameters: `6 + 7n`, and those that not every robot has.
    pub const fn count(&self) -> usize {
        self.first_further() + self.further.len()
    }

    /// The parameters, in their order.
    pub fn parameters(&self) -> Vec<Parameter> {
        let cables = self.cables;
        let points = |parameter: fn(usize, Axis) -> Parameter| {
            (0..cables).flat_map(move |i| Axis::ALL.map(move |axis| parameter(i, axis)))
        };
        [Parameter::Mass, Parameter::LinearDensity, Parameter::YoungsModulus]
            .into_iter()
            .chain(points(Parameter::AnchorPoint))
            .chain(points(Parameter::ExitPoint))
            .chain(Axis::ALL.map(Parameter::CenterOfMass))
            .chain((0..cables).map(Parameter::TensionOffset))
            .chain(self.further.iter().copied())
            .collect()
    }

    /// The names of the parameters, as messages list them.
    fn names(&self) -> String {
        format!("those of a robot with {} cables ({})", self.cables, Parameter::NAMES)
    }

    const fn first_further(&self) -> usize {
        self.tension_offset(self.cables)
    }

    /// Index of the platform's mass.
    pub const fn mass(&self) -> usize {
        0
    }

    /// Index of the cables' linear density.
    pub const fn linear_density(&self) -> usize {
        1
    }

    /// Index of the cables' modulus.
    pub const fn youngs_modulus(&self) -> usize {
        2
    }

    /// First index of anchor point `i`, from 0.
    pub const fn anchor_point(&self, i: usize) -> usize {
        3 + 3 * i
    }

    /// First index of exit point `i`, from 0.
    pub const fn exit_point(&self, i: usize) -> usize {
        self.anchor_point(self.cables) + 3 * i
    }

    /// First index of the centre of mass.
    pub const fn center_of_mass(&self) -> usize {
        self.exit_point(self.cables)
    }

    /// Index of the offset of tension set-point `i`, from 0.
    pub const fn tension_offset(&self, i: usize) -> usize {
        self.center_of_mass() + 3 + i
    }

    /// Index of a parameter; `None` for one that the robot does not have.
    pub fn index(&self, parameter: Parameter) -> Option<usize> {
        let (i, index) = match parameter {
            Parameter::Mass => (0, self.mass()),
            Parameter::LinearDensity => (0, self.linear_density()),
            Parameter::YoungsModulus => (0, self.youngs_modulus()),
            Parameter::AnchorPoint(i, axis) => (i, self.anchor_point(i) + axis.index()),
            Parameter::ExitPoint(i, axis) => (i, self.exit_point(i) + axis.index()),
            Parameter::CenterOfMass(axis) => (0, self.center_of_mass() + axis.index()),
            Parameter::TensionOffset(i) => (i, self.tension_offset(i)),
            further => {
                let position = self.further.iter().position(|own| *own == further)?;
                (0, self.first_further() + position)
            }
        };
        (i < self.cables).then_some(index)
    }
}

impl Parameter {
    /// The names of all parameters, as messages list them.
    pub const NAMES: &str = "mass, linear_density, youngs_modulus, a1.x ..., b1.x ..., cog.x ..., dt1 ...; \
         with pulleys r1 ..., tilt1.u ...; with leads lead1 ...; with gravity as a vector gravity.x ...";

    /// All parameters of a robot, in the order of [`ParameterLayout`].
    pub fn of(robot: &Robot) -> Vec<Self> {
        ParameterLayout::of(robot).parameters()
    }

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

    /// Changes the value of this parameter of the `nominal` robot, for all cables if they share it.
    fn change(&self, nominal: &Robot, perturbed: &mut Perturbed, change: impl Fn(&mut f64)) {
        let Perturbed { robot, tension_offsets } = perturbed;
        match *self {
            Self::Mass => change(&mut robot.platform.mass),
            Self::LinearDensity => {
                robot.cables.iter_mut().for_each(|cable| change(&mut cable.properties.linear_density));
            }
            Self::YoungsModulus => {
                robot.cables.iter_mut().for_each(|cable| change(&mut cable.properties.youngs_modulus));
            }
            Self::AnchorPoint(i, axis) => change(&mut robot.cables[i].anchor_point[axis.index()]),
            Self::ExitPoint(i, axis) => change(&mut robot.cables[i].exit_point[axis.index()]),
            Self::CenterOfMass(axis) => change(&mut robot.platform.center_of_mass[axis.index()]),
            Self::TensionOffset(i) => change(&mut tension_offsets[i]),
            Self::PulleyRadius(i) => {
                robot.cables[i].pulley.iter_mut().for_each(|pulley| change(&mut pulley.radius));
            }
            Self::Lead(i) => change(&mut robot.cables[i].lead),
            Self::Tilt(i, axis) => {
                let mut angle = 0.0;
                change(&mut angle);
                let pulleys = robot.cables[i].pulley.iter_mut().zip(&nominal.cables[i].pulley);
                for (pulley, nominal) in pulleys.filter(|_| angle != 0.0) {
                    let about = Unit::new_unchecked(axis.of(nominal));
                    pulley.axis = Rotation3::from_axis_angle(&about, angle) * pulley.axis;
                }
            }
            Self::Gravity(axis) => {
                let mut vector = robot.gravity.vector();
                change(&mut vector[axis.index()]);
                robot.gravity = vector.into();
            }
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

/// A robot with deviations added to its parameters.
#[derive(Clone, Debug, PartialEq)]
pub struct Perturbed {
    /// The perturbed robot.
    pub robot: Robot,
    /// Offset dt_i of every cable's tension set-point [N].
    pub tension_offsets: Vec<f64>,
}

impl Robot {
    /// The robot with one deviation added to each of its parameters, in the order of [`Parameter::of`].
    ///
    /// # Errors
    /// [`RobotError::DeviationCount`]; [`RobotError::Invalid`] if the perturbed robot is invalid, for example
    /// with a negative mass.
    pub fn perturbed(&self, deviations: &[f64]) -> Result<Perturbed, RobotError> {
        let parameters = Parameter::of(self);
        if deviations.len() != parameters.len() {
            return Err(RobotError::DeviationCount { given: deviations.len(), parameters: parameters.len() });
        }
        let mut perturbed = Perturbed { robot: self.clone(), tension_offsets: vec![0.0; self.cables.len()] };
        for (parameter, deviation) in parameters.iter().zip(deviations) {
            if !deviation.is_finite() {
                return Err(RobotError::invalid(parameter.to_string(), deviation, "a finite deviation"));
            }
            parameter.change(self, &mut perturbed, |value| *value += deviation);
        }
        perturbed.robot.validate()?;
        Ok(perturbed)
    }

    /// The robot with other values of some parameters, by name and in [`Parameter::unit`].
    ///
    /// # Errors
    /// [`RobotError::UnknownParameter`] for a name that the robot does not have, and for an offset of a
    /// tension, which is no property of a robot; [`RobotError::Invalid`] for an invalid value.
    pub fn with_values(&self, named: &[(&str, f64)]) -> Result<Self, RobotError> {
        let layout = ParameterLayout::of(self);
        let mut changed = Perturbed { robot: self.clone(), tension_offsets: Vec::new() };
        for (name, value) in named {
            let parameter: Parameter = name.parse()?;
            let exists = layout.index(parameter).is_some();
            if matches!(parameter, Parameter::TensionOffset(_)) || !exists {
                return Err(RobotError::UnknownParameter {
                    name: (*name).to_owned(),
                    expected: format!("{}; no offset dt of a tension", layout.names()),
                });
            }
            parameter.change(self, &mut changed, |old| *old = *value);
        }
        changed.robot.validate()?;
        Ok(changed.robot)
    }
}

/// The deviation vector of a robot that is zero except for the named parameters.
///
/// # Errors
/// [`RobotError::UnknownParameter`] for a name that the robot does not have.
pub fn deviations(robot: &Robot, named: &[(&str, f64)]) -> Result<Vec<f64>, RobotError> {
    let layout = ParameterLayout::of(robot);
    let mut deviations = vec![0.0; layout.count()];
    for (name, deviation) in named {
        let parameter: Parameter = name.parse()?;
        let index = layout.index(parameter).ok_or_else(|| RobotError::UnknownParameter {
            name: (*name).to_owned(),
            expected: layout.names(),
        })?;
        deviations[index] += deviation;
    }
    Ok(deviations)
}

#[cfg(test)]
mod tests {
    use super::*;

    const CAROCA: &str = include_str!("../../../data/robots/caroca.json");

    fn caroca() -> Robot {
        Robot::from_json(CAROCA).unwrap()
    }

    /// CAROCA with so many cables, the first three on pulleys, the second with a lead, its gravity a vector.
    fn guided(cables: usize) -> Robot {
        let mut robot = caroca();
        robot.cables = robot.cables.iter().cycle().take(cables).cloned().collect();
        for (i, axis) in [Vector3::z(), -Vector3::z(), Vector3::new(0.0, 0.6, 0.8)].into_iter().enumerate() {
            robot.cables[i].pulley = Some(Pulley { radius: 0.045, axis });
        }
        robot.cables[1].lead = 3.0;
        robot.gravity = Vector3::new(0.3, -0.2, -9.8).into();
        robot
    }

    #[test]
    fn eight_cables_have_the_62_parameters_of_the_paper() {
        let parameters = Parameter::of(&caroca());
        let names: Vec<String> = parameters.iter().map(ToString::to_string).collect();
        assert_eq!(names.len(), 62);
        assert_eq!(names[..4], ["mass", "linear_density", "youngs_modulus", "a1.x"]);
        assert_eq!(names[26..28], ["a8.z", "b1.x"]);
        assert_eq!(names[50..55], ["b8.z", "cog.x", "cog.y", "cog.z", "dt1"]);
        assert_eq!(names[61], "dt8");
        let geometric = parameters.iter().filter(|p| p.unit() == "m").count();
        assert_eq!((geometric, 62 - geometric), (51, 11));
    }

    #[test]
    fn pulleys_leads_and_a_vector_of_gravity_come_after_the_parameters_of_every_robot() {
        let names: Vec<String> = Parameter::of(&guided(8)).iter().map(ToString::to_string).collect();
        let tilts = ["tilt1.u", "tilt1.v", "tilt2.u", "tilt2.v", "tilt3.u", "tilt3.v"];
        assert_eq!(names[61..66], ["dt8", "r1", "r2", "r3", "lead2"]);
        assert_eq!(names[66..72], tilts);
        assert_eq!(names[72..], ["gravity.x", "gravity.y", "gravity.z"]);
    }

    #[test]
    fn the_layout_gives_the_index_of_every_parameter() {
        for robot in (6..=16).flat_map(|cables| {
            let mut plain = caroca();
            plain.cables = plain.cables.iter().cycle().take(cables).cloned().collect();
            [plain, guided(cables)]
        }) {
            let (layout, all) = (ParameterLayout::of(&robot), Parameter::of(&robot));
            assert_eq!(all.len(), layout.count());
            let indices: Vec<_> = all.iter().map(|parameter| layout.index(*parameter)).collect();
            assert_eq!(indices, (0..layout.count()).map(Some).collect::<Vec<_>>());
            for absent in [Parameter::AnchorPoint(robot.cables.len(), Axis::X), Parameter::PulleyRadius(3)] {
                assert_eq!(layout.index(absent), None);
            }
        }
    }

    #[test]
    fn names_are_read_back() {
        for cables in 6..=16 {
            for parameter in Parameter::of(&guided(cables)) {
                assert_eq!(parameter.to_string().parse(), Ok(parameter));
            }
        }
        for name in [
            "",
            "a",
            "a0.x",
            "a1.w",
            "a1",
            "b.x",
            "dt",
            "dt0",
            "c1.x",
            "Mass",
            "ä1.x",
            "r",
            "r0",
            "r1.x",
            "lead",
            "lead0",
            "tilt1",
            "tilt1.x",
            "tilt0.u",
            "a1.u",
            "gravity",
            "gravity.u",
        ] {
            assert!(name.parse::<Parameter>().is_err(), "{name}");
        }
    }

    #[test]
    fn a_robot_with_another_value_has_that_very_value() {
        for robot in [caroca(), guided(8)] {
            let parameters = Parameter::of(&robot);
            let own = |p: &&Parameter| !matches!(p, Parameter::TensionOffset(_) | Parameter::Tilt(..));
            for (parameter, value) in parameters.iter().filter(own).zip(1..) {
                let value = f64::from(value) / 3.0;
                let mut changed = Perturbed { robot: robot.clone(), tension_offsets: Vec::new() };
                parameter.change(&robot, &mut changed, |old| *old = value);
                assert_eq!(parameter.nominal(&changed.robot), value, "{parameter}");
            }
        }
        let robot = caroca();
        assert_eq!(robot.with_values(&[("mass", 185.0)]).unwrap().platform.mass, 185.0);
        let refused = [("dt1", 1.0), ("a9.x", 1.0), ("mass", -1.0), ("b1.x", f64::NAN), ("r1", 0.1)];
        for (name, value) in refused.into_iter().chain([("lead1", 0.1), ("tilt1.u", 0.1), ("gravity.x", 0.1)])
        {
            assert!(robot.with_values(&[(name, value)]).is_err(), "{name}");
        }
    }

    #[test]
    fn a_tilt_turns_the_axis_of_the_pulley_about_u_and_v() {
        let robot = guided(8);
        // Axes u and v of (0, 0, 1), (0, 0, -1) and (0, 3, 4)/5.
        let [x, y, z] = [Vector3::x(), Vector3::y(), Vector3::z()];
        let expected = [(x, y), (x, -y), (-x, 0.6 * z - 0.8 * y)];
        for (i, (u, v)) in expected.into_iter().enumerate() {
            let pulley = robot.cables[i].pulley.unwrap();
            let axes = TiltAxis::ALL.map(|axis| axis.of(&pulley));
            assert!((axes[0] - u).norm() + (axes[1] - v).norm() < 1e-15, "{i}: {axes:?}");
            for (axis, about) in TiltAxis::ALL.into_iter().zip(axes) {
                let mut changed = Perturbed { robot: robot.clone(), tension_offsets: Vec::new() };
                Parameter::Tilt(i, axis).change(&robot, &mut changed, |angle| *angle = 0.1);
                let turned = changed.robot.cables[i].pulley.unwrap().axis;
                let expected = 0.1_f64.cos() * pulley.axis + 0.1_f64.sin() * about.cross(&pulley.axis);
                assert!((turned - expected).norm() < 1e-15, "{i} {axis:?}");
            }
        }
    }

    #[test]
    fn a_parameter_that_the_robot_does_not_have_is_refused() {
        for name in ["b9.x", "r1", "lead1", "tilt1.u", "gravity.x"] {
            let found = deviations(&caroca(), &[(name, 0.1)]);
            assert!(matches!(found, Err(RobotError::UnknownParameter { .. })), "{name}");
        }
    }
}
