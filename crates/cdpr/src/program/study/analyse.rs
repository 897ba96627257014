//! `cdpr analyse`: what a table of inputs and outputs says.

use crate::program::arguments::{self, Format, Overwrite, Threads, With, count, number, with};
use crate::program::error::ProgramError;
use crate::program::output::{Details, Ending, patiently};
use crate::program::study::print::analysis;
use cdpr_report::analysis_report;
use cdpr_study::{
    Analyser, Analysis, OutputLimit, TableRequest, analyse_table, begin_analysis, open_table, write_analysis,
};
use std::path::PathBuf;

/// The table, its columns and the limits.
#[derive(clap::Args)]
pub(crate) struct Settings {
    /// CSV and its relatives, Parquet, a folder of results or one of the tables in it, or - for the standard
    /// input.
    table: PathBuf,
    /// Columns of inputs, `NAME*` for all that begin so [default: `d_*` of a study, else all but the output].
    #[arg(long = "input", value_name = "COLUMN", value_delimiter = ',')]
    inputs: Vec<String>,
    /// Columns of outputs [default: those with a limit, else the last column of numbers].
    #[arg(long = "output", value_name = "COLUMN", value_delimiter = ',')]
    outputs: Vec<String>,
    /// Columns that are the components of one vector, in a common unit: how much each input moves its law
    /// (index of Wasserstein and Bures).
    #[arg(long, value_name = "COLUMN", value_delimiter = ',')]
    vector: Vec<String>,
    /// What an output is to satisfy, such as `magnitude_mm<1.4`: `<`, `<=`, `>` or `>=`. The analysis then
    /// says which inputs make it fail.
    #[arg(long = "limit", value_name = "COLUMN<VALUE", value_parser = arguments::limit)]
    limits: Vec<(String, OutputLimit)>,
    /// Settings: confidence=SHARE of the intervals (0.95); hsic-rows=N, the rows that HSIC takes at most
    /// (2000), whose square its time grows with.
    #[arg(long, value_name = "NAMES", value_parser = with)]
    with: Option<With>,
    /// Seed of all that is random.
    #[arg(long, default_value_t = 2017, value_parser = arguments::seed, allow_negative_numbers = true)]
    seed: u64,
    /// Folder for `report.html`, with scatter plots and a cobweb, and `analysis.json`; made if missing.
    #[arg(short, long, value_name = "FOLDER")]
    out: Option<PathBuf>,
    #[command(flatten)]
    overwrite: Overwrite,
    #[command(flatten)]
    threads: Threads,
    #[command(flatten)]
    details: Details,
    /// How the results are printed.
    #[arg(long, value_enum, default_value_t = Format::Text)]
    format: Format,
}

pub(crate) fn run(settings: &Settings) -> Result<Ending, ProgramError> {
    settings.threads.start()?;
    let with = With::known(settings.with.as_ref(), &["confidence", "hsic-rows"])?;
    let rows = count::<{ Analyser::LEAST_DEPENDENCE_ROWS }, { Analyser::MOST_DEPENDENCE_ROWS }>;
    let mut analyser = Analyser::new(settings.seed);
    analyser.level = with.value("confidence", None, number)?.unwrap_or(analyser.level);
    analyser.dependence_rows = with.value("hsic-rows", None, rows)?.unwrap_or(analyser.dependence_rows);
    let request = TableRequest {
        inputs: settings.inputs.clone(),
        outputs: settings.outputs.clone(),
        limits: settings.limits.clone(),
        vector: settings.vector.clone(),
        analyser,
    };
    let found = patiently("analysing the table", || -> Result<_, ProgramError> {
        let folder = settings.out.as_ref().map(|out| begin_analysis(out, settings.overwrite.if_exists()));
        let folder = folder.transpose()?;
        let table = open_table(&settings.table, None)?;
        let found = analyse_table(&table, &request)?;
        if let Some(folder) = folder {
            write_analysis(&folder, &found, &analysis_report(&table, &found))?;
        }
        Ok(found)
    })?;
    settings.format.print(&found, |found| {
        analysis::print(found);
        if settings.details.details {
            analysis::print_details(found);
        }
        if let Some(folder) = &settings.out {
            println!("report in {}", folder.join("report.html").display());
        }
    })?;
    let failed = |(_, of): &(&String, &Analysis)| of.summary.failed > of.summary.count;
    let mut few = found.outputs.iter().filter(failed).peekable();
    let is_odd = few.peek().is_some() || found.has_questions();
    for (name, of) in few {
        let (failed, all) = (of.summary.failed, of.summary.failed + of.summary.count);
        eprintln!("warning: {name}: more than half of the observations failed, {failed} of {all}");
    }
    Ok(if is_odd { Ending::SomethingWrong } else { Ending::Well })
}
