//! Everything that a table says of one output: summary, fitted laws, and all measures beside each other.

use serde::{Deserialize, Serialize};

use crate::error::{SensitivityError, check_level, check_range};
use crate::given::data::GivenData;
use crate::given::delta::Delta;
use crate::given::expansion::GivenExpansion;
use crate::given::halves::Half;
use crate::given::hsic::{self, Dependence};
use crate::given::levels::LevelMean;
use crate::given::limit::{AtLimit, InputAtLimit, Limit, LimitFailures};
use crate::given::measures::{Notes, Work};
use crate::given::pawn::Pawn;
use crate::given::verdict::Verdict;
use crate::law::fit::{Fit, fit_all};
use crate::law::verdict::BestFit;
use crate::measure::expansion::Shares;
use crate::sample::interval::Estimate;
use crate::sample::random::Bootstrap;
use crate::sample::summary::{Sample, Summary};

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
    /// Number of outputs of the table: doubts of its inputs are corrected for all of them together.
    pub outputs: usize,
}

impl Analyser {
    /// Least number of rows of the dependences.
    pub const LEAST_DEPENDENCE_ROWS: usize = hsic::MIN_ROWS;
    /// Largest number of rows of the dependences.
    pub const MOST_DEPENDENCE_ROWS: usize = hsic::MOST_ROWS;

    /// Checks a number of inputs before their values are put together.
    ///
    /// # Errors
    /// [`SensitivityError::OutOfRange`] for none, and for more than [`MOST_INPUTS`].
    pub fn check_inputs(count: usize) -> Result<(), SensitivityError> {
        check_range("inputs", count as u64, 1, MOST_INPUTS as u64)
    }

    /// Intervals of 95 %, dependences of 2000 rows, no limit, a single output.
    #[must_use]
    pub fn new(seed: u64) -> Self {
        Self { level: 0.95, seed, dependence_rows: 2000, limit: None, outputs: 1 }
    }
}

/// Largest number of rows of fits, PAWN, δ and expansion. If there are more, so many are drawn at random.
pub const MOST_ROWS: usize = 10_000;
/// Largest number of inputs of an analysis.
pub const MOST_INPUTS: usize = 1000;
/// Resamples of fits.
const FIT_RESAMPLES: usize = 199;
/// What a table says of one output.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schemars", derive(schemars::JsonSchema))]
pub struct Analysis {
    /// Confidence level of the intervals.
    pub level: f64,
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
    /// Which inputs matter.
    pub verdict: Verdict,
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

/// Measures of one input. A constant input has none.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schemars", derive(schemars::JsonSchema))]
pub struct InputAnalysis {
    /// Name of the input.
    pub input: String,
    /// Upper half of its values against the lower half; an input of words has none.
    pub half: Option<Half>,
    /// Mean outputs of the levels of an input of words.
    pub levels: Vec<LevelMean>,
    /// Standardized coefficient of values.
    pub standardized: Option<f64>,
    /// Standardized coefficient of ranks.
    pub rank_standardized: Option<f64>,
    /// First-order Sobol' index by ranks, or by levels where these are few.
    pub first: Option<Estimate>,
    /// Shares of the variance by the polynomial model, if it explains at least half of it.
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

impl Analyser {
    /// Analyses a table.
    ///
    /// Whatever cannot be computed from it is left out, with the reason among the notes.
    ///
    /// # Errors
    /// [`SensitivityError::OutOfRange`] for fewer than two outputs, more than [`MOST_INPUTS`] inputs, or
    /// dependences of more than [`hsic::MOST_ROWS`] rows, [`SensitivityError::ConstantSample`] if all outputs
    /// are equal, [`SensitivityError::InvalidParameter`] for a level outside (0, 1).
    pub fn analyse(&self, data: &GivenData) -> Result<Analysis, SensitivityError> {
        check_level(self.level)?;
        let most = self.dependence_rows as u64;
        check_range("dependence_rows", most, hsic::MIN_ROWS as u64, hsic::MOST_ROWS as u64)?;
        Self::check_inputs(data.names().len())?;
        let all = data.observed(2)?;
        let work = Work::new(*self, data, &all);
        let mut notes = Notes(Vec::new());
        let fitted = work.fitted();
        if fitted.len() < work.outputs.len() {
            notes.0.push(format!("fits are of {} rows drawn at random", fitted.len()));
        }
        if work.drawn.outputs.len() < work.observed.outputs.len() {
            notes.0.push(format!(
                "PAWN, delta and expansion are of {} rows drawn at random, dependences of {}",
                work.drawn.outputs.len(),
                self.dependence_rows.min(work.observed.outputs.len())
            ));
        }
        let sample = Sample::new(data.outputs())?;
        let fits =
            fit_all(&Sample::of_values(&fitted)?, Bootstrap { resamples: FIT_RESAMPLES, seed: work.seed(1) });
        let fits = notes.unless("fitted laws", fits).unwrap_or_default();
        let expansion = work.expansion(&mut notes);
        let (linear, inputs, dependence) = work.inputs(data, expansion.as_ref(), &mut notes);
        let limit = self.limit.map(|limit| {
            let (rows, level) = (work.rows(), self.level);
            let (outputs, observed) = (&work.outputs[..], &work.observed);
            AtLimit { limit, outputs, observed, kinds: &work.kinds, rows, level }.found(&mut notes.0)
        });
        let limit = limit.transpose()?;
        let verdict = work.verdict(data, &all, dependence.as_deref());
        let mut inputs: Vec<InputAnalysis> = inputs;
        for (place, &input) in work.varying.iter().enumerate() {
            inputs[input].limit = limit.as_ref().and_then(|(_, inputs)| inputs.get(place).copied());
        }
        let quantile = |p: f64| sample.quantile(p);
        Ok(Analysis {
            level: self.level,
            summary: sample.summary(),
            quantiles: [quantile(0.05)?, quantile(0.5)?, quantile(0.95)?],
            best_fit: BestFit::of(&fits),
            fits,
            r_squared: linear[0],
            rank_r_squared: linear[1],
            verdict,
            inputs,
            expansion,
            most_correlated: work.most_correlated(),
            limit: limit.map(|(failures, _)| failures),
            notes: notes.0,
        })
    }
}

impl Analyser {
    /// Which inputs matter: the verdict of [`Analyser::analyse`] alone.
    ///
    /// # Errors
    /// As there.
    pub fn verdict(&self, data: &GivenData) -> Result<Verdict, SensitivityError> {
        let most = self.dependence_rows as u64;
        check_range("dependence_rows", most, hsic::MIN_ROWS as u64, hsic::MOST_ROWS as u64)?;
        Self::check_inputs(data.names().len())?;
        let all = data.observed(2)?;
        Ok(Work::new(*self, data, &all).verdict(data, &all, None))
    }
}
