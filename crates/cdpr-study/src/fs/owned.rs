//! A folder of results belongs to one owner at a time, and only files that runs have written belong to it.
//!
//! Every process that writes holds the lock of the folder: alone, or shared with the others that make blocks
//! of the same study. A file that is not in the folder's list ([`Manifest`]) is never written over and never
//! removed, and no link is ever followed. A file that was changed after the run that wrote it belongs to the
//! user, too, unless the results are to be overwritten.

use crate::error::StudyError;
use crate::fs::atomic::{AtomicFile, is_unfinished, remove_unfinished};
use crate::fs::disk;
use crate::fs::files::check_folder;
use crate::fs::finite::FiniteCells;
use crate::fs::manifest::{Manifest, ResultsOf, digest, entries, is_plain_file, is_plain_folder};
use crate::fs::single::IfExists;
use crate::names::LOCK_NAME;
use serde::Serialize;
use std::collections::{BTreeMap, BTreeSet};
use std::fs::File;
use std::io::Write;
use std::path::{Path, PathBuf};
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};
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

/// A folder of results that this process may write into, until this value is dropped.
#[derive(Debug)]
pub struct ResultsFolder {
    path: PathBuf,
    lock: Lock,
    state: Arc<Mutex<State>>,
    /// Whether the folder was made for this run, which has it alone.
    made: bool,
}

impl Drop for ResultsFolder {
    /// Removes a folder that was made for a run that was refused before it wrote anything.
    fn drop(&mut self) {
        let is_unused = {
            let state = self.state();
            state.alone && !state.listed && state.written.is_empty()
        };
        if self.made && is_unused {
            // What cannot be removed stays: the run has another error to report.
            let _ = disk::remove(&self.path.join(LOCK_NAME));
            let _ = disk::remove_folder(&self.path);
        }
    }
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

#[derive(Debug)]
struct State {
    manifest: Manifest,
    /// Whether no other process writes.
    alone: bool,
    /// Whether the list is on the disk.
    listed: bool,
    /// Whether files of earlier runs are replaced even if they were changed since.
    overwrites: bool,
    /// Files of this run, with the digests of those that are finished.
    written: BTreeMap<String, Option<String>>,
}

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
    /// Makes the folder, or takes one that runs have written, and checks that files can be written in it.
    /// `writes` says of a name whether the run may write a file of that name.
    ///
    /// # Errors
    /// [`StudyError::Write`]; [`StudyError::FolderBusy`] where another process writes;
    /// [`StudyError::ResultsExist`] for results that are not to be overwritten; [`StudyError::NoResults`],
    /// [`StudyError::Link`], [`StudyError::OtherResults`] and those of the list for a folder that is not of
    /// such runs alone.
    pub fn begin(
        path: &Path,
        of: ResultsOf,
        if_exists: IfExists,
        writes: impl Fn(&str) -> bool,
    ) -> Result<Self, StudyError> {
        let folder = Self::take(path, of, Access::Alone, writes)?;
        match if_exists {
            IfExists::Overwrite => folder.overwrite(),
            IfExists::Refuse => {
                let files = folder.state().manifest.files.clone();
                // Files of a run that was interrupted have no digest.
                if files.iter().any(|(name, digest)| digest.is_some() && path.join(name).exists()) {
                    return Err(StudyError::ResultsExist { folder: path.to_owned(), of: of.word() });
                }
            }
        }
        Ok(folder)
    }

    /// From now on, files of earlier runs are replaced even if they were changed since.
    pub(crate) fn overwrite(&self) {
        self.state().overwrites = true;
    }

    /// The same for one of several processes. [`Access::Shared`] may find the folder free, and then has it
    /// alone until [`ResultsFolder::share`].
    pub(crate) fn take(
        path: &Path,
        of: ResultsOf,
        access: Access,
        writes: impl Fn(&str) -> bool,
    ) -> Result<Self, StudyError> {
        // Before anything is made in what may be a user's own folder.
        known(path, of, &writes)?;
        let made = access == Access::Alone && path.symlink_metadata().is_err();
        check_folder(path)?;
        let lock_path = path.join(LOCK_NAME);
        is_plain_file(&lock_path)?;
        let lock = disk::open_lock(&lock_path)
            .map_err(|source| StudyError::Write { path: lock_path.clone(), source })?;
        let lock = Lock(lock);
        let alone = take_lock(path, &lock.0, access)?;
        let manifest = known(path, of, &writes)?;
        let listed = manifest.is_some();
        let manifest = manifest.unwrap_or_else(|| Manifest::new(of));
        let state = State { manifest, alone, listed, overwrites: false, written: BTreeMap::new() };
        Ok(Self { path: path.to_owned(), lock, state: Arc::new(Mutex::new(state)), made })
    }

    /// Shares the folder from now on with other processes that make blocks of the same study.
    ///
    /// # Errors
    /// [`StudyError::FolderBusy`] where another process took the folder meanwhile.
    pub(crate) fn share(&self) -> Result<(), StudyError> {
        if !self.is_alone() {
            return Ok(());
        }
        self.take_again(Access::Shared)
    }

    /// Takes the folder alone again when the others are done.
    ///
    /// # Errors
    /// As [`ResultsFolder::share`].
    pub(crate) fn take_alone(&self) -> Result<(), StudyError> {
        self.take_again(Access::Alone)
    }

    fn take_again(&self, access: Access) -> Result<(), StudyError> {
        let write = |source| StudyError::Write { path: self.path.join(LOCK_NAME), source };
        self.lock.0.unlock().map_err(write)?;
        let clock = Instant::now();
        while !disk::lock(&self.lock.0, &self.path.join(LOCK_NAME), access == Access::Shared)
            .map_err(write)?
        {
            if clock.elapsed() > PATIENCE {
                return Err(StudyError::FolderBusy { folder: self.path.clone() });
            }
            std::thread::sleep(LOOK_AGAIN);
        }
        self.state().alone = access == Access::Alone;
        // In between, it was anybody's.
        match Manifest::read(&self.path)? {
            Some(found) if found.study == self.state().manifest.study => Ok(()),
            _ => Err(StudyError::FolderBusy { folder: self.path.clone() }),
        }
    }

    /// The folder.
    pub fn path(&self) -> &Path {
        &self.path
    }

    /// Hash of the study that the folder is of; `None` for a new folder.
    pub(crate) fn study(&self) -> Option<String> {
        self.state().manifest.study.clone()
    }

    /// Whether no other process writes into the folder.
    pub(crate) fn is_alone(&self) -> bool {
        self.state().alone
    }

    /// Whether runs have written a file of this name.
    pub(crate) fn has(&self, name: &str) -> bool {
        self.state().manifest.files.contains_key(name)
    }

    /// Says of which study the results are, and gives these files their digests.
    ///
    /// # Errors
    /// [`StudyError::Write`].
    pub(crate) fn set_study(&self, hash: &str, files: &[(&str, Option<String>)]) -> Result<(), StudyError> {
        let mut state = self.state();
        let mut manifest = state.manifest.clone();
        manifest.study = Some(hash.to_owned());
        manifest.files.extend(files.iter().map(|(name, digest)| ((*name).to_owned(), digest.clone())));
        if state.listed && state.manifest == manifest {
            return Ok(());
        }
        state.listed = true;
        state.manifest = manifest;
        state.manifest.write(&self.path)
    }

    /// Whether the results are of this study, and these files have these digests.
    pub(crate) fn is_of(&self, hash: &str, files: &[(&str, Option<String>)]) -> bool {
        let State { manifest, .. } = &*self.state();
        let is_listed = |(name, digest): &(&str, _)| manifest.files.get(*name) == Some(digest);
        manifest.study.as_deref() == Some(hash) && files.iter().all(is_listed)
    }

    /// Names files that will be written.
    ///
    /// # Errors
    /// [`StudyError::NoResults`] for a file that no run has written, [`StudyError::Changed`] for one that was
    /// changed since, unless the results are overwritten; [`StudyError::Write`].
    pub fn claim(&self, names: impl IntoIterator<Item = String>) -> Result<(), StudyError> {
        let mut state = self.state();
        let mut new = Vec::new();
        for name in names {
            let path = self.path.join(&name);
            if state.manifest.files.contains_key(&name) {
                state.check_ours(&self.path, &name)?;
                // The digest is that of the earlier content.
                if !state.written.contains_key(&name) && state.manifest.files[&name].is_some() {
                    new.push(name);
                }
            } else if path.symlink_metadata().is_ok() {
                return Err(StudyError::NoResults { path });
            } else {
                new.push(name);
            }
        }
        if new.is_empty() && state.listed {
            return Ok(());
        }
        state.manifest.files.extend(new.into_iter().map(|name| (name, None)));
        state.listed = true;
        state.manifest.write(&self.path)
    }

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

    /// Gives the list the digests of the files that this run has written so far.
    ///
    /// # Errors
    /// [`StudyError::Write`].
    pub(crate) fn list_written(&self) -> Result<(), StudyError> {
        let mut state = self.state();
        let written = state.written.clone();
        state.manifest.files.extend(written);
        state.manifest.write(&self.path)
    }

    /// Writes a value as indented JSON.
    ///
    /// # Errors
    /// As [`ResultsFolder::claim`].
    pub fn write_json(&self, name: &str, value: &impl Serialize) -> Result<PathBuf, StudyError> {
        self.write(name, self.json(name, value)?.as_bytes())
    }

    /// Writes the summary of all results as indented JSON, the last file of a run. Before that, what earlier
    /// runs have written and this one has not is removed, except the files in `keep`, and the list gets the
    /// digests of all files of this run: beside a summary they are whole.
    ///
    /// # Errors
    /// As [`ResultsFolder::claim`] and [`ResultsFolder::remove`].
    pub fn conclude(
        &self,
        name: &str,
        summary: &impl Serialize,
        keep: &[&str],
    ) -> Result<PathBuf, StudyError> {
        let text = self.json(name, summary)?;
        self.remove_unfinished()?;
        self.claim([name.to_owned()])?;
        let written = self.state().written.clone();
        let (mut files, stale): (BTreeMap<_, _>, BTreeMap<_, _>) =
            self.state().manifest.files.clone().into_iter().partition(|(found, _)| {
                written.contains_key(found) || found == name || keep.contains(&found.as_str())
            });
        // What a user has changed stays, and is no longer of runs.
        let overwrites = self.state().overwrites;
        let is_changed = |name: &String| {
            let found = self.state().manifest.check(&self.path, name);
            !overwrites && matches!(found, Err(StudyError::Changed { .. }))
        };
        self.remove_files(&stale.into_keys().filter(|name| !is_changed(name)).collect::<Vec<_>>())?;
        files.extend(written);
        let digest = Some(digest(text.as_bytes()));
        files.insert(name.to_owned(), digest.clone());
        {
            let mut state = self.state();
            state.written.insert(name.to_owned(), digest);
            if state.manifest.files != files {
                state.manifest.files = files;
                state.manifest.write(&self.path)?;
            }
        }
        self.write(name, text.as_bytes())
    }

    fn json(&self, name: &str, value: &impl Serialize) -> Result<String, StudyError> {
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

    /// Removes a file that a run has written, if it exists. Its name stays in the list.
    ///
    /// # Errors
    /// [`StudyError::Link`], [`StudyError::Write`]; [`StudyError::Changed`] for a file that was changed
    /// since, unless the results are overwritten.
    pub fn remove(&self, name: &str) -> Result<(), StudyError> {
        if !self.has(name) {
            return Ok(());
        }
        let path = self.path.join(name);
        if let Some((folder, _)) = name.split_once('/')
            && !is_plain_folder(&self.path.join(folder))?
        {
            return Ok(());
        }
        if is_plain_file(&path)? {
            self.state().check_ours(&self.path, name)?;
            disk::remove(&path).map_err(|source| StudyError::Write { path, source })?;
        }
        Ok(())
    }

    /// Checks that no link stands in the place of a file that runs have written, or of its folder.
    ///
    /// # Errors
    /// [`StudyError::Link`], [`StudyError::Read`].
    pub(crate) fn check_plain(&self) -> Result<(), StudyError> {
        for folder in self.folders() {
            is_plain_folder(&folder)?;
        }
        let files = self.state().manifest.files.clone();
        files.keys().try_for_each(|name| is_plain_file(&self.path.join(name)).map(|_| ()))
    }

    /// Removes all files that runs have written but these.
    ///
    /// # Errors
    /// As [`ResultsFolder::remove`].
    pub(crate) fn remove_all_but(&self, keep: &[&str]) -> Result<(), StudyError> {
        let files = self.state().manifest.files.clone();
        let files: Vec<_> = files.into_keys().filter(|name| !keep.contains(&name.as_str())).collect();
        self.remove_files(&files)
    }

    /// Removes unfinished files of killed processes beside the files that runs have written.
    ///
    /// # Errors
    /// [`StudyError::Read`], [`StudyError::Write`].
    pub(crate) fn remove_unfinished(&self) -> Result<(), StudyError> {
        // Only directly beside them: the folder may hold much else.
        for folder in [self.path.clone()].into_iter().chain(self.folders()) {
            if folder == self.path || is_plain_folder(&folder)? {
                let plain = entries(&folder)?.into_iter().filter(|(_, kind)| kind.is_file());
                plain
                    .map(|(path, _)| path)
                    .filter(|path| is_unfinished(path))
                    .try_for_each(remove_unfinished)?;
            }
        }
        Ok(())
    }

    /// Removes these files, and the folders that are empty then.
    fn remove_files(&self, names: &[String]) -> Result<(), StudyError> {
        let folders: BTreeSet<&str> = names.iter().filter_map(|name| Some(name.split_once('/')?.0)).collect();
        names.iter().try_for_each(|name| self.remove(name))?;
        for folder in folders {
            let path = self.path.join(folder);
            disk::remove_folder(&path).map_err(|source| StudyError::Write { path, source })?;
        }
        Ok(())
    }

    /// The folders of the files that runs have written.
    fn folders(&self) -> BTreeSet<PathBuf> {
        let files = &self.state().manifest.files;
        files.keys().filter_map(|name| Some(self.path.join(name.split_once('/')?.0))).collect()
    }

    fn state(&self) -> MutexGuard<'_, State> {
        held(&self.state)
    }
}

impl State {
    /// Checks that a listed file is what this or an earlier run has written, if it exists.
    fn check_ours(&self, folder: &Path, name: &str) -> Result<(), StudyError> {
        let path = folder.join(name);
        if !is_plain_file(&path)? || self.overwrites || self.written.contains_key(name) {
            return Ok(());
        }
        self.manifest.check(folder, name)
    }
}

fn held(state: &Mutex<State>) -> MutexGuard<'_, State> {
    state.lock().unwrap_or_else(PoisonError::into_inner)
}

/// The list of a folder, if it has one. A file that a run may write and that is not in it belongs to the
/// user.
fn known(path: &Path, of: ResultsOf, writes: &impl Fn(&str) -> bool) -> Result<Option<Manifest>, StudyError> {
    if !path.is_dir() {
        return Ok(None);
    }
    // Another process may be at work: it names a file before it creates it, and forgets it after it has
    // removed it.
    let earlier = Manifest::read(path)?;
    let found = entries(path)?;
    let manifest = Manifest::read(path)?;
    if let Some(manifest) = &manifest
        && manifest.of != of
    {
        let (found, expected) = (manifest.of.word(), of.word());
        return Err(StudyError::OtherResults { folder: path.to_owned(), found, expected });
    }
    let is_foreign = |path: &PathBuf| {
        let name = path.file_name().and_then(|name| name.to_str());
        let mut lists = [&earlier, &manifest].into_iter().flatten();
        name.is_some_and(|name| writes(name) && !lists.any(|list| list.files.contains_key(name)))
    };
    match found.into_iter().map(|(path, _)| path).find(is_foreign) {
        Some(path) => Err(StudyError::NoResults { path }),
        None => Ok(manifest),
    }
}

/// Takes the lock of a folder, and returns whether alone. One that asks for a share waits a little for others
/// that begin theirs.
fn take_lock(folder: &Path, lock: &File, access: Access) -> Result<bool, StudyError> {
    let path = folder.join(LOCK_NAME);
    let locked = |shared| {
        disk::lock(lock, &path, shared).map_err(|source| StudyError::Write { path: path.clone(), source })
    };
    let clock = Instant::now();
    loop {
        if locked(false)? {
            return Ok(true);
        }
        if access == Access::Shared && locked(true)? {
            return Ok(false);
        }
        if access == Access::Alone || clock.elapsed() > PATIENCE {
            return Err(StudyError::FolderBusy { folder: folder.to_owned() });
        }
        std::thread::sleep(LOOK_AGAIN);
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

/// Makes a folder, or takes one that is no link.
///
/// # Errors
/// [`StudyError::Link`], [`StudyError::Write`].
pub(crate) fn make_plain_folder(path: &Path) -> Result<(), StudyError> {
    if !is_plain_folder(path)? {
        disk::make_folder(path).map_err(|source| StudyError::Write { path: path.to_owned(), source })?;
        is_plain_folder(path)?;
    }
    Ok(())
}
