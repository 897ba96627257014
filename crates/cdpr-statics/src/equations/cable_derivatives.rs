//! Derivatives of the force of one cable, (D1) to (D3) and (D10) of `equations/partials.rs`.

use crate::equations::spanned::{SpannedCable, end, to_base};
use crate::problem::DirectProblem;
use cdpr_cable::{Catenary, HeldSlopes};
use cdpr_number::vector;
use cdpr_robot::{Matrix3, Pose, Robot, TiltAxis, Vector2, Vector3, Vector6};

/// Wrench [F; s x F] about P of a force F at the arm s.
pub(crate) fn wrench(arm: &Vector3<f64>, force: &Vector3<f64>) -> Vector6<f64> {
    vector::wrench(&(*arm).into(), &(*force).into()).into()
}

/// Wrench [0; s x F] of the moment alone.
pub(super) fn moment(arm: &Vector3<f64>, force: &Vector3<f64>) -> Vector6<f64> {
    let moment = arm.cross(force);
    Vector6::new(0.0, 0.0, 0.0, moment.x, moment.y, moment.z)
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
    pub(super) stiffness: Matrix3<f64>,
    /// Per density [N m/kg].
    pub(super) per_density: Vector3<f64>,
    /// Per modulus [N/Pa].
    pub(super) per_modulus: Vector3<f64>,
    /// k_L [N/m] per length, or v_i per tension where the tension is given.
    pub(crate) per_actuation: Vector3<f64>,
    /// Those by guide and gravity; `None` where all are zero or no parameters.
    pub(super) surroundings: Option<Box<Surroundings>>,
}

/// Derivatives of a cable's force by what leads it and by gravity.
#[derive(Clone)]
pub(super) struct Surroundings {
    /// By lead and radius of the guide [N/m].
    pub(super) per_guide: [Vector3<f64>; 2],
    /// By the tilts of the swivel axis of the pulley [N/rad].
    pub(super) per_tilt: [Vector3<f64>; 2],
    /// By the components of gravity [N s²/m], equation (D10).
    pub(super) per_gravity: Matrix3<f64>,
}

impl CableDerivatives {
    /// Cable i at a pose with its length given, equation (D1).
    pub(crate) fn new(robot: &Robot, pose: &Pose, i: usize, catenary: &Catenary) -> Self {
        let cable = SpannedCable::of(robot, pose, i, catenary);
        let (arm, o) = (cable.anchor_arm.into(), Vector3::zeros());
        let (force, tension) = (cable.force_on_platform().into(), catenary.anchor_tension());
        let none = Self {
            arm,
            force,
            direction: o,
            stiffness: Matrix3::zeros(),
            per_density: o,
            per_modulus: o,
            per_actuation: o,
            surroundings: None,
        };
        let Some(linearized) = cable.linearized() else { return none };
        let mut stiffness = linearized.stiffness();
        if let Some(skew) = cable.skew_stiffness(catenary) {
            stiffness += skew;
        }
        // The force by which the cable gives way to a motion of its free end.
        let ends = cable.end_slopes(catenary);
        Self {
            direction: force / tension,
            stiffness,
            per_density: stiffness * ends.per_weight * robot.gravity.magnitude(),
            per_modulus: stiffness * ends.per_stiffness * robot.cables[i].properties.section,
            per_actuation: stiffness * cable.end_per_length(),
            ..none
        }
        .within(robot, pose, i, || {
            ([ends.per_lead, ends.per_radius].map(|end| stiffness * end), stiffness * ends.per_axis)
        })
    }

    /// The same cable with its derivatives by guide and gravity, equation (D10), where they are parameters;
    /// from those by lead and radius and by the components of the swivel axis.
    fn within(
        mut self,
        robot: &Robot,
        pose: &Pose,
        i: usize,
        by_guide: impl FnOnce() -> ([Vector3<f64>; 2], Matrix3<f64>),
    ) -> Self {
        let pulley = robot.cables[i].pulley.as_ref();
        if pulley.is_none() && robot.cables[i].lead == 0.0 && !robot.gravity.is_vector() {
            return self;
        }
        let (per_guide, per_axis) = by_guide();
        let axis = pulley.map_or_else(Vector3::zeros, |pulley| pulley.axis.normalize());
        let by_tilts = |pulley| TiltAxis::ALL.map(|tilt: TiltAxis| per_axis * tilt.of(pulley).cross(&axis));
        let per_tilt = pulley.map_or([Vector3::zeros(); 2], by_tilts);
        let mut per_gravity = Matrix3::zeros();
        let g = robot.gravity.magnitude();
        if robot.gravity.is_vector() && g > 0.0 {
            let (up, span) = (robot.gravity.vector() / -g, robot.span(pose, i));
            let density = robot.cables[i].properties.linear_density;
            for (component, unit) in Matrix3::identity().column_iter().enumerate() {
                let turn = unit.cross(&up) / g;
                let by_direction = turn.cross(&self.force) + self.stiffness * turn.cross(&span)
                    - per_axis * turn.cross(&axis);
                let column = by_direction - self.per_density * (density / g * up[component]);
                per_gravity.set_column(component, &column);
            }
        }
        self.surroundings = Some(Box::new(Surroundings { per_guide, per_tilt, per_gravity }));
        self
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
        let keep = |force: Vector3<f64>| force - v * self.direction.dot(&force);
        Self {
            stiffness: self.stiffness - v * (self.direction.transpose() * self.stiffness),
            per_density: keep(self.per_density),
            per_modulus: keep(self.per_modulus),
            per_actuation: v,
            surroundings: self.surroundings.as_ref().map(|around| {
                let Surroundings { per_guide, per_tilt, per_gravity } = &**around;
                Box::new(Surroundings {
                    per_guide: per_guide.map(keep),
                    per_tilt: per_tilt.map(keep),
                    per_gravity: per_gravity - v * (self.direction.transpose() * per_gravity),
                })
            }),
            ..*self
        }
    }

    /// The derivatives of `v_i = dF_i/dt_i`, in the place of those of F_i: with the tension given it is a
    /// function of the same inputs.
    pub(crate) fn of_tension_slope(robot: &Robot, pose: &Pose, i: usize, catenary: &Catenary) -> Self {
        let slopes = SpannedCable::of(robot, pose, i, catenary).tension_slopes(catenary, end(robot, pose, i));
        Self::of_vector(robot, pose, i, &slopes)
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
        let none = Self { force: Vector3::zeros(), surroundings: None, ..self.clone() };
        if at.is_slack_and_weightless() {
            return none;
        }
        let slopes = SpannedCable::of(robot, pose, i, at).stiffness_slopes(at, d);
        let mut of_vector = Self::of_vector(robot, pose, i, &slopes);
        let g = robot.gravity.magnitude();
        if let Some(around) = of_vector.surroundings.as_mut().filter(|_| g > 0.0) {
            // (D10) turns `d`, too.
            let up = robot.gravity.vector() / -g;
            for (component, unit) in Matrix3::identity().column_iter().enumerate() {
                let mut column = around.per_gravity.column_mut(component);
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
            per_density: -slopes.per_weight * robot.gravity.magnitude(),
            per_modulus: -slopes.per_stiffness * robot.cables[i].properties.section,
            per_actuation: -slopes.per_actuation,
            surroundings: None,
        }
        .within(robot, pose, i, || ([-slopes.per_lead, -slopes.per_radius], -slopes.per_axis))
    }

    /// (K3 + K3ᵀ) d.
    pub(crate) fn resisted_both_ways(&self, d: &Vector3<f64>) -> Vector3<f64> {
        self.stiffness * d + self.stiffness.transpose() * d
    }

    /// The derivatives of the tension `t` [N] that the greatest tension of cable i at its exit point leaves
    /// at the platform, in the place of those of F_i: equation (C26) of `cdpr_cable` differentiated.
    pub(crate) fn of_exit_limit(robot: &Robot, pose: &Pose, i: usize, t: f64) -> Self {
        let (cable, exit, o) = (robot.cable(i), robot.limits(i).max, Vector3::zeros());
        let up = Vector3::from(to_base(robot.gravity.level(), [0.0, 0.0, 1.0]));
        let per_work = up / (1.0 + cable.strain(t));
        let energy = cable.energy_per_length(t) - cable.energy_per_length(exit);
        Self {
            arm: robot.anchor_arm(pose, i),
            force: t * up,
            direction: up,
            stiffness: -cable.weight_per_length * per_work * up.transpose(),
            per_density: per_work * (end(robot, pose, i).z * robot.gravity.magnitude()),
            // The energy falls in proportion to 1/E.
            per_modulus: per_work * (energy / robot.cables[i].properties.youngs_modulus),
            per_actuation: o,
            surroundings: None,
        }
        .within(robot, pose, i, || ([o; 2], Matrix3::zeros()))
    }

    /// Wrench about P per length, or per tension where the tension is given.
    pub(crate) fn wrench_per_actuation(&self) -> Vector6<f64> {
        wrench(&self.arm, &self.per_actuation)
    }
}
