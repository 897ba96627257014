//! `cdpr hysteresis`: where a payload that is put on and taken off again leaves the platform.

use crate::program::answer::{OutOfLimits, decimal, vector};
use crate::program::arguments::poses::PoseArguments;
use crate::program::arguments::{
    self, FigureArgument, FreeArguments, Preference, Printing, RobotArgument, With, figure, number, payload,
    with,
};
use crate::program::error::ProgramError;
use crate::program::output::{Ending, patiently, print_sentence, table};
use crate::program::pose::at_pose::print_fall;
use crate::program::questions;
use cdpr_report::{Cycle, CycleBranch, Sheet, cycle};
use cdpr_robot::{Robot, Vector3, decimals_of, rounded, shown, visible};
use cdpr_statics::hysteresis::{
    CycleStep, HysteresisLaw, LoadCycle, PulleyFriction, PulleyState, Unloading, load_cycle_over_pulleys,
};
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
    /// the part of the unloading curve with the same tensions and not the part from its start; friction=MU of
    /// the cables on their pulleys, bearing=C, the friction radius of a bearing over the radius of its wheel.
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
    #[serde(skip_serializing_if = "Option::is_none")]
    pulleys: Option<Pulleys>,
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

/// Friction at the pulleys.
#[derive(Serialize)]
struct Pulleys {
    friction: f64,
    bearing: f64,
    /// Greatest difference of the tensions at winch and platform, at any step.
    greatest_difference_n: f64,
    /// Greatest distance of the two ways at the same payload.
    gap_mm: f64,
    /// Numbers of the cables whose wheels slip at any step.
    slipping: Vec<usize>,
    cables: Vec<AtPulley>,
}

/// The pulley of a cable, under own weight, with the payload and without it again.
#[derive(Serialize)]
struct AtPulley {
    wrap_deg: [f64; 3],
    platform_tension_n: [f64; 3],
    winch_tension_n: [f64; 3],
    /// 1 where cable runs towards the winch, -1 towards the platform, between them where the wheel sticks.
    slip: [f64; 3],
}

pub(crate) fn run(settings: &Settings) -> Result<Ending, ProgramError> {
    let with = With::known(settings.with.as_ref(), &["steps", "same-tension", "friction", "bearing"])?;
    let (mu, bearing) = (with.value("friction", None, number)?, with.value("bearing", None, number)?);
    let friction = PulleyFriction { friction: mu.unwrap_or(0.0), bearing: bearing.unwrap_or(0.0) };
    // Zeros are a friction, too: then elastic cables have no loop.
    let is_elastic = mu.or(bearing).is_some();
    let steps = with.value("steps", None, arguments::count::<1, 100_000>)?.unwrap_or(50);
    let pose = settings.pose.needed()?;
    let robot = settings.preference.open_robot(settings.robot.path())?;
    let unloading = if with.has("same-tension")? { Unloading::SameTension } else { Unloading::TurningPoint };
    let laws = laws(&robot, settings, unloading, is_elastic)?;
    questions::about_pose(&robot, "--pose", &pose);
    questions::about_load(&robot, &Load::payload(settings.payload));
    let cycle = || {
        let wanted = WantedPose::at(&pose).free(&settings.free.free);
        load_cycle_over_pulleys(&robot, wanted, &laws, settings.payload, steps, friction)
    };
    let cycle = match patiently("following the load", cycle) {
        Err(error @ StaticsError::BranchEnds(_)) => {
            return print_fall(settings.printing.format(), &robot, &pose, error);
        }
        cycle => cycle?,
    };
    let found = Found { pulleys: Pulleys::new(friction, &cycle), ..Found::new(&robot, &laws, &cycle) };
    settings.printing.format().print(&found, |found| print(&robot, found))?;
    if gives_energy(&robot, settings.payload, &cycle) {
        eprintln!(
            "warning: the loop of a cable runs the wrong way round and gives energy: in its range of tension \
             the record's unloading curve is softer than its loading curve, as it can be far below the \
             turning point from which it was measured"
        );
    }
    if let Some(file) = &settings.figure {
        file.write(&settings.printing.overwrite, |sheet| draw(&robot, &cycle, &found, sheet))?;
    }
    Ok(OutOfLimits::ending(&found.out_of_limits))
}

/// Whether a cable gives more energy than rounding: 1e-9 of the work of gravity on the payload on its way
/// down, and 1e-11 of the elastic energy of the cable.
fn gives_energy(robot: &Robot, payload: f64, cycle: &LoadCycle) -> bool {
    let work = payload * robot.gravity.magnitude() * cycle.deflection().norm();
    let elastic = |i: usize| {
        cycle.tensions[i][1].powi(2) * cycle.lengths[i] / robot.cables[i].properties.axial_stiffness()
    };
    let mut energies = cycle.dissipated.iter().enumerate();
    energies.any(|(i, energy)| *energy < -1e-9 * work - 1e-11 * elastic(i))
}

/// The hysteresis of each cable; without a law it may be elastic, or a law is missing.
fn laws(
    robot: &Robot,
    settings: &Settings,
    unloading: Unloading,
    is_elastic: bool,
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
        (None, _) => {
            let constant = || Ok(vec![HysteresisLaw::linear()?; robot.cables.len()]);
            return match elastic_laws(robot)? {
                None if !is_elastic => Err(ProgramError::NoLaw),
                own => own.map_or_else(constant, Ok),
            };
        }
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
        let at_both_ends = |step: &CycleStep| {
            let equilibrium = &step.solution.equilibrium;
            let exits = equilibrium.exit_tensions(robot, &step.lengths(&cycle.lengths));
            equilibrium.tensions().into_iter().zip(exits).map(<[f64; 2]>::from).collect()
        };
        let tensions: Vec<Vec<[f64; 2]>> = steps.map(at_both_ends).collect();
        Self {
            deflection_mm: (1e3 * cycle.deflection()).into(),
            residual_mm: (1e3 * cycle.residual()).into(),
            payload_work_j: cycle.payload_work,
            dissipated_j: cycle.dissipated.iter().sum(),
            cables: cables.collect(),
            pulleys: None,
            out_of_limits: OutOfLimits::of_tensions(robot, &tensions),
        }
    }
}

impl Pulleys {
    fn new(friction: PulleyFriction, cycle: &LoadCycle) -> Option<Self> {
        let corners = [cycle.loading.first()?, cycle.unloading.first()?, cycle.unloading.last()?];
        let count = corners[0].pulleys.len();
        let cable = |i: usize| {
            let of = |get: fn(&PulleyState) -> f64| corners.map(|step| get(&step.pulleys[i]));
            AtPulley {
                wrap_deg: of(|pulley| pulley.wrap.to_degrees()),
                platform_tension_n: of(|pulley| pulley.tension),
                winch_tension_n: of(|pulley| pulley.winch_tension),
                slip: of(|pulley| pulley.slip),
            }
        };
        let steps: Vec<&CycleStep> = cycle.loading.iter().chain(&cycle.unloading).collect();
        let slips = |i: &usize| steps.iter().any(|step| step.pulleys[*i].slip.abs() == 1.0);
        let differences = steps.iter().flat_map(|step| &step.pulleys);
        let differences = differences.map(|pulley| (pulley.winch_tension - pulley.tension).abs());
        (count > 0).then(|| Self {
            friction: friction.friction,
            bearing: friction.bearing,
            greatest_difference_n: differences.fold(0.0, f64::max),
            gap_mm: 1e3 * cycle.gap(),
            slipping: (0..count).filter(slips).map(|i| i + 1).collect(),
            cables: (0..count).map(cable).collect(),
        })
    }

    fn print(&self) {
        let slipping: Vec<_> = self.slipping.iter().map(usize::to_string).collect();
        let slipping = match slipping.len() {
            0 => "no wheel slips".to_owned(),
            all if all == self.cables.len() => "all wheels slip".to_owned(),
            1 => format!("the wheel of cable {} slips", slipping[0]),
            _ => format!("the wheels of cables {} slip", slipping.join(", ")),
        };
        print_sentence(&format!(
            "Friction of the pulleys: up to {} N between winch and platform; the ways down and up are \
             up to {} mm apart; {slipping}.",
            visible(self.greatest_difference_n, 2),
            visible(rounded(self.gap_mm, ROUNDING), 5)
        ));
        let mut rows = table(&[
            "cable",
            "wrap [deg]",
            "unloaded: platform, winch [N]",
            "payload [N]",
            "removed [N]",
            "slip",
        ]);
        let all =
            self.cables.iter().flat_map(|at| at.winch_tension_n.into_iter().chain(at.platform_tension_n));
        let decimals = decimals_of(all, 2);
        for (i, at) in self.cables.iter().enumerate() {
            let both = |k: usize| {
                let ends = [at.platform_tension_n[k], at.winch_tension_n[k]];
                ends.map(|tension| decimal(tension, decimals)).join(", ")
            };
            let slips = format!("{}, {}", decimal(at.slip[1], 2), decimal(at.slip[2], 2));
            rows.add_row([
                (i + 1).to_string(),
                format!("{:.1}", at.wrap_deg[1]),
                both(0),
                both(1),
                both(2),
                slips,
            ]);
        }
        println!("{rows}");
        println!("slip with the payload and without it: 1 runs to the winch, -1 to the platform");
    }
}

fn print(robot: &Robot, found: &Found) {
    let left = Vector3::from(found.residual_mm).norm();
    let displaced = Vector3::from(found.deflection_mm).norm();
    print_sentence(&format!(
        "{}: the payload displaces the platform by {} mm; {} mm are left when it is gone.",
        shown(&robot.name),
        visible(displaced, 4),
        decimal(left, decimals_of([displaced], 4) + 1)
    ));
    let mut rows =
        table(&["cable", "unloaded [N]", "payload [N]", "removed [N]", "E [GPa]", "dissipated [mJ]"]);
    let all = found.cables.iter().flat_map(|cable| [cable.tension_own_weight_n, cable.tension_payload_n]);
    let decimals = decimals_of(all, 2);
    for (i, cable) in found.cables.iter().enumerate() {
        let [a, b, c] = [cable.tension_own_weight_n, cable.tension_payload_n, cable.tension_removed_n]
            .map(|tension| decimal(tension, decimals));
        let (modulus, energy) = (format!("{:.2}", cable.modulus_gpa), millijoules(cable.dissipated_j));
        rows.add_row([(i + 1).to_string(), a, b, c, modulus, energy]);
    }
    println!("{rows}");
    println!("tensions at the middle of each cable");
    println!(
        "displaced by the payload  {} mm",
        vector(&found.deflection_mm, decimals_of(found.deflection_mm, 4))
    );
    println!("left when it is gone      {} mm", vector(&found.residual_mm, 5));
    println!(
        "energy: {} mJ given by the payload, {} mJ in the loops of the cables{}",
        millijoules(found.payload_work_j),
        millijoules(found.dissipated_j),
        if found.pulleys.is_some() { ",\nthe rest at the pulleys" } else { "" }
    );
    if let Some(pulleys) = &found.pulleys {
        pulleys.print();
    }
    OutOfLimits::print(&found.out_of_limits);
}

/// An energy [J] in mJ, without the sign of a zero.
fn millijoules(energy: f64) -> String {
    visible(rounded(1e3 * energy, ROUNDING), 4)
}

/// Decimals of millimetres and millijoules, beyond which there is rounding alone.
const ROUNDING: i32 = 9;

fn draw(robot: &Robot, ran: &LoadCycle, found: &Found, sheet: Sheet) -> Result<String, ProgramError> {
    let begin = ran.loading.first().map_or(0.0, |step| step.solution.equilibrium.pose.position.z);
    let points = |way: &[CycleStep]| {
        let at = |step: &CycleStep| (1e3 * (begin - step.solution.equilibrium.pose.position.z), step.payload);
        way.iter().map(at).collect::<Vec<_>>()
    };
    let branches = [
        CycleBranch { name: "payload put on".to_owned(), points: points(&ran.loading) },
        CycleBranch { name: "payload taken off".to_owned(), points: points(&ran.unloading) },
    ];
    let drawn = Cycle {
        title: &format!("{}: payload over the way down", robot.name),
        lines: &[format!(
            "{} mm stay; {} mJ given by the payload",
            visible(rounded(-found.residual_mm[2], ROUNDING), 5),
            visible(rounded(1e3 * found.payload_work_j, ROUNDING), 3)
        )],
        x: "way down [mm]",
        y: "payload [kg]",
        branches: &branches,
    };
    Ok(cycle(&drawn, sheet)?)
}
