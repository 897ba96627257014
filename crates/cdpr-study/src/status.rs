//! How far a study in a folder of results is.

use crate::block::blocks;
use crate::designs::Design;
use crate::error::StudyError;
use crate::observation::{Observed, failures, outcome_rms_mm};
use crate::store::{Blocks, Place};
use crate::study::Study;
use cdpr_sensitivity::Moments;
use indexmap::IndexMap;
use serde::Serialize;
use std::collections::BTreeMap;
use std::ops::Range;
use std::path::{Path, PathBuf};

/// How far a study is.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Status {
    /// Name of the study.
    pub study: String,
    /// Its hash.
    pub hash: String,
    /// Whether all blocks are there, so that it can be merged.
    pub complete: bool,
    /// Its samplings by name.
    pub samplings: IndexMap<String, SamplingStatus>,
}

/// How far a sampling is.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct SamplingStatus {
    /// Its designs by name: its own, `sampling`, and those of replicates and measures.
    pub designs: IndexMap<String, DesignStatus>,
    /// What its own observations that are there say of the RMS, wherever they are; none for fewer than two.
    pub provisional_rms_mm: Option<Provisional>,
}

/// How far a design is.
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
pub struct DesignStatus {
    /// Blocks that are there and whole.
    pub blocks_done: usize,
    /// Blocks that are not, damaged ones among them.
    pub blocks_missing: usize,
    /// Damaged blocks: each will be made again.
    pub damaged: Vec<PathBuf>,
    /// Observations that are there.
    pub observed: usize,
    /// Observations of the whole design.
    pub observations: usize,
    /// Failed ones of those that are there, by kind.
    pub failed: BTreeMap<String, usize>,
}

/// Moments of the observations so far [mm].
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Provisional {
    /// Mean.
    pub mean: f64,
    /// Standard deviation, with n - 1.
    pub std: f64,
}

/// Reads all blocks of a study and says which are there.
///
/// # Errors
/// [`StudyError::Read`]; [`StudyError::ForeignBlock`].
pub fn status(study: &Study, blocks: &Blocks) -> Result<Status, StudyError> {
    let mut samplings = IndexMap::new();
    for name in study.file.samplings.keys() {
        let mut moments = Moments::default();
        let mut designs = IndexMap::new();
        for (design, points) in study.sampling(name)?.designs() {
            let mut found = DesignStatus { observations: points, ..DesignStatus::default() };
            let design_name = design.name();
            visit(blocks, name, &design_name, points, |path, range, outcomes| {
                let Ok(outcomes) = outcomes else {
                    found.blocks_missing += 1;
                    return found.damaged.push(path);
                };
                let whole = outcomes.len() == range.len();
                *(if whole { &mut found.blocks_done } else { &mut found.blocks_missing }) += 1;
                found.observed += outcomes.len();
                for kind in failures(&outcomes) {
                    *found.failed.entry(kind.to_owned()).or_default() += 1;
                }
                if design == Design::Own {
                    outcomes.iter().for_each(|outcome| moments.add(outcome_rms_mm(outcome)));
                }
            })?;
            designs.insert(design_name, found);
        }
        let provisional = moments.summary().ok().map(|rms| Provisional { mean: rms.mean, std: rms.std });
        samplings.insert(name.clone(), SamplingStatus { designs, provisional_rms_mm: provisional });
    }
    let mut all = samplings.values().flat_map(|sampling: &SamplingStatus| sampling.designs.values());
    let complete = all.all(|design| design.blocks_missing == 0);
    Ok(Status { study: study.file.name.clone(), hash: study.hash()?, complete, samplings })
}

/// Sees to it that all blocks of the study in `folder` are there.
///
/// # Errors
/// [`StudyError::MissingBlocks`], damaged ones counted; as [`status`].
pub fn check_complete(folder: &Path, study: &Study, blocks: &Blocks) -> Result<(), StudyError> {
    let (mut all, mut missing) = (0, Vec::new());
    for name in study.file.samplings.keys() {
        for (design, points) in study.sampling(name)?.designs() {
            visit(blocks, name, &design.name(), points, |path, range, outcomes| {
                all += 1;
                if !outcomes.is_ok_and(|outcomes| outcomes.len() == range.len()) {
                    missing.push(path);
                }
            })?;
        }
    }
    match missing.first().cloned() {
        None => Ok(()),
        Some(first) => {
            let (folder, missing) = (folder.to_owned(), missing.len());
            Err(StudyError::MissingBlocks { folder, missing, blocks: all, first })
        }
    }
}

/// Shows each block of a design: path, range of indices, and what of it is there or why it is damaged.
fn visit(
    blocks_on_disk: &Blocks,
    sampling: &str,
    design: &str,
    points: usize,
    mut see: impl FnMut(PathBuf, Range<usize>, Result<Vec<Observed>, StudyError>),
) -> Result<(), StudyError> {
    for (number, range) in blocks(points) {
        let place = Place { sampling, design, number };
        let read = match blocks_on_disk.read(&place) {
            Ok(mut outcomes) => {
                outcomes.truncate(range.len());
                Ok(outcomes)
            }
            Err(error @ StudyError::DamagedBlock { .. }) => Err(error),
            Err(error) => return Err(error),
        };
        see(blocks_on_disk.path(&place), range, read);
    }
    Ok(())
}
