//! Tolerance budgets: which tolerances to tighten so that a quantile of an error stays below a limit, and by
//! how much.
//!
//! A *tolerance* is an entry of a sampling's error model: one for all exit points if the model has one law
//! for them. Tightened to the share s, deviations keep their law about its mean at s times the distance. With
//! y the error, `y0` that of the robot whose deviations are the means, and J its exact derivatives there,
//!
//! ```text
//! v_j = sum over the inputs i of tolerance j:  |J_i|² var_i                            (B1)
//! quantile(s) = y0 + κ √(sum v_j s_j²)                                                 (B2)
//! ```
//!
//! defines κ, which is constant for a linear model and hardly changes otherwise. A sample at the current s
//! gives κ; κ and the limit give the admissible variance; this gives the cheapest s
//! (`tolerance/purchase.rs`). A few rounds suffice. Independent draws then verify what the budget reaches.
//!
//! The weather of a study is drawn as it is: no money makes it calmer. With yw the quantile in the weather of
//! robots without deviations, and the sum over all other tolerances,
//!
//! ```text
//! quantile(s) = √(yw² + κ² sum v_j s_j²)                                               (B3)
//! ```

mod drawn;
mod limit;
mod market;
mod purchase;
mod rounds;
mod verdict;

use crate::error::AssessError;
use cdpr_sensitivity::{Estimate, SensitivityError};
use cdpr_statics::{Load, StaticsError};
use cdpr_study::{LinearLaw, Sampling, StudyError, explained, observe_rows};
pub use limit::{Limit, Limited};
use market::{Entries, Market};
use purchase::Way;
use rounds::Settled;
use serde::Serialize;

/// Which tolerances to tighten for a limit.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct ToleranceBudget {
    /// The error.
    pub of: Limited,
    /// Its limit [mm].
    pub limit_mm: f64,
    /// Share of the robots that are to keep it.
    pub quantile: f64,
    /// The error without any deviation from the means [mm]: no tolerance goes below it.
    pub least_mm: f64,
    /// The quantile of the error [mm] that the weather alone leaves, where it deviates.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub weather_mm: Option<f64>,
    /// Share of the variance of the error, as the tolerances are, that the linear law behind (B1) explains.
    pub explained: Option<f64>,
    /// All tolerances, those to tighten most first.
    pub tolerances: Vec<Tolerance>,
    /// Result of the tolerances as they are.
    pub now: Reached,
    /// Result of the tightened tolerances.
    pub tightened: Reached,
    /// Sum of the costs, now and after tightening, calibrations included.
    pub cost: [f64; 2],
    /// Whether the costs are the prices of the study.
    #[serde(skip)]
    pub priced: bool,
    /// Calibrations that have a price.
    pub calibrations: Vec<PricedCalibration>,
    /// Rounds of sampling until the factors settled.
    pub rounds: usize,
}

/// One tolerance of a budget.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Tolerance {
    /// Entry of the error model.
    pub name: String,
    /// Standard deviation now, in the unit of the deviation.
    pub std: f64,
    /// Share of the variance that it causes, to first order.
    pub share: f64,
    /// Predicted quantile [mm] if it alone is halved.
    pub halved_mm: f64,
    /// Factor of the tolerance, above 0; 1 if it may stay as it is.
    pub factor: f64,
    /// Cost as it is. Zero of the weather, and without a price.
    pub cost: f64,
    /// Cost with the factor.
    pub cost_then: f64,
    /// By what it has its factor: "grade", "calibration", or "least", the narrowest that is for sale; `None`
    /// where it is as it is, or as narrow as is best.
    pub by: Option<&'static str>,
    /// By how much the quantile falls for a further unit of its cost, to first order [mm]: the same for all
    /// that are as narrow as is best. `None` where it has no price or is a grade or of a calibration.
    pub mm_per_cost: Option<f64>,
    /// Whether it is a number of the weather, which stays as it is.
    #[serde(skip_serializing_if = "std::ops::Not::not")]
    pub weather: bool,
}

/// A calibration that has a price.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct PricedCalibration {
    /// Its name.
    pub name: String,
    /// Its cost.
    pub cost: f64,
    /// Whether it is worth its cost.
    pub bought: bool,
    /// By how much the cheapest purchase with it is cheaper than the cheapest one without it; `None` where
    /// none without it keeps the limit.
    pub saves: Option<f64>,
}

/// Results of independent draws of the deviations, with intervals at the study's confidence.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Reached {
    /// The quantile [mm]; robots without feasible tensions count as beyond it.
    pub quantile_mm: Estimate,
    /// Share of the robots within the limit.
    pub within: Estimate,
    /// Robots drawn.
    pub robots: usize,
    /// Robots without feasible tensions; they count as beyond the limit.
    pub failed: usize,
}

/// Robots of a round of sampling.
const ROUND: usize = 1 << 12;
/// The same in weather, where robots are observed one by one.
const ROUND_IN_WEATHER: usize = 1 << 9;
/// Robots of a round that say how much the linear law explains.
const EXPLAINED: usize = 512;
/// Robots that are observed first.
const FIRST: usize = 64;
/// Confidence at which too many robots fail for the quantile.
const CERTAIN: f64 = 1.0 - 1e-9;

/// Finds the cheapest tightening of a sampling's tolerances by which `limit` is kept.
///
/// # Errors
/// [`AssessError::Study`] for an invalid limit, quantile, cost or count, for an output of the study that is
/// neither deflection nor position unless the limit names one, and for correlated inputs;
/// [`AssessError::Unreachable`] for a limit that no tightening reaches; [`AssessError::Unobservable`] where
/// the robot without deviations, or too many robots of a sample, have no feasible tensions.
pub fn tolerance_budget(sampling: &Sampling, limit: &Limit) -> Result<ToleranceBudget, AssessError> {
    let model = Model::new(sampling, limit)?;
    let entries = Entries {
        names: &model.names,
        stds: &model.stds,
        variances: &model.variances,
        weather: &model.weather,
    };
    let market = Market::of(sampling, limit, &entries)?;
    let weather_mm = model.of_weather_alone()?;
    let settled = model.settled(&market, weather_mm)?;
    let Settled { bought, about, stays, .. } = &settled;
    let factors = bought.shares();
    let unmoved = vec![1.0; model.names.len()];
    let total: f64 = model.parts.iter().sum();
    let tightened: f64 = model.variances.iter().sum();
    let halved = |part: f64| {
        let excess = settled.first * (tightened - 0.75 * part);
        about + (stays * stays + if tightened > 0.0 { excess } else { 0.0 }).sqrt()
    };
    // By (B3), the quantile changes by so much for each unit of the variance.
    let per_variance = settled.inflation / (2.0 * (limit.limit_mm - about));
    let tolerance = |(j, (way, factor)): (usize, &(Way, f64))| Tolerance {
        name: model.names[j].clone(),
        std: model.stds[j],
        share: model.parts[j] / total,
        halved_mm: halved(model.variances[j]),
        factor: *factor,
        cost: market.offers.tolerances[j].1[0].cost,
        cost_then: way.cost_at(*factor),
        by: way.name.or((way.within[0] == *factor && *factor < 1.0).then_some("least")),
        mm_per_cost: way
            .variance_per_cost(*factor, model.variances[j])
            .map(|of| per_variance * of)
            .filter(|of| of.is_finite()),
        weather: model.weather[j],
    };
    let mut tolerances: Vec<Tolerance> = bought.tolerances.iter().enumerate().map(tolerance).collect();
    tolerances
        .sort_by(|one, other| one.factor.total_cmp(&other.factor).then(other.share.total_cmp(&one.share)));
    Ok(ToleranceBudget {
        of: model.of,
        limit_mm: limit.limit_mm,
        quantile: limit.quantile,
        least_mm: model.least_mm,
        weather_mm,
        explained: model.explained(&unmoved)?,
        cost: [tolerances.iter().map(|one| one.cost).sum(), bought.cost],
        priced: market.has_prices,
        calibrations: model.calibrations(&market, &settled)?,
        now: model.verify(&unmoved, 1)?,
        tightened: model.verify(&factors, 2)?,
        tolerances,
        rounds: settled.rounds,
    })
}

/// Variance after tightening.
fn left(variances: &[f64], factors: &[f64]) -> f64 {
    variances.iter().zip(factors).map(|(variance, factor)| variance * factor * factor).sum()
}

/// A sampling's tolerances and their error.
struct Model<'a> {
    sampling: &'a Sampling<'a>,
    limit: &'a Limit,
    of: Limited,
    names: Vec<String>,
    /// Largest standard deviation of the inputs of a tolerance.
    stds: Vec<f64>,
    /// The error to first order about the means of the inputs.
    law: LinearLaw,
    /// Equation (B1) [mm²].
    parts: Vec<f64>,
    /// The same of those that can be tightened, zero of the weather.
    variances: Vec<f64>,
    /// Which of them are numbers of the weather.
    weather: Vec<bool>,
    /// Tolerance of each input, and the mean of its law.
    inputs: Vec<(usize, f64)>,
    least_mm: f64,
}

impl<'a> Model<'a> {
    fn new(sampling: &'a Sampling<'a>, limit: &'a Limit) -> Result<Self, AssessError> {
        limit.check()?;
        let of = Limited::of(limit.of, sampling.output())?;
        let in_weather = sampling.observer.is_in_weather(&sampling.errors);
        if of == Limited::Deflection && sampling.load == Load::none() && !in_weather {
            let expected = "a mass above zero [kg], whose effect is the deflection";
            return Err(StudyError::setting("the study's payload", 0.0, expected).into());
        }
        if sampling.correlation.is_some() {
            let expected = "none: the variance of correlated tolerances is not the sum of their parts (B1)";
            let field = format!("samplings.{}.correlations", sampling.name);
            return Err(StudyError::setting(field, "given", expected).into());
        }
        let errors = &sampling.errors;
        let mut names: Vec<String> = Vec::new();
        let (mut inputs, mut weather) = (Vec::new(), Vec::new());
        for (number, (entry, input)) in errors.entries.iter().zip(&errors.inputs).enumerate() {
            let known = names.iter().position(|name| name == entry).unwrap_or(names.len());
            if known == names.len() {
                names.push(entry.clone());
                weather.push(errors.is_of_weather(number));
            }
            inputs.push((known, input.mean()));
        }
        let mut model = Self {
            sampling,
            limit,
            of,
            stds: vec![0.0; names.len()],
            parts: vec![0.0; names.len()],
            variances: Vec::new(),
            weather,
            names,
            law: LinearLaw { about: Vec::new(), value: Vec::new(), slopes: Vec::new() },
            inputs,
            least_mm: 0.0,
        };
        let unobservable = |source| match source {
            StaticsError::NoDerivative { .. } => {
                let (field, output) = (format!("samplings.{}", sampling.name), of.output().noun());
                StudyError::setting(field, output, format!("one with a known derivative: {source}")).into()
            }
            source => AssessError::Unobservable {
                what: "the robot whose deviations are the means of their laws".to_owned(),
                source: Some(Box::new(source)),
            },
        };
        model.law = model.linear().map_err(unobservable)?;
        let least = model.law.nominal();
        model.least_mm = least;
        let parts = model.law.squares();
        for ((tolerance, _), (input, part)) in model.inputs.iter().zip(errors.inputs.iter().zip(parts)) {
            let std = input.std();
            model.parts[*tolerance] += part * std * std;
            model.stds[*tolerance] = model.stds[*tolerance].max(std);
        }
        let tightened = model.parts.iter().zip(&model.weather);
        model.variances = tightened.map(|(part, weather)| if *weather { 0.0 } else { *part }).collect();
        if limit.limit_mm <= least && !model.weather.contains(&true) {
            let reason = match model.of {
                Limited::Deflection => "it is not above the deflection without any deviation",
                Limited::Position => "it is not above the position error without any deviation",
            };
            return Err(model.unreachable(reason, least));
        }
        Ok(model)
    }

    /// The error [mm] to first order about the means of the inputs.
    fn linear(&self) -> Result<LinearLaw, StaticsError> {
        let Sampling { robot, errors, observer, .. } = self.sampling;
        let about: Vec<f64> = self.inputs.iter().map(|(_, mean)| *mean).collect();
        if let Some(found) = observer.slopes_in_weather(errors, &about, self.of.output()) {
            let (value, slopes) = found?;
            return Ok(LinearLaw { about, value: vec![value], slopes: vec![slopes] });
        }
        let perturbed = robot.perturbed(errors.deviations(&about).values())?;
        let gradient =
            |slopes: &[f64]| errors.gradient(slopes).into_iter().map(|slope| 1e3 * slope).collect();
        let (value, slopes): (Vec<f64>, Vec<Vec<f64>>) = match self.of {
            Limited::Deflection => {
                let (magnitude, slopes) = observer.magnitude_slopes(&perturbed)?;
                (vec![magnitude], vec![gradient(&slopes)])
            }
            Limited::Position => {
                let (displaced, slopes) = observer.displaced_slopes(&perturbed, errors)?;
                let row = |axis| gradient(&slopes.row(axis).iter().copied().collect::<Vec<_>>());
                (displaced.iter().copied().collect(), [0, 1, 2].map(row).to_vec())
            }
        };
        Ok(LinearLaw { about, value: value.into_iter().map(|x| 1e3 * x).collect(), slopes })
    }

    /// Share of the variance of the error that its linear law explains, of the first robots of a round.
    fn explained(&self, factors: &[f64]) -> Result<Option<f64>, AssessError> {
        let design = self.round()?;
        let pairs = observe_rows(&design, 0..EXPLAINED, |rows| {
            let width = self.inputs.len();
            let linear: Vec<f64> = rows.chunks_exact(width).map(|row| self.law.at(row)).collect();
            let outcomes = self.outcomes(rows, factors).into_iter();
            linear.into_iter().zip(outcomes.map(|outcome| outcome.ok().map(|metres| 1e3 * metres))).collect()
        });
        let pairs: Vec<_> =
            pairs.into_iter().filter_map(|(linear, observed)| Some((linear, observed?))).collect();
        Ok(explained(&pairs))
    }

    /// What each calibration saves, at the variance that was aimed at.
    fn calibrations(
        &self,
        market: &Market,
        settled: &Settled,
    ) -> Result<Vec<PricedCalibration>, AssessError> {
        let each = market.calibrations.iter().zip(&market.offers.calibrations).enumerate();
        let of = |(k, (name, cost)): (usize, (&String, &f64))| {
            let costs = |bought: bool| {
                let decided: Vec<_> =
                    (0..market.calibrations.len()).map(|i| (i == k).then_some(bought)).collect();
                let found = self.bought(market, settled.aim.unwrap_or(f64::INFINITY), &decided)?;
                Ok::<_, AssessError>(found.map(|found| found.cost))
            };
            let (with, without) = (costs(true)?, costs(false)?);
            let saves = with.zip(without).map(|(with, without)| without - with);
            let bought = settled.bought.calibrations[k];
            Ok(PricedCalibration { name: name.clone(), cost: *cost, bought, saves })
        };
        each.map(of).collect()
    }

    fn unreachable(&self, reason: &'static str, reached_mm: f64) -> AssessError {
        AssessError::Unreachable { limit_mm: self.limit.limit_mm, reason, reached_mm }
    }

    fn wrong(&self, source: SensitivityError) -> StudyError {
        let field = format!("samplings.{}", self.sampling.name);
        StudyError::Statistics { path: self.sampling.study.path.clone(), field, source }
    }
}
