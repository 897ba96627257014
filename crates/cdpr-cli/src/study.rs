//! `cdpr study ...`: arguments of its subcommands.

mod carry_out;
mod print;
mod status;
mod template;

use crate::{report, throughput};
use cdpr_study::{Existing, Shard, Study, StudyError, TableFormat};
use clap::{Args, Subcommand, ValueEnum};
use comfy_table::{Table, presets};
use std::path::PathBuf;

#[derive(Subcommand)]
pub(crate) enum Command {
    /// Print a study of one's own robot to begin with, or write it to a file.
    #[command(after_help = "Example: cdpr study new --robot data/robots/cogiro.json --out my-study.json")]
    New(template::Settings),
    /// Run a study file and write observations, figures and a summary; what is done is kept block by block.
    #[command(after_help = "Example: cdpr study run data/studies/caroca.json --out results\n\n\
                      Interrupted or killed, it goes on with --resume and gives the same results to the last bit.\n\
                      On several machines with a shared folder: --shard 1/4 ... --shard 4/4, then `cdpr study merge`.")]
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
    /// Begin anew: remove the blocks that the folder holds, of whatever study they are.
    #[arg(long)]
    overwrite: bool,
    /// Make every n-th block only, beginning with the i-th, into a folder shared with the other shards; `auto` takes i and n from
    /// Slurm's job array, `auto/n` takes i from HyperQueue's or Slurm's. Goes on with what is there; analyses nothing.
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
    #[error("cannot wait for Ctrl-C: {0}")]
    Signals(#[from] ctrlc::Error),
    #[error("cannot write JSON: {0}")]
    Json(#[from] serde_json::Error),
}

pub(crate) fn run(command: Command) -> Result<(), RunError> {
    match command {
        Command::New(settings) => template::run(&settings),
        Command::Run(settings) => {
            let RunSettings { out, resume, overwrite, .. } = &settings;
            start_threads(settings.common.threads)?;
            let mut study = Study::open(&settings.study)?;
            if let Some(observations) = settings.observations {
                study.set_observations(observations)?;
            }
            let shard = settings.shard.as_ref();
            let shard = shard.map(|text| Shard::parse(text, |name| std::env::var(name).ok())).transpose()?;
            let existing = match (resume | shard.is_some(), overwrite) {
                (true, _) => Existing::GoOn,
                (false, true) => Existing::Overwrite,
                (false, false) => Existing::Refuse,
            };
            let blocks = cdpr_study::begin(out, &study, existing)?;
            match shard {
                Some(shard) => carry_out::shard(&study, out, &blocks, shard),
                None => carry_out::whole(&study, out, &blocks, settings.common.table.map(TableFormat::from)),
            }
        }
        Command::Merge(FolderSettings { folder, common }) => {
            start_threads(common.threads)?;
            let (study, blocks) = cdpr_study::open_results(&folder)?;
            cdpr_study::check_complete(&folder, &study, &blocks)?;
            carry_out::whole(&study, &folder, &blocks, common.table.map(TableFormat::from))
        }
        Command::Status(settings) => status::run(&settings),
        Command::Extend { folder: FolderSettings { folder, common }, observations } => {
            start_threads(common.threads)?;
            let (mut study, _) = cdpr_study::open_results(&folder)?;
            study.extend(observations)?;
            let blocks = cdpr_study::begin(&folder, &study, Existing::GoOn)?;
            carry_out::whole(&study, &folder, &blocks, common.table.map(TableFormat::from))
        }
        Command::Throughput { study, sampling, observations, threads } => {
            throughput::run(&study, &sampling, observations, threads)
        }
    }
}

/// Starts the threads that were asked for; all cores by default.
pub(crate) fn start_threads(threads: Option<u16>) -> Result<(), RunError> {
    let Some(threads) = threads else { return Ok(()) };
    let pool = rayon::ThreadPoolBuilder::new().num_threads(threads.into()).build_global();
    pool.map_err(|source| RunError::Threads { threads, source })
}

pub(crate) fn table(header: &[&str]) -> Table {
    let mut table = Table::new();
    table.load_style(presets::UTF8_FULL_CONDENSED).set_header(header);
    table
}
