//! Least squares with bounds for six equations, by an active set.
//!
//! ```text
//! minimize  |J d + F|²/2 + sum (c_i d_i + h_i d_i²/2)   subject to   l_i <= d_i <= u_i             (T7)
//! ```
//!
//! This is (T4) with ε = 1 and λ_0 = 0. Where h is small, the multipliers of its dual lose the digits from
//! which d follows; the normal equations of the unknowns within their bounds do not. Unknowns rest on their
//! bounds until their gradient asks for the way inside (C. L. Lawson and R. J. Hanson, *Solving Least Squares
//! Problems*, 1974, chapter 23; P. B. Stark and R. L. Parker, *Bounded-Variable Least-Squares*, Computational
//! Statistics 10, 1995). The search starts at d = 0, moved into the bounds.

use crate::box_problem::BoxUnknown;
use nalgebra::{DMatrix, DVector, Vector6};

/// A gradient below this, relative to the column times the residual, is rounding.
const ROUNDING: f64 = 1e-12;

/// d of (T7) for the equations' residual F; `None` where a Hessian is not positive.
pub fn bounded_least_squares(unknowns: &[BoxUnknown], residual: &Vector6<f64>) -> Option<Vec<f64>> {
    let most = 8 * unknowns.len();
    let mut values: Vec<f64> =
        unknowns.iter().map(|BoxUnknown { bounds: [low, high], .. }| 0.0_f64.max(*low).min(*high)).collect();
    let mut free: Vec<usize> = (0..unknowns.len())
        .filter(|i| unknowns[*i].bounds[0] < values[*i] && values[*i] < unknowns[*i].bounds[1])
        .collect();
    for _ in 0..most {
        if move_free(unknowns, residual, &mut values, &mut free)? {
            match freed(unknowns, residual, &values, &free) {
                Some(i) => free.push(i),
                None => break,
            }
        }
    }
    Some(values)
}

/// Moves the free unknowns to their least squares, or until one meets a bound, where it rests from then on.
/// Returns whether they got there.
fn move_free(
    unknowns: &[BoxUnknown],
    residual: &Vector6<f64>,
    values: &mut [f64],
    free: &mut Vec<usize>,
) -> Option<bool> {
    let open = opened(unknowns, residual, values);
    let hessian = DMatrix::from_fn(free.len(), free.len(), |row, column| {
        let [one, other] = [row, column].map(|k| &unknowns[free[k]]);
        one.column.dot(&other.column) + if row == column { one.curvature } else { 0.0 }
    });
    let gradient = DVector::from_fn(free.len(), |row, _| gradient(unknowns, &open, values, free[row]));
    let step = hessian.cholesky()?.solve(&-gradient);
    let (mut share, mut first) = (1.0, None);
    for (k, i) in free.iter().enumerate() {
        let side = usize::from(step[k] > 0.0);
        let room = unknowns[*i].bounds[side] - values[*i];
        if step[k].abs() * share > room.abs() {
            (share, first) = (room / step[k], Some((k, unknowns[*i].bounds[side])));
        }
    }
    for (k, i) in free.iter().enumerate() {
        values[*i] += share * step[k];
    }
    if let Some((k, bound)) = first {
        values[free.swap_remove(k)] = bound;
    }
    Some(first.is_none())
}

/// The unknown on a bound whose gradient most asks for the way inside.
fn freed(unknowns: &[BoxUnknown], residual: &Vector6<f64>, values: &[f64], free: &[usize]) -> Option<usize> {
    let open = opened(unknowns, residual, values);
    let mut most = ROUNDING * open.norm();
    let mut found = None;
    for (i, unknown) in unknowns.iter().enumerate().filter(|(i, _)| !free.contains(i)) {
        let [low, high] = unknown.bounds;
        let size = unknown.column.norm();
        let inwards = match gradient(unknowns, &open, values, i) / size {
            slope if slope < 0.0 && values[i] < high => -slope,
            slope if slope > 0.0 && values[i] > low => slope,
            _ => continue,
        };
        if inwards > most {
            (most, found) = (inwards, Some(i));
        }
    }
    found
}

/// J d + F.
fn opened(unknowns: &[BoxUnknown], residual: &Vector6<f64>, values: &[f64]) -> Vector6<f64> {
    unknowns.iter().zip(values).fold(*residual, |sum, (unknown, d)| sum + unknown.column * *d)
}

/// The slope of (T7) along an unknown.
fn gradient(unknowns: &[BoxUnknown], open: &Vector6<f64>, values: &[f64], i: usize) -> f64 {
    let BoxUnknown { gradient, curvature, column, .. } = &unknowns[i];
    gradient + curvature * values[i] + column.dot(open)
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    #[test]
    fn two_springs_of_which_one_is_blocked() {
        // |d_1 + d_2 - 3|²/2 + d_1²/2 + d_2²/2 with d_1 <= 0.25: d_2 = (3 - 0.25)/2.
        let unknown = |high: f64| BoxUnknown {
            gradient: 0.0,
            curvature: 1.0,
            column: Vector6::x(),
            bounds: [-1.0, high],
        };
        let found = bounded_least_squares(&[unknown(0.25), unknown(9.0)], &(-3.0 * Vector6::x())).unwrap();
        assert!((found[0] - 0.25).abs() < 1e-15 && (found[1] - 1.375).abs() < 1e-15, "{found:?}");
    }

    proptest! {
        /// The conditions of a minimum hold: within the bounds no slope, on a bound none that leads inside.
        #[test]
        fn no_unknown_can_make_it_less(
            columns in prop::collection::vec(-1.0..1.0_f64, 60),
            gradients in prop::collection::vec(-1.0..1.0_f64, 10),
            low in prop::collection::vec(-2.0..0.5_f64, 10),
            width in prop::collection::vec(0.0..2.0_f64, 10),
            residual in prop::collection::vec(-4.0..4.0_f64, 6),
            curvature in prop::sample::select(vec![1.0, 1e-3, 1e-9]),
        ) {
            let unknowns: Vec<BoxUnknown> = (0..10)
                .map(|i| BoxUnknown {
                    gradient: if curvature > 1e-6 { gradients[i] } else { 0.0 },
                    curvature,
                    column: Vector6::from_column_slice(&columns[6 * i..6 * i + 6]),
                    bounds: [low[i], low[i] + width[i]],
                })
                .collect();
            let residual = Vector6::from_column_slice(&residual);
            let values = bounded_least_squares(&unknowns, &residual).unwrap();
            let open = opened(&unknowns, &residual, &values);
            for (i, (unknown, d)) in unknowns.iter().zip(&values).enumerate() {
                let [low, high] = unknown.bounds;
                prop_assert!((low..=high).contains(d), "{d} of {low} to {high}");
                let slope = gradient(&unknowns, &open, &values, i);
                prop_assert!(*d == low || slope < 1e-9, "{slope} at {d} of {low} to {high}");
                prop_assert!(*d == high || slope > -1e-9, "{slope} at {d} of {low} to {high}");
            }
        }
    }
}
