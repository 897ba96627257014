//! `cdpr study status`: how far a study in a folder is.

use crate::program::arguments::Printing;
use crate::program::error::ProgramError;
use crate::program::output::{patiently, table};
use cdpr_robot::{counted, shown, significant};
use cdpr_study::{Provisional, SoFar, Status, StoredStudy, open_results, status};
use clap::Args;
use std::path::PathBuf;

#[derive(Args)]
pub(crate) struct Settings {
    /// Folder of the results.
    folder: PathBuf,
    #[command(flatten)]
    printing: Printing,
}

pub(super) fn run(settings: &Settings) -> Result<(), ProgramError> {
    let found = patiently("reading the results", || {
        let StoredStudy { study, blocks } = open_results(&settings.folder)?;
        status(&study, &blocks)
    })?;
    Ok(settings.printing.format().print(&found, print)?)
}

fn print(status: &Status) {
    let all = || status.samplings.values().flat_map(|sampling| sampling.designs.values());
    let (done, wanted) =
        all().fold((0, 0), |(done, wanted), of| (done + of.observed, wanted + of.observations));
    let observations = counted(done, "observation");
    if status.complete && status.analysed {
        println!("Complete and analysed, {observations}.");
    } else if status.complete {
        println!("Complete, {observations}: cdpr study merge analyses it.");
    } else {
        let percent = 100.0 * done as f64 / wanted.max(1) as f64;
        println!("Not complete: {done} of {} ({percent:.1} %).", counted(wanted, "observation"));
        println!("It goes on with cdpr study run --resume, or --shard.");
    }
    for (name, sampling) in &status.samplings {
        let SoFar { output, moments } = sampling.provisional;
        if let (Some(Provisional { mean, std }), unit) = (moments, output.unit()) {
            let [mean, std] = [significant(mean, 4), significant(std, 3)];
            println!("{name}: so far mean {} {mean} {unit}, std {std} {unit}", output.noun());
        }
    }
    println!("\n{} (hash {})", shown(&status.study), status.hash);
    let mut rows = table(&["sampling", "design", "blocks", "missing", "observations", "of", "failed"]);
    for (name, sampling) in &status.samplings {
        for (design, found) in &sampling.designs {
            let failed: usize = found.failed.values().sum();
            let counts =
                [found.blocks_done, found.blocks_missing, found.observed, found.observations, failed];
            let cells = counts.iter().map(ToString::to_string);
            rows.add_row([name.clone(), design.clone()].into_iter().chain(cells));
        }
    }
    println!("{rows}");
    for (name, sampling) in &status.samplings {
        for path in sampling.designs.values().flat_map(|design| &design.damaged) {
            println!("damaged, will be made again: {}", path.display());
        }
        let kinds = sampling.designs.iter().flat_map(|(design, found)| {
            found.failed.iter().map(move |(kind, count)| format!("{count} {kind} of {design}"))
        });
        let kinds: Vec<String> = kinds.collect();
        if !kinds.is_empty() {
            println!("{name}: failed: {}", kinds.join(", "));
        }
        if let Some(count) = sampling.poses_not_held.filter(|count| *count > 0) {
            println!("{name}: {count} poses have no blocks: the nominal robot does not hold them");
        }
    }
    for path in &status.changed {
        println!("not what the run has written: {}", path.display());
    }
}
