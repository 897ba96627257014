//! Measures of sensitivity beside each other: the value of each for every input of a sampling, the
//! observations on which it rests, and where they agree. The output is that of the
//! study, in its unit.
//!
//! | method | result | input |
//! |---|---|---|
//! | `t_student` | t-Student index and signed effect | first observations of the sampling |
//! | `derivatives` | share of the variance, to first order | derivatives at the nominal robot, variances of the laws |
//! | `regression`, `rank_regression` | squared coefficients of values and ranks | first observations |
//! | `morris` | mean absolute elementary effect and deviation of the effects | radial blocks |
//! | `dgsm` | bound on the total index | exact derivatives at points of a scrambled Sobol sequence |
//! | `expansion` | first-order and total indices of a polynomial model | first observations |
//! | `sobol` | indices of the first order and total, with intervals | Saltelli's blocks |
//!
//! Derivatives and polynomials take the continuous laws: steps of h in a uniform range R change a variance by
//! a relative (h / R)². All observations are of the stepped inputs.

use crate::analysis::measures::{InputMeasures, MEASURES, Measure, Quantity};
use crate::error::StudyError;
use crate::file::study_file::{SensitivitySpec, StudyFile};
use crate::model::designs::{MORRIS, Points, SALTELLI};
use crate::model::study::Sampling;
use crate::observe::observation::{Session, Tally, observe_values};
use cdpr_sensitivity::{
    Bootstrap, Input, Regression, SampleDesign, SensitivityError, Slopes, SobolDesign, dgsm, expansion,
    morris_effects, rank_correlation, rank_regression, regression, sobol_indices, student_effects,
};
use cdpr_statics::StaticsError;
use indexmap::IndexMap;
use rayon::prelude::*;
use serde::{Deserialize, Serialize};
use std::error::Error;
use std::time::Instant;

/// Measures of all inputs of a sampling; serialised into `summary.json`.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct SensitivitySummary {
    /// Values of the measures for each input, in the order of the parameter vector.
    pub inputs: Vec<InputMeasures>,
    /// The basis of each method; methods that failed are named in the notes instead.
    pub methods: IndexMap<String, MethodSummary>,
    /// Sums of each share of the variance over the inputs of a group (`a`, `b`, `mass`, ...), and over all of
    /// them (`all`).
    pub sums: IndexMap<String, IndexMap<String, f64>>,
    /// Where the measures agree.
    pub agreement: Agreement,
    /// What could not be measured, and why.
    pub notes: Vec<String>,
}

/// The observations on which a method rests, and how well it explains the output.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct MethodSummary {
    /// Observations made, failed ones included; each with its derivatives for `derivatives` and `dgsm`.
    pub observations: usize,
    /// Those that failed.
    pub failed: usize,
    /// Saltelli's blocks with a failed observation. It is missed by the indices of one input only, unless it
    /// is one of the two points on which all inputs of a block rest.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub failed_blocks: Option<usize>,
    /// Whether the intervals of Sobol' indices have their confidence: they have from 64 blocks on.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub reliable: Option<bool>,
    /// Share of the variance that a linear model explains.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub r_squared: Option<f64>,
    /// Share of the variance that the expansion does not predict: its corrected leave-one-out error.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub leave_one_out: Option<f64>,
    /// Wall time [s]; not in files, which are the same from run to run.
    #[serde(skip)]
    pub seconds: f64,
}

/// What the measures agree on.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Agreement {
    /// How many inputs count as leading: ten, or half of them if that is less.
    pub first: usize,
    /// Inputs that every measure below puts above zero and among its `first` largest.
    pub inputs: Vec<String>,
    /// The measures compared, one for each method that has not failed.
    pub measures: Vec<String>,
    /// Spearman's rank correlation over all inputs, of each of these measures with each; `None` with one that
    /// does not vary.
    pub rank_correlation: Vec<Vec<Option<f64>>>,
}

/// Most inputs that count as leading.
const LEADING: usize = 10;

/// The data of a method.
struct Run<'a> {
    sampling: &'a Sampling<'a>,
    spec: &'a SensitivitySpec,
    settings: &'a StudyFile,
    tally: &'a Tally,
    session: &'a Session<'a>,
}

/// Fills in the fields of a method for all inputs, unless it fails.
type Method = fn(&Run, &mut [InputMeasures]) -> Result<MethodSummary, Box<dyn Error>>;

const METHODS: [(&str, Method); 8] = [
    ("t_student", t_student),
    ("derivatives", nominal_derivatives),
    ("regression", |run, inputs| {
        regress(run, inputs, regression, |input, share| input.regression_share = Some(share))
    }),
    ("rank_regression", |run, inputs| {
        regress(run, inputs, rank_regression, |input, share| input.rank_regression_share = Some(share))
    }),
    ("morris", morris),
    ("dgsm", derivative_bounds),
    ("expansion", chaos_expansion),
    ("sobol", sobol),
];

/// Measures all inputs of a sampling by every method, from its observations and others made here. A method
/// that fails is left out and
/// named in [`SensitivitySummary::notes`].
///
/// # Errors
/// Those of the session's blocks; a session in memory has no errors.
pub fn measure(
    sampling: &Sampling,
    spec: &SensitivitySpec,
    tally: &Tally,
    session: &Session,
) -> Result<SensitivitySummary, StudyError> {
    let run = Run { sampling, spec, settings: &sampling.study.file, tally, session };
    let named = |input: &Input| InputMeasures { input: input.name.clone(), ..InputMeasures::default() };
    let mut inputs: Vec<_> = sampling.design.inputs().iter().map(named).collect();
    let (mut methods, mut notes) = (IndexMap::new(), Vec::new());
    for (name, method) in METHODS {
        let clock = Instant::now();
        match method(&run, &mut inputs) {
            Ok(summary) => {
                if summary.reliable == Some(false) {
                    notes.push(format!("{name}: too few blocks, the intervals are an indication only"));
                }
                methods.insert(
                    name.to_owned(),
                    MethodSummary { seconds: clock.elapsed().as_secs_f64(), ..summary },
                );
            }
            // An error that prevents observations is not a note: it ends the run.
            Err(error) => match error.downcast::<StudyError>() {
                Ok(error) => return Err(*error),
                Err(error) => notes.push(format!("{name}: {error}")),
            },
        }
    }
    let (sums, agreement) = (sums(sampling, &inputs), Agreement::of(&inputs));
    Ok(SensitivitySummary { inputs, methods, sums, agreement, notes })
}

impl SensitivitySummary {
    /// The inputs, leading ones first: by the last measure of [`Agreement::measures`], which is the total
    /// index unless it has
    /// failed.
    pub fn leading(&self) -> Vec<&InputMeasures> {
        let mut inputs: Vec<_> = self.inputs.iter().collect();
        let last = self.agreement.measures.last();
        if let Some(Measure { value: of, .. }) =
            MEASURES.iter().find(|one| last.is_some_and(|last| last == one.name))
        {
            inputs.sort_by(|one, other| of(other).unwrap_or(0.0).total_cmp(&of(one).unwrap_or(0.0)));
        }
        inputs
    }
}

impl Run<'_> {
    fn inputs(&self) -> &[Input] {
        self.sampling.design.inputs()
    }

    fn observe(&self, name: &str, design: &dyn Points) -> Result<Vec<Option<f64>>, StudyError> {
        observe_values(self.sampling, (name, design), self.session)
    }

    /// The sampling's first observations.
    fn first(&self) -> Result<(SobolDesign, Vec<Option<f64>>), SensitivityError> {
        let whole = &self.sampling.design;
        let points = whole.points().min(self.spec.observations);
        let design = SobolDesign::new(whole.inputs().to_vec(), whole.first_index(), points)?;
        Ok((design, self.tally.first_values.iter().copied().take(points).collect()))
    }

    /// Output of the robot with these deviations of the inputs, and its derivatives per unit of the input.
    fn slopes(&self, row: &[f64]) -> Result<Slopes, StaticsError> {
        let Sampling { errors, observer, .. } = self.sampling;
        let (output, gradient) = observer.slopes(&errors.deviations(row), errors)?;
        Ok(Slopes { output, gradient })
    }
}

fn t_student(run: &Run, inputs: &mut [InputMeasures]) -> Result<MethodSummary, Box<dyn Error>> {
    let (design, outputs) = run.first()?;
    let found = student_effects(&design, &outputs)?;
    for (input, effect) in inputs.iter_mut().zip(found.effects) {
        input.t_student = Some(effect.student);
        input.signed_effect = Some(effect.effect);
    }
    Ok(MethodSummary::of(&outputs))
}

fn nominal_derivatives(run: &Run, inputs: &mut [InputMeasures]) -> Result<MethodSummary, Box<dyn Error>> {
    let slopes = run.slopes(&vec![0.0; inputs.len()])?;
    let part = |(slope, input): (&f64, &Input)| (slope * input.law.std()).powi(2);
    let parts: Vec<f64> = slopes.gradient.iter().zip(run.inputs()).map(part).collect();
    let variance: f64 = parts.iter().sum();
    if !(variance.is_finite() && variance > 0.0) {
        return Err(format!("the variance to first order is {variance}").into());
    }
    for (input, part) in inputs.iter_mut().zip(parts) {
        input.derivative_share = Some(part / variance);
    }
    Ok(MethodSummary { observations: 1, ..MethodSummary::default() })
}

fn regress(
    run: &Run,
    inputs: &mut [InputMeasures],
    fit: fn(&SobolDesign, &[Option<f64>]) -> Result<Regression, SensitivityError>,
    set: fn(&mut InputMeasures, f64),
) -> Result<MethodSummary, Box<dyn Error>> {
    let (design, outputs) = run.first()?;
    let found = fit(&design, &outputs)?;
    for (input, coefficient) in inputs.iter_mut().zip(found.inputs) {
        set(input, coefficient.share);
    }
    Ok(MethodSummary { r_squared: Some(found.r_squared), ..MethodSummary::of(&outputs) })
}

fn morris(run: &Run, inputs: &mut [InputMeasures]) -> Result<MethodSummary, Box<dyn Error>> {
    let design = run.sampling.morris_design(run.spec.morris_blocks)?;
    let outputs = run.observe(MORRIS, &design)?;
    for (input, effect) in inputs.iter_mut().zip(morris_effects(&design, &outputs, run.settings.confidence)?)
    {
        input.morris_mean_absolute = Some(effect.mean_absolute.value);
        input.morris_std = Some(effect.std);
    }
    Ok(MethodSummary::of(&outputs))
}

fn derivative_bounds(run: &Run, inputs: &mut [InputMeasures]) -> Result<MethodSummary, Box<dyn Error>> {
    let points = run.spec.derivative_points;
    let design = SobolDesign::scrambled(run.inputs().to_vec(), points, run.settings.seed)?;
    let slopes_at = |row: &mut Vec<f64>, index| {
        design.row(index, row)?;
        (run.session.tick)(1);
        Ok(run.slopes(row).ok())
    };
    let slopes: Result<Vec<Option<Slopes>>, SensitivityError> =
        (0..points).into_par_iter().map_init(|| vec![0.0; run.inputs().len()], slopes_at).collect();
    let found = dgsm(&design, &slopes?, run.settings.confidence)?;
    for (input, measure) in inputs.iter_mut().zip(found.inputs) {
        input.dgsm_total_bound = measure.total_bound;
    }
    Ok(MethodSummary { observations: points, failed: found.failed, ..MethodSummary::default() })
}

fn chaos_expansion(run: &Run, inputs: &mut [InputMeasures]) -> Result<MethodSummary, Box<dyn Error>> {
    let (design, outputs) = run.first()?;
    let found = expansion(&design, &outputs, run.spec.expansion)?;
    if found.terms.is_empty() {
        return Err("no polynomial predicts the output better than its mean".into());
    }
    for (input, shares) in inputs.iter_mut().zip(found.indices()) {
        input.expansion_first = Some(shares.closed);
        input.expansion_total = Some(shares.total);
    }
    Ok(MethodSummary { leave_one_out: Some(found.leave_one_out), ..MethodSummary::of(&outputs) })
}

fn sobol(run: &Run, inputs: &mut [InputMeasures]) -> Result<MethodSummary, Box<dyn Error>> {
    let SensitivitySpec { saltelli_blocks, bootstrap_resamples: resamples, .. } = *run.spec;
    let design = run.sampling.saltelli_design(saltelli_blocks)?;
    let outputs = run.observe(SALTELLI, &design)?;
    let bootstrap = Bootstrap { resamples, seed: run.settings.seed };
    let found = sobol_indices(&design, &outputs, bootstrap, run.settings.confidence)?;
    for (input, index) in inputs.iter_mut().zip(found.inputs) {
        [input.sobol_first, input.sobol_first_low, input.sobol_first_high] =
            [index.first.value, index.first.low, index.first.high].map(Some);
        [input.sobol_total, input.sobol_total_low, input.sobol_total_high] =
            [index.total.value, index.total.low, index.total.high].map(Some);
    }
    let (failed_blocks, reliable) = (Some(found.failed_blocks), Some(found.reliable));
    Ok(MethodSummary { failed_blocks, reliable, ..MethodSummary::of(&outputs) })
}

impl MethodSummary {
    fn of(outputs: &[Option<f64>]) -> Self {
        let failed = outputs.iter().filter(|output| output.is_none()).count();
        Self { observations: outputs.len(), failed, ..Self::default() }
    }
}

/// [`SensitivitySummary::sums`].
fn sums(sampling: &Sampling, inputs: &[InputMeasures]) -> IndexMap<String, IndexMap<String, f64>> {
    let groups = (0..inputs.len()).map(|input| sampling.errors.group(input));
    let mut sums: IndexMap<String, IndexMap<String, f64>> = IndexMap::new();
    for (group, input) in groups.zip(inputs).chain(inputs.iter().map(|input| ("all", input))) {
        let sums = sums.entry(group.to_owned()).or_default();
        for measure in MEASURES.iter().filter(|measure| measure.quantity == Quantity::Share) {
            if let Some(share) = (measure.value)(input) {
                *sums.entry(measure.name.to_owned()).or_default() += share;
            }
        }
    }
    sums
}

impl Agreement {
    fn of(inputs: &[InputMeasures]) -> Self {
        let first = LEADING.min(inputs.len().div_ceil(2));
        let column = |measure: &Measure| {
            let values = inputs.iter().map(measure.value).collect::<Option<Vec<f64>>>()?;
            Some((measure.name.to_owned(), values))
        };
        let (measures, columns): (Vec<_>, Vec<_>) =
            MEASURES.iter().filter(|measure| measure.ranks).filter_map(column).unzip();
        let leads = |values: &Vec<f64>, input: usize| {
            values[input] > 0.0 && values.iter().filter(|value| **value > values[input]).count() < first
        };
        let leads_all = |input: &usize| columns.iter().all(|values| leads(values, *input));
        let agreed = (0..inputs.len()).filter(leads_all).map(|input| inputs[input].input.clone());
        let agreed = if columns.is_empty() { Vec::new() } else { agreed.collect() };
        let correlations =
            |one: &Vec<f64>| columns.iter().map(|other| rank_correlation(one, other)).collect();
        Self { first, inputs: agreed, measures, rank_correlation: columns.iter().map(correlations).collect() }
    }
}
