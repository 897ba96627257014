//! Probability laws of one real variable. An input has a law, and a law can be fitted to an output.
//!
//! Densities and quantiles are those of N. L. Johnson, S. Kotz, N. Balakrishnan, *Continuous univariate
//! distributions*, 2nd ed., vol. 1 (1994) and 2 (1995). The special functions come from `statrs`. Its error
//! function has a relative error of 1e-10, which the normal laws here inherit. The standard deviation of a
//! normal law that is truncated far from its mean loses two or three more digits.

pub mod choice;
pub mod fit;
mod likelihood;
pub(crate) mod normal;
pub mod verdict;

use std::f64::consts::{PI, SQRT_2};

use serde::{Deserialize, Serialize};
use statrs::consts::EULER_MASCHERONI;
use statrs::function::{beta, gamma};

use crate::error::{SensitivityError, require};
use crate::law::normal::{Truncated, ln_normal_pdf, standard_normal_cdf, standard_normal_quantile};

/// A probability law, in the unit of its variable. In JSON: `{"uniform": {"min": -1.0, "max": 1.0}}`.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schemars", derive(schemars::JsonSchema))]
#[serde(rename_all = "snake_case", deny_unknown_fields)]
pub enum Law {
    /// Uniform law: constant density on [min, max].
    Uniform {
        /// Lower end.
        min: f64,
        /// Upper end, above `min`.
        max: f64,
    },
    /// Normal law.
    Normal {
        /// Mean.
        mean: f64,
        /// Standard deviation, positive.
        std: f64,
    },
    /// Normal law restricted to [min, max].
    TruncatedNormal {
        /// Mean before truncation.
        mean: f64,
        /// Standard deviation before truncation, positive.
        std: f64,
        /// Lower end.
        min: f64,
        /// Upper end, above `min`.
        max: f64,
    },
    /// Triangular law: the density rises linearly from `min` to `mode` and falls linearly to `max`.
    Triangular {
        /// Lower end.
        min: f64,
        /// Most probable value, in [min, max].
        mode: f64,
        /// Upper end, above `min`.
        max: f64,
    },
    /// Beta law on [min, max]: density (x - min)^(alpha - 1) (max - x)^(beta - 1) up to a factor.
    Beta {
        /// Shape at the lower end, positive.
        alpha: f64,
        /// Shape at the upper end, positive.
        beta: f64,
        /// Lower end.
        min: f64,
        /// Upper end, above `min`.
        max: f64,
    },
    /// Lognormal law: the logarithm of the positive variable is normal.
    LogNormal {
        /// Mean of the logarithm.
        log_mean: f64,
        /// Standard deviation of the logarithm, positive.
        log_std: f64,
    },
    /// Weibull's law of a positive variable: F = 1 - exp(-(x / scale)^shape).
    Weibull {
        /// Shape, positive.
        shape: f64,
        /// Scale, positive.
        scale: f64,
    },
    /// Logistic law: F = 1 / (1 + exp(-(x - location) / scale)).
    Logistic {
        /// Mean.
        location: f64,
        /// Scale, positive.
        scale: f64,
    },
    /// Gumbel's law of the largest value: F = exp(-exp(-(x - location) / scale)).
    Gumbel {
        /// Mode.
        location: f64,
        /// Scale, positive.
        scale: f64,
    },
    /// Laplace's two-sided exponential law: density exp(-|x - location| / scale) / (2 scale).
    Laplace {
        /// Median.
        location: f64,
        /// Mean absolute deviation, positive.
        scale: f64,
    },
}

/// Interval of the values that a law allows.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Support {
    /// Lower end, which may be -∞.
    pub min: f64,
    /// Upper end, which may be ∞.
    pub max: f64,
}

impl Support {
    /// Whether both ends are finite.
    #[must_use]
    pub fn is_bounded(&self) -> bool {
        (self.max - self.min).is_finite()
    }
}

impl Law {
    /// Checks the parameters. The other methods expect a valid law.
    ///
    /// # Errors
    /// [`SensitivityError::InvalidParameter`] with the first parameter that is not finite, not positive
    /// although it has to be, or out of order.
    pub fn validate(&self) -> Result<(), SensitivityError> {
        let finite = |field, value: f64| require(value.is_finite(), field, value, "a finite number");
        let positive = |field, value: f64| {
            require(value > 0.0 && value.is_finite(), field, value, "a positive finite number")
        };
        let ordered = |min: f64, max: f64| {
            finite("min", min)?;
            finite("max", max)?;
            require(
                (max - min).is_finite() && min < max,
                "max",
                max,
                "a number above min, at a finite distance",
            )
        };
        match *self {
            Self::Uniform { min, max } => ordered(min, max),
            Self::Normal { mean, std } => finite("mean", mean).and(positive("std", std)),
            Self::TruncatedNormal { mean, std, min, max } => {
                finite("mean", mean)?;
                positive("std", std)?;
                ordered(min, max)?;
                let mass = Truncated::new(mean, std, min, max).mass;
                require(
                    mass > 0.0,
                    "std",
                    std,
                    "a deviation that leaves some probability between min and max",
                )
            }
            Self::Triangular { min, mode, max } => {
                ordered(min, max)?;
                require((min..=max).contains(&mode), "mode", mode, "a number from min to max")
            }
            Self::Beta { alpha, beta, min, max } => {
                positive("alpha", alpha).and(positive("beta", beta)).and(ordered(min, max))
            }
            Self::LogNormal { log_mean, log_std } => {
                finite("log_mean", log_mean).and(positive("log_std", log_std))
            }
            Self::Weibull { shape, scale } => positive("shape", shape).and(positive("scale", scale)),
            Self::Logistic { location, scale }
            | Self::Gumbel { location, scale }
            | Self::Laplace { location, scale } => finite("location", location).and(positive("scale", scale)),
        }
    }

    /// Support of the law. An end that does not exist is infinite.
    #[must_use]
    pub fn support(&self) -> Support {
        let (min, max) = match *self {
            Self::Uniform { min, max }
            | Self::TruncatedNormal { min, max, .. }
            | Self::Triangular { min, max, .. }
            | Self::Beta { min, max, .. } => (min, max),
            Self::LogNormal { .. } | Self::Weibull { .. } => (0.0, f64::INFINITY),
            Self::Normal { .. } | Self::Logistic { .. } | Self::Gumbel { .. } | Self::Laplace { .. } => {
                (f64::NEG_INFINITY, f64::INFINITY)
            }
        };
        Support { min, max }
    }

    /// Middle of the domain: halfway between the ends of a bounded support, otherwise the median.
    #[must_use]
    pub fn middle(&self) -> f64 {
        let support = self.support();
        let Support { min, max } = support;
        if support.is_bounded() { between(min, max, 0.5) } else { self.quantile(0.5) }
    }

    /// Quantile: the value that is not exceeded with probability `u`.
    ///
    /// At u = 0 and u = 1 it is an end of the support, which may be infinite. For `u` outside [0, 1] it is
    /// NaN.
    #[must_use]
    #[inline]
    pub fn quantile(&self, u: f64) -> f64 {
        if !(0.0..=1.0).contains(&u) {
            return f64::NAN;
        }
        match *self {
            Self::Uniform { min, max } => between(min, max, u),
            _ => self.nonuniform_quantile(u),
        }
    }

    /// The quantile for `u` in [0, 1], in a function of its own: uniform laws, which most studies have, need
    /// no call.
    fn nonuniform_quantile(&self, u: f64) -> f64 {
        match *self {
            Self::Uniform { min, max } => between(min, max, u),
            Self::Normal { mean, std } => mean + std * standard_normal_quantile(u),
            Self::TruncatedNormal { mean, std, min, max } => {
                Truncated::new(mean, std, min, max).quantile(u).clamp(min, max)
            }
            Self::Triangular { min, mode, max } => {
                let range = max - min;
                if u * range < mode - min {
                    min + (u * range * (mode - min)).sqrt()
                } else {
                    max - ((1.0 - u) * range * (max - mode)).sqrt()
                }
            }
            Self::Beta { alpha, beta, min, max } => {
                if alpha > 0.0 && beta > 0.0 {
                    between(min, max, beta::inv_beta_reg(alpha, beta, u))
                } else {
                    f64::NAN
                }
            }
            Self::LogNormal { log_mean, log_std } => (log_mean + log_std * standard_normal_quantile(u)).exp(),
            Self::Weibull { shape, scale } => scale * (-(-u).ln_1p()).powf(1.0 / shape),
            Self::Logistic { location, scale } => location + scale * (u.ln() - (-u).ln_1p()),
            Self::Gumbel { location, scale } => location - scale * (-u.ln()).ln(),
            Self::Laplace { location, scale } => {
                let tail = u.min(1.0 - u);
                location + scale * (2.0 * tail).ln() * if u < 0.5 { 1.0 } else { -1.0 }
            }
        }
    }

    /// Distribution function: the probability of a value up to `x`.
    #[must_use]
    pub fn cdf(&self, x: f64) -> f64 {
        match *self {
            Self::Uniform { min, max } => ((x - min) / (max - min)).clamp(0.0, 1.0),
            Self::Normal { mean, std } => standard_normal_cdf((x - mean) / std),
            Self::TruncatedNormal { mean, std, min, max } => {
                Truncated::new(mean, std, min, max).cdf(x.clamp(min, max)).clamp(0.0, 1.0)
            }
            Self::Triangular { min, mode, max } => {
                let x = x.clamp(min, max);
                if x < mode {
                    (x - min) * (x - min) / ((max - min) * (mode - min))
                } else {
                    1.0 - (max - x) * (max - x) / ((max - min) * (max - mode)).max(f64::MIN_POSITIVE)
                }
            }
            Self::Beta { alpha, beta, min, max } => {
                beta::checked_beta_reg(alpha, beta, ((x - min) / (max - min)).clamp(0.0, 1.0))
                    .unwrap_or(f64::NAN)
            }
            Self::LogNormal { log_mean, log_std } => {
                standard_normal_cdf((x.max(0.0).ln() - log_mean) / log_std)
            }
            Self::Weibull { shape, scale } => -(-(x.max(0.0) / scale).powf(shape)).exp_m1(),
            Self::Logistic { location, scale } => 1.0 / (1.0 + ((location - x) / scale).exp()),
            Self::Gumbel { location, scale } => (-((location - x) / scale).exp()).exp(),
            Self::Laplace { location, scale } => {
                let tail = 0.5 * (-((x - location) / scale).abs()).exp();
                if x < location { tail } else { 1.0 - tail }
            }
        }
    }

    /// Natural logarithm of the density at `x`. It is -∞ outside the support.
    #[must_use]
    pub fn ln_pdf(&self, x: f64) -> f64 {
        let Support { min, max } = self.support();
        if x < min || x > max {
            return f64::NEG_INFINITY;
        }
        match *self {
            Self::Uniform { min, max } => -(max - min).ln(),
            Self::Normal { mean, std } => ln_normal_pdf((x - mean) / std) - std.ln(),
            Self::TruncatedNormal { mean, std, min, max } => {
                ln_normal_pdf((x - mean) / std) - std.ln() - Truncated::new(mean, std, min, max).mass.ln()
            }
            Self::Triangular { min, mode, max } => {
                let height = if x < mode {
                    (x - min) / (mode - min)
                } else if max > mode {
                    (max - x) / (max - mode)
                } else {
                    1.0
                };
                (2.0 * height / (max - min)).ln()
            }
            Self::Beta { alpha, beta, min, max } => {
                let range = max - min;
                let (y, z) = ((x - min) / range, (max - x) / range);
                power_term(alpha - 1.0, y) + power_term(beta - 1.0, z)
                    - beta::checked_ln_beta(alpha, beta).unwrap_or(f64::NAN)
                    - range.ln()
            }
            Self::LogNormal { .. } if x == 0.0 => f64::NEG_INFINITY,
            Self::LogNormal { log_mean, log_std } => {
                ln_normal_pdf((x.ln() - log_mean) / log_std) - (x * log_std).ln()
            }
            Self::Weibull { shape, scale } => {
                let z = x / scale;
                (shape / scale).ln() + power_term(shape - 1.0, z) - z.powf(shape)
            }
            Self::Logistic { location, scale } => {
                let z = ((x - location) / scale).abs();
                -z - 2.0 * (-z).exp().ln_1p() - scale.ln()
            }
            Self::Gumbel { location, scale } => {
                let z = (x - location) / scale;
                -z - (-z).exp() - scale.ln()
            }
            Self::Laplace { location, scale } => -((x - location) / scale).abs() - (2.0 * scale).ln(),
        }
    }

    /// Mean.
    #[must_use]
    pub fn mean(&self) -> f64 {
        match *self {
            Self::Uniform { .. } => self.middle(),
            Self::Normal { mean, .. } => mean,
            Self::TruncatedNormal { mean, std, min, max } => {
                Truncated::new(mean, std, min, max).mean().clamp(min, max)
            }
            Self::Triangular { min, mode, max } => (min + mode + max) / 3.0,
            Self::Beta { alpha, beta, min, max } => min + (max - min) * alpha / (alpha + beta),
            Self::LogNormal { log_mean, log_std } => (log_mean + 0.5 * log_std * log_std).exp(),
            Self::Weibull { shape, scale } => scale * gamma::gamma(1.0 + 1.0 / shape),
            Self::Gumbel { location, scale } => location + EULER_MASCHERONI * scale,
            Self::Logistic { location, .. } | Self::Laplace { location, .. } => location,
        }
    }

    /// Standard deviation.
    #[must_use]
    pub fn std(&self) -> f64 {
        match *self {
            Self::Uniform { min, max } => (max - min) / 12.0_f64.sqrt(),
            Self::Normal { std, .. } => std,
            Self::TruncatedNormal { mean, std, min, max } => Truncated::new(mean, std, min, max).std(),
            Self::Triangular { min, mode, max } => {
                let (a, b) = (mode - min, max - mode);
                ((a * a + a * b + b * b) / 18.0).sqrt()
            }
            Self::Beta { alpha, beta, min, max } => {
                let sum = alpha + beta;
                (max - min) * (alpha * beta / (sum + 1.0)).sqrt() / sum
            }
            Self::LogNormal { log_std, .. } => self.mean() * (log_std * log_std).exp_m1().sqrt(),
            Self::Weibull { shape, scale } => {
                let mean = gamma::gamma(1.0 + 1.0 / shape);
                scale * (gamma::gamma(1.0 + 2.0 / shape) - mean * mean).max(0.0).sqrt()
            }
            Self::Logistic { scale, .. } => scale * PI / 3.0_f64.sqrt(),
            Self::Gumbel { scale, .. } => scale * PI / 6.0_f64.sqrt(),
            Self::Laplace { scale, .. } => scale * SQRT_2,
        }
    }
}

/// The point at a share of the way from one end to the other.
fn between(min: f64, max: f64, share: f64) -> f64 {
    min + share * (max - min)
}

/// Computes p ln x, with the limit 0 for p = 0.
fn power_term(p: f64, x: f64) -> f64 {
    if p == 0.0 { 0.0 } else { p * x.ln() }
}
