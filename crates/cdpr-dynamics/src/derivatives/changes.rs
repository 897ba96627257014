//! How the energy of a motion of platform and cables changes with the inputs, (N11).

use crate::energy::{CableEnergy, Change, Number, Vector, real};
use crate::error::DynamicsError;
use cdpr_robot::{CableEnd, Parameter};
use cdpr_statics::derivatives::{ForceDerivatives, Inputs};
use cdpr_statics::vibration::{CableAtRest, SmallMotions};
use cdpr_statics::{DirectProblem, Equilibrium, Vector3, Vector6};
use nalgebra::Complex;

/// A motion of platform and cables at a frequency.
pub(super) struct Moved {
    /// ω² [1/s²].
    pub(super) square: f64,
    /// That of the platform.
    pub(super) v: Vector6<Number>,
    /// Force on the end of each cable, K_dyn u [N].
    pub(super) forces: Vec<Vector>,
    /// Each cable; `None` for one that resists nothing.
    pub(super) energies: Vec<Option<CableEnergy>>,
}

impl Moved {
    /// Rotation vector of the platform.
    fn turn(&self) -> Vector {
        self.v.fixed_rows::<3>(3).into()
    }
}

/// What changes with the inputs: parameters, payload, pose and, after these, the lengths.
pub(super) struct Changes<'a> {
    problem: &'a DirectProblem<'a>,
    equilibrium: &'a Equilibrium,
    pub(super) inputs: Inputs,
    /// Of the forces at the anchor points and at the exits.
    pub(super) anchors: ForceDerivatives,
    exits: ForceDerivatives,
    /// Of K3 z where a cable is on a pulley: of the parts of z, each with the number that multiplies it.
    resistances: Vec<(Number, ForceDerivatives)>,
    moved: Moved,
}

impl<'a> Changes<'a> {
    pub(super) fn new(
        problem: &'a DirectProblem<'a>,
        equilibrium: &'a Equilibrium,
        moved: Moved,
    ) -> Result<Self, DynamicsError> {
        let part = |of: fn(&Number) -> f64| -> Vec<Vector3<f64>> {
            let z = |energy: &CableEnergy| energy.z.map(|z| of(&z));
            moved.energies.iter().map(|energy| energy.as_ref().map_or_else(Vector3::zeros, z)).collect()
        };
        let parts = [(real(1.0), part(|z| z.re)), (Complex::i(), part(|z| z.im))];
        let existing = parts.into_iter().filter(|(_, z)| z.iter().any(|z| *z != Vector3::zeros()));
        let resistances = existing.map(|(of, z)| Ok((of, problem.resistance_derivatives(equilibrium, &z)?)));
        Ok(Self {
            problem,
            equilibrium,
            inputs: Inputs { parameters: Parameter::of(problem.robot()) },
            anchors: problem.force_derivatives(equilibrium, CableEnd::Anchor)?,
            exits: problem.force_derivatives(equilibrium, CableEnd::Exit)?,
            resistances: resistances.collect::<Result<_, DynamicsError>>()?,
            moved,
        })
    }

    /// v_r·R J_c Rᵀ v_r [kg m²/(kg m²)].
    pub(super) fn spin(&self) -> Number {
        let inertia = self.problem.robot().platform.inertia;
        let turn = self.equilibrium.pose.rotation.matrix().map(real).tr_mul(&self.moved.turn());
        inertia.map_or(real(0.0), |inertia| turn.dot(&(inertia.map(real) * turn)))
    }

    /// How the rotation of the platform changes with a column [rad].
    pub(super) fn turned(&self, column: usize) -> Vector3<f64> {
        self.anchors.pose.fixed_view::<3, 1>(3, column).into()
    }

    /// xᵀ (dK - ω² dM) x by every input and length, (N11).
    pub(super) fn all(&self, at_rest: &SmallMotions) -> Vec<Number> {
        let columns = self.inputs.count() + at_rest.cables.len();
        (0..columns)
            .map(|column| {
                let parameter = self.inputs.parameters.get(column);
                let turned = self.turned(column);
                let of_cables = (0..at_rest.cables.len())
                    .map(|i| self.of_cable((i, &at_rest.cables[i]), column, &turned));
                of_cables.sum::<Number>() + self.of_platform(parameter, column, &turned)
            })
            .collect()
    }

    fn of_cable(&self, (i, cable): (usize, &CableAtRest), column: usize, turned: &Vector3<f64>) -> Number {
        let Some(energy) = &self.moved.energies[i] else { return real(0.0) };
        let robot = self.problem.robot();
        let of = |all: &ForceDerivatives| -> Vector3<f64> {
            all.per_input.fixed_view::<3, 1>(3 * i, column).into()
        };
        let force = of(&self.anchors);
        let mut change = Change {
            // On the platform the cable pulls with -n, on what leads it with n.
            anchor: -force,
            exit: of(&self.exits),
            // The derivatives are those of -K3 z.
            resistance: self.resistances.iter().map(|(z, all)| of(all).map(|of| -z * of)).sum(),
            ..Change::default()
        };
        let mut arm = turned.cross(&cable.lever);
        match self.inputs.parameters.get(column) {
            Some(Parameter::LinearDensity) => change.density = 1.0,
            Some(Parameter::YoungsModulus) => {
                change.modulus = robot.cables[i].properties.youngs_modulus.recip();
            }
            Some(Parameter::AnchorPoint(of, axis)) if *of == i => {
                arm += self.equilibrium.pose.rotation.matrix().column(axis.index());
            }
            Some(Parameter::Lead(of)) if *of == i => change.lead = 1.0,
            Some(Parameter::Gravity(axis)) => change.gravity[axis.index()] = 1.0,
            _ => {}
        }
        if column == self.inputs.count() + i {
            change.length = 1.0;
        }
        let turn = self.moved.turn();
        let twice = |v: &Vector3<f64>| turn.cross(&turn.cross(&v.map(real)));
        energy.change(&change) + self.moved.forces[i].dot(&turn.cross(&arm.map(real))) * 2.0
            - force.map(real).dot(&twice(&cable.lever))
            - self.anchors.forces[i].map(real).dot(&twice(&arm))
    }

    /// Of the weight and of the mass of platform and payload.
    fn of_platform(&self, parameter: Option<&Parameter>, column: usize, turned: &Vector3<f64>) -> Number {
        let robot = self.problem.robot();
        let (pose, gravity) = (&self.equilibrium.pose, robot.gravity.vector());
        let mass = robot.platform.mass + self.problem.load().payload;
        let center = pose.rotation * robot.platform.center_of_mass;
        let (mut heavier, mut moved, mut pull) = (0.0, turned.cross(&center), Vector3::zeros());
        match parameter {
            Some(Parameter::Mass) => heavier = 1.0,
            Some(Parameter::CenterOfMass(axis)) => moved += pose.rotation.matrix().column(axis.index()),
            Some(Parameter::Gravity(axis)) => pull[axis.index()] = mass,
            _ if column == self.inputs.payload() => heavier = 1.0,
            _ => {}
        }
        let turn = self.moved.turn();
        let twice = |v: &Vector3<f64>| turn.cross(&turn.cross(&v.map(real)));
        let of_weight = -(pull + heavier * gravity).map(real).dot(&twice(&center))
            - (mass * gravity).map(real).dot(&twice(&moved));
        let translation: Vector = self.moved.v.fixed_rows::<3>(0).into();
        let velocity = translation + turn.cross(&center.map(real));
        let inertia = robot.platform.inertia.map_or_else(Vector::zeros, |inertia| {
            let rotation = pose.rotation.matrix();
            (rotation * inertia * rotation.transpose()).map(real) * turn
        });
        let of_mass = velocity.dot(&velocity) * heavier
            + velocity.dot(&turn.cross(&moved.map(real))) * (2.0 * mass)
            + turned.map(real).dot(&inertia.cross(&turn)) * 2.0;
        of_weight - of_mass * self.moved.square
    }
}
