//! `cdpr study run`, `merge` and `extend`: each part of a study is written as soon as it is done, so that nothing computed is lost
//! with what fails after it. A process that ends at any moment loses the block under way and no more: Ctrl-C need do nothing else.

use super::{RunError, print};
use crate::{report, sensitivity};
use cdpr_report::{Points, ReportError, pose_maps};
use cdpr_study::{
    Blocks, IndexMap, ObservationTable, STUDY_NAME, Sampling, Session, Shard, Study, StudyError,
    StudySummary, Summary, SurfaceSummary, TableFormat, Tally, Timings, analyse, compare, compute_surface,
    observe_into, observe_poses, observe_shard, write_figure, write_poses, write_sensitivity, write_summary,
    write_surface, write_timings,
};
use indicatif::{ProgressBar, ProgressState, ProgressStyle};
use std::fmt::Write;
use std::path::Path;
use std::time::Instant;

/// Exit code of a run that was interrupted, as shells have it.
const INTERRUPTED: i32 = 130;

/// Makes the blocks of one shard.
pub(super) fn shard(study: &Study, out: &Path, blocks: &Blocks, shard: Shard) -> Result<(), RunError> {
    let progress = progress(study)?;
    leave_when_interrupted(&progress, out, "the same command goes on".to_owned())?;
    let tick = |done: usize| progress.inc(done as u64);
    let warn = warn(&progress);
    observe_shard(study, shard, &Session { blocks: Some(blocks), tick: &tick, warn: &warn })?;
    progress.finish_and_clear();
    println!("all blocks of the shard are in {}: cdpr study status, then cdpr study merge", out.display());
    Ok(())
}

/// Makes what `first` leaves missing and analyses the whole. Without a format, samplings at one pose have tables as CSV.
pub(super) fn whole(
    study: &Study,
    out: &Path,
    blocks: &Blocks,
    format: Option<TableFormat>,
    first: impl FnOnce(&Session) -> Result<(), RunError>,
) -> Result<(), RunError> {
    let clock = Instant::now();
    let progress = progress(study)?;
    let folder = out.display();
    let remedy = format!("go on with: cdpr study run {folder}/{STUDY_NAME} --out {folder} --resume");
    leave_when_interrupted(&progress, out, remedy)?;
    let tick = |done: usize| progress.inc(done as u64);
    first(&Session { blocks: Some(blocks), tick: &tick, warn: &warn(&progress) })?;
    progress.reset();
    let mut run =
        Run { out, blocks, format, progress, studies: IndexMap::new(), timings: Timings::default() };
    for (name, spec) in &study.file.samplings {
        if spec.poses.is_some() { run.poses(study, name)? } else { run.sampling(study, name)? }
    }
    for name in study.file.surfaces.keys() {
        run.surface(study, name)?;
    }
    run.point_effects(study)?;
    let mut summary = Summary {
        study: study.file.name.clone(),
        robot: study.robot.name.clone(),
        version: env!("CARGO_PKG_VERSION").to_owned(),
        payload: study.file.payload,
        seed: study.file.seed,
        studies: run.studies,
        comparison: Vec::new(),
    };
    summary.comparison = compare(&study.file.comparison, &summary);
    write_summary(out, &summary)?;
    blocks.remove_unfinished()?;
    run.progress.finish_and_clear();
    let timings =
        Timings { threads: rayon::current_num_threads(), all: clock.elapsed().as_secs_f64(), ..run.timings };
    write_timings(out, &timings)?;
    print::print_results(&summary);
    for (name, study) in &summary.studies {
        if let StudySummary::Sampling(sampling) = study
            && let Some(found) = &sampling.sensitivity
        {
            sensitivity::print(&format!("{name}: {}", sampling.title), found);
        }
    }
    print::print_comparison(&summary);
    for (name, seconds) in &timings.seconds {
        println!("{name:24} {seconds:6.2} s");
    }
    println!("{:24} {:6.2} s", "all", timings.all);
    println!("\nresults in {}", out.display());
    let path = out.join("report.html");
    report::write(out, &path)?;
    println!("report in {}", path.display());
    Ok(())
}

/// Blocks are whole or not there: on Ctrl-C (or an end of time on a cluster) the process says how to go on, and leaves.
fn leave_when_interrupted(progress: &ProgressBar, out: &Path, remedy: String) -> Result<(), RunError> {
    let (progress, out) = (progress.clone(), out.display().to_string());
    ctrlc::set_handler(move || {
        progress.abandon();
        eprintln!("\ninterrupted: what is done is in {out}; {remedy}");
        std::process::exit(INTERRUPTED);
    })?;
    Ok(())
}

fn warn(progress: &ProgressBar) -> impl Fn(&StudyError) + Sync {
    |damage| progress.suspend(|| eprintln!("warning: {damage}; it is made again"))
}

/// A run under way.
struct Run<'a> {
    out: &'a Path,
    blocks: &'a Blocks,
    format: Option<TableFormat>,
    progress: ProgressBar,
    studies: IndexMap<String, StudySummary>,
    timings: Timings,
}

impl Run<'_> {
    fn sampling(&mut self, study: &Study, name: &str) -> Result<(), RunError> {
        let clock = Instant::now();
        let sampling = study.sampling(name)?;
        let tick = |done: usize| self.progress.inc(done as u64);
        let warn = warn(&self.progress);
        let session = Session { blocks: Some(self.blocks), tick: &tick, warn: &warn };
        let tally = self.observed(&sampling, &session, self.format.unwrap_or(TableFormat::Csv))?;
        let summary = analyse(&sampling, &tally, &session)?;
        self.figure(name, cdpr_report::histogram(&summary))?;
        if !summary.signed_effects_mm.is_empty() {
            self.figure(&format!("{name}_effects"), cdpr_report::signed_effects(&summary, 20))?;
        }
        if let Some(measures) = &summary.sensitivity {
            let seconds = measures.methods.iter().map(|(name, method)| (name.clone(), method.seconds));
            self.timings.sensitivity.insert(name.to_owned(), seconds.collect());
            write_sensitivity(self.out, name, measures)?;
            self.figure(&format!("{name}_sensitivity"), cdpr_report::shares(&summary, 12))?;
        }
        self.studies.insert(name.to_owned(), StudySummary::Sampling(Box::new(summary)));
        self.timings.seconds.insert(name.to_owned(), clock.elapsed().as_secs_f64());
        Ok(())
    }

    /// A sampling at several poses; tables of their observations only if they are asked for: those of all poses may be more than a disk holds.
    fn poses(&mut self, study: &Study, name: &str) -> Result<(), RunError> {
        let clock = Instant::now();
        let tick = |done: usize| self.progress.inc(done as u64);
        let warn = warn(&self.progress);
        let session = Session { blocks: Some(self.blocks), tick: &tick, warn: &warn };
        let format = self.format.unwrap_or(TableFormat::None);
        let observe = |sampling: &Sampling| self.observed(sampling, &session, format);
        let (summary, rows) = observe_poses(study, name, &session, observe)?;
        write_poses(self.out, name, &rows)?;
        let maps = pose_maps(&study.robot, &summary, &rows);
        if maps.is_empty() {
            self.progress.suspend(|| eprintln!("note: no map of {name}: its poses are on no plane or box"));
        }
        for (map, svg) in maps {
            self.figure(&format!("{name}_{map}"), svg)?;
        }
        self.studies.insert(name.to_owned(), StudySummary::Poses(summary));
        self.timings.seconds.insert(name.to_owned(), clock.elapsed().as_secs_f64());
        Ok(())
    }

    /// Observations of a sampling, and their table.
    fn observed(
        &self,
        sampling: &Sampling,
        session: &Session,
        format: TableFormat,
    ) -> Result<Tally, StudyError> {
        self.progress.set_message(sampling.name.clone());
        let mut table = ObservationTable::new(self.out, sampling, format)?;
        let tally = observe_into(sampling, session, |part| format.rows(part), |rows| table.write(rows))?;
        // The table is written whether or not its statistics can be computed.
        table.finish()?;
        Ok(tally)
    }

    fn surface(&mut self, study: &Study, name: &str) -> Result<(), RunError> {
        let clock = Instant::now();
        self.progress.set_message(name.to_owned());
        let surface = study.surface(name)?;
        let result = compute_surface(&surface, &|done| self.progress.inc(done as u64));
        write_surface(self.out, &surface, &result)?;
        let summary = SurfaceSummary::new(&surface, &result);
        self.figure(name, cdpr_report::surface(&summary, &result))?;
        self.studies.insert(name.to_owned(), StudySummary::Surface(summary));
        self.timings.seconds.insert(name.to_owned(), clock.elapsed().as_secs_f64());
        Ok(())
    }

    /// The effects of anchor and exit points of all samplings that have them, one panel each.
    fn point_effects(&self, study: &Study) -> Result<(), RunError> {
        for (name, letter, points) in
            [("anchor_points", "a1.x", Points::Anchor), ("exit_points", "b1.x", Points::Exit)]
        {
            let samplings: Vec<_> = self
                .studies
                .iter()
                .filter_map(|(name, study)| match study {
                    StudySummary::Sampling(sampling) if sampling.t_student.contains_key(letter) => {
                        Some((name.as_str(), sampling.as_ref()))
                    }
                    _ => None,
                })
                .collect();
            if !samplings.is_empty() {
                self.figure(name, cdpr_report::point_effects(&study.robot, &samplings, points))?;
            }
        }
        Ok(())
    }

    /// Writes a figure, or notes why there is none: results that cannot be drawn are results nevertheless.
    fn figure(&self, name: &str, svg: Result<String, ReportError>) -> Result<(), RunError> {
        match svg {
            Ok(svg) => write_figure(self.out, name, &svg).map(|_| ())?,
            Err(error) => self.progress.suspend(|| eprintln!("note: no figure {name}: {error}")),
        }
        Ok(())
    }
}

/// A bar with rate and time left over all observations and grid points; silent when not on a terminal.
fn progress(study: &Study) -> Result<ProgressBar, StudyError> {
    let file = &study.file;
    let samplings = file.samplings.keys().map(|name| study.observations(name)).sum::<Result<usize, _>>()?;
    let surfaces = file.surfaces.values().map(|s| s.x.points * s.y.points).sum::<usize>();
    let template = "{msg:24} {bar:30} {pos}/{len} observations, {rate}, {eta} left";
    let rate = |state: &ProgressState, out: &mut dyn Write| {
        // Nothing to be done about a terminal that takes no text.
        let _ = write!(out, "{:.0}/s", state.per_sec());
    };
    let bar = ProgressBar::new((samplings + surfaces) as u64);
    Ok(match ProgressStyle::with_template(template) {
        Ok(style) => bar.with_style(style.with_key("rate", rate)),
        Err(_) => bar,
    })
}
