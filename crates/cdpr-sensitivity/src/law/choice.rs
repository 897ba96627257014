//! How probable each family is for a sample, among those that are fitted to it.
//!
//! A family of a location a and a scale b has the likelihood of what does not depend on either,
//!
//! ```text
//! m = ∫∫ L(a, b) da db / b                                                           (Ch1)
//! regular laws:  m ≈ L 2π b / (n √c)                                                 (Ch2)
//! uniform law:   m = L r / (n (n - 1)),   L = r^-n,   r = max - min                  (Ch3)
//! P(family | x) = m / Σ m                                                            (Ch4)
//! ```
//!
//! with L and b at the largest likelihood and c the determinant of Fisher's information of (a / b, ln b) of
//! one value. A ratio of two m is the most powerful invariant test of one family against the other: E. L.
//! Lehmann, J. P. Romano, *Testing statistical hypotheses*, 3rd ed. (2005), section 6.3. (Ch2) is Laplace's
//! approximation, (Ch3) is exact. The ends of a uniform law follow the sample more closely than parameters of
//! regular laws do, which AIC and BIC disregard: (Ch3) has n² where (Ch2) has n.
//!
//! The integrals (Ch1) of two values are 1 / (2 |x1 - x2|) for all families: none is preferred before a third
//! value. Lognormal and Weibull laws have a location and a scale in ln x, and their integral of two values is
//! 1 / (2 x1 x2 |ln x1 - ln x2|). Each m is therefore divided by this, with standard deviations for the
//! distances and the geometric mean for the values: J. O. Berger, L. R. Pericchi, J. A. Varshavsky, *Bayes
//! factors and marginal distributions in invariant situations*, Sankhya A 60 (1998).
//!
//! [`crate::law::verdict`] decides by them. `cargo xtask statistics choice` counts how often this is right.

use std::f64::consts::PI;

use crate::law::Law;
use crate::law::likelihood::moments;

/// Logarithm of m, Eq. (Ch1) to (Ch3), over the integral of two values.
///
/// The law is that of the largest likelihood for the sample, which is in ascending order.
pub(crate) fn log_weight(law: &Law, log_likelihood: f64, sorted: &[f64]) -> f64 {
    let n = sorted.len() as f64;
    let regular = |scale: f64, information: f64| (2.0 * PI * scale / (n * information.sqrt())).ln();
    // Determinants of Fisher's information: Johnson, Kotz, Balakrishnan (1994, 1995).
    let gumbel = PI * PI / 6.0;
    let integral = match *law {
        Law::Normal { std, .. } | Law::LogNormal { log_std: std, .. } => regular(std, 2.0),
        Law::Logistic { scale, .. } => regular(scale, (3.0 + PI * PI) / 27.0),
        Law::Laplace { scale, .. } => regular(scale, 1.0),
        Law::Gumbel { scale, .. } => regular(scale, gumbel),
        Law::Weibull { shape, .. } => regular(1.0 / shape, gumbel),
        Law::Uniform { .. } | Law::TruncatedNormal { .. } | Law::Triangular { .. } | Law::Beta { .. } => {
            ((sorted[sorted.len() - 1] - sorted[0]) / (n * (n - 1.0))).ln()
        }
    };
    let two_values = if matches!(law, Law::LogNormal { .. } | Law::Weibull { .. }) {
        let logarithms: Vec<f64> = sorted.iter().map(|x| x.ln()).collect();
        let (mean, std) = moments(&logarithms);
        2.0 * mean + std.ln()
    } else {
        moments(sorted).1.ln()
    };
    log_likelihood + integral + two_values
}
