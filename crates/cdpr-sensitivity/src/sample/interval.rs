//! Estimates with their confidence intervals.
//!
//! ```text
//! mean ± t_(n-1, (1 + level) / 2) s / √n                                  (CI1)
//! estimate ± t_(n-1, (1 + level) / 2) s* √(n / (n - 1))                    (CI2)
//! ```
//!
//! (CI1) is Student's interval of the mean of n independent values. (CI2) is its counterpart for an estimate
//! that is not a mean, where s* is the deviation of the estimate over bootstrap resamples of n independent
//! units: B. Efron, R. J. Tibshirani, *An introduction to the bootstrap* (1993), section 12.2 and, for the
//! factor √(n / (n - 1)), section 5.3. For a mean the two agree up to the noise of resampling.
//!
//! The law of (mean - μ)/s is skewed where that of the values is. With their skewness γ and Student's t,
//!
//! ```text
//! mean - s h(t) <= μ <= mean - s h(-t),   h(t) = (3/γ) [(1 + γ (t/√n - γ/(6 n)))^(1/3) - 1]      (CI5)
//! ```
//!
//! is the interval by the inverse of a cubic that removes the skewness: P. Hall, *On the removal of skewness
//! by transformation*, J. R. Stat. Soc. B 54 (1992).
//!
//! A positive estimate whose law has a long upper tail, such as a mean of squares, has Student's interval of
//! its logarithm: with its deviation s*,
//!
//! ```text
//! estimate exp(± t_(f, (1 + level) / 2) s* / estimate)                    (CI6)
//! ```
//!
//! Its upper end is above that of (CI2) for the same s*.
//!
//! A quotient of two means, such as the part θ of a variance that an input leaves, has a deviation that
//! depends on its value. Its interval has the values that a test with their own deviation s*(θ0) does not
//! refuse,
//!
//! ```text
//! |θ - θ0| <= t_(f, (1 + level) / 2) s*(θ0),   θ0 >= 0                    (CI7)
//! ```
//!
//! E. C. Fieller, *Some problems in interval estimation*, J. R. Stat. Soc. B 16 (1954). Where few rows decide
//! the variance, no large θ0 is refused. The interval of `1 - θ` also has those of the first order,
//! `1 - θ exp(h / θ)` to `1 - θ + h` with `h = t s*(θ)`, and ends at -1.
//!
//! If k of n independent values lie below a limit, with B⁻¹ the inverse of the beta distribution function
//! and `b_q` the inverse of the binomial one,
//!
//! ```text
//! B⁻¹((1 - level)/2; k, n - k + 1) <= share <= B⁻¹((1 + level)/2; k + 1, n - k)       (CI3)
//! x_(l) <= quantile q <= x_(u),    l = b_q((1 - level)/2),   u = b_q((1 + level)/2) + 1     (CI4)
//! ```
//!
//! (CI3): C. J. Clopper, E. S. Pearson, *The use of confidence or fiducial limits*, Biometrika 26 (1934).
//! (CI4): G. J. Hahn, W. Q. Meeker, *Statistical intervals* (1991), section 5.2. Both hold for any law.

use serde::{Deserialize, Serialize};
use statrs::distribution::{Binomial, ContinuousCDF, DiscreteCDF, StudentsT};
use statrs::function::beta::inv_beta_reg;

use crate::error::{SensitivityError, check_level, check_range, require};
use crate::sample::summary::Spread;

/// An estimate and its confidence interval.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schemars", derive(schemars::JsonSchema))]
pub struct Estimate {
    /// Estimate.
    pub value: f64,
    /// Lower end of the interval.
    pub low: f64,
    /// Upper end of the interval.
    pub high: f64,
}

/// Whether a value is at least as large as its interval is wide.
#[must_use]
pub fn is_resolved(value: f64, [low, high]: [f64; 2]) -> bool {
    high - low <= value.abs()
}

impl Estimate {
    /// Width of the interval.
    #[must_use]
    pub fn width(&self) -> f64 {
        self.high - self.low
    }

    /// A share in percent with its interval, unless this is wider than the share.
    #[must_use]
    pub fn percent(&self) -> String {
        let [value, low, high] =
            [self.value, self.low.max(0.0), self.high.min(1.0)].map(|share| 100.0 * share);
        match is_resolved(self.value, [self.low, self.high]) {
            true => format!("{value:.1} ({low:.1} to {high:.1})"),
            false => "not resolved".to_owned(),
        }
    }

    /// Mean of at least two values with its interval, Eq. (CI1).
    pub(crate) fn of_mean(values: &[f64], level: f64) -> Result<Self, SensitivityError> {
        check_range("independent values", values.len() as u64, 2, u64::MAX)?;
        let spread = Spread::of(values);
        Ok(Self::around(spread.mean, student(values.len() as f64 - 1.0, level)? * spread.standard_error()))
    }

    /// Mean of at least two values of a skewed law with its interval, Eq. (CI5).
    pub(crate) fn of_skewed_mean(values: &[f64], level: f64) -> Result<Self, SensitivityError> {
        /// A skewness at which both intervals agree to rounding.
        const SKEWED: f64 = 1e-6;
        let plain = Self::of_mean(values, level)?;
        let n = values.len() as f64;
        let (mean, std) = (plain.value, Spread::of(values).std());
        let cubes: f64 = values.iter().map(|value| ((value - mean) / std).powi(3)).sum();
        // Two values have no skewness.
        let skewness = cubes * n / ((n - 1.0) * (n - 2.0));
        if !(skewness.is_finite() && skewness.abs() > SKEWED) {
            return Ok(plain);
        }
        let t = student(n - 1.0, level)? / n.sqrt();
        let h = |t: f64| 3.0 / skewness * ((1.0 + skewness * (t - skewness / (6.0 * n))).cbrt() - 1.0);
        Ok(Self { value: mean, low: mean - std * h(t), high: mean - std * h(-t) })
    }

    /// Estimate with its interval, Eq. (CI2), from at least two units and two resamples. `variance` is added
    /// to that of the resamples.
    pub(crate) fn of_resamples(
        value: f64,
        resampled: &[f64],
        variance: f64,
        units: usize,
        level: f64,
    ) -> Result<Self, SensitivityError> {
        let n = units as f64;
        let variance = Spread::of(resampled).variance() * n / (n - 1.0) + variance;
        check_range("independent values", units as u64, 2, u64::MAX)?;
        Self::of_variance(value, variance, n - 1.0, level)
    }

    /// Estimate of a known variance with Student's interval of so many degrees of freedom.
    pub(crate) fn of_variance(
        value: f64,
        variance: f64,
        freedoms: f64,
        level: f64,
    ) -> Result<Self, SensitivityError> {
        Ok(Self::around(value, student(freedoms, level)? * variance.sqrt()))
    }

    /// Estimate of a known variance with Student's interval of its logarithm, Eq. (CI6). One that is not
    /// positive, which only noise makes so, has no logarithm: its upper end is that of zero.
    pub(crate) fn of_positive(
        value: f64,
        variance: f64,
        freedoms: f64,
        level: f64,
    ) -> Result<Self, SensitivityError> {
        let half = student(freedoms, level)? * variance.sqrt();
        if value <= 0.0 {
            return Ok(Self { value, low: value - half, high: value.max(0.0) + half });
        }
        let factor = (half / value).exp();
        Ok(Self { value, low: value / factor, high: value * factor })
    }

    /// The share `1 - θ` of an estimated θ >= 0, with its interval (CI7) from the deviation s* as a function
    /// of the true θ.
    pub(crate) fn of_rest(
        theta: f64,
        deviation: impl Fn(f64) -> f64,
        freedoms: f64,
        level: f64,
    ) -> Result<Self, SensitivityError> {
        /// Largest θ that is looked at.
        const MOST: f64 = 2.0;
        let t = student(freedoms, level)?;
        let is_held = |other: f64| (theta - other).abs() <= t * deviation(other);
        let end = |mut outside: f64| {
            let mut inside = theta;
            if theta == 0.0 {
                return theta;
            }
            if is_held(outside) {
                return outside;
            }
            for _ in 0..60 {
                let middle = 0.5 * (inside + outside);
                *(if is_held(middle) { &mut inside } else { &mut outside }) = middle;
            }
            inside
        };
        let half = t * deviation(theta);
        let most = theta.max(MOST);
        let first_order = if theta > 0.0 { theta * (half / theta).exp() } else { half };
        Ok(Self {
            value: 1.0 - theta,
            low: 1.0 - end(most).max(first_order).min(most),
            high: 1.0 - end(0.0).min(theta - half),
        })
    }

    /// Whether an interval of a share holds all that a share can be.
    pub(crate) fn says_nothing(&self) -> bool {
        self.low <= 0.0 && self.high >= 1.0
    }

    /// The same estimate with an interval that is no shorter than `half` on either side.
    pub(crate) fn at_least(self, half: f64) -> Self {
        Self {
            value: self.value,
            low: self.low.min(self.value - half),
            high: self.high.max(self.value + half),
        }
    }

    /// Share of a population, estimated from `count` of `n` independent draws, with its interval (CI3).
    ///
    /// # Errors
    /// [`SensitivityError::OutOfRange`] for no draw or a count above their number,
    /// [`SensitivityError::InvalidParameter`] for a level outside (0, 1).
    pub fn of_share(count: usize, n: usize, level: f64) -> Result<Self, SensitivityError> {
        check_range("draws", n as u64, 1, u64::MAX)?;
        check_range("count", count as u64, 0, n as u64)?;
        check_level(level)?;
        let (k, rest, tail) = (count as f64, (n - count) as f64, 0.5 * (1.0 - level));
        let low = if count == 0 { 0.0 } else { inv_beta_reg(k, rest + 1.0, tail) };
        let high = if count == n { 1.0 } else { inv_beta_reg(k + 1.0, rest, 1.0 - tail) };
        Ok(Self { value: k / n as f64, low, high })
    }

    /// Quantile `q` of the law of independent values, which are in ascending order, with its interval (CI4).
    ///
    /// An end that the number of values does not determine is infinite.
    ///
    /// # Errors
    /// [`SensitivityError::OutOfRange`] for no value, [`SensitivityError::InvalidParameter`] for a `q` or a
    /// level outside (0, 1).
    pub fn of_quantile(ascending: &[f64], q: f64, level: f64) -> Result<Self, SensitivityError> {
        let n = ascending.len();
        check_range("values", n as u64, 1, u64::MAX)?;
        require(q > 0.0 && q < 1.0, "q", q, "a number between 0 and 1")?;
        check_level(level)?;
        let wrong =
            |_| SensitivityError::InvalidParameter { field: "q", value: q, expected: "a probability" };
        let ranks = Binomial::new(q, n as u64).map_err(wrong)?;
        // Ranks start at 1.
        let of_rank = |rank: u64, beyond: f64| match rank.checked_sub(1).map(|k| k as usize) {
            Some(k) if k < n => ascending[k],
            _ => beyond,
        };
        let tail = 0.5 * (1.0 - level);
        Ok(Self {
            value: ascending[((q * n as f64).ceil() as usize).clamp(1, n) - 1],
            low: of_rank(ranks.inverse_cdf(tail), f64::NEG_INFINITY),
            high: of_rank(ranks.inverse_cdf(1.0 - tail) + 1, f64::INFINITY),
        })
    }

    fn around(value: f64, half: f64) -> Self {
        Self { value, low: value - half, high: value + half }
    }
}

/// Number of equal sizes whose mean scatters as that of these does: (Σ |x|)² / Σ x². Where few of them decide
/// the mean, the next one may be larger than all before.
pub(crate) fn effective(sizes: &[f64]) -> f64 {
    let (sum, squares): (f64, f64) = (sizes.iter().sum(), sizes.iter().map(|size| size * size).sum());
    // Zeros alone are equal: the mean rests on all of them.
    if squares == 0.0 { sizes.len() as f64 } else { sum * sum / squares }
}

/// Student's factor of so many degrees of freedom.
fn student(freedoms: f64, level: f64) -> Result<f64, SensitivityError> {
    let wrong = |_| SensitivityError::InvalidParameter {
        field: "level",
        value: level,
        expected: "a confidence level",
    };
    Ok(StudentsT::new(0.0, 1.0, freedoms).map_err(wrong)?.inverse_cdf(0.5 * (1.0 + level)))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::sample::random::{stream, uniform};

    #[test]
    fn the_interval_of_a_share_is_that_of_clopper_and_pearson() {
        // Hahn and Meeker's example, section 6.2: 20 of 1000, two-sided 95 %.
        let share = Estimate::of_share(20, 1000, 0.95).unwrap();
        assert!((share.low - 0.0123).abs() < 5e-5 && (share.high - 0.0307).abs() < 5e-5, "{share:?}");
        let zero = Estimate::of_share(0, 10, 0.95).unwrap();
        assert!(zero.low == 0.0 && (zero.high - (1.0 - 0.025_f64.powf(0.1))).abs() < 1e-9, "{zero:?}");
        assert_eq!(Estimate::of_share(10, 10, 0.95).unwrap().high, 1.0);
        assert!(Estimate::of_share(11, 10, 0.95).is_err() && Estimate::of_share(1, 10, 1.0).is_err());
    }

    #[test]
    fn the_interval_of_a_quantile_holds_it_as_often_as_its_level() {
        let mut held = 0;
        for seed in 0..1000 {
            let mut generator = stream(seed, 0);
            let mut values: Vec<f64> = (0..200).map(|_| uniform(&mut generator)).collect();
            values.sort_by(f64::total_cmp);
            let quantile = Estimate::of_quantile(&values, 0.9, 0.95).unwrap();
            held += usize::from(quantile.low <= 0.9 && 0.9 <= quantile.high);
        }
        // At least 950 expected; 928 is three standard deviations below.
        assert!(held >= 929, "{held} of 1000");
    }

    #[test]
    fn the_interval_of_a_skewed_mean_holds_it_as_often_as_its_level() {
        // Exponential values, of skewness 2.
        let (mut held, mut plain) = (0, 0);
        for seed in 0..2000 {
            let mut generator = stream(seed, 0);
            let values: Vec<f64> = (0..32).map(|_| -uniform(&mut generator).ln()).collect();
            let holds = |estimate: Estimate| usize::from(estimate.low <= 1.0 && 1.0 <= estimate.high);
            held += holds(Estimate::of_skewed_mean(&values, 0.95).unwrap());
            plain += holds(Estimate::of_mean(&values, 0.95).unwrap());
        }
        // 1900 expected; 1870 is three standard deviations below. Student's hold less often.
        assert!(held > 1870 && plain < held, "{held} and {plain} of 2000");
        let same = Estimate::of_skewed_mean(&[2.0, 2.0, 2.0], 0.95).unwrap();
        assert_eq!((same.low, same.high), (2.0, 2.0));
        let two = Estimate::of_skewed_mean(&[1.0, 2.0], 0.95).unwrap();
        assert_eq!(two, Estimate::of_mean(&[1.0, 2.0], 0.95).unwrap());
    }

    #[test]
    fn few_values_leave_the_interval_of_an_outer_quantile_open() {
        let quantile = Estimate::of_quantile(&[1.0, 2.0, 3.0], 0.99, 0.95).unwrap();
        assert_eq!((quantile.value, quantile.high), (3.0, f64::INFINITY));
    }
}
