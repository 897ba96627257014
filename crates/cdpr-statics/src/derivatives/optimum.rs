//! Derivatives of the tensions of the inverse model, on both sides of every input.
//!
//! With the cables on their bounds known, equation (D6) gives the derivatives of all tensions. A bound with a
//! multiplier other than zero stays active for small changes, and the tensions have a derivative. A cable
//! that rests on its bound with the multiplier zero, or reaches it exactly, leaves the bound or stays on it:
//! along a direction d of the inputs its tension and the slope ρ_i of (D5) have
//!
//! ```text
//! dt_i - b_i >= 0,   dρ_i = D_i dt_i + c_i·dλ + ∂ρ_i >= 0,   one of them zero                       (D9)
//! ```
//!
//! at its least tension, and <= 0 at its greatest; b_i is the change of the bound. The directions +d and -d,
//! the right and the left derivative, may keep different cables on their bounds.

use crate::error::StaticsError;
use cdpr_robot::{Freedoms, Matrix6xX};
use cdpr_tension::Bound;
use nalgebra::{DMatrix, Matrix6};

/// A cable that rests on a bound.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct AtBound {
    /// Index of the cable, from 0.
    pub cable: usize,
    /// The bound.
    pub bound: Bound,
}

/// What equation (D6) is made of, before it is known which cables stay on their bounds; columns are inputs.
pub(super) struct Optimum {
    /// ∂G with the tensions constant, 6 x count.
    pub(super) balance: Matrix6xX<f64>,
    /// ∂ρ_i, n x count.
    pub(super) slopes: DMatrix<f64>,
    /// c_i, 6 x n.
    pub(super) per_tension: Matrix6xX<f64>,
    /// D_i.
    pub(super) curvatures: Vec<f64>,
    /// b_i, n x count.
    pub(super) bounds: DMatrix<f64>,
    /// Rows of constrained motions are zero in `balance` and `per_tension`.
    pub(super) freedoms: Freedoms,
}

/// Derivatives of the tensions, n x count.
pub(super) struct Sides {
    pub(super) left: DMatrix<f64>,
    /// The right derivatives, unless they are the left ones.
    pub(super) right: Option<DMatrix<f64>>,
}

const DISTRIBUTION: &str = "the tension distribution";

/// More cables than these without a multiplier have too many combinations.
const MOST_UNDECIDED: usize = 12;

/// A matrix of (D6) with a diagonal of one and an eigenvalue below this is singular to rounding: too few
/// cables are between their bounds, and the multipliers are not unique.
const NEARLY_SINGULAR: f64 = 1e-12;

/// A change below this, relative to the largest in its column, is rounding.
pub(super) const ROUNDING: f64 = 1e-9;

impl Optimum {
    /// The derivatives with the cables of `on_bound` on their bounds; those of `undecided` leave them or
    /// stay, as (D9) decides.
    pub(super) fn sides(&self, on_bound: &[bool], undecided: &[AtBound]) -> Result<Sides, StaticsError> {
        if undecided.is_empty() {
            return Ok(Sides { left: self.with(on_bound)?.0, right: None });
        }
        let none = |reason| StaticsError::NoDerivative { quantity: DISTRIBUTION, reason };
        if undecided.len() > MOST_UNDECIDED {
            return Err(none("many cables reach their bounds there at once"));
        }
        let columns = self.bounds.ncols();
        let mut sides = [self.bounds.clone(), self.bounds.clone()];
        let mut open = vec![[true; 2]; columns];
        let mut on_bound = on_bound.to_vec();
        for released in 0..1_usize << undecided.len() {
            for (k, at) in undecided.iter().enumerate() {
                on_bound[at.cable] = (released >> k) & 1 == 0;
            }
            // With too many cables on their bounds the equations have no solution.
            let Ok((tensions, multipliers)) = self.with(&on_bound) else { continue };
            for column in 0..columns {
                let size = tensions.column(column).amax();
                for (side, sign) in [-1.0, 1.0].into_iter().enumerate() {
                    // (D9)
                    let follows = |at: &AtBound| {
                        let i = at.cable;
                        let t = tensions[(i, column)];
                        let change = if on_bound[i] {
                            let moved = self.per_tension.column(i).dot(&multipliers.column(column));
                            self.curvatures[i] * t + moved + self.slopes[(i, column)]
                        } else {
                            t - self.bounds[(i, column)]
                        };
                        let inwards = if at.bound == Bound::Min { sign } else { -sign };
                        inwards * change >= -ROUNDING * size
                    };
                    if open[column][side] && undecided.iter().all(follows) {
                        sides[side].set_column(column, &tensions.column(column));
                        open[column][side] = false;
                    }
                }
            }
        }
        if open.as_flattened().contains(&true) {
            return Err(none("which bounds the cables leave there is not decided to first order"));
        }
        let [left, right] = sides;
        Ok(Sides { left, right: Some(right) })
    }

    /// (dt, dλ) with the cables of `on_bound` on their bounds, equation (D6).
    fn with(&self, on_bound: &[bool]) -> Result<(DMatrix<f64>, Matrix6xX<f64>), StaticsError> {
        let mut tensions = self.bounds.clone();
        // -c_i/D_i, zero for a cable on a bound.
        let mut responses = DMatrix::zeros(on_bound.len(), 6);
        for i in (0..on_bound.len()).filter(|i| !on_bound[*i]) {
            let d = -self.curvatures[i];
            tensions.set_row(i, &(self.slopes.row(i) / d));
            responses.set_row(i, &(self.per_tension.column(i) / d).transpose());
        }
        let matrix: Matrix6<f64> = (&self.per_tension * &responses).fixed_columns::<6>(0).into();
        let mut multipliers = self.balance.clone();
        multipliers.gemm(1.0, &self.per_tension, &tensions, 1.0);
        multipliers.neg_mut();
        // Constrained motions have no equation and no multiplier.
        let matrix = Matrix6::from_fn(|i, j| match self.freedoms.contains(i) {
            false if i == j => 1.0,
            _ => matrix[(i, j)],
        });
        // With a diagonal of one; the inverse of a matrix that is singular to rounding shows nothing.
        let scale = matrix.diagonal().map(|entry| entry.abs().sqrt().recip());
        let scaled = matrix.component_mul(&(scale * scale.transpose()));
        let is_regular = scaled.iter().all(|entry| entry.is_finite())
            && scaled.symmetric_eigenvalues().abs().min() > NEARLY_SINGULAR;
        let Some(inverse) = matrix.try_inverse().filter(|_| is_regular) else {
            let reason = "the cables between their bounds do not act on all motions of the platform there";
            return Err(StaticsError::NoDerivative { quantity: DISTRIBUTION, reason });
        };
        multipliers = inverse * multipliers;
        tensions.gemm(1.0, &responses, &multipliers, 1.0);
        Ok((tensions, multipliers))
    }
}
