//! Whole runs: a study carried out in its folder of results.
//!
//! Each part is written as soon as it is done, so that nothing computed is lost with what fails after it. A
//! process that ends at any moment loses the block under way and no more. Figures are drawn by a function of
//! the caller, once each.

use crate::analysis::part::StudySummary;
use crate::analysis::poses::{PoseRow, PosesResult, PosesSummary, observe_poses};
use crate::analysis::sampling::{SamplingSummary, analyse};
use crate::analysis::summary::Summary;
use crate::analysis::surface::{SurfaceResult, SurfaceSummary, compute_surface};
use crate::error::StudyError;
use crate::file::study_file::StudyFile;
use crate::fs::files::read;
use crate::fs::owned::ResultsFolder;
use crate::model::study::{Sampling, Study};
use crate::names::{REPORT_NAME, ROBOT_NAME, STUDY_NAME, SUMMARY_NAME, TIMINGS_NAME};
use crate::observe::observation::{Session, Tally, observe_into};
use crate::results::read::Results;
use crate::results::table::{ObservationTable, TableFormat};
use crate::results::write::{
    Timings, write_figure, write_poses, write_sensitivity, write_summary, write_surface, write_timings,
};
use crate::store::blocks::Blocks;
use indexmap::IndexMap;
use std::time::Instant;

/// Functions that hear how far a run is.
#[derive(Clone, Copy)]
pub struct Watcher<'a> {
    /// Called with the name of each sampling at one pose and of each surface when it begins.
    pub begin: &'a (dyn Fn(&str) + Sync),
    /// Called with the number of further observations or points that are done.
    pub tick: &'a (dyn Fn(usize) + Sync),
    /// Called with each damaged block, which is made again.
    pub warn: &'a (dyn Fn(&StudyError) + Sync),
    /// Called with each figure that cannot be drawn, and the reason.
    pub note: &'a (dyn Fn(&str) + Sync),
    /// Returns, before each block, whether the run is to end there.
    pub stop: &'a (dyn Fn() -> bool + Sync),
}

/// Results that figures can be drawn of.
#[derive(Clone, Copy)]
pub enum Drawable<'a> {
    /// A sampling at one pose.
    Sampling {
        /// Its name.
        name: &'a str,
        /// Its results.
        summary: &'a SamplingSummary,
    },
    /// A sampling at several poses.
    Poses {
        /// Its name.
        name: &'a str,
        /// Its results.
        summary: &'a PosesSummary,
        /// One row for each pose.
        rows: &'a [PoseRow],
    },
    /// A surface.
    Surface {
        /// Its name.
        name: &'a str,
        /// Its results.
        summary: &'a SurfaceSummary,
        /// The deflection over its grid.
        result: &'a SurfaceResult<String>,
    },
    /// The study as a whole.
    Whole {
        /// Results of all parts of the study.
        studies: &'a IndexMap<String, StudySummary>,
    },
}

/// A figure of results.
#[derive(Clone, Debug, PartialEq)]
pub struct Figure {
    /// Name of its file, without the ending.
    pub name: String,
    /// Text of the file, or why it cannot be written.
    pub svg: Result<String, String>,
}

/// Draws all figures of some results of a study.
pub type Draw<'a> = &'a (dyn Fn(&Study, Drawable) -> Vec<Figure> + Sync);

/// A study that was carried out.
#[derive(Clone, Debug)]
pub struct Run {
    /// The results, as [`Results::read`] finds them in the folder.
    pub results: Results,
    /// The figures, in the order in which they were drawn.
    pub figures: Vec<Figure>,
}

/// Makes what is missing of a study in its folder of results, analyses the whole, and writes tables, figures,
/// `summary.json` and `timings.json`. Without a format, samplings at one pose have tables as CSV.
///
/// # Errors
/// The errors of files and blocks, [`StudyError::NotOwned`] for a folder opened to be read, and
/// [`StudyError::Stopped`].
pub fn run(
    study: &Study,
    blocks: &Blocks,
    format: Option<TableFormat>,
    draw: Draw,
    watcher: Watcher,
) -> Result<Run, StudyError> {
    let clock = Instant::now();
    let out = blocks.results()?.as_ref();
    blocks.remove_summary()?;
    out.claim(study.file.names(format.unwrap_or(TableFormat::Csv).ending()))?;
    let mut run = Running {
        study,
        out,
        blocks,
        format,
        draw,
        watcher,
        studies: IndexMap::new(),
        surfaces: IndexMap::new(),
        poses: IndexMap::new(),
        timings: Timings::default(),
        figures: Vec::new(),
    };
    for (name, spec) in &study.file.samplings {
        if spec.poses.is_some() { run.at_poses(name)? } else { run.sampling(name)? }
    }
    for name in study.file.surfaces.keys() {
        run.surface(name)?;
    }
    let drawn = draw(study, Drawable::Whole { studies: &run.studies });
    run.figures(drawn)?;
    let Running { studies, surfaces, poses, timings, figures, .. } = run;
    // What is of an earlier run and not of this one would not belong to the summary.
    out.remove_stale(&[ROBOT_NAME, STUDY_NAME, SUMMARY_NAME, TIMINGS_NAME, REPORT_NAME])?;
    let summary = Summary::new(study, studies)?;
    write_summary(out, &summary)?;
    blocks.remove_unfinished()?;
    let timings =
        Timings { threads: rayon::current_num_threads(), all: clock.elapsed().as_secs_f64(), ..timings };
    write_timings(out, &timings)?;
    let path = out.path().join(STUDY_NAME);
    let (study_json, robot_json) = (read(&path)?, read(&out.path().join(ROBOT_NAME))?);
    let file = StudyFile { robot: ROBOT_NAME.to_owned(), ..study.file.clone() };
    let study = Study { path, file, ..study.clone() };
    let results = Results { study, study_json, robot_json, summary, surfaces, poses, timings: Some(timings) };
    Ok(Run { results, figures })
}

/// A run under way.
struct Running<'a> {
    study: &'a Study,
    out: &'a ResultsFolder,
    blocks: &'a Blocks,
    format: Option<TableFormat>,
    draw: Draw<'a>,
    watcher: Watcher<'a>,
    studies: IndexMap<String, StudySummary>,
    surfaces: IndexMap<String, SurfaceResult<String>>,
    poses: IndexMap<String, Vec<PoseRow>>,
    timings: Timings,
    figures: Vec<Figure>,
}

impl<'a> Running<'a> {
    fn sampling(&mut self, name: &str) -> Result<(), StudyError> {
        let clock = Instant::now();
        let session = self.session();
        let sampling = self.study.sampling(name)?;
        let tally = self.observed(&sampling, &session, self.format.unwrap_or(TableFormat::Csv))?;
        let summary = analyse(&sampling, &tally, &session)?;
        if let Some(measures) = &summary.sensitivity {
            let seconds = measures.methods.iter().map(|(name, method)| (name.clone(), method.seconds));
            self.timings.sensitivity.insert(name.to_owned(), seconds.collect());
            write_sensitivity(self.out, name, measures)?;
        }
        self.figures((self.draw)(self.study, Drawable::Sampling { name, summary: &summary }))?;
        self.finish(name, StudySummary::Sampling(Box::new(summary)), clock);
        Ok(())
    }

    /// A sampling at several poses. Tables of their observations are written only if they are asked for:
    /// those of all poses may be more than a disk holds.
    fn at_poses(&mut self, name: &str) -> Result<(), StudyError> {
        let clock = Instant::now();
        let session = self.session();
        let format = self.format.unwrap_or(TableFormat::None);
        let poses = self.study.poses(name, self.study.entry(name)?.1)?;
        if let (Some(ending), Some(several)) = (format.ending(), poses.several()) {
            self.out.claim((0..several).map(|number| format!("{}.{ending}", poses.name(name, number))))?;
        }
        let observe = |sampling: &Sampling| self.observed(sampling, &session, format);
        let PosesResult { summary, rows } = observe_poses(self.study, name, &session, observe)?;
        write_poses(self.out, name, &rows)?;
        let maps = (self.draw)(self.study, Drawable::Poses { name, summary: &summary, rows: &rows });
        if maps.is_empty() {
            (self.watcher.note)(&format!("no map of {name}: its poses are on no plane or box"));
        }
        self.figures(maps)?;
        self.poses.insert(name.to_owned(), rows);
        self.finish(name, StudySummary::Poses(summary), clock);
        Ok(())
    }

    fn surface(&mut self, name: &str) -> Result<(), StudyError> {
        let clock = Instant::now();
        (self.watcher.begin)(name);
        let surface = self.study.surface(name)?;
        let result = compute_surface(&surface, self.watcher.tick);
        write_surface(self.out, &surface, &result)?;
        let summary = SurfaceSummary::new(&surface, &result);
        let result = result.by_kind();
        self.figures((self.draw)(
            self.study,
            Drawable::Surface { name, summary: &summary, result: &result },
        ))?;
        self.surfaces.insert(name.to_owned(), result);
        self.finish(name, StudySummary::Surface(summary), clock);
        Ok(())
    }

    fn finish(&mut self, name: &str, summary: StudySummary, clock: Instant) {
        self.studies.insert(name.to_owned(), summary);
        self.timings.seconds.insert(name.to_owned(), clock.elapsed().as_secs_f64());
    }

    fn session(&self) -> Session<'a> {
        let Watcher { tick, warn, stop, .. } = self.watcher;
        Session { blocks: Some(self.blocks), tick, warn, stop }
    }

    /// Makes the observations of a sampling at one pose, and their table.
    fn observed(
        &self,
        sampling: &Sampling,
        session: &Session,
        format: TableFormat,
    ) -> Result<Tally, StudyError> {
        (self.watcher.begin)(&sampling.name);
        let mut table = ObservationTable::new(self.out, sampling, format)?;
        let tally = observe_into(sampling, session, |part| format.rows(part), |rows| table.write(rows))?;
        // The table is written whether or not its statistics can be computed.
        table.finish()?;
        Ok(tally)
    }

    /// Writes figures, or notes why one cannot be drawn; such results remain valid.
    fn figures(&mut self, drawn: Vec<Figure>) -> Result<(), StudyError> {
        for Figure { name, svg } in &drawn {
            match svg {
                Ok(svg) => write_figure(self.out, name, svg).map(|_| ())?,
                Err(reason) => (self.watcher.note)(&format!("no figure {name}: {reason}")),
            }
        }
        self.figures.extend(drawn);
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::fs::disk::faults::{DIED, Fault, with};
    use crate::names::LOCK_NAME;
    use crate::store::folder::{Existing, begin};
    use serde_json::{Value, json};
    use std::collections::BTreeMap;
    use std::path::{Path, PathBuf};
    use std::process::Command;

    /// Variable with the folder, the number of the operation and the fault, for a process that a fault ends.
    const FAULT: &str = "CDPR_TEST_FAULT";

    type Files = BTreeMap<PathBuf, Vec<u8>>;

    /// CAROCA at one pose and at a list of two, with tables, and a surface.
    fn study(change: impl FnOnce(&mut Value)) -> Study {
        let data = Path::new(concat!(env!("CARGO_MANIFEST_DIR"), "/../../data/studies"));
        let path = data.join("caroca-poses.json");
        let mut study: Value = serde_json::from_str(&std::fs::read_to_string(&path).unwrap()).unwrap();
        let model = study["error_models"]["table_4"].as_object_mut().unwrap();
        model.retain(|name, _| ["mass", "youngs_modulus"].contains(&name.as_str()));
        let pose = json!({"position": [0.0, 0.0, 1.75]});
        let plane = &mut study["samplings"]["plane"];
        plane["observations"] = json!(3);
        let mut alone = plane.clone();
        plane["poses"] = json!({"list": [pose]});
        alone.as_object_mut().unwrap().remove("poses");
        alone["pose"] = pose.clone();
        study["samplings"]["alone"] = alone;
        (study["replicates"], study["bootstrap_resamples"]) = (json!(0), json!(1));
        let axis = |parameter: &str| json!({"parameter": parameter, "min": -1.0, "max": 1.0, "points": 2});
        study["surfaces"] = json!({
            "sheet": {"title": "Sheet", "pose": pose, "x": axis("mass"), "y": axis("linear_density")}
        });
        study["surfaces"]["sheet"]["y"]["min"] = json!(-0.01);
        study["surfaces"]["sheet"]["y"]["max"] = json!(0.01);
        change(&mut study);
        Study::from_json(&study.to_string(), &path).unwrap()
    }

    /// A run with its report.
    fn whole(study: &Study, out: &Path, existing: Existing) -> Result<(), StudyError> {
        let blocks = begin(out, study, existing)?;
        let figure = |name: &str| Figure { name: name.to_owned(), svg: Ok("<svg></svg>".to_owned()) };
        let draw = |_: &Study, of: Drawable| match of {
            Drawable::Sampling { name, .. } | Drawable::Surface { name, .. } => vec![figure(name)],
            Drawable::Poses { name, .. } => vec![figure(&format!("{name}_mean"))],
            Drawable::Whole { .. } => vec![figure("robot")],
        };
        let watcher =
            Watcher { begin: &|_| (), tick: &|_| (), warn: &|_| (), note: &|_| (), stop: &|| false };
        let Run { results, .. } = run(study, &blocks, Some(TableFormat::Csv), &draw, watcher)?;
        let report = format!("report of {}", results.summary.hash);
        blocks.results()?.write(REPORT_NAME, report.as_bytes()).map(|_| ())
    }

    /// All files below a folder.
    fn files(out: &Path) -> Files {
        let (mut folders, mut files) = (vec![out.to_owned()], Files::new());
        while let Some(folder) = folders.pop() {
            for path in std::fs::read_dir(&folder).unwrap().map(|entry| entry.unwrap().path()) {
                if path.is_dir() {
                    folders.push(path);
                } else {
                    files.insert(path.strip_prefix(out).unwrap().to_owned(), std::fs::read(&path).unwrap());
                }
            }
        }
        files
    }

    fn put(files: &Files, out: &Path) {
        for (name, content) in files {
            let path = out.join(name);
            std::fs::create_dir_all(path.parent().unwrap()).unwrap();
            std::fs::write(path, content).unwrap();
        }
    }

    /// Runs `second` over what `first` has left, with a fault at each operation in turn; then nothing of the
    /// user is lost, nothing is mixed, and the run that goes on ends with the bytes of one without a fault.
    fn at_every_operation(test: &str, first: Option<&Study>, second: &Study, existing: Existing) {
        if let Some(fault) = std::env::var_os(FAULT) {
            let (out, number, after) = serde_json::from_str(fault.to_str().unwrap()).unwrap();
            let (out, number, after): (PathBuf, usize, bool) = (out, number, after);
            let fault = if after { Fault::DieAfter } else { Fault::DieBefore };
            let (ended, _) = with(Some((number, fault)), || whole(second, &out, existing));
            panic!("the process goes on: {ended:?}");
        }
        let folder = tempfile::tempdir().unwrap();
        let out = folder.path().join("out");
        if let Some(first) = first {
            whole(first, &out, Existing::Refuse).unwrap();
            for name in ["mine.csv", "plane/2024.csv", "blocks/mine.txt", "blocks/alone/mine.block"] {
                put(&[(PathBuf::from(name), b"mine".to_vec())].into(), &out);
            }
        }
        let before = if first.is_some() { files(&out) } else { Files::new() };
        let mine: Vec<_> = before.iter().filter(|(_, content)| *content == b"mine").collect();
        let (ended, operations) = with(None, || whole(second, &out, existing));
        ended.unwrap();
        let without_times = |mut files: Files| {
            assert!(files.remove(Path::new(TIMINGS_NAME)).is_some());
            files
        };
        let after = without_times(files(&out));
        assert!(operations.len() > 50 && after.contains_key(Path::new(LOCK_NAME)), "{operations:?}");
        let summary = |files: &Files| files.get(Path::new(SUMMARY_NAME)).cloned();
        let mut died = 0;
        for (number, (operation, path)) in operations.iter().enumerate() {
            // EIO and ENOSPC in turn: the program does not tell them apart.
            let error = Fault::Error([5, 28][number % 2]);
            for fault in [error, Fault::DieBefore, Fault::DieAfter] {
                let what = format!("{fault:?} at {number}, {operation} {}", path.display());
                // What a process leaves before an operation is what it leaves after the one before.
                if fault == Fault::DieAfter && !["rename", "unlink"].contains(operation) {
                    continue;
                }
                if out.exists() {
                    std::fs::remove_dir_all(&out).unwrap();
                }
                put(&before, &out);
                if let Fault::Error(_) = fault {
                    let (ended, _) = with(Some((number, fault)), || whole(second, &out, existing));
                    assert!(ended.is_err(), "{what}");
                } else {
                    let fault = json!([out, number, fault == Fault::DieAfter]).to_string();
                    let mut child = Command::new(std::env::current_exe().unwrap());
                    child.args(["--exact", test, "--nocapture"]).env(FAULT, fault);
                    assert_eq!(child.output().unwrap().status.code(), Some(DIED), "{what}");
                    died += 1;
                }
                let left = if out.exists() { files(&out) } else { Files::new() };
                for (name, content) in &mine {
                    assert_eq!(left.get(*name), Some(*content), "{what}");
                }
                if let Some(found) = summary(&left) {
                    // A summary stands beside the files of its own run alone.
                    let whole = if Some(&found) == summary(&after).as_ref() { &after } else { &before };
                    for name in ["alone.csv", "plane.csv", "sheet.csv", "study.json", "alone.svg"] {
                        assert_eq!(left.get(Path::new(name)), whole.get(Path::new(name)), "{what}: {name}");
                    }
                }
                match whole(second, &out, Existing::GoOn) {
                    Err(StudyError::ForeignFolder { .. }) if existing == Existing::Overwrite => {
                        whole(second, &out, Existing::Overwrite).unwrap();
                    }
                    resumed => resumed.unwrap_or_else(|error| panic!("{what}: {error}")),
                }
                let resumed = without_times(files(&out));
                assert_eq!(resumed.keys().collect::<Vec<_>>(), after.keys().collect::<Vec<_>>(), "{what}");
                assert!(resumed == after, "{what}");
            }
        }
        assert!(died > operations.len());
    }

    #[test]
    fn a_first_run_that_fails_or_dies_at_any_operation_is_told_and_resumed_to_the_same_bytes() {
        let test = "run::tests::\
                    a_first_run_that_fails_or_dies_at_any_operation_is_told_and_resumed_to_the_same_bytes";
        at_every_operation(test, None, &study(|_| ()), Existing::Refuse);
    }

    #[test]
    fn a_run_that_overwrites_another_and_fails_or_dies_at_any_operation_loses_and_mixes_nothing() {
        let test = "run::tests::\
                    a_run_that_overwrites_another_and_fails_or_dies_at_any_operation_loses_and_mixes_nothing";
        let second = study(|study| study["payload"] = json!(60.0));
        at_every_operation(test, Some(&study(|_| ())), &second, Existing::Overwrite);
    }

    #[test]
    fn a_larger_study_that_fails_or_dies_at_any_operation_goes_on_with_the_blocks_of_the_smaller() {
        let test = "run::tests::\
                    a_larger_study_that_fails_or_dies_at_any_operation_goes_on_with_the_blocks_of_the_smaller";
        let second = study(|study| {
            study["samplings"]["plane"]["observations"] = json!(4);
            study["samplings"]["further"] = study["samplings"]["alone"].clone();
        });
        at_every_operation(test, Some(&study(|_| ())), &second, Existing::GoOn);
    }
}
