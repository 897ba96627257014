//! The balance of the platform and its stiffness, cable by cable.

use crate::equations::assembled::cross;
use crate::model::Model;
use cdpr_robot::{Matrix3, Pose, Vector3, Vector6};
use nalgebra::Matrix6;

/// Platform wrench and stiffness at a pose, from the cables' forces and stiffnesses.
pub(crate) struct Balance {
    /// Gradient of the potential: minus the open wrench on the platform [N, N m].
    pub(crate) gradient: Vector6<f64>,
    /// Its derivative with respect to (dp, dφ); symmetric where the gradient vanishes.
    pub(crate) hessian: Matrix6<f64>,
}

impl Balance {
    /// Weight and load alone.
    pub(crate) fn of_load(model: &Model, pose: &Pose) -> Self {
        let total = model.load.total(model.robot, pose);
        let weight = model.robot.weight(pose, model.load.payload).force;
        let center = pose.rotation * model.robot.platform.center_of_mass;
        let mut hessian = Matrix6::zeros();
        hessian.fixed_view_mut::<3, 3>(3, 3).copy_from(&(-cross(&weight) * cross(&center)));
        Self { gradient: -total.to_vector(), hessian }
    }

    /// Adds a cable with end force `force` [N] and stiffness `stiffness` [N/m] at the arm `s` [m] from P.
    pub(crate) fn add_cable(&mut self, s: &Vector3<f64>, force: &Vector3<f64>, stiffness: &Matrix3<f64>) {
        let arm = cross(s);
        let ks = stiffness * arm;
        let moment = s.cross(force);
        let mut g_p = self.gradient.fixed_rows_mut::<3>(0);
        g_p += force;
        let mut g_r = self.gradient.fixed_rows_mut::<3>(3);
        g_r += moment;
        let mut pp = self.hessian.fixed_view_mut::<3, 3>(0, 0);
        pp += stiffness;
        let mut pr = self.hessian.fixed_view_mut::<3, 3>(0, 3);
        pr -= ks;
        let mut rp = self.hessian.fixed_view_mut::<3, 3>(3, 0);
        rp -= ks.transpose();
        let mut rr = self.hessian.fixed_view_mut::<3, 3>(3, 3);
        rr += cross(force) * arm - arm * ks;
    }

    /// The Hessian of the potential: symmetric, in the increment `R <- exp(dφ) R`.
    pub(crate) fn symmetric_hessian(&self) -> Matrix6<f64> {
        0.5 * (self.hessian + self.hessian.transpose())
    }
}
