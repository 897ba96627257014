//! The series of ψ(q²) = (atanh(q)/q - 1)/q², which is the part of a cable's sag in its end position.

use cdpr_number::{Lanewise, Number};

/// A cable with q² up to this is taut: ten terms of the series are enough.
pub const TAUT: f64 = 0.02;

/// Halvings of atanh(q) that lead from the greatest slackness of doubles to [`TAUT`].
const MOST_HALVINGS: usize = 12;

/// 1/3, 1/5, 1/7, ...: the coefficients of ψ(q²).
const SERIES: [f64; 10] = {
    let mut series = [0.0; 10];
    let mut k = 0;
    while k < series.len() {
        series[k] = 1.0 / (2 * k + 3) as f64;
        k += 1;
    }
    series
};

/// ψ(q²) for q² up to [`TAUT`], by ten terms, which leave 5e-19.
///
/// Even and odd terms are summed apart, so that neither sum waits for the other.
#[inline(always)]
pub(super) fn psi_of_taut<T: Number>(q2: T) -> T {
    let c = &SERIES;
    let q4 = q2 * q2;
    let even = (((q4 * c[8] + c[6]) * q4 + c[4]) * q4 + c[2]) * q4 + c[0];
    let odd = (((q4 * c[9] + c[7]) * q4 + c[5]) * q4 + c[3]) * q4 + c[1];
    // What is left out and the rounding of the coefficients are at most 6e-17 together.
    (odd * q2 + even).within(1e-16)
}

/// ψ(q²) for any q², from q² and `cosine` = sqrt(1 - q²).
///
/// With `q' = q/(1 + sqrt(1 - q²))` is `atanh(q) = 2 atanh(q')`, and
///
/// ```text
/// q'² = q²/(1 + c)²,    ψ(q²) = (1 + 2 ψ(q'²)/(1 + c)) / (1 + c)²,    c'² = 2 c/(1 + c)     (C34)
/// ```
///
/// in which nothing cancels. Each cable is halved until it is [`TAUT`], by its own q² alone.
#[inline(always)]
pub(super) fn psi_by_halves<T: Lanewise>(q2: T, cosine: T) -> T {
    let (mut q2, mut cosine) = (q2, cosine);
    let mut halvings = [(q2.at_most(TAUT), cosine); MOST_HALVINGS];
    let mut count = 0;
    while count < MOST_HALVINGS && !T::all(q2.at_most(TAUT)) {
        let taut = q2.at_most(TAUT);
        let inverse = (cosine + 1.0).recip();
        halvings[count] = (taut, inverse);
        q2 = T::select(taut, q2, q2 * inverse * inverse);
        cosine = T::select(taut, cosine, (cosine * 2.0 * inverse).sqrt());
        count += 1;
    }
    let mut psi = psi_of_taut(q2);
    psi = T::select(q2.at_most(TAUT), psi, psi.within(f64::INFINITY));
    while count > 0 {
        count -= 1;
        let (taut, inverse) = halvings[count];
        psi = T::select(taut, psi, (psi * 2.0 * inverse + 1.0) * inverse * inverse);
    }
    psi
}

/// Angle of the unit vector (x, z), x >= 0, above the level [rad].
///
/// Three times halved it is below π/16, where the series of ψ holds for a negative square:
///
/// ```text
/// tan(α/2) = z/(1 + x),      tan(α/2) = tan α/(1 + sqrt(1 + tan² α))
/// atan q = q (1 - q² ψ(-q²))                                                            (C35)
/// ```
#[inline(always)]
pub(super) fn elevation<T: Number>([x, z]: [T; 2]) -> T {
    let half = z / (x + 1.0);
    let quarter = half / ((half * half + 1.0).sqrt() + 1.0);
    let eighth = quarter / ((quarter * quarter + 1.0).sqrt() + 1.0);
    let square = -(eighth * eighth);
    eighth * (square * psi_of_taut(square) + 1.0) * 8.0
}

#[cfg(test)]
mod tests {
    use super::*;
    use approx::assert_relative_eq;

    #[test]
    fn halves_agree_with_the_logarithm_up_to_folded_cables() {
        for cosine in [0.95, 0.9, 0.5, 0.1, 1e-2, 1e-3, 1e-6, 1e-20, 1e-100] {
            let q2 = 1.0 - cosine * cosine;
            let q = f64::sqrt(q2);
            // atanh q = ln((1 + q)/c)
            let logarithm = (((1.0 + q) / cosine).ln() / q - 1.0) / q2;
            assert_relative_eq!(psi_by_halves(q2, cosine), logarithm, max_relative = 1e-14);
        }
    }

    #[test]
    fn elevations_are_those_of_the_arctangent() {
        for k in -1000..=1000 {
            let angle = f64::from(k) / 1000.0 * std::f64::consts::FRAC_PI_2;
            let (sin, cos) = angle.sin_cos();
            assert_relative_eq!(elevation([cos, sin]), angle, max_relative = 1e-15);
        }
    }
}
