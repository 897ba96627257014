//! The blocks of a study on disk: `blocks/SAMPLING/DESIGN/NUMBER.block`, each written atomically.

use crate::atomic::{UNFINISHED, write_atomic};
use crate::block::{BLOCK, BlockHeader, decode, encode};
use crate::error::StudyError;
use crate::folder::BLOCKS_NAME;
use crate::observation::{Observed, count_failed, failures};
use crate::study::Study;
use std::fs;
use std::io::ErrorKind;
use std::path::{Path, PathBuf};

/// Where the blocks of a study are.
#[derive(Clone, Debug)]
pub struct Blocks {
    folder: PathBuf,
    study: String,
    /// Folders of tables of several poses, beside.
    tables: Vec<PathBuf>,
}

/// Which block.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Place<'a> {
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
        Ok(Self { folder: results.join(BLOCKS_NAME), study: study.hash()?, tables })
    }

    pub(crate) fn path(&self, place: &Place) -> PathBuf {
        let folder = self.folder.join(place.sampling).join(place.design);
        folder.join(format!("{:06}.block", place.number))
    }

    /// What is known of a block, from its first observation on. A damaged one is warned of, and nothing is known of it.
    ///
    /// # Errors
    /// [`StudyError::Read`]; [`StudyError::ForeignBlock`] for one that belongs elsewhere.
    pub(crate) fn known(
        &self,
        place: &Place,
        warn: &dyn Fn(&StudyError),
    ) -> Result<Vec<Observed>, StudyError> {
        match self.read(place) {
            Err(error @ StudyError::DamagedBlock { .. }) => {
                warn(&error);
                Ok(Vec::new())
            }
            read => read,
        }
    }

    /// The same, but a damaged block is an error.
    pub(crate) fn read(&self, place: &Place) -> Result<Vec<Observed>, StudyError> {
        let path = self.path(place);
        let file = match fs::read(&path) {
            Err(error) if error.kind() == ErrorKind::NotFound => return Ok(Vec::new()),
            read => read.map_err(|source| StudyError::Read { path: path.clone(), source })?,
        };
        let (header, outcomes) =
            decode(&file).map_err(|reason| StudyError::DamagedBlock { path: path.clone(), reason })?;
        let wanted = self.header(place, &outcomes);
        let foreign = |field, found: &str, expected: &str| StudyError::ForeignBlock {
            path: path.clone(),
            field,
            found: found.to_owned(),
            expected: expected.to_owned(),
        };
        // The version is looked at first: another one makes another hash, too.
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

    /// Writes a block in place of what is known of it.
    ///
    /// # Errors
    /// [`StudyError::Write`].
    pub(crate) fn write(&self, place: &Place, outcomes: &[Observed]) -> Result<(), StudyError> {
        let path = self.path(place);
        let file = encode(&self.header(place, outcomes), outcomes)
            .map_err(|error| StudyError::Write { path: path.clone(), source: error.into() })?;
        let folder = self.folder.join(place.sampling).join(place.design);
        fs::create_dir_all(&folder).map_err(|source| StudyError::Write { path: folder, source })?;
        write_atomic(path, &file)?;
        Ok(())
    }

    /// Number of blocks on disk, whatever they are of.
    pub(crate) fn count(&self) -> Result<usize, StudyError> {
        let is_block = |path: &PathBuf| path.extension().is_some_and(|extension| extension == "block");
        Ok(files(&self.folder)?.iter().filter(|path| is_block(path)).count())
    }

    /// Removes what killed runs have left unfinished, of blocks and beside them. Only where no other process writes any more.
    ///
    /// # Errors
    /// [`StudyError::Read`], [`StudyError::Write`].
    pub fn remove_unfinished(&self) -> Result<(), StudyError> {
        let results = self.folder.parent().unwrap_or(&self.folder);
        let unfinished = |path: &&PathBuf| {
            path.file_name().is_some_and(|name| name.to_string_lossy().starts_with(UNFINISHED))
        };
        // Beside the blocks, not below: the folder of results may be one that holds much else.
        let read = |source| StudyError::Read { path: results.to_owned(), source };
        let mut all = files(&self.folder)?;
        let tables = self.tables.iter().map(PathBuf::as_path).filter(|folder| folder.is_dir());
        for folder in [results].into_iter().chain(tables) {
            for entry in fs::read_dir(folder).map_err(read)? {
                all.push(entry.map_err(read)?.path());
            }
        }
        for path in all.iter().filter(unfinished) {
            fs::remove_file(path).map_err(|source| StudyError::Write { path: path.clone(), source })?;
        }
        Ok(())
    }

    fn header(&self, place: &Place, outcomes: &[Observed]) -> BlockHeader {
        BlockHeader {
            version: env!("CARGO_PKG_VERSION").to_owned(),
            study: self.study.clone(),
            sampling: place.sampling.to_owned(),
            design: place.design.to_owned(),
            first: place.number * BLOCK,
            observations: outcomes.len(),
            failed: count_failed(failures(outcomes)),
        }
    }
}

/// All files below a folder.
fn files(folder: &Path) -> Result<Vec<PathBuf>, StudyError> {
    let mut folders = vec![folder.to_owned()];
    let mut files = Vec::new();
    while let Some(folder) = folders.pop() {
        let read = |source| StudyError::Read { path: folder.clone(), source };
        for entry in fs::read_dir(&folder).map_err(read)? {
            let path = entry.map_err(read)?.path();
            if path.is_dir() { folders.push(path) } else { files.push(path) }
        }
    }
    Ok(files)
}
