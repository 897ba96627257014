//! Observations of a study: deflections of robots whose parameters deviate.

use crate::answers::failure::Failure;
use crate::question::ObserveReplicate;
use cdpr_robot::Robot;
use cdpr_sensitivity::{Effects, SampleDesign};
use cdpr_study::{
    Measured, Part, PartVerdict, STUDY_NAME, ScalarCount, Session, Study, StudyFile, ValueSummary,
    effects_of_replicates, observe as observe_sampling, observe_into, observe_replicate,
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
    /// What comes out, in the words of the program and the report.
    sentences: Vec<String>,
    /// Failures by kind.
    failed: BTreeMap<String, usize>,
    scalar: ScalarCount,
    /// Deflection of the nominal robot [mm].
    nominal_mm: f64,
    /// Effects of the inputs in this design, for the question `effects`.
    effects: Option<Effects>,
}

/// Observations with their inputs.
#[derive(Serialize)]
pub(crate) struct Table {
    /// Seed of the study.
    seed: u64,
    inputs: Vec<Column>,
    /// Names of the outputs, with their units.
    outputs: &'static [&'static str],
    rows: Vec<Row>,
}

/// An input of a table.
#[derive(Serialize)]
struct Column {
    name: String,
    /// Unit of its deviations; absent for a cause of parameters in different units.
    unit: Option<&'static str>,
}

/// An observation.
#[derive(Serialize)]
struct Row {
    /// Deviations of the inputs, in SI units.
    inputs: Vec<f64>,
    /// The outputs; absent if it failed.
    outputs_mm: Option<Vec<f64>>,
    /// Why it failed.
    failure: Option<Failure>,
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
    let summary = ValueSummary::of(&sampling, &tally);
    Ok(Observed {
        sentences: PartVerdict::outcome(&sampling, &tally, summary.as_ref()),
        summary,
        nominal_mm: sampling.nominal_value,
        effects: tally.sums.effects(sampling.design.inputs()).ok(),
        values_mm: tally.first_values,
        failed: tally.failed,
        scalar: tally.scalar,
    })
}

pub(crate) fn table(study: &Study) -> Result<Table, Failure> {
    let sampling = study.sampling(SAMPLING)?;
    let named = sampling.design.inputs();
    let of_part = |part: &Part| -> Vec<Row> {
        let inputs = part.rows.chunks_exact(named.len());
        inputs.zip(&part.outcomes).map(|(inputs, outcome)| row(inputs, outcome)).collect()
    };
    let mut rows = Vec::new();
    observe_into(&sampling, &Session::in_memory(), of_part, |part| {
        rows.extend(part);
        Ok(())
    })?;
    let column = |(number, input): (usize, &cdpr_sensitivity::Input)| Column {
        name: input.name.clone(),
        unit: sampling.errors.unit(number),
    };
    Ok(Table {
        seed: study.file.seed,
        inputs: named.iter().enumerate().map(column).collect(),
        outputs: sampling.output().columns(),
        rows,
    })
}

fn row(inputs: &[f64], outcome: &cdpr_study::Observed) -> Row {
    let failure =
        |failed: &cdpr_study::Failure| Failure { kind: failed.kind.clone(), reason: failed.reason.clone() };
    Row {
        inputs: inputs.to_vec(),
        outputs_mm: outcome.as_ref().ok().map(|measured| Measured::cells(measured).collect()),
        failure: outcome.as_ref().err().map(failure),
    }
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
