//! The least eigenvalue of symmetric matrices, one in each lane.
//!
//! Jacobi's rotations make the elements beside the diagonal zero, one after the other. With
//! `θ = (a_qq - a_pp)/2`,
//!
//! ```text
//! t = a_pq/(θ ± sqrt(θ² + a_pq²)),    c = 1/sqrt(1 + t²),    s = c t                               (L14)
//! a_pp <- a_pp - t a_pq,   a_qq <- a_qq + t a_pq,   (a_rp, a_rq) <- (c a_rp - s a_rq, s a_rp + c a_rq)
//! ```
//!
//! with the sign of θ. The small eigenvalues of a positive definite matrix are as exact as the large ones
//! where its elements are (J. Demmel, K. Veselić, *Jacobi's method is more accurate than QR*, 1992).

use crate::dense::Lanes6x6;
use crate::lanes::{Lanes, Simd};
use crate::number::Number;

/// Sweeps over all elements. They converge quadratically; five or six are usual.
const MAX_SWEEPS: usize = 12;

/// Square of an element beside the diagonal, relative to the product of those on it, from which on its
/// effect is rounding.
const NEGLIGIBLE: f64 = 1e-24;

/// The least eigenvalue of positive definite matrices, of which the upper triangles are read. A lane stops by
/// its own elements alone.
// Indices as in the formula.
#[allow(clippy::needless_range_loop)]
#[inline(always)]
pub fn least_eigenvalue<S: Simd>(matrix: Lanes6x6<S>) -> Lanes<S> {
    let mut a = matrix;
    let zero = a[0][0].all(0.0);
    for _ in 0..MAX_SWEEPS {
        let mut small = zero.less_or_equal(zero);
        for p in 0..6 {
            for q in p + 1..6 {
                let least = a[p][p] * a[q][q] * NEGLIGIBLE;
                small = small & (a[p][q] * a[p][q]).less_or_equal(least);
            }
        }
        let active = !small;
        if !active.any() {
            break;
        }
        for p in 0..6 {
            for q in p + 1..6 {
                let beside = active.select(a[p][q], zero);
                let half = (a[q][q] - a[p][p]) * 0.5;
                let root = (half * half + beside * beside).sqrt();
                let sum = zero.less_or_equal(half).select(half + root, half - root);
                // Equal elements with nothing beside them are not turned.
                let nothing = sum.abs().less_or_equal(zero);
                let t = nothing.select(zero, beside / nothing.select(zero.all(1.0), sum));
                let c = (t * t + 1.0).sqrt().recip();
                let s = c * t;
                a[p][p] -= t * beside;
                a[q][q] += t * beside;
                a[p][q] = active.select(zero, a[p][q]);
                for r in 0..6 {
                    if r == p || r == q {
                        continue;
                    }
                    let [(ip, jp), (iq, jq)] =
                        [if r < p { (r, p) } else { (p, r) }, if r < q { (r, q) } else { (q, r) }];
                    let (rp, rq) = (a[ip][jp], a[iq][jq]);
                    a[ip][jp] = c * rp - s * rq;
                    a[iq][jq] = s * rp + c * rq;
                }
            }
        }
    }
    let mut least = a[0][0];
    for k in 1..6 {
        least = least.less_or_equal(a[k][k]).select(least, a[k][k]);
    }
    least
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::lanes::{MAX_LANES, Scalar, WithSimd, dispatch};
    use nalgebra::Matrix6;

    /// The least eigenvalue of each of these.
    struct Least<'a>(&'a [Matrix6<f64>; MAX_LANES]);

    impl WithSimd for Least<'_> {
        type Output = Vec<f64>;

        #[inline(always)]
        fn with_simd<S: Simd>(self, simd: S) -> Self::Output {
            let mut found = Vec::new();
            for first in (0..MAX_LANES).step_by(Lanes::<S>::COUNT) {
                let lanes: Lanes6x6<S> = std::array::from_fn(|i| {
                    std::array::from_fn(|j| Lanes::from_fn(simd, |lane| self.0[first + lane][(i, j)]))
                });
                found.extend_from_slice(&least_eigenvalue(lanes).to_array()[..Lanes::<S>::COUNT]);
            }
            found
        }
    }

    /// A positive definite matrix whose rows differ in size, or a diagonal one with equal elements.
    fn matrix(seed: usize) -> Matrix6<f64> {
        if seed % 8 == 3 {
            return Matrix6::identity() * 3.0;
        }
        let half = Matrix6::from_fn(|i, j| ((3 * i + 7 * j + 11 * seed) as f64).sin());
        let size = Matrix6::from_diagonal(&nalgebra::Vector6::from_fn(|i, _| 10f64.powi(i as i32 / 2)));
        size * (half * half.transpose() + Matrix6::identity() * 0.01) * size
    }

    #[test]
    fn the_least_eigenvalue_is_that_of_a_dense_solver_on_any_unit() {
        for first in 0..40 {
            let matrices: [_; MAX_LANES] = std::array::from_fn(|lane| matrix(first + lane));
            let found = dispatch(Least(&matrices));
            assert_eq!(found, Least(&matrices).with_simd(Scalar));
            for (own, matrix) in found.into_iter().zip(matrices) {
                let values = matrix.symmetric_eigenvalues();
                assert!((own - values.min()).abs() < 1e-14 * values.max(), "{own} {}", values.min());
            }
        }
    }
}
