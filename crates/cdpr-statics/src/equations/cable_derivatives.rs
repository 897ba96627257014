//! Derivatives of the force of one cable, (D1) to (D3) and (D10) of `equations/partials.rs`.

use crate::equations::spanned::{SpannedCable, end, to_base};
use crate::problem::DirectProblem;
use cdpr_cable::{Catenary, HeldInWind, HeldSlopes, InWindSlopes, Property, PropertySlopes};
use cdpr_number::vector;
use cdpr_robot::{Matrix3, Pose, Robot, TiltAxis, Vector2, Vector3, Vector6};
use nalgebra::SMatrix;

/// Wrench [F; s x F] about P of a force F at the arm s.
pub(crate) fn wrench(arm: &Vector3<f64>, force: &Vector3<f64>) -> Vector6<f64> {
    vector::wrench(&(*arm).into(), &(*force).into()).into()
}

/// Wrench [0; s x F] of the moment alone.
pub(super) fn moment(arm: &Vector3<f64>, force: &Vector3<f64>) -> Vector6<f64> {
    let moment = arm.cross(force);
    Vector6::new(0.0, 0.0, 0.0, moment.x, moment.y, moment.z)
}

/// What the force of a cable depends on: the columns of [`CableDerivatives::per_input`], per SI unit.
#[derive(Clone, Copy)]
pub(crate) enum CableInput {
    Density,
    Modulus,
    Lead,
    Radius,
    /// The tilts of the swivel axis of the pulley: the first of two.
    Tilt,
    /// The components of gravity, equation (D10): the first of three.
    Gravity = 6,
}

/// A cable with the derivatives of its force on the platform.
#[derive(Clone)]
pub(crate) struct CableDerivatives {
    /// s_i [m].
    pub(crate) arm: Vector3<f64>,
    /// F_i [N], on the platform.
    pub(crate) force: Vector3<f64>,
    /// u_i; zero for a slack cable without weight.
    pub(crate) direction: Vector3<f64>,
    /// -dF_i/dr_i: K3_i, or Q_i K3_i where the tension is given [N/m].
    pub(crate) stiffness: Matrix3<f64>,
    /// By the inputs of the cable, in the order of [`CableInput`]; zero by those that are no parameters.
    pub(super) per_input: SMatrix<f64, 3, 9>,
    /// k_L [N/m] per length, or v_i per tension where the tension is given.
    pub(crate) per_actuation: Vector3<f64>,
}

impl CableDerivatives {
    /// Cable i at a pose with its length given, equation (D1).
    pub(crate) fn new(robot: &Robot, pose: &Pose, i: usize, catenary: &Catenary) -> Self {
        let cable = SpannedCable::of(robot, pose, i, catenary);
        let (arm, o) = (cable.anchor_arm.into(), Vector3::zeros());
        let force = Vector3::from(cable.force_on_platform());
        let Some(linearized) = cable.linearized() else {
            let (stiffness, per_input) = (Matrix3::zeros(), SMatrix::zeros());
            return Self { arm, force, direction: o, stiffness, per_input, per_actuation: o };
        };
        let mut stiffness = linearized.stiffness();
        if let Some(skew) = cable.skew_stiffness(catenary) {
            stiffness += skew;
        }
        // The force by which the cable gives way to a motion of its free end.
        let per_property = stiffness * cable.end_slopes(catenary);
        Self {
            arm,
            force,
            direction: force / catenary.anchor_tension(),
            stiffness,
            per_input: SMatrix::zeros(),
            per_actuation: stiffness * cable.end_per_length(),
        }
        .with(robot, pose, i, &per_property)
    }

    /// The same with its derivatives by the inputs of the cable, from those by what it is; equation (D10).
    fn with(mut self, robot: &Robot, pose: &Pose, i: usize, per_property: &PropertySlopes) -> Self {
        let (cable, g) = (&robot.cables[i], robot.gravity.magnitude());
        let per = |property: Property| per_property.column(property as usize);
        let per_axis = per_property.fixed_columns::<3>(Property::Axis as usize);
        let per_density = per(Property::Weight) * g;
        let mut set = |first: CableInput, k: usize, slope: Vector3<f64>| {
            self.per_input.set_column(first as usize + k, &slope);
        };
        set(CableInput::Density, 0, per_density);
        set(CableInput::Modulus, 0, per(Property::Stiffness) * cable.properties.section);
        set(CableInput::Lead, 0, per(Property::Lead).into());
        set(CableInput::Radius, 0, per(Property::Radius).into());
        let mut axis = Vector3::zeros();
        if let Some(pulley) = &cable.pulley {
            axis = pulley.axis.normalize();
            for (k, tilt) in TiltAxis::ALL.into_iter().enumerate() {
                set(CableInput::Tilt, k, per_axis * tilt.of(pulley).cross(&axis));
            }
        }
        if robot.gravity.is_vector() && g > 0.0 {
            let (up, span) = (robot.gravity.vector() / -g, robot.span(pose, i));
            for (k, unit) in Matrix3::identity().column_iter().enumerate() {
                let turn = unit.cross(&up) / g;
                let by_direction = turn.cross(&self.force) + self.stiffness * turn.cross(&span)
                    - per_axis * turn.cross(&axis);
                let column = by_direction - per_density * (cable.properties.linear_density / g * up[k]);
                set(CableInput::Gravity, k, column);
            }
        }
        self
    }

    /// Cable i of a rest in wind with its length given, equation (C42) of `cdpr_cable`: one without a pulley.
    pub(crate) fn in_wind(
        robot: &Robot,
        pose: &Pose,
        i: usize,
        held: &HeldInWind,
        slopes: &InWindSlopes,
    ) -> Self {
        let (properties, force) = (&robot.cables[i].properties, -held.anchor_force);
        let mut per_input = SMatrix::<f64, 3, 9>::zeros();
        let mut set = |column: usize, slope: Vector3<f64>| per_input.set_column(column, &-slope);
        set(CableInput::Density as usize, slopes.per_weight * robot.gravity.vector());
        set(CableInput::Modulus as usize, slopes.per_axial_stiffness * properties.section);
        set(CableInput::Lead as usize, slopes.per_guided);
        for k in 0..3 {
            let column = slopes.per_weight.column(k) * properties.linear_density;
            set(CableInput::Gravity as usize + k, column);
        }
        Self {
            arm: robot.anchor_arm(pose, i),
            force,
            direction: force / force.norm(),
            stiffness: held.stiffness,
            per_input,
            per_actuation: -slopes.per_length,
        }
    }

    /// Derivative of the force by an input of the cable with one component.
    pub(crate) fn by(&self, input: CableInput) -> Vector3<f64> {
        self.per_input.column(input as usize).into()
    }

    /// All cables of a model at a pose.
    pub(crate) fn all(problem: &DirectProblem, pose: &Pose, forces: &[Vector2<f64>]) -> Vec<Self> {
        let catenary =
            |(i, force): (usize, &_)| Self::new(problem.robot, pose, i, &problem.catenary(i, *force));
        forces.iter().enumerate().map(catenary).collect()
    }

    /// The same cable with its tension given, equation (D3).
    pub(crate) fn at_tension(&self) -> Self {
        let v = self.per_actuation / self.direction.dot(&self.per_actuation);
        Self {
            stiffness: self.stiffness - v * self.direction.tr_mul(&self.stiffness),
            per_input: self.per_input - v * self.direction.tr_mul(&self.per_input),
            per_actuation: v,
            ..*self
        }
    }

    /// The derivatives of `v_i = dF_i/dt_i`, in the place of those of F_i: with the tension given it is a
    /// function of the same inputs.
    pub(crate) fn of_tension_slope(robot: &Robot, pose: &Pose, i: usize, catenary: &Catenary) -> Self {
        Self::of_vector(robot, pose, i, &SpannedCable::of(robot, pose, i, catenary).tension_slopes(catenary))
    }

    /// The derivatives of `-K3_i d`, the change of F_i by the motion `d` of its anchor point, in the place of
    /// those of F_i: `d` is constant.
    pub(crate) fn of_stiffness(
        &self,
        robot: &Robot,
        pose: &Pose,
        i: usize,
        at: &Catenary,
        d: Vector3<f64>,
    ) -> Self {
        if at.is_slack_and_weightless() {
            return Self { force: Vector3::zeros(), ..self.clone() };
        }
        let slopes = SpannedCable::of(robot, pose, i, at).stiffness_slopes(at, d);
        let mut of_vector = Self::of_vector(robot, pose, i, &slopes);
        let g = robot.gravity.magnitude();
        if robot.gravity.is_vector() && g > 0.0 {
            // (D10) turns `d`, too.
            let up = robot.gravity.vector() / -g;
            for (k, unit) in Matrix3::identity().column_iter().enumerate() {
                let mut column = of_vector.per_input.column_mut(CableInput::Gravity as usize + k);
                column += self.stiffness * (unit.cross(&up) / g).cross(&d);
            }
        }
        of_vector
    }

    /// The derivatives of the force with which the cable pulls on its guide, in the place of those of F_i.
    pub(crate) fn of_pull(&self, robot: &Robot, pose: &Pose, i: usize, at: &Catenary) -> Self {
        if at.is_slack_and_weightless() {
            return self.clone();
        }
        Self::of_vector(robot, pose, i, &SpannedCable::of(robot, pose, i, at).leave_force_slopes(at))
    }

    /// A vector that acts on the cable, in the place of -F_i.
    fn of_vector(robot: &Robot, pose: &Pose, i: usize, slopes: &HeldSlopes) -> Self {
        Self {
            arm: robot.anchor_arm(pose, i),
            force: -slopes.value,
            direction: Vector3::zeros(),
            stiffness: slopes.per_end,
            per_input: SMatrix::zeros(),
            per_actuation: -slopes.per_actuation,
        }
        .with(robot, pose, i, &-slopes.per_property)
    }

    /// (K3 + K3ᵀ) d.
    pub(crate) fn resisted_both_ways(&self, d: &Vector3<f64>) -> Vector3<f64> {
        self.stiffness * d + self.stiffness.transpose() * d
    }

    /// The derivatives of the tension `t` [N] that the greatest tension of cable i at its exit point leaves
    /// at the platform, in the place of those of F_i: equation (C26) of `cdpr_cable` differentiated.
    pub(crate) fn of_exit_limit(robot: &Robot, pose: &Pose, i: usize, t: f64) -> Self {
        let (cable, exit) = (robot.cable(i), robot.limits(i).max);
        let up = Vector3::from(to_base(robot.gravity.level(), [0.0, 0.0, 1.0]));
        let per_work = up / (1.0 + cable.strain(t));
        // The energy falls in proportion to 1/EA.
        let energy = cable.energy_per_length(t) - cable.energy_per_length(exit);
        let mut per_property = PropertySlopes::zeros();
        per_property.set_column(Property::Weight as usize, &(per_work * end(robot, pose, i).z));
        per_property.set_column(Property::Stiffness as usize, &(per_work * (energy / cable.axial_stiffness)));
        Self {
            arm: robot.anchor_arm(pose, i),
            force: t * up,
            direction: up,
            stiffness: -cable.weight_per_length * per_work * up.transpose(),
            per_input: SMatrix::zeros(),
            per_actuation: Vector3::zeros(),
        }
        .with(robot, pose, i, &per_property)
    }

    /// Wrench about P per length, or per tension where the tension is given.
    pub(crate) fn wrench_per_actuation(&self) -> Vector6<f64> {
        wrench(&self.arm, &self.per_actuation)
    }
}
