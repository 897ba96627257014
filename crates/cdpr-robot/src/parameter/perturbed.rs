//! Robots with other values of their parameters.

use crate::error::RobotError;
use crate::parameter::Parameter;
use crate::parameter::layout::ParameterLayout;
use crate::robot::Robot;
use nalgebra::{Rotation3, Unit};

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
    /// The value of a parameter that cables share is that of the first cable. The others change by as much,
    /// as in [`Robot::perturbed`].
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
            let nominal = parameter.nominal(self);
            let deviation = value - nominal;
            parameter.change(self, &mut changed, |old| {
                *old = if *old == nominal { *value } else { *old + deviation };
            });
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

impl Parameter {
    /// Changes the value of this parameter of the `nominal` robot, for all cables if they share it.
    pub(super) fn change(&self, nominal: &Robot, perturbed: &mut Perturbed, change: impl Fn(&mut f64)) {
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
