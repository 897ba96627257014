//! The kinks of elastic laws in a row.
//!
//! At the tension T_k where a segment of a law ends, the derivative of a length by its tension T jumps. A
//! length error e with the multiplier λ (half the derivative of the sum of squares by e) adds to the second
//! derivative of half this sum
//!
//! ```text
//! λ e'' = λ l [1/EA]_k / W                                                                       (K7)
//! ```
//!
//! with the length l under a tension from one side of T_k to the other, the jump of the flexibility 1/EA
//! there, and the width W of these tensions: by its own weight a cable has them between its two ends. On its
//! lead and its pulley the tension is that of the exit point, and W is rounding. Where (K7) is positive a row
//! may be at its best with a tension at the kink: linearized residuals show none of this.

use crate::model::compare::Compared;
use crate::model::read::Observed;
use crate::model::{Model, RowAt, RowState};
use cdpr_robot::{CableEnd, PiecewiseLaw, Robot};
use nalgebra::{DMatrix, DVector, RowDVector};

/// Width of the tensions at a kink that rounding leaves, over the tension.
const SHARPEST: f64 = 1e-8;

/// A tension at the end of a cable, of which the law has a kink.
pub(crate) struct Kink {
    /// Tension of the kink less that of the cable [N].
    pub(crate) away: f64,
    /// Derivatives of the tension by the unknowns of the row.
    pub(crate) per_own: RowDVector<f64>,
}

impl Model<'_> {
    /// Finds the kinks of a row, and the second derivatives (K7) that are positive, as rows whose squares add
    /// to the sum.
    pub(super) fn compare_kinks(
        &self,
        at: &RowAt,
        state: &RowState,
        observed: &Observed,
        compared: &mut Compared,
    ) {
        let own = state.errors.len();
        if own == 0 || at.robot.is_linear() {
            return;
        }
        let first = compared.motion.ncols() - own;
        let multipliers = multipliers(at, compared, own);
        let mut bends: Vec<RowDVector<f64>> = Vec::new();
        for i in 0..own {
            let ends = [CableEnd::Anchor, CableEnd::Exit].map(|end| {
                let (tension, models) = observed.tension(i, end);
                (tension, self.chained(at, &observed.lengths, &models))
            });
            let free = at.robot.span(state.pose(), i).norm().min(observed.lengths[i]);
            let tensions = [ends[0].0, ends[1].0];
            for (kink, jump) in jumps(at.robot, i) {
                for (tension, slopes) in &ends {
                    let per_own = slopes.columns(first, own).into_owned();
                    compared.kinks.push(Kink { away: kink - tension, per_own });
                }
                let led = observed.lengths[i] - free;
                for (slopes, length, between) in
                    [(&ends[0].1, free, tensions), (&ends[1].1, led, [tensions[1]; 2])]
                {
                    let width = (between[1] - between[0]).abs().max(SHARPEST * kink);
                    let middle = 0.5 * (between[0] + between[1]);
                    let bend = multipliers[i] * length * jump / width;
                    if (kink - middle).abs() <= 0.5 * width && bend > 0.0 {
                        bends.push(slopes * bend.sqrt());
                    }
                }
            }
        }
        if !bends.is_empty() {
            compared.bends = DMatrix::from_rows(&bends);
        }
    }
}

/// Half the derivatives of the sum of squares by the errors of lengths themselves; zero where none are read.
fn multipliers(at: &RowAt, compared: &Compared, own: usize) -> DVector<f64> {
    let mut whole = compared.residuals.clone();
    if let Some(factor) = at.row.correlation_factor() {
        factor.tr_solve_lower_triangular_mut(&mut whole);
    }
    let first = at.row.readings.len();
    DVector::from_fn(own, |i, _| whole.get(first + i).map_or(0.0, |of| of / compared.std[first + i]))
}

/// Tension of each kink of the law of a cable [N], and the jump of 1/EA there [1/N].
fn jumps(robot: &Robot, i: usize) -> Vec<(f64, f64)> {
    let properties = &robot.cables[i].properties;
    let segments: Vec<_> = properties.law.iter().flat_map(PiecewiseLaw::segments).collect();
    let jump = |pair: &[cdpr_robot::Segment]| {
        let flexibility = |k: usize| 1.0 / (pair[k].ratio * properties.axial_stiffness());
        (pair[1].tension, flexibility(1) - flexibility(0))
    };
    segments.windows(2).map(jump).collect()
}
