//! The `6 + 2n` equations of an equilibrium, assembled, with their Jacobian. No other module names faer.
//!
//! Unknowns: the motion (dp, dφ) of the platform, then (fx, fz) of every cable at A. Equations, in this
//! order:
//!
//! ```text
//! -( sum F_i + F_ex ) = 0                 force balance of the platform [N]               Eq. (3)
//! -( sum s_i x F_i + M_ex ) = 0           moment balance about P [N m]                    Eq. (3)
//! (h_i, z_i) - (x, z)(f_i, L_i) = 0       each cable spans its two points [m]    Eq. (1), (2a), (2b)
//! ```
//!
//! with F_i of (S1) and the wrench (F_ex, M_ex) of weight and load. The sign of the balance makes it the
//! gradient of the potential. Derivatives:
//!
//! ```text
//! -dF_i = e_h dfx + e_z dfz + (fx/h) e_l e_lᵀ dr_i,    dr_i = dp - [s_i] dφ,    e_l = e_z x e_h
//! d(s_i x F_i) = [s_i] dF_i + [F_i][s_i] dφ,           dM_ex = [F_w][R c] dφ
//! d(h_i, z_i) = (e_hᵀ, e_zᵀ) dr_i,                     d(x, z) = C_i df_i
//! ```

use crate::equations::balance::add_stiffness;
use crate::equations::spanned::SpannedCable;
use crate::problem::DirectProblem;
use crate::state::Equilibrium;
use cdpr_cable::kernel::Response;
use cdpr_number::Real;
use cdpr_number::vector::cross;
use cdpr_robot::{Matrix3, Vector3, Vector6};
use faer::linalg::solvers::{PartialPivLu, Solve};
use nalgebra::{
    ClosedAddAssign, ClosedMulAssign, ClosedSubAssign, DMatrix, DVector, Matrix6, Scalar, Vector2,
};
use num_traits::{One, Zero};

/// Numbers that the equations can be evaluated with: doubles, intervals.
pub(crate) trait Element:
    Real + Scalar + Zero + One + ClosedAddAssign + ClosedSubAssign + ClosedMulAssign
{
}

impl<T: Real + Scalar + Zero + One + ClosedAddAssign + ClosedSubAssign + ClosedMulAssign> Element for T {}

/// The unknowns: pose and cable forces.
pub(crate) struct State<T> {
    pub(crate) position: Vector3<T>,
    pub(crate) rotation: Matrix3<T>,
    pub(crate) forces: Vec<Vector2<T>>,
}

impl From<&Equilibrium> for State<f64> {
    fn from(equilibrium: &Equilibrium) -> Self {
        Self {
            position: equilibrium.pose.position,
            rotation: *equilibrium.pose.rotation.matrix(),
            forces: equilibrium.cable_forces.clone(),
        }
    }
}

impl<T: Element> State<T> {
    /// Cable i at this state.
    pub(crate) fn cable<'a>(&self, problem: &DirectProblem<'a>, i: usize) -> SpannedCable<'a, T> {
        let arm = self.rotation * problem.robot.cables[i].anchor_point.map(T::of);
        SpannedCable::new(problem, self.position.into(), arm.into(), self.forces[i].into(), i)
    }
}

/// Cross-product matrix [v].
pub(crate) fn skew<T: Element>(v: &Vector3<T>) -> Matrix3<T> {
    let o = T::zero();
    Matrix3::new(o, -v.z, v.y, v.z, o, -v.x, -v.y, v.x, o)
}

/// Nearer to the vertical than this, `fx/h` of a cable that need not fit its points means nothing, and its
/// limit stands in.
pub(crate) const NEAR_VERTICAL: f64 = 1e-9;

/// Weight of platform and payload [N], and the lever of its centre of mass [m].
fn weight<T: Element>(problem: &DirectProblem, state: &State<T>) -> (Vector3<T>, Vector3<T>) {
    let platform = &problem.robot.platform;
    let mass = T::of(platform.mass) + T::of(problem.load.payload);
    let weight = problem.robot.gravity.vector().map(T::of) * mass;
    (weight, state.rotation * platform.center_of_mass.map(T::of))
}

/// Index of the first of the two equations of cable i, and of its first unknown fx.
pub(crate) fn closure_row(i: usize) -> usize {
    6 + 2 * i
}

/// Left-hand sides of all equations.
pub(crate) fn residual<T: Element>(problem: &DirectProblem, state: &State<T>) -> DVector<T> {
    let mut residual = DVector::from_element(6 + 2 * problem.cables(), T::zero());
    let (weight, center) = weight(problem, state);
    let load = &problem.load.wrench;
    // Eq. (3) with the opposite sign: -w_ex, then -w_i t_i of each cable.
    residual.fixed_rows_mut::<3>(0).copy_from(&-(weight + load.force.map(T::of)));
    residual.fixed_rows_mut::<3>(3).copy_from(&-(center.cross(&weight) + load.moment.map(T::of)));
    for i in 0..problem.cables() {
        let cable = state.cable(problem, i);
        let mut balance = residual.fixed_rows_mut::<6>(0);
        balance -= Vector6::from(cable.wrench());
        // Eq. (2a), Eq. (2b): from the end of the cable to its anchor point.
        let misclosure = Vector2::from(cable.misclosure());
        residual.fixed_rows_mut::<2>(closure_row(i)).copy_from(&misclosure);
    }
    residual
}

/// Derivatives of [`residual`] with respect to (dp, dφ, fx_1, fz_1, ..., fx_n, fz_n).
pub(crate) fn jacobian<T: Element>(problem: &DirectProblem, state: &State<T>) -> DMatrix<T> {
    let size = 6 + 2 * problem.cables();
    let mut jacobian = DMatrix::from_element(size, size, T::zero());
    let (weight, center) = weight(problem, state);
    let mut platform = Matrix6::zeros();
    platform.fixed_view_mut::<3, 3>(3, 3).copy_from(&-(skew(&weight) * skew(&center)));
    for i in 0..problem.cables() {
        let cable = state.cable(problem, i);
        let at = closure_row(i);
        let Some(&Response { flexibility: [xx, xz, zz], lateral_flexibility, .. }) = cable.response() else {
            // Its force stays zero.
            jacobian.fixed_view_mut::<2, 2>(at, at).fill_with_identity();
            continue;
        };
        let plane = &cable.span.plane;
        let sideways = Vector3::new(-plane.azimuth[1], plane.azimuth[0], T::zero());
        let [h, z] = cable.span.end;
        let near_vertical = Real::value(h) <= NEAR_VERTICAL * Real::value(z).abs();
        let lateral = if near_vertical { T::one() / lateral_flexibility } else { cable.force[0] / h };
        let swing = sideways * sideways.transpose() * lateral;
        add_stiffness(&mut platform, &cable.anchor_arm, &cable.force_on_platform(), swing.into());
        for (j, axis) in [[T::one(), T::zero()], [T::zero(), T::one()]].into_iter().enumerate() {
            let axis = plane.lift(axis);
            let [axis, turned] = [axis, cross(&cable.anchor_arm, &axis)].map(Vector3::from);
            jacobian.fixed_view_mut::<3, 1>(0, at + j).copy_from(&axis);
            jacobian.fixed_view_mut::<3, 1>(3, at + j).copy_from(&turned);
            jacobian.fixed_view_mut::<1, 3>(at + j, 0).copy_from(&axis.transpose());
            jacobian.fixed_view_mut::<1, 3>(at + j, 3).copy_from(&turned.transpose());
        }
        let force = Vector2::from(cable.force.map(Real::value));
        let asymmetry = T::of(problem.catenary(i, force).asymmetry());
        let flexibility = nalgebra::Matrix2::new(-xx, -(xz + asymmetry), -(xz - asymmetry), -zz);
        jacobian.fixed_view_mut::<2, 2>(at, at).copy_from(&flexibility);
    }
    jacobian.fixed_view_mut::<6, 6>(0, 0).copy_from(&platform);
    jacobian
}

/// The assembled Jacobian at an equilibrium, factored once for any number of right-hand sides.
pub(crate) struct FactoredJacobian {
    lu: PartialPivLu<f64>,
    size: usize,
}

impl FactoredJacobian {
    pub(crate) fn new(jacobian: &DMatrix<f64>) -> Self {
        let size = jacobian.nrows();
        let matrix = faer::Mat::from_fn(size, size, |i, j| jacobian[(i, j)]);
        Self { lu: matrix.partial_piv_lu(), size }
    }

    /// `J⁻¹`.
    pub(crate) fn inverse(&self) -> DMatrix<f64> {
        self.solve(&DMatrix::identity(self.size, self.size))
    }

    /// `J⁻¹ right`, column by column.
    pub(crate) fn solve(&self, right: &DMatrix<f64>) -> DMatrix<f64> {
        let right = faer::Mat::from_fn(self.size, right.ncols(), |i, j| right[(i, j)]);
        let solution = self.lu.solve(&right);
        DMatrix::from_fn(self.size, solution.ncols(), |i, j| solution[(i, j)])
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::direct::newton_step;
    use crate::equations::cables_at;
    use crate::state::Load;
    use cdpr_robot::{Pose, Robot, Vector2, Wrench};
    use proptest::prelude::*;

    fn moved(equilibrium: &Equilibrium, step: &DVector<f64>) -> Equilibrium {
        let cable_forces = equilibrium.cable_forces.iter().enumerate();
        Equilibrium {
            pose: equilibrium.pose.moved(step.fixed_rows::<3>(0).into(), step.fixed_rows::<3>(3).into()),
            cable_forces: cable_forces
                .map(|(i, force)| force + Vector2::new(step[6 + 2 * i], step[7 + 2 * i]))
                .collect(),
        }
    }

    /// CAROCA or CoGiRo somewhere, with cables from taut to slack and a wrench.
    fn any_state() -> impl Strategy<Value = (Robot, Vec<f64>, Load, Pose)> {
        let slack = prop::collection::vec(prop_oneof![-1e-3..1e-3f64, 1e-3..0.2f64], 8);
        (any::<bool>(), prop::array::uniform6(-1.0..1.0f64), prop::array::uniform6(-1.0..1.0f64), slack)
            .prop_map(|(caroca, m, w, slack)| {
                let (text, height) = if caroca {
                    (include_str!("../../../../data/robots/caroca.json"), 1.75)
                } else {
                    (include_str!("../../../../data/robots/cogiro.json"), 2.5)
                };
                let robot = Robot::from_json(text).unwrap();
                let pose = Pose::at(2.0 * m[0], m[1], height + m[2])
                    .moved(Vector3::zeros(), 0.3 * Vector3::new(m[3], m[4], m[5]));
                let lengths = (0..8).map(|i| robot.span(&pose, i).norm() * (1.0 + slack[i])).collect();
                let wrench = Wrench {
                    force: 100.0 * Vector3::new(w[0], w[1], w[2]),
                    moment: 20.0 * Vector3::new(w[3], w[4], w[5]),
                };
                (robot, lengths, Load { payload: 20.0, wrench }, pose)
            })
    }

    proptest! {
        #![proptest_config(ProptestConfig {
            cases: 300, failure_persistence: None, ..ProptestConfig::default()
        })]

        #[test]
        fn the_jacobian_is_the_derivative_of_the_equations(
            (robot, lengths, load, pose) in any_state(), misfit in prop_oneof![Just(1.0), 0.5..2.0f64],
        ) {
            let problem = DirectProblem::new(&robot, &lengths, &load).unwrap();
            let mut state = cables_at(&problem, &pose).unwrap();
            // Forces that need not fit the pose, too.
            state.cable_forces.iter_mut().for_each(|force| *force *= misfit);
            let jacobian = jacobian(&problem, &State::from(&state));
            for column in 0..jacobian.ncols() {
                let force = state.cable_forces.get(column.wrapping_sub(6) / 2);
                let by_force = force.map_or(1.0, |f| 2e-4 * f.x.max(1e-3 * f.norm()));
                let h = if column < 6 { 1e-4 } else { by_force };
                let at = |h: f64| {
                    let mut step = DVector::zeros(jacobian.nrows());
                    step[column] = h;
                    residual(&problem, &State::from(&moved(&state, &step)))
                };
                let slope = (8.0 * (at(h) - at(-h)) - (at(2.0 * h) - at(-2.0 * h))) / (12.0 * h);
                let error = (&slope - jacobian.column(column)).norm();
                let rounding = 1e-15 * (at(0.0).norm() + 1e4) / h;
                let allowed = 1e-6 * jacobian.column(column).norm() + rounding;
                prop_assert!(error < allowed, "column {column}: {error:e}");
            }
        }

        #[test]
        fn eliminating_the_cables_is_newtons_step_of_the_assembled_equations(
            (robot, lengths, load, pose) in any_state(),
        ) {
            let problem = DirectProblem::new(&robot, &lengths, &load).unwrap();
            let state = cables_at(&problem, &pose).unwrap();
            let right = -residual(&problem, &State::from(&state));
            let factored = FactoredJacobian::new(&jacobian(&problem, &State::from(&state)));
            let assembled = factored.solve(&DMatrix::from_column_slice(right.len(), 1, right.as_slice()));
            let reduced = newton_step(&problem, &state).unwrap();
            let expected = assembled.fixed_view::<6, 1>(0, 0);
            prop_assert!((reduced - expected).norm() < 1e-6 * expected.norm(), "{reduced} {expected}");
        }
    }
}
