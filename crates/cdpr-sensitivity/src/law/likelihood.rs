//! Maximum-likelihood estimates of laws of a location and a scale.
//!
//! Let z be the standardized values and t = a z - b, with a = 1 / scale and b = location / scale, and let -h
//! be the logarithm of the standard density. Then
//!
//! ```text
//! ln L = n ln a - Σ h(t)                                                 (Li1)
//! ∂ ln L / ∂a = n / a - Σ z h'(t),    ∂ ln L / ∂b = Σ h'(t)              (Li2)
//! logistic:  h' = tanh(t / 2),        h'' = (1 - h'²) / 2                (Li3)
//! Gumbel:    h' = 1 - exp(-t),        h'' = exp(-t)                      (Li4)
//! ```
//!
//! Where h is convex, (Li1) is concave in (a, b). It has one maximum, and Newton's method finds it (J.
//! Burridge, *A note on maximum likelihood estimation for regression models using grouped data*, 1981; J. W.
//! Pratt, *Concavity of the log likelihood*, 1981). The estimates of uniform, normal and Laplace laws have
//! closed forms. The logarithm of a lognormal variable is normal, and the negative logarithm of a Weibull
//! variable follows Gumbel's law.

use std::f64::consts::PI;

use statrs::consts::EULER_MASCHERONI;

use crate::error::SensitivityError;
use crate::family::Family;
use crate::law::Law;
use crate::sample::summary::Spread;

/// Estimates the law of the largest likelihood in `family`.
///
/// `sorted` holds at least two different finite values in ascending order. For the lognormal and Weibull
/// families they are positive.
pub(crate) fn estimate(family: Family, sorted: &[f64]) -> Result<Law, SensitivityError> {
    let n = sorted.len();
    match family {
        Family::Uniform => Ok(Law::Uniform { min: sorted[0], max: sorted[n - 1] }),
        Family::Normal => {
            let (mean, std) = moments(sorted);
            Ok(Law::Normal { mean, std })
        }
        Family::Laplace => {
            let location = 0.5 * (sorted[(n - 1) / 2] + sorted[n / 2]);
            let scale = sorted.iter().map(|x| (x - location).abs()).sum::<f64>() / n as f64;
            Ok(Law::Laplace { location, scale })
        }
        Family::Logistic => {
            let (location, scale) = concave(family, sorted, [PI / 3.0_f64.sqrt(), 0.0], |t| {
                let e = (-t.abs()).exp();
                let slope = ((1.0 - e) / (1.0 + e)).copysign(t);
                (slope, 0.5 * (1.0 - slope * slope))
            })?;
            Ok(Law::Logistic { location, scale })
        }
        Family::Gumbel => {
            let (location, scale) = concave(family, sorted, [PI / 6.0_f64.sqrt(), -EULER_MASCHERONI], |t| {
                let e = (-t).exp();
                (1.0 - e, e)
            })?;
            Ok(Law::Gumbel { location, scale })
        }
        Family::LogNormal => {
            let logarithms: Vec<f64> = sorted.iter().map(|x| x.ln()).collect();
            let (log_mean, log_std) = moments(&logarithms);
            Ok(Law::LogNormal { log_mean, log_std })
        }
        Family::Weibull => {
            let logarithms: Vec<f64> = sorted.iter().rev().map(|x| -x.ln()).collect();
            match estimate(Family::Gumbel, &logarithms)? {
                Law::Gumbel { location, scale } => {
                    Ok(Law::Weibull { shape: 1.0 / scale, scale: (-location).exp() })
                }
                other => Ok(other),
            }
        }
    }
}

/// Mean and standard deviation (with n), which are the estimates of a normal law.
pub(crate) fn moments(values: &[f64]) -> (f64, f64) {
    let spread = Spread::of(values);
    (spread.mean, (spread.squares / values.len() as f64).sqrt())
}

const ITERATIONS: usize = 200;
/// Relative length of the last Newton step. Convergence is quadratic: the error after it is about its square.
const TOLERANCE: f64 = 1e-7;

/// Location and scale at the maximum of (Li1) by Newton's method.
///
/// `moments_match` are the (a, b) of the law of mean 0 and deviation 1, from which the iteration starts. A
/// step is halved while it makes a negative, or while the slope at its end is below -0.9 times that at its
/// beginning: it then has overshot the maximum of the concave function.
fn concave(
    family: Family,
    sorted: &[f64],
    moments_match: [f64; 2],
    slope_and_curvature: impl Fn(f64) -> (f64, f64),
) -> Result<(f64, f64), SensitivityError> {
    let (mean, std) = moments(sorted);
    let z: Vec<f64> = sorted.iter().map(|x| (x - mean) / std).collect();
    let n = z.len() as f64;
    // Gradient (Li2) and negative Hessian of (Li1) in one pass.
    let derivatives = |a: f64, b: f64| {
        let (mut za, mut zb, mut haa, mut hab, mut hbb) = (0.0, 0.0, 0.0, 0.0, 0.0);
        for &z in &z {
            let (slope, curvature) = slope_and_curvature(a * z - b);
            za += z * slope;
            zb += slope;
            haa += z * z * curvature;
            hab -= z * curvature;
            hbb += curvature;
        }
        ([n / a - za, zb], [n / (a * a) + haa, hab, hbb])
    };
    // a is limited so that no exponential overflows at the start.
    let reach = z[0].abs().max(z[z.len() - 1].abs());
    let [mut a, mut b] = moments_match;
    a = a.min(20.0 / reach);
    let (mut gradient, mut hessian) = derivatives(a, b);
    for iteration in 1..=ITERATIONS {
        let [haa, hab, hbb] = hessian;
        let determinant = haa * hbb - hab * hab;
        let da = (hbb * gradient[0] - hab * gradient[1]) / determinant;
        let db = (haa * gradient[1] - hab * gradient[0]) / determinant;
        if da.abs() <= TOLERANCE * a && db.abs() <= TOLERANCE * (1.0 + b.abs()) {
            return Ok((mean + std * (b + db) / (a + da), std / (a + da)));
        }
        let rise = gradient[0] * da + gradient[1] * db;
        let mut length = 1.0;
        loop {
            let (next_a, next_b) = (a + length * da, b + length * db);
            if next_a > 0.0 {
                let (next_gradient, next_hessian) = derivatives(next_a, next_b);
                if next_gradient[0] * da + next_gradient[1] * db >= -0.9 * rise {
                    (a, b, gradient, hessian) = (next_a, next_b, next_gradient, next_hessian);
                    break;
                }
            }
            length *= 0.5;
            if length <= f64::EPSILON {
                return Err(SensitivityError::NotConverged { family, iterations: iteration });
            }
        }
    }
    Err(SensitivityError::NotConverged { family, iterations: ITERATIONS })
}
