//! The standard normal law, and the normal law truncated to an interval.
//!
//! With φ and Φ the standard normal density and distribution function, and low and high the ends of the
//! interval in standard units,
//!
//! ```text
//! mass = Φ(high) - Φ(low),   F⁻¹(u) = Φ⁻¹(Φ(low) + u mass)                (No1)
//! E z = (φ(low) - φ(high)) / mass                                         (No2)
//! Var z = 1 + (low φ(low) - high φ(high)) / mass - (E z)²                 (No3)
//! ```
//!
//! N. L. Johnson, S. Kotz, N. Balakrishnan, *Continuous univariate distributions*, vol. 1 (1994), section
//! 13.10.1.

use std::f64::consts::{PI, SQRT_2};

use statrs::function::erf;

/// Truncated normal law in standard units.
///
/// An interval above the mean is mirrored (`sign` = -1), so that its probabilities are differences of small
/// numbers instead of numbers close to 1.
pub(crate) struct Truncated {
    mean: f64,
    std: f64,
    sign: f64,
    low: f64,
    high: f64,
    pub(crate) mass: f64,
}

impl Truncated {
    pub(crate) fn new(mean: f64, std: f64, min: f64, max: f64) -> Self {
        let (low, high) = ((min - mean) / std, (max - mean) / std);
        let (sign, low, high) = if low > 0.0 { (-1.0, -high, -low) } else { (1.0, low, high) };
        Self { mean, std, sign, low, high, mass: standard_normal_cdf(high) - standard_normal_cdf(low) }
    }

    pub(crate) fn quantile(&self, u: f64) -> f64 {
        let u = if self.sign > 0.0 { u } else { 1.0 - u };
        if u == 0.0 || u == 1.0 {
            return self.mean + self.sign * self.std * if u == 0.0 { self.low } else { self.high };
        }
        let z = standard_normal_quantile((standard_normal_cdf(self.low) + u * self.mass).min(1.0));
        self.mean + self.sign * self.std * z
    }

    pub(crate) fn cdf(&self, x: f64) -> f64 {
        let z = self.sign * (x - self.mean) / self.std;
        let p = (standard_normal_cdf(z) - standard_normal_cdf(self.low)) / self.mass;
        if self.sign > 0.0 { p } else { 1.0 - p }
    }

    /// Mean (No2) in standard units.
    fn standard_mean(&self) -> f64 {
        (ln_normal_pdf(self.low).exp() - ln_normal_pdf(self.high).exp()) / self.mass
    }

    pub(crate) fn mean(&self) -> f64 {
        self.mean + self.sign * self.std * self.standard_mean()
    }

    /// Standard deviation from (No3).
    pub(crate) fn std(&self) -> f64 {
        let ends = self.low * ln_normal_pdf(self.low).exp() - self.high * ln_normal_pdf(self.high).exp();
        self.std * (1.0 + ends / self.mass - self.standard_mean().powi(2)).max(0.0).sqrt()
    }
}

pub(crate) fn standard_normal_cdf(z: f64) -> f64 {
    0.5 * erf::erfc(-z / SQRT_2)
}

pub(crate) fn standard_normal_quantile(u: f64) -> f64 {
    -SQRT_2 * erf::erfc_inv(2.0 * u)
}

pub(crate) fn ln_normal_pdf(z: f64) -> f64 {
    -0.5 * z * z - 0.5 * (2.0 * PI).ln()
}
