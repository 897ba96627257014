//! Progress of a study in a folder of results.

use crate::error::StudyError;
use crate::file::output::Output;
use crate::model::designs::Design;
use crate::model::observed::{Observed, failures, value_of};
use crate::model::study::Study;
use crate::observe::plan::{Plan, Planned};
use crate::store::blocks::{BlockId, Blocks};
use cdpr_sensitivity::Moments;
use indexmap::IndexMap;
use serde::Serialize;
use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

/// Progress of a study.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Status {
    /// Name of the study.
    pub study: String,
    /// Its hash.
    pub hash: String,
    /// Whether all blocks exist, so that the study can be merged.
    pub complete: bool,
    /// Whether tables and figures have been made of them.
    pub analysed: bool,
    /// Its samplings by name.
    pub samplings: IndexMap<String, SamplingStatus>,
    /// Files of the analysed results that were changed or removed after the run that wrote them.
    #[serde(serialize_with = "as_texts", skip_serializing_if = "Vec::is_empty")]
    pub changed: Vec<PathBuf>,
}

/// Progress of a sampling.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct SamplingStatus {
    /// Its designs by name: its own, `sampling`, and those of replicates and measures; summed over all poses,
    /// if it has several.
    pub designs: IndexMap<String, DesignStatus>,
    /// Poses at which the nominal robot has no feasible tensions, and which therefore have no blocks.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub poses_not_held: Option<usize>,
    /// Moments of the output over the existing observations of its own design; `None` for fewer than two, or
    /// for several poses.
    #[serde(flatten)]
    pub provisional: SoFar,
}

/// Progress of a design.
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
pub struct DesignStatus {
    /// Blocks that exist and are whole.
    pub blocks_done: usize,
    /// Missing blocks, damaged ones included.
    pub blocks_missing: usize,
    /// Damaged blocks: each will be made again.
    #[serde(serialize_with = "as_texts")]
    pub damaged: Vec<PathBuf>,
    /// Existing observations.
    pub observed: usize,
    /// Observations of the whole design.
    pub observations: usize,
    /// Failed ones among the existing observations, by kind.
    pub failed: BTreeMap<String, usize>,
}

/// Moments of the output over the observations so far.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SoFar {
    /// What is observed.
    pub output: Output,
    /// Its moments in its unit.
    pub moments: Option<Provisional>,
}

impl Serialize for SoFar {
    fn serialize<S: serde::Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.collect_map([(self.output.named("provisional_magnitude_mm"), self.moments)])
    }
}

/// Moments of the observations so far.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Provisional {
    /// Mean.
    pub mean: f64,
    /// Standard deviation, with n - 1.
    pub std: f64,
}

/// Paths as texts, also those that are not UTF-8.
fn as_texts<S: serde::Serializer>(paths: &[PathBuf], serializer: S) -> Result<S::Ok, S::Error> {
    serializer.collect_seq(paths.iter().map(|path| path.to_string_lossy()))
}

/// Reads all blocks of a study, and all files of its results if it was analysed, and reports its progress.
///
/// # Errors
/// [`StudyError::Read`]; [`StudyError::ForeignBlock`].
pub fn status(study: &Study, blocks: &Blocks) -> Result<Status, StudyError> {
    let mut samplings = IndexMap::new();
    for (name, spec) in &study.file.samplings {
        let designs = study.designs(name, spec)?.into_iter();
        let designs = designs.map(|(design, _)| (design.name(), DesignStatus::default())).collect();
        let provisional = SoFar { output: study.file.output, moments: None };
        let poses_not_held = spec.poses.as_ref().map(|_| 0);
        samplings.insert(name.clone(), SamplingStatus { designs, poses_not_held, provisional });
    }
    let mut moments: IndexMap<String, Moments> = IndexMap::new();
    visit(
        study,
        blocks,
        |_| true,
        |Seen { block, path, outcomes }| {
            let Some(sampling) = samplings.get_mut(block.entry) else { return };
            let Some(found) = sampling.designs.get_mut(&block.design.name()) else { return };
            let Some(outcomes) = outcomes else {
                if let (Some(not_held), 0) = (&mut sampling.poses_not_held, block.number) {
                    *not_held += 1;
                }
                return;
            };
            found.observations += block.range.len();
            let Ok(outcomes) = outcomes else {
                found.blocks_missing += 1;
                return found.damaged.push(path);
            };
            let whole = outcomes.len() == block.range.len();
            *(if whole { &mut found.blocks_done } else { &mut found.blocks_missing }) += 1;
            found.observed += outcomes.len();
            for kind in failures(&outcomes) {
                *found.failed.entry(kind.to_owned()).or_default() += 1;
            }
            if block.design == Design::Own && sampling.poses_not_held.is_none() {
                let moments = moments.entry(block.entry.to_owned()).or_default();
                outcomes.iter().for_each(|outcome| moments.add(value_of(outcome)));
            }
        },
    )?;
    for (name, sampling) in &mut samplings {
        let found = moments.get(name).and_then(|moments| moments.summary().ok());
        sampling.provisional.moments = found.map(|found| Provisional { mean: found.mean, std: found.std });
    }
    let mut all = samplings.values().flat_map(|sampling: &SamplingStatus| sampling.designs.values());
    let complete = all.all(|design| design.blocks_missing == 0);
    let changed = blocks.changed_results()?;
    let analysed = blocks.are_analysed();
    Ok(Status { study: study.file.name.clone(), hash: study.hash()?, complete, analysed, samplings, changed })
}

/// Checks that all blocks of the study in `folder` exist.
///
/// # Errors
/// [`StudyError::MissingBlocks`], damaged ones counted; as [`status`].
pub fn check_complete(folder: &Path, study: &Study, blocks: &Blocks) -> Result<(), StudyError> {
    check(folder, study, blocks, |_| true)
}

/// The same for the observations of one sampling, at one pose; other samplings, replicates and measures of
/// sensitivity do not matter.
///
/// # Errors
/// As [`check_complete`].
pub fn check_observed(
    folder: &Path,
    study: &Study,
    blocks: &Blocks,
    sampling: &str,
) -> Result<(), StudyError> {
    check(folder, study, blocks, |block| block.design == Design::Own && block.sampling == sampling)
}

fn check(
    folder: &Path,
    study: &Study,
    blocks: &Blocks,
    wanted: impl Fn(&Planned) -> bool,
) -> Result<(), StudyError> {
    let (mut all, mut missing) = (0, Vec::new());
    visit(study, blocks, wanted, |Seen { block, path, outcomes }| {
        let Some(outcomes) = outcomes else { return };
        all += 1;
        if !outcomes.is_ok_and(|outcomes| outcomes.len() == block.range.len()) {
            missing.push(path);
        }
    })?;
    match missing.first().cloned() {
        None => Ok(()),
        Some(first) => {
            let (folder, missing) = (folder.to_owned(), missing.len());
            Err(StudyError::MissingBlocks { folder, missing, blocks: all, first })
        }
    }
}

/// A block of a study and its state on disk.
struct Seen<'a> {
    block: Planned<'a>,
    path: PathBuf,
    /// Its content, or why it is damaged; `None` for a pose without feasible tensions, where nothing is
    /// missing.
    outcomes: Option<Result<Vec<Observed>, StudyError>>,
}

/// Shows each block of a study that is wanted.
fn visit(
    study: &Study,
    blocks: &Blocks,
    wanted: impl Fn(&Planned) -> bool,
    mut see: impl FnMut(Seen),
) -> Result<(), StudyError> {
    let plan = Plan::new(study)?;
    // A pose without feasible tensions lacks no block. This is checked once for each pose, and only if a
    // block is missing.
    let mut held = (String::new(), true);
    let mut is_held = |block: &Planned| {
        if block.sampling != held.0 {
            held = (block.sampling.clone(), study.held(&block.sampling)?.is_some());
        }
        Ok::<_, StudyError>(held.1)
    };
    for block in (0..plan.blocks()).filter_map(|number| plan.block(number)).filter(wanted) {
        let design = block.design.name();
        let (number, recorded) = (block.number, block.design.recorded());
        let id = BlockId { sampling: &block.sampling, design: &design, number, recorded };
        let outcomes = match blocks.read(&id) {
            Ok(outcomes) if outcomes.is_empty() && block.sampling != block.entry && !is_held(&block)? => None,
            Ok(mut outcomes) => {
                outcomes.truncate(block.range.len());
                Some(Ok(outcomes))
            }
            Err(error @ StudyError::DamagedBlock { .. }) => Some(Err(error)),
            Err(error) => return Err(error),
        };
        see(Seen { path: blocks.path(&id), block, outcomes });
    }
    Ok(())
}
