//! Files of a folder of results: texts, JSON and tables.

use crate::error::StudyError;
use crate::fs::atomic::AtomicFile;
use crate::fs::finite::FiniteCells;
use crate::fs::manifest::make_plain_folder;
use crate::fs::owned::{ResultsFolder, State, held};
use serde::Serialize;
use std::io::Write;
use std::path::PathBuf;
use std::sync::{Arc, Mutex};

/// A file of a folder of results, being written.
pub(crate) struct ResultFile {
    name: String,
    file: AtomicFile,
    hasher: blake3::Hasher,
    state: Arc<Mutex<State>>,
}

impl ResultFile {
    /// The error of a failure to write to the file.
    pub(crate) fn unwritten(&self, source: std::io::Error) -> StudyError {
        self.file.unwritten(source)
    }

    /// Gives the file its name. It is on the disk when this returns.
    ///
    /// # Errors
    /// [`StudyError::Write`].
    pub(crate) fn finish(self) -> Result<PathBuf, StudyError> {
        let path = self.file.finish()?;
        held(&self.state).written.insert(self.name, Some(self.hasher.finalize().to_string()));
        Ok(path)
    }
}

impl Write for ResultFile {
    fn write(&mut self, bytes: &[u8]) -> std::io::Result<usize> {
        let written = self.file.write(bytes)?;
        self.hasher.update(&bytes[..written]);
        Ok(written)
    }

    fn flush(&mut self) -> std::io::Result<()> {
        self.file.flush()
    }
}

impl ResultsFolder {
    /// Begins a file of this name, in place of one that a run has written.
    ///
    /// # Errors
    /// As [`ResultsFolder::claim`].
    pub(crate) fn create(&self, name: &str) -> Result<ResultFile, StudyError> {
        self.claim([name.to_owned()])?;
        if let Some((folder, _)) = name.split_once('/') {
            make_plain_folder(&self.path.join(folder))?;
        }
        self.state().written.insert(name.to_owned(), None);
        let file = AtomicFile::new(self.path.join(name))?;
        let (name, hasher) = (name.to_owned(), blake3::Hasher::new());
        Ok(ResultFile { name, file, hasher, state: self.state.clone() })
    }

    /// Writes a file that is whole and on the disk when this returns.
    ///
    /// # Errors
    /// As [`ResultsFolder::claim`].
    pub fn write(&self, name: &str, text: &[u8]) -> Result<PathBuf, StudyError> {
        let mut file = self.create(name)?;
        match file.write_all(text) {
            Ok(()) => file.finish(),
            Err(source) => Err(file.unwritten(source)),
        }
    }

    /// Writes a value as indented JSON.
    ///
    /// # Errors
    /// As [`ResultsFolder::claim`].
    pub fn write_json(&self, name: &str, value: &impl Serialize) -> Result<PathBuf, StudyError> {
        self.write(name, self.json(name, value)?.as_bytes())
    }

    pub(super) fn json(&self, name: &str, value: &impl Serialize) -> Result<String, StudyError> {
        match serde_json::to_string_pretty(value) {
            Ok(text) => Ok(text + "\n"),
            Err(error) => Err(StudyError::Write { path: self.path.join(name), source: error.into() }),
        }
    }

    /// Writes a table as CSV whose columns are the fields of its rows.
    ///
    /// # Errors
    /// As [`ResultsFolder::claim`].
    pub fn write_rows<T: Serialize>(&self, name: &str, rows: &[T]) -> Result<PathBuf, StudyError> {
        self.write_table(name, |table| rows.iter().try_for_each(|row| table.serialize(row)))
    }

    /// Writes a table as CSV from its header and its rows of text.
    ///
    /// # Errors
    /// As [`ResultsFolder::claim`].
    pub fn write_csv(
        &self,
        name: &str,
        header: Vec<String>,
        mut rows: impl Iterator<Item = Vec<String>>,
    ) -> Result<PathBuf, StudyError> {
        self.write_table(name, |table| {
            table.write_record(header)?;
            rows.try_for_each(|row| table.write_record(row))
        })
    }

    fn write_table(
        &self,
        name: &str,
        write: impl FnOnce(&mut csv::Writer<FiniteCells<ResultFile>>) -> Result<(), csv::Error>,
    ) -> Result<PathBuf, StudyError> {
        let mut table = csv::Writer::from_writer(FiniteCells::new(self.create(name)?));
        let unwritten = |source| StudyError::Write { path: self.path.join(name), source };
        write(&mut table).map_err(|error| unwritten(error.into()))?;
        let cells = table.into_inner().map_err(|error| unwritten(error.into_error()))?;
        cells.into_inner().map_err(unwritten)?.finish()
    }
}
