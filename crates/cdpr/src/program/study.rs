//! Commands about studies, `cdpr study ...`, and `cdpr analyse`.

pub(crate) mod analyse;
mod carry_out;
mod common;
mod interrupted;
mod print;
mod report;
mod status;
mod template;
mod tolerances;

use crate::program::arguments;
use crate::program::error::ProgramError;
use crate::program::output::{Ending, patiently};
use crate::program::questions::take_results;
use cdpr_study::{Access, StoredStudy};
use clap::Subcommand;
use common::{FolderSettings, RunSettings, begun};

#[derive(Subcommand)]
pub(crate) enum Command {
    /// Write a first study of a robot.
    ///
    /// To a file or to the standard output.
    #[command(after_help = "Example: cdpr study new data/robots/cogiro.json --out my-study.json")]
    New(template::Settings),
    /// Run a study file.
    ///
    /// Writes its observations, figures, summary and report. What is done is kept block by block.
    #[command(after_help = "Example: cdpr study run data/studies/caroca.json --out results

Interrupted or killed, it continues with --resume and gives the same results to the last bit.
On several machines with a shared folder: --shard 1/4 ... --shard 4/4, then `cdpr study merge`.")]
    Run(RunSettings),
    /// Analyse a study whose blocks are all there.
    ///
    /// Such as those of all shards.
    #[command(after_help = "Example: cdpr study merge results")]
    Merge(FolderSettings),
    /// Print how far a study is.
    ///
    /// And what its observations say so far.
    #[command(after_help = "Example: cdpr study status results --format json")]
    Status(status::Settings),
    /// Continue a study to more observations.
    ///
    /// Of each sampling; those it has are kept.
    #[command(after_help = "Example: cdpr study extend results --observations 1000000")]
    Extend {
        #[command(flatten)]
        folder: FolderSettings,
        /// Observations of each sampling, including those it has.
        #[arg(long, value_parser = arguments::count::<3, 10_000_000_000>)]
        observations: usize,
    },
    /// Write the report of a study as one HTML file.
    ///
    /// With all figures; it opens offline.
    #[command(after_help = "Example: cdpr study report results")]
    Report(report::Settings),
    /// Find which tolerances to tighten, and by how much.
    ///
    /// So that an error stays below a limit.
    #[command(after_help = "Example: cdpr study tolerances data/studies/caroca.json \
                      --sampling geometrical_asymmetric --limit 'deflection_mm<0.9' --costs b=3")]
    Tolerances(tolerances::Settings),
}

pub(crate) fn run(command: Command) -> Result<Ending, ProgramError> {
    match command {
        Command::New(settings) => template::run(&settings).map(well),
        Command::Run(settings) => match processes(|name| std::env::var(name).ok()) {
            // Shards have numbers, however they are launched.
            Some(processes) if settings.shard.is_none() => Err(ProgramError::Together { processes }),
            _ => alone(&settings),
        },
        Command::Merge(FolderSettings { folder, common }) => {
            common.threads.start()?;
            let StoredStudy { study, blocks } = take_results(&folder, Access::Alone)?;
            let complete = || cdpr_study::check_complete(&folder, &study, &blocks);
            patiently("looking for blocks", complete)?;
            carry_out::whole(&study, &folder, &blocks, &common)
        }
        Command::Status(settings) => status::run(&settings).map(well),
        Command::Extend { folder: FolderSettings { folder, common }, observations } => {
            common.threads.start()?;
            let StoredStudy { study, blocks } = take_results(&folder, Access::Alone)?.extend(observations)?;
            carry_out::whole(&study, &folder, &blocks, &common)
        }
        Command::Report(settings) => report::run(&settings).map(well),
        Command::Tolerances(settings) => tolerances::run(&settings).map(well),
    }
}

/// The ending of a command that has nothing to say against what it did.
fn well((): ()) -> Ending {
    Ending::Well
}

/// Runs the study in this process alone.
fn alone(settings: &RunSettings) -> Result<Ending, ProgramError> {
    let (study, blocks) = begun(settings)?;
    match settings.shard()? {
        Some(shard) => {
            carry_out::shard(&study, &settings.out, &blocks, shard, settings.common.format).map(well)
        }
        None => carry_out::whole(&study, &settings.out, &blocks, &settings.common),
    }
}

/// Number of processes that were started together; `None` for one alone.
///
/// Open MPI, other MPIs and Slurm tell it to each process.
fn processes(variable: impl Fn(&str) -> Option<String>) -> Option<usize> {
    let count = ["OMPI_COMM_WORLD_SIZE", "PMI_SIZE", "SLURM_STEP_NUM_TASKS"].into_iter().find_map(variable);
    count.and_then(|count| count.parse().ok()).filter(|count| *count > 1)
}

#[cfg(test)]
mod tests {
    use super::processes;

    #[test]
    fn a_process_knows_whether_others_were_started_with_it() {
        let counted = |variable: &'static str, value: &'static str| {
            processes(|name| (name == variable).then(|| value.to_owned()))
        };
        assert_eq!(counted("OMPI_COMM_WORLD_SIZE", "4"), Some(4));
        assert_eq!(counted("PMI_SIZE", "2"), Some(2));
        assert_eq!(counted("SLURM_STEP_NUM_TASKS", "3"), Some(3));
        // One task of a job array, and no launcher at all.
        assert_eq!(counted("SLURM_STEP_NUM_TASKS", "1"), None);
        assert_eq!(counted("SLURM_NTASKS", "8"), None);
    }
}
