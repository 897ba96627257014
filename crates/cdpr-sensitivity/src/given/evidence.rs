//! Evidence that an input matters: several tests of independence, each with its p-value.
//!
//! With the scores v of the output (mean 0, norm 1) and the projection A on the functions of an input,
//!
//! ```text
//! R² = vᵀ A v = Σ_g (Σ_(i in g) v_i)² / n_g   for groups g of rows,   (u · v)²   for scores u         (Ev1)
//! p = P(B >= R²),   B a beta variable of the mean and variance of R² over all permutations of v       (Ev2)
//! p >= Π n_g! / n!                                                                                    (Ev3)
//! Q = Σ (v_(j+1) - v_(j))² in the order of the input,   p = P(N <= Q)                                 (Ev4)
//! ```
//!
//! - (Ev1), (Ev2): the moments are (Hs3) and (Hs5) of [`hsic`](crate::given::hsic), exact for any scores and
//!   any ties, where F or χ² assume normal ones. Of two values in two groups p is exact (R. A. Fisher). (Ev3)
//!   is the share of the permutations that are as far apart as any can be: no permutation test has a smaller
//!   p.
//! - (Ev4) is the index by ranks ([`rank`](crate::given::rank)) of the ranks of the output (R. Bartels 1982;
//!   S. Chatterjee 2021), with a normal law of the exact moments over all permutations. Of an output with two
//!   values Q counts runs, whose law is known (A. Wald, J. Wolfowitz, *On a test whether two samples are from
//!   the same population*, Ann. Math. Stat. 11, 1940); where most values are equal, p is at least that of the
//!   runs of equal and other ones.
//!
//! | measure | scores of the output | functions of the input |
//! |---|---|---|
//! | trend | ranks | its ranks (Spearman) |
//! | location | ranks | steps: ten parts, or its levels (Kruskal and Wallis) |
//! | spread | distances of the ranks from the middle | the same steps |
//! | together | ranks times those of another input | the same steps; least p times the number of others |
//! | neighbours | ranks | any (Ev4) |
//! | dependence | values | any (HSIC) |
//!
//! An output of ranks is as little moved by long tails as by a diverged run. *Together* finds an input that
//! acts with another one only: under its hypothesis the input is independent of the other and the output.

use serde::{Deserialize, Serialize};
use statrs::distribution::{ContinuousCDF, Normal};
use statrs::function::beta::beta_reg;
use statrs::function::gamma::ln_gamma;

use crate::given::data::Kind;
use crate::given::hsic::{Invariants, moments};
use crate::given::rank::MIN_ROWS as ROWS_OF_NEIGHBOURS;
use crate::given::rank::rows::order;
use crate::measure::regression::ranks;
use crate::parallel::*;

/// A measure with a test of independence.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(feature = "schemars", derive(schemars::JsonSchema))]
#[serde(rename_all = "snake_case")]
pub enum Measure {
    /// Rank correlation.
    Trend,
    /// Means of ranks by parts or levels of the input.
    Location,
    /// The same of the distances of the ranks from the middle.
    Spread,
    /// What the input does together with another one.
    Together,
    /// Differences of neighbours in the input, as the index by ranks.
    Neighbours,
    /// HSIC.
    Dependence,
}

impl Measure {
    /// Word for a sentence.
    #[must_use]
    pub const fn word(self) -> &'static str {
        match self {
            Self::Trend => "trend",
            Self::Location => "location",
            Self::Spread => "spread",
            Self::Together => "together",
            Self::Neighbours => "neighbours",
            Self::Dependence => "HSIC",
        }
    }

    /// What the output does where the test finds an input.
    #[must_use]
    pub const fn meaning(self) -> &'static str {
        match self {
            Self::Trend => "it rises or falls with the input",
            Self::Location => "its level differs along the input",
            Self::Spread => "its scatter differs along the input",
            Self::Together => "it depends on the input and another one together",
            Self::Neighbours => "it is alike where the input is",
            Self::Dependence => "it depends on the input in any way",
        }
    }
}

/// Result of a test.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schemars", derive(schemars::JsonSchema))]
pub struct Test {
    /// The measure.
    pub measure: Measure,
    /// Probability of as much without an effect, of this test alone.
    pub p_value: f64,
}

/// Least number of rows of tests.
pub(crate) const MIN_ROWS: usize = 8;
/// Largest number of parts of an input.
const PARTS: usize = 10;
/// Largest number of inputs of which pairs are tested: the time grows with its square.
pub(crate) const MOST_OF_PAIRS: usize = 200;

/// Values of mean 0 and norm 1.
#[derive(Clone, Debug)]
pub(crate) struct Scores(Vec<f64>);

impl Scores {
    /// Without scores for constant values.
    pub(crate) fn new(mut values: Vec<f64>) -> Option<Self> {
        let mean = values.iter().sum::<f64>() / values.len() as f64;
        values.iter_mut().for_each(|value| *value -= mean);
        let norm = values.iter().map(|value| value * value).sum::<f64>().sqrt();
        let rounding = 1e-12 * mean.abs() * (values.len() as f64).sqrt();
        values.iter_mut().for_each(|value| *value /= norm);
        (norm > rounding).then_some(Self(values))
    }

    pub(crate) fn of_ranks(values: &[f64]) -> Option<Self> {
        Self::new(ranks(values))
    }

    /// Distances of the ranks from the middle.
    pub(crate) fn of_spread(values: &[f64]) -> Option<Self> {
        let middle = 0.5 * (values.len() as f64 + 1.0);
        Self::new(ranks(values).into_iter().map(|rank| (rank - middle).abs()).collect())
    }

    /// Scores of the product with others, row by row.
    pub(crate) fn times(&self, other: &Self) -> Option<Self> {
        Self::new(self.0.iter().zip(&other.0).map(|(one, other)| one * other).collect())
    }

    pub(crate) fn values(&self) -> &[f64] {
        &self.0
    }

    /// Correlation with others.
    pub(crate) fn product(&self, other: &Self) -> f64 {
        self.0.iter().zip(&other.0).map(|(one, other)| one * other).sum()
    }

    fn invariants(&self) -> Invariants {
        Invariants { trace: 1.0, square: 1.0, diagonal: self.0.iter().map(|v| v.powi(4)).sum() }
    }
}

/// Functions of an input.
#[derive(Clone, Debug)]
pub(crate) enum Space {
    Line(Scores),
    /// Group of each row, and the sizes of the groups.
    Steps(Vec<usize>, Vec<f64>),
}

impl Space {
    /// Steps between the parts of an input, or between its levels.
    pub(crate) fn steps(values: &[f64], kind: Kind, seed: u64) -> Self {
        let n = values.len();
        let most = (n / 3).clamp(2, PARTS);
        let order = order(values, seed, 0);
        let mut group = vec![0; n];
        let levels = order.chunk_by(|&i, &j| values[i] == values[j]);
        let count = if kind == Kind::Levels || levels.clone().count() <= most {
            let number = |(level, rows): (usize, &[usize])| rows.iter().for_each(|&row| group[row] = level);
            let count = levels.clone().count();
            levels.enumerate().for_each(number);
            count
        } else {
            let count = (n / 10).clamp(2, PARTS);
            order.iter().enumerate().for_each(|(place, &row)| group[row] = place * count / n);
            count
        };
        let mut sizes = vec![0.0; count];
        group.iter().for_each(|&group| sizes[group] += 1.0);
        Self::Steps(group, sizes)
    }

    /// R² (Ev1).
    pub(crate) fn share(&self, scores: &Scores) -> f64 {
        match self {
            Self::Line(u) => u.product(scores).powi(2),
            Self::Steps(groups, sizes) => {
                let mut sums = vec![0.0; sizes.len()];
                groups.iter().zip(&scores.0).for_each(|(&group, v)| sums[group] += v);
                sums.iter().zip(sizes).map(|(sum, size)| sum * sum / size).sum()
            }
        }
    }

    fn invariants(&self, n: f64) -> Invariants {
        match self {
            Self::Line(u) => u.invariants(),
            Self::Steps(_, sizes) => {
                let freedoms = sizes.len() as f64 - 1.0;
                let diagonal = sizes.iter().map(|size| size * (1.0 / size - 1.0 / n).powi(2)).sum();
                Invariants { trace: freedoms, square: freedoms, diagonal }
            }
        }
    }

    /// ln of (Ev3).
    fn log_least(&self, n: f64) -> f64 {
        let ln_factorial = |count: f64| ln_gamma(count + 1.0);
        let equal = match self {
            // The same values in the opposite order are as far apart.
            Self::Line(u) => {
                let mut sorted = u.0.clone();
                sorted.sort_unstable_by(f64::total_cmp);
                let ties = sorted.chunk_by(|one, other| one == other);
                2.0_f64.ln() + ties.map(|ties| ln_factorial(ties.len() as f64)).sum::<f64>()
            }
            Self::Steps(_, sizes) => sizes.iter().map(|size| ln_factorial(*size)).sum(),
        };
        equal - ln_factorial(n)
    }

    /// P(as far from the expected number of rows, or farther) of rows with one of two values in one of two
    /// groups, by the hypergeometric law.
    fn exact(&self, scores: &Scores) -> Option<f64> {
        let group = match self {
            Self::Line(u) => of_two(&u.0)?,
            Self::Steps(groups, sizes) if sizes.len() == 2 => groups.iter().map(|of| *of == 1).collect(),
            Self::Steps(..) => return None,
        };
        let value = of_two(&scores.0)?;
        let count = |rows: &[bool]| rows.iter().filter(|is| **is).count() as f64;
        let (n, k, m) = (value.len() as f64, count(&value), count(&group));
        let both = group.iter().zip(&value).filter(|(one, other)| **one && **other).count() as f64;
        let expected = k * m / n;
        let is_as_far = |x: &f64| (x - expected).abs() >= (both - expected).abs() - 1e-9;
        let p = |x: f64| (ln_choose(k, x) + ln_choose(n - k, m - x) - ln_choose(n, m)).exp();
        Some((0..=k.min(m) as u32).map(f64::from).filter(is_as_far).map(p).sum::<f64>().min(1.0))
    }

    /// p (Ev2).
    pub(crate) fn p_value(&self, scores: &Scores) -> f64 {
        if let Some(p) = self.exact(scores) {
            return p;
        }
        let n = scores.0.len() as f64;
        let share = self.share(scores).clamp(0.0, 1.0);
        let (mean, variance) = moments(self.invariants(n), scores.invariants(), n);
        let sum = mean * (1.0 - mean) / variance - 1.0;
        // Without a variance, no permutation differs from another.
        if !(sum.is_finite() && sum > 0.0 && variance > 1e-14) {
            return 1.0;
        }
        let tail = beta_reg((1.0 - mean) * sum, mean * sum, 1.0 - share);
        tail.max(self.log_least(n).exp()).min(1.0)
    }
}

/// p (Ev4) of scores in the order of an input.
fn of_neighbours(values: &[f64], scores: &Scores, seed: u64) -> f64 {
    let sorted: Vec<f64> = order(values, seed, 1).into_iter().map(|row| scores.0[row]).collect();
    let found: f64 = sorted.windows(2).map(|pair| (pair[1] - pair[0]).powi(2)).sum();
    let n = sorted.len() as f64;
    // Q = vᵀ L v with the Laplacian L of the path from row to row: 1, 2, .. 2, 1 on its diagonal, -1 beside.
    let squares = 4.0 * (n - 2.0) + 2.0;
    let path = Invariants { trace: 2.0 * (n - 1.0), square: squares + 2.0 * (n - 1.0), diagonal: squares };
    let (mean, variance) = moments(path, scores.invariants(), n);
    let p = Normal::new(mean, variance.sqrt()).map_or(1.0, |normal| normal.cdf(found));
    let mut values = sorted.clone();
    values.sort_unstable_by(f64::total_cmp);
    let ties: Vec<&[f64]> = values.chunk_by(|one, other| one == other).collect();
    let most = ties.iter().max_by_key(|ties| ties.len()).map_or(&[][..], |ties| ties);
    if ties.len() > 2 && most.len() as f64 <= MOSTLY_EQUAL * n {
        return p;
    }
    let runs = of_runs(&sorted.iter().map(|value| Some(value) == most.first()).collect::<Vec<_>>());
    if ties.len() > 2 { p.max(runs) } else { runs }
}

/// Which rows have another value than the first one, where there are two values.
fn of_two(values: &[f64]) -> Option<Vec<bool>> {
    let first = values.first()?;
    let other = values.iter().find(|value| *value != first)?;
    let is_other = |value: &f64| if value == first { Some(false) } else { (value == other).then_some(true) };
    values.iter().map(is_other).collect()
}

/// ln of the number of choices of k from n; of none -∞.
fn ln_choose(n: f64, k: f64) -> f64 {
    match k {
        0.0.. if k <= n => ln_gamma(n + 1.0) - ln_gamma(k + 1.0) - ln_gamma(n - k + 1.0),
        _ => f64::NEG_INFINITY,
    }
}

/// Share of equal values from which a sum over neighbours is far from normal.
const MOSTLY_EQUAL: f64 = 0.75;

/// Probability of as few runs of the same kind, or fewer, in a row of two kinds.
fn of_runs(row: &[bool]) -> f64 {
    let found = 1 + row.windows(2).filter(|pair| pair[0] != pair[1]).count();
    let one = row.iter().filter(|kind| **kind).count() as f64;
    let other = row.len() as f64 - one;
    if one == 0.0 || other == 0.0 {
        return 1.0;
    }
    let all = ln_choose(one + other, one);
    // Divided into so many runs.
    let ways = |of: f64, runs: usize| ln_choose(of - 1.0, runs as f64 - 1.0);
    let probability = |runs: usize| {
        let (half, more) = (runs / 2, runs.div_ceil(2));
        let pair = |one_runs, other_runs| (ways(one, one_runs) + ways(other, other_runs) - all).exp();
        pair(half, more) + pair(more, half)
    };
    (2..=found).map(probability).sum::<f64>().min(1.0)
}

/// An input as tests take it.
pub(crate) struct Tested<'a> {
    pub(crate) values: &'a [f64],
    pub(crate) kind: Kind,
    pub(crate) steps: Space,
    /// Of its ranks, where these have a meaning.
    pub(crate) scores: Option<Scores>,
    /// Of their distances from the middle, if it has numbers.
    pub(crate) spread: Option<Scores>,
}

impl<'a> Tested<'a> {
    pub(crate) fn new(values: &'a [f64], kind: Kind, seed: u64) -> Self {
        let steps = Space::steps(values, kind, seed);
        let two = matches!(&steps, Space::Steps(_, sizes) if sizes.len() == 2);
        let scores = if kind == Kind::Numbers || two { Scores::of_ranks(values) } else { None };
        let spread = if kind == Kind::Numbers { Scores::of_spread(values) } else { None };
        Self { values, kind, steps, scores, spread }
    }

    /// The functions that a measure takes of it.
    pub(crate) fn space(&self, measure: Measure) -> Space {
        match (&self.scores, measure) {
            (Some(scores), Measure::Trend) => Space::Line(scores.clone()),
            _ => self.steps.clone(),
        }
    }
}

/// The least p times the number of tests.
pub(crate) fn bonferroni(all: &[f64]) -> f64 {
    all.iter().fold(1.0 / all.len().max(1) as f64, |least, p| p.min(least)) * all.len().max(1) as f64
}

/// What rows allow to test.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Tests {
    /// Everything.
    All,
    /// Trends and means of ranks by parts: rows of a sequence make patterns of all else.
    Means,
}

/// All tests of each input but HSIC.
pub(crate) fn tests(inputs: &[Tested], outputs: &[f64], which: Tests, seed: u64) -> Vec<Vec<Test>> {
    let (Some(scores), spread) = (Scores::of_ranks(outputs), Scores::of_spread(outputs)) else {
        return vec![vec![]; inputs.len()];
    };
    let pairs = which == Tests::All && (2..=MOST_OF_PAIRS).contains(&inputs.len());
    let products: Vec<Option<Scores>> =
        inputs.par_iter().map(|of| of.scores.as_ref().filter(|_| pairs)?.times(&scores)).collect();
    let of_input = |(number, input): (usize, &Tested)| {
        let mut tests = Vec::new();
        let mut add = |measure, p_value| tests.push(Test { measure, p_value });
        if let Some(ranks) = &input.scores {
            add(Measure::Trend, Space::Line(ranks.clone()).p_value(&scores));
        }
        add(Measure::Location, input.steps.p_value(&scores));
        if let Some(spread) = spread.as_ref().filter(|_| which == Tests::All) {
            add(Measure::Spread, input.steps.p_value(spread));
        }
        let others = products.iter().enumerate().filter(|(other, _)| *other != number);
        let together: Vec<f64> =
            others.filter_map(|(_, product)| Some(input.steps.p_value(product.as_ref()?))).collect();
        if !together.is_empty() {
            add(Measure::Together, bonferroni(&together));
        }
        let parts = matches!(&input.steps, Space::Steps(groups, sizes)
            if input.kind == Kind::Numbers && sizes.len() > 2 && groups.len() >= ROWS_OF_NEIGHBOURS);
        if parts && which == Tests::All {
            add(Measure::Neighbours, of_neighbours(input.values, &scores, seed));
        }
        tests
    };
    inputs.par_iter().enumerate().map(of_input).collect()
}
