//! Estimates with their confidence intervals.
//!
//! ```text
//! mean ± t_(n-1, (1 + level) / 2) s / √n                                  (1)
//! estimate ± t_(n-1, (1 + level) / 2) s* √(n / (n - 1))                    (2)
//! ```
//!
//! (1) is Student's, of n independent values. (2) is its counterpart for an estimate that is no mean, s* being the
//! deviation of the estimate over bootstrap resamples of n independent units: B. Efron, R. J. Tibshirani, *An introduction
//! to the bootstrap* (1993), section 12.2 and, for the factor √(n / (n - 1)), 5.3; for a mean the two are the same but for
//! the noise of resampling.

use serde::{Deserialize, Serialize};
use statrs::distribution::{ContinuousCDF, StudentsT};

use crate::error::SensitivityError;
use crate::summary::mean_and_squares;

/// An estimate and its confidence interval.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize, schemars::JsonSchema)]
pub struct Estimate {
    /// The estimate itself.
    pub value: f64,
    /// Lower end of the interval.
    pub low: f64,
    /// Upper end of the interval.
    pub high: f64,
}

impl Estimate {
    /// Width of the interval.
    #[must_use]
    pub fn width(&self) -> f64 {
        self.high - self.low
    }

    /// Eq. (1), for at least two values.
    pub(crate) fn of_mean(values: &[f64], level: f64) -> Result<Self, SensitivityError> {
        let n = values.len();
        let (mean, squares) = mean_and_squares(values);
        Ok(Self::around(mean, student(n, level)? * (squares / (n * (n - 1)) as f64).sqrt()))
    }

    /// Eq. (2), for at least two units and two resamples.
    pub(crate) fn of_resamples(
        value: f64,
        resampled: &[f64],
        units: usize,
        level: f64,
    ) -> Result<Self, SensitivityError> {
        let variance = mean_and_squares(resampled).1 / (resampled.len() as f64 - 1.0);
        let n = units as f64;
        Ok(Self::around(value, student(units, level)? * (variance * n / (n - 1.0)).sqrt()))
    }

    fn around(value: f64, half: f64) -> Self {
        Self { value, low: value - half, high: value + half }
    }
}

/// Student's factor for n values.
fn student(n: usize, level: f64) -> Result<f64, SensitivityError> {
    let law = StudentsT::new(0.0, 1.0, n as f64 - 1.0).map_err(|_| SensitivityError::OutOfRange {
        field: "independent values",
        value: n as u64,
        minimum: 2,
        maximum: u64::MAX,
    })?;
    Ok(law.inverse_cdf(0.5 * (1.0 + level)))
}
