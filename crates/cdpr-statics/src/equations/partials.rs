//! Partial derivatives of the equations of equilibrium with respect to the robot's parameters, the load and
//! the pose.
//!
//! Between fixed ends the force of a cable follows from its span, its length and its material. The catenary
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

use crate::equations::cable_derivatives::{CableDerivatives, CableInput, moment, wrench};
use crate::error::StaticsError;
use crate::state::Load;
use cdpr_robot::{Matrix6xX, Parameter, Pose, Robot, Vector3};
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

/// Partial derivatives with respect to all [`Inputs`], with lengths or tensions constant. The columns of the
/// pose are those of the pose that the cables are at.
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
        each_effect_on_weight(robot, inputs, pose, load, |column, force, lever| {
            let mut column = self.balance.column_mut(column);
            column += wrench(&center, &force) + moment(&lever, &weight);
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

/// Derivatives of the tensions of `cables` at `pose` with the lengths constant, n x count: `u_i·dF_i`.
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

/// Gives `add(column, i, dF_i, ds_i)` for every input that cable i responds to, equations (D1)-(D3).
fn each_effect(
    inputs: &Inputs,
    pose: &Pose,
    cables: &[CableDerivatives],
    mut add: impl FnMut(usize, usize, Vector3<f64>, Vector3<f64>),
) {
    let o = Vector3::zeros();
    let slope = |i: usize, first: CableInput, k: usize| -> Vector3<f64> {
        cables[i].per_input.column(first as usize + k).into()
    };
    for (column, parameter) in inputs.parameters.iter().enumerate() {
        match *parameter {
            // dF_i = k_ρ dρ
            Parameter::LinearDensity => {
                (0..cables.len()).for_each(|i| add(column, i, slope(i, CableInput::Density, 0), o));
            }
            // dF_i = k_E dE
            Parameter::YoungsModulus => {
                (0..cables.len()).for_each(|i| add(column, i, slope(i, CableInput::Modulus, 0), o));
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
            Parameter::Lead(i) => add(column, i, slope(i, CableInput::Lead, 0), o),
            Parameter::PulleyRadius(i) => add(column, i, slope(i, CableInput::Radius, 0), o),
            Parameter::Tilt(i, axis) => add(column, i, slope(i, CableInput::Tilt, axis as usize), o),
            Parameter::Gravity(axis) => {
                (0..cables.len())
                    .for_each(|i| add(column, i, slope(i, CableInput::Gravity, axis as usize), o));
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

/// Gives `add(column, dF_w, d(R c))` for every input that changes the weight F_w or its lever R c.
pub(crate) fn each_effect_on_weight(
    robot: &Robot,
    inputs: &Inputs,
    pose: &Pose,
    load: &Load,
    mut add: impl FnMut(usize, Vector3<f64>, Vector3<f64>),
) {
    let o = Vector3::zeros();
    for (column, parameter) in inputs.parameters.iter().enumerate() {
        match *parameter {
            // dF_w = γ dm
            Parameter::Mass => add(column, robot.gravity.vector(), o),
            // R dc
            Parameter::CenterOfMass(axis) => {
                add(column, o, pose.rotation.matrix().column(axis as usize).into());
            }
            // dF_w = (m + payload) dγ
            Parameter::Gravity(axis) => {
                add(column, Vector3::ith(axis as usize, robot.platform.mass + load.payload), o);
            }
            _ => {}
        }
    }
    add(inputs.payload(), robot.gravity.vector(), o);
    let center = pose.rotation * robot.platform.center_of_mass;
    for (axis, unit) in [Vector3::x(), Vector3::y(), Vector3::z()].iter().enumerate() {
        // dφ x R c
        add(inputs.pose().start + 3 + axis, o, unit.cross(&center));
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
