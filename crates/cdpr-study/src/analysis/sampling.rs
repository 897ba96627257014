//! Analysis of a sampling: summary, fitted laws, effects.

use crate::analysis::linear_law::{LinearLaw, explained};
use crate::analysis::methods::run::Run;
use crate::analysis::sensitivity::{SensitivitySummary, bounded, measured};
use crate::analysis::values::ValueSummary;
use crate::analysis::verdict::PartVerdict;
use crate::analysis::verdict::recommendation::{Basis, Candidate, Recommendation, recommend};
use crate::error::StudyError;
use crate::file::output::Output;
use crate::file::sensitivity_spec::{SensitivitySpec, VERDICT_POINTS};
use crate::model::nominal::too_much;
use crate::model::observed::ScalarCount;
use crate::model::study::Sampling;
use crate::observe::observation::{FITTED, KEPT, Session, Tally, observe_replicate};
use cdpr_robot::Robot;
use cdpr_sensitivity::{
    BestFit, Bootstrap, EffectInterval, Effects, Family, Fit, Histogram, Law, Sample, SampleDesign,
    SensitivityError, SobolDesign, fit_all, intervals_of_effects,
};
use cdpr_statics::Deflection;
use indexmap::IndexMap;
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;

/// Results of one sampling; serialized into `summary.json`.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct SamplingSummary {
    /// Title.
    pub title: String,
    /// The answer in words, and the recommended measure of the inputs.
    pub verdict: PartVerdict,
    /// What is observed.
    #[serde(default, skip_serializing_if = "crate::file::is_default")]
    pub output: Output,
    /// Position of the wanted pose [m].
    pub pose: [f64; 3],
    /// Its rotation as a unit quaternion (w, x, y, z), w >= 0.
    pub quaternion: [f64; 4],
    /// Number of observations, failed ones included.
    pub observations: usize,
    /// Failed observations by kind.
    pub failed: BTreeMap<String, usize>,
    /// Observations by the scalar models, and why; absent in results of earlier versions.
    #[serde(default)]
    pub scalar: ScalarCount,
    /// Summary of the output; absent if fewer than two observations succeeded.
    #[serde(rename = "magnitude_mm")]
    pub values: Option<ValueSummary>,
    /// The nominal robot at this pose.
    pub nominal: NominalSummary,
    /// Least and greatest modulus of the cables' law at the tensions of pose and load [GPa], where the error
    /// model asks for them.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub operating_moduli_gpa: Option<[f64; 2]>,
    /// Fitted laws by ascending AIC; empty where they cannot be fitted.
    pub fits: Vec<FitSummary>,
    /// The family that fits best, and what the observations say of it; on Sobol' points, which are not
    /// independent, an indication.
    pub best_fit: Option<BestFit>,
    /// Histogram of the output in its unit.
    pub histogram: Option<Histogram>,
    /// The paper's t-Student index by parameter (section 5.2). On Sobol points its significance levels do not
    /// hold.
    pub t_student: IndexMap<String, f64>,
    /// Signed effect by parameter: mean output in the upper half of its range minus that in the lower half,
    /// with an interval from scrambled replicates.
    #[serde(rename = "signed_effects_mm")]
    pub signed_effects: IndexMap<String, SignedEffect>,
    /// Scrambled replicates behind those intervals.
    pub replicates: usize,
    /// Their confidence.
    pub confidence: f64,
    /// Measures of sensitivity beside each other; absent unless the study asks for them.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub sensitivity: Option<SensitivitySummary>,
    /// What could not be computed, and why.
    pub notes: Vec<String>,
}

/// The nominal robot under the study's load.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct NominalSummary {
    /// dp [mm], without the weather.
    pub displacement_mm: [f64; 3],
    /// |dp| that the stiffness at the unloaded pose predicts [mm]. Section 3.3 of the paper says why it
    /// differs.
    pub small_displacement_magnitude_mm: Option<f64>,
    /// Tension of every cable under the platform's own weight [N].
    pub unloaded_tensions: Vec<f64>,
    /// Tension of every cable with the payload [N].
    pub loaded_tensions: Vec<f64>,
    /// Its tensions above their limits or breaking forces, without or with the payload.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub out_of_limits: Vec<String>,
}

/// A law fitted to the output.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct FitSummary {
    /// Family.
    pub law: Family,
    /// The law of largest likelihood, in the unit of the output.
    pub parameters: Law,
    /// Natural logarithm of its likelihood.
    pub log_likelihood: f64,
    /// Akaike's criterion.
    pub aic: f64,
    /// Schwarz's criterion.
    pub bic: f64,
    /// Kolmogorov-Smirnov distance.
    pub ks: f64,
    /// p-value of that distance for fitted parameters, by parametric bootstrap: at least 1/(resamples + 1),
    /// and for independent observations; on Sobol points it is an indication.
    pub p_value: f64,
    /// Whether no sample of the bootstrap had so large a distance: p may be smaller.
    #[serde(default)]
    pub p_is_bound: bool,
    /// Probability of this family among those fitted, for independent observations.
    #[serde(default)]
    pub probability: f64,
}

/// Signed effect of a parameter, in the unit of the output, and its confidence interval.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct SignedEffect {
    /// Mean over the replicates.
    pub effect: f64,
    /// Lower end of the interval.
    pub low: f64,
    /// Upper end of the interval.
    pub high: f64,
}

impl NominalSummary {
    pub(crate) fn new(robot: &Robot, nominal: &Deflection, load: &cdpr_statics::Load) -> Self {
        let small = nominal.small_displacement(robot, load).map(|dp| 1e3 * dp.norm()).ok();
        Self {
            displacement_mm: (1e3 * nominal.displacement()).into(),
            small_displacement_magnitude_mm: small,
            unloaded_tensions: nominal.unloaded.equilibrium.tensions(),
            loaded_tensions: nominal.loaded.equilibrium.tensions(),
            out_of_limits: too_much(robot, nominal),
        }
    }
}

impl From<Fit> for FitSummary {
    fn from(fit: Fit) -> Self {
        let p_is_bound = fit.p_is_bound();
        let Fit {
            family,
            law,
            log_likelihood,
            aic,
            bic,
            ks_distance: ks,
            p_value,
            resamples: _,
            probability,
        } = fit;
        Self { law: family, parameters: law, log_likelihood, aic, bic, ks, p_value, p_is_bound, probability }
    }
}

/// Analyses the observations of a sampling. The replicates for the intervals of signed effects and the
/// measures of sensitivity run here, in the same session. Statistics that need more observations are left
/// out; [`SamplingSummary::notes`] names them, and says on how many observations quantiles, histogram and
/// laws rest if these are not all.
///
/// # Errors
/// Those of the session's blocks; a session in memory has no errors.
pub fn analyse(sampling: &Sampling, tally: &Tally, session: &Session) -> Result<SamplingSummary, StudyError> {
    let (settings, output) = (&sampling.study.file, sampling.output());
    let mut notes = Vec::new();
    for (what, used) in [("quantiles, histogram", KEPT), ("fitted laws", FITTED)] {
        if sampling.design.points() > used {
            notes.push(format!("{what}: of the first {used} observations"));
        }
    }
    if sampling.correlation.is_some() {
        notes.push("t_student, signed effects: the inputs are correlated".to_owned());
    }
    notes.extend(sampling.observer.vibration_note());
    let mut note = |what: &str, error: SensitivityError| notes.push(format!("{what}: {error}"));
    let moments = tally.sums.outputs().summary().map_err(|error| note(output.name(), error)).ok();
    // An output that is no length has this value for every robot, if at all, where nothing resists.
    let rounding = if output.is_length() { 1e3 * sampling.nominal.rounding(sampling.robot) } else { 0.0 };
    if let Some(moments) = &moments
        && moments.max <= rounding
    {
        return Ok(unmoved(sampling, tally, rounding));
    }
    let sample = moments.and_then(|_| Sample::new(&tally.first_values).ok());
    let bootstrap = Bootstrap { resamples: settings.bootstrap_resamples, seed: settings.seed };
    let fitted = &tally.first_values[..tally.first_values.len().min(FITTED)];
    let fits = match moments.and_then(|_| Sample::new(fitted).ok()).map(|sample| fit_all(&sample, bootstrap))
    {
        Some(Ok(fits)) => fits,
        Some(Err(error)) => {
            note("fits", error);
            Vec::new()
        }
        None => Vec::new(),
    };
    let best_fit = BestFit::of(&fits);
    let t_student = match sampling.correlation {
        None => tally.sums.effects(sampling.design.inputs()).map(|effects| {
            effects.effects.into_iter().map(|effect| (effect.input, effect.student)).collect()
        }),
        Some(_) => Ok(IndexMap::new()),
    };
    let signed = signed_effects(sampling, session)?;
    let t_student = t_student.unwrap_or_else(|error| {
        note("t_student", error);
        IndexMap::new()
    });
    let signed_effects = signed.unwrap_or_else(|error| {
        note(&output.named("signed_effects_mm"), error);
        IndexMap::new()
    });
    let values = moments.zip(sample.as_ref()).zip(tally.range()).and_then(|((all, sample), range)| {
        ValueSummary::new(&all, sample, range, sampling.nominal_value).ok()
    });
    let (sensitivity, recommendation) = recommended(sampling, tally, session, &t_student, &mut notes)?;
    Ok(SamplingSummary {
        verdict: PartVerdict::of_sampling(sampling, tally, values.as_ref(), recommendation),
        values,
        fits: fits.into_iter().map(FitSummary::from).collect(),
        best_fit,
        histogram: sample.and_then(|sample| sample.histogram(cdpr_sensitivity::Bins::FreedmanDiaconis).ok()),
        t_student,
        signed_effects,
        replicates: settings.replicates,
        sensitivity,
        notes,
        ..unmoved(sampling, tally, rounding)
    })
}

/// The measures of sensitivity that the study asks for, and the recommended one. Without any, derivatives are
/// taken for it alone.
fn recommended(
    sampling: &Sampling,
    tally: &Tally,
    session: &Session,
    t_student: &IndexMap<String, f64>,
    notes: &mut Vec<String>,
) -> Result<(Option<SensitivitySummary>, Option<Recommendation>), StudyError> {
    let settings = &sampling.study.file;
    let names: Vec<String> = sampling.design.inputs().iter().map(|input| input.name.clone()).collect();
    let for_verdict = SensitivitySpec { derivative_points: VERDICT_POINTS, ..SensitivitySpec::default() };
    let spec = settings.sensitivity.unwrap_or(for_verdict);
    let run = Run::new(sampling, &spec, tally, session);
    let (summary, mut candidates) = match settings.sensitivity {
        Some(_) => {
            let (summary, candidates) = measured(&run)?;
            (Some(summary), candidates)
        }
        None => (
            None,
            bounded(&run).unwrap_or_else(|reason| {
                notes.push(format!("bounds of shares: {reason}"));
                Vec::new()
            }),
        ),
    };
    let student = names.iter().map(|name| t_student.get(name).copied()).collect::<Option<Vec<f64>>>();
    candidates.extend(student.map(Candidate::of_student));
    let mut recommendation = recommend(&names, candidates, settings.confidence);
    if let Some(of) = recommendation.as_mut().filter(|of| of.basis == Basis::Derivatives) {
        of.explained = explained_to_first_order(sampling, tally);
    }
    Ok((summary, recommendation))
}

/// Share of the variance that the derivatives of the nominal robot explain; `None` where it has none.
fn explained_to_first_order(sampling: &Sampling, tally: &Tally) -> Option<f64> {
    let (value, slopes) = sampling.observer.to_first_order(&sampling.errors).ok()?;
    let mut row = vec![0.0; sampling.design.inputs().len()];
    let law = LinearLaw { about: row.clone(), value, slopes };
    let mut pairs = Vec::new();
    for (index, observed) in tally.first_values.iter().enumerate() {
        if let Some(observed) = observed {
            sampling.design.row(index, &mut row).ok()?;
            pairs.push((law.at(&row), *observed));
        }
    }
    explained(&pairs)
}

/// The summary of a sampling whose outputs are below rounding: zero, without laws and effects.
fn unmoved(sampling: &Sampling, tally: &Tally, rounding: f64) -> SamplingSummary {
    let output = sampling.output();
    let all = if output == Output::Deflection { "deflections" } else { "values" };
    SamplingSummary {
        title: sampling.title.to_owned(),
        output,
        pose: sampling.pose.position.into(),
        quaternion: sampling.pose.quaternion(),
        verdict: PartVerdict::of_zero(sampling, tally, rounding),
        observations: sampling.design.points(),
        failed: tally.failed.clone(),
        scalar: tally.scalar.clone(),
        values: Some(ValueSummary::default()),
        nominal: NominalSummary::new(sampling.robot, &sampling.nominal, &sampling.load),
        operating_moduli_gpa: sampling.operating_moduli.map(|moduli| moduli.map(|modulus| 1e-9 * modulus)),
        fits: Vec::new(),
        best_fit: None,
        histogram: None,
        t_student: IndexMap::new(),
        signed_effects: IndexMap::new(),
        replicates: 0,
        confidence: sampling.study.file.confidence,
        sensitivity: None,
        notes: vec![format!(
            "{}: all {all} are below {rounding:.1e} {}, which rounding may cause: zero within this bound",
            output.name(),
            output.unit()
        )],
    }
}

/// Signed effects, or a note that explains why they cannot be computed. An error of the session ends the run.
fn signed_effects(
    sampling: &Sampling,
    session: &Session,
) -> Result<Result<IndexMap<String, SignedEffect>, SensitivityError>, StudyError> {
    let replicates = if sampling.correlation.is_none() { sampling.study.file.replicates } else { 0 };
    if replicates == 0 {
        return Ok(Ok(IndexMap::new()));
    }
    let tallies = (1..=replicates).map(|number| observe_replicate(sampling, number, session));
    let tallies: Vec<Tally> = tallies.collect::<Result<_, _>>()?;
    let effects = tallies.iter().map(|tally| tally.sums.effects(sampling.design.inputs()));
    Ok(effects.collect::<Result<Vec<_>, _>>().and_then(|effects| effects_of_replicates(sampling, &effects)))
}

/// Signed effects with their intervals, from the effects in each scrambled replicate of a sampling, the first
/// of them replicate 1.
///
/// # Errors
/// As [`intervals_of_effects`].
pub fn effects_of_replicates(
    sampling: &Sampling,
    effects: &[Effects],
) -> Result<IndexMap<String, SignedEffect>, SensitivityError> {
    let designs: Vec<SobolDesign> = (1..=effects.len()).map(|number| sampling.replicate(number)).collect();
    let designs: Vec<&SobolDesign> = designs.iter().collect();
    let intervals = intervals_of_effects(&designs, effects, sampling.study.file.confidence)?;
    let named = |e: EffectInterval| (e.input, SignedEffect { effect: e.effect, low: e.low, high: e.high });
    Ok(intervals.into_iter().map(named).collect())
}
