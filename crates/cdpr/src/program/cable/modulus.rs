//! `cdpr cable modulus`: the moduli of a cable from a load-elongation record.

use crate::program::arguments::endings;
use crate::program::arguments::{FigureArgument, Named, Printing, figure, named, number};
use crate::program::error::ProgramError;
use crate::program::output::{patiently, print_sentence, table};
use crate::program::questions;
use cdpr_cable::{Phase, Record, SecantModulus, Specimen};
use cdpr_report::{Cycle, CycleBranch, Sheet, cycle};
use cdpr_robot::{Doubt, plausible, visible};
use cdpr_study::{CableLaw, law_json, open_record};
use serde::Serialize;
use std::path::{Path, PathBuf};

/// The record and its specimen.
#[derive(clap::Args)]
pub(crate) struct Settings {
    /// Record of a whole loop: a table with the columns force_n, elongation_mm, phase (loading and
    /// unloading); - for the standard input.
    record: PathBuf,
    /// Breaking force [N]; ranges of load are percentages of it.
    #[arg(long, value_parser = number, allow_hyphen_values = true)]
    breaking_force: f64,
    /// Section of the specimen [m²].
    #[arg(long, value_parser = number, allow_hyphen_values = true)]
    section: f64,
    /// Length of the specimen between its clamps [m].
    #[arg(long, value_parser = number, allow_hyphen_values = true)]
    length: f64,
    /// Range of load in percent of the breaking force, such as 10-30; may be given several times.
    #[arg(long = "range", value_parser = range, required = true)]
    ranges: Vec<(f64, f64)>,
    /// Errors in SI units: of each force [N] and elongation [m], of length [m] and section [m²].
    ///
    /// Independent errors give a modulus one standard deviation where these are standard deviations.
    /// `greatest` is where all of them add up.
    #[arg(long, value_parser = named, default_value = "force=1,elongation=3e-5,length=0,section=0")]
    errors: Named,
    /// File for a figure of the loop (.svg, .pdf, .png); behind its name: width=MM, untitled.
    #[arg(long, value_name = "FILE", value_parser = figure)]
    figure: Option<FigureArgument>,
    /// File for the record's law (JSON, `cdpr-law/1`), which `cdpr hysteresis --law` and an operating point
    /// of a study take.
    #[arg(long, value_name = "FILE", value_parser = endings::json())]
    law: Option<PathBuf>,
    #[command(flatten)]
    printing: Printing,
}

/// A range `p-q` or `p:q` [%].
fn range(text: &str) -> Result<(f64, f64), String> {
    let ends = text.split_once(['-', ':']).ok_or_else(|| format!("`{text}`: expected p-q, such as 10-30"))?;
    Ok((number(ends.0)?, number(ends.1)?))
}

#[derive(Serialize)]
struct Found {
    ranges: Vec<InRange>,
    dissipated_energy_j: f64,
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

pub(super) fn run(settings: &Settings) -> Result<(), ProgramError> {
    let record = patiently("reading the record", || open_record(&settings.record))?;
    let greatest = [Phase::Loading, Phase::Unloading].map(|phase| record.forces(phase)[1]);
    let greatest = greatest[0].max(greatest[1]);
    questions::ask((greatest > settings.breaking_force).then(|| Doubt {
        quantity: "--breaking-force".to_owned(),
        value: format!("{} N", visible(settings.breaking_force, 3)),
        why: format!("less than the greatest force of the record, {} N", visible(greatest, 3)),
        meant: "a breaking force in N".to_owned(),
    }));
    let names = ["force", "elongation", "length", "section"];
    let [force, elongation, length, section] = settings.errors.all("--errors", names)?;
    let specimen = Specimen {
        breaking_force: settings.breaking_force,
        section: settings.section,
        length: settings.length,
        force_error: force.unwrap_or(1.0),
        elongation_error: elongation.unwrap_or(3e-5),
        length_error: length.unwrap_or_default(),
        section_error: section.unwrap_or_default(),
    };
    let ranges = settings.ranges.iter().map(|&(from_percent, to_percent)| {
        let of = |phase| record.modulus(&specimen, phase, from_percent, to_percent).map(Modulus::from);
        Ok(InRange {
            from_percent,
            to_percent,
            loading: of(Phase::Loading)?,
            unloading: of(Phase::Unloading)?,
        })
    });
    let found = Found {
        ranges: ranges.collect::<Result<_, cdpr_cable::RecordError>>()?,
        dissipated_energy_j: record.dissipated_energy(),
    };
    questions::ask((found.dissipated_energy_j < 0.0).then(|| Doubt {
        quantity: "the energy that the loop dissipates".to_owned(),
        value: format!("{:.4} J", found.dissipated_energy_j),
        why: "less than zero: a cable gives no energy".to_owned(),
        meant: "a record whose phases are not exchanged, with elongations from one zero".to_owned(),
    }));
    let asked =
        |range: &InRange| plausible::modulus("modulus of the record", 1e9 * range.loading.modulus_gpa);
    questions::ask(found.ranges.iter().find_map(asked));
    settings.printing.format().print(&found, |found| print(found, &specimen))?;
    if let Some(path) = &settings.law {
        write_law(&record, &specimen, settings, path)?;
    }
    let write = |file: &FigureArgument| {
        file.write(&settings.printing.overwrite, |sheet| draw(&record, &found, sheet))
    };
    settings.figure.as_ref().map_or(Ok(()), write)
}

fn print(found: &Found, specimen: &Specimen) {
    for InRange { from_percent, to_percent, loading, .. } in found.ranges.iter().take(1) {
        let [modulus, error] = [loading.modulus_gpa, loading.standard_uncertainty_gpa];
        // Without the rounding of the factor, 0.030000000000000002 mm.
        let elongation = (1e12 * specimen.elongation_error).round() / 1e9;
        let force = specimen.force_error;
        print_sentence(&format!(
            "{modulus:.2} GPa +- {error:.2} GPa while loading from {from_percent} to {to_percent} %."
        ));
        print_sentence(&format!(
            "Errors of {force} N and {elongation} mm are taken as independent; they add up at most to \
             +- {:.2} GPa.",
            loading.greatest_uncertainty_gpa
        ));
    }
    let mut rows = table(&["range [%]", "phase", "modulus [GPa]", "+-, independent", "+-, greatest"]);
    for range in &found.ranges {
        let name = format!("{} to {}", range.from_percent, range.to_percent);
        for (phase, of) in [("loading", &range.loading), ("unloading", &range.unloading)] {
            let cells = [of.modulus_gpa, of.standard_uncertainty_gpa, of.greatest_uncertainty_gpa]
                .map(|value| format!("{value:.2}"));
            rows.add_row([name.clone(), phase.to_owned()].into_iter().chain(cells));
        }
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
    settings.printing.overwrite.write(path, &(law_json(Some(source), law)? + "\n"))
}

fn draw(record: &Record, found: &Found, sheet: Sheet) -> Result<String, ProgramError> {
    let branches = [Phase::Loading, Phase::Unloading].map(|phase| {
        let points = record.samples(phase).iter().map(|sample| (1e3 * sample.elongation, sample.force));
        CycleBranch { name: phase.name().to_owned(), points: points.collect() }
    });
    let drawn = Cycle {
        title: "Load over elongation",
        lines: &[format!("the loop dissipates {:.4} J", found.dissipated_energy_j)],
        x: "elongation [mm]",
        y: "force [N]",
        branches: &branches,
    };
    Ok(cycle(&drawn, sheet)?)
}
