//! What a sample looks like: moments, quantiles, histogram.
//!
//! ```text
//! mean = Σ x / n,   std² = (Σ (x - mean)² - (Σ (x - mean))² / n) / (n - 1)            (1)
//! quantile(p) = x_(j) + (h - j) (x_(j+1) - x_(j)),   h = 1 + (n - 1) p,  j = floor h   (2)
//! bins = ceil((max - min) / (2 IQR n^(-1/3)))                                         (3)
//! ```
//!
//! (1) is the corrected two-pass algorithm: T. F. Chan et al., *Algorithms for computing the sample variance* (1983).
//! (2) is type 7 of R. J. Hyndman, Y. Fan, *Sample quantiles in statistical packages* (1996). (3): D. Freedman,
//! P. Diaconis, *On the histogram as a density estimator* (1981). All sums run over the sorted values: the order of
//! the observations does not matter, not even for rounding.

use serde::{Deserialize, Serialize};

use crate::error::{SensitivityError, require};

/// The observed outputs of a study, sorted, and how many more have failed.
#[derive(Debug, Clone, PartialEq)]
pub struct Sample {
    sorted: Vec<f64>,
    failed: usize,
}

/// Count, moments and extremes of a [`Sample`], in the unit of the output.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize, schemars::JsonSchema)]
pub struct Summary {
    /// Observations that gave a value. All other fields but `failed` are about these only.
    pub count: usize,
    /// Observations that failed.
    pub failed: usize,
    /// Mean.
    pub mean: f64,
    /// Standard deviation, with n - 1.
    pub std: f64,
    /// Smallest value.
    pub min: f64,
    /// Largest value.
    pub max: f64,
}

/// Moments and extremes of outputs that come one by one and need not be kept.
///
/// ```text
/// mean' = mean + (x - mean)/n,   M2' = M2 + (x - mean)(x - mean'),   std² = M2/(n - 1)      (4)
/// mean = mean_a + δ n_b/n,   M2 = M2_a + M2_b + δ² n_a n_b/n,   δ = mean_b - mean_a           (5)
/// ```
///
/// (4): B. P. Welford, *Note on a method for calculating corrected sums of squares and products* (1962); (5): Chan et al. (1983).
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Moments {
    count: usize,
    failed: usize,
    mean: f64,
    squares: f64,
    min: f64,
    max: f64,
}

impl Default for Moments {
    fn default() -> Self {
        let (min, max) = (f64::INFINITY, f64::NEG_INFINITY);
        Self { count: 0, failed: 0, mean: 0.0, squares: 0.0, min, max }
    }
}

impl Moments {
    /// Adds an output, `None` if the observation failed.
    pub fn add(&mut self, output: Option<f64>) {
        let Some(x) = output else {
            self.failed += 1;
            return;
        };
        self.count += 1;
        let deviation = x - self.mean;
        self.mean += deviation / self.count as f64;
        self.squares += deviation * (x - self.mean);
        self.min = self.min.min(x);
        self.max = self.max.max(x);
    }

    /// Adds the outputs of others.
    pub fn merge(&mut self, other: &Self) {
        self.failed += other.failed;
        if other.count == 0 {
            return;
        }
        let count = self.count + other.count;
        let (share, delta) = (other.count as f64 / count as f64, other.mean - self.mean);
        self.mean += delta * share;
        self.squares += other.squares + delta * delta * self.count as f64 * share;
        self.min = self.min.min(other.min);
        self.max = self.max.max(other.max);
        self.count = count;
    }

    /// What is known of the outputs so far.
    ///
    /// # Errors
    /// [`SensitivityError::OutOfRange`] for fewer than two values.
    pub fn summary(&self) -> Result<Summary, SensitivityError> {
        let Self { count, failed, mean, squares, min, max } = *self;
        check_count(count)?;
        Ok(Summary { count, failed, mean, std: (squares / (count as f64 - 1.0)).sqrt(), min, max })
    }
}

/// A sample needs two values.
fn check_count(count: usize) -> Result<(), SensitivityError> {
    if count >= 2 {
        return Ok(());
    }
    let value = count as u64;
    Err(SensitivityError::OutOfRange { field: "observed outputs", value, minimum: 2, maximum: u64::MAX })
}

/// Number of bins of a histogram.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Bins {
    /// Eq. (3), at least one and at most one a value; one if the interquartile range is zero.
    FreedmanDiaconis,
    /// This many.
    Count(usize),
}

/// Bins of equal width from the smallest value to the largest one.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, schemars::JsonSchema)]
pub struct Histogram {
    /// Edges, one more than bins. A bin holds its lower edge and not its upper one, the last bin both.
    pub edges: Vec<f64>,
    /// Values in each bin.
    pub counts: Vec<usize>,
}

impl Sample {
    /// Sample of outputs, `None` for an observation that has failed.
    ///
    /// # Errors
    /// [`SensitivityError::NotFinite`] for a value that is not finite, [`SensitivityError::OutOfRange`] for fewer
    /// than two values.
    pub fn new(outputs: &[Option<f64>]) -> Result<Self, SensitivityError> {
        let mut sorted = Vec::with_capacity(outputs.len());
        for (index, &output) in outputs.iter().enumerate() {
            if let Some(value) = output {
                if !value.is_finite() {
                    return Err(SensitivityError::NotFinite { field: "outputs", index, value });
                }
                sorted.push(value);
            }
        }
        check_count(sorted.len())?;
        sorted.sort_unstable_by(f64::total_cmp);
        let failed = outputs.len() - sorted.len();
        Ok(Self { sorted, failed })
    }

    /// Sample of values none of which has failed.
    ///
    /// # Errors
    /// As [`Sample::new`].
    pub fn of_values(values: &[f64]) -> Result<Self, SensitivityError> {
        let outputs: Vec<_> = values.iter().copied().map(Some).collect();
        Self::new(&outputs)
    }

    /// The values, in ascending order.
    #[must_use]
    pub fn sorted(&self) -> &[f64] {
        &self.sorted
    }

    /// Count, moments and extremes.
    #[must_use]
    pub fn summary(&self) -> Summary {
        let count = self.sorted.len();
        let (mean, squares) = mean_and_squares(&self.sorted);
        Summary {
            count,
            failed: self.failed,
            mean,
            std: (squares / (count as f64 - 1.0)).sqrt(),
            min: self.sorted[0],
            max: self.sorted[count - 1],
        }
    }

    /// Quantile by Eq. (2).
    ///
    /// # Errors
    /// [`SensitivityError::InvalidParameter`] for a `p` outside of [0, 1].
    pub fn quantile(&self, p: f64) -> Result<f64, SensitivityError> {
        require((0.0..=1.0).contains(&p), "p", p, "a probability from 0 to 1")?;
        let h = (self.sorted.len() - 1) as f64 * p;
        let j = h as usize;
        let next = (j + 1).min(self.sorted.len() - 1);
        Ok(self.sorted[j] + (h - j as f64) * (self.sorted[next] - self.sorted[j]))
    }

    /// Histogram. That of a constant sample is a single bin of zero width.
    ///
    /// # Errors
    /// [`SensitivityError::OutOfRange`] for no bin, or more than there are values.
    pub fn histogram(&self, bins: Bins) -> Result<Histogram, SensitivityError> {
        let n = self.sorted.len();
        let (min, max) = (self.sorted[0], self.sorted[n - 1]);
        let bins = match bins {
            Bins::Count(bins) => bins,
            Bins::FreedmanDiaconis => {
                let width = 2.0 * (self.quantile(0.75)? - self.quantile(0.25)?) / (n as f64).cbrt();
                if width > 0.0 { (((max - min) / width).ceil() as usize).clamp(1, n) } else { 1 }
            }
        };
        if !(1..=n).contains(&bins) {
            let (value, maximum) = (bins as u64, n as u64);
            return Err(SensitivityError::OutOfRange { field: "bins", value, minimum: 1, maximum });
        }
        if min == max {
            return Ok(Histogram { edges: vec![min, max], counts: vec![n] });
        }
        let mut edges: Vec<f64> = (0..bins).map(|i| min + (max - min) * (i as f64 / bins as f64)).collect();
        let starts: Vec<usize> =
            edges.iter().map(|edge| self.sorted.partition_point(|value| value < edge)).chain([n]).collect();
        edges.push(max);
        let counts = starts.windows(2).map(|pair| pair[1] - pair[0]).collect();
        Ok(Histogram { edges, counts })
    }
}

/// Mean and sum of squares about it, Eq. (1).
pub(crate) fn mean_and_squares(values: &[f64]) -> (f64, f64) {
    let n = values.len() as f64;
    let mean = values.iter().sum::<f64>() / n;
    let (mut squares, mut rounding) = (0.0, 0.0);
    for value in values {
        let deviation = value - mean;
        squares += deviation * deviation;
        rounding += deviation;
    }
    (mean, (squares - rounding * rounding / n).max(0.0))
}
