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
use crate::fs::manifest::{Manifest, read};
use crate::fs::owned::ResultsFolder;
use crate::model::study::{Sampling, Study};
use crate::names::{ROBOT_NAME, STUDY_NAME};
use crate::observe::observation::{Session, Tally, observe_into};
use crate::results::read::Results;
use crate::results::table::{ObservationTable, TableFormat};
use crate::results::write::{
    Timings, write_figure, write_named, write_summary, write_surface, write_timings,
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
    let summary = Summary::new(study, studies)?;
    write_summary(out, &summary)?;
    blocks.remove_unfinished()?;
    let timings =
        Timings { threads: rayon::current_num_threads(), all: clock.elapsed().as_secs_f64(), ..timings };
    write_timings(out, &timings)?;
    let list = Manifest::read(out.path())?;
    let [study_json, robot_json] = [STUDY_NAME, ROBOT_NAME].map(|name| read(out.path(), list.as_ref(), name));
    let (path, study_json, robot_json) = (out.path().join(STUDY_NAME), study_json?, robot_json?);
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
            // One row an input: shares and indices have no unit, and a method that has failed leaves its
            // cells empty.
            let table = format!("{name}_sensitivity.csv");
            write_named(self.out, &table, summary.output, &measures.inputs)?;
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
        write_named(self.out, &format!("{name}.csv"), summary.output, &rows)?;
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
