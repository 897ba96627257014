//! Partial derivatives of the equations of equilibrium with respect to the robot's parameters, the load and
//! the pose.
//!
//! Between held ends the force of a cable follows from its span, its length and its material. The catenary
//! `(h, z) = (x, z)(f, L, w, EA)` with the stiffness K3 in space (S3), `K = C⁻¹` in its plane, `w = ρ g`
//! and `EA = E S` gives for the force F_i on the platform
//!
//! ```text
//! dF_i = -K3_i dr_i + k_L dL_i + k_ρ dρ + k_E dE                                                  (D1)
//!  k_L = K ∂(x, z)/∂L,  k_ρ = g K ∂(x, z)/∂w,   k_E = S K ∂(x, z)/∂EA   (lifted from its plane)
//! ds_i = dφ x s_i + R da_i,   dr_i = dp + ds_i - db_i                                             (D2)
//! ```
//!
//! With `u_i = F_i/t_i` the tension changes by `dt_i = u_i·dF_i`. A cable that is given its tension instead
//! of its length has
//!
//! ```text
//! dF_i = Q_i (-K3_i dr_i + k_ρ dρ + k_E dE) + v_i dt_i,   v_i = k_L/(u_i·k_L),   Q_i = 1 - v_i u_iᵀ  (D3)
//! ```
//!
//! which is (D1) with other coefficients. So are the derivatives by lead and radius of a guide, `K ∂A/∂d`
//! and `K ∂A/∂r`, and by its axis k, which a tilt by an angle τ about e turns by `dk = e x k dτ`.
//!
//! Gravity γ = -g u acts on cable i by its magnitude, `dg = -u·dγ`, and by the direction u of "up", which
//! turns by `δ = -(u x dγ)/g`. If span, pulley and up turn together, the force turns with them; the span
//! does not, and hence
//!
//! ```text
//! dF_i = δ x F_i + K3_i (δ x r_i) - K3_i ∂A/∂k (δ x k) + k_ρ (ρ/g) dg                         (D10)
//! ```
//!
//! because the axis of a pulley does not turn either. The left-hand side of the paper's Eq. (3),
//! `G = sum [F_i; s_i x F_i] + w_ex`, changes by
//!
//! ```text
//! dG = sum [ dF_i; ds_i x F_i + s_i x dF_i ] + dw_ex                                              (D4)
//! w_ex = [ F_w; R c x F_w ] + load,   F_w = (m + payload) γ
//! ```

use crate::equations::spanned::{SpannedCable, end, to_base};
use crate::error::StaticsError;
use crate::problem::DirectProblem;
use crate::state::Load;
use cdpr_cable::{Catenary, HeldSlopes};
use cdpr_number::vector;
use cdpr_robot::{Matrix3, Matrix6xX, Parameter, Pose, Robot, TiltAxis, Vector2, Vector3, Vector6};
use nalgebra::{DMatrix, Matrix6};
use std::ops::Range;

/// The inputs that the columns of all derivatives stand for: the parameters, the payload, the wanted pose.
#[derive(Clone, Debug, PartialEq)]
pub struct Inputs {
    /// The parameters of the robot in the order of [`Parameter::of`], per SI unit of each: the first columns.
    pub parameters: Vec<Parameter>,
}

impl Inputs {
    pub(crate) fn of(robot: &Robot) -> Self {
        Self { parameters: Parameter::of(robot) }
    }

    /// Column of a parameter, per SI unit; `None` for one that the robot does not have.
    pub fn column(&self, parameter: Parameter) -> Option<usize> {
        self.parameters.iter().position(|column| *column == parameter)
    }

    /// Column of the payload, per [kg].
    pub fn payload(&self) -> usize {
        self.parameters.len()
    }

    /// Columns of the wanted pose: (dp, dφ) in the base frame, per [m] and [rad].
    pub fn pose(&self) -> Range<usize> {
        self.payload() + 1..self.payload() + 7
    }

    /// Number of columns: those of the parameters, and seven.
    pub fn count(&self) -> usize {
        self.payload() + 7
    }

    /// A matrix of zeros with a column for every input, faster than that of nalgebra, which writes them one
    /// by one.
    pub(crate) fn zeros(&self, rows: usize) -> DMatrix<f64> {
        DMatrix::from_vec(rows, self.count(), vec![0.0; rows * self.count()])
    }
}

/// Wrench [F; s x F] about P of a force F at the arm s.
pub(crate) fn wrench(arm: &Vector3<f64>, force: &Vector3<f64>) -> Vector6<f64> {
    vector::wrench(&(*arm).into(), &(*force).into()).into()
}

/// Wrench [0; s x F] of the moment alone.
fn moment(arm: &Vector3<f64>, force: &Vector3<f64>) -> Vector6<f64> {
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
    stiffness: Matrix3<f64>,
    /// Per density [N m/kg].
    per_density: Vector3<f64>,
    /// Per modulus [N/Pa].
    per_modulus: Vector3<f64>,
    /// k_L [N/m] per length, or v_i per tension where the tension is given.
    pub(crate) per_actuation: Vector3<f64>,
    /// Those by guide and gravity; `None` where all are zero or no parameters.
    surroundings: Option<Box<Surroundings>>,
}

/// Derivatives of a cable's force by what leads it and by gravity.
#[derive(Clone)]
struct Surroundings {
    /// By lead and radius of the guide [N/m].
    per_guide: [Vector3<f64>; 2],
    /// By the tilts of the swivel axis of the pulley [N/rad].
    per_tilt: [Vector3<f64>; 2],
    /// By the components of gravity [N s²/m], equation (D10).
    per_gravity: Matrix3<f64>,
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
        let mut stiffness = Matrix3::from(linearized.stiffness());
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
        if at.is_limp() {
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
        if at.is_limp() {
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

/// A scalar function of a cable, with the derivative `per_force·dF_i + per_arm·ds_i`.
#[derive(Clone, Copy)]
pub(crate) struct Reading {
    pub(crate) per_force: Vector3<f64>,
    pub(crate) per_arm: Vector3<f64>,
}

impl Reading {
    /// The tension, with the derivative dt_i.
    pub(crate) fn tension(cable: &CableDerivatives) -> Self {
        Self { per_force: cable.direction, per_arm: Vector3::zeros() }
    }
}

/// Partial derivatives with respect to all [`Inputs`], with lengths or tensions held. The columns of the pose
/// are those of the pose that the cables are at.
pub(crate) struct Partials {
    /// dG, equation (D4), 6 x count.
    pub(crate) balance: Matrix6xX<f64>,
    /// Derivatives of one reading of each cable, n x count.
    pub(crate) readings: DMatrix<f64>,
}

impl Partials {
    /// Partial derivatives of `cables` at `pose` under weight and `load`.
    pub(crate) fn new(
        robot: &Robot,
        inputs: &Inputs,
        pose: &Pose,
        load: &Load,
        cables: &[CableDerivatives],
        reading: impl Fn(&CableDerivatives) -> Reading,
    ) -> Self {
        let mut partials = Self {
            balance: Matrix6xX::from_vec(vec![0.0; 6 * inputs.count()]),
            readings: inputs.zeros(cables.len()),
        };
        let readings: Vec<_> = cables.iter().map(reading).collect();
        each_effect(inputs, pose, cables, |column, i, force, turn| {
            let (cable, reading) = (&cables[i], &readings[i]);
            let mut balance = partials.balance.column_mut(column);
            balance += wrench(&cable.arm, &force) + moment(&turn, &cable.force);
            partials.readings[(i, column)] += reading.per_force.dot(&force) + reading.per_arm.dot(&turn);
        });
        partials.add_weight(robot, inputs, pose, load);
        partials
    }

    /// Adds dw_ex.
    fn add_weight(&mut self, robot: &Robot, inputs: &Inputs, pose: &Pose, load: &Load) {
        let weight = robot.weight(pose, load.payload).force;
        let center = pose.rotation * robot.platform.center_of_mass;
        each_effect_on_weight(robot, inputs, pose, load, |column, Weighed { force, turn, .. }| {
            let mut column = self.balance.column_mut(column);
            column += wrench(&center, &force) + moment(&turn, &weight);
        });
    }

    /// Moves the columns of the pose out of the partial derivatives: (dG, readings) per (dp, dφ).
    pub(crate) fn take_pose(&mut self, inputs: &Inputs) -> (Matrix6<f64>, DMatrix<f64>) {
        let start = inputs.pose().start;
        let balance = self.balance.fixed_columns::<6>(start).into_owned();
        let readings = self.readings.columns(start, 6).into_owned();
        self.balance.fixed_columns_mut::<6>(start).fill(0.0);
        self.readings.columns_mut(start, 6).fill(0.0);
        (balance, readings)
    }
}

/// Derivatives of the tensions of `cables` at `pose` with the lengths held, n x count: `u_i·dF_i`.
pub(crate) fn tensions(inputs: &Inputs, pose: &Pose, cables: &[CableDerivatives]) -> DMatrix<f64> {
    read(inputs, pose, cables, Reading::tension)
}

/// Derivatives of one reading of each of `cables` at `pose`, n x count.
pub(crate) fn read(
    inputs: &Inputs,
    pose: &Pose,
    cables: &[CableDerivatives],
    reading: impl Fn(&CableDerivatives) -> Reading,
) -> DMatrix<f64> {
    let mut readings = inputs.zeros(cables.len());
    let each: Vec<_> = cables.iter().map(reading).collect();
    each_effect(inputs, pose, cables, |column, i, force, turn| {
        readings[(i, column)] += each[i].per_force.dot(&force) + each[i].per_arm.dot(&turn);
    });
    readings
}

/// Gives `add(column, i, dF_i, ds_i)` for every input that cable i answers to, equations (D1)-(D3).
fn each_effect(
    inputs: &Inputs,
    pose: &Pose,
    cables: &[CableDerivatives],
    mut add: impl FnMut(usize, usize, Vector3<f64>, Vector3<f64>),
) {
    let o = Vector3::zeros();
    let around = |i: usize| cables[i].surroundings.as_deref();
    for (column, parameter) in inputs.parameters.iter().enumerate() {
        match *parameter {
            // dF_i = k_ρ dρ
            Parameter::LinearDensity => {
                cables.iter().enumerate().for_each(|(i, cable)| add(column, i, cable.per_density, o));
            }
            // dF_i = k_E dE
            Parameter::YoungsModulus => {
                cables.iter().enumerate().for_each(|(i, cable)| add(column, i, cable.per_modulus, o));
            }
            // dr_i = ds_i = R da_i
            Parameter::AnchorPoint(i, axis) => {
                let moved: Vector3<f64> = pose.rotation.matrix().column(axis as usize).into();
                add(column, i, -cables[i].stiffness * moved, moved);
            }
            // dr_i = -db_i
            Parameter::ExitPoint(i, axis) => {
                add(column, i, cables[i].stiffness.column(axis as usize).into(), o);
            }
            Parameter::Lead(i) => add(column, i, around(i).map_or(o, |by| by.per_guide[0]), o),
            Parameter::PulleyRadius(i) => add(column, i, around(i).map_or(o, |by| by.per_guide[1]), o),
            Parameter::Tilt(i, axis) => {
                add(column, i, around(i).map_or(o, |by| by.per_tilt[axis as usize]), o);
            }
            Parameter::Gravity(axis) => {
                for i in 0..cables.len() {
                    let column_of = |by: &Surroundings| by.per_gravity.column(axis as usize).into();
                    add(column, i, around(i).map_or(o, column_of), o);
                }
            }
            // These act on the weight or on the set-points.
            Parameter::Mass | Parameter::CenterOfMass(_) | Parameter::TensionOffset(_) => {}
        }
    }
    let start = inputs.pose().start;
    for (axis, unit) in [Vector3::x(), Vector3::y(), Vector3::z()].iter().enumerate() {
        for (i, cable) in cables.iter().enumerate() {
            // dr_i = dp
            add(start + axis, i, -cable.stiffness.column(axis), o);
            // dr_i = ds_i = dφ x s_i
            let turn = unit.cross(&cable.arm);
            add(start + 3 + axis, i, -cable.stiffness * turn, turn);
        }
    }
}

/// What an input changes of the weight.
#[derive(Clone, Copy)]
pub(crate) struct Weighed {
    /// Of mass and payload together, per unit.
    pub(crate) mass: f64,
    /// dF_w [N per unit].
    pub(crate) force: Vector3<f64>,
    /// Of the lever R c [m per unit].
    pub(crate) turn: Vector3<f64>,
}

/// Gives `add(column, what)` for every input that changes the weight F_w at its lever R c.
pub(crate) fn each_effect_on_weight(
    robot: &Robot,
    inputs: &Inputs,
    pose: &Pose,
    load: &Load,
    mut add: impl FnMut(usize, Weighed),
) {
    let none = Weighed { mass: 0.0, force: Vector3::zeros(), turn: Vector3::zeros() };
    // dF_w = γ dm
    let heavier = Weighed { mass: 1.0, force: robot.gravity.vector(), ..none };
    for (column, parameter) in inputs.parameters.iter().enumerate() {
        match *parameter {
            Parameter::Mass => add(column, heavier),
            // R dc
            Parameter::CenterOfMass(axis) => {
                add(column, Weighed { turn: pose.rotation.matrix().column(axis as usize).into(), ..none });
            }
            // dF_w = (m + payload) dγ
            Parameter::Gravity(axis) => {
                let force = Vector3::ith(axis as usize, robot.platform.mass + load.payload);
                add(column, Weighed { force, ..none });
            }
            _ => {}
        }
    }
    add(inputs.payload(), heavier);
    let center = pose.rotation * robot.platform.center_of_mass;
    for (axis, unit) in [Vector3::x(), Vector3::y(), Vector3::z()].iter().enumerate() {
        // dφ x R c
        add(inputs.pose().start + 3 + axis, Weighed { turn: unit.cross(&center), ..none });
    }
}

/// `matrix⁻¹ right`, in place. At 6 x 6 the inverse, applied column by column, is the fastest and as exact
/// as the factors.
pub(crate) fn solve(
    matrix: Matrix6<f64>,
    right: &mut Matrix6xX<f64>,
    quantity: &'static str,
) -> Result<(), StaticsError> {
    let inverse = matrix.try_inverse().filter(|inverse| inverse.iter().all(|value| value.is_finite()));
    let Some(inverse) = inverse else {
        return Err(StaticsError::NoDerivative { quantity, reason: "its equations are singular there" });
    };
    for mut column in right.column_iter_mut() {
        let solution = inverse * &column;
        column.copy_from(&solution);
    }
    Ok(())
}
