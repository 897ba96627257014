//! A study carried out into its folder: each part is written as soon as it is done, so that nothing computed is lost with what fails after
//! it. A process that ends at any moment loses the block under way and no more.

use crate::error::ReportError;
use crate::figure::points::{Points, point_effects};
use crate::{histogram, pose_maps, robot_view, shares, signed_effects, surface};
use cdpr_study::{
    Blocks, IndexMap, ObservationTable, Sampling, Session, Study, StudyError, StudySummary, Summary,
    SurfaceSummary, TableFormat, Tally, Timings, analyse, compute_surface, observe_into, observe_poses,
    write_figure, write_poses, write_sensitivity, write_summary, write_surface, write_timings,
};
use std::path::Path;
use std::time::Instant;

/// Who is told how far a run is.
#[derive(Clone, Copy)]
pub struct Watcher<'a> {
    /// Told of each sampling, at one pose, or surface that is begun, by its name.
    pub begin: &'a (dyn Fn(&str) + Sync),
    /// Told how many more observations or points are there.
    pub tick: &'a (dyn Fn(usize) + Sync),
    /// Told of each damaged block, which is made again.
    pub warn: &'a (dyn Fn(&StudyError) + Sync),
    /// Told of each figure that cannot be drawn, and why.
    pub note: &'a (dyn Fn(&str) + Sync),
    /// Asked before each block whether to end there.
    pub stop: &'a (dyn Fn() -> bool + Sync),
}

/// Makes what is missing of a study in the folder `out`, analyses the whole, and writes tables, figures, `summary.json` and `timings.json`.
/// Without a format, samplings at one pose have tables as CSV.
/// The report of it is [`crate::report()`].
///
/// # Errors
/// Those of files and blocks; [`StudyError::Stopped`].
pub fn run(
    study: &Study,
    out: &Path,
    blocks: &Blocks,
    format: Option<TableFormat>,
    watcher: Watcher,
) -> Result<(Summary, Timings), StudyError> {
    let clock = Instant::now();
    blocks.remove_summary()?;
    let mut run = Run { out, blocks, format, watcher, studies: IndexMap::new(), timings: Timings::default() };
    for (name, spec) in &study.file.samplings {
        if spec.poses.is_some() { run.poses(study, name)? } else { run.sampling(study, name)? }
    }
    for name in study.file.surfaces.keys() {
        run.surface(study, name)?;
    }
    run.point_effects(study)?;
    run.figure("robot", robot_view(study))?;
    let summary = Summary::new(study, run.studies);
    write_summary(out, &summary)?;
    blocks.remove_unfinished()?;
    let timings =
        Timings { threads: rayon::current_num_threads(), all: clock.elapsed().as_secs_f64(), ..run.timings };
    write_timings(out, &timings)?;
    Ok((summary, timings))
}

/// A run under way.
struct Run<'a> {
    out: &'a Path,
    blocks: &'a Blocks,
    format: Option<TableFormat>,
    watcher: Watcher<'a>,
    studies: IndexMap<String, StudySummary>,
    timings: Timings,
}

impl<'a> Run<'a> {
    fn sampling(&mut self, study: &Study, name: &str) -> Result<(), StudyError> {
        let clock = Instant::now();
        let session = self.session();
        let sampling = study.sampling(name)?;
        let tally = self.observed(&sampling, &session, self.format.unwrap_or(TableFormat::Csv))?;
        let summary = analyse(&sampling, &tally, &session)?;
        self.figure(name, histogram(&summary))?;
        if !summary.signed_effects_mm.is_empty() {
            self.figure(&format!("{name}_effects"), signed_effects(&summary, 20))?;
        }
        if let Some(measures) = &summary.sensitivity {
            let seconds = measures.methods.iter().map(|(name, method)| (name.clone(), method.seconds));
            self.timings.sensitivity.insert(name.to_owned(), seconds.collect());
            write_sensitivity(self.out, name, measures)?;
            self.figure(&format!("{name}_sensitivity"), shares(&summary, 12))?;
        }
        self.studies.insert(name.to_owned(), StudySummary::Sampling(Box::new(summary)));
        self.timings.seconds.insert(name.to_owned(), clock.elapsed().as_secs_f64());
        Ok(())
    }

    /// A sampling at several poses; tables of their observations only if they are asked for: those of all poses may be more than a disk holds.
    fn poses(&mut self, study: &Study, name: &str) -> Result<(), StudyError> {
        let clock = Instant::now();
        let session = self.session();
        let format = self.format.unwrap_or(TableFormat::None);
        let observe = |sampling: &Sampling| self.observed(sampling, &session, format);
        let (summary, rows) = observe_poses(study, name, &session, observe)?;
        write_poses(self.out, name, &rows)?;
        let maps = pose_maps(&study.robot, &summary, &rows);
        if maps.is_empty() {
            (self.watcher.note)(&format!("no map of {name}: its poses are on no plane or box"));
        }
        for (map, svg) in maps {
            self.figure(&format!("{name}_{map}"), svg)?;
        }
        self.studies.insert(name.to_owned(), StudySummary::Poses(summary));
        self.timings.seconds.insert(name.to_owned(), clock.elapsed().as_secs_f64());
        Ok(())
    }

    fn session(&self) -> Session<'a> {
        let Watcher { tick, warn, stop, .. } = self.watcher;
        Session { blocks: Some(self.blocks), tick, warn, stop }
    }

    /// Observations of a sampling, and their table.
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

    fn surface(&mut self, study: &Study, name: &str) -> Result<(), StudyError> {
        let clock = Instant::now();
        (self.watcher.begin)(name);
        let sheet = study.surface(name)?;
        let result = compute_surface(&sheet, self.watcher.tick);
        write_surface(self.out, &sheet, &result)?;
        let summary = SurfaceSummary::new(&sheet, &result);
        self.figure(name, surface(&summary, &result))?;
        self.studies.insert(name.to_owned(), StudySummary::Surface(summary));
        self.timings.seconds.insert(name.to_owned(), clock.elapsed().as_secs_f64());
        Ok(())
    }

    /// The effects of anchor and exit points of all samplings that have them, one panel each.
    fn point_effects(&self, study: &Study) -> Result<(), StudyError> {
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
                self.figure(name, point_effects(&study.robot, &samplings, points))?;
            }
        }
        Ok(())
    }

    /// Writes a figure, or notes why there is none: results that cannot be drawn are results nevertheless.
    fn figure(&self, name: &str, svg: Result<String, ReportError>) -> Result<(), StudyError> {
        match svg {
            Ok(svg) => write_figure(self.out, name, &svg).map(|_| ())?,
            Err(error) => (self.watcher.note)(&format!("no figure {name}: {error}")),
        }
        Ok(())
    }
}
