//! The methods behind the measures of sensitivity: each observes what it needs and fills in its measures.

mod candidates;
pub(crate) mod run;

use crate::analysis::measures::{InputMeasures, SubspaceSummary};
use crate::analysis::methods::run::{Found, MethodSummary, Run};
use crate::analysis::verdict::recommendation::{Basis, Candidate};
use crate::file::output::VectorOutput;
use crate::model::designs::{Design, Grouped, key};
use crate::model::observed::Measured;
use cdpr_sensitivity::{
    Bootstrap, Correlated, Estimate, Expansion, Input, Regression, SensitivityError, SobolDesign,
    active_subspace, brackets, dgsm, expansion, gradient_expansion, morris_effects, rank_regression,
    regression, shapley_effects, sobol_indices, student_effects, vector_sobol_indices, wasserstein_bures,
};
use std::error::Error;

/// A method of sensitivity analysis.
pub(crate) struct Method {
    /// Its name in results.
    pub(crate) name: &'static str,
    pub(crate) inputs: Needs,
    /// Fills in its measures and returns its basis; `None` where the study does not ask for it.
    pub(crate) run: Estimator,
}

/// What carries a method out.
type Estimator = fn(&Run, &mut Found) -> Result<Option<MethodSummary>, Box<dyn Error>>;

/// What a method relies on.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Needs {
    /// Independent inputs.
    Independent,
    /// No more than a sample of their joint law.
    Joint,
}

/// Resamples behind the intervals of eigenvalues.
const SUBSPACE_RESAMPLES: usize = 200;

/// All methods, in the order of their cost.
pub(crate) const METHODS: [Method; 15] = [
    Method::new("t_student", Needs::Independent, t_student),
    Method::new("derivatives", Needs::Independent, nominal_derivatives),
    Method::new("regression", Needs::Joint, |run, found| {
        let fits = (regression::<SobolDesign> as Fit<_>, regression::<Correlated<SobolDesign>> as Fit<_>);
        regress(run, found, fits, |input, share| input.regression_share = Some(share))
    }),
    Method::new("rank_regression", Needs::Joint, |run, found| {
        let fits =
            (rank_regression::<SobolDesign> as Fit<_>, rank_regression::<Correlated<SobolDesign>> as Fit<_>);
        let summary = regress(run, found, fits, |input, share| input.rank_regression_share = Some(share))?;
        found.candidates.extend(summary.iter().filter_map(|of| candidates::of_ranks(&found.inputs, of)));
        Ok(summary)
    }),
    Method::new("morris", Needs::Independent, morris),
    Method::new("dgsm", Needs::Independent, derivative_bounds),
    Method::new("brackets", Needs::Independent, derivative_brackets),
    Method::new("active_subspace", Needs::Independent, subspace),
    Method::new("expansion", Needs::Independent, chaos_expansion),
    Method::new("gradient_expansion", Needs::Independent, chaos_expansion_of_slopes),
    Method::new("sobol", Needs::Independent, sobol),
    Method::new("morris_of_groups", Needs::Independent, morris_of_groups),
    Method::new("sobol_of_groups", Needs::Independent, sobol_of_groups),
    Method::new("bures", Needs::Joint, bures),
    Method::new("shapley", Needs::Joint, shapley),
];

/// A regression on a design.
type Fit<D> = fn(&D, &[Option<f64>]) -> Result<Regression, SensitivityError>;

impl Method {
    const fn new(name: &'static str, inputs: Needs, run: Estimator) -> Self {
        Self { name, inputs, run }
    }
}

/// An estimate and the ends of its interval, as measures that exist.
fn known(of: Estimate) -> [Option<f64>; 3] {
    [of.value, of.low, of.high].map(Some)
}

fn t_student(run: &Run, found: &mut Found) -> Result<Option<MethodSummary>, Box<dyn Error>> {
    let (design, outputs) = run.first()?;
    let effects = student_effects(&design, &outputs)?.effects;
    for (input, effect) in found.inputs.iter_mut().zip(effects) {
        input.t_student = Some(effect.student);
        input.signed_effect = Some(effect.effect);
    }
    Ok(Some(MethodSummary::of(&outputs)))
}

fn nominal_derivatives(run: &Run, found: &mut Found) -> Result<Option<MethodSummary>, Box<dyn Error>> {
    let nominal = run.slopes(&vec![0.0; run.inputs().len()]);
    let slopes = nominal.into_iter().next().transpose()?.ok_or("there is no nominal robot")?;
    let part = |(slope, input): (&f64, &Input)| (slope * input.std()).powi(2);
    let parts: Vec<f64> = slopes.gradient.iter().zip(run.inputs()).map(part).collect();
    let variance: f64 = parts.iter().sum();
    if !(variance.is_finite() && variance > 0.0) {
        return Err(format!("the variance to first order is {variance}").into());
    }
    for (input, part) in found.inputs.iter_mut().zip(parts) {
        input.derivative_share = Some(part / variance);
    }
    Ok(Some(MethodSummary { observations: 1, ..MethodSummary::default() }))
}

fn regress(
    run: &Run,
    found: &mut Found,
    (fit, of_correlated): (Fit<SobolDesign>, Fit<Correlated<SobolDesign>>),
    set: fn(&mut InputMeasures, f64),
) -> Result<Option<MethodSummary>, Box<dyn Error>> {
    let (design, outputs) = run.first()?;
    let fitted = match &run.sampling.correlation {
        Some(matrix) => of_correlated(&Correlated::new(design, matrix)?, &outputs)?,
        None => fit(&design, &outputs)?,
    };
    for (input, coefficient) in found.inputs.iter_mut().zip(fitted.inputs) {
        set(input, coefficient.share);
    }
    Ok(Some(MethodSummary { r_squared: Some(fitted.r_squared), ..MethodSummary::of(&outputs) }))
}

fn morris(run: &Run, found: &mut Found) -> Result<Option<MethodSummary>, Box<dyn Error>> {
    let design = run.sampling.morris_design(run.spec)?;
    let outputs = run.observe(Design::Morris(run.spec.morris_levels), &design)?;
    let effects = morris_effects(&design, &outputs, run.settings.confidence)?;
    for (input, effect) in found.inputs.iter_mut().zip(effects) {
        [input.morris_mean_absolute, input.morris_low, input.morris_high] = known(effect.mean_absolute);
        input.morris_reliable = Some(effect.reliable);
        input.morris_std = Some(effect.std);
    }
    let reliable = Some(found.inputs.iter().all(|input| input.morris_reliable == Some(true)));
    Ok(Some(MethodSummary { reliable, ..MethodSummary::of(&outputs) }))
}

fn morris_of_groups(run: &Run, found: &mut Found) -> Result<Option<MethodSummary>, Box<dyn Error>> {
    let groups = &run.sampling.groups;
    if groups.is_empty() {
        return Ok(None);
    }
    let design = run.sampling.morris_design(run.spec)?.grouped(groups.clone())?;
    let of = Design::Groups(Grouped::Morris(run.spec.morris_levels), key(groups));
    let outputs = run.observe(of, &design)?;
    let effects = morris_effects(&design, &outputs, run.settings.confidence)?;
    for (group, effect) in found.groups.iter_mut().zip(effects) {
        group.morris_mean_absolute = Some(effect.mean_absolute.value);
        group.morris_reliable = Some(effect.reliable);
    }
    let reliable = Some(found.groups.iter().all(|group| group.morris_reliable == Some(true)));
    Ok(Some(MethodSummary { reliable, ..MethodSummary::of(&outputs) }))
}

fn derivative_bounds(run: &Run, found: &mut Found) -> Result<Option<MethodSummary>, Box<dyn Error>> {
    let (design, slopes) = run.sloped()?;
    let measures = dgsm(&design, slopes, run.settings.confidence)?;
    let mut reliable = true;
    for (input, measure) in found.inputs.iter_mut().zip(measures.inputs) {
        let Some(bound) = measure.total_bound else { continue };
        input.dgsm_total_bound = Some(bound.value);
        input.dgsm_total_bound_high = measure.reliable.then_some(bound.high);
        reliable &= measure.reliable;
    }
    Ok(Some(MethodSummary { reliable: Some(reliable), ..MethodSummary::of(slopes) }))
}

pub(crate) fn derivative_brackets(
    run: &Run,
    found: &mut Found,
) -> Result<Option<MethodSummary>, Box<dyn Error>> {
    let (design, slopes) = run.sloped()?;
    let bounds = brackets(&design, slopes, run.settings.confidence, run.settings.seed)?;
    for (input, bracket) in found.inputs.iter_mut().zip(bounds) {
        [input.first_lower, input.first_lower_low] =
            [bracket.first_lower.value, bracket.first_lower.low.max(0.0)].map(Some);
        [input.total_lower, input.total_lower_low] =
            [bracket.total_lower.value, bracket.total_lower.low.max(0.0)].map(Some);
        [input.total_upper, input.total_upper_high] =
            [bracket.total_upper.value, bracket.total_upper.high.min(1.0)].map(Some);
    }
    let summary = MethodSummary::of(slopes);
    found.candidates.push(candidates::of_derivatives(run, &design, slopes, &summary)?);
    Ok(Some(summary))
}

fn subspace(run: &Run, found: &mut Found) -> Result<Option<MethodSummary>, Box<dyn Error>> {
    let (design, slopes) = run.sloped()?;
    let (level, seed) = (run.settings.confidence, run.settings.seed);
    let space = active_subspace(&design, slopes, Bootstrap { resamples: SUBSPACE_RESAMPLES, seed }, level)?;
    for (input, score) in found.inputs.iter_mut().zip(&space.activity) {
        input.activity = Some(*score);
    }
    found.subspace = Some(SubspaceSummary {
        eigenvalues: space.eigenvalues.iter().map(|of| of.value).collect(),
        low: space.eigenvalues.iter().map(|of| of.low).collect(),
        high: space.eigenvalues.iter().map(|of| of.high).collect(),
        needed_90: space.needed(0.9, level)?,
        needed_99: space.needed(0.99, level)?,
        first: space.directions.first().cloned().unwrap_or_default(),
    });
    Ok(Some(MethodSummary::of(slopes)))
}

fn chaos_expansion(run: &Run, found: &mut Found) -> Result<Option<MethodSummary>, Box<dyn Error>> {
    let (design, outputs) = run.first()?;
    let model = useful(expansion(&design, &outputs, run.spec.expansion)?)?;
    for (input, shares) in found.inputs.iter_mut().zip(model.indices()) {
        input.expansion_first = Some(shares.closed);
        input.expansion_total = Some(shares.total);
    }
    let summary = MethodSummary { leave_one_out: Some(model.leave_one_out), ..MethodSummary::of(&outputs) };
    found.candidates.push(candidates::of_model(&model, &summary));
    Ok(Some(summary))
}

fn chaos_expansion_of_slopes(run: &Run, found: &mut Found) -> Result<Option<MethodSummary>, Box<dyn Error>> {
    if !run.spec.gradient_expansion {
        return Ok(None);
    }
    let (design, slopes) = run.sloped()?;
    let model = useful(gradient_expansion(&design, slopes, run.spec.expansion)?)?;
    for (input, shares) in found.inputs.iter_mut().zip(model.indices()) {
        input.gradient_expansion_first = Some(shares.closed);
        input.gradient_expansion_total = Some(shares.total);
    }
    let (leave_one_out, derivatives) = (Some(model.leave_one_out), Some(model.derivatives));
    let summary = MethodSummary { leave_one_out, derivatives, ..MethodSummary::of(slopes) };
    found.candidates.push(candidates::of_model(&model, &summary));
    Ok(Some(summary))
}

/// An expansion that has a term.
fn useful(model: Expansion) -> Result<Expansion, Box<dyn Error>> {
    match model.terms.is_empty() {
        true => Err("no polynomial predicts the output better than its mean".into()),
        false => Ok(model),
    }
}

fn sobol(run: &Run, found: &mut Found) -> Result<Option<MethodSummary>, Box<dyn Error>> {
    if run.spec.saltelli_blocks == 0 {
        return Ok(None);
    }
    let design = run.sampling.saltelli_design(run.spec.saltelli_blocks)?;
    let measured = run.observe_quantities(Design::Saltelli(run.spec.vector.recorded()), &design)?;
    let outputs: Vec<_> = measured.iter().map(|of| of.as_ref().map(Measured::value)).collect();
    let indices = sobol_indices(&design, &outputs, run.bootstrap(), run.settings.confidence)?;
    for (input, index) in found.inputs.iter_mut().zip(indices.inputs) {
        [input.sobol_first, input.sobol_first_low, input.sobol_first_high] = known(index.first);
        [input.sobol_total, input.sobol_total_low, input.sobol_total_high] = known(index.total);
    }
    if run.sampling.output().is_length() {
        let vector = |of: &Measured| components(of, run.spec.vector);
        let vectors: Vec<_> = measured.iter().map(|of| of.as_ref().and_then(vector)).collect();
        let of_vectors = vector_sobol_indices(&design, &vectors, run.bootstrap(), run.settings.confidence)?;
        for (input, index) in found.inputs.iter_mut().zip(of_vectors.inputs) {
            [input.vector_first, input.vector_first_low, input.vector_first_high] = known(index.first);
            [input.vector_total, input.vector_total_low, input.vector_total_high] = known(index.total);
        }
    }
    let (failed_blocks, reliable) = (Some(indices.failed_blocks), Some(indices.reliable));
    let summary = MethodSummary { failed_blocks, reliable, ..MethodSummary::of(&outputs) };
    // The bootstrap takes long: not where derivatives settle all inputs.
    let is_settled = |of: &Candidate| of.basis == Basis::Derivatives && of.settled() == found.inputs.len();
    if indices.reliable && !found.candidates.iter().any(is_settled) {
        found.candidates.push(candidates::of_sobol(run, &design, &outputs, &summary)?);
    }
    Ok(Some(summary))
}

fn sobol_of_groups(run: &Run, found: &mut Found) -> Result<Option<MethodSummary>, Box<dyn Error>> {
    let groups = &run.sampling.groups;
    if groups.is_empty() || run.spec.saltelli_blocks == 0 {
        return Ok(None);
    }
    let design = run.sampling.saltelli_design(run.spec.saltelli_blocks)?.grouped(groups.clone())?;
    let outputs = run.observe(Design::Groups(Grouped::Saltelli, key(groups)), &design)?;
    let indices = sobol_indices(&design, &outputs, run.bootstrap(), run.settings.confidence)?;
    for (group, index) in found.groups.iter_mut().zip(indices.inputs) {
        [group.sobol_first, group.sobol_first_low, group.sobol_first_high] = known(index.first);
        [group.sobol_total, group.sobol_total_low, group.sobol_total_high] = known(index.total);
    }
    let (failed_blocks, reliable) = (Some(indices.failed_blocks), Some(indices.reliable));
    Ok(Some(MethodSummary { failed_blocks, reliable, ..MethodSummary::of(&outputs) }))
}

fn bures(run: &Run, found: &mut Found) -> Result<Option<MethodSummary>, Box<dyn Error>> {
    if run.spec.bures_observations == 0 {
        return Ok(None);
    }
    let design = run.sampling.random_design(run.spec.bures_observations)?;
    let measured = run.observe_quantities(Design::Random(run.spec.vector.recorded()), &*design)?;
    let k = run.inputs().len();
    let mut rows = vec![0.0; k * design.size()];
    design.fill(0, &mut rows);
    let columns: Vec<Vec<f64>> =
        (0..k).map(|input| rows.iter().skip(input).step_by(k).copied().collect()).collect();
    let vector = |of: &Measured| components(of, run.spec.vector).unwrap_or_else(|| vec![of.value()]);
    let vectors: Vec<_> = measured.iter().map(|of| of.as_ref().map(vector)).collect();
    let indices = wasserstein_bures(&columns, &vectors, run.settings.confidence, run.settings.seed)?;
    for (input, of) in found.inputs.iter_mut().zip(indices) {
        [input.bures, input.bures_low, input.bures_high] = known(of.index);
        input.bures_means = Some(of.means.value);
    }
    Ok(Some(MethodSummary::of(&vectors)))
}

fn shapley(run: &Run, found: &mut Found) -> Result<Option<MethodSummary>, Box<dyn Error>> {
    if run.spec.shapley_walks == 0 {
        return Ok(None);
    }
    let design = run.sampling.shapley_design(run.spec.shapley_walks)?;
    let outputs = run.observe(Design::Shapley, &design)?;
    let effects = shapley_effects(&design, &outputs, run.settings.confidence)?;
    for (input, of) in found.inputs.iter_mut().zip(effects) {
        [input.shapley, input.shapley_low, input.shapley_high] = known(of.effect);
    }
    let summary = MethodSummary::of(&outputs);
    found.candidates.extend(candidates::of_shapley(run, &found.inputs, &summary));
    Ok(Some(summary))
}

/// The components of the vector of an output that is a length [mm].
fn components(of: &Measured, vector: VectorOutput) -> Option<Vec<f64>> {
    let displacement = of.quantity.displacement()?;
    let turned = match vector {
        VectorOutput::Displacement => None,
        VectorOutput::Pose { characteristic_length } => Some(of.quantity.rotation()? * characteristic_length),
    };
    Some([Some(displacement), turned].iter().flatten().flatten().map(|x| 1e3 * x).collect())
}
