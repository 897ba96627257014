//! Error models from files of their own.

use crate::error::StudyError;
use crate::file::errors_file::ErrorsFile;
use crate::file::study_file::InputSpec;
use crate::fs::input::{from_text, read_text};
use crate::kind::InputKind;
use crate::model::error_model::{ErrorModel, Wrong};
use cdpr_robot::Robot;
use cdpr_sensitivity::SensitivityError;
use indexmap::IndexMap;
use serde_json::Value;
use std::borrow::Cow;
use std::path::Path;

/// The text of a study in which error models of the form `{"file": "posterior.json"}` are replaced by those
/// of these files, next to the study, and correlated errors (`cdpr-errors/1`) by the entries that they mean.
///
/// # Errors
/// As [`read_text`]; [`StudyError::Format`] and [`StudyError::Invalid`] for what such a file says.
pub(crate) fn with_error_files<'t>(text: &'t str, path: &Path) -> Result<Cow<'t, str>, StudyError> {
    // Text that is no JSON is refused where the study is read.
    let Ok(mut study) = serde_json::from_str::<Value>(text) else { return Ok(text.into()) };
    let mut replaced = false;
    if let Some(models) = study.get_mut("error_models").and_then(Value::as_object_mut) {
        for model in models.values_mut() {
            let Some(fields) = model.as_object() else { continue };
            let named = fields.get("file").and_then(Value::as_str).filter(|_| fields.len() == 1);
            let entries = match named {
                Some(named) => {
                    let file = path.parent().unwrap_or(Path::new(".")).join(named);
                    entries_of(&read_text(&file, InputKind::Errors)?, &file)?
                }
                None if is_correlated(model) => entries_of(&model.to_string(), path)?,
                None => continue,
            };
            *model = serde_json::to_value(entries).unwrap_or_default();
            replaced = true;
        }
    }
    Ok(if replaced { study.to_string().into() } else { text.into() })
}

/// Whether an error model is one of correlated errors, which states its format.
fn is_correlated(model: &Value) -> bool {
    model.get("format").is_some()
}

/// The entries of an error model from its text: `cdpr-errors/1`, or an object as a study has it in
/// `error_models`.
fn entries_of(text: &str, path: &Path) -> Result<IndexMap<String, InputSpec>, StudyError> {
    if !serde_json::from_str::<Value>(text).is_ok_and(|value| is_correlated(&value)) {
        return from_text(text, path, InputKind::Errors);
    }
    let file: ErrorsFile = from_text(text, path, InputKind::Errors)?;
    file.entries().map_err(|(field, value, expected)| {
        StudyError::Invalid { path: path.to_owned(), field, value, expected }.placed(text)
    })
}

/// The error model of a file for a robot: `cdpr-errors/1`, or an object as a study has it in `error_models`.
///
/// # Errors
/// As [`read_text`] and [`read_errors`].
pub fn open_errors(path: &Path, robot: &Robot) -> Result<ErrorModel, StudyError> {
    read_errors(&read_text(path, InputKind::Errors)?, path, robot)
}

/// The same from its text; `path` names it in errors.
///
/// # Errors
/// [`StudyError::Format`], [`StudyError::Invalid`] and [`StudyError::Statistics`] for what it says.
pub fn read_errors(text: &str, path: &Path, robot: &Robot) -> Result<ErrorModel, StudyError> {
    without_sampling(&entries_of(text, path)?, robot).map_err(|wrong| match wrong {
        Wrong::Field { field, value, expected } => {
            StudyError::Invalid { path: path.to_owned(), field, value, expected }
        }
        Wrong::Law(source) => {
            StudyError::Statistics { path: path.to_owned(), field: "error model".to_owned(), source }
        }
    })
}

/// The error model of entries as a study has them in `error_models`, for a robot.
///
/// # Errors
/// Field, value and what is expected.
pub fn error_model(
    entries: &IndexMap<String, InputSpec>,
    robot: &Robot,
) -> Result<ErrorModel, (String, String, String)> {
    without_sampling(entries, robot).map_err(|wrong| match wrong {
        Wrong::Field { field, value, expected } => (field, value, expected),
        Wrong::Law(SensitivityError::InvalidInput { name, source }) => match *source {
            SensitivityError::InvalidParameter { field, value, expected } => {
                (format!("{name}.{field}"), value.to_string(), expected.to_owned())
            }
            source => (name, "invalid".to_owned(), source.to_string()),
        },
        Wrong::Law(source) => ("law".to_owned(), "invalid".to_owned(), source.to_string()),
    })
}

/// The error model of entries, none of which refers to the pose and load of a sampling.
fn without_sampling(entries: &IndexMap<String, InputSpec>, robot: &Robot) -> Result<ErrorModel, Wrong> {
    if let Some((key, _)) = entries.iter().find(|(_, spec)| spec.operating_point.is_some()) {
        let expected = "an error model without one, as there is no pose and load of a sampling";
        return Err(Wrong::field(format!("{key}.operating_point"), "given", expected));
    }
    ErrorModel::new(entries, robot, None)
}
