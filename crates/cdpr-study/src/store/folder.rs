//! The folder of a study's results, complete by itself: beside tables, figures and `summary.json` it holds
//! the study as it was run (`study.json`), the robot (`robot.json`), what was observed (`blocks`), and how
//! long it took (`timings.json`, apart from the summary, which is the same from run to run).

use crate::error::StudyError;
use crate::file::study_file::StudyFile;
use crate::fs::input::{read_bytes, read_text};
use crate::fs::lock::Access;
use crate::fs::manifest::{Manifest, ResultsOf, digest, is_plain_folder, make_plain_folder, read};
use crate::fs::owned::ResultsFolder;
use crate::kind::InputKind;
use crate::model::study::Study;
use crate::names::{BLOCKS_NAME, ROBOT_NAME, STUDY_NAME};
use crate::store::blocks::Blocks;
use std::path::Path;
use std::sync::Arc;

/// Files that [`begin`] writes.
const BEGUN: [&str; 2] = [ROBOT_NAME, STUDY_NAME];

/// What becomes of blocks that a folder holds already.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Existing {
    /// They are left alone, and the folder is refused.
    Refuse,
    /// Those of the same study are kept and the rest is made.
    GoOn,
    /// The same, while other processes make other blocks of the same study.
    Share,
    /// All are removed, of whatever study they are, with its tables and figures.
    Overwrite,
}

/// Makes the folder for the results of a study, or goes on with one: before anything is computed. The folder
/// is locked until the blocks are dropped.
///
/// # Errors
/// [`StudyError::Write`]; [`StudyError::FolderBusy`] where another process writes into the folder,
/// [`StudyError::FolderInUse`] and [`StudyError::ForeignFolder`] for blocks of this study and of others,
/// [`StudyError::NoResults`], [`StudyError::Link`] and [`StudyError::OtherResults`] for what stands there and
/// is not of a run.
pub fn begin(folder: &Path, study: &Study, existing: Existing) -> Result<Blocks, StudyError> {
    let access = if existing == Existing::Share { Access::Shared } else { Access::Alone };
    let results = ResultsFolder::take(folder, ResultsOf::Study, access, |name| study.file.writes(name))?;
    let results = Arc::new(results);
    settle(&results, study, existing)?;
    if existing == Existing::Share {
        results.share()?;
    }
    Blocks::owned(results, study)
}

/// Makes a folder that this process has locked one of this study.
fn settle(results: &Arc<ResultsFolder>, study: &Study, existing: Existing) -> Result<(), StudyError> {
    let blocks = Blocks::owned(results.clone(), study)?;
    let hash = study.hash()?;
    if !results.is_alone() && results.study().as_ref() != Some(&hash) {
        return Err(StudyError::FolderBusy { folder: results.path().to_owned() });
    }
    if existing == Existing::Overwrite {
        results.overwrite();
        results.check_plain()?;
        is_plain_folder(&results.path().join(BLOCKS_NAME))?;
        // Without its summary and its report, nobody takes the rest for the results of a study.
        blocks.remove_summary()?;
        results.remove_all_but(&BEGUN)?;
        blocks.remove()?;
    } else {
        check_study(results, study)?;
    }
    if existing == Existing::Refuse {
        let blocks = blocks.count()?;
        if blocks > 0 {
            return Err(StudyError::FolderInUse { folder: results.path().to_owned(), blocks });
        }
    }
    if results.study().is_some_and(|found| found != hash) {
        blocks.remove_summary()?;
    }
    make_plain_folder(&results.path().join(BLOCKS_NAME))?;
    write_study(results, study, &blocks)
}

/// The study in a folder of results, with its blocks.
#[derive(Debug)]
pub struct StoredStudy {
    /// The study.
    pub study: Study,
    /// Its blocks of observations.
    pub blocks: Blocks,
}

/// Opens the study in a folder of results, to be read.
///
/// # Errors
/// As [`Study::open`]; [`StudyError::Read`] for a folder without blocks, [`StudyError::Mixed`] and
/// [`StudyError::Changed`] for a study or robot that is not the one that was run.
pub fn open_results(folder: &Path) -> Result<StoredStudy, StudyError> {
    let study = loop {
        let before = Manifest::read(folder)?;
        let study = open_study(folder);
        // A run that has begun meanwhile may have written another study.
        if study.is_ok() || Manifest::read(folder)? == before {
            break study?;
        }
    };
    let blocks = Blocks::new(folder, &study)?;
    Ok(StoredStudy { study, blocks })
}

/// The same, and this process writes into the folder until the blocks are dropped.
///
/// # Errors
/// As [`open_results`] and [`begin`].
pub fn take_results(folder: &Path, access: Access) -> Result<StoredStudy, StudyError> {
    // A folder that is no folder of results gets no lock.
    if Manifest::read(folder)?.is_none() {
        open_study(folder)?;
    }
    let results = ResultsFolder::take(folder, ResultsOf::Study, access, |_| false)?;
    if access == Access::Shared {
        results.share()?;
    }
    let study = open_study(folder)?;
    let blocks = Blocks::owned(Arc::new(results), &study)?;
    Ok(StoredStudy { study, blocks })
}

impl StoredStudy {
    /// Goes on with more observations of each sampling.
    ///
    /// # Errors
    /// As [`Study::extend`] and [`begin`].
    pub fn extend(mut self, observations: usize) -> Result<Self, StudyError> {
        self.study.extend(observations)?;
        settle(self.blocks.results()?, &self.study, Existing::GoOn)?;
        Ok(self)
    }
}

fn open_study(folder: &Path) -> Result<Study, StudyError> {
    let study = Study::open(&folder.join(STUDY_NAME))?;
    let path = folder.join(BLOCKS_NAME);
    std::fs::read_dir(&path).map_err(|source| StudyError::Read { path: path.clone(), source })?;
    let list = Manifest::read(folder)?;
    read(folder, list.as_ref(), ROBOT_NAME)?;
    check_hash(folder, list.as_ref(), &study.hash()?)?;
    read(folder, list.as_ref(), STUDY_NAME)?;
    Ok(study)
}

/// Checks that the study in a folder of results has the hash of the folder's list. A folder of an earlier
/// version has no list.
///
/// # Errors
/// [`StudyError::Mixed`].
pub(crate) fn check_hash(folder: &Path, list: Option<&Manifest>, found: &str) -> Result<(), StudyError> {
    match list.and_then(|list| list.study.clone()) {
        Some(expected) if expected != found => {
            Err(StudyError::Mixed { path: folder.join(STUDY_NAME), found: found.to_owned(), expected })
        }
        _ => Ok(()),
    }
}

/// Checks that a run of this study may go on in the folder. A folder without a study file holds an
/// interrupted start.
fn check_study(results: &ResultsFolder, study: &Study) -> Result<(), StudyError> {
    let path = results.path().join(STUDY_NAME);
    let (Some(listed), expected) = (results.study(), study.hash()?) else { return Ok(()) };
    if listed == expected || !path.exists() {
        return Ok(());
    }
    let stored = Study::unchecked(&read_text(&path, InputKind::Study)?, &path)?;
    if listed == stored.hash()? && contains(study, &stored)? {
        return Ok(());
    }
    let (folder, version) = (results.path().to_owned(), env!("CARGO_PKG_VERSION"));
    Err(StudyError::ForeignFolder { folder, found: listed, expected, version })
}

/// Whether a study has all samplings of another one, so that their blocks remain what they are.
fn contains(study: &Study, other: &Study) -> Result<bool, StudyError> {
    for (name, spec) in &other.file.samplings {
        let Some(same) = study.file.samplings.get(name) else { return Ok(false) };
        if study.sampling_hash(same)? != other.sampling_hash(spec)? {
            return Ok(false);
        }
    }
    Ok(true)
}

/// Writes the study and its robot into a folder of results, where [`Study::open`] reads them. A summary
/// belongs to the study beside it: it is removed when the study changes, and only then.
fn write_study(results: &ResultsFolder, study: &Study, blocks: &Blocks) -> Result<(), StudyError> {
    let file = StudyFile { robot: ROBOT_NAME.to_owned(), ..study.file.clone() };
    let path = results.path().join(STUDY_NAME);
    let json = serde_json::to_string_pretty(&file);
    let json = json.map_err(|error| StudyError::Write { path, source: error.into() })?;
    let texts = [(ROBOT_NAME, study.robot.to_json() + "\n"), (STUDY_NAME, json + "\n")];
    let (hash, digests) =
        (study.hash()?, texts.each_ref().map(|(name, text)| (*name, Some(digest(text.as_bytes())))));
    let is_there = |(name, text): &&(&str, String)| {
        let found = read_bytes(&results.path().join(name), InputKind::Study);
        found.is_ok_and(|found| found == text.as_bytes())
    };
    let missing: Vec<_> = texts.iter().filter(|text| !is_there(text)).collect();
    if missing.is_empty() && results.is_of(&hash, &digests) {
        return Ok(());
    }
    if !results.is_alone() {
        return Err(StudyError::FolderBusy { folder: results.path().to_owned() });
    }
    blocks.remove_summary()?;
    results.set_study(&hash, &BEGUN.map(|name| (name, None)))?;
    missing.into_iter().try_for_each(|(name, text)| results.write(name, text.as_bytes()).map(|_| ()))?;
    results.set_study(&hash, &digests)
}
