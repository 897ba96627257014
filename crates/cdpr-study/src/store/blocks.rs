//! The blocks of a study on disk: `blocks/SAMPLING/DESIGN/NUMBER.block`, each written atomically.

use crate::error::StudyError;
use crate::fs::atomic::{is_unfinished, remove_unfinished, write_atomic};
use crate::fs::files::remove_stale;
use crate::fs::input::read_bytes;
use crate::kind::InputKind;
use crate::model::observed::{Observed, count_failed, failures};
use crate::model::study::Study;
use crate::names::{BLOCKS_NAME, SUMMARY_NAME};
use crate::store::block::{BLOCK, BlockHeader, decode, encode};
use std::fs;
use std::io::{self, ErrorKind};
use std::path::{Path, PathBuf};

/// The folder of a study's blocks.
#[derive(Clone, Debug)]
pub struct Blocks {
    /// Folder of the results.
    results: PathBuf,
    /// Folder of the blocks in it.
    folder: PathBuf,
    study: String,
    /// Folders of the tables of several poses, beside it.
    tables: Vec<PathBuf>,
}

/// Identity of a block.
#[derive(Clone, Copy, Debug)]
pub(crate) struct BlockId<'a> {
    pub(crate) sampling: &'a str,
    pub(crate) design: &'a str,
    pub(crate) number: usize,
}

impl Blocks {
    /// Blocks of a study in the folder `blocks` of its results.
    ///
    /// # Errors
    /// As [`Study::hash`].
    pub(crate) fn new(results: &Path, study: &Study) -> Result<Self, StudyError> {
        let at_several = study.file.samplings.iter().filter(|(_, spec)| spec.poses.is_some());
        let tables = at_several.map(|(name, _)| results.join(name)).collect();
        let (results, folder) = (results.to_owned(), results.join(BLOCKS_NAME));
        Ok(Self { results, folder, study: study.hash()?, tables })
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

    /// Writes a block over its shorter version, unless another process has done so meanwhile. A summary that
    /// is then out of date is removed first.
    ///
    /// # Errors
    /// [`StudyError::Write`].
    pub(crate) fn write(&self, id: &BlockId, outcomes: &[Observed]) -> Result<(), StudyError> {
        if self.read(id).is_ok_and(|found| found.len() >= outcomes.len()) {
            return Ok(());
        }
        let path = self.path(id);
        let file = encode(&self.header(id, outcomes), outcomes)
            .map_err(|error| StudyError::Write { path: path.clone(), source: error.into() })?;
        let folder = self.folder.join(id.sampling).join(id.design);
        fs::create_dir_all(&folder).map_err(|source| StudyError::Write { path: folder, source })?;
        self.remove_summary()?;
        write_atomic(path, &file)?;
        Ok(())
    }

    /// Number of blocks on disk, of any study.
    pub(crate) fn count(&self) -> Result<usize, StudyError> {
        Ok(files(&self.folder)?.iter().filter(|path| is_block(path)).count())
    }

    /// Removes all blocks, of any study, and the folders that are empty then. Other files stay.
    ///
    /// # Errors
    /// [`StudyError::Write`].
    pub(crate) fn remove(&self) -> Result<(), StudyError> {
        let removed = if self.folder.is_dir() { remove_blocks(&self.folder) } else { Ok(()) };
        removed.map_err(|source| StudyError::Write { path: self.folder.clone(), source })
    }

    /// Removes the summary of an earlier analysis, because new blocks make it out of date.
    ///
    /// # Errors
    /// [`StudyError::Write`].
    pub fn remove_summary(&self) -> Result<(), StudyError> {
        remove_stale(self.results.join(SUMMARY_NAME))
    }

    /// Removes unfinished files of killed processes, among the blocks and beside them.
    ///
    /// # Errors
    /// [`StudyError::Read`], [`StudyError::Write`].
    pub fn remove_unfinished(&self) -> Result<(), StudyError> {
        let mut all = files(&self.folder)?;
        // Only directly beside the blocks: the folder of results may hold much else.
        for folder in [&self.results].into_iter().chain(&self.tables).filter(|folder| folder.is_dir()) {
            let read = |source| StudyError::Read { path: folder.clone(), source };
            for entry in fs::read_dir(folder).map_err(read)? {
                all.push(entry.map_err(read)?.path());
            }
        }
        all.into_iter().filter(|path| is_unfinished(path)).try_for_each(remove_unfinished)
    }

    fn header(&self, id: &BlockId, outcomes: &[Observed]) -> BlockHeader {
        BlockHeader {
            version: env!("CARGO_PKG_VERSION").to_owned(),
            study: self.study.clone(),
            sampling: id.sampling.to_owned(),
            design: id.design.to_owned(),
            first: id.number * BLOCK,
            observations: outcomes.len(),
            failed: count_failed(failures(outcomes)),
        }
    }
}

fn is_block(path: &Path) -> bool {
    path.extension().is_some_and(|extension| extension == "block")
}

fn remove_blocks(folder: &Path) -> io::Result<()> {
    for entry in fs::read_dir(folder)? {
        let entry = entry?;
        let path = entry.path();
        if entry.file_type()?.is_dir() {
            remove_blocks(&path)?;
            // A folder that is not empty stays.
            let _ = fs::remove_dir(&path);
        } else if is_block(&path) || is_unfinished(&path) {
            fs::remove_file(&path)?;
        }
    }
    Ok(())
}

/// All files below a folder; none if the folder does not exist.
fn files(folder: &Path) -> Result<Vec<PathBuf>, StudyError> {
    let mut folders: Vec<_> = [folder.to_owned()].into_iter().filter(|folder| folder.is_dir()).collect();
    let mut files = Vec::new();
    while let Some(folder) = folders.pop() {
        let read = |source| StudyError::Read { path: folder.clone(), source };
        for entry in fs::read_dir(&folder).map_err(read)? {
            let entry = entry.map_err(read)?;
            // A link is no folder: links may lead in a circle.
            let is_folder = entry.file_type().map_err(read)?.is_dir();
            if is_folder { folders.push(entry.path()) } else { files.push(entry.path()) }
        }
    }
    Ok(files)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::fs::atomic::AtomicFile;
    use cdpr_robot::Vector3;
    use std::io::Write;

    fn blocks(results: &Path) -> Blocks {
        Blocks {
            results: results.to_owned(),
            folder: results.join(BLOCKS_NAME),
            study: "a hash".to_owned(),
            tables: vec![results.join("plane")],
        }
    }

    #[test]
    fn a_summary_goes_with_a_block_that_it_does_not_know_and_with_no_other() {
        let results = tempfile::tempdir().unwrap();
        let (blocks, summary) = (blocks(results.path()), results.path().join(SUMMARY_NAME));
        let id = BlockId { sampling: "mechanical", design: "sampling", number: 0 };
        for (observations, stays) in [(2, false), (2, true), (1, true), (3, false)] {
            fs::write(&summary, "of all blocks").unwrap();
            blocks.write(&id, &vec![Ok(Vector3::zeros()); observations]).unwrap();
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
