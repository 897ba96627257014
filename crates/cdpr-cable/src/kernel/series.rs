//! The series of ψ(q²) = (atanh(q)/q - 1)/q², which is the part of a cable's sag in its end position.

use super::field::Field;

/// A cable with q² up to this is taut: the formulas of [`crate::kernel::taut_response`] hold to rounding.
pub const TAUT: f64 = 0.02;

/// Above this q² the logarithm is used; it agrees with the series to rounding there.
pub(super) const SERIES_LIMIT: f64 = 0.1;

/// 1/3, 1/5, 1/7, ...: the coefficients of ψ(q²).
const SERIES: [f64; 17] = {
    let mut series = [0.0; 17];
    let mut k = 0;
    while k < series.len() {
        series[k] = 1.0 / (2 * k + 3) as f64;
        k += 1;
    }
    series
};

/// ψ(q²) for q² up to [`SERIES_LIMIT`]: the first terms of 1/3 + q²/5 + q⁴/7 + ...
pub(super) fn psi_of_slack<T: Field>(q2: T) -> T {
    let [first @ .., before, last] = &SERIES;
    first.iter().rev().fold(q2 * *last + *before, |sum, term| sum * q2 + *term)
}

/// ψ(q²) for q² up to [`TAUT`], by ten terms, which leave 5e-19.
///
/// Even and odd terms are summed apart, so that neither sum waits for the other.
#[inline(always)]
pub(super) fn psi_of_taut<T: Field>(q2: T) -> T {
    let c = &SERIES;
    let q4 = q2 * q2;
    let even = (((q4 * c[8] + c[6]) * q4 + c[4]) * q4 + c[2]) * q4 + c[0];
    let odd = (((q4 * c[9] + c[7]) * q4 + c[5]) * q4 + c[3]) * q4 + c[1];
    odd * q2 + even
}

#[cfg(test)]
mod tests {
    use super::*;
    use approx::assert_relative_eq;

    #[test]
    fn series_and_logarithm_meet_without_a_jump() {
        for q2 in [SERIES_LIMIT * (1.0 - 1e-12), SERIES_LIMIT] {
            let q = f64::sqrt(q2);
            assert_relative_eq!(psi_of_slack(q2), (q.atanh() / q - 1.0) / q2, max_relative = 1e-14);
        }
        assert_relative_eq!(psi_of_taut(TAUT), psi_of_slack(TAUT), max_relative = 1e-15);
    }
}
