//! The parts of the explorer's page, and its file.

use crate::convert::{Answer, Raised};
use crate::robot::Robot;
use cdpr_report::{Explored, explorer};
use cdpr_study::{IfExists, write_file};
use cdpr_web::page;
use pyo3::prelude::*;
use pyo3::types::{PyBytes, PyDict};
use std::path::PathBuf;

/// The packed script, the worker, the style and the packed module of the explorer, for its widget.
#[pyfunction]
pub(crate) fn explorer_parts(py: Python<'_>) -> PyResult<Bound<'_, PyDict>> {
    let parts = PyDict::new(py);
    parts.set_item("script", PyBytes::new(py, page::SCRIPT))?;
    parts.set_item("worker", page::WORKER)?;
    parts.set_item("style", page::STYLE)?;
    parts.set_item("module", PyBytes::new(py, page::MODULE))?;
    Ok(parts)
}

#[pymethods]
impl Robot {
    /// Shows the robot in a notebook, where it computes as it is moved: a widget of the package anywidget.
    ///
    /// Parameters
    /// ----------
    /// state : dict, optional
    ///     What is shown first, as `Explorer.state` has it.
    ///
    /// Returns
    /// -------
    /// Any
    ///     The widget.
    ///
    /// Examples
    /// --------
    /// >>> import cdpr
    /// >>> robot = cdpr.Robot.from_file("cogiro")
    /// >>> widget = robot.explore()  # doctest: +SKIP
    #[pyo3(signature = (*, state = None))]
    fn explore(slf: Bound<'_, Self>, state: Option<Bound<'_, PyDict>>) -> PyResult<Py<PyAny>> {
        let module = slf.py().import("cdpr.explorer")?;
        Ok(module.call_method1("Explorer", (slf, state))?.unbind())
    }

    /// Writes the page of `cdpr explore`: one HTML file on which the robot computes in any browser.
    ///
    /// Parameters
    /// ----------
    /// path : path
    ///     The file. overwrite: whether a file that exists is replaced.
    /// overwrite : bool, default False
    ///     Whether what is there is replaced.
    ///
    /// Raises
    /// ------
    /// FileError
    ///     For a file or folder that cannot be read, written or used.
    ///
    /// Examples
    /// --------
    /// >>> import cdpr
    /// >>> robot = cdpr.Robot.from_file("cogiro")
    /// >>> robot.write_explorer("cogiro.html")  # doctest: +SKIP
    #[pyo3(signature = (path, *, overwrite = false))]
    fn write_explorer(&self, path: PathBuf, overwrite: bool) -> Answer<()> {
        let Self { robot } = self;
        let file = format!("{}.json", robot.name);
        let explored = Explored { name: &robot.name, file: &file, robot: &robot.to_json(), study: None };
        let page = explorer(&explored, env!("CARGO_PKG_VERSION"))
            .map_err(|error| Raised::Input(error.to_string()))?;
        Ok(write_file(&path, &page, IfExists::overwriting(overwrite))?)
    }
}
