//! Laws fitted to a sample by maximum likelihood, and how well they fit.
//!
//! ```text
//! AIC = 2 k - 2 ln L,   BIC = k ln n - 2 ln L,   k = 2 parameters                    (Fi1)
//! D = max_i max(i / n - F(x_(i)), F(x_(i)) - (i - 1) / n)                            (Fi2)
//! p = (1 + #{D* ≥ D}) / (R + 1)                                                      (Fi3)
//! ```
//!
//! - (Fi1): H. Akaike, *A new look at the statistical model identification* (1974); G. Schwarz, *Estimating
//!   the dimension of a model* (1978).
//! - (Fi2) is the distance of Kolmogorov and Smirnov. Its usual p-value does not hold once the parameters are
//!   fitted to the same sample: H. W. Lilliefors, *On the Kolmogorov-Smirnov test for normality* (1967).
//! - (Fi3) therefore draws R samples from the fitted law, fits each of them again and compares the distances.
//!   This is the parametric bootstrap: A. C. Davison, D. V. Hinkley, *Bootstrap methods and their
//!   application* (1997), Eq. 4.11.
//!
//! All families are laws of a location and a scale, either of x or of its logarithm. The distribution of D*
//! then depends on n and the family only, not on the parameters (F. N. David, N. L. Johnson, *The probability
//! integral transformation when parameters are estimated from the sample*, 1948). The samples are therefore
//! drawn from the standard law. The normal and the lognormal family share them, and so do Gumbel's and
//! Weibull's.
//!
//! Some laws are left out. The likelihood of a law with a free lower end (Weibull, lognormal or gamma with
//! three parameters) and that of a beta law on the range of the sample are unbounded. The gamma law with two
//! parameters is not a law of a location and a scale.

use rand_distr::{Distribution, Exp1};
use serde::{Deserialize, Serialize};

use crate::error::{SensitivityError, check_range};
use crate::family::Family;
use crate::law::Law;
use crate::law::choice::log_weight;
use crate::law::likelihood::estimate;
use crate::parallel::*;
use crate::sample::random::{Bootstrap, stream};
use crate::sample::summary::{Sample, check_varies};

impl Family {
    /// Standard law of this family, on the scale (of x or of its logarithm) on which it has a location and a
    /// scale.
    fn standard(self) -> (Self, Law) {
        let (location, scale) = (0.0, 1.0);
        match self {
            Self::Uniform => (Self::Uniform, Law::Uniform { min: 0.0, max: 1.0 }),
            Self::Normal | Self::LogNormal => (Self::Normal, Law::Normal { mean: 0.0, std: 1.0 }),
            Self::Logistic => (self, Law::Logistic { location, scale }),
            Self::Laplace => (self, Law::Laplace { location, scale }),
            Self::Gumbel | Self::Weibull => (Self::Gumbel, Law::Gumbel { location, scale }),
        }
    }
}

/// A fitted law and how well it fits.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schemars", derive(schemars::JsonSchema))]
pub struct Fit {
    /// Family of the law.
    pub family: Family,
    /// Law of the largest likelihood in the family.
    pub law: Law,
    /// Natural logarithm of the likelihood.
    pub log_likelihood: f64,
    /// Akaike's criterion AIC (Fi1). Smaller is better.
    pub aic: f64,
    /// Schwarz's criterion BIC (Fi1). Smaller is better.
    pub bic: f64,
    /// Kolmogorov-Smirnov distance D (Fi2).
    pub ks_distance: f64,
    /// Probability (Fi3) of a distance of D or more if the sample was drawn from this family: at least
    /// 1 / (resamples + 1).
    pub p_value: f64,
    /// Samples of the bootstrap behind the p-value.
    pub resamples: usize,
    /// Probability of the family among those that were fitted together (see [`crate::law::choice`]).
    pub probability: f64,
}

/// Fits one family.
///
/// # Errors
/// - [`SensitivityError::OutOfRange`] for fewer than three values or no resample;
/// - [`SensitivityError::ConstantSample`] if all values are equal;
/// - [`SensitivityError::NotPositive`] for a family of positive values if the sample has a value of 0 or
///   less;
/// - [`SensitivityError::NotConverged`], or [`SensitivityError::InvalidParameter`] of the fitted law, for
///   values that differ by rounding only.
pub fn fit(sample: &Sample, family: Family, bootstrap: Bootstrap) -> Result<Fit, SensitivityError> {
    let minimum = sample.sorted()[0];
    if family.positive() && minimum <= 0.0 {
        return Err(SensitivityError::NotPositive { family, minimum });
    }
    check(sample, bootstrap)?;
    let distances = bootstrap_distances(&[family.standard()], sample.sorted().len(), bootstrap)?;
    assess(sample, family, distances.iter().map(|row| row[0]))
}

/// Fits all families that apply and sorts them by ascending [`Fit::aic`], which is not the order of
/// [`Fit::probability`].
///
/// Families of positive values are left out if the sample has a value of 0 or less.
///
/// # Errors
/// As [`fit`], but never [`SensitivityError::NotPositive`], and [`SensitivityError::Discrete`] for values
/// that no continuous law has.
pub fn fit_all(sample: &Sample, bootstrap: Bootstrap) -> Result<Vec<Fit>, SensitivityError> {
    check(sample, bootstrap)?;
    check_continuous(sample.sorted())?;
    let positive = sample.sorted()[0] > 0.0;
    let families = Family::ALL.into_iter().filter(|family| positive || !family.positive());
    // The families of positive values share the standard laws of others.
    let bases = Family::ALL.into_iter().filter(|family| !family.positive()).map(Family::standard);
    let bases: Vec<_> = bases.collect();
    let distances = bootstrap_distances(&bases, sample.sorted().len(), bootstrap)?;
    let mut fits = Vec::with_capacity(Family::ALL.len());
    for family in families {
        let base = bases.iter().take_while(|&&base| base != family.standard()).count();
        fits.push(assess(sample, family, distances.iter().map(|row| row[base]))?);
    }
    weigh(&mut fits, sample.sorted());
    fits.sort_by(|one, other| one.aic.total_cmp(&other.aic));
    Ok(fits)
}

/// Kolmogorov-Smirnov distance (Fi2) of a law and a sample.
#[must_use]
pub fn ks_distance(law: &Law, sample: &Sample) -> f64 {
    distance(law, sample.sorted())
}

/// Writes the probabilities of all fits to one sample, Eq. (Ch4) of [`crate::law::choice`].
fn weigh(fits: &mut [Fit], sorted: &[f64]) {
    let weight = |fit: &Fit| log_weight(&fit.law, fit.log_likelihood, sorted);
    let weights: Vec<f64> = fits.iter().map(weight).collect();
    let greatest = weights.iter().copied().fold(f64::NEG_INFINITY, f64::max);
    let total: f64 = weights.iter().map(|weight| (weight - greatest).exp()).sum();
    for (fit, weight) in fits.iter_mut().zip(weights) {
        fit.probability = (weight - greatest).exp() / total;
    }
}

/// Estimates the law and computes its criteria (Fi1), its distance (Fi2) and its p-value (Fi3) from the
/// distances of the bootstrap.
fn assess(
    sample: &Sample,
    family: Family,
    bootstrap: impl ExactSizeIterator<Item = f64>,
) -> Result<Fit, SensitivityError> {
    let sorted = sample.sorted();
    let law = estimate(family, sorted)?;
    law.validate()?;
    let log_likelihood = sorted.iter().map(|&x| law.ln_pdf(x)).sum::<f64>();
    let ks_distance = distance(&law, sorted);
    let resamples = bootstrap.len();
    let beyond = bootstrap.filter(|&other| other >= ks_distance).count();
    Ok(Fit {
        family,
        law,
        log_likelihood,
        aic: 2.0 * PARAMETERS - 2.0 * log_likelihood,
        bic: PARAMETERS * (sorted.len() as f64).ln() - 2.0 * log_likelihood,
        ks_distance,
        p_value: (1 + beyond) as f64 / (1 + resamples) as f64,
        resamples,
        probability: 1.0,
    })
}

/// Number of parameters of each family.
const PARAMETERS: f64 = 2.0;
/// Least number of values: one more than there are parameters.
const MIN_VALUES: u64 = 3;

fn check(sample: &Sample, bootstrap: Bootstrap) -> Result<(), SensitivityError> {
    let sorted = sample.sorted();
    check_range("observed outputs", sorted.len() as u64, MIN_VALUES, u64::MAX)?;
    check_range("resamples", bootstrap.resamples as u64, 1, u64::MAX)?;
    check_varies(sorted)
}

/// Checks that the values may be those of a continuous law, rounded at most.
///
/// A value that c of n have is a step of c / n in their distribution function, so that D of every continuous
/// law is at least c / (2 n). More than √n equal values are therefore beyond what a continuous law leaves to
/// chance, and fewer than √n different ones are levels.
fn check_continuous(sorted: &[f64]) -> Result<(), SensitivityError> {
    let groups = || sorted.chunk_by(|one, other| one == other);
    let (levels, root) = (groups().count(), (sorted.len() as f64).sqrt());
    let most = groups().max_by_key(|group| group.len()).unwrap_or_default();
    let (times, levels_needed) = (most.len(), root.max(3.0));
    if (times as f64) <= root.max(2.0) && levels as f64 >= levels_needed {
        return Ok(());
    }
    Err(SensitivityError::Discrete { value: most[0], times, count: sorted.len(), levels })
}

/// Distances D* of the base laws, one row per resample.
///
/// Resample r is stream r of the generator: all laws share one set of sorted uniform numbers.
fn bootstrap_distances(
    bases: &[(Family, Law)],
    n: usize,
    bootstrap: Bootstrap,
) -> Result<Vec<Vec<f64>>, SensitivityError> {
    let resample = |r: usize| {
        let uniform = sorted_uniform(n, bootstrap.seed, r as u64);
        let mut values = vec![0.0; n];
        let mut row = Vec::with_capacity(bases.len());
        for (family, law) in bases {
            for (value, &u) in values.iter_mut().zip(&uniform) {
                *value = law.quantile(u);
            }
            row.push(distance(&estimate(*family, &values)?, &values));
        }
        Ok(row)
    };
    (0..bootstrap.resamples).into_par_iter().map(resample).collect()
}

/// Draws n uniform numbers in ascending order without sorting.
///
/// They are the partial sums of n + 1 exponential numbers over their total (L. Devroye, *Non-uniform random
/// variate generation*, 1986, section V.3.1).
fn sorted_uniform(n: usize, seed: u64, number: u64) -> Vec<f64> {
    let mut generator = stream(seed, number);
    let mut total = 0.0;
    let mut sums: Vec<f64> = Vec::with_capacity(n + 1);
    for _ in 0..=n {
        let spacing: f64 = Exp1.sample(&mut generator);
        total += spacing;
        sums.push(total);
    }
    sums.truncate(n);
    for sum in &mut sums {
        *sum = (*sum / total).clamp(f64::MIN_POSITIVE, 1.0 - f64::EPSILON);
    }
    sums
}

/// Distance (Fi2), exactly, by bisection of the sample.
///
/// F and i / n ascend, so that their values at the ends of a part bound the distance within it. Most parts
/// need no further evaluation.
fn distance(law: &Law, sorted: &[f64]) -> f64 {
    let n = sorted.len() as f64;
    let at = |i: usize| {
        let f = law.cdf(sorted[i]);
        (f, ((i + 1) as f64 / n - f).max(f - i as f64 / n))
    };
    let last = sorted.len() - 1;
    let ((f_first, distance_first), (f_last, distance_last)) = (at(0), at(last));
    let mut distance = distance_first.max(distance_last);
    let mut parts = vec![(0, last, f_first, f_last)];
    while let Some((low, high, f_low, f_high)) = parts.pop() {
        let bound = (high as f64 / n - f_low).max(f_high - (low + 1) as f64 / n);
        if high - low < 2 || bound <= distance {
            continue;
        }
        let middle = low + (high - low) / 2;
        let (f, distance_middle) = at(middle);
        distance = distance.max(distance_middle);
        parts.push((low, middle, f_low, f));
        parts.push((middle, high, f, f_high));
    }
    distance
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_bootstrap_finds_the_critical_values_of_lilliefors_test() {
        // 5 % point of D for a normal law of unknown mean and deviation: P. Molin, H. Abdi, *New tables and
        // numerical approximation for the Kolmogorov-Smirnov/Lilliefors/Van Soest test of normality* (1998).
        for n in [20, 50, 200] {
            let size = n as f64;
            let f = (0.83 + size) / size.sqrt() - 0.01;
            let table = 0.895 / f;
            let bootstrap = Bootstrap { resamples: 4000, seed: 1 };
            let rows = bootstrap_distances(&[Family::Normal.standard()], n, bootstrap).unwrap();
            let beyond = rows.iter().filter(|row| row[0] >= table).count() as f64 / 4000.0;
            // Standard deviation of the estimate: 0.0034.
            assert!((beyond - 0.05).abs() < 0.012, "n {n}: {beyond}");
        }
    }

    #[test]
    fn the_distance_by_bisection_is_that_over_all_values() {
        let law = Law::Normal { mean: 0.5, std: 0.3 };
        for (n, stream) in [(3, 0), (4, 1), (50, 2), (1000, 3)] {
            let values = sorted_uniform(n, 9, stream);
            let mut all = 0.0_f64;
            for (i, &x) in values.iter().enumerate() {
                let (f, n) = (law.cdf(x), n as f64);
                all = all.max((i + 1) as f64 / n - f).max(f - i as f64 / n);
            }
            assert_eq!(distance(&law, &values), all);
        }
    }

    #[test]
    fn sorted_uniform_numbers_ascend_in_the_open_unit_interval_with_the_spread_of_independent_ones() {
        let numbers = sorted_uniform(10_000, 2, 0);
        assert!(numbers.is_sorted() && numbers[0] > 0.0 && numbers[9_999] < 1.0);
        // 0.1 % point of the Kolmogorov-Smirnov distance of known law: 1.95 / sqrt(n).
        assert!(distance(&Law::Uniform { min: 0.0, max: 1.0 }, &numbers) < 1.95 / 100.0);
    }
}
