//! From the given coordinates of a pose to set-points and lengths, for fewer cables than free motions.
//!
//! The unloaded platform rests at a pose whose free coordinates q are found together with the lengths, (I6)
//! of `inverse/free.rs`. If the inputs change its balance by ∂G and the given coordinates move it by dc, then
//! with the motions T of the free coordinates
//!
//! ```text
//! ∂G/∂(p, φ) (T dq + dc) + sum [k_L; s x k_L] dL_i + ∂G = 0                                       (D11)
//! ```
//!
//! m equations for n lengths and m - n coordinates. Tensions of this rest, with their offsets, are the
//! set-points; the lengths for these, at the pose of rest, follow from (D7), whose ∂F_i includes the motion
//! `T dq + dc`.

use crate::dense::Lu;
use crate::equations::{CableDerivatives, Inputs, Partials, Reading, tensions};
use crate::error::StaticsError;
use crate::inverse::PoseLengths;
use crate::problem::DirectProblem;
use crate::state::Load;
use cdpr_robot::{Coordinate, Matrix6xX, ParameterLayout, Pose, Robot, Vector6};
use nalgebra::{DMatrix, Matrix6};

/// A platform that rests where some coordinates are those of a wanted pose.
pub(super) struct Rest<'a> {
    pub(super) robot: &'a Robot,
    pub(super) wanted: &'a Pose,
    pub(super) free: &'a [Coordinate],
    pub(super) inputs: &'a Inputs,
    /// Without offsets of the set-points.
    pub(super) unmoved: &'a PoseLengths,
    /// At the same pose, with the offsets.
    pub(super) offset: &'a PoseLengths,
}

/// A set-point differs from its tension and offset by less than this share, or it is on a limit.
const SAME: f64 = 1e-9;

impl Rest<'_> {
    /// Derivatives of the set-points and of the lengths, n x count each.
    ///
    /// # Errors
    /// [`StaticsError::NoDerivative`] where the equations are singular, and for a set-point on a limit.
    pub(super) fn slopes(
        &self,
        tension_offsets: &[f64],
    ) -> Result<(DMatrix<f64>, DMatrix<f64>), StaticsError> {
        let Self { robot, inputs, unmoved, offset: with_offsets, .. } = *self;
        let (before, after) = (unmoved.equilibrium.tensions(), with_offsets.equilibrium.tensions());
        let moved = before.iter().zip(tension_offsets).zip(&after);
        if moved.into_iter().any(|((t, offset), found)| (t + offset - found).abs() > SAME * (t + found)) {
            let reason =
                "it stays at a limit of tension, or at the least one that the weight of its cable demands";
            return Err(StaticsError::NoDerivative { quantity: "a set-point with its offset", reason });
        }
        let (motion, mut set_points) = self.motion()?;
        let layout = ParameterLayout::of(robot);
        for i in 0..before.len() {
            set_points[(i, layout.tension_offset(i))] += 1.0;
        }
        let cables = cables_with(robot, with_offsets)?;
        let mut lengths = tensions(inputs, &with_offsets.equilibrium.pose, &cables);
        let per_motion = lengths.columns(inputs.pose().start, 6).into_owned();
        lengths.columns_mut(inputs.pose().start, 6).fill(0.0);
        lengths.gemm(1.0, &per_motion, &motion, 1.0);
        let lengths = lengths_of(&set_points, lengths, &cables);
        Ok((set_points, lengths))
    }

    /// Derivatives of the pose of rest, 6 x count, and of its tensions, n x count: equation (D11).
    fn motion(&self) -> Result<(Matrix6xX<f64>, DMatrix<f64>), StaticsError> {
        let Self { robot, inputs, unmoved, .. } = *self;
        let (pose, none) = (&unmoved.equilibrium.pose, Load::none());
        let cables = cables_with(robot, unmoved)?;
        let mut partials = Partials::new(robot, inputs, pose, &none, &cables, Reading::tension);
        let (hessian, tensions_per_motion) = partials.take_pose(inputs);
        let Partials { mut balance, readings: mut tensions } = partials;
        balance.column_mut(inputs.payload()).fill(0.0);
        let (given, free) = self.coordinates()?;
        let start = inputs.pose().start;
        balance.fixed_columns_mut::<6>(start).copy_from(&(hessian * given));

        let (rows, n) = (robot.freedoms().components(), cables.len());
        let per_length: Vec<Vector6<f64>> =
            cables.iter().map(CableDerivatives::wrench_per_actuation).collect();
        let per_free = hessian * &free;
        let entry = |i: usize, j: usize| match per_length.get(j) {
            Some(wrench) => wrench[rows[i]],
            None => per_free[(rows[i], j - n)],
        };
        let matrix = DMatrix::from_fn(rows.len(), rows.len(), entry);
        let right = DMatrix::from_fn(rows.len(), inputs.count(), |i, j| -balance[(rows[i], j)]);
        let found = Lu::new(&matrix).solve(&right);
        if !found.iter().all(|value| value.is_finite()) {
            let reason = "its equations are singular there";
            return Err(StaticsError::NoDerivative { quantity: "the pose of rest", reason });
        }
        let mut motion = free * found.rows(n, rows.len() - n);
        let mut of_wanted = motion.fixed_columns_mut::<6>(start);
        of_wanted += given;
        tensions.gemm(1.0, &tensions_per_motion, &motion, 1.0);
        for (i, cable) in cables.iter().enumerate() {
            let mut row = tensions.row_mut(i);
            row += found.row(i) * cable.direction.dot(&cable.per_actuation);
        }
        Ok((motion, tensions))
    }

    /// Motion (dp, dφ) of rest by that of the wanted pose, 6 x 6, and by the free coordinates.
    fn coordinates(&self) -> Result<(Matrix6<f64>, Matrix6xX<f64>), StaticsError> {
        let [wanted, mut rest] = [self.wanted, &self.unmoved.equilibrium.pose].map(|pose| {
            Matrix6::from_columns(&Coordinate::ALL.map(|coordinate| self.robot.motion(coordinate, pose)))
        });
        let free: Vec<_> =
            self.free.iter().map(|coordinate| rest.column(coordinate.component()).into_owned()).collect();
        for coordinate in self.free {
            rest.column_mut(coordinate.component()).fill(0.0);
        }
        let inverse = wanted.try_inverse().filter(|_| wanted.determinant().abs() > SAME);
        let upright = || StaticsError::NoDerivative {
            quantity: "the wanted pose",
            reason: "at a pitch of 90 degrees roll and yaw are the same motion",
        };
        Ok((rest * inverse.ok_or_else(upright)?, Matrix6xX::from_columns(&free)))
    }
}

/// The cables with these lengths, without a load.
pub(super) fn cables_with(robot: &Robot, at: &PoseLengths) -> Result<Vec<CableDerivatives>, StaticsError> {
    let PoseLengths { lengths, equilibrium } = at;
    let problem = DirectProblem::new(robot, lengths, &Load::none())?;
    Ok(CableDerivatives::all(&problem, &equilibrium.pose, &equilibrium.cable_forces))
}

/// Derivatives of the lengths from those of the set-points and of the tensions with constant lengths,
/// equation (D7).
pub(super) fn lengths_of(
    set_points: &DMatrix<f64>,
    tensions: DMatrix<f64>,
    cables: &[CableDerivatives],
) -> DMatrix<f64> {
    let mut lengths = set_points - tensions;
    for (mut row, cable) in lengths.row_iter_mut().zip(cables) {
        row /= cable.direction.dot(&cable.per_actuation);
    }
    lengths
}
