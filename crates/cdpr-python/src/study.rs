//! Studies: the same functions as `cdpr study`, on folders of results. `study.py` puts them together.

use crate::error::{Answer, Raised};
use crate::threads::watched;
use cdpr_report::{Watcher, report};
use cdpr_robot::Vector3;
use cdpr_sensitivity::SampleDesign;
use cdpr_study::{
    Existing, Part, Plan, Results, Session, Shard, Study, StudyError, TableFormat, check_complete,
    observe_into, observe_shard, open_results, write_text,
};
use numpy::{IxDyn, PyArray1, PyArrayMethods};
use pyo3::prelude::*;
use std::path::PathBuf;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::sync::{Mutex, PoisonError};

/// Makes the folder of a study, or goes on with it; says how many blocks and observations the study has.
#[pyfunction]
pub(crate) fn begin(
    study: PathBuf,
    out: PathBuf,
    observations: Option<usize>,
    resume: bool,
    overwrite: bool,
) -> Answer<(usize, usize)> {
    let mut study = Study::open(&study)?;
    if let Some(observations) = observations {
        study.set_observations(observations)?;
    }
    let existing = match (resume, overwrite) {
        (true, true) => {
            return Err(Raised::Input("resume and overwrite are both True: expected one of them".to_owned()));
        }
        (true, false) => Existing::GoOn,
        (false, true) => Existing::Overwrite,
        (false, false) => Existing::Refuse,
    };
    cdpr_study::begin(&out, &study, existing)?;
    Ok((Plan::new(&study)?.blocks(), observations_of(&study)?))
}

/// Makes the blocks of the `index`-th of `count` shards that are not in the folder; says how many observations they are.
#[pyfunction]
pub(crate) fn make_shard(
    py: Python,
    out: PathBuf,
    index: usize,
    count: usize,
    threads: usize,
) -> Answer<usize> {
    let (study, blocks) = open_results(&out)?;
    let shard = Shard::parse(&format!("{index}/{count}"), |_| None)?;
    let made = AtomicUsize::new(0);
    let tick = |more| {
        made.fetch_add(more, Ordering::Relaxed);
    };
    watched(
        py,
        Some(threads),
        |_| Ok(()),
        |stop| {
            let session = Session {
                blocks: Some(&blocks),
                tick: &tick,
                // It is made again, which is all there is to say of it.
                warn: &|_| (),
                stop: &|| stop.load(Ordering::Relaxed),
            };
            observe_shard(&study, shard, &session)
        },
    )??;
    Ok(made.into_inner())
}

/// Makes what is missing in the folder, unless it has to be complete, and analyses the whole; writes all results and the report.
#[pyfunction]
pub(crate) fn carry_out(
    py: Python,
    out: PathBuf,
    table: Option<&str>,
    threads: Option<usize>,
    complete: bool,
    progress: Option<Py<PyAny>>,
) -> Answer<Vec<String>> {
    let (study, blocks) = open_results(&out)?;
    let format = match table {
        None => None,
        Some("csv") => Some(TableFormat::Csv),
        Some("none") => Some(TableFormat::None),
        Some(table) => return Err(Raised::Input(format!("table is {table}: expected csv or none"))),
    };
    if complete {
        check_complete(&out, &study, &blocks)?;
    }
    let (all, done) = (observations_of(&study)?, AtomicUsize::new(0));
    let notes = Mutex::new(Vec::new());
    let note = |note: &str| notes.lock().unwrap_or_else(PoisonError::into_inner).push(note.to_owned());
    let mut told = 0;
    let mut tell = |py: Python| -> PyResult<()> {
        let now = done.load(Ordering::Relaxed);
        if let Some(progress) = progress.as_ref().filter(|_| now != told) {
            told = now;
            progress.call1(py, (now, all))?;
        }
        Ok(())
    };
    watched(py, threads, &mut tell, |stop| -> Result<(), StudyError> {
        let watcher = Watcher {
            begin: &|_| (),
            tick: &|more| {
                done.fetch_add(more, Ordering::Relaxed);
            },
            warn: &|damage| note(&format!("{damage}; it is made again")),
            note: &note,
            stop: &|| stop.load(Ordering::Relaxed),
        };
        cdpr_report::run(&study, &out, &blocks, format, watcher).map(|_| ())
    })??;
    tell(py)?;
    let page = report(&Results::read(&out)?);
    write_text(&out.join("report.html"), &page.map_err(|error| Raised::Input(error.to_string()))?)?;
    Ok(notes.into_inner().unwrap_or_else(PoisonError::into_inner))
}

/// Names of the inputs, deviations (m, k), dx, dy, dz and |dp| [mm] (m, 4) and kinds of failure of the observations of a sampling in a folder.
#[pyfunction]
#[allow(clippy::type_complexity)]
pub(crate) fn observations(
    py: Python,
    out: PathBuf,
    sampling: &str,
) -> Answer<(Vec<String>, Py<PyAny>, Py<PyAny>, Vec<Option<String>>)> {
    let (study, blocks) = open_results(&out)?;
    check_complete(&out, &study, &blocks)?;
    let sampling = study.sampling(sampling)?;
    let (mut rows, mut deflections, mut failures) = (Vec::new(), Vec::new(), Vec::new());
    watched(
        py,
        None,
        |_| Ok(()),
        |stop| {
            let session = Session {
                blocks: Some(&blocks),
                tick: &|_| (),
                warn: &|_| (),
                stop: &|| stop.load(Ordering::Relaxed),
            };
            observe_into(&sampling, &session, Part::clone, |part| {
                rows.extend(part.rows);
                for outcome in part.outcomes {
                    let displacement =
                        outcome.as_ref().copied().unwrap_or_else(|_| Vector3::repeat(f64::NAN));
                    let [dx, dy, dz] = displacement.into();
                    deflections.extend([dx, dy, dz, displacement.norm()].map(|metres| 1e3 * metres));
                    failures.push(outcome.err().map(|failure| failure.kind));
                }
                Ok(())
            })
        },
    )??;
    let names: Vec<String> = sampling.design.inputs().iter().map(|input| input.name.clone()).collect();
    let array = |values: Vec<f64>, width: usize| -> PyResult<Py<PyAny>> {
        let array = PyArray1::from_vec(py, values).reshape(IxDyn(&[failures.len(), width]))?;
        Ok(array.into_any().unbind())
    };
    let (rows, deflections) = (array(rows, names.len())?, array(deflections, 4)?);
    Ok((names, rows, deflections, failures))
}

/// Observations and points of a whole run, replicates and measures of sensitivity included.
fn observations_of(study: &Study) -> Answer<usize> {
    let of_sampling = |name: &String| study.observations(name);
    let samplings: usize = study.file.samplings.keys().map(of_sampling).sum::<Result<_, _>>()?;
    let surfaces: usize =
        study.file.surfaces.values().map(|surface| surface.x.points * surface.y.points).sum();
    Ok(samplings + surfaces)
}
