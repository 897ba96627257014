//! JSON between Python's dictionaries and the types of the models.

use crate::convert::error::{Answer, Raised};
use pyo3::prelude::*;
use pyo3::types::PyDict;

/// JSON of a dictionary, in which numbers of NumPy and arrays are numbers and lists.
pub(crate) fn json_text(name: &str, content: &Bound<PyAny>) -> Answer<String> {
    let py = content.py();
    let settings = PyDict::new(py);
    settings.set_item("default", py.import("operator")?.call_method1("methodcaller", ("tolist",))?)?;
    let text = py.import("json")?.call_method("dumps", (content,), Some(&settings));
    let text = text.map_err(|error| {
        Raised::Input(format!(
            "{name} cannot be written as JSON ({}): expected what `json.loads` makes",
            error.value(py)
        ))
    });
    Ok(text?.extract()?)
}

/// JSON of a value.
pub(crate) fn to_json(value: &impl serde::Serialize) -> Answer<String> {
    serde_json::to_string(value).map_err(|error| Raised::Input(error.to_string()))
}
