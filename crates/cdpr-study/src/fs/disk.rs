//! The one place where files and folders are changed: each function is one operation of the system. Tests let
//! any of them fail, or end the process before or after it.

use std::fs::{self, File, TryLockError};
use std::io::{self, ErrorKind, Write};
use std::path::Path;
use tempfile::NamedTempFile;

/// Makes a folder in an existing one. One that is there already is left alone.
pub(crate) fn make_folder(path: &Path) -> io::Result<()> {
    step("mkdir", path, || match fs::create_dir(path) {
        Err(error) if error.kind() == ErrorKind::AlreadyExists => Ok(()),
        made => made,
    })
}

/// Makes a folder and all those above it that are missing.
pub(crate) fn make_folders(path: &Path) -> io::Result<()> {
    step("mkdir", path, || fs::create_dir_all(path))
}

/// Creates a file without a name, which vanishes when it is closed.
pub(crate) fn probe(folder: &Path) -> io::Result<()> {
    step("create", folder, || tempfile::tempfile_in(folder)).map(|_| ())
}

/// Creates a file under a temporary name.
pub(crate) fn create(folder: &Path, builder: &tempfile::Builder) -> io::Result<NamedTempFile> {
    step("create", folder, || builder.tempfile_in(folder))
}

/// Opens the file of a lock, and creates it if it is missing.
pub(crate) fn open_lock(path: &Path) -> io::Result<File> {
    step("create", path, || File::options().create(true).truncate(false).write(true).open(path))
}

/// Locks a file for this process alone, or shared with others; returns whether it was free. Where the file
/// system has no locks, every file counts as free.
pub(crate) fn lock(file: &File, path: &Path, shared: bool) -> io::Result<bool> {
    step("lock", path, || match if shared { file.try_lock_shared() } else { file.try_lock() } {
        Ok(()) => Ok(true),
        Err(TryLockError::WouldBlock) => Ok(false),
        Err(TryLockError::Error(error)) if error.kind() == ErrorKind::Unsupported => Ok(true),
        Err(TryLockError::Error(error)) => Err(error),
    })
}

/// Writes bytes to an open file that will be called `path`, and returns how many.
pub(crate) fn write(file: &mut impl Write, path: &Path, bytes: &[u8]) -> io::Result<usize> {
    step("write", path, || file.write(bytes))
}

/// Writes bytes to the file, pipe or terminal of this name, which the user has asked for.
pub(crate) fn write_to(path: &Path, bytes: &[u8]) -> io::Result<()> {
    step("write", path, || fs::write(path, bytes))
}

/// Puts on the disk what a file or folder holds.
pub(crate) fn sync(file: &File, path: &Path) -> io::Result<()> {
    step("fsync", path, || file.sync_all())
}

/// Gives a file its name, in place of one that has it.
pub(crate) fn rename(file: NamedTempFile, path: &Path) -> io::Result<()> {
    step("rename", path, || file.persist(path).map(|_| ()).map_err(io::Error::from))
}

/// Removes a file, if it exists. Of a link it removes the link.
pub(crate) fn remove(path: &Path) -> io::Result<()> {
    step("unlink", path, || match fs::remove_file(path) {
        Err(error) if error.kind() == ErrorKind::NotFound => Ok(()),
        removed => removed,
    })
}

/// Removes a folder, if it exists and is empty.
pub(crate) fn remove_folder(path: &Path) -> io::Result<()> {
    step("rmdir", path, || match fs::remove_dir(path) {
        Err(error) if [ErrorKind::NotFound, ErrorKind::DirectoryNotEmpty].contains(&error.kind()) => Ok(()),
        removed => removed,
    })
}

/// Carries out one operation.
#[cfg(not(test))]
fn step<T>(_: &'static str, _: &Path, operation: impl FnOnce() -> io::Result<T>) -> io::Result<T> {
    operation()
}

#[cfg(test)]
use faults::step;

/// Failures of operations, in tests alone.
#[cfg(test)]
pub(crate) mod faults {
    use std::cell::{Cell, RefCell};
    use std::io;
    use std::path::{Path, PathBuf};

    /// What happens at an operation.
    #[derive(Clone, Copy, Debug, PartialEq)]
    pub(crate) enum Fault {
        /// It fails with this error of the system.
        Error(i32),
        /// The process ends before it.
        DieBefore,
        /// The process ends after it.
        DieAfter,
    }

    /// Exit code of a process that a fault has ended.
    pub(crate) const DIED: i32 = 86;

    thread_local! {
        static PLAN: Cell<Option<(usize, Fault)>> = const { Cell::new(None) };
        static LOG: RefCell<Vec<(&'static str, PathBuf)>> = const { RefCell::new(Vec::new()) };
    }

    /// Runs `act` with a fault at the operation of this number, from 0. Returns what `act` returns and all
    /// operations of this thread in their order.
    pub(crate) fn with<T>(
        plan: Option<(usize, Fault)>,
        act: impl FnOnce() -> T,
    ) -> (T, Vec<(&'static str, PathBuf)>) {
        LOG.with_borrow_mut(Vec::clear);
        PLAN.set(plan);
        let result = act();
        PLAN.set(None);
        (result, LOG.take())
    }

    pub(super) fn step<T>(
        name: &'static str,
        path: &Path,
        operation: impl FnOnce() -> io::Result<T>,
    ) -> io::Result<T> {
        let number = LOG.with_borrow_mut(|log| {
            log.push((name, path.to_owned()));
            log.len() - 1
        });
        let fault = PLAN.get().filter(|(at, _)| *at == number).map(|(_, fault)| fault);
        match fault {
            Some(Fault::Error(code)) => return Err(io::Error::from_raw_os_error(code)),
            Some(Fault::DieBefore) => std::process::exit(DIED),
            _ => (),
        }
        let done = operation();
        if fault == Some(Fault::DieAfter) {
            std::process::exit(DIED);
        }
        done
    }
}
