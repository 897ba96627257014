//! A folder of results belongs to one owner at a time, and only files that runs have written belong to it.
//!
//! Every process that writes holds the lock of the folder: alone, or shared with the others that make blocks
//! of the same study. A file that is not in the folder's list ([`Manifest`]) is never written over and never
//! removed, and no link is ever followed. A file that was changed after the run that wrote it belongs to the
//! user, too, unless the results are to be overwritten.

pub(crate) mod write;

use crate::error::StudyError;
use crate::fs::atomic::{is_unfinished, remove_unfinished};
use crate::fs::disk;
use crate::fs::files::check_folder;
use crate::fs::lock::{Access, Lock};
use crate::fs::manifest::{Manifest, ResultsOf, digest, entries, is_plain_file, is_plain_folder};
use crate::fs::single::IfExists;
use crate::names::LOCK_NAME;
use serde::Serialize;
use std::collections::{BTreeMap, BTreeSet};
use std::path::{Path, PathBuf};
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};

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
        let (lock, alone) = Lock::take(path, access)?;
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
        self.lock.share(&self.path)?;
        self.state().alone = false;
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
