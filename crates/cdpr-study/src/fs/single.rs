//! Single files of the user's choice, written whole or not at all.

use crate::error::StudyError;
use crate::fs::atomic::{write_atomic, write_new};
use crate::fs::disk;
use crate::fs::input::open;
use crate::kind::InputKind;
use std::io::{ErrorKind, Read};
use std::path::Path;

/// What becomes of a file, or of the results in a folder, that exist already.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum IfExists {
    /// They are left alone, and nothing is written.
    #[default]
    Refuse,
    /// They are replaced.
    Overwrite,
}

impl IfExists {
    /// [`IfExists::Overwrite`] where that was requested.
    pub fn overwriting(requested: bool) -> Self {
        if requested { Self::Overwrite } else { Self::Refuse }
    }
}

/// Refuses a file that [`write_file`] would not replace, before anything is written.
///
/// # Errors
/// [`StudyError::FileExists`] for a file with another content, [`StudyError::Read`].
pub fn check_replaceable(
    path: &Path,
    content: impl AsRef<[u8]>,
    if_exists: IfExists,
) -> Result<(), StudyError> {
    let content = content.as_ref();
    let found = std::fs::metadata(path).ok().filter(std::fs::Metadata::is_file);
    match found {
        Some(found) if if_exists == IfExists::Refuse => {
            let same = found.len() == content.len() as u64 && has_content(path, content)?;
            if same { Ok(()) } else { Err(StudyError::FileExists { path: path.to_owned() }) }
        }
        _ => Ok(()),
    }
}

/// Writes a file of the user's choice. A file that exists is replaced only if that was requested;
/// one that has this content already is left as it is. A pipe or terminal is written to as it is.
///
/// # Errors
/// [`StudyError::FileExists`] for a file with another content, [`StudyError::Read`], [`StudyError::Write`].
pub fn write_file(path: &Path, content: impl AsRef<[u8]>, if_exists: IfExists) -> Result<(), StudyError> {
    let content = content.as_ref();
    let write = |source| StudyError::Write { path: path.to_owned(), source };
    match std::fs::metadata(path) {
        Ok(found) if found.is_file() => {
            if found.len() == content.len() as u64 && has_content(path, content)? {
                return Ok(());
            }
            check_replaceable(path, content, if_exists)?;
            // Through a link, to the file itself.
            write_atomic(path.canonicalize().map_err(write)?, content).map(|_| ())
        }
        Err(error) if error.kind() == ErrorKind::NotFound && path.symlink_metadata().is_err() => {
            write_new(path.to_owned(), content).map(|_| ())
        }
        _ => disk::write_to(path, content).map_err(write),
    }
}

fn has_content(path: &Path, content: &[u8]) -> Result<bool, StudyError> {
    let mut found = Vec::with_capacity(content.len());
    let read = open(path, InputKind::Results)?.take(content.len() as u64 + 1).read_to_end(&mut found);
    read.map_err(|source| StudyError::Read { path: path.to_owned(), source })?;
    Ok(found == content)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_file_of_another_content_is_replaced_on_request_only() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("robot.json");
        let text = || std::fs::read_to_string(&path).unwrap();
        write_file(&path, "ours", IfExists::Refuse).unwrap();
        write_file(&path, "ours", IfExists::Refuse).unwrap();
        for other in ["else", "of another length"] {
            let error = write_file(&path, other, IfExists::Refuse).unwrap_err();
            assert!(matches!(error, StudyError::FileExists { .. }), "{error}");
            assert_eq!(text(), "ours");
        }
        write_file(&path, "else", IfExists::Overwrite).unwrap();
        assert_eq!(text(), "else");
    }
}
