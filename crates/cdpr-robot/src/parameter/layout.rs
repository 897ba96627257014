//! The order of the parameters of a robot.

use crate::axis::Axis;
use crate::parameter::{Parameter, TiltAxis};
use crate::robot::{Robot, RobotCable};

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
    pub(super) fn names(&self) -> String {
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
    /// All parameters of a robot, in the order of [`ParameterLayout`].
    pub fn of(robot: &Robot) -> Vec<Self> {
        ParameterLayout::of(robot).parameters()
    }
}
