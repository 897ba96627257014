//! Functions of studies on folders of results, as `cdpr study` has them. `study.py` puts them together.

use crate::convert::{Answer, Numbers, Raised, components, run, to_json, watched, whole};
use crate::robot::Robot;
use crate::robot::inverse::coordinates;
use crate::source::Source;
use cdpr_assess::read_region;
use cdpr_report::{Sheet, draw, figures, report_with};
use cdpr_sensitivity::SampleDesign;
use cdpr_study::{
    Access, Existing, IfExists, Part, Plan, REPORT_NAME, ROBOT_NAME, Results, Run, Session, Shard,
    StoredStudy, StudyError, TableFormat, Watcher, check_complete, check_observed, observe_into,
    observe_shard, take_results, write_file,
};
use numpy::{IxDyn, PyArray1, PyArrayMethods};
use pyo3::prelude::*;
use std::path::PathBuf;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::sync::{Mutex, PoisonError};

/// The text of a study file for a robot, with usual tolerances.
#[pyfunction]
pub(crate) fn template(
    py: Python,
    robot: &Robot,
    position: Option<Numbers>,
    payload: Option<f64>,
    free: Option<Vec<String>>,
) -> Answer<String> {
    let position = position.map(|position| components("position", &position)).transpose()?;
    let free = coordinates(free)?;
    Ok(run(py, |_| cdpr_study::template(&robot.robot, ROBOT_NAME, position, payload, &free))??)
}

/// Makes the folder of a study, or continues with it; returns the numbers of blocks and observations.
///
/// All settings of the run are checked before anything is removed.
#[pyfunction]
#[allow(clippy::too_many_arguments)]
pub(crate) fn begin(
    py: Python,
    study: Source,
    robot: Option<&Robot>,
    out: PathBuf,
    observations: Option<Bound<PyAny>>,
    resume: bool,
    overwrite: bool,
    table: Option<&str>,
    threads: Option<usize>,
) -> Answer<(usize, usize)> {
    let existing = match (resume, overwrite) {
        (true, true) => {
            return Err(Raised::Input("resume and overwrite are both True: expected one of them".to_owned()));
        }
        (true, false) => Existing::GoOn,
        (false, true) => Existing::Overwrite,
        (false, false) => Existing::Refuse,
    };
    format_of(table)?;
    let observations = observations.map(|number| whole("observations", &number)).transpose()?;
    let begun = |_: &_| -> Answer<_> {
        let mut study = study.study(robot)?;
        if let Some(observations) = observations {
            study.set_observations(observations)?;
        }
        let size = (Plan::new(&study)?.blocks(), study.all_observations()?);
        cdpr_study::begin(&out, &study, existing)?;
        Ok(size)
    };
    watched(py, threads, |_| Ok(()), begun)?
}

/// Makes the missing blocks of the `index`-th of `count` shards; returns their number of observations.
#[pyfunction]
pub(crate) fn make_shard(
    py: Python,
    out: PathBuf,
    index: usize,
    count: usize,
    threads: usize,
) -> Answer<usize> {
    let made = AtomicUsize::new(0);
    let tick = |more| {
        made.fetch_add(more, Ordering::Relaxed);
    };
    watched(
        py,
        Some(threads),
        |_| Ok(()),
        |stop| {
            let StoredStudy { study, blocks } = take_results(&out, Access::Shared)?;
            let shard = Shard::parse(&format!("{index}/{count}"), |_| None)?;
            let session = Session {
                blocks: Some(&blocks),
                tick: &tick,
                // A damaged block is made again.
                warn: &|_| (),
                stop: &|| stop.load(Ordering::Relaxed),
            };
            observe_shard(&study, shard, &session)
        },
    )??;
    Ok(made.into_inner())
}

/// Makes what is missing in the folder, analyses the whole, and writes all results and the report.
///
/// A folder that must be `complete` is refused if blocks are missing. `progress` is called with the
/// observations that are done and `all`.
#[pyfunction]
#[allow(clippy::too_many_arguments)]
pub(crate) fn carry_out(
    py: Python,
    out: PathBuf,
    table: Option<&str>,
    threads: Option<usize>,
    complete: bool,
    all: usize,
    progress: Option<Py<PyAny>>,
) -> Answer<Vec<String>> {
    let format = format_of(table)?;
    let done = AtomicUsize::new(0);
    let notes = Mutex::new(Vec::new());
    let note = |note: &str| notes.lock().unwrap_or_else(PoisonError::into_inner).push(note.to_owned());
    let mut reported = 0;
    let mut tell = |py: Python| -> PyResult<()> {
        let now = done.load(Ordering::Relaxed);
        if let Some(progress) = progress.as_ref().filter(|_| now != reported) {
            reported = now;
            progress.call1(py, (now, all))?;
        }
        Ok(())
    };
    watched(py, threads, &mut tell, |stop| -> Answer<()> {
        let StoredStudy { study, blocks } = take_results(&out, Access::Alone)?;
        if complete {
            check_complete(&out, &study, &blocks)?;
        }
        let watcher = Watcher {
            begin: &|_| (),
            tick: &|more| {
                done.fetch_add(more, Ordering::Relaxed);
            },
            warn: &|damage| note(&format!("{damage}; it is made again")),
            note: &note,
            stop: &|| stop.load(Ordering::Relaxed),
        };
        let Run { results, figures } = cdpr_study::run(&study, &blocks, format, &draw, watcher)?;
        let page = report_with(&results, &figures, None).map_err(|error| Raised::Input(error.to_string()))?;
        blocks.results()?.write(REPORT_NAME, page.as_bytes())?;
        Ok(())
    })??;
    tell(py)?;
    Ok(notes.into_inner().unwrap_or_else(PoisonError::into_inner))
}

/// Checks that a folder holds results.
#[pyfunction]
pub(crate) fn open_results(py: Python, out: PathBuf) -> Answer<()> {
    run(py, |_| cdpr_study::open_results(&out))??;
    Ok(())
}

/// Returns how far the study in a folder is, as `cdpr study status --format json` prints it.
#[pyfunction]
pub(crate) fn status(py: Python, out: PathBuf) -> Answer<String> {
    to_json(&run(py, |_| {
        let StoredStudy { study, blocks } = cdpr_study::open_results(&out)?;
        cdpr_study::status(&study, &blocks)
    })??)
}

/// Reads the observations of a sampling in a folder.
///
/// Returns the names of the inputs, their deviations (m, k), the names of the output's columns, their values
/// (m, columns), and the kinds of failure.
#[pyfunction]
#[allow(clippy::type_complexity)]
pub(crate) fn observations(
    py: Python,
    out: PathBuf,
    sampling: &str,
) -> Answer<(Vec<String>, Py<PyAny>, Vec<&'static str>, Py<PyAny>, Vec<Option<String>>)> {
    let (mut rows, mut cells, mut failures) = (Vec::new(), Vec::new(), Vec::new());
    let (names, output) = run(py, |stop| -> Result<_, StudyError> {
        let StoredStudy { study, blocks } = cdpr_study::open_results(&out)?;
        let sampling = study.sampling(sampling)?;
        check_observed(&out, &study, &blocks, &sampling.name)?;
        let session = Session {
            blocks: Some(&blocks),
            tick: &|_| (),
            warn: &|_| (),
            stop: &|| stop.load(Ordering::Relaxed),
        };
        observe_into(&sampling, &session, Part::clone, |part| {
            rows.extend(part.rows);
            for outcome in part.outcomes {
                cells.extend(outcome.as_ref().unwrap_or(&part.output.nothing()).cells());
                failures.push(outcome.err().map(|failure| failure.kind));
            }
            Ok(())
        })?;
        let names: Vec<String> = sampling.design.inputs().iter().map(|input| input.name.clone()).collect();
        Ok((names, sampling.output()))
    })??;
    let array = |values: Vec<f64>, width: usize| -> PyResult<Py<PyAny>> {
        let array = PyArray1::from_vec(py, values).reshape(IxDyn(&[failures.len(), width]))?;
        Ok(array.into_any().unbind())
    };
    let columns = output.columns();
    let (rows, cells) = (array(rows, names.len())?, array(cells, columns.len())?);
    Ok((names, rows, columns.to_vec(), cells, failures))
}

/// The format of the tables of observations; `None` for the default.
fn format_of(table: Option<&str>) -> Answer<Option<TableFormat>> {
    match table {
        None => Ok(None),
        Some("csv") => Ok(Some(TableFormat::Csv)),
        Some("none") => Ok(Some(TableFormat::None)),
        Some(table) => Err(Raised::Input(format!("table is {table}: expected csv or none"))),
    }
}

/// Writes the report of a folder of results; returns its path.
///
/// workspace: folder with the boundary of a workspace, which is drawn around the robot.
#[pyfunction]
pub(crate) fn write_report(
    py: Python,
    folder: PathBuf,
    out: Option<PathBuf>,
    workspace: Option<PathBuf>,
    overwrite: bool,
) -> Answer<PathBuf> {
    run(py, |_| -> Answer<PathBuf> {
        let results = Results::read(&folder)?;
        let region = workspace.as_deref().map(read_region).transpose()?;
        let page = report_with(&results, &figures(&results, Sheet::SCREEN), region.as_ref());
        let page = page.map_err(|error| Raised::Input(error.to_string()))?;
        match out {
            Some(path) => write_file(&path, &page, IfExists::overwriting(overwrite)).map(|()| path),
            None => results.write_report(&folder, &page),
        }
        .map_err(Raised::from)
    })?
}
