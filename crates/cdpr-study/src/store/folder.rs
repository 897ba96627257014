//! The folder of a study's results, complete by itself: beside tables, figures and `summary.json` it holds
//! the study as it was run (`study.json`), the robot (`robot.json`), what was observed (`blocks`), and how
//! long it took (`timings.json`, apart from the summary, which is the same from run to run). A file of its
//! own tells it from a folder in which somebody keeps a study.

use crate::error::StudyError;
use crate::file::names::remove_files;
use crate::file::study_file::StudyFile;
use crate::fs::atomic::write_atomic;
use crate::fs::files::{check_folder, read, remove_stale};
use crate::model::study::Study;
use crate::names::{BLOCKS_NAME, MARK_NAME, REPORT_NAME, ROBOT_NAME, STUDY_NAME, SUMMARY_NAME, TIMINGS_NAME};
use crate::store::blocks::Blocks;
use cdpr_robot::from_json;
use std::path::Path;

const MARK: &str = "Results of a study, written by cdpr, which knows this folder by this file.
`cdpr study run --overwrite` removes the blocks, tables and figures of the study in study.json,
and nothing else.
";

/// What becomes of blocks that a folder holds already.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Existing {
    /// They are left alone, and the folder is refused.
    Refuse,
    /// Those of the same study are kept and the rest is made.
    GoOn,
    /// All are removed, of whatever study they are, with its tables and figures.
    Overwrite,
}

/// Makes the folder for the results of a study, or goes on with one: before anything is computed. Several
/// processes may do so at once.
///
/// # Errors
/// [`StudyError::Write`]; [`StudyError::FolderInUse`] and [`StudyError::ForeignFolder`] for blocks of this
/// study and of others, [`StudyError::NoResults`] for a study or robot file that stands there and is not of a
/// run.
pub fn begin(folder: &Path, study: &Study, existing: Existing) -> Result<Blocks, StudyError> {
    check_folder(folder)?;
    let blocks = Blocks::new(folder, study)?;
    // Looked for before the mark, which another process that begins at the same moment writes first.
    let found = [STUDY_NAME, ROBOT_NAME].map(|name| folder.join(name)).into_iter().find(|path| path.exists());
    let mark = folder.join(MARK_NAME);
    match (found, mark.exists(), existing) {
        // Somebody's own file, perhaps the very study that is to run.
        (Some(path), false, _) => return Err(StudyError::NoResults { path }),
        (_, true, Existing::Overwrite) => remove_results(folder, &blocks)?,
        (_, true, _) => check_study(folder, study)?,
        (None, false, _) => (),
    }
    if existing == Existing::Refuse {
        let blocks = blocks.count()?;
        if blocks > 0 {
            return Err(StudyError::FolderInUse { folder: folder.to_owned(), blocks });
        }
    }
    if !mark.exists() {
        write_atomic(mark, MARK.as_bytes())?;
    }
    let path = folder.join(BLOCKS_NAME);
    std::fs::create_dir_all(&path).map_err(|source| StudyError::Write { path, source })?;
    write_study(folder, study, &blocks)?;
    Ok(blocks)
}

/// The study in a folder of results, with its blocks.
#[derive(Debug)]
pub struct StoredStudy {
    /// The study.
    pub study: Study,
    /// Its blocks of observations.
    pub blocks: Blocks,
}

/// Opens the study in a folder of results.
///
/// # Errors
/// As [`Study::open`]; [`StudyError::Read`] for a folder without blocks.
pub fn open_results(folder: &Path) -> Result<StoredStudy, StudyError> {
    let study = Study::open(&folder.join(STUDY_NAME))?;
    let path = folder.join(BLOCKS_NAME);
    std::fs::read_dir(&path).map_err(|source| StudyError::Read { path: path.clone(), source })?;
    let blocks = Blocks::new(folder, &study)?;
    Ok(StoredStudy { study, blocks })
}

/// Checks that the study in a folder is the one to run. A folder without a study file holds an interrupted
/// start.
fn check_study(folder: &Path, study: &Study) -> Result<(), StudyError> {
    let path = folder.join(STUDY_NAME);
    if !path.exists() {
        return Ok(());
    }
    let (found, expected) = (Study::unchecked(&read(&path)?, &path)?.hash()?, study.hash()?);
    if found == expected {
        return Ok(());
    }
    let version = env!("CARGO_PKG_VERSION");
    Err(StudyError::ForeignFolder { folder: folder.to_owned(), found, expected, version })
}

/// Writes the study and its robot into a folder of results, where [`Study::open`] reads them. A summary
/// belongs to the study beside it: it is removed when the study changes, and only then.
fn write_study(folder: &Path, study: &Study, blocks: &Blocks) -> Result<(), StudyError> {
    let file = StudyFile { robot: ROBOT_NAME.to_owned(), ..study.file.clone() };
    for (name, text) in
        [(ROBOT_NAME, Ok(study.robot.to_json())), (STUDY_NAME, serde_json::to_string_pretty(&file))]
    {
        let path = folder.join(name);
        let text = match text {
            Ok(text) => text + "\n",
            Err(error) => return Err(StudyError::Write { path, source: error.into() }),
        };
        if std::fs::read(&path).is_ok_and(|found| found == text.as_bytes()) {
            continue;
        }
        blocks.remove_summary()?;
        write_atomic(path, text.as_bytes())?;
    }
    Ok(())
}

/// Removes what runs have written into a folder of results, and nothing else. The study stays, because
/// another one replaces it.
fn remove_results(folder: &Path, blocks: &Blocks) -> Result<(), StudyError> {
    let path = folder.join(STUDY_NAME);
    // A folder without a study file holds an interrupted start.
    if path.exists() {
        let study: StudyFile =
            from_json(&read(&path)?).map_err(|source| StudyError::Format { path, source })?;
        remove_files(folder, &study)?;
    }
    for name in [SUMMARY_NAME, TIMINGS_NAME, REPORT_NAME] {
        remove_stale(folder.join(name))?;
    }
    blocks.remove()
}
