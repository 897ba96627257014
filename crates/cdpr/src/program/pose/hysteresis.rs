//! `cdpr hysteresis`: where a payload that is put on and taken off again leaves the platform.

use crate::program::answer::{OutOfLimits, vector};
use crate::program::arguments::poses::PoseArguments;
use crate::program::arguments::{
    self, FigureArgument, FreeArguments, Preference, Printing, RobotArgument, With, figure, number, payload,
    with,
};
use crate::program::error::ProgramError;
use crate::program::output::{Ending, patiently, print_sentence, table};
use crate::program::pose::at_pose::print_fall;
use crate::program::questions;
use cdpr_report::{Cycle, CycleBranch, cycle};
use cdpr_robot::{Robot, Vector3, shown};
use cdpr_statics::hysteresis::{CycleStep, HysteresisLaw, LoadCycle, Unloading, load_cycle};
use cdpr_statics::{Load, StaticsError, WantedPose};
use cdpr_study::{CableLaw, InputKind, StudyError, elastic_laws, open_law, open_record};
use serde::Serialize;
use std::path::{Path, PathBuf};

/// The robot, its cables and its load.
#[derive(clap::Args)]
pub(crate) struct Settings {
    #[command(flatten)]
    robot: RobotArgument,
    /// Law of its cables (JSON, `cdpr-law/1`), or a record of them with --length (columns force_n,
    /// elongation_mm, phase: loading or unloading). Without it: the laws in the robot file.
    #[arg(long, value_name = "FILE")]
    law: Option<PathBuf>,
    /// Length of the record's specimen between its clamps [m].
    #[arg(long, value_parser = number, allow_hyphen_values = true, requires = "law")]
    length: Option<f64>,
    /// Section of the record's specimen [m²]; that of the cables if left out.
    #[arg(long, value_parser = number, allow_hyphen_values = true, requires = "length")]
    section: Option<f64>,
    #[command(flatten)]
    pose: PoseArguments,
    #[command(flatten)]
    free: FreeArguments,
    /// Mass put on the platform's centre of mass and taken off again [kg].
    #[arg(long, value_parser = payload, allow_hyphen_values = true)]
    payload: f64,
    #[command(flatten)]
    preference: Preference,
    /// How the cycle is followed: steps=N of the payload each way (50); same-tension, where a cable follows
    /// the part of the unloading curve with the same tensions and not the part from its start.
    #[arg(long, value_name = "NAMES", value_parser = with)]
    with: Option<With>,
    /// File for a figure of payload over height (.svg, .pdf, .png); behind its name: width=MM, untitled.
    #[arg(long, value_name = "FILE", value_parser = figure)]
    figure: Option<FigureArgument>,
    #[command(flatten)]
    printing: Printing,
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
    let with = settings.with.clone().unwrap_or_default();
    with.check(&["steps", "same-tension"])?;
    let steps = with.value("steps", None, arguments::count::<1, 100_000>)?.unwrap_or(50);
    let pose = settings.pose.needed()?;
    let robot = settings.preference.open_robot(settings.robot.path())?;
    let unloading = if with.has("same-tension")? { Unloading::SameTension } else { Unloading::TurningPoint };
    let laws = laws(&robot, settings, unloading)?;
    questions::about_pose(&robot, "--pose", &pose);
    questions::about_load(&robot, &Load::payload(settings.payload));
    let cycle = || {
        load_cycle(&robot, WantedPose::at(&pose).free(&settings.free.free), &laws, settings.payload, steps)
    };
    let cycle = match patiently("following the load", cycle) {
        Err(error @ StaticsError::BranchEnds(_)) => {
            return print_fall(settings.printing.format(), &robot, &pose, error);
        }
        cycle => cycle?,
    };
    let found = Found::new(&robot, &laws, &cycle);
    settings.printing.format().print(&found, |found| print(&robot, found))?;
    // The work of gravity on the payload on its way down, of which 1e-9 is rounding.
    let work =
        settings.payload * robot.gravity.magnitude() * 1e-3 * Vector3::from(found.deflection_mm).norm();
    if found.cables.iter().any(|cable| cable.dissipated_j < -1e-9 * work) {
        eprintln!(
            "warning: the loop of a cable runs the wrong way round and gives energy: in its range of tension \
             the record's unloading curve is softer than its loading curve, as it can be far below the \
             turning point from which it was measured"
        );
    }
    if let Some(file) = &settings.figure {
        file.write(&settings.printing.overwrite, &draw(&robot, &cycle, &found)?)?;
    }
    Ok(OutOfLimits::ending(&found.out_of_limits))
}

/// The hysteresis of each cable.
fn laws(
    robot: &Robot,
    settings: &Settings,
    unloading: Unloading,
) -> Result<Vec<HysteresisLaw>, ProgramError> {
    let law = match (&settings.law, settings.length) {
        (Some(record), Some(length)) => of_record(robot, record, length, settings.section)?,
        (Some(law), None) => open_law(law).map_err(|error| match error {
            StudyError::OtherKind { found: InputKind::Table, .. } => ProgramError::Usage(format!(
                "--law {}: a record and no law: expected --length, that of its specimen",
                law.display()
            )),
            error => error.into(),
        })?,
        (None, _) => return elastic_laws(robot)?.ok_or(ProgramError::NoLaw),
    };
    let cables = robot.cables.iter().enumerate();
    let curves = cables.map(|(i, cable)| {
        let curves = law.curves(&cable.properties, unloading);
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
    let opened = open_record(record).map_err(|error| match error {
        StudyError::OtherKind { found: InputKind::Law, .. } => ProgramError::Usage(format!(
            "--law {}: a law and no record: expected no --length",
            record.display()
        )),
        error => error.into(),
    })?;
    let law = CableLaw::of_record(&opened, length, section.unwrap_or(of_cables));
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

fn print(robot: &Robot, found: &Found) {
    let left = Vector3::from(found.residual_mm).norm();
    let displaced = Vector3::from(found.deflection_mm).norm();
    print_sentence(&format!(
        "{}: the payload displaces the platform by {displaced:.4} mm; {left:.5} mm are left when it is gone.",
        shown(&robot.name)
    ));
    let mut rows =
        table(&["cable", "unloaded [N]", "payload [N]", "removed [N]", "E [GPa]", "dissipated [mJ]"]);
    for (i, cable) in found.cables.iter().enumerate() {
        let [a, b, c] = [cable.tension_own_weight_n, cable.tension_payload_n, cable.tension_removed_n]
            .map(|tension| format!("{tension:.2}"));
        let (modulus, energy) = (format!("{:.2}", cable.modulus_gpa), millijoules(cable.dissipated_j));
        rows.add_row([(i + 1).to_string(), a, b, c, modulus, energy]);
    }
    println!("{rows}");
    println!("displaced by the payload  {} mm", vector(&found.deflection_mm, 4));
    println!("left when it is gone      {} mm", vector(&found.residual_mm, 5));
    println!(
        "energy: {} mJ given by the payload, {} mJ in the loops of the cables",
        millijoules(found.payload_work_j),
        millijoules(found.dissipated_j)
    );
    OutOfLimits::print(&found.out_of_limits);
}

/// An energy [J] in mJ, without the sign of a zero.
fn millijoules(energy: f64) -> String {
    format!("{:.4}", (1e7 * energy).round() / 1e4 + 0.0)
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
