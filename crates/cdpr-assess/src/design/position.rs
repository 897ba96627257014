//! The position error by tolerances: the distance from its pose within which P of 95 % of the robots is.
//!
//! The robots are given the unstrained lengths of the robot as it is designed, without the load. Independent
//! causes with the standard deviations `σ_j` then displace P, to first order, by a vector with the covariance
//!
//! ```text
//! C = sum over the causes j:  σ_j² G_j G_jᵀ                                                    (Q4)
//! ```
//!
//! of the exact derivatives `G_j`; the mean of both sides where left and right ones differ. The vector is
//! taken as normal: it is if the causes are, and nearly so if many of them count. [`normal_distance`] is the
//! distance r, with its derivatives `D_i` by the eigenvalues of C, whose eigenvectors are `e_i`:
//!
//! ```text
//! dr = sum D_i e_iᵀ dC e_i                                                                     (Q5)
//! ```
//!
//! dC by a variable is a difference of (Q4) over a small step within the bounds, of second order: the models
//! have no second derivatives of poses.

use crate::design::evaluation::Quantity;
use crate::design::problem::DesignProblem;
use cdpr_robot::{Matrix3, Pose, Robot, Vector3};
use cdpr_sensitivity::normal_distance;
use cdpr_statics::derivatives::derivatives_from;
use cdpr_statics::{
    DirectProblem, InverseSolution, Load, Matrix3xX, StaticsError, WantedPose, deflection, derivatives,
    inverse,
};
use cdpr_study::{ErrorModel, position_slopes};

/// Share of the robots whose position error is within the distance.
const SHARE: f64 = 0.95;
/// What a position error of a design is.
pub(crate) const BASIS: &str = "The position error is the distance from its pose within which P of 95 % of \
    the robots is, if they are given the lengths of the design without the load: to first order in the \
    deviations, whose sum is taken as normal.";

impl DesignProblem {
    /// The position error at each pose [mm], with derivatives by differences over this share of the range
    /// between the bounds, or without.
    ///
    /// # Errors
    /// Why a robot is not held at a pose, or has no derivatives there.
    pub(crate) fn position_errors(
        &self,
        values: &[f64],
        step: Option<f64>,
    ) -> Result<Vec<Quantity>, StaticsError> {
        let spreads = self.spreads(values)?;
        let mut changes = vec![vec![Matrix3::zeros(); spreads.len()]; self.variables.len()];
        for (j, [low, high]) in self.bounded().filter(|_| step.is_some()) {
            let h = step.unwrap_or_default() * (high - low);
            let moved = |steps: f64| {
                let mut moved = values.to_vec();
                moved[j] += steps * h;
                self.spreads(&moved)
            };
            let side = if values[j] - h < low { 1.0 } else { -1.0 };
            let is_central = values[j] - h >= low && values[j] + h <= high;
            let [one, other] = if is_central { [1.0, -1.0] } else { [side, 2.0 * side] };
            let pairs = moved(one)?.into_iter().zip(moved(other)?);
            for ((change, at), (one, other)) in changes[j].iter_mut().zip(&spreads).zip(pairs) {
                *change = match is_central {
                    true => (one - other) / (2.0 * h),
                    false => (one * 4.0 - other - at * 3.0) / (2.0 * side * h),
                };
            }
        }
        let of = |(k, spread): (usize, &Matrix3<f64>)| {
            position_error(spread, changes.iter().map(|of| &of[k]), step.is_some())
        };
        spreads.iter().enumerate().map(of).collect()
    }

    /// (Q4) at each pose of the robot with these values [m²].
    fn spreads(&self, values: &[f64]) -> Result<Vec<Matrix3<f64>>, StaticsError> {
        let Some(errors) = &self.errors else { return Ok(Vec::new()) };
        let robot = self.robot_at(values)?;
        let solved =
            if self.free.is_empty() { inverse(&robot, &self.poses, &Load::none()) } else { Vec::new() };
        let mut solved = solved.into_iter();
        let at = |pose| self.spread(&robot, errors, pose, solved.next().transpose()?);
        self.poses.iter().map(at).collect()
    }

    fn spread(
        &self,
        robot: &Robot,
        errors: &ErrorModel,
        pose: &Pose,
        held: Option<InverseSolution>,
    ) -> Result<Matrix3<f64>, StaticsError> {
        let (none, wanted) = (Load::none(), WantedPose::at(pose).free(&self.free));
        let of_offsets = match (&held, errors.has_offsets()) {
            (_, false) => None,
            (Some(held), true) => Some(derivatives_from(robot, wanted, &none, held.clone())?),
            (None, true) => Some(derivatives(robot, wanted, &none)?),
        };
        let (lengths, rest) = match held {
            Some(held) => (held.lengths, held.equilibrium),
            None => {
                let found = deflection(robot, wanted, &none)?;
                (found.lengths, found.unloaded.equilibrium)
            }
        };
        let problem = DirectProblem::new(robot, &lengths, &none)?;
        let left = squares(errors, &position_slopes(&problem, &rest, of_offsets.as_ref())?);
        let Some(found) = of_offsets.filter(|found| !found.one_sided.is_empty()) else { return Ok(left) };
        let right = squares(errors, &position_slopes(&problem, &rest, Some(&found.right()))?);
        Ok((left + right) * 0.5)
    }
}

/// The sum of (Q4).
fn squares(errors: &ErrorModel, slopes: &Matrix3xX<f64>) -> Matrix3<f64> {
    let row = |axis| errors.gradient(&slopes.row(axis).iter().copied().collect::<Vec<_>>());
    let rows = [row(0), row(1), row(2)];
    let cause = |(j, input): (usize, &cdpr_sensitivity::Input)| {
        let g = Vector3::new(rows[0][j], rows[1][j], rows[2][j]) * input.std();
        g * g.transpose()
    };
    errors.inputs.iter().enumerate().map(cause).sum()
}

/// The position error [mm] with its derivatives (Q5).
fn position_error<'a>(
    spread: &Matrix3<f64>,
    changes: impl Iterator<Item = &'a Matrix3<f64>>,
    with_slopes: bool,
) -> Result<Quantity, StaticsError> {
    let eigen = spread.symmetric_eigen();
    let variances: [f64; 3] = eigen.eigenvalues.map(|variance| variance.max(0.0)).into();
    let no_derivative = |reason| StaticsError::NoDerivative { quantity: "the position error", reason };
    let found = normal_distance(variances, SHARE).map_err(|_| no_derivative("it is not finite"))?;
    if with_slopes && found.distance == 0.0 {
        return Err(no_derivative("no deviation of the error model moves P"));
    }
    let slope = |change: &Matrix3<f64>| {
        let along = eigen.eigenvectors.column_iter().map(|e| e.dot(&(change * e)));
        1e3 * along.zip(found.per_variance).map(|(change, slope)| change * slope).sum::<f64>()
    };
    let slopes = if with_slopes { changes.map(slope).collect() } else { Vec::new() };
    Ok(Quantity { value: 1e3 * found.distance, slopes })
}
