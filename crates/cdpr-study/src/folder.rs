//! The folder of a study's results, complete by itself: beside tables, figures and `summary.json` it holds the study as it was run
//! (`study.json`), the robot (`robot.json`), what was observed (`blocks`), and how long it took (`timings.json`, apart from the
//! summary, which is the same from run to run).

use crate::atomic::{write_atomic, write_json};
use crate::error::StudyError;
use crate::output::{check_folder, remove_stale};
use crate::store::Blocks;
use crate::study::Study;
use cdpr_robot::Robot;
use indexmap::IndexMap;
use serde::{Deserialize, Serialize};
use std::path::{Path, PathBuf};

/// Name of the study file in a folder of results.
pub const STUDY_NAME: &str = "study.json";

/// Name of the robot file in a folder of results.
pub const ROBOT_NAME: &str = "robot.json";

/// Name of the folder of blocks in a folder of results.
pub(crate) const BLOCKS_NAME: &str = "blocks";

/// What becomes of blocks that a folder holds already.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Existing {
    /// They are left alone, and the folder is refused.
    Refuse,
    /// Those of the same study are kept and the rest is made.
    GoOn,
    /// All are removed, of whatever study they are.
    Overwrite,
}

/// Wall times of a run; `timings.json`.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Timings {
    /// Threads.
    pub threads: usize,
    /// Seconds by name of sampling or surface.
    pub seconds: IndexMap<String, f64>,
    /// Seconds by sampling and method of its measures of sensitivity.
    #[serde(default, skip_serializing_if = "IndexMap::is_empty")]
    pub sensitivity: IndexMap<String, IndexMap<String, f64>>,
    /// Seconds of all.
    pub all: f64,
}

impl Study {
    /// Hash of everything that decides what is observed: robot, error models, poses, payload, seed, version of the program. Names, titles, the
    /// numbers of observations and what is made of them leave it as it is.
    ///
    /// # Errors
    /// None that a study which was read can have.
    pub fn hash(&self) -> Result<String, StudyError> {
        let mut file = self.file.clone();
        (file.name, file.source, file.robot) = Default::default();
        // All of these ask for more or fewer rows of the same designs, or for other statistics of them.
        (file.replicates, file.confidence, file.bootstrap_resamples, file.sensitivity) = Default::default();
        for sampling in file.samplings.values_mut() {
            (sampling.title, sampling.observations) = Default::default();
        }
        file.surfaces.clear();
        file.comparison.clear();
        let robot = Robot { name: String::new(), source: None, ..self.robot.clone() };
        let mut hasher = blake3::Hasher::new();
        let whole = (env!("CARGO_PKG_VERSION"), file, robot.to_json());
        serde_json::to_writer(&mut hasher, &whole)
            .map_err(|error| StudyError::Write { path: self.path.clone(), source: error.into() })?;
        // 128 bits tell studies apart, and can be read out.
        Ok(hasher.finalize().to_hex()[..32].to_owned())
    }
}

/// Makes the folder for the results of a study, or goes on with one: before anything is computed.
///
/// # Errors
/// [`StudyError::Write`]; [`StudyError::FolderInUse`] and [`StudyError::ForeignFolder`] for blocks of this study and of others,
/// [`StudyError::NoResults`] for a study or robot file that stands there and is not of a run.
pub fn begin(folder: &Path, study: &Study, existing: Existing) -> Result<Blocks, StudyError> {
    check_folder(folder)?;
    let path = folder.join(BLOCKS_NAME);
    let blocks = Blocks::new(folder, study)?;
    if path.is_dir() {
        let unwritten = |source| StudyError::Write { path: path.clone(), source };
        match existing {
            Existing::Overwrite => std::fs::remove_dir_all(&path).map_err(unwritten)?,
            Existing::Refuse => {
                check_study(folder, study)?;
                let blocks = blocks.count()?;
                if blocks > 0 {
                    return Err(StudyError::FolderInUse { folder: folder.to_owned(), blocks });
                }
            }
            Existing::GoOn => check_study(folder, study)?,
        }
    } else if let Some(name) = [STUDY_NAME, ROBOT_NAME].iter().find(|name| folder.join(name).exists()) {
        // Somebody's own file, perhaps the very study that is to run.
        return Err(StudyError::NoResults { path: folder.join(name) });
    }
    remove_stale(folder.join("summary.json"))?;
    std::fs::create_dir_all(&path).map_err(|source| StudyError::Write { path, source })?;
    write_study(folder, study)?;
    Ok(blocks)
}

/// The study in a folder of results and its blocks.
///
/// # Errors
/// As [`Study::open`]; [`StudyError::Read`] for a folder without blocks.
pub fn open_results(folder: &Path) -> Result<(Study, Blocks), StudyError> {
    let study = Study::open(&folder.join(STUDY_NAME))?;
    let path = folder.join(BLOCKS_NAME);
    std::fs::read_dir(&path).map_err(|source| StudyError::Read { path: path.clone(), source })?;
    let blocks = Blocks::new(folder, &study)?;
    Ok((study, blocks))
}

/// The study that a folder with blocks is of is the one to run. Without a study file it was begun only.
fn check_study(folder: &Path, study: &Study) -> Result<(), StudyError> {
    let path = folder.join(STUDY_NAME);
    if !path.exists() {
        return Ok(());
    }
    let (found, expected) = (Study::open(&path)?.hash()?, study.hash()?);
    if found == expected {
        return Ok(());
    }
    let version = env!("CARGO_PKG_VERSION");
    Err(StudyError::ForeignFolder { folder: folder.to_owned(), found, expected, version })
}

/// Writes the study and its robot into a folder of results: [`Study::open`] reads them there.
fn write_study(folder: &Path, study: &Study) -> Result<(), StudyError> {
    write_atomic(folder.join(ROBOT_NAME), (study.robot.to_json() + "\n").as_bytes())?;
    let mut file = study.file.clone();
    file.robot = ROBOT_NAME.to_owned();
    write_json(folder.join(STUDY_NAME), &file)?;
    Ok(())
}

/// Writes `timings.json`.
///
/// # Errors
/// [`StudyError::Write`].
pub fn write_timings(folder: &Path, timings: &Timings) -> Result<PathBuf, StudyError> {
    write_json(folder.join("timings.json"), timings)
}
