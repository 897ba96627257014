//! A table from a file, or from a folder of results.

use crate::error::StudyError;
use crate::fs::input::read_table;
use crate::fs::lock::hold_still;
use crate::fs::manifest::check_unchanged;
use crate::given::columns::GivenTable;
use crate::kind::InputKind;
use std::path::{Path, PathBuf};

/// Ending of the tables of a folder that hold measures instead of observations.
const MEASURES: &str = "_sensitivity";

/// Reads a table: CSV, Parquet, or a folder of results with the name of one of its tables (the only one if
/// left out).
///
/// # Errors
/// [`StudyError::Read`], [`StudyError::NotRegular`], [`StudyError::TooLarge`]; [`StudyError::FolderBusy`]
/// where a process writes into the folder; [`StudyError::Table`] for lines of different lengths and equal
/// names; [`StudyError::Invalid`] for a folder without such a table, and for Parquet without its feature.
pub fn open_table(path: &Path, name: Option<&str>) -> Result<GivenTable, StudyError> {
    if path.is_dir() {
        let _lock = hold_still(path)?;
        return read(&in_folder(path, name)?);
    }
    read(path)
}

fn read(path: &Path) -> Result<GivenTable, StudyError> {
    check_unchanged(path)?;
    if path.extension().is_some_and(|ending| ending == "parquet") {
        #[cfg(feature = "parquet")]
        return Ok(GivenTable::of(path, crate::given::parquet::read(path)?));
        #[cfg(not(feature = "parquet"))]
        return Err(StudyError::invalid(
            path,
            "format",
            "Parquet",
            "CSV, or a program built with the feature `parquet`",
        ));
    }
    Ok(GivenTable::of(path, read_table(path, InputKind::Table)?))
}

/// The table of this name in a folder, or its only one.
fn in_folder(folder: &Path, name: Option<&str>) -> Result<PathBuf, StudyError> {
    let unread = |source| StudyError::Read { path: folder.to_owned(), source };
    let invalid =
        |field: &str, value: &str, expected: &str| StudyError::invalid(folder, field, value, expected);
    let mut tables: Vec<PathBuf> = Vec::new();
    for entry in std::fs::read_dir(folder).map_err(unread)? {
        let path = entry.map_err(unread)?.path();
        let is_table = path.extension().is_some_and(|ending| ending == "csv" || ending == "parquet");
        if is_table && !stem(&path).ends_with(MEASURES) {
            tables.push(path);
        }
    }
    tables.sort();
    let names = tables.iter().map(|path| stem(path)).collect::<Vec<_>>().join(", ");
    match (name, &tables[..]) {
        (Some(name), _) => {
            let expected = format!("one of its tables: {names}");
            let found = tables.iter().find(|path| stem(path) == name);
            found.cloned().ok_or_else(|| invalid("table", name, &expected))
        }
        (None, [only]) => Ok(only.clone()),
        (None, []) => Err(invalid("tables", "an empty list", "a folder with tables of observations")),
        (None, [first, ..]) => {
            let expected = format!("one of them by its file, such as {}: {names}", first.display());
            Err(invalid("table", "one of several in a folder", &expected))
        }
    }
}

fn stem(path: &Path) -> String {
    path.file_stem().map(|stem| stem.to_string_lossy().into_owned()).unwrap_or_default()
}
