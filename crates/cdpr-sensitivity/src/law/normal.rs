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
//! Over a narrow interval these are differences of numbers that are almost equal. Its moments are integrals
//! about its middle then, by the rule of Gauss and Legendre with five points, and in so narrow a one that φ
//! changes by 3e-4 at most, F is a parabola.
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
    /// E z and Var z over a narrow interval.
    narrow: Option<[f64; 2]>,
}

impl Truncated {
    pub(crate) fn new(mean: f64, std: f64, min: f64, max: f64) -> Self {
        let (low, high) = ((min - mean) / std, (max - mean) / std);
        let (sign, low, high) = if low > 0.0 { (-1.0, -high, -low) } else { (1.0, low, high) };
        let wide = standard_normal_cdf(high) - standard_normal_cdf(low);
        let (mass, narrow) = match change(low, high) < NARROW {
            true => over_narrow(low, high),
            false => (wide, None),
        };
        Self { mean, std, sign, low, high, mass, narrow }
    }

    /// Middle and width, where the density is a line.
    fn line(&self) -> Option<[f64; 2]> {
        let is_line = change(self.low, self.high) < LINEAR;
        is_line.then_some([0.5 * (self.low + self.high), self.high - self.low])
    }

    pub(crate) fn quantile(&self, u: f64) -> f64 {
        let u = if self.sign > 0.0 { u } else { 1.0 - u };
        if u == 0.0 || u == 1.0 {
            return self.mean + self.sign * self.std * if u == 0.0 { self.low } else { self.high };
        }
        let z = match self.line() {
            Some([middle, width]) => {
                let t = width * (u - 0.5);
                middle + t + 0.5 * middle * (t * t - 0.25 * width * width)
            }
            None => standard_normal_quantile((standard_normal_cdf(self.low) + u * self.mass).min(1.0)),
        };
        self.mean + self.sign * self.std * z
    }

    pub(crate) fn cdf(&self, x: f64) -> f64 {
        let z = self.sign * (x - self.mean) / self.std;
        let p = match self.line() {
            Some([middle, width]) => {
                let t = z - middle;
                (t + 0.5 * width - 0.5 * middle * (t * t - 0.25 * width * width)) / width
            }
            None => (standard_normal_cdf(z) - standard_normal_cdf(self.low)) / self.mass,
        };
        if self.sign > 0.0 { p } else { 1.0 - p }
    }

    /// Mean (No2) in standard units.
    fn standard_mean(&self) -> f64 {
        if let Some([mean, _]) = self.narrow {
            return mean;
        }
        (ln_normal_pdf(self.low).exp() - ln_normal_pdf(self.high).exp()) / self.mass
    }

    pub(crate) fn mean(&self) -> f64 {
        self.mean + self.sign * self.std * self.standard_mean()
    }

    /// Standard deviation from (No3).
    pub(crate) fn std(&self) -> f64 {
        if let Some([_, variance]) = self.narrow {
            return self.std * variance.sqrt();
        }
        let ends = self.low * ln_normal_pdf(self.low).exp() - self.high * ln_normal_pdf(self.high).exp();
        self.std * (1.0 + ends / self.mass - self.standard_mean().powi(2)).max(0.0).sqrt()
    }
}

/// An interval is narrow, and the density in it a line, where its logarithm changes by less.
const NARROW: f64 = 0.1;
const LINEAR: f64 = 3e-4;

/// By how much the logarithm of the density changes over an interval at most, or its width.
fn change(low: f64, high: f64) -> f64 {
    (high - low) * (1.0 + low.abs().max(high.abs()))
}

/// Mass, and E z and Var z, over a narrow interval.
fn over_narrow(low: f64, high: f64) -> (f64, Option<[f64; 2]>) {
    const POINTS: [[f64; 2]; 5] = [
        [-0.906_179_845_938_664, 0.236_926_885_056_189_1],
        [-0.538_469_310_105_683_1, 0.478_628_670_499_366_5],
        [0.0, 0.568_888_888_888_888_9],
        [0.538_469_310_105_683_1, 0.478_628_670_499_366_5],
        [0.906_179_845_938_664, 0.236_926_885_056_189_1],
    ];
    let (middle, half) = (0.5 * (low + high), 0.5 * (high - low));
    let weighed = POINTS.map(|[x, weight]| {
        let t = half * x;
        (t, weight * (-middle * t - 0.5 * t * t).exp())
    });
    let sum = |power: i32| weighed.iter().map(|(t, weight)| t.powi(power) * weight).sum::<f64>();
    let mean = sum(1) / sum(0);
    let variance = weighed.iter().map(|(t, weight)| (t - mean).powi(2) * weight).sum::<f64>() / sum(0);
    (half * sum(0) * ln_normal_pdf(middle).exp(), Some([middle + mean, variance]))
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
