//! `cdpr analyse`: what a table of inputs and outputs says.

use crate::arguments::{self, Format, Overwrite, Threads};
use crate::error::ProgramError;
use crate::output::{Ending, patiently, table};
use cdpr_report::analysis_report;
use cdpr_study::{
    Analyser, Analysis, Dependence, Estimate, InputAnalysis, OutputLimit, TableAnalysis, TableRequest,
    VectorAnalysis, analyse_table, begin_analysis, open_table, write_analysis,
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
    /// Rows of the dependences (HSIC), whose time grows with the square; of more rows so many are drawn.
    #[arg(long, value_name = "N", default_value_t = 2000)]
    dependence_rows: usize,
    /// Seed of all that is random.
    #[arg(long, default_value_t = 2017)]
    seed: u64,
    /// Folder for `report.html`, with scatter plots and a cobweb, and `analysis.json`; made if missing.
    #[arg(long, value_name = "DIR")]
    out: Option<PathBuf>,
    #[command(flatten)]
    overwrite: Overwrite,
    #[command(flatten)]
    threads: Threads,
    /// How the results are printed.
    #[arg(long, value_enum, default_value_t = Format::Text)]
    format: Format,
    /// The same as `--format json`.
    #[arg(long, conflicts_with = "format")]
    json: bool,
}

/// Inputs in a table on the terminal.
const MOST: usize = 20;
/// Probability of one or more false findings among the inputs of a table.
const FALSE: f64 = 0.05;

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
        print(found);
        if let Some(folder) = &settings.out {
            println!("report in {}", folder.join("report.html").display());
        }
    })?;
    Ok(Ending::Well)
}

fn print(found: &TableAnalysis) {
    let counted = |count: usize, word: &str| format!("{count} {word}{}", if count == 1 { "" } else { "s" });
    println!(
        "{}: {}, {}, {}",
        found.table,
        counted(found.rows, "row"),
        counted(found.inputs.len(), "input"),
        counted(found.outputs.len(), "output")
    );
    if found.left_out > 0 {
        println!("{} rows are left out: an input has no number", found.left_out);
    }
    for bad in &found.first_bad_cells {
        let text = if bad.text.trim().is_empty() { "empty" } else { &bad.text };
        println!("no number: row {}, column {}: {text}", bad.row, bad.column);
    }
    let more = found.bad_cells - found.first_bad_cells.len();
    if more > 0 {
        println!("no number: {more} more cells");
    }
    for (name, analysis) in &found.outputs {
        println!();
        print_summary(name, analysis);
        print_inputs(analysis);
        print_limit(analysis);
        for note in &analysis.notes {
            println!("note: {note}");
        }
    }
    if let Some(vector) = &found.vector {
        print_vector(vector);
    }
}

/// Inputs by their index, the greatest first.
fn print_vector(vector: &VectorAnalysis) {
    println!("\n({}): how much an input moves the law of this vector", vector.columns.join(", "));
    let mut leading: Vec<_> = vector.bures.iter().collect();
    leading.sort_by(|one, other| other.1.index.value.total_cmp(&one.1.index.value));
    let mut rows = table(&["input", "Wasserstein-Bures", "of which by the means"]);
    let cell = |of: &Estimate| format!("{:.3} \u{b1} {:.3}", of.value, 0.5 * of.width());
    for (input, of) in leading.into_iter().take(MOST) {
        rows.add_row([input.clone(), cell(&of.index), cell(&of.means)]);
    }
    println!("{rows}");
}

fn print_summary(name: &str, analysis: &Analysis) {
    let of = &analysis.summary;
    let [low, median, high] = analysis.quantiles.map(number);
    println!(
        "{name}: {} values, {} failed; mean {}, deviation {}; 5 % {low}, median {median}, 95 % {high}; {} to {}",
        of.count,
        of.failed,
        number(of.mean),
        number(of.std),
        number(of.min),
        number(of.max)
    );
    if let Some(fit) = analysis.best_fit {
        println!("law: {fit}");
    }
    let percent = |share: f64| format!("{:.1} %", 100.0 * share);
    let linear = analysis.r_squared.zip(analysis.rank_r_squared);
    if let Some((values, ranks)) = linear {
        println!("R\u{b2} of a linear model: {}, of ranks {}", percent(values), percent(ranks));
    }
    if let Some(expansion) = &analysis.expansion {
        println!(
            "polynomial model: {} terms up to degree {}, error {} of the variance",
            expansion.terms.len(),
            expansion.degree,
            percent(expansion.leave_one_out)
        );
    }
}

/// Inputs by what a function says of them, the greatest first.
fn leading(analysis: &Analysis, of: impl Fn(&InputAnalysis) -> f64) -> Vec<&InputAnalysis> {
    let mut inputs: Vec<&InputAnalysis> = analysis.inputs.iter().collect();
    inputs.sort_by(|one, other| of(other).total_cmp(&of(one)));
    inputs
}

fn print_inputs(analysis: &Analysis) {
    let header = [
        "input",
        "effect",
        "t",
        "SRC",
        "SRRC",
        "S ranks [%]",
        "S, T poly. [%]",
        "HSIC R\u{b2}",
        "p",
        "PAWN",
        "\u{3b4}, at least",
    ];
    let mut rows = table(&header);
    let leading = leading(analysis, |input| input.dependence.map_or(0.0, |dependence| dependence.r_squared));
    let two = |value: Option<f64>| value.map_or_else(String::new, |value| format!("{value:.2}"));
    let percent = |share: f64| format!("{:.1}", 100.0 * share);
    for input in leading.iter().take(MOST) {
        let first = input
            .first
            .map(|first| format!("{} \u{b1} {}", percent(first.value), percent(0.5 * first.width())));
        let shares = input.shares.map(|of| format!("{}, {}", percent(of.closed), percent(of.total)));
        let over = |value: f64, noise: f64| {
            if value > noise { format!("{value:.3}") } else { format!("({value:.3})") }
        };
        rows.add_row([
            input.input.clone(),
            number(input.half.effect),
            format!("{:.1}", input.half.student),
            two(input.standardised),
            two(input.rank_standardised),
            first.unwrap_or_default(),
            shares.unwrap_or_default(),
            input.dependence.map_or_else(String::new, |dependence| format!("{:.3}", dependence.r_squared)),
            p_value(input.dependence),
            input.pawn.map_or_else(String::new, |pawn| over(pawn.median, pawn.noise)),
            input.delta.map_or_else(String::new, |delta| {
                format!("{}, {:.3}", over(delta.delta, delta.noise), delta.at_least)
            }),
        ]);
    }
    println!("{rows}");
    if leading.len() > MOST {
        println!("{} more inputs stand in --json and --out", leading.len() - MOST);
    }
    println!("in brackets: as large without an effect in one table of twenty");
    let level = FALSE / analysis.inputs.len() as f64;
    let certain = leading.iter().filter(|input| input.dependence.is_some_and(|of| of.p_value < level));
    let names: Vec<&str> = certain.map(|input| input.input.as_str()).collect();
    let names = if names.is_empty() { "none".to_owned() } else { names.join(", ") };
    println!("certain to matter (p < {FALSE} / {}): {names}", analysis.inputs.len());
}

fn print_limit(analysis: &Analysis) {
    let Some(failures) = analysis.limit else { return };
    let (sign, value) = match failures.limit {
        OutputLimit::Below(value) => ("<", value),
        OutputLimit::AtMost(value) => ("<=", value),
        OutputLimit::Above(value) => (">", value),
        OutputLimit::AtLeast(value) => (">=", value),
    };
    println!(
        "limit {sign} {value}: {} of {} values fail, {:.2} % ({:.2} % to {:.2} %)",
        failures.count,
        analysis.summary.count,
        100.0 * failures.share.value,
        100.0 * failures.share.low,
        100.0 * failures.share.high
    );
    let strength = |input: &InputAnalysis| input.limit.map_or(0.0, |at| at.target.r_squared);
    let mut rows =
        table(&["input", "target R\u{b2}", "p", "conditional R\u{b2}", "p", "place of the failures"]);
    let mut any = false;
    for input in leading(analysis, strength).into_iter().take(MOST) {
        let Some(at) = input.limit else { continue };
        any = true;
        let conditional = at.conditional.map(|dependence| format!("{:.3}", dependence.r_squared));
        rows.add_row([
            input.input.clone(),
            format!("{:.3}", at.target.r_squared),
            p_value(Some(at.target)),
            conditional.unwrap_or_default(),
            p_value(at.conditional),
            format!("{:.2}", at.place),
        ]);
    }
    if any {
        println!("{rows}");
        println!(
            "target: what makes the limit fail; conditional: what moves the values that fail; place: share of \
             all values below the median of those that fail"
        );
    }
}

fn p_value(dependence: Option<Dependence>) -> String {
    match dependence {
        None => String::new(),
        Some(Dependence { p_value, .. }) if p_value < 1e-4 => "< 1e-4".to_owned(),
        Some(Dependence { p_value, .. }) => format!("{p_value:.4}"),
    }
}

/// Four significant digits.
fn number(value: f64) -> String {
    let decimals = 3 - value.abs().max(1e-300).log10().floor() as i32;
    match usize::try_from(decimals) {
        Ok(decimals) if decimals <= 8 && value != 0.0 => format!("{value:.decimals$}"),
        Err(_) => format!("{value:.0}"),
        Ok(_) if value == 0.0 => "0".to_owned(),
        Ok(_) => format!("{value:.3e}"),
    }
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

    #[test]
    fn numbers_have_four_digits() {
        let cases = [(0.0, "0"), (1.33125, "1.331"), (-12345.6, "-12346"), (1.2e-9, "1.200e-9")];
        for (value, text) in cases {
            assert_eq!(number(value), text);
        }
    }
}
