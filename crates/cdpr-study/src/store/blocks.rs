//! The blocks of a study on disk: `blocks/SAMPLING/DESIGN/NUMBER.block`, each written atomically. A block
//! belongs to the results by its name and its header; other files among the blocks are left alone, and links
//! are not followed.

use crate::error::StudyError;
use crate::file::output::{Output, Recorded};
use crate::fs::atomic::{is_unfinished, remove_unfinished, write_atomic};
use crate::fs::disk;
use crate::fs::input::{read_bytes, read_start};
use crate::fs::manifest::make_plain_folder;
use crate::fs::manifest::{Manifest, changed_files, entries, is_plain_file, is_plain_folder};
use crate::fs::owned::ResultsFolder;
use crate::kind::InputKind;
use crate::model::designs::Design;
use crate::model::observed::{Observed, count_failed, failures};
use crate::model::study::Study;
use crate::names::{BLOCKS_NAME, REPORT_NAME, SUMMARY_NAME};
use crate::store::block::{BLOCK, BlockHeader, decode, encode, header_of};
use indexmap::IndexMap;
use std::io::ErrorKind;
use std::path::{Component, Path, PathBuf};
use std::sync::Arc;

/// Bytes of a block's file in which its header ends.
const HEADER: u64 = 1 << 16;

/// The folder of a study's blocks.
#[derive(Clone, Debug)]
pub struct Blocks {
    /// Folder of the results.
    results: PathBuf,
    /// The same, if this process writes into it.
    owned: Option<Arc<ResultsFolder>>,
    /// Folder of the blocks in it.
    folder: PathBuf,
    /// Hashes of the samplings of the study file, by name.
    hashes: IndexMap<String, String>,
    /// What the study observes.
    output: Output,
}

/// Identity of a block.
#[derive(Clone, Copy, Debug)]
pub(crate) struct BlockId<'a> {
    pub(crate) sampling: &'a str,
    pub(crate) design: &'a str,
    pub(crate) number: usize,
    /// What it keeps of each observation.
    pub(crate) recorded: Recorded,
}

impl Blocks {
    /// Blocks of a study in the folder `blocks` of its results, to be read.
    ///
    /// # Errors
    /// As [`Study::hash`].
    pub(crate) fn new(results: &Path, study: &Study) -> Result<Self, StudyError> {
        let hashes = study.file.samplings.iter();
        let hashes = hashes.map(|(name, spec)| Ok((name.clone(), study.sampling_hash(spec)?)));
        Ok(Self {
            results: results.to_owned(),
            owned: None,
            folder: results.join(BLOCKS_NAME),
            hashes: hashes.collect::<Result<_, StudyError>>()?,
            output: study.file.output,
        })
    }

    /// Blocks of a study in a folder that this process writes into.
    ///
    /// # Errors
    /// As [`Study::hash`].
    pub(crate) fn owned(results: Arc<ResultsFolder>, study: &Study) -> Result<Self, StudyError> {
        Ok(Self { owned: Some(results.clone()), ..Self::new(results.path(), study)? })
    }

    /// The folder of the results, which this process writes into.
    ///
    /// # Errors
    /// [`StudyError::NotOwned`] for blocks that were opened to be read.
    pub fn results(&self) -> Result<&Arc<ResultsFolder>, StudyError> {
        self.owned.as_ref().ok_or_else(|| StudyError::NotOwned { folder: self.results.clone() })
    }

    /// Shares the folder from now on with other processes that make blocks of the same study.
    ///
    /// # Errors
    /// [`StudyError::FolderBusy`] where another process took the folder meanwhile.
    pub fn share(&self) -> Result<(), StudyError> {
        self.results()?.share()
    }

    pub(crate) fn path(&self, id: &BlockId) -> PathBuf {
        let folder = self.folder.join(id.sampling).join(id.design);
        folder.join(format!("{:06}.block", id.number))
    }

    /// The known observations of a block, from the first on. A damaged block causes a warning and has none.
    ///
    /// # Errors
    /// [`StudyError::Read`]; [`StudyError::ForeignBlock`] for a block that belongs elsewhere.
    pub(crate) fn known(
        &self,
        id: &BlockId,
        warn: &dyn Fn(&StudyError),
    ) -> Result<Vec<Observed>, StudyError> {
        match self.read(id) {
            Err(error @ StudyError::DamagedBlock { .. }) => {
                warn(&error);
                Ok(Vec::new())
            }
            read => read,
        }
    }

    /// The same, but a damaged block is an error.
    pub(crate) fn read(&self, id: &BlockId) -> Result<Vec<Observed>, StudyError> {
        let path = self.path(id);
        let file = match read_bytes(&path, InputKind::Block) {
            Err(StudyError::Read { source, .. }) if source.kind() == ErrorKind::NotFound => {
                return Ok(Vec::new());
            }
            read => read?,
        };
        let (header, outcomes) =
            decode(&file).map_err(|reason| StudyError::DamagedBlock { path: path.clone(), reason })?;
        let wanted = self.header(id, &outcomes);
        let foreign = |field, found: &str, expected: &str| StudyError::ForeignBlock {
            path: path.clone(),
            field,
            found: found.to_owned(),
            expected: expected.to_owned(),
        };
        // The version is compared first, because another version also changes the hash.
        for (field, found, expected) in [
            ("version", &header.version, &wanted.version),
            ("study", &header.study, &wanted.study),
            ("sampling", &header.sampling, &wanted.sampling),
            ("design", &header.design, &wanted.design),
            ("recorded", &format!("{:?}", header.recorded), &format!("{:?}", wanted.recorded)),
            ("first index", &header.first.to_string(), &wanted.first.to_string()),
        ] {
            if found != expected {
                return Err(foreign(field, found, expected));
            }
        }
        if outcomes.len() > BLOCK {
            return Err(foreign(
                "size",
                &outcomes.len().to_string(),
                &format!("at most {BLOCK} observations"),
            ));
        }
        Ok(outcomes)
    }

    /// Writes a block over its shorter or damaged version, unless another process has done so meanwhile. A
    /// summary that is then out of date is removed first, with its report.
    ///
    /// # Errors
    /// [`StudyError::Write`], [`StudyError::Link`], [`StudyError::ForeignBlock`], [`StudyError::NotOwned`].
    pub(crate) fn write(&self, id: &BlockId, outcomes: &[Observed]) -> Result<(), StudyError> {
        let results = self.results()?;
        let path = self.path(id);
        let mut folder = results.path().to_owned();
        // The name of a sampling at one of several poses has two parts.
        for part in [BLOCKS_NAME].into_iter().chain(id.sampling.split('/')).chain([id.design]) {
            folder.push(part);
            make_plain_folder(&folder)?;
        }
        if is_plain_file(&path)? {
            match self.read(id) {
                Ok(found) if found.len() >= outcomes.len() => return Ok(()),
                Ok(_) | Err(StudyError::DamagedBlock { .. }) => (),
                Err(error) => return Err(error),
            }
        }
        let file = encode(&self.header(id, outcomes), outcomes)
            .map_err(|error| StudyError::Write { path: path.clone(), source: error.into() })?;
        self.remove_summary()?;
        write_atomic(path, &file)?;
        Ok(())
    }

    /// Observations of a sampling's own design on disk; of several poses at the one that has most.
    ///
    /// # Errors
    /// [`StudyError::Read`].
    pub fn observed(&self, sampling: &str) -> Result<usize, StudyError> {
        let mut most = 0;
        for path in files(&self.folder.join(sampling))? {
            let header = header_of(&read_start(&path, InputKind::Block, HEADER)?).and_then(Result::ok);
            let own = header.filter(|header| header.design == Design::Own.name());
            most = most.max(own.map_or(0, |header| header.first + header.observations));
        }
        Ok(most)
    }

    /// Number of blocks on disk, of any study.
    pub(crate) fn count(&self) -> Result<usize, StudyError> {
        Ok(files(&self.folder)?.iter().filter(|path| is_block(path)).count())
    }

    /// Removes all blocks, of any study, and the folders that are empty then. Other files stay.
    ///
    /// # Errors
    /// [`StudyError::Read`], [`StudyError::Write`], [`StudyError::NotOwned`]; [`StudyError::Link`] for a link
    /// in the place of the folder.
    pub(crate) fn remove(&self) -> Result<(), StudyError> {
        self.results()?;
        if is_plain_folder(&self.folder)? { remove_blocks(&self.folder, &self.folder) } else { Ok(()) }
    }

    /// Removes the summary and the report of an earlier analysis, because new blocks make them out of date.
    ///
    /// # Errors
    /// [`StudyError::Write`], [`StudyError::Link`], [`StudyError::NotOwned`].
    pub(crate) fn remove_summary(&self) -> Result<(), StudyError> {
        [SUMMARY_NAME, REPORT_NAME].into_iter().try_for_each(|name| self.results()?.remove(name))
    }

    /// Whether an analysis of the blocks has been concluded.
    pub(crate) fn are_analysed(&self) -> bool {
        self.results.join(SUMMARY_NAME).exists()
    }

    /// Files of the analysed results that were changed or removed after the run that wrote them. There are
    /// none while another run makes new ones.
    ///
    /// # Errors
    /// [`StudyError::Read`] and those of the list.
    pub(crate) fn changed_results(&self) -> Result<Vec<PathBuf>, StudyError> {
        let state = || Ok::<_, StudyError>((self.are_analysed(), Manifest::read(&self.results)?));
        let before = state()?;
        let changed = if before.0 { changed_files(&self.results)? } else { Vec::new() };
        Ok(if state()? == before { changed } else { Vec::new() })
    }

    /// Removes unfinished files of killed processes, among the blocks and beside them.
    ///
    /// # Errors
    /// [`StudyError::Read`], [`StudyError::Write`].
    pub(crate) fn remove_unfinished(&self) -> Result<(), StudyError> {
        self.results()?.remove_unfinished()?;
        files(&self.folder)?.into_iter().filter(|path| is_unfinished(path)).try_for_each(remove_unfinished)
    }

    fn header(&self, id: &BlockId, outcomes: &[Observed]) -> BlockHeader {
        BlockHeader {
            version: env!("CARGO_PKG_VERSION").to_owned(),
            study: self.hashes.get(entry(id.sampling)).cloned().unwrap_or_default(),
            sampling: id.sampling.to_owned(),
            design: id.design.to_owned(),
            first: id.number * BLOCK,
            observations: outcomes.len(),
            output: self.output,
            recorded: id.recorded,
            failed: count_failed(failures(outcomes)),
        }
    }
}

/// Name in the study file of a sampling, which may be `NAME/0000`.
fn entry(sampling: &str) -> &str {
    sampling.split_once('/').map_or(sampling, |(entry, _)| entry)
}

fn is_block(path: &Path) -> bool {
    path.extension().is_some_and(|extension| extension == "block")
}

/// Whether a run has written a file among the blocks: one with the header of this very place, or one that is
/// damaged there.
fn belongs(folder: &Path, path: &Path) -> Result<bool, StudyError> {
    let place = path.strip_prefix(folder).unwrap_or(path).components().map(|part| match part {
        Component::Normal(part) => part.to_str(),
        _ => None,
    });
    let Some(place) = place.collect::<Option<Vec<_>>>() else { return Ok(false) };
    let [sampling @ .., design, file] = place.as_slice() else { return Ok(false) };
    let number = file.strip_suffix(".block").filter(|digits| digits.len() >= 6);
    let number = number.filter(|digits| digits.bytes().all(|digit| digit.is_ascii_digit()));
    let Some(Ok(number)) = number.map(str::parse::<usize>) else { return Ok(false) };
    if !(1..=2).contains(&sampling.len()) {
        return Ok(false);
    }
    let start = read_start(path, InputKind::Block, HEADER)?;
    Ok(match header_of(&start) {
        Some(Ok(header)) => {
            header.sampling == sampling.join("/")
                && header.design == *design
                && Some(header.first) == number.checked_mul(BLOCK)
        }
        Some(Err(())) => true,
        None => start.is_empty(),
    })
}

/// Removes the blocks and unfinished files below a folder. Links are neither followed nor removed.
fn remove_blocks(root: &Path, folder: &Path) -> Result<(), StudyError> {
    for (path, kind) in entries(folder)? {
        let removed = if kind.is_dir() {
            remove_blocks(root, &path)?;
            // A folder that is not empty stays.
            disk::remove_folder(&path)
        } else if kind.is_file() && (is_unfinished(&path) || belongs(root, &path)?) {
            disk::remove(&path)
        } else {
            Ok(())
        };
        removed.map_err(|source| StudyError::Write { path, source })?;
    }
    Ok(())
}

/// All plain files below a folder, except behind links; none if the folder does not exist.
fn files(folder: &Path) -> Result<Vec<PathBuf>, StudyError> {
    let mut folders = Vec::new();
    if is_plain_folder(folder)? {
        folders.push(folder.to_owned());
    }
    let mut files = Vec::new();
    while let Some(folder) = folders.pop() {
        for (path, kind) in entries(&folder)? {
            if kind.is_dir() {
                folders.push(path);
            } else if kind.is_file() {
                files.push(path);
            }
        }
    }
    Ok(files)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::fs::atomic::AtomicFile;
    use crate::fs::manifest::ResultsOf;
    use crate::fs::single::IfExists;
    use std::fs;
    use std::io::Write;

    fn blocks(results: &Path) -> Blocks {
        let owned = ResultsFolder::begin(results, ResultsOf::Study, IfExists::Refuse, |_| false).unwrap();
        owned.claim([SUMMARY_NAME.to_owned(), "plane/0000.csv".to_owned()]).unwrap();
        Blocks {
            results: results.to_owned(),
            owned: Some(Arc::new(owned)),
            folder: results.join(BLOCKS_NAME),
            hashes: [("mechanical".to_owned(), "a hash".to_owned())].into(),
            output: Output::Deflection,
        }
    }

    #[test]
    fn a_summary_goes_with_a_block_that_it_does_not_know_and_with_no_other() {
        let results = tempfile::tempdir().unwrap();
        let (blocks, summary) = (blocks(results.path()), results.path().join(SUMMARY_NAME));
        let id =
            BlockId { sampling: "mechanical", design: "sampling", number: 0, recorded: Recorded::Output };
        for (observations, stays) in [(2, false), (2, true), (1, true), (3, false)] {
            fs::write(&summary, "of all blocks").unwrap();
            blocks.write(&id, &vec![Ok(Output::Deflection.nothing()); observations]).unwrap();
            assert_eq!(summary.exists(), stays, "{observations} observations");
            assert!(blocks.read(&id).unwrap().len() >= observations);
        }
    }

    #[test]
    fn what_is_being_written_stays_and_what_was_left_goes() {
        let folder = tempfile::tempdir().unwrap();
        let results = folder.path().to_owned();
        let blocks = blocks(&results);
        let design = blocks.folder.join("mechanical/sampling");
        let folders = [results.clone(), results.join("plane"), design];
        let mut written = Vec::new();
        for folder in &folders {
            fs::create_dir_all(folder).unwrap();
            // As a killed process leaves it, without a lock.
            fs::write(folder.join(".cdpr-left.tmp"), "half").unwrap();
            let mut file = AtomicFile::new(folder.join("written")).unwrap();
            file.write_all(b"whole").unwrap();
            written.push(file);
        }
        blocks.remove_unfinished().unwrap();
        for (folder, file) in folders.iter().zip(written) {
            assert!(!folder.join(".cdpr-left.tmp").exists());
            assert_eq!(fs::read(file.finish().unwrap()).unwrap(), b"whole");
        }
    }
}
