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
    /// d_i(λ), (T5).
    fn value(&self, multipliers: &Vector6<f64>) -> f64 {
        let free = -(self.gradient + self.column.dot(multipliers)) / self.curvature;
        free.max(self.bounds[0]).min(self.bounds[1])
    }
}

/// The dual at some λ.
struct Dual {
    /// g.
    gradient: Vector6<f64>,
    /// -dg/dλ.
    slope: Matrix6<f64>,
    /// The largest term of g.
    size: f64,
}

impl BoxProblem<'_> {
    /// The solution: for a positive ε there is exactly one.
    pub fn solve(&self) -> BoxSolution {
        const MAX_ITERATIONS: usize = 100;
        let mut multipliers = self.multipliers;
        // The first step sees no bound.
        let mut dual = self.dual(&multipliers, true);
        for _ in 0..MAX_ITERATIONS {
            let error = dual.gradient.amax();
            if error <= ROUNDING * dual.size {
                break;
            }
            let Some(step) = dual.slope.cholesky().map(|factors| factors.solve(&dual.gradient)) else {
                break;
            };
            let full = multipliers + step;
            let next = self.dual(&full, false);
            let halved = next.gradient.amax() <= 0.5 * error;
            if !halved && error <= NEARLY_ROUNDING * dual.size {
                break;
            }
            if halved || next.gradient.dot(&step) >= 0.0 {
                (multipliers, dual) = (full, next);
            } else {
                multipliers += step * self.share(&multipliers, &step);
                dual = self.dual(&multipliers, false);
            }
        }
        let values = self.unknowns.iter().map(|unknown| unknown.value(&multipliers)).collect();
        BoxSolution { values, multipliers, residual: dual.gradient.norm() }
    }

    /// The dual at λ; its slope is that without bounds where they are `ignored`.
    fn dual(&self, multipliers: &Vector6<f64>, ignored: bool) -> Dual {
        let mut dual = Dual {
            gradient: self.residual - (multipliers - self.multipliers) * self.elasticity,
            slope: Matrix6::from_diagonal_element(self.elasticity),
            size: self.residual.amax(),
        };
        for unknown in self.unknowns {
            let BoxUnknown { column, bounds: [least, greatest], curvature, gradient } = unknown;
            let d = unknown.value(multipliers);
            dual.gradient.axpy(d, column, 1.0);
            if ignored || (*least < d && d < *greatest) {
                dual.slope.syger(1.0 / curvature, column, column, 1.0);
                // d is the difference of two terms as large as this.
                let terms = gradient.abs() + column.dot(multipliers).abs();
                dual.size = dual.size.max(terms / curvature * column.amax());
            }
        }
        dual
    }

    /// The share of a step at which the slope g·step becomes zero; it is negative at the whole step.
    fn share(&self, multipliers: &Vector6<f64>, step: &Vector6<f64>) -> f64 {
        let slope = |share: f64| self.dual(&(multipliers + step * share), false).gradient.dot(step);
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
