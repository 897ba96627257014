//! `cdpr study run`, `merge` and `extend`: a study carried out, as a whole or one shard of it.
//!
//! A process that ends at any moment loses no more than the block under way, so that Ctrl-C only ends it.

use super::common::Common;
use super::{interrupted, print};
use crate::program::arguments::Format;
use crate::program::error::ProgramError;
use crate::program::output::{Ending, progress};
use crate::program::questions;
use crate::program::said;
use cdpr_report::{draw, report_with};
use cdpr_robot::COLUMNS;
use cdpr_study::{
    Blocks, Plan, REPORT_NAME, Run, STUDY_NAME, Session, Shard, Study, StudyError, Summary, TableFormat,
    Watcher, observe_shard,
};
use clap::ValueEnum;
use indicatif::ProgressBar;
use std::borrow::Cow;
use std::path::Path;

/// Makes the blocks of one shard.
pub(super) fn shard(
    study: &Study,
    out: &Path,
    blocks: &Blocks,
    shard: Shard,
    format: Format,
) -> Result<(), ProgramError> {
    let progress = progress(Plan::new(study)?.observations(shard), "observations");
    interrupted::leave(&progress, out, "the same command goes on".to_owned())?;
    let tick = |done: usize| progress.inc(done as u64);
    let warn = warn(&progress);
    observe_shard(
        study,
        shard,
        &Session { blocks: Some(blocks), tick: &tick, warn: &warn, stop: &|| false },
    )?;
    progress.finish_and_clear();
    let text = |_: &_| {
        println!(
            "all blocks of the shard are in {}: cdpr study status, then cdpr study merge",
            out.display()
        );
    };
    Ok(format.print(&serde_json::json!({ "folder": out.to_string_lossy(), "shard": "done" }), text)?)
}

/// Makes the blocks that are missing, and analyses the whole study.
pub(super) fn whole(
    study: &Study,
    out: &Path,
    blocks: &Blocks,
    common: &Common,
) -> Result<Ending, ProgramError> {
    announce_slow(study)?;
    let progress = progress(study.all_observations()?, "observations");
    interrupted::leave(&progress, out, format!("go on with: {}", resumed(out, common)))?;
    let watcher = Watcher {
        begin: &|name| progress.set_message(name.to_owned()),
        tick: &|done| progress.inc(done as u64),
        warn: &warn(&progress),
        note: &|note| progress.suspend(|| said::note(format_args!("{note}"))),
        stop: &|| false,
    };
    let format = common.table.map(TableFormat::from);
    let Run { results, figures } = cdpr_study::run(study, blocks, format, &draw, watcher)?;
    progress.finish_and_clear();
    let timings = results.timings.clone().unwrap_or_default();
    common.format.print(&results.summary, |summary| {
        print::print(summary);
        if common.details.details {
            println!();
            print::print_details(summary, &timings);
        }
    })?;
    let page = report_with(&results, &figures, None)?;
    let path = blocks.results()?.write(REPORT_NAME, page.as_bytes())?;
    if common.format == Format::Text {
        println!("\nresults in {}\nreport in {}", out.display(), path.display());
        if !common.details.details {
            let mut command = format!("  {} --details", resumed(out, common));
            if command.chars().count() > COLUMNS {
                command = command.replace(" --resume", " \\\n    --resume");
            }
            println!("all measures: in the report, or with\n{command}");
        }
    }
    Ok(ending(&results.summary))
}

/// Seconds from which on a run is announced.
const LONG: f64 = 20.0;

/// Says before the run which samplings take long because the scalar models observe them.
fn announce_slow(study: &Study) -> Result<(), ProgramError> {
    let slow = study.scalar_samplings()?.into_iter().filter(|sampling| sampling.seconds > LONG);
    slow.for_each(|sampling| said::note(format_args!("{sampling}; `--observations N` makes fewer")));
    Ok(())
}

/// Names what is wrong about results: parts without any, nominal robots that are strained too much.
fn ending(summary: &Summary) -> Ending {
    let mut ending = Ending::Well;
    for (name, part) in &summary.studies {
        let failed: usize = part.failed().values().sum();
        questions::about_failed(name, failed, part.observations());
        for beyond in part.out_of_limits() {
            eprintln!("warning: {name}, nominal robot {beyond}");
            ending = Ending::SomethingWrong;
        }
    }
    ending
}

/// The command that continues a run, as a shell takes it.
fn resumed(out: &Path, common: &Common) -> String {
    let quoted = |path: &Path| {
        let text = path.display().to_string();
        // The one character that cannot be quoted is NUL, which no path holds.
        shlex::try_quote(&text).map_or_else(|_| text.clone(), Cow::into_owned)
    };
    let mut command =
        format!("cdpr study run {} --out {} --resume", quoted(&out.join(STUDY_NAME)), quoted(out));
    if let Some(table) = common.table.and_then(|table| table.to_possible_value()) {
        command += &format!(" --table {}", table.get_name());
    }
    if let Some(threads) = common.threads.threads {
        command += &format!(" --threads {threads}");
    }
    if common.format == Format::Json {
        command += " --format json";
    }
    if common.details.details {
        command += " --details";
    }
    command
}

fn warn(progress: &ProgressBar) -> impl Fn(&StudyError) + Sync {
    |damage| progress.suspend(|| eprintln!("warning: {damage}; it is made again"))
}
