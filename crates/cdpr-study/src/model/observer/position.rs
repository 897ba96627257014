//! Derivatives of a position.

use cdpr_robot::Parameter;
use cdpr_statics::{Derivatives, DirectProblem, Equilibrium, Matrix3xX, StaticsError};

/// Derivatives of the position of P at an equilibrium for given lengths, by the parameters [m per unit]; by
/// the offsets of tension set-points as they change these lengths, and zero without `of_offsets`.
///
/// # Errors
/// As [`DirectProblem::derivatives`].
pub fn position_slopes(
    problem: &DirectProblem,
    rest: &Equilibrium,
    of_offsets: Option<&Derivatives>,
) -> Result<Matrix3xX<f64>, StaticsError> {
    let mut slopes: Matrix3xX<f64> = problem.derivatives(rest)?.pose.fixed_rows::<3>(0).into();
    if let Some(Derivatives { inputs, lengths, .. }) = of_offsets
        && let Some(first) = inputs.column(Parameter::TensionOffset(0))
    {
        let n = lengths.nrows();
        let moved = problem.linearize(rest)?.pose_per_length() * lengths.columns(first, n);
        slopes.columns_mut(first, n).copy_from(&moved.fixed_rows::<3>(0));
    }
    Ok(slopes)
}
