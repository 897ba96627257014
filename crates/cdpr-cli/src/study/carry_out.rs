//! `cdpr study run`, `merge` and `extend`. A process that ends at any moment loses the block under way and no more: Ctrl-C need do nothing else.

use super::{RunError, print};
use crate::{report, sensitivity};
use cdpr_report::Watcher;
use cdpr_study::{
    Blocks, STUDY_NAME, Session, Shard, Study, StudyError, StudySummary, TableFormat, observe_shard,
};
use indicatif::{ProgressBar, ProgressState, ProgressStyle};
use std::fmt::Write;
use std::path::Path;

/// Exit code of a run that was interrupted, as shells have it.
const INTERRUPTED: i32 = 130;

/// Makes the blocks of one shard.
pub(super) fn shard(study: &Study, out: &Path, blocks: &Blocks, shard: Shard) -> Result<(), RunError> {
    let progress = progress(study)?;
    leave_when_interrupted(&progress, out, "the same command goes on".to_owned())?;
    let tick = |done: usize| progress.inc(done as u64);
    let warn = warn(&progress);
    observe_shard(
        study,
        shard,
        &Session { blocks: Some(blocks), tick: &tick, warn: &warn, stop: &|| false },
    )?;
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
    let progress = progress(study)?;
    let folder = out.display();
    let remedy = format!("go on with: cdpr study run {folder}/{STUDY_NAME} --out {folder} --resume");
    leave_when_interrupted(&progress, out, remedy)?;
    let watcher = Watcher {
        begin: &|name| progress.set_message(name.to_owned()),
        tick: &|done| progress.inc(done as u64),
        warn: &warn(&progress),
        note: &|note| progress.suspend(|| eprintln!("note: {note}")),
        stop: &|| false,
    };
    let Watcher { tick, warn, stop, .. } = watcher;
    first(&Session { blocks: Some(blocks), tick, warn, stop })?;
    progress.reset();
    let (summary, timings) = cdpr_report::run(study, out, blocks, format, watcher)?;
    progress.finish_and_clear();
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
