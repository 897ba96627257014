//! `cdpr study ...`: arguments of its subcommands.

mod carry_out;
mod print;
#[cfg(feature = "mpi")]
mod ranks;
pub(crate) mod report;
mod sensitivity;
mod status;
mod template;
mod throughput;
pub(crate) mod tolerances;

use crate::arguments::Format;
use cdpr_study::{Blocks, Existing, Shard, Study, StudyError, TableFormat};
use clap::{Args, Subcommand, ValueEnum};
use std::path::PathBuf;

#[derive(Subcommand)]
pub(crate) enum Command {
    /// Print a study of one's own robot to begin with, or write it to a file.
    #[command(after_help = "Example: cdpr study new --robot data/robots/cogiro.json --out my-study.json")]
    New(template::Settings),
    /// Run a study file and write observations, figures and a summary; what is done is kept block by block.
    #[command(after_help = "Example: cdpr study run data/studies/caroca.json --out results\n\n\
                      Interrupted or killed, it goes on with --resume and gives the same results to the last bit.\n\
                      On several machines with a shared folder: --shard 1/4 ... --shard 4/4, then `cdpr study merge`; or, built with the\n\
                      feature `mpi`: mpirun -n 4 cdpr study run ....")]
    Run(RunSettings),
    /// Analyse a study whose blocks are all in a folder: those of all shards, say.
    #[command(after_help = "Example: cdpr study merge results")]
    Merge(FolderSettings),
    /// Say how far a study in a folder is, and what its observations say so far.
    #[command(after_help = "Example: cdpr study status results --format json")]
    Status(status::Settings),
    /// Go on with a study in a folder to more observations of each sampling, keeping those it has.
    #[command(after_help = "Example: cdpr study extend results --observations 1000000")]
    Extend {
        #[command(flatten)]
        folder: FolderSettings,
        /// Observations of each sampling, those it has included.
        #[arg(long)]
        observations: usize,
    },
    /// Run one sampling of a study without writing anything; print how long it took, its memory and its results as JSON.
    #[command(
        after_help = "Example: cdpr study throughput data/studies/caroca.json --sampling mechanical --observations 1000000"
    )]
    Throughput {
        /// Study file (JSON, `cdpr-study/1`).
        study: PathBuf,
        /// Name of the sampling.
        #[arg(long)]
        sampling: String,
        /// Observations, in place of the file's.
        #[arg(long, default_value_t = 1_000_000)]
        observations: usize,
        /// Threads; all cores if left out. The numbers do not depend on it.
        #[arg(long, value_parser = clap::value_parser!(u16).range(1..))]
        threads: Option<u16>,
    },
}

#[derive(Args)]
pub(crate) struct RunSettings {
    /// Study file (JSON, `cdpr-study/1`).
    study: PathBuf,
    /// Folder for the results; made if missing.
    #[arg(long, default_value = "results")]
    out: PathBuf,
    /// Observations of each sampling, in place of the file's.
    #[arg(long)]
    observations: Option<usize>,
    /// Go on with what the folder holds of this study.
    #[arg(long, conflicts_with = "overwrite")]
    resume: bool,
    /// Begin anew: remove blocks, tables and figures of the study that the folder holds, whatever study that is.
    #[arg(long)]
    overwrite: bool,
    /// Make one of n shares of the blocks only, into a folder shared with the other shards; `auto/n` takes i from the task of a job array of
    /// Slurm or HyperQueue, numbered from 1 to n. Goes on with what is there; analyses nothing.
    #[arg(long, value_name = "i/n", conflicts_with = "overwrite")]
    shard: Option<String>,
    #[command(flatten)]
    common: Common,
}

#[derive(Args)]
pub(crate) struct FolderSettings {
    /// Folder of the results.
    folder: PathBuf,
    #[command(flatten)]
    common: Common,
}

#[derive(Args)]
struct Common {
    /// Threads; all cores if left out. The numbers do not depend on it.
    #[arg(long, value_parser = clap::value_parser!(u16).range(1..))]
    threads: Option<u16>,
    /// What the observations are written as; 0.9 kB each as CSV, less as Parquet (if built with that feature). If left out, as CSV, but
    /// not those of samplings at several poses. The blocks keep them in any case.
    #[arg(long, value_enum)]
    table: Option<TableName>,
    /// How the results of the whole are printed; as JSON they are one line, that of `summary.json`.
    #[arg(long, value_enum, default_value_t = Format::Text)]
    format: Format,
}

#[derive(Clone, Copy, ValueEnum)]
enum TableName {
    Csv,
    #[cfg(feature = "parquet")]
    Parquet,
    None,
}

impl From<TableName> for TableFormat {
    fn from(name: TableName) -> Self {
        match name {
            TableName::Csv => Self::Csv,
            #[cfg(feature = "parquet")]
            TableName::Parquet => Self::Parquet,
            TableName::None => Self::None,
        }
    }
}

#[derive(Debug, thiserror::Error)]
pub(crate) enum RunError {
    #[error(transparent)]
    Study(#[from] StudyError),
    #[error(transparent)]
    Report(#[from] report::WriteError),
    #[error("cannot start {threads} threads: {source}")]
    Threads { threads: u16, source: rayon::ThreadPoolBuildError },
    #[cfg(not(feature = "mpi"))]
    #[error(
        "{processes} processes run this study together: expected one, several with --shard, or a program built with the feature `mpi` \
         (cargo install --path crates/cdpr-cli --features mpi)"
    )]
    WithoutMpi { processes: usize },
    #[cfg(feature = "mpi")]
    #[error(
        "the launcher has started {expected} processes and MPI knows of {found}: expected a launcher of the MPI that the program was built with"
    )]
    Ranks { expected: usize, found: usize },
    #[error("cannot wait for Ctrl-C: {0}")]
    Signals(#[from] ctrlc::Error),
    #[error("cannot write JSON: {0}")]
    Json(#[from] serde_json::Error),
}

pub(crate) fn run(command: Command) -> Result<(), RunError> {
    match command {
        Command::New(settings) => template::run(&settings),
        Command::Run(settings) => match processes(|name| std::env::var(name).ok()) {
            // Shards are told apart by their numbers, however they are launched.
            Some(processes) if settings.shard.is_none() => together(&settings, processes),
            _ => alone(&settings),
        },
        Command::Merge(FolderSettings { folder, common }) => {
            start_threads(common.threads)?;
            let (study, blocks) = cdpr_study::open_results(&folder)?;
            cdpr_study::check_complete(&folder, &study, &blocks)?;
            carry_out::whole(&study, &folder, &blocks, &common, |_| Ok(()))
        }
        Command::Status(settings) => status::run(&settings),
        Command::Extend { folder: FolderSettings { folder, common }, observations } => {
            start_threads(common.threads)?;
            let (mut study, _) = cdpr_study::open_results(&folder)?;
            study.extend(observations)?;
            let blocks = cdpr_study::begin(&folder, &study, Existing::GoOn)?;
            carry_out::whole(&study, &folder, &blocks, &common, |_| Ok(()))
        }
        Command::Throughput { study, sampling, observations, threads } => {
            throughput::run(&study, &sampling, observations, threads)
        }
    }
}

/// A run in this process alone.
fn alone(settings: &RunSettings) -> Result<(), RunError> {
    let (study, blocks) = begun(settings)?;
    match settings.shard()? {
        Some(shard) => carry_out::shard(&study, &settings.out, &blocks, shard, settings.common.format),
        None => carry_out::whole(&study, &settings.out, &blocks, &settings.common, |_| Ok(())),
    }
}

/// A run in so many processes that `mpirun` or `srun` has started.
#[cfg(feature = "mpi")]
fn together(settings: &RunSettings, processes: usize) -> Result<(), RunError> {
    ranks::share_out(settings, processes)
}

#[cfg(not(feature = "mpi"))]
fn together(_: &RunSettings, processes: usize) -> Result<(), RunError> {
    Err(RunError::WithoutMpi { processes })
}

/// How many processes were started together with this one, by what Open MPI, other MPIs and Slurm tell each of them; none for one alone.
fn processes(variable: impl Fn(&str) -> Option<String>) -> Option<usize> {
    let told = ["OMPI_COMM_WORLD_SIZE", "PMI_SIZE", "SLURM_STEP_NUM_TASKS"].into_iter().find_map(variable);
    told.and_then(|count| count.parse().ok()).filter(|count| *count > 1)
}

/// The study to run and the folder for its results.
fn begun(settings: &RunSettings) -> Result<(Study, Blocks), RunError> {
    start_threads(settings.common.threads)?;
    let mut study = Study::open(&settings.study)?;
    if let Some(observations) = settings.observations {
        study.set_observations(observations)?;
    }
    let existing = match (settings.resume | settings.shard()?.is_some(), settings.overwrite) {
        (true, _) => Existing::GoOn,
        (false, true) => Existing::Overwrite,
        (false, false) => Existing::Refuse,
    };
    let blocks = cdpr_study::begin(&settings.out, &study, existing)?;
    Ok((study, blocks))
}

impl RunSettings {
    fn shard(&self) -> Result<Option<Shard>, StudyError> {
        self.shard.as_ref().map(|text| Shard::parse(text, |name| std::env::var(name).ok())).transpose()
    }
}

/// Starts the threads that were asked for; all cores by default.
pub(crate) fn start_threads(threads: Option<u16>) -> Result<(), RunError> {
    let Some(threads) = threads else { return Ok(()) };
    let pool = rayon::ThreadPoolBuilder::new().num_threads(threads.into()).build_global();
    pool.map_err(|source| RunError::Threads { threads, source })
}

#[cfg(test)]
mod tests {
    use super::processes;

    #[test]
    fn a_process_knows_whether_others_were_started_with_it() {
        let told = |variable: &'static str, value: &'static str| {
            processes(|name| (name == variable).then(|| value.to_owned()))
        };
        assert_eq!(told("OMPI_COMM_WORLD_SIZE", "4"), Some(4));
        assert_eq!(told("PMI_SIZE", "2"), Some(2));
        assert_eq!(told("SLURM_STEP_NUM_TASKS", "3"), Some(3));
        // One task of a job array, and no launcher at all.
        assert_eq!(told("SLURM_STEP_NUM_TASKS", "1"), None);
        assert_eq!(told("SLURM_NTASKS", "8"), None);
    }
}
