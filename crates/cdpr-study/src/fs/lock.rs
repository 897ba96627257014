//! The lock of a folder of results: held alone, or shared with those that make blocks of the same study.

use crate::error::StudyError;
use crate::fs::disk;
use crate::fs::manifest::is_plain_file;
use crate::names::LOCK_NAME;
use std::fs::File;
use std::path::Path;
use std::time::{Duration, Instant};

/// How long a process waits for another one that begins or ends a share of the same study.
const PATIENCE: Duration = Duration::from_secs(10);

/// How long it waits before it looks again.
const LOOK_AGAIN: Duration = Duration::from_millis(2);

/// Who else may write into a folder at the same time.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Access {
    /// Nobody.
    Alone,
    /// Processes that make other blocks of the same study.
    Shared,
}

/// The file of a lock. It is unlocked when it is dropped, even if a process that was started meanwhile has
/// inherited it.
#[derive(Debug)]
pub(crate) struct Lock(File);

impl Drop for Lock {
    fn drop(&mut self) {
        // The system unlocks it in any case when the last process has closed it.
        let _ = self.0.unlock();
    }
}

impl Lock {
    /// Takes the lock of a folder, and returns whether alone. One that asks for a share waits a little for
    /// others that begin theirs.
    pub(super) fn take(folder: &Path, access: Access) -> Result<(Self, bool), StudyError> {
        let path = folder.join(LOCK_NAME);
        let write = |source| StudyError::Write { path: path.clone(), source };
        is_plain_file(&path)?;
        let lock = Self(disk::open_lock(&path).map_err(write)?);
        let locked = |shared| disk::lock(&lock.0, &path, shared).map_err(write);
        let clock = Instant::now();
        loop {
            if locked(false)? {
                return Ok((lock, true));
            }
            if access == Access::Shared && locked(true)? {
                return Ok((lock, false));
            }
            if access == Access::Alone || clock.elapsed() > PATIENCE {
                return Err(StudyError::FolderBusy { folder: folder.to_owned() });
            }
            std::thread::sleep(LOOK_AGAIN);
        }
    }

    /// Takes it again, shared. In between, the folder is anybody's.
    pub(super) fn share(&self, folder: &Path) -> Result<(), StudyError> {
        let path = folder.join(LOCK_NAME);
        let write = |source| StudyError::Write { path: path.clone(), source };
        self.0.unlock().map_err(write)?;
        let clock = Instant::now();
        while !disk::lock(&self.0, &path, true).map_err(write)? {
            if clock.elapsed() > PATIENCE {
                return Err(StudyError::FolderBusy { folder: folder.to_owned() });
            }
            std::thread::sleep(LOOK_AGAIN);
        }
        Ok(())
    }
}

/// Waits for nobody, and lets nobody write into a folder of results until the value is dropped. A folder that
/// nobody can write into, or of an earlier version, has no lock.
///
/// # Errors
/// [`StudyError::FolderBusy`] where a process writes into it, [`StudyError::Link`] for a lock that no run has
/// made.
pub(crate) fn hold_still(folder: &Path) -> Result<Option<Lock>, StudyError> {
    let path = folder.join(LOCK_NAME);
    if folder.is_file() {
        return Err(StudyError::NoFolder { path: folder.to_owned() });
    }
    if !is_plain_file(&path)? {
        return Ok(None);
    }
    let Ok(lock) = File::open(&path).map(Lock) else { return Ok(None) };
    match disk::lock(&lock.0, &path, true) {
        Ok(true) => Ok(Some(lock)),
        Ok(false) => Err(StudyError::FolderBusy { folder: folder.to_owned() }),
        Err(source) => Err(StudyError::Read { path, source }),
    }
}
