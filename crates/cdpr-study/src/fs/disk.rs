//! The one place where files and folders are changed: each function is one operation of the system. Tests of
//! the program (`crates/cdpr/tests/faults.rs`) let any of them fail, or end the process before or after
//! it.

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

/// Gives a file its name, if no other file has it.
pub(crate) fn rename_new(file: NamedTempFile, path: &Path) -> io::Result<()> {
    step("rename", path, || file.persist_noclobber(path).map(|_| ()).map_err(io::Error::from))
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
#[cfg(not(debug_assertions))]
fn step<T>(_: &'static str, _: &Path, operation: impl FnOnce() -> io::Result<T>) -> io::Result<T> {
    operation()
}

#[cfg(debug_assertions)]
use faults::step;

/// Failures of operations that tests ask for. Programs for users are built without debug assertions.
#[cfg(debug_assertions)]
mod faults {
    use std::io::{self, Write};
    use std::path::Path;
    use std::sync::atomic::{AtomicUsize, Ordering};

    /// Variable with the number of an operation, from 0, and what happens at it: `EIO`, `ENOSPC`, or the end
    /// of the process `before` or `after` it, such as `12 EIO`.
    const VARIABLE: &str = "CDPR_TEST_FAULT";

    /// Operations so far.
    static OPERATIONS: AtomicUsize = AtomicUsize::new(0);

    pub(super) fn step<T>(
        name: &'static str,
        path: &Path,
        operation: impl FnOnce() -> io::Result<T>,
    ) -> io::Result<T> {
        let number = OPERATIONS.fetch_add(1, Ordering::Relaxed);
        let plan = std::env::var(VARIABLE).unwrap_or_default();
        let Some((_, fault)) = plan.split_once(' ').filter(|(at, _)| *at == number.to_string()) else {
            return operation();
        };
        // The test reads there what has failed.
        let _ = writeln!(io::stderr(), "fault: {fault} at {number}, {name} {}", path.display());
        match fault {
            "EIO" => return Err(io::Error::from_raw_os_error(5)),
            "ENOSPC" => return Err(io::Error::from_raw_os_error(28)),
            "before" => end(),
            _ => (),
        }
        let done = operation();
        if fault == "after" {
            end();
        }
        done
    }

    /// Ends the process without anything being put in order.
    fn end() {
        std::process::exit(86);
    }
}
