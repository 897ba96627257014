//! Everything that a table says of one output: summary, fitted laws, and all measures beside each other.

use rand::seq::index::sample;
use serde::{Deserialize, Serialize};

use crate::design::observation::Observed;
use crate::error::{SensitivityError, check_level};
use crate::given::data::GivenData;
use crate::given::delta::{self, Delta};
use crate::given::expansion::{self, GivenExpansion, affordable};
use crate::given::halves::{self, Half};
use crate::given::hsic::{self, Dependence, Rows, dependence_of_event};
use crate::given::pawn::{self, Pawn};
use crate::given::rank;
use crate::law::fit::{Fit, fit_all};
use crate::law::verdict::BestFit;
use crate::measure::expansion::Shares;
use crate::measure::regression::{self, Of, ranks, standardised};
use crate::sample::interval::Estimate;
use crate::sample::random::{Bootstrap, derived_seed, stream};
use crate::sample::summary::{Sample, Summary, check_varies};

/// What the outputs are to satisfy.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schemars", derive(schemars::JsonSchema))]
#[serde(rename_all = "snake_case")]
pub enum Limit {
    /// They are to stay below this value.
    Below(f64),
    /// They are to be this value or less.
    AtMost(f64),
    /// They are to stay above this value.
    Above(f64),
    /// They are to be this value or more.
    AtLeast(f64),
}

impl Limit {
    /// Whether an output satisfies the limit.
    #[must_use]
    pub fn holds(&self, output: f64) -> bool {
        match *self {
            Self::Below(value) => output < value,
            Self::AtMost(value) => output <= value,
            Self::Above(value) => output > value,
            Self::AtLeast(value) => output >= value,
        }
    }
}

/// How a table is analysed.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Analyser {
    /// Confidence level of the intervals, in (0, 1).
    pub level: f64,
    /// Seed of all that is random.
    pub seed: u64,
    /// Largest number of rows of the dependences, whose time grows with the square.
    pub dependence_rows: usize,
    /// Limit whose failures are asked for.
    pub limit: Option<Limit>,
}

impl Analyser {
    /// Intervals of 95 %, dependences of 2000 rows, no limit.
    #[must_use]
    pub fn new(seed: u64) -> Self {
        Self { level: 0.95, seed, dependence_rows: 2000, limit: None }
    }
}

/// Largest number of rows of fits, PAWN, δ and expansion. If there are more, so many are drawn at random.
pub const MOST_ROWS: usize = 10_000;
/// Resamples of fits.
const FIT_RESAMPLES: usize = 199;
/// Least number of rows on either side of a limit.
const LEAST_FAILING: usize = 5;

/// What a table says of one output.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schemars", derive(schemars::JsonSchema))]
pub struct Analysis {
    /// Moments and extremes, in the unit of the output, and the number of failed observations.
    pub summary: Summary,
    /// Quantiles of 5 %, 50 % and 95 %, in the unit of the output.
    pub quantiles: [f64; 3],
    /// The law that fits best, and what the outputs say of it.
    pub best_fit: Option<BestFit>,
    /// Fitted laws, the best by Akaike's criterion first.
    pub fits: Vec<Fit>,
    /// Share of the variance that a linear model explains.
    pub r_squared: Option<f64>,
    /// Share of the variance of the ranks that a linear model of the ranks explains.
    pub rank_r_squared: Option<f64>,
    /// The polynomial model.
    pub expansion: Option<GivenExpansion>,
    /// The two inputs of the largest rank correlation, if there are two.
    pub most_correlated: Option<CorrelatedPair>,
    /// How often the limit fails.
    pub limit: Option<LimitFailures>,
    /// Measures of each input, in the order of the table.
    pub inputs: Vec<InputAnalysis>,
    /// What was left out, and why; what is not to be relied on.
    pub notes: Vec<String>,
}

/// Two inputs and the correlation of their ranks.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schemars", derive(schemars::JsonSchema))]
pub struct CorrelatedPair {
    /// Their names.
    pub inputs: [String; 2],
    /// Spearman's correlation, from -1 to 1.
    pub rank_correlation: f64,
}

/// How often a limit fails.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schemars", derive(schemars::JsonSchema))]
pub struct LimitFailures {
    /// The limit.
    pub limit: Limit,
    /// Number of observed outputs that do not satisfy it.
    pub count: usize,
    /// Their share, with its interval for independent rows.
    pub share: Estimate,
}

/// Measures of one input.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schemars", derive(schemars::JsonSchema))]
pub struct InputAnalysis {
    /// Name of the input.
    pub input: String,
    /// Upper half of its values against the lower half.
    pub half: Half,
    /// Standardised coefficient of values.
    pub standardised: Option<f64>,
    /// Standardised coefficient of ranks.
    pub rank_standardised: Option<f64>,
    /// First-order Sobol' index by ranks.
    pub first: Option<Estimate>,
    /// Shares of the variance by the polynomial model.
    pub shares: Option<Shares>,
    /// Dependence of the output.
    pub dependence: Option<Dependence>,
    /// PAWN index.
    pub pawn: Option<Pawn>,
    /// δ.
    pub delta: Option<Delta>,
    /// How it makes the limit fail.
    pub limit: Option<InputAtLimit>,
    /// Dependence of an observation's failure, where some failed.
    pub failure: Option<Dependence>,
}

/// How an input makes a limit fail.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schemars", derive(schemars::JsonSchema))]
pub struct InputAtLimit {
    /// Dependence of the failure of the limit (target HSIC).
    pub target: Dependence,
    /// Dependence of the output within the rows that fail (conditional HSIC).
    pub conditional: Option<Dependence>,
    /// Share of all values of the input below the median of those that fail: 0.5 without a relation, near 1
    /// where large values fail.
    pub place: f64,
}

impl Analyser {
    /// Analyses a table.
    ///
    /// Whatever cannot be computed from it is left out, with the reason among the notes.
    ///
    /// # Errors
    /// [`SensitivityError::OutOfRange`] for fewer than two outputs, [`SensitivityError::ConstantSample`] if
    /// all are equal, [`SensitivityError::InvalidParameter`] for a level outside (0, 1).
    pub fn analyse(&self, data: &GivenData) -> Result<Analysis, SensitivityError> {
        check_level(self.level)?;
        let observed = data.observed(2)?;
        let mut notes = Notes(Vec::new());
        let seed = |part: u64| derived_seed(self.seed, part);
        let drawn = thinned(&observed, seed(0));
        if drawn.outputs.len() < observed.outputs.len() {
            notes.0.push(format!(
                "fits, PAWN, delta and expansion are of {} rows drawn at random, dependences of {}",
                drawn.outputs.len(),
                self.dependence_rows.min(observed.outputs.len())
            ));
        }
        let names: Vec<&str> = data.names().iter().map(String::as_str).collect();
        let sample = Sample::new(data.outputs())?;
        let fits = fit_all(
            &Sample::of_values(&drawn.outputs)?,
            Bootstrap { resamples: FIT_RESAMPLES, seed: seed(1) },
        );
        let fits = notes.unless("fitted laws", fits).unwrap_or_default();
        let [of_values, of_ranks] = [(Of::Values, "regression"), (Of::Ranks, "rank regression")]
            .map(|(of, label)| notes.unless(label, regression_of_varying(&names, &observed, of)));
        let first = rank::of_observed(&observed, self.level, seed(2));
        let first = notes.unless("first-order indices", enough(&observed, rank::MIN_ROWS).and(first));
        let rows = Rows { most: self.dependence_rows, seed: seed(3) };
        let dependence = hsic::of_output(&observed.columns, &observed.outputs, rows);
        let dependence = notes.unless("dependence", dependence);
        let enough_rows = enough(&observed, pawn::MIN_ROWS);
        let pawn = notes.unless(
            "PAWN",
            enough_rows.clone().map(|()| pawn::of_columns(&drawn.columns, &drawn.outputs, seed(4))),
        );
        let delta =
            enough_rows.and_then(|()| delta::of_columns(&drawn.columns, &drawn.outputs, self.level, seed(5)));
        let delta = notes.unless("delta", delta);
        let truncation = affordable(names.len(), drawn.outputs.len());
        let expansion = enough(&drawn, crate::measure::expansion::Expansion::MIN_OUTPUTS)
            .and_then(|()| expansion::of_observed(&drawn, truncation));
        let expansion = notes.unless("expansion", expansion);
        let most_correlated = most_correlated(&names, &drawn);
        notes.warn_of_correlation(most_correlated.as_ref(), drawn.outputs.len());
        let limit = self.limit.map(|limit| self.at_limit(limit, &observed, rows, &mut notes)).transpose()?;
        let failure = failure(data, rows);
        let halves = halves::of_observed(&observed);
        let shares = expansion.as_ref().filter(|expansion| !expansion.terms.is_empty());
        let input = |i: usize| InputAnalysis {
            input: names[i].to_owned(),
            half: halves[i],
            standardised: of_values.as_ref().map(|found| found.1[i]),
            rank_standardised: of_ranks.as_ref().map(|found| found.1[i]),
            first: first.as_ref().map(|first| first[i]),
            shares: shares.map(|expansion| expansion.shares(i)),
            dependence: dependence.as_ref().map(|dependence| dependence[i]),
            pawn: pawn.as_ref().map(|pawn| pawn[i]),
            delta: delta.as_ref().map(|delta| delta[i]),
            limit: limit.as_ref().and_then(|(_, inputs)| inputs.get(i).copied()),
            failure: failure.as_ref().map(|failure| failure[i]),
        };
        let quantile = |p: f64| sample.quantile(p);
        Ok(Analysis {
            summary: sample.summary(),
            quantiles: [quantile(0.05)?, quantile(0.5)?, quantile(0.95)?],
            best_fit: BestFit::of(&fits),
            fits,
            r_squared: of_values.as_ref().map(|found| found.0),
            rank_r_squared: of_ranks.as_ref().map(|found| found.0),
            inputs: (0..names.len()).map(input).collect(),
            expansion,
            most_correlated,
            limit: limit.map(|(failures, _)| failures),
            notes: notes.0,
        })
    }

    /// How often the limit fails, and how each input makes it fail, if enough rows are on both of its sides.
    fn at_limit(
        &self,
        limit: Limit,
        observed: &Observed,
        rows: Rows,
        notes: &mut Notes,
    ) -> Result<(LimitFailures, Vec<InputAtLimit>), SensitivityError> {
        let (n, columns) = (observed.outputs.len(), &observed.columns);
        let fails: Vec<bool> = observed.outputs.iter().map(|&output| !limit.holds(output)).collect();
        let count = fails.iter().filter(|fails| **fails).count();
        let failures = LimitFailures { limit, count, share: Estimate::of_share(count, n, self.level)? };
        if count.min(n - count) < LEAST_FAILING {
            notes.0.push(format!(
                "causes at the limit: {count} of {n} rows fail, {LEAST_FAILING} are needed on \
                                  either side"
            ));
            return Ok((failures, vec![]));
        }
        let target = dependence_of_event(columns, &fails, rows)?;
        let within = |values: &[f64]| -> Vec<f64> {
            values.iter().zip(&fails).filter(|(_, fails)| **fails).map(|(value, _)| *value).collect()
        };
        let columns_within: Vec<Vec<f64>> = columns.iter().map(|column| within(column)).collect();
        let conditional = hsic::of_output(&columns_within, &within(&observed.outputs), rows);
        let conditional = notes.unless("dependence among the rows that fail", conditional);
        let input = |i: usize| InputAtLimit {
            target: target[i],
            conditional: conditional.as_ref().map(|conditional| conditional[i]),
            place: place(&columns[i], &columns_within[i]),
        };
        Ok((failures, (0..columns.len()).map(input).collect()))
    }
}

struct Notes(Vec<String>);

impl Notes {
    /// The result, or a note of why it is left out.
    fn unless<T>(&mut self, label: &str, result: Result<T, SensitivityError>) -> Option<T> {
        result.map_err(|error| self.0.push(format!("{label}: {error}"))).ok()
    }

    fn warn_of_correlation(&mut self, pair: Option<&CorrelatedPair>, n: usize) {
        let Some(CorrelatedPair { inputs: [one, other], rank_correlation }) = pair else { return };
        if rank_correlation.abs() > (4.5 / (n as f64).sqrt()).max(0.1) {
            self.0.push(format!(
                "inputs `{one}` and `{other}` are correlated ({rank_correlation:.2}): first-order indices, \
                 shares and dependences count for each what they cause together"
            ));
        }
    }
}

fn enough(observed: &Observed, minimum: usize) -> Result<(), SensitivityError> {
    let n = observed.outputs.len() as u64;
    crate::error::check_range("observed outputs", n, minimum as u64, u64::MAX)
}

/// At most [`MOST_ROWS`] rows.
fn thinned(observed: &Observed, seed: u64) -> Observed {
    let n = observed.outputs.len();
    if n <= MOST_ROWS {
        return observed.clone();
    }
    let mut rows = sample(&mut stream(seed, 0), n, MOST_ROWS).into_vec();
    rows.sort_unstable();
    let select = |values: &[f64]| -> Vec<f64> { rows.iter().map(|&row| values[row]).collect() };
    Observed {
        columns: observed.columns.iter().map(|column| select(column)).collect(),
        outputs: select(&observed.outputs),
        failed: observed.failed,
    }
}

/// R² and the coefficient of each input. That of a constant input is 0.
fn regression_of_varying(
    names: &[&str],
    observed: &Observed,
    of: Of,
) -> Result<(f64, Vec<f64>), SensitivityError> {
    let varies: Vec<bool> = observed.columns.iter().map(|column| check_varies(column).is_ok()).collect();
    let varying = || (0..names.len()).filter(|&i| varies[i]);
    let found = regression::of_observed(
        &varying().map(|i| names[i]).collect::<Vec<_>>(),
        Observed {
            columns: varying().map(|i| observed.columns[i].clone()).collect(),
            outputs: observed.outputs.clone(),
            failed: observed.failed,
        },
        of,
    )?;
    let mut coefficients = vec![0.0; names.len()];
    varying().zip(&found.inputs).for_each(|(i, input)| coefficients[i] = input.standardised);
    Ok((found.r_squared, coefficients))
}

/// The pair of the largest rank correlation.
fn most_correlated(names: &[&str], observed: &Observed) -> Option<CorrelatedPair> {
    let columns: Vec<Option<Vec<f64>>> =
        observed.columns.iter().map(|column| standardised(ranks(column))).collect();
    let mut largest: Option<([usize; 2], f64)> = None;
    for (i, one) in columns.iter().enumerate() {
        for (j, other) in columns.iter().enumerate().skip(i + 1) {
            let Some((one, other)) = one.as_ref().zip(other.as_ref()) else { continue };
            let product: f64 = one.iter().zip(other).map(|(x, y)| x * y).sum();
            let correlation = product / (one.len() as f64 - 1.0);
            if largest.is_none_or(|(_, known)| correlation.abs() > known.abs()) {
                largest = Some(([i, j], correlation));
            }
        }
    }
    let (pair, rank_correlation) = largest?;
    Some(CorrelatedPair { inputs: pair.map(|i| names[i].to_owned()), rank_correlation })
}

/// Dependence of a failed observation on each input, where at least [`LEAST_FAILING`] failed.
fn failure(data: &GivenData, rows: Rows) -> Option<Vec<Dependence>> {
    let failed: Vec<bool> = data.outputs().iter().map(Option::is_none).collect();
    let count = failed.iter().filter(|failed| **failed).count();
    if count.min(failed.len() - count) < LEAST_FAILING {
        return None;
    }
    dependence_of_event(data.columns(), &failed, rows).ok()
}

/// Share of values below the median of some of them; values equal to it count by half.
fn place(all: &[f64], some: &[f64]) -> f64 {
    let mut some = some.to_vec();
    let middle = some.len() / 2;
    let (_, &mut median, _) = some.select_nth_unstable_by(middle, f64::total_cmp);
    let weight = |x: &f64| match x.total_cmp(&median) {
        std::cmp::Ordering::Less => 1.0,
        std::cmp::Ordering::Equal => 0.5,
        std::cmp::Ordering::Greater => 0.0,
    };
    all.iter().map(weight).sum::<f64>() / all.len() as f64
}
