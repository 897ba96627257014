//! Observations of a study: deflections of robots whose parameters deviate.

use crate::answers::failure::Failure;
use crate::question::ObserveReplicate;
use cdpr_robot::Robot;
use cdpr_sensitivity::{Effects, SampleDesign};
use cdpr_study::{
    STUDY_NAME, ScalarCount, Session, Study, StudyFile, ValueSummary, effects_of_replicates,
    observe as observe_sampling, observe_replicate,
};
use serde::Serialize;
use std::collections::BTreeMap;
use std::path::Path;

/// Name of the sampling that is observed.
pub(crate) const SAMPLING: &str = "all";

/// The uncertain inputs of a study.
#[derive(Serialize)]
pub(crate) struct Inputs {
    /// Their names.
    inputs: Vec<String>,
    /// The entry of the error model that each comes from.
    entries: Vec<String>,
}

/// Observations of one design.
#[derive(Serialize)]
pub(crate) struct Observed {
    /// Deflections [mm], `null` for failed observations.
    values_mm: Vec<Option<f64>>,
    /// Their summary; absent if fewer than two exist.
    summary: Option<ValueSummary>,
    /// Failures by kind.
    failed: BTreeMap<String, usize>,
    scalar: ScalarCount,
    /// Deflection of the nominal robot [mm].
    nominal_mm: f64,
    /// Effects of the inputs in this design, for the question `effects`.
    effects: Option<Effects>,
}

/// A signed effect with its interval.
#[derive(Serialize)]
pub(crate) struct InputEffect {
    name: String,
    /// Entry of the error model.
    entry: String,
    /// Mean deflection in the upper half of the input's range minus that in the lower half [mm].
    effect_mm: f64,
    low_mm: f64,
    high_mm: f64,
}

/// Signed effects of all inputs.
#[derive(Serialize)]
pub(crate) struct InputEffects {
    inputs: Vec<InputEffect>,
    confidence: f64,
    replicates: usize,
}

/// Checks a study of the robot.
pub(crate) fn set(robot: &Robot, file: StudyFile) -> Result<(Study, Inputs), Failure> {
    let study = Study::of_robot(file, robot.clone(), Path::new(STUDY_NAME))?;
    let errors = study.sampling(SAMPLING)?.errors;
    let inputs = Inputs {
        inputs: errors.inputs.iter().map(|input| input.name.clone()).collect(),
        entries: errors.entries.clone(),
    };
    Ok((study, inputs))
}

pub(crate) fn observe(study: &Study, given: ObserveReplicate) -> Result<Observed, Failure> {
    let sampling = study.sampling(SAMPLING)?;
    let session = Session::in_memory();
    let tally = match given.replicate {
        0 => observe_sampling(&sampling, &session)?,
        number => observe_replicate(&sampling, number, &session)?,
    };
    Ok(Observed {
        summary: ValueSummary::of(&sampling, &tally),
        nominal_mm: sampling.nominal_value,
        effects: tally.sums.effects(sampling.design.inputs()).ok(),
        values_mm: tally.first_values,
        failed: tally.failed,
        scalar: tally.scalar,
    })
}

pub(crate) fn effects(study: &Study, of: &[Effects]) -> Result<InputEffects, Failure> {
    let sampling = study.sampling(SAMPLING)?;
    let found = effects_of_replicates(&sampling, of).map_err(|error| {
        Failure::invalid("of", format!("effects of {} replicates", of.len()), &error.to_string())
    })?;
    let inputs = found.into_iter().zip(&sampling.errors.entries);
    let effect = |((name, found), entry): ((String, cdpr_study::SignedEffect), &String)| InputEffect {
        name,
        entry: entry.clone(),
        effect_mm: found.effect,
        low_mm: found.low,
        high_mm: found.high,
    };
    Ok(InputEffects {
        inputs: inputs.map(effect).collect(),
        confidence: study.file.confidence,
        replicates: of.len(),
    })
}
