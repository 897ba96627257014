//! Files that are either complete or absent. They are written under a temporary name in the same folder, then
//! renamed.

use crate::error::StudyError;
use crate::fs::disk;
use std::fs::File;
use std::io::{BufWriter, Write};
use std::path::{Path, PathBuf};
use tempfile::{Builder, NamedTempFile};

/// Beginning and end of the names of unfinished files.
const UNFINISHED: [&str; 2] = [".cdpr-", ".tmp"];

/// A file that takes its name when it is finished. An unfinished one leaves nothing behind, unless the
/// process is killed. It is locked while it is written: other processes recognize leftovers by the missing
/// lock.
pub(crate) struct AtomicFile {
    path: PathBuf,
    file: BufWriter<Unfinished>,
}

/// The file under its temporary name.
struct Unfinished {
    path: PathBuf,
    file: NamedTempFile,
}

impl Write for Unfinished {
    fn write(&mut self, bytes: &[u8]) -> std::io::Result<usize> {
        disk::write(&mut self.file, &self.path, bytes)
    }

    fn flush(&mut self) -> std::io::Result<()> {
        self.file.flush()
    }
}

impl AtomicFile {
    /// Begins a file that will be called `path`.
    ///
    /// # Errors
    /// [`StudyError::Write`].
    pub(crate) fn new(path: PathBuf) -> Result<Self, StudyError> {
        let mut builder = Builder::new();
        builder.prefix(UNFINISHED[0]).suffix(UNFINISHED[1]);
        // The mask of the user applies, as to any other file: results in a shared folder are for others to
        // read.
        #[cfg(unix)]
        builder.permissions(std::os::unix::fs::PermissionsExt::from_mode(0o666));
        match disk::create(folder_of(&path), &builder) {
            Ok(file) => {
                // Where the file system has no locks, [`remove_unfinished`] gets none either.
                let _ = file.as_file().try_lock();
                Ok(Self { file: BufWriter::new(Unfinished { path: path.clone(), file }), path })
            }
            Err(source) => Err(StudyError::Write { path, source }),
        }
    }

    /// The error of a failure to write to the file.
    pub(crate) fn unwritten(&self, source: std::io::Error) -> StudyError {
        StudyError::Write { path: self.path.clone(), source }
    }

    /// Gives the file its name. It is on the disk when this returns.
    ///
    /// # Errors
    /// [`StudyError::Write`].
    pub(crate) fn finish(self) -> Result<PathBuf, StudyError> {
        self.named_by(disk::rename)
    }

    fn named_by(
        self,
        rename: impl FnOnce(NamedTempFile, &Path) -> std::io::Result<()>,
    ) -> Result<PathBuf, StudyError> {
        let Self { path, file } = self;
        let finish = || -> std::io::Result<()> {
            let file = file.into_inner().map_err(std::io::IntoInnerError::into_error)?.file;
            disk::sync(file.as_file(), &path)?;
            rename(file, &path)?;
            // The name is part of the folder.
            #[cfg(unix)]
            disk::sync(&File::open(folder_of(&path))?, folder_of(&path))?;
            Ok(())
        };
        match finish() {
            Ok(()) => Ok(path),
            Err(source) => Err(StudyError::Write { path, source }),
        }
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
    let name = path.file_name().map(|name| name.to_string_lossy());
    name.is_some_and(|name| name.starts_with(UNFINISHED[0]) && name.ends_with(UNFINISHED[1]))
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
    disk::remove(&path).map_err(|source| StudyError::Write { path, source })
}

/// Writes a file that is whole and on the disk when this returns.
///
/// # Errors
/// [`StudyError::Write`].
pub(crate) fn write_atomic(path: PathBuf, text: &[u8]) -> Result<PathBuf, StudyError> {
    written(path, text)?.finish()
}

/// The same for a file that does not exist yet.
///
/// # Errors
/// [`StudyError::Write`], also if there is such a file.
pub(crate) fn write_new(path: PathBuf, text: &[u8]) -> Result<PathBuf, StudyError> {
    written(path, text)?.named_by(disk::rename_new)
}

fn written(path: PathBuf, text: &[u8]) -> Result<AtomicFile, StudyError> {
    let mut file = AtomicFile::new(path)?;
    match file.write_all(text) {
        Ok(()) => Ok(file),
        Err(source) => Err(file.unwritten(source)),
    }
}
