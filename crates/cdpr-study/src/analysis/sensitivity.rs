//! Measures of sensitivity beside each other: the value of each for every input of a sampling, the
//! observations on which it rests, and where they agree. The output is that of the
//! study, in its unit.
//!
//! | method | result | input |
//! |---|---|---|
//! | `t_student` | t-Student index and signed effect | first observations of the sampling |
//! | `derivatives` | share of the variance, to first order | derivatives at the nominal robot, variances |
//! | `regression`, `rank_regression` | squared coefficients of values and ranks | first observations |
//! | `morris` | mean absolute elementary effect, deviation of effects | radial blocks or trajectories |
//! | `dgsm` | bound on the total index | exact derivatives at points of a scrambled Sobol sequence |
//! | `brackets` | bounds of first-order and total indices on both sides | the same derivatives |
//! | `expansion` | first-order and total indices of a polynomial model | first observations |
//! | `gradient_expansion` | the same of a model fitted to derivatives as well | the derivatives of `dgsm` |
//! | `sobol` | first-order and total indices, with intervals; of vectors, too | Saltelli's blocks |
//! | `bures` | index of Wasserstein and Bures of the same vectors | random observations |
//! | `shapley` | Shapley effects, with intervals | walks through the joint law of the inputs |
//! | `active_subspace` | directions of all inputs, activity scores | the derivatives of `dgsm` |
//! | `morris_of_groups`, `sobol_of_groups` | the same of groups | blocks that move groups |
//!
//! Derivatives and polynomials take the continuous laws: steps of h in a uniform range R change a variance by
//! a relative (h / R)². All observations are of the stepped inputs.

use crate::analysis::measures::{GroupMeasures, InputMeasures, MEASURES, Measure, Quantity, SubspaceSummary};
use crate::analysis::methods::run::{Found, MethodSummary, Run};
use crate::analysis::methods::{METHODS, Needs, derivative_brackets};
use crate::analysis::verdict::recommendation::Candidate;
use crate::error::StudyError;
use crate::file::output::VectorOutput;
use crate::file::sensitivity_spec::SensitivitySpec;
use crate::model::study::Sampling;
use crate::observe::observation::{Session, Tally};
use cdpr_sensitivity::rank_correlation;
use indexmap::IndexMap;
use serde::{Deserialize, Serialize};
use std::time::Instant;

/// Measures of all inputs of a sampling; serialized into `summary.json`.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct SensitivitySummary {
    /// Values of the measures for each input, in the order of the parameter vector.
    pub inputs: Vec<InputMeasures>,
    /// Values of the measures for each group of the study.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub groups: Vec<GroupMeasures>,
    /// Directions of the parameters along which the output varies.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub subspace: Option<SubspaceSummary>,
    /// The basis of each method; methods that failed are named in the notes instead.
    pub methods: IndexMap<String, MethodSummary>,
    /// Sums of each share of the variance over the inputs of a group (`a`, `b`, `mass`, ...), and over all of
    /// them (`all`).
    pub sums: IndexMap<String, IndexMap<String, f64>>,
    /// Where the measures agree.
    pub agreement: Agreement,
    /// What the indices of vectors are of.
    #[serde(default, skip_serializing_if = "crate::file::is_default")]
    pub vector: VectorOutput,
    /// What could not be measured, and why.
    pub notes: Vec<String>,
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
    Ok(measured(&Run::new(sampling, spec, tally, session))?.0)
}

/// The measures, and what may be recommended of them.
pub(crate) fn measured(run: &Run) -> Result<(SensitivitySummary, Vec<Candidate>), StudyError> {
    let (sampling, spec) = (run.sampling, run.spec);
    let mut found = Found::new(sampling);
    let (mut methods, mut notes) = (IndexMap::new(), Vec::new());
    let is_correlated = sampling.correlation.is_some();
    if is_correlated {
        let left: Vec<_> =
            METHODS.iter().filter(|of| of.inputs == Needs::Independent).map(|of| of.name).collect();
        notes.push(format!("{}: the inputs are correlated", left.join(", ")));
    }
    for method in METHODS.iter().filter(|of| !(is_correlated && of.inputs == Needs::Independent)) {
        let clock = Instant::now();
        let name = method.name;
        match (method.run)(run, &mut found) {
            Ok(None) => {}
            Ok(Some(summary)) => {
                if summary.reliable == Some(false) {
                    notes.push(format!(
                        "{name}: {}, the intervals are an indication only",
                        doubt(name, &found)
                    ));
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
    let Found { inputs, groups, subspace, candidates } = found;
    let (sums, agreement) = (sums(sampling, &inputs), Agreement::of(&inputs));
    let summary =
        SensitivitySummary { inputs, groups, subspace, methods, sums, agreement, vector: spec.vector, notes };
    Ok((summary, candidates))
}

/// Bounds by derivatives alone, for the verdict on a sampling whose study has no measures; otherwise the
/// reason why there are no bounds.
pub(crate) fn bounded(run: &Run) -> Result<Vec<Candidate>, String> {
    if run.sampling.correlation.is_some() {
        return Err("the inputs are correlated".to_owned());
    }
    let mut found = Found::new(run.sampling);
    derivative_brackets(run, &mut found).map_err(|error| error.to_string())?;
    Ok(found.candidates)
}

/// Why intervals of a method are not reliable: the means of these inputs or groups rest on few observations,
/// or there are few blocks.
fn doubt(method: &str, found: &Found) -> String {
    let of_inputs = |reliable: fn(&InputMeasures) -> bool| -> Vec<(&String, bool)> {
        found.inputs.iter().map(|input| (&input.input, reliable(input))).collect()
    };
    let (what, all, every) = match method {
        "morris" => (
            "few effects dominate the means of",
            of_inputs(|input| input.morris_reliable == Some(true)),
            "too few blocks",
        ),
        "morris_of_groups" => (
            "few effects dominate the means of",
            found.groups.iter().map(|group| (&group.group, group.morris_reliable == Some(true))).collect(),
            "too few blocks",
        ),
        // Inputs without a bound have nothing to doubt.
        "dgsm" => (
            "few points dominate the mean squares of",
            of_inputs(|input| input.dgsm_total_bound_high.is_some() || input.dgsm_total_bound.is_none()),
            "few points dominate the mean squares",
        ),
        _ => return "too few blocks".to_owned(),
    };
    let names: Vec<&str> = all.iter().filter(|(_, good)| !good).map(|(name, _)| name.as_str()).collect();
    if names.len() == all.len() { every.to_owned() } else { format!("{what} {}", names.join(", ")) }
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
