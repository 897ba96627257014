//! `cdpr modulus`: the moduli of a cable from a load-elongation record.

mod published;

use crate::arguments::{Format, Overwrite, number};
use crate::endings;
use crate::error::ProgramError;
use crate::output::{patiently, table};
use crate::questions;
use cdpr_cable::{Phase, Record, SecantModulus, Specimen};
use cdpr_report::{Cycle, CycleBranch, cycle};
use cdpr_robot::plausible;
use cdpr_study::{CableLaw, law_json, open_record};
use published::{Entry, Published, percent};
use serde::Serialize;
use std::path::{Path, PathBuf};

/// The record and its specimen.
#[derive(clap::Args)]
pub(crate) struct Settings {
    /// Record (CSV with the columns force_n, elongation_mm, phase: loading or unloading).
    record: PathBuf,
    /// Breaking force [N]; ranges of load are percentages of it.
    #[arg(long, value_parser = number, allow_hyphen_values = true, required_unless_present = "published")]
    breaking_force: Option<f64>,
    /// Section of the specimen [m²].
    #[arg(long, value_parser = number, allow_hyphen_values = true, required_unless_present = "published")]
    section: Option<f64>,
    /// Length of the specimen between its clamps [m].
    #[arg(long, value_parser = number, allow_hyphen_values = true)]
    length: f64,
    /// Range of load in percent of the breaking force, such as 10-30; may be given several times.
    #[arg(long = "range", value_parser = range, required_unless_present = "published")]
    ranges: Vec<(f64, f64)>,
    /// Published table to compare with (JSON as data/cables/caroca-4mm.json).
    ///
    /// Breaking force, section and ranges are those of the table.
    #[arg(long, conflicts_with_all = ["breaking_force", "section", "ranges"])]
    published: Option<PathBuf>,
    /// Error of each force [N].
    #[arg(long, value_parser = number, allow_hyphen_values = true, default_value_t = 1.0)]
    force_error: f64,
    /// Error of each elongation [mm].
    #[arg(long, value_parser = number, allow_hyphen_values = true, default_value_t = 0.03)]
    elongation_error: f64,
    /// Error of the length [m].
    #[arg(long, value_parser = number, allow_hyphen_values = true, default_value_t = 0.0)]
    length_error: f64,
    /// Error of the section [m²].
    #[arg(long, value_parser = number, allow_hyphen_values = true, default_value_t = 0.0)]
    section_error: f64,
    /// File for a figure of the loop (SVG).
    #[arg(long, value_parser = endings::svg)]
    figure: Option<PathBuf>,
    /// File for the record's law (JSON, `cdpr-law/1`).
    ///
    /// `cdpr hysteresis --law` and an operating point of a study take such a law.
    #[arg(long, value_parser = endings::json())]
    law: Option<PathBuf>,
    #[command(flatten)]
    overwrite: Overwrite,
    /// How the results are printed.
    #[arg(long, value_enum, default_value_t = Format::Text)]
    format: Format,
}

/// A range `p-q` [%].
fn range(text: &str) -> Result<(f64, f64), String> {
    let ends = text.split_once('-').ok_or_else(|| format!("`{text}`: expected p-q, such as 10-30"))?;
    Ok((number(ends.0)?, number(ends.1)?))
}

#[derive(Serialize)]
struct Found {
    ranges: Vec<InRange>,
    dissipated_energy_j: f64,
    #[serde(skip_serializing_if = "Option::is_none")]
    published: Option<Vec<Entry>>,
}

#[derive(Serialize)]
struct InRange {
    from_percent: f64,
    to_percent: f64,
    loading: Modulus,
    unloading: Modulus,
}

/// A modulus with its uncertainties, as in `cdpr_cable::SecantModulus`.
#[derive(Serialize)]
struct Modulus {
    modulus_gpa: f64,
    standard_uncertainty_gpa: f64,
    greatest_uncertainty_gpa: f64,
}

impl From<SecantModulus> for Modulus {
    fn from(found: SecantModulus) -> Self {
        Self {
            modulus_gpa: found.modulus / 1e9,
            standard_uncertainty_gpa: found.standard / 1e9,
            greatest_uncertainty_gpa: found.greatest / 1e9,
        }
    }
}

pub(crate) fn run(settings: &Settings) -> Result<(), ProgramError> {
    let record = patiently("reading the record", || open_record(&settings.record))?;
    let published = settings.published.as_deref().map(Published::open).transpose()?;
    let (breaking_force, section, ranges) = match (&published, settings.breaking_force, settings.section) {
        (Some(table), ..) => (table.breaking_force, table.section, &table.ranges),
        (None, Some(breaking_force), Some(section)) => (breaking_force, section, &settings.ranges),
        _ => {
            let expected = "expected --breaking-force, --section and --range, or --published";
            return Err(ProgramError::Usage(expected.to_owned()));
        }
    };
    let specimen = Specimen {
        breaking_force,
        section,
        length: settings.length,
        force_error: settings.force_error,
        elongation_error: 1e-3 * settings.elongation_error,
        length_error: settings.length_error,
        section_error: settings.section_error,
    };
    let ranges = ranges.iter().map(|&(from_percent, to_percent)| {
        let of = |phase| record.modulus(&specimen, phase, from_percent, to_percent).map(Modulus::from);
        Ok(InRange {
            from_percent,
            to_percent,
            loading: of(Phase::Loading)?,
            unloading: of(Phase::Unloading)?,
        })
    });
    let mut found = Found {
        ranges: ranges.collect::<Result<_, cdpr_cable::RecordError>>()?,
        dissipated_energy_j: record.dissipated_energy(),
        published: None,
    };
    let moduli = found.ranges.iter().map(|range| [range.loading.modulus_gpa, range.unloading.modulus_gpa]);
    let asked =
        |range: &InRange| plausible::modulus("modulus of the record", 1e9 * range.loading.modulus_gpa);
    questions::ask(found.ranges.iter().find_map(asked));
    found.published = published.as_ref().map(|table| table.beside(moduli));
    settings.format.print(&found, |found| {
        print(found);
        if let (Some(table), Some(entries)) = (&published, &found.published) {
            published::print(table, entries);
        }
    })?;
    if let Some(path) = &settings.law {
        write_law(&record, &specimen, settings, path)?;
    }
    let write = |path| settings.overwrite.write(path, &draw(&record, &found)?);
    settings.figure.as_deref().map_or(Ok(()), write)
}

fn print(found: &Found) {
    let mut rows = table(&[
        "range [%]",
        "loading [GPa]",
        "standard",
        "greatest",
        "unloading [GPa]",
        "standard",
        "greatest",
    ]);
    for range in &found.ranges {
        let cells = |of: &Modulus| {
            [of.modulus_gpa, of.standard_uncertainty_gpa, of.greatest_uncertainty_gpa]
                .map(|value| format!("{value:.2}"))
        };
        let name = percent(range.from_percent, range.to_percent);
        rows.add_row([name].into_iter().chain(cells(&range.loading)).chain(cells(&range.unloading)));
    }
    println!("{rows}\nthe loop dissipates {:.4} J", found.dissipated_energy_j);
}

fn write_law(
    record: &Record,
    specimen: &Specimen,
    settings: &Settings,
    path: &Path,
) -> Result<(), ProgramError> {
    let law = CableLaw::of_record(record, specimen.length, specimen.section)?;
    let source =
        format!("load-elongation record {}, specimen of {} m", settings.record.display(), specimen.length);
    settings.overwrite.write(path, &(law_json(Some(source), law)? + "\n"))
}

fn draw(record: &Record, found: &Found) -> Result<String, ProgramError> {
    let branches = [Phase::Loading, Phase::Unloading].map(|phase| {
        let points = record.samples(phase).iter().map(|sample| (1e3 * sample.elongation, sample.force));
        CycleBranch { name: phase.name().to_owned(), points: points.collect() }
    });
    Ok(cycle(&Cycle {
        title: "Load over elongation",
        lines: &[format!("the loop dissipates {:.4} J", found.dissipated_energy_j)],
        x: "elongation [mm]",
        y: "force [N]",
        branches: &branches,
    })?)
}
