//! Quadratic programs with a diagonal Hessian, bounds and six equations, by their dual.
//!
//! ```text
//! minimise  sum (c_i d_i + h_i d_i²/2) + |J d + F + ε λ_0|²/2ε   subject to   l_i <= d_i <= u_i   (T4)
//! ```
//!
//! As ε goes to zero this is the program with `J d + F = 0`. Its dual has six unknowns λ, however many
//! unknowns d there are: for given λ each d_i stands alone,
//!
//! ```text
//! d_i(λ) = clip( -(c_i + J_i·λ)/h_i, l_i, u_i ),      g(λ) = J d(λ) + F - ε (λ - λ_0) = 0         (T5)
//! ```
//!
//! and g is the gradient of a concave function, quadratic between the points at which a bound becomes active.
//! Newton's method solves for it. A step that would pass the maximum ends there: the slope along the step is
//! piecewise linear, so that its zero is found exactly.

use nalgebra::{Matrix6, Vector6};

/// One unknown of the program (T4).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BoxUnknown {
    /// Gradient c_i.
    pub gradient: f64,
    /// Element h_i of the Hessian, positive.
    pub curvature: f64,
    /// Column J_i.
    pub column: Vector6<f64>,
    /// Least and greatest value.
    pub bounds: [f64; 2],
}

/// The program (T4).
#[derive(Clone, Copy, Debug)]
pub struct BoxProblem<'a> {
    /// The unknowns.
    pub unknowns: &'a [BoxUnknown],
    /// F.
    pub residual: Vector6<f64>,
    /// ε, positive.
    pub elasticity: f64,
    /// λ_0, where Newton's method starts, too.
    pub multipliers: Vector6<f64>,
}

/// The solution of a [`BoxProblem`].
#[derive(Clone, Debug, PartialEq)]
pub struct BoxSolution {
    /// d.
    pub values: Vec<f64>,
    /// λ.
    pub multipliers: Vector6<f64>,
    /// |g(λ)|, zero but for rounding.
    pub residual: f64,
}

/// A gradient below this, relative to the terms that it is the sum of, is rounding; one below the other if a
/// step does not halve it.
const ROUNDING: f64 = 1e-15;
const NEARLY_ROUNDING: f64 = 1e-12;

impl BoxUnknown {
    /// d_i(λ), (T5), with J_i·λ.
    #[inline]
    fn value(&self, along: f64) -> f64 {
        let free = -(self.gradient + along) / self.curvature;
        free.max(self.bounds[0]).min(self.bounds[1])
    }
}

/// The dual at some λ.
struct Dual {
    /// g.
    gradient: Vector6<f64>,
    /// The largest term of g.
    size: f64,
}

/// What is kept of an unknown between the iterations.
struct Kept {
    /// The largest component of its column.
    largest: f64,
    /// Whether it moves with λ, as far as the factors of the slope know.
    moving: bool,
    /// Whether it moves with λ where the dual was last evaluated.
    moves: bool,
}

impl BoxProblem<'_> {
    /// The solution: for a positive ε there is exactly one.
    pub fn solve(&self) -> BoxSolution {
        const MAX_ITERATIONS: usize = 100;
        let mut multipliers = self.multipliers;
        // The first step sees no bound.
        let each = self.unknowns.iter().map(|unknown| unknown.column.amax());
        let mut kept: Vec<_> = each.map(|largest| Kept { largest, moving: true, moves: true }).collect();
        let mut dual = self.dual(&multipliers, &mut kept, true);
        let mut factors = self.slope(&kept).cholesky();
        for _ in 0..MAX_ITERATIONS {
            let error = dual.gradient.amax();
            if error <= ROUNDING * dual.size {
                break;
            }
            let Some(step) = factors.as_ref().map(|factors| factors.solve(&dual.gradient)) else { break };
            let full = multipliers + step;
            let next = self.dual(&full, &mut kept, false);
            let halved = next.gradient.amax() <= 0.5 * error;
            if !halved && error <= NEARLY_ROUNDING * dual.size {
                break;
            }
            if halved || next.gradient.dot(&step) >= 0.0 {
                (multipliers, dual) = (full, next);
            } else {
                multipliers += step * self.share(&multipliers, &step, &mut kept);
                dual = self.dual(&multipliers, &mut kept, false);
            }
            if kept.iter().any(|kept| kept.moving != kept.moves) {
                kept.iter_mut().for_each(|kept| kept.moving = kept.moves);
                factors = self.slope(&kept).cholesky();
            }
        }
        let value = |unknown: &BoxUnknown| unknown.value(unknown.column.dot(&multipliers));
        let values = self.unknowns.iter().map(value).collect();
        BoxSolution { values, multipliers, residual: dual.gradient.norm() }
    }

    /// The dual at λ, and which unknowns move there: all where bounds are `ignored`.
    fn dual(&self, multipliers: &Vector6<f64>, kept: &mut [Kept], ignored: bool) -> Dual {
        let mut gradient = self.residual - (multipliers - self.multipliers) * self.elasticity;
        let mut size = self.residual.amax();
        for (unknown, kept) in self.unknowns.iter().zip(kept) {
            let BoxUnknown { column, bounds: [least, greatest], curvature, .. } = unknown;
            let along = column.dot(multipliers);
            let d = unknown.value(along);
            gradient += column * d;
            kept.moves = ignored || (*least < d && d < *greatest);
            if kept.moves {
                // d is the difference of two terms as large as this.
                let terms = (unknown.gradient.abs() + along.abs()) / curvature * kept.largest;
                size = if terms > size { terms } else { size };
            }
        }
        Dual { gradient, size }
    }

    /// -dg/dλ, where the unknowns that are `moving` move with λ.
    fn slope(&self, kept: &[Kept]) -> Matrix6<f64> {
        let mut slope = Matrix6::from_diagonal_element(self.elasticity);
        let moving = self.unknowns.iter().zip(kept).filter(|(_, kept)| kept.moving);
        for (BoxUnknown { column, curvature, .. }, _) in moving {
            slope.syger(1.0 / curvature, column, column, 1.0);
        }
        slope
    }

    /// The share of a step at which the slope g·step becomes zero; it is negative at the whole step.
    fn share(&self, multipliers: &Vector6<f64>, step: &Vector6<f64>, kept: &mut [Kept]) -> f64 {
        let mut slope = |share: f64| self.dual(&(multipliers + step * share), kept, false).gradient.dot(step);
        // Where an unknown meets a bound.
        let mut kinks: Vec<f64> = Vec::with_capacity(2 * self.unknowns.len());
        for BoxUnknown { gradient, curvature, column, bounds } in self.unknowns {
            let (now, change) = (gradient + column.dot(multipliers), column.dot(step));
            let kink = |bound: &f64| -(curvature * bound + now) / change;
            kinks.extend(bounds.iter().map(kink).filter(|share| 0.0 < *share && *share < 1.0));
        }
        kinks.sort_by(f64::total_cmp);
        let first_negative = kinks.partition_point(|kink| slope(*kink) > 0.0);
        let low = first_negative.checked_sub(1).map_or(0.0, |i| kinks[i]);
        let high = kinks.get(first_negative).copied().unwrap_or(1.0);
        let (at_low, at_high) = (slope(low), slope(high));
        low + (high - low) * (at_low / (at_low - at_high)).clamp(0.0, 1.0)
    }
}
