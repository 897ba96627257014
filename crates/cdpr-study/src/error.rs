//! Errors of studies.

use crate::kind::InputKind;
use crate::names::MANIFEST_NAME;
use crate::table::TableError;
use cdpr_cable::RecordError;
use cdpr_robot::{JsonError, RobotError, place_of, shortened};
use cdpr_sensitivity::SensitivityError;
use cdpr_statics::StaticsError;
use std::path::{Path, PathBuf};

/// Why a study could not be read, run or written. A failed observation is not an error but a result.
#[derive(Debug, thiserror::Error)]
pub enum StudyError {
    /// A file could not be read.
    #[error("cannot read {path}: {source}: expected a readable text file")]
    Read {
        /// The file.
        path: PathBuf,
        /// Message of the system.
        source: std::io::Error,
    },
    /// A folder, a pipe or a device stands where a file is expected.
    #[error("{path} is {found}: expected {kind}")]
    NotRegular {
        /// The path.
        path: PathBuf,
        /// What stands there.
        found: &'static str,
        /// What the file is to be.
        kind: InputKind,
    },
    /// A file stands where a folder of results is expected.
    #[error("{path} is a file: expected a folder of results")]
    NoFolder {
        /// The file.
        path: PathBuf,
    },
    /// A file is larger than any of its kind.
    #[error("{path} is larger than {} MB: expected {kind}", most / 1_000_000)]
    TooLarge {
        /// The file.
        path: PathBuf,
        /// What the file is to be.
        kind: InputKind,
        /// Largest size of such a file \[bytes\].
        most: u64,
    },
    /// A file of this program, but of another kind.
    #[error("{path} is {found}: expected {kind}")]
    OtherKind {
        /// The file.
        path: PathBuf,
        /// What it is.
        found: InputKind,
        /// What it is to be.
        kind: InputKind,
    },
    /// A name that neither a file nor the library has.
    #[error(
        "no file and no {} of the library is called `{name}`: {}",
        if *kind == InputKind::Cable { "cable" } else { "robot" },
        match near.is_empty() {
            true => "expected the path of a file, or a name".to_owned(),
            false => format!("near are {near}"),
        }
    )]
    NoSuchName {
        /// The name.
        name: String,
        /// What is called by it.
        kind: InputKind,
        /// Names in the library that are similar to it.
        near: String,
    },
    /// A file could not be written, or a folder could not be made.
    #[error(
        "cannot write {path}: {source}: expected {}",
        if source.kind() == std::io::ErrorKind::AlreadyExists {
            "a name that no file has yet"
        } else {
            "a place where files can be made"
        }
    )]
    Write {
        /// The file or folder.
        path: PathBuf,
        /// What the system says.
        source: std::io::Error,
    },
    /// The text is not a study file.
    #[error("{path}: {source}")]
    Format {
        /// The file.
        path: PathBuf,
        /// Place and reason.
        source: JsonError,
    },
    /// The robot file is invalid.
    #[error("{path}: {source}")]
    Robot {
        /// The file.
        path: PathBuf,
        /// Place and reason.
        source: RobotError,
    },
    /// The text is not a load-elongation record.
    #[error("{path}: {source}")]
    Record {
        /// The file.
        path: PathBuf,
        /// Line and reason.
        source: RecordError,
    },
    /// The file is not a table, or has a cell that cannot be read.
    #[error("{path}: {source}")]
    Table {
        /// The file.
        path: PathBuf,
        /// Line, column and reason.
        source: TableError,
    },
    /// One of these errors, with its place in the study file.
    #[error("{source} (line {line}, column {column})")]
    At {
        /// Line in the file, from 1.
        line: usize,
        /// Column in that line.
        column: usize,
        /// The error at this place.
        source: Box<StudyError>,
    },
    /// An invalid value in a study.
    #[error("{path}: {field} is {}: expected {expected}", shortened(value))]
    Invalid {
        /// The file.
        path: PathBuf,
        /// Path of the field.
        field: String,
        /// What was given.
        value: String,
        /// What would be right.
        expected: String,
    },
    /// The nominal robot cannot hold the study's pose or bear its load.
    #[error(
        "{path}: {field} is {}: expected a pose that the nominal robot can hold{}: {source}",
        shortened(value),
        meant.as_ref().map_or_else(String::new, |meant| format!(" (meant? {meant})"))
    )]
    Nominal {
        /// The file.
        path: PathBuf,
        /// Path of the field.
        field: String,
        /// The position [m].
        value: String,
        /// What was probably meant, where the position is far from the robot.
        meant: Option<String>,
        /// The reason.
        source: Box<StaticsError>,
    },
    /// A damaged block. A run makes it again.
    #[error("{path} is damaged: {reason}")]
    DamagedBlock {
        /// The file.
        path: PathBuf,
        /// The damage.
        reason: String,
    },
    /// A block of another study, or from another place in this one.
    #[error("{path} is of {field} {found}: expected {expected}; remove it, or use another folder")]
    ForeignBlock {
        /// The file.
        path: PathBuf,
        /// The field that differs.
        field: &'static str,
        /// Its value in the block.
        found: String,
        /// The expected value.
        expected: String,
    },
    /// A folder with the blocks of another study.
    #[error(
        "{folder} contains study {found}, and this is study {expected} (version {version}): expected the \
         same robot, error models, poses, payload, seed and version; use another folder"
    )]
    ForeignFolder {
        /// The folder.
        folder: PathBuf,
        /// Hash of the study in it.
        found: String,
        /// Hash of the study to run.
        expected: String,
        /// Version of this program, which is part of the hash.
        version: &'static str,
    },
    /// A folder with blocks, without instructions to resume or to overwrite them.
    #[error("{folder} contains {blocks} block{s} of this study", s = plural(*blocks))]
    FolderInUse {
        /// The folder.
        folder: PathBuf,
        /// Blocks in it.
        blocks: usize,
    },
    /// A file of the user's choice exists already, with another content.
    #[error("{path} exists already, with another content: nothing was written")]
    FileExists {
        /// The file.
        path: PathBuf,
    },
    /// A folder has results already.
    #[error("{folder} has the results of {of} already: nothing was written")]
    ResultsExist {
        /// The folder.
        folder: PathBuf,
        /// What they are of.
        of: &'static str,
    },
    /// A file that no run has written is in the way.
    #[error(
        "{path} was not written by a run, which would write over it: move it, or choose another place (the \
         files of runs are listed in {} next to them)",
        MANIFEST_NAME
    )]
    NoResults {
        /// The file.
        path: PathBuf,
    },
    /// Another process writes into the folder.
    #[error("{folder} is in use: another process writes into it; wait for its end, or choose another folder")]
    FolderBusy {
        /// The folder.
        folder: PathBuf,
    },
    /// A folder of results of another kind.
    #[error("{folder} contains the results of {found}: expected those of {expected}, or another folder")]
    OtherResults {
        /// The folder.
        folder: PathBuf,
        /// What its results are of.
        found: &'static str,
        /// What the new results are of.
        expected: &'static str,
    },
    /// A link, or something else that no run makes, stands where a run writes or removes.
    #[error(
        "{path} is a link, or no plain file or folder: links in a folder of results are not followed; move \
         it, \
         or choose another folder"
    )]
    Link {
        /// Its path.
        path: PathBuf,
    },
    /// A folder of results was opened for reading, and something was to be written.
    #[error("{folder} was opened for reading: expected a folder that this process has locked")]
    NotOwned {
        /// The folder.
        folder: PathBuf,
    },
    /// Files in a folder of results belong to different studies.
    #[error(
        "{path} is of study {found}: expected {expected}, as the files next to it; it was changed, or a run \
         was \
         interrupted"
    )]
    Mixed {
        /// The file.
        path: PathBuf,
        /// Hash of its study.
        found: String,
        /// Hash of the study of the other files.
        expected: String,
    },
    /// A file in a folder of results was changed after the run that wrote it.
    #[error("{path} is not what the run has written here: it was changed since")]
    Changed {
        /// The file.
        path: PathBuf,
    },
    /// A study cannot be analysed yet.
    #[error("{folder} lacks {missing} of {blocks} block{s}, the first one {first}", s = plural(*blocks))]
    MissingBlocks {
        /// The folder.
        folder: PathBuf,
        /// Number of missing blocks.
        missing: usize,
        /// Blocks of the whole study.
        blocks: usize,
        /// The first missing block.
        first: PathBuf,
    },
    /// The results have not been analysed yet.
    #[error("{folder} has no summary.json")]
    NotAnalysed {
        /// The folder.
        folder: PathBuf,
    },
    /// The run was asked to end.
    #[error("stopped: blocks of a study that are done are kept, and a run that resumes goes on with them")]
    Stopped,
    /// An invalid law, step or design.
    #[error("{path}: {field}: {source}")]
    Statistics {
        /// The file.
        path: PathBuf,
        /// Path of the field.
        field: String,
        /// The reason.
        source: SensitivityError,
    },
    /// An invalid setting of a run or test.
    #[error("{field} is {value}: expected {expected}")]
    Setting {
        /// The setting.
        field: String,
        /// What was given.
        value: String,
        /// What would be right.
        expected: String,
    },
}

/// The ending of a noun behind a count.
fn plural(count: usize) -> &'static str {
    if count == 1 { "" } else { "s" }
}

impl StudyError {
    /// Whether the error is in the settings and not in a file.
    pub fn is_argument(&self) -> bool {
        matches!(self, Self::Setting { .. })
    }

    /// The error with the place of its field in the file's text, if it has one.
    #[must_use]
    pub fn placed(mut self, text: &str) -> Self {
        let position = match &mut self {
            Self::Format { source, .. } => {
                if let Some((line, column)) = place_of(text, &source.field) {
                    (source.line, source.column) = (line, column);
                }
                None
            }
            Self::Invalid { field, .. } | Self::Nominal { field, .. } | Self::Statistics { field, .. } => {
                place_of(text, field)
            }
            _ => None,
        };
        match position {
            Some((line, column)) => Self::At { line, column, source: Box::new(self) },
            None => self,
        }
    }

    /// An invalid value of a field of a file, and what is expected.
    pub fn invalid(path: &Path, field: &str, value: impl ToString, expected: &str) -> Self {
        Self::Invalid {
            path: path.to_owned(),
            field: field.to_owned(),
            value: value.to_string(),
            expected: expected.to_owned(),
        }
    }

    /// An invalid setting of a run or test: its name, its value, and what is expected.
    pub fn setting(field: impl Into<String>, value: impl ToString, expected: impl Into<String>) -> Self {
        Self::Setting { field: field.into(), value: shortened(&value.to_string()), expected: expected.into() }
    }
}
