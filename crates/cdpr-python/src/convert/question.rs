//! Questions about numbers that are probably not what was meant: warnings of Python.

use crate::convert::error::Answer;
use cdpr_robot::Doubt;
use pyo3::exceptions::PyUserWarning;
use pyo3::prelude::*;
use std::ffi::CString;

/// Asks each question as a `UserWarning`; the numbers are taken as they are.
pub(crate) fn question(doubts: impl IntoIterator<Item = Doubt>) -> Answer<()> {
    doubts.into_iter().try_for_each(|doubt| warn(&doubt.to_string()))
}

/// Warns, also from a thread that does not hold Python's lock.
pub(crate) fn warn(message: &str) -> Answer<()> {
    let message = CString::new(message).unwrap_or_default();
    Ok(Python::attach(|py| PyErr::warn(py, &py.get_type::<PyUserWarning>(), &message, 1))?)
}
