//! Files that are either complete or absent. They are written under a temporary name in the same folder, then
//! renamed.

use crate::error::StudyError;
use crate::fs::files::remove_stale;
use serde::Serialize;
use std::fs::File;
use std::io::{BufWriter, Write};
use std::path::{Path, PathBuf};
use tempfile::{Builder, NamedTempFile};

/// Prefix of the names of unfinished files.
const UNFINISHED: &str = ".cdpr-";

/// A file that takes its name when it is finished. An unfinished one leaves nothing behind, unless the
/// process is killed. It is locked while it is written: other processes recognise leftovers by the missing
/// lock.
pub(crate) struct AtomicFile {
    path: PathBuf,
    file: BufWriter<NamedTempFile>,
}

impl AtomicFile {
    /// Begins a file that will be called `path`.
    ///
    /// # Errors
    /// [`StudyError::Write`].
    pub(crate) fn new(path: PathBuf) -> Result<Self, StudyError> {
        let mut builder = Builder::new();
        builder.prefix(UNFINISHED).suffix(".tmp");
        // The mask of the user applies, as to any other file: results in a shared folder are for others to
        // read.
        #[cfg(unix)]
        builder.permissions(std::os::unix::fs::PermissionsExt::from_mode(0o666));
        match builder.tempfile_in(folder_of(&path)) {
            Ok(file) => {
                // Where the file system has no locks, [`remove_unfinished`] gets none either.
                let _ = file.as_file().try_lock();
                Ok(Self { path, file: BufWriter::new(file) })
            }
            Err(source) => Err(StudyError::Write { path, source }),
        }
    }

    /// The error of a failure to write to the file.
    pub(crate) fn unwritten(&self, source: std::io::Error) -> StudyError {
        StudyError::Write { path: self.path.clone(), source }
    }

    /// Gives the file its name. After a failure of the system it may be missing or empty.
    ///
    /// # Errors
    /// [`StudyError::Write`].
    pub(crate) fn finish(self) -> Result<PathBuf, StudyError> {
        let Self { path, file } = self;
        let finish = || -> std::io::Result<()> {
            file.into_inner().map_err(std::io::IntoInnerError::into_error)?.persist(&path)?;
            Ok(())
        };
        match finish() {
            Ok(()) => Ok(path),
            Err(source) => Err(StudyError::Write { path, source }),
        }
    }

    /// The same, and the file is on the disk when this returns.
    ///
    /// # Errors
    /// [`StudyError::Write`].
    pub(crate) fn finish_on_disk(mut self) -> Result<PathBuf, StudyError> {
        let synced = self.file.flush().and_then(|()| self.file.get_ref().as_file().sync_all());
        if let Err(source) = synced {
            return Err(StudyError::Write { path: self.path, source });
        }
        let path = self.finish()?;
        // The name is part of the folder.
        #[cfg(unix)]
        if let Err(source) = File::open(folder_of(&path)).and_then(|folder| folder.sync_all()) {
            return Err(StudyError::Write { path, source });
        }
        Ok(path)
    }
}

impl Write for AtomicFile {
    fn write(&mut self, bytes: &[u8]) -> std::io::Result<usize> {
        self.file.write(bytes)
    }

    fn flush(&mut self) -> std::io::Result<()> {
        self.file.flush()
    }
}

fn folder_of(path: &Path) -> &Path {
    path.parent().filter(|folder| !folder.as_os_str().is_empty()).unwrap_or(Path::new("."))
}

/// Whether a file is unfinished: being written, or left by a killed process.
pub(crate) fn is_unfinished(path: &Path) -> bool {
    path.file_name().is_some_and(|name| name.to_string_lossy().starts_with(UNFINISHED))
}

/// Removes an unfinished file, unless a process writes it.
///
/// # Errors
/// [`StudyError::Write`].
pub(crate) fn remove_unfinished(path: PathBuf) -> Result<(), StudyError> {
    // A file that cannot be opened may belong to somebody else.
    let Ok(file) = File::options().write(true).open(&path) else { return Ok(()) };
    if file.try_lock().is_err() {
        return Ok(());
    }
    remove_stale(path)
}

/// Writes a file that is whole and on the disk when this returns.
///
/// # Errors
/// [`StudyError::Write`].
pub(crate) fn write_atomic(path: PathBuf, text: &[u8]) -> Result<PathBuf, StudyError> {
    let mut file = AtomicFile::new(path)?;
    match file.write_all(text) {
        Ok(()) => file.finish_on_disk(),
        Err(source) => Err(file.unwritten(source)),
    }
}

/// Writes a value as indented JSON into a file that is whole and on the disk when this returns.
///
/// # Errors
/// [`StudyError::Write`].
pub fn write_json(path: PathBuf, value: &impl Serialize) -> Result<PathBuf, StudyError> {
    match serde_json::to_string_pretty(value) {
        Ok(text) => write_atomic(path, (text + "\n").as_bytes()),
        Err(error) => Err(StudyError::Write { path, source: error.into() }),
    }
}
