//! The arguments that several commands of `cdpr study` share, and the start of a study.

use crate::program::arguments::{self, Format, Preference, Threads};
use crate::program::error::ProgramError;
use crate::program::output::{Details, patiently};
use crate::program::said;
use cdpr_study::{Blocks, Existing, Shard, Study, StudyError, TableFormat};
use clap::{Args, ValueEnum};
use std::cmp::Ordering;
use std::path::PathBuf;

#[derive(Args)]
pub(crate) struct RunSettings {
    /// Study file (JSON, `cdpr-study/1`).
    pub(super) study: PathBuf,
    /// Folder for the results; made if missing.
    #[arg(short, long, default_value = "results")]
    pub(super) out: PathBuf,
    /// Number of observations of each sampling, instead of the file's.
    ///
    /// Fewer than the file's shorten the measures of sensitivity in proportion, but for exact derivatives.
    #[arg(long, value_parser = arguments::count::<3, 10_000_000_000>)]
    observations: Option<usize>,
    #[command(flatten)]
    preference: Preference,
    /// Continue with the blocks of this study that the folder holds.
    ///
    /// Where it has more observations than the study, the results are of the first ones, and the others are
    /// kept.
    #[arg(long, conflicts_with = "overwrite")]
    resume: bool,
    /// Begin again: remove blocks, tables and figures of the study in the folder, whatever study that is.
    #[arg(long)]
    overwrite: bool,
    /// Make only the i-th of n shares of the blocks, into a folder shared with the other shards.
    ///
    /// `auto/n` takes i from the task of a job array of Slurm or HyperQueue, numbered from 1 to n. Blocks
    /// that are there are kept; nothing is analysed.
    #[arg(long, value_name = "i/n", conflicts_with = "overwrite")]
    pub(super) shard: Option<String>,
    #[command(flatten)]
    pub(super) common: Common,
}

#[derive(Args)]
pub(crate) struct FolderSettings {
    /// Folder of the results.
    pub(super) folder: PathBuf,
    #[command(flatten)]
    pub(super) common: Common,
}

#[derive(Args)]
pub(crate) struct Common {
    #[command(flatten)]
    pub(super) threads: Threads,
    /// Format of the tables of observations: 0.9 kB each as CSV, less as Parquet (if built with it).
    ///
    /// If left out, samplings at one pose have tables as CSV, and those at several poses have none. The
    /// blocks keep the observations in any case.
    #[arg(long, value_enum)]
    pub(super) table: Option<TableName>,
    #[command(flatten)]
    pub(super) details: Details,
    /// How the results are printed; as JSON they are one line with the content of `summary.json`.
    #[arg(long, value_enum, default_value_t = Format::Text)]
    pub(super) format: Format,
}

#[derive(Clone, Copy, ValueEnum)]
pub(crate) enum TableName {
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

/// Opens the study to run and the folder for its results.
pub(super) fn begun(settings: &RunSettings) -> Result<(Study, Blocks), ProgramError> {
    settings.common.threads.start()?;
    let study = patiently("checking the study", || {
        let mut study = settings.preference.open_study(&settings.study)?;
        if let Some(observations) = settings.observations {
            study.set_observations(observations)?;
        }
        Ok::<_, ProgramError>(study)
    })?;
    let existing = match (settings.shard()?, settings.resume, settings.overwrite) {
        (Some(_), ..) => Existing::Share,
        (None, true, _) => Existing::GoOn,
        (None, false, true) => Existing::Overwrite,
        (None, false, false) => Existing::Refuse,
    };
    let blocks = cdpr_study::begin(&settings.out, &study, existing)?;
    if settings.resume {
        say_what_is_there(settings, &study, &blocks)?;
    }
    Ok((study, blocks))
}

/// Says of each sampling how many observations the folder has, where it has others than the study.
fn say_what_is_there(settings: &RunSettings, study: &Study, blocks: &Blocks) -> Result<(), StudyError> {
    for (name, sampling) in &study.file.samplings {
        let (there, wanted) = (blocks.observed(name)?, sampling.observations);
        let then = match there.cmp(&wanted) {
            Ordering::Less if there > 0 => format!("{} more are made", wanted - there),
            Ordering::Greater => format!("the results are of the first {wanted}, the others are kept"),
            _ => continue,
        };
        let out = settings.out.display();
        said::note(format_args!("{out} has {there} observations of {name}: {then}"));
    }
    Ok(())
}

impl RunSettings {
    /// The shard that was asked for.
    pub(super) fn shard(&self) -> Result<Option<Shard>, StudyError> {
        self.shard.as_ref().map(|text| Shard::parse(text, |name| std::env::var(name).ok())).transpose()
    }
}
