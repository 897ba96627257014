//! `cdpr analyse`: what a table of inputs and outputs says.

use crate::arguments::{self, Format, Overwrite, Threads};
use crate::error::ProgramError;
use crate::output::{Details, Ending, patiently};
use crate::study::print::analysis;
use cdpr_report::analysis_report;
use cdpr_study::{
    Analyser, OutputLimit, TableRequest, analyse_table, begin_analysis, open_table, write_analysis,
};
use std::path::PathBuf;

/// The table, its columns and the limits.
#[derive(clap::Args)]
pub(crate) struct Settings {
    /// CSV, Parquet or a folder of results.
    table: PathBuf,
    /// Name of the table in a folder of results that has several.
    #[arg(long = "table", value_name = "NAME")]
    name: Option<String>,
    /// Columns of inputs, `NAME*` for all that begin so [default: `d_*` of a study, else all but the output].
    #[arg(long = "input", visible_alias = "inputs", value_name = "COLUMN", value_delimiter = ',')]
    inputs: Vec<String>,
    /// Columns of outputs [default: those with a limit, else the last column of numbers].
    #[arg(long = "output", visible_alias = "outputs", value_name = "COLUMN", value_delimiter = ',')]
    outputs: Vec<String>,
    /// Columns that are the components of one vector, in a common unit: how much each input moves its law
    /// (index of Wasserstein and Bures).
    #[arg(long, value_name = "COLUMN", value_delimiter = ',')]
    vector: Vec<String>,
    /// What an output is to satisfy, such as `rms_mm<1.4`: `<`, `<=`, `>` or `>=`. The analysis then says
    /// which inputs make it fail.
    #[arg(long = "limit", value_name = "COLUMN<VALUE", value_parser = limit)]
    limits: Vec<(String, OutputLimit)>,
    /// Confidence level of the intervals.
    #[arg(long, default_value_t = 0.95, allow_negative_numbers = true)]
    level: f64,
    /// Rows of the dependences (HSIC), up to 5000, as the time grows with the square; of more, so many are drawn.
    #[arg(long, value_name = "N", default_value_t = 2000, value_parser = arguments::count::<
        { Analyser::LEAST_DEPENDENCE_ROWS }, { Analyser::MOST_DEPENDENCE_ROWS },
    >)]
    dependence_rows: usize,
    /// Seed of all that is random.
    #[arg(long, default_value_t = 2017, value_parser = arguments::seed, allow_negative_numbers = true)]
    seed: u64,
    /// Folder for `report.html`, with scatter plots and a cobweb, and `analysis.json`; made if missing.
    #[arg(long, value_name = "DIR")]
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
    /// The same as `--format json`.
    #[arg(long, conflicts_with = "format")]
    json: bool,
}

/// A column and its limit.
fn limit(text: &str) -> Result<(String, OutputLimit), String> {
    let expected = || "expected COLUMN<VALUE, with <, <=, > or >=".to_owned();
    let at = text.find(['<', '>']).filter(|at| *at > 0).ok_or_else(expected)?;
    let (column, rest) = text.split_at(at);
    type Of = fn(f64) -> OutputLimit;
    let relations: [(&str, Of); 4] = [
        ("<=", OutputLimit::AtMost),
        (">=", OutputLimit::AtLeast),
        ("<", OutputLimit::Below),
        (">", OutputLimit::Above),
    ];
    let found = relations.into_iter().find_map(|(sign, of)| Some((rest.strip_prefix(sign)?, of)));
    let (value, of) = found.ok_or_else(expected)?;
    Ok((column.trim().to_owned(), of(arguments::number(value)?)))
}

pub(crate) fn run(settings: &Settings) -> Result<Ending, ProgramError> {
    settings.threads.start()?;
    let analyser = Analyser {
        level: settings.level,
        dependence_rows: settings.dependence_rows,
        ..Analyser::new(settings.seed)
    };
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
        let table = open_table(&settings.table, settings.name.as_deref())?;
        let found = analyse_table(&table, &request)?;
        if let Some(folder) = folder {
            write_analysis(&folder, &found, &analysis_report(&table, &found))?;
        }
        Ok(found)
    })?;
    let format = if settings.json { Format::Json } else { settings.format };
    format.print(&found, |found| {
        analysis::print(found);
        if settings.details.details {
            analysis::print_details(found);
        }
        if let Some(folder) = &settings.out {
            println!("report in {}", folder.join("report.html").display());
        }
    })?;
    Ok(if found.has_questions() { Ending::SomethingWrong } else { Ending::Well })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_limit_is_a_column_a_sign_and_a_number() {
        assert_eq!(limit("rms_mm<1.4").unwrap(), ("rms_mm".to_owned(), OutputLimit::Below(1.4)));
        assert_eq!(limit("f >= -2e3").unwrap(), ("f".to_owned(), OutputLimit::AtLeast(-2e3)));
        for text in ["", "rms", "<1", "rms<", "rms<x", "rms=1"] {
            assert!(limit(text).is_err(), "{text}");
        }
    }
}
