//! The `6 + 2n` equations of an equilibrium, assembled, with their Jacobian.
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
use crate::error::StaticsError;
use crate::problem::DirectProblem;
use crate::state::Equilibrium;
use cdpr_cable::kernel::Response;
use cdpr_number::Real;
use cdpr_number::vector::cross;
use cdpr_robot::{Matrix3, Vector3, Vector6};
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
    let zero = T::zero();
    let mut upper = [[zero; 6]; 6];
    add_stiffness(&mut upper, &center.into(), &(-weight).into(), &[[zero; 3]; 3]);
    let mut moment = center.cross(&weight);
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
        let force = cable.force_on_platform();
        moment += Vector3::from(cross(&cable.anchor_arm, &force));
        add_stiffness(&mut upper, &cable.anchor_arm, &force.map(|component| -component), &swing.into());
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
    let platform = Matrix6::from_fn(|i, j| upper[i.min(j)][i.max(j)]);
    jacobian.fixed_view_mut::<6, 6>(0, 0).copy_from(&platform);
    // The skew part of (S5).
    let mut rotations = jacobian.fixed_view_mut::<3, 3>(3, 3);
    rotations += skew(&(moment * T::of(0.5)));
    jacobian
}

impl DirectProblem<'_> {
    /// Left-hand sides of the 6 + 2n equations of an equilibrium, in the order of forces [N], moments [N m]
    /// and the closure of each cable in its plane [m]: zero at an equilibrium.
    ///
    /// # Errors
    /// [`StaticsError::Invalid`] unless `at` is finite and has one force for each cable.
    pub fn equations(&self, at: &Equilibrium) -> Result<DVector<f64>, StaticsError> {
        self.check("equilibrium", at)?;
        Ok(residual(self, &State::from(at)))
    }

    /// Derivatives of [`DirectProblem::equations`] with respect to the motion (dp, dφ) of the platform and to
    /// the force (fx, fz) of each cable.
    ///
    /// # Errors
    /// Those of [`DirectProblem::equations`].
    pub fn jacobian(&self, at: &Equilibrium) -> Result<DMatrix<f64>, StaticsError> {
        self.check("equilibrium", at)?;
        Ok(jacobian(self, &State::from(at)))
    }
}
