//! `cdpr study run`: each part of a study is written as soon as it is done, so that nothing computed is lost with what fails
//! after it.

use crate::sensitivity;
use cdpr_report::{Points, ReportError};
use cdpr_study::{
    IndexMap, ObservationTable, Study, StudyError, StudySummary, Summary, SurfaceSummary, Timings, analyse,
    check_folder, compare, compute_surface, observe_into, remove_summary, write_figure, write_sensitivity,
    write_study, write_summary, write_surface, write_timings,
};
use comfy_table::{Table, presets};
use indicatif::{ProgressBar, ProgressState, ProgressStyle};
use std::fmt::Write;
use std::path::PathBuf;
use std::time::Instant;

/// What was asked for.
pub(crate) struct Settings {
    pub(crate) study: PathBuf,
    pub(crate) out: PathBuf,
    pub(crate) observations: Option<usize>,
    pub(crate) threads: Option<u16>,
}

#[derive(Debug, thiserror::Error)]
pub(crate) enum RunError {
    #[error(transparent)]
    Study(#[from] StudyError),
    #[error("cannot start {threads} threads: {source}")]
    Threads { threads: u16, source: rayon::ThreadPoolBuildError },
}

pub(crate) fn run(settings: &Settings) -> Result<(), RunError> {
    start_threads(settings.threads)?;
    let clock = Instant::now();
    let mut study = Study::open(&settings.study)?;
    if let Some(observations) = settings.observations {
        study.set_observations(observations)?;
    }
    check_folder(&settings.out)?;
    remove_summary(&settings.out)?;
    write_study(&settings.out, &study)?;
    let mut run =
        Run { settings, progress: progress(&study)?, studies: IndexMap::new(), timings: Timings::default() };
    for name in study.file.samplings.keys() {
        run.sampling(&study, name)?;
    }
    for name in study.file.surfaces.keys() {
        run.surface(&study, name)?;
    }
    run.point_effects()?;
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
    let path = write_summary(&settings.out, &summary)?;
    run.progress.finish_and_clear();
    let timings =
        Timings { threads: rayon::current_num_threads(), all: clock.elapsed().as_secs_f64(), ..run.timings };
    write_timings(&settings.out, &timings)?;
    print_results(&summary);
    for (name, study) in &summary.studies {
        if let StudySummary::Sampling(sampling) = study
            && let Some(found) = &sampling.sensitivity
        {
            sensitivity::print(&format!("{name}: {}", sampling.title), found);
        }
    }
    print_comparison(&summary);
    for (name, seconds) in &timings.seconds {
        println!("{name:24} {seconds:6.2} s");
    }
    println!("{:24} {:6.2} s", "all", timings.all);
    println!("\nresults in {}", path.parent().unwrap_or(&path).display());
    Ok(())
}

/// Starts the threads that were asked for; all cores by default.
pub(crate) fn start_threads(threads: Option<u16>) -> Result<(), RunError> {
    let Some(threads) = threads else { return Ok(()) };
    let pool = rayon::ThreadPoolBuilder::new().num_threads(threads.into()).build_global();
    pool.map_err(|source| RunError::Threads { threads, source })
}

/// A run under way.
struct Run<'a> {
    settings: &'a Settings,
    progress: ProgressBar,
    studies: IndexMap<String, StudySummary>,
    timings: Timings,
}

impl Run<'_> {
    fn sampling(&mut self, study: &Study, name: &str) -> Result<(), RunError> {
        let clock = Instant::now();
        self.progress.set_message(name.to_owned());
        let tick = |done: usize| self.progress.inc(done as u64);
        let sampling = study.sampling(name)?;
        let mut table = ObservationTable::new(&self.settings.out, &sampling)?;
        let tally = observe_into(&sampling, &tick, |block| table.write(block))?;
        // The table is written whether or not its statistics can be computed.
        table.finish()?;
        let summary = analyse(&sampling, &tally, &tick);
        self.figure(name, cdpr_report::histogram(&summary))?;
        if !summary.signed_effects_mm.is_empty() {
            self.figure(&format!("{name}_effects"), cdpr_report::signed_effects(&summary, 20))?;
        }
        if let Some(measures) = &summary.sensitivity {
            let seconds = measures.methods.iter().map(|(name, method)| ((*name).to_owned(), method.seconds));
            self.timings.sensitivity.insert(name.to_owned(), seconds.collect());
            write_sensitivity(&self.settings.out, name, measures)?;
            self.figure(&format!("{name}_sensitivity"), cdpr_report::shares(&summary, 12))?;
        }
        self.studies.insert(name.to_owned(), StudySummary::Sampling(Box::new(summary)));
        self.timings.seconds.insert(name.to_owned(), clock.elapsed().as_secs_f64());
        Ok(())
    }

    fn surface(&mut self, study: &Study, name: &str) -> Result<(), RunError> {
        let clock = Instant::now();
        self.progress.set_message(name.to_owned());
        let surface = study.surface(name)?;
        let result = compute_surface(&surface, &|done| self.progress.inc(done as u64));
        write_surface(&self.settings.out, &surface, &result)?;
        let summary = SurfaceSummary::new(&surface, &result);
        self.figure(name, cdpr_report::surface(&summary, &result))?;
        self.studies.insert(name.to_owned(), StudySummary::Surface(summary));
        self.timings.seconds.insert(name.to_owned(), clock.elapsed().as_secs_f64());
        Ok(())
    }

    /// The effects of anchor and exit points of all samplings that have them, one panel each.
    fn point_effects(&self) -> Result<(), RunError> {
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
                self.figure(name, cdpr_report::point_effects(&samplings, points))?;
            }
        }
        Ok(())
    }

    /// Writes a figure, or notes why there is none: results that cannot be drawn are results nevertheless.
    fn figure(&self, name: &str, svg: Result<String, ReportError>) -> Result<(), RunError> {
        match svg {
            Ok(svg) => write_figure(&self.settings.out, name, &svg).map(|_| ())?,
            Err(error) => self.progress.suspend(|| eprintln!("note: no figure {name}: {error}")),
        }
        Ok(())
    }
}

/// A bar with rate and time left over all observations and grid points; silent when not on a terminal.
fn progress(study: &Study) -> Result<ProgressBar, StudyError> {
    let file = &study.file;
    let observations = |name| study.sampling(name).map(|sampling| sampling.observations());
    let samplings = file.samplings.keys().map(|name| observations(name)).sum::<Result<usize, _>>()?;
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

pub(crate) fn table(header: &[&str]) -> Table {
    let mut table = Table::new();
    table.load_style(presets::UTF8_FULL_CONDENSED).set_header(header);
    table
}

fn print_results(summary: &Summary) {
    println!("{}: {}\n", summary.robot, summary.study);
    let mut rows = table(&["study", "n", "failed", "nominal", "mean", "std", "min", "max", "[mm]  best fit"]);
    for (name, study) in &summary.studies {
        rows.add_row(match study {
            StudySummary::Sampling(s) => {
                let best = s.fits.iter().find(|fit| Some(fit.law) == s.best_fit);
                let best = best.map(|fit| format!("{}, p = {:.3}", fit.law, fit.p_value));
                let rms = s.rms_mm.as_ref();
                let rms = rms.map_or([None; 5], |r| [r.nominal, r.mean, r.std, r.min, r.max].map(Some));
                let counts = [s.observations, s.failed.values().sum()].map(|count| count.to_string());
                row(name, counts, rms, best.unwrap_or_default())
            }
            StudySummary::Surface(s) => {
                let rms = [Some(s.rms_mm.nominal), None, None, s.rms_mm.min, s.rms_mm.max];
                let counts = [s.observations, s.failed.values().sum()].map(|count| count.to_string());
                row(name, counts, rms, String::new())
            }
        });
    }
    println!("{rows}\n");
    for (name, study) in &summary.studies {
        let failed = match study {
            StudySummary::Sampling(s) => &s.failed,
            StudySummary::Surface(s) => &s.failed,
        };
        if let StudySummary::Sampling(s) = study {
            for note in &s.notes {
                println!("{name}: {note}");
            }
        }
        for (kind, count) in failed.iter().filter(|(_, count)| **count > 0) {
            println!("{name}: {count} failed: {kind}");
        }
    }
}

fn row(name: &str, counts: [String; 2], rms: [Option<f64>; 5], last: String) -> Vec<String> {
    let rms = rms.map(|value| value.map_or_else(String::new, |value| format!("{value:.4}")));
    [name.to_owned()].into_iter().chain(counts).chain(rms).chain([last]).collect()
}

fn print_comparison(summary: &Summary) {
    if summary.comparison.is_empty() {
        return;
    }
    let mut rows = table(&["figure", "quantity", "paper", "computed", "unit", "verdict"]);
    for r in &summary.comparison {
        let cells = [
            &r.figure,
            &r.quantity,
            &r.paper.to_string(),
            &r.computed.to_string(),
            &r.unit,
            &r.verdict.to_string(),
        ];
        rows.add_row(cells.map(String::clone));
    }
    println!("{rows}");
    println!("reproduced: within half of the published figure's last digit plus 1 % of it; words: the same");
    println!(
        "points: by the largest t of their coordinates; nearly equal: the largest at most 1.5 times the smallest\n"
    );
}
