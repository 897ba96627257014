//! `cdpr hysteresis`: where a payload that is put on and taken off again leaves the platform.

use crate::answer::{OutOfLimits, vector};
use crate::arguments::{self, Format, FreeArguments, Overwrite, Preference, number, payload};
use crate::endings;
use crate::error::ProgramError;
use crate::output::{Ending, patiently, table};
use crate::pose::at_pose::print_fall;
use crate::poses::{self, Angles};
use crate::questions;
use cdpr_report::{Cycle, CycleBranch, cycle};
use cdpr_robot::{Pose, Robot};
use cdpr_statics::hysteresis::{CycleStep, HysteresisLaw, LoadCycle, Unloading, load_cycle};
use cdpr_statics::{Load, StaticsError, WantedPose};
use cdpr_study::{CableLaw, elastic_laws, open_law, open_record};
use serde::Serialize;
use std::path::{Path, PathBuf};

/// The robot, its cables and its load.
#[derive(clap::Args)]
pub(crate) struct Settings {
    /// Robot file (JSON, `cdpr-robot/1`).
    robot: PathBuf,
    /// Record of its cables (CSV with the columns force_n, elongation_mm, phase: loading or unloading).
    #[arg(long, requires = "length")]
    record: Option<PathBuf>,
    /// Length of the record's specimen between its clamps [m].
    #[arg(long, value_parser = number, allow_hyphen_values = true, requires = "record")]
    length: Option<f64>,
    /// Section of the record's specimen [m²]; that of the cables if left out.
    #[arg(long, value_parser = number, allow_hyphen_values = true, requires = "record")]
    section: Option<f64>,
    /// Law of its cables (JSON, `cdpr-law/1`). Without record and law: the laws in the robot file.
    #[arg(long, conflicts_with = "record")]
    law: Option<PathBuf>,
    /// Pose under the platform's own weight: x,y,z [m], or x,y,z,qw,qx,qy,qz with a quaternion.
    #[arg(long, value_parser = poses::pose, allow_hyphen_values = true)]
    pose: Pose,
    #[command(flatten)]
    angles: Angles,
    #[command(flatten)]
    free: FreeArguments,
    /// Mass put on the platform's centre of mass and taken off again [kg].
    #[arg(long, value_parser = payload, allow_hyphen_values = true)]
    payload: f64,
    #[command(flatten)]
    preference: Preference,
    /// The part of the unloading curve that a cable follows.
    #[arg(long, value_enum, default_value_t = Branch::TurningPoint)]
    unloading: Branch,
    /// Steps of the payload each way.
    #[arg(long, default_value_t = 50, value_parser = arguments::count::<1, 100_000>)]
    steps: usize,
    /// File for a figure of payload over height (SVG).
    #[arg(long, value_parser = endings::svg)]
    figure: Option<PathBuf>,
    #[command(flatten)]
    overwrite: Overwrite,
    /// How the results are printed.
    #[arg(long, value_enum, default_value_t = Format::Text)]
    format: Format,
}

/// The part of the unloading curve that a cable follows.
#[derive(Clone, Copy, Debug, PartialEq, Eq, clap::ValueEnum)]
enum Branch {
    /// The part with the same tensions.
    SameTension,
    /// The part from its start, which is moved to the turning point of the tension.
    TurningPoint,
}

#[derive(Serialize)]
struct Found {
    deflection_mm: [f64; 3],
    residual_mm: [f64; 3],
    payload_work_j: f64,
    dissipated_j: f64,
    cables: Vec<InCable>,
    /// Tensions at any step of the cycle.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    out_of_limits: Vec<OutOfLimits>,
}

/// The load cycle of a cable, with the tensions at its middle.
#[derive(Serialize)]
struct InCable {
    tension_own_weight_n: f64,
    tension_payload_n: f64,
    tension_removed_n: f64,
    /// Secant modulus between own weight and payload.
    modulus_gpa: f64,
    dissipated_j: f64,
}

pub(crate) fn run(settings: &Settings) -> Result<Ending, ProgramError> {
    let robot = settings.preference.open_robot(&settings.robot)?;
    let laws = laws(&robot, settings)?;
    let pose = settings.angles.of(&settings.pose)?;
    questions::about_pose(&robot, "--pose", &pose);
    questions::about_load(&robot, &Load::payload(settings.payload));
    let cycle = || {
        load_cycle(
            &robot,
            WantedPose::at(&pose).free(&settings.free.free),
            &laws,
            settings.payload,
            settings.steps,
        )
    };
    let cycle = match patiently("following the load", cycle) {
        Err(error @ StaticsError::BranchEnds(_)) => return print_fall(settings.format, &robot, &pose, error),
        cycle => cycle?,
    };
    let found = Found::new(&robot, &laws, &cycle);
    settings.format.print(&found, print)?;
    if found.cables.iter().any(|cable| cable.dissipated_j < 0.0) {
        eprintln!(
            "warning: the loop of a cable runs the wrong way round and gives energy: in its range of tension \
             the record's unloading curve is softer than its loading curve, as it can be far below the \
             turning point from which it was measured"
        );
    }
    if let Some(path) = &settings.figure {
        settings.overwrite.write(path, &draw(&robot, &cycle, &found)?)?;
    }
    Ok(OutOfLimits::ending(&found.out_of_limits))
}

/// The hysteresis of each cable.
fn laws(robot: &Robot, settings: &Settings) -> Result<Vec<HysteresisLaw>, ProgramError> {
    let law = match (&settings.record, &settings.length, &settings.law) {
        (Some(record), Some(length), _) => of_record(robot, record, *length, settings.section)?,
        (_, _, Some(law)) => open_law(law)?,
        _ => return elastic_laws(robot)?.ok_or(ProgramError::NoLaw),
    };
    let from = match settings.unloading {
        Branch::SameTension => Unloading::SameTension,
        Branch::TurningPoint => Unloading::TurningPoint,
    };
    let cables = robot.cables.iter().enumerate();
    let curves = cables.map(|(i, cable)| {
        let curves = law.curves(&cable.properties, from);
        curves.map_err(|source| ProgramError::OfCable { cable: i + 1, source })
    });
    curves.collect()
}

fn of_record(
    robot: &Robot,
    record: &Path,
    length: f64,
    section: Option<f64>,
) -> Result<CableLaw, ProgramError> {
    let of_cables = robot.cables[0].properties.section;
    if section.is_none() && robot.cables.iter().any(|cable| cable.properties.section != of_cables) {
        return Err(ProgramError::DifferentSections);
    }
    let law = CableLaw::of_record(&open_record(record)?, length, section.unwrap_or(of_cables));
    law.map_err(ProgramError::in_file(record))
}

impl Found {
    fn new(robot: &Robot, laws: &[HysteresisLaw], cycle: &LoadCycle) -> Self {
        let cables = cycle.tensions.iter().zip(&cycle.dissipated).enumerate();
        let cables = cables.map(|(i, (tensions, dissipated))| InCable {
            tension_own_weight_n: tensions[0],
            tension_payload_n: tensions[1],
            tension_removed_n: tensions[2],
            modulus_gpa: 1e-9
                * robot.cables[i].properties.youngs_modulus
                * laws[i].loading.secant_ratio(tensions[0], tensions[1]),
            dissipated_j: *dissipated,
        });
        let steps = cycle.loading.iter().chain(&cycle.unloading);
        let equilibria: Vec<_> = steps.map(|step| &step.solution.equilibrium).collect();
        Self {
            deflection_mm: (1e3 * cycle.deflection()).into(),
            residual_mm: (1e3 * cycle.residual()).into(),
            payload_work_j: cycle.payload_work,
            dissipated_j: cycle.dissipated.iter().sum(),
            cables: cables.collect(),
            out_of_limits: OutOfLimits::all(robot, &cycle.lengths, &equilibria),
        }
    }
}

fn print(found: &Found) {
    let mut rows =
        table(&["cable", "own weight [N]", "payload [N]", "removed [N]", "E [GPa]", "dissipated [mJ]"]);
    for (i, cable) in found.cables.iter().enumerate() {
        let [a, b, c] = [cable.tension_own_weight_n, cable.tension_payload_n, cable.tension_removed_n]
            .map(|tension| format!("{tension:.2}"));
        let (modulus, energy) =
            (format!("{:.2}", cable.modulus_gpa), format!("{:.4}", 1e3 * cable.dissipated_j));
        rows.add_row([(i + 1).to_string(), a, b, c, modulus, energy]);
    }
    println!("{rows}");
    println!("displaced by the payload  {} mm", vector(&found.deflection_mm, 4));
    println!("left when it is gone      {} mm", vector(&found.residual_mm, 5));
    println!(
        "energy: {:.4} mJ given by the payload, {:.4} mJ in the loops of the cables",
        1e3 * found.payload_work_j,
        1e3 * found.dissipated_j
    );
    OutOfLimits::print(&found.out_of_limits);
}

fn draw(robot: &Robot, ran: &LoadCycle, found: &Found) -> Result<String, ProgramError> {
    let begin = ran.loading.first().map_or(0.0, |step| step.solution.equilibrium.pose.position.z);
    let points = |way: &[CycleStep]| {
        let at = |step: &CycleStep| (1e3 * (begin - step.solution.equilibrium.pose.position.z), step.payload);
        way.iter().map(at).collect::<Vec<_>>()
    };
    let branches = [
        CycleBranch { name: "payload put on".to_owned(), points: points(&ran.loading) },
        CycleBranch { name: "payload taken off".to_owned(), points: points(&ran.unloading) },
    ];
    Ok(cycle(&Cycle {
        title: &format!("{}: payload over the way down", robot.name),
        lines: &[format!(
            "{:.5} mm stay; {:.3} mJ given by the payload",
            -found.residual_mm[2],
            1e3 * found.payload_work_j
        )],
        x: "way down [mm]",
        y: "payload [kg]",
        branches: &branches,
    })?)
}
