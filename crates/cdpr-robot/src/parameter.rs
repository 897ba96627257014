//! The uncertain parameters of a robot as one vector (section 4 of Baklouti, Caro, Courteille 2017).
//!
//! For n cables there are `6 + 7n` parameters (62 for 8 cables): the platform's mass, the cables' linear
//! density and modulus, the coordinates of every anchor and exit point, the centre of mass, and an offset of
//! every tension set-point. A *deviation* is added to the nominal value.

use crate::axis::Axis;
use crate::error::RobotError;
use crate::robot::Robot;
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
}

/// The order of the parameters in the vector of a robot with a given number of cables.
///
/// A point stands as three coordinates one after the other: its methods give the index of the first.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct ParameterLayout {
    cables: usize,
}

impl ParameterLayout {
    /// The layout of a robot with `cables` cables.
    pub const fn new(cables: usize) -> Self {
        Self { cables }
    }

    /// Number of parameters, `6 + 7n`.
    pub const fn count(&self) -> usize {
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

    /// Index of a parameter; `None` for a cable that the robot does not have.
    pub fn index(&self, parameter: Parameter) -> Option<usize> {
        let (i, index) = match parameter {
            Parameter::Mass => (0, self.mass()),
            Parameter::LinearDensity => (0, self.linear_density()),
            Parameter::YoungsModulus => (0, self.youngs_modulus()),
            Parameter::AnchorPoint(i, axis) => (i, self.anchor_point(i) + axis.index()),
            Parameter::ExitPoint(i, axis) => (i, self.exit_point(i) + axis.index()),
            Parameter::CenterOfMass(axis) => (0, self.center_of_mass() + axis.index()),
            Parameter::TensionOffset(i) => (i, self.tension_offset(i)),
        };
        (i < self.cables).then_some(index)
    }
}

impl Parameter {
    /// The names of all parameters, as messages list them.
    pub const NAMES: &str = "mass, linear_density, youngs_modulus, a1.x ..., b1.x ..., cog.x ..., dt1 ...";
    /// The names of all groups, [`Parameter::group`], as messages list them.
    pub const GROUPS: &str = "mass, linear_density, youngs_modulus, a, b, cog, dt";

    /// All parameters of a robot with `cables` cables, in the order of [`ParameterLayout`].
    pub fn all(cables: usize) -> Vec<Self> {
        let points = |parameter: fn(usize, Axis) -> Self| {
            (0..cables).flat_map(move |i| Axis::ALL.map(move |axis| parameter(i, axis)))
        };
        [Self::Mass, Self::LinearDensity, Self::YoungsModulus]
            .into_iter()
            .chain(points(Self::AnchorPoint))
            .chain(points(Self::ExitPoint))
            .chain(Axis::ALL.map(Self::CenterOfMass))
            .chain((0..cables).map(Self::TensionOffset))
            .collect()
    }

    /// Name of the group that a study can give one law: `a`, `b`, `cog` or `dt`.
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
        }
    }

    /// SI unit.
    pub fn unit(&self) -> &'static str {
        match self {
            Self::Mass => "kg",
            Self::LinearDensity => "kg/m",
            Self::YoungsModulus => "Pa",
            Self::AnchorPoint(..) | Self::ExitPoint(..) | Self::CenterOfMass(_) => "m",
            Self::TensionOffset(_) => "N",
        }
    }

    /// Nominal value in `robot`, in [`Parameter::unit`].
    ///
    /// It is that of the first cable for what all cables share, and zero for an offset.
    pub fn nominal(&self, robot: &Robot) -> f64 {
        match *self {
            Self::Mass => robot.platform.mass,
            Self::LinearDensity => robot.cables[0].properties.linear_density,
            Self::YoungsModulus => robot.cables[0].properties.youngs_modulus,
            Self::AnchorPoint(i, axis) => robot.cables[i].anchor_point[axis.index()],
            Self::ExitPoint(i, axis) => robot.cables[i].exit_point[axis.index()],
            Self::CenterOfMass(axis) => robot.platform.center_of_mass[axis.index()],
            Self::TensionOffset(_) => 0.0,
        }
    }

    /// Changes the value of this parameter, for all cables if they share it.
    fn change(&self, perturbed: &mut Perturbed, change: impl Fn(&mut f64)) {
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
    let cable = |number: &str| number.parse::<usize>().ok()?.checked_sub(1);
    if let Some(number) = name.strip_prefix("dt") {
        return cable(number).map(Parameter::TensionOffset);
    }
    let (point, axis) = name.split_once('.')?;
    let axis = Axis::from_letter(axis)?;
    match point {
        "cog" => Some(Parameter::CenterOfMass(axis)),
        _ => match point.split_at_checked(1)? {
            ("a", number) => Some(Parameter::AnchorPoint(cable(number)?, axis)),
            ("b", number) => Some(Parameter::ExitPoint(cable(number)?, axis)),
            _ => None,
        },
    }
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
    /// The robot with one deviation added to each of its parameters, in the order of [`Parameter::all`].
    ///
    /// # Errors
    /// [`RobotError::DeviationCount`]; [`RobotError::Invalid`] if the perturbed robot is invalid, for example
    /// with a negative mass.
    pub fn perturbed(&self, deviations: &[f64]) -> Result<Perturbed, RobotError> {
        let parameters = Parameter::all(self.cables.len());
        if deviations.len() != parameters.len() {
            return Err(RobotError::DeviationCount { given: deviations.len(), parameters: parameters.len() });
        }
        let mut perturbed = Perturbed { robot: self.clone(), tension_offsets: vec![0.0; self.cables.len()] };
        for (parameter, deviation) in parameters.iter().zip(deviations) {
            if !deviation.is_finite() {
                return Err(RobotError::invalid(parameter.to_string(), deviation, "a finite deviation"));
            }
            parameter.change(&mut perturbed, |value| *value += deviation);
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
        let cables = self.cables.len();
        let mut changed = Perturbed { robot: self.clone(), tension_offsets: Vec::new() };
        for (name, value) in named {
            let parameter: Parameter = name.parse()?;
            let exists = ParameterLayout::new(cables).index(parameter).is_some();
            if matches!(parameter, Parameter::TensionOffset(_)) || !exists {
                return Err(RobotError::UnknownParameter {
                    name: (*name).to_owned(),
                    expected: format!(
                        "those of a robot with {cables} cables, except the offsets dt of its tensions"
                    ),
                });
            }
            parameter.change(&mut changed, |old| *old = *value);
        }
        changed.robot.validate()?;
        Ok(changed.robot)
    }
}

/// The deviation vector of a robot with `cables` cables that is zero except for the named parameters.
///
/// # Errors
/// [`RobotError::UnknownParameter`] for a name that such a robot does not have.
pub fn deviations(cables: usize, named: &[(&str, f64)]) -> Result<Vec<f64>, RobotError> {
    let layout = ParameterLayout::new(cables);
    let mut deviations = vec![0.0; layout.count()];
    for (name, deviation) in named {
        let parameter: Parameter = name.parse()?;
        let index = layout.index(parameter).ok_or_else(|| RobotError::UnknownParameter {
            name: (*name).to_owned(),
            expected: format!("those of a robot with {cables} cables"),
        })?;
        deviations[index] += deviation;
    }
    Ok(deviations)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn eight_cables_have_the_62_parameters_of_the_paper() {
        let names: Vec<String> = Parameter::all(8).iter().map(ToString::to_string).collect();
        assert_eq!(names.len(), 62);
        assert_eq!(names[..4], ["mass", "linear_density", "youngs_modulus", "a1.x"]);
        assert_eq!(names[26..28], ["a8.z", "b1.x"]);
        assert_eq!(names[50..55], ["b8.z", "cog.x", "cog.y", "cog.z", "dt1"]);
        assert_eq!(names[61], "dt8");
        let geometric = Parameter::all(8).iter().filter(|p| p.unit() == "m").count();
        assert_eq!((geometric, 62 - geometric), (51, 11));
    }

    #[test]
    fn the_layout_gives_the_index_of_every_parameter() {
        for cables in 6..=16 {
            let (layout, all) = (ParameterLayout::new(cables), Parameter::all(cables));
            assert_eq!(all.len(), layout.count());
            let indices: Vec<_> = all.iter().map(|parameter| layout.index(*parameter)).collect();
            assert_eq!(indices, (0..layout.count()).map(Some).collect::<Vec<_>>());
            assert_eq!(layout.index(Parameter::AnchorPoint(cables, Axis::X)), None);
        }
    }

    #[test]
    fn names_are_read_back() {
        for cables in 6..=16 {
            for parameter in Parameter::all(cables) {
                assert_eq!(parameter.to_string().parse(), Ok(parameter));
            }
        }
        for name in ["", "a", "a0.x", "a1.w", "a1", "b.x", "dt", "dt0", "c1.x", "Mass", "ä1.x"] {
            assert!(name.parse::<Parameter>().is_err(), "{name}");
        }
    }

    #[test]
    fn a_robot_with_another_value_has_that_very_value() {
        let robot = Robot::from_json(include_str!("../../../data/robots/caroca.json")).unwrap();
        for (parameter, value) in Parameter::all(8)[..54].iter().zip(1..) {
            let value = f64::from(value) / 3.0;
            let changed = robot.with_values(&[(&parameter.to_string(), value)]).unwrap();
            assert_eq!(parameter.nominal(&changed), value, "{parameter}");
        }
        for (name, value) in [("dt1", 1.0), ("a9.x", 1.0), ("mass", -1.0), ("b1.x", f64::NAN)] {
            assert!(robot.with_values(&[(name, value)]).is_err(), "{name}");
        }
    }

    #[test]
    fn a_parameter_of_a_cable_that_does_not_exist_is_refused() {
        assert!(matches!(deviations(8, &[("b9.x", 0.1)]), Err(RobotError::UnknownParameter { .. })));
    }
}
