//! Summary of a sample: moments, quantiles, histogram.
//!
//! ```text
//! mean = Σ x / n,   std² = (Σ (x - mean)² - (Σ (x - mean))² / n) / (n - 1)             (Su1)
//! quantile(p) = x_(j) + (h - j) (x_(j+1) - x_(j)),   h = 1 + (n - 1) p,  j = floor h   (Su2)
//! bins = ceil((max - min) / (2 IQR n^(-1/3)))                                          (Su3)
//! ```
//!
//! - (Su1) is the corrected two-pass algorithm: T. F. Chan, G. H. Golub, R. J. LeVeque, *Algorithms for
//!   computing the sample variance* (1983).
//! - (Su2) is type 7 of R. J. Hyndman, Y. Fan, *Sample quantiles in statistical packages* (1996).
//! - (Su3): D. Freedman, P. Diaconis, *On the histogram as a density estimator* (1981).
//!
//! All sums run over the sorted values, so that the order of the observations does not change even the last
//! digit.

use serde::{Deserialize, Serialize};

use crate::error::{SensitivityError, check_range, check_values, require};

/// Observed outputs in ascending order, and the number of failed observations.
#[derive(Debug, Clone, PartialEq)]
pub struct Sample {
    sorted: Vec<f64>,
    failed: usize,
}

/// Count, moments and extremes of a [`Sample`], in the unit of the output.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schemars", derive(schemars::JsonSchema))]
pub struct Summary {
    /// Number of observations that gave a value. All fields but `failed` describe these only.
    pub count: usize,
    /// Number of failed observations.
    pub failed: usize,
    /// Mean.
    pub mean: f64,
    /// Standard deviation (with n - 1).
    pub std: f64,
    /// Smallest value.
    pub min: f64,
    /// Largest value.
    pub max: f64,
}

/// Moments and extremes of outputs that arrive one by one and are not stored.
///
/// ```text
/// mean' = mean + (x - mean)/n,   M2' = M2 + (x - mean)(x - mean'),   std² = M2/(n - 1)       (Su4)
/// mean = mean_a + δ n_b/n,   M2 = M2_a + M2_b + δ² n_a n_b/n,   δ = mean_b - mean_a          (Su5)
/// ```
///
/// (Su4): B. P. Welford, *Note on a method for calculating corrected sums of squares and products* (1962).
/// (Su5): Chan et al. (1983).
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
    /// Adds an output, or `None` for a failed observation.
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

    /// Adds the outputs of other moments.
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

    /// Summary of the outputs added so far.
    ///
    /// # Errors
    /// [`SensitivityError::OutOfRange`] for fewer than two values.
    pub fn summary(&self) -> Result<Summary, SensitivityError> {
        let Self { count, failed, mean, squares, min, max } = *self;
        check_range("observed outputs", count as u64, 2, u64::MAX)?;
        Ok(Summary { count, failed, mean, std: (squares / (count as f64 - 1.0)).sqrt(), min, max })
    }
}

/// Rule for the number of bins of a histogram.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Bins {
    /// Eq. (Su3), limited to the number of values. There is one bin if the interquartile range is zero.
    FreedmanDiaconis,
    /// This number of bins.
    Count(usize),
}

/// Histogram with bins of equal width from the smallest to the largest value.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schemars", derive(schemars::JsonSchema))]
pub struct Histogram {
    /// Edges, one more than bins. A bin includes its lower edge only; the last bin includes both.
    pub edges: Vec<f64>,
    /// Number of values in each bin.
    pub counts: Vec<usize>,
}

impl Sample {
    /// Makes a sample of outputs, with `None` for a failed observation.
    ///
    /// # Errors
    /// [`SensitivityError::NotFinite`] for a value that is not finite, [`SensitivityError::Scale`] for values
    /// whose squares a computer does not hold, [`SensitivityError::OutOfRange`] for fewer than two values.
    pub fn new(outputs: &[Option<f64>]) -> Result<Self, SensitivityError> {
        let observed = || outputs.iter().enumerate().filter_map(|(index, output)| Some((index, (*output)?)));
        check_values("outputs", observed())?;
        let mut sorted: Vec<f64> = observed().map(|(_, value)| value).collect();
        check_range("observed outputs", sorted.len() as u64, 2, u64::MAX)?;
        sorted.sort_unstable_by(f64::total_cmp);
        let failed = outputs.len() - sorted.len();
        Ok(Self { sorted, failed })
    }

    /// Makes a sample of values without failed observations.
    ///
    /// # Errors
    /// As [`Sample::new`].
    pub fn of_values(values: &[f64]) -> Result<Self, SensitivityError> {
        let outputs: Vec<_> = values.iter().copied().map(Some).collect();
        Self::new(&outputs)
    }

    /// Values in ascending order.
    #[must_use]
    pub fn sorted(&self) -> &[f64] {
        &self.sorted
    }

    /// Count, moments and extremes.
    #[must_use]
    pub fn summary(&self) -> Summary {
        let count = self.sorted.len();
        let spread = Spread::of(&self.sorted);
        Summary {
            count,
            failed: self.failed,
            mean: spread.mean,
            std: spread.std(),
            min: self.sorted[0],
            max: self.sorted[count - 1],
        }
    }

    /// Quantile, Eq. (Su2).
    ///
    /// # Errors
    /// [`SensitivityError::InvalidParameter`] for a `p` outside [0, 1].
    pub fn quantile(&self, p: f64) -> Result<f64, SensitivityError> {
        require((0.0..=1.0).contains(&p), "p", p, "a probability from 0 to 1")?;
        let h = (self.sorted.len() - 1) as f64 * p;
        let j = h as usize;
        let next = (j + 1).min(self.sorted.len() - 1);
        Ok(self.sorted[j] + (h - j as f64) * (self.sorted[next] - self.sorted[j]))
    }

    /// Histogram. For a constant sample it is a single bin of zero width.
    ///
    /// # Errors
    /// [`SensitivityError::OutOfRange`] for no bin, or for more bins than values.
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
        check_range("bins", bins as u64, 1, n as u64)?;
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

/// Returns [`SensitivityError::ConstantSample`] unless at least two values differ.
pub(crate) fn check_varies(values: &[f64]) -> Result<(), SensitivityError> {
    let first = values.first().copied().unwrap_or(f64::NAN);
    if values.iter().all(|value| *value == first) {
        return Err(SensitivityError::ConstantSample { value: first, count: values.len() });
    }
    Ok(())
}

/// Mean of values and their spread about it, Eq. (Su1).
pub(crate) struct Spread {
    n: f64,
    pub(crate) mean: f64,
    /// Sum of the squares about the mean.
    pub(crate) squares: f64,
}

impl Spread {
    pub(crate) fn of(values: &[f64]) -> Self {
        let n = values.len() as f64;
        let mean = values.iter().sum::<f64>() / n;
        let (mut squares, mut rounding) = (0.0, 0.0);
        for value in values {
            let deviation = value - mean;
            squares += deviation * deviation;
            rounding += deviation;
        }
        Self { n, mean, squares: (squares - rounding * rounding / n).max(0.0) }
    }

    /// Variance (with n - 1).
    pub(crate) fn variance(&self) -> f64 {
        self.squares / (self.n - 1.0)
    }

    /// Standard deviation (with n - 1).
    pub(crate) fn std(&self) -> f64 {
        self.variance().sqrt()
    }

    /// Standard error of the mean.
    pub(crate) fn standard_error(&self) -> f64 {
        (self.variance() / self.n).sqrt()
    }
}
