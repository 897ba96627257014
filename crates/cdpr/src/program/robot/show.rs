//! `cdpr robot show`: what a robot is, in a few lines.

use crate::program::arguments::{Printing, RobotArgument};
use crate::program::error::ProgramError;
use crate::program::output::print_sentence;
use crate::program::questions;
use crate::program::robot::library::{exit_points, extent};
use cdpr_robot::{CableEnd, Grade, Robot, counted, decimals_of, rounded, shown};
use serde::Serialize;

/// The robot.
#[derive(clap::Args)]
pub(crate) struct Settings {
    #[command(flatten)]
    robot: RobotArgument,
    #[command(flatten)]
    printing: Printing,
}

/// A robot.
#[derive(Serialize)]
struct Shown {
    name: String,
    cables: usize,
    /// Cables whose exit point is on a pulley.
    pulleys: usize,
    /// Least and greatest radius of the pulleys, to the middle of the cable; `None` without pulleys.
    #[serde(rename = "pulley_radius_m")]
    pulley_radius: Option<[f64; 2]>,
    /// Least and greatest stretched length between winch and exit point; `None` where no cable has one.
    #[serde(rename = "lead_m")]
    lead: Option<[f64; 2]>,
    /// Free motions of the platform.
    free_motions: usize,
    #[serde(rename = "mass_kg")]
    mass: f64,
    #[serde(rename = "center_of_mass_m")]
    center_of_mass: [f64; 3],
    has_inertia: bool,
    #[serde(skip)]
    is_point: bool,
    /// Sides of the boxes around the exit points and the anchor points.
    #[serde(rename = "exit_extent_m")]
    exit_points: [f64; 3],
    #[serde(rename = "anchor_extent_m")]
    anchor_points: [f64; 3],
    /// Least and greatest value over the cables.
    #[serde(rename = "linear_density_kg_per_m")]
    linear_density: [f64; 2],
    #[serde(rename = "axial_stiffness_n")]
    axial_stiffness: [f64; 2],
    #[serde(rename = "min_tension_n")]
    min_tension: [f64; 2],
    #[serde(rename = "max_tension_n")]
    max_tension: [f64; 2],
    /// Least and greatest breaking force that is known, and cables whose own is not known.
    #[serde(rename = "breaking_force_n")]
    breaking_force: Option<[f64; 2]>,
    unknown_breaking_forces: usize,
    /// Ends at which the greatest tension is limited.
    max_at: Vec<CableEnd>,
    distribution: &'static str,
    has_reference: bool,
    has_laws: bool,
    /// Least and greatest EA of the segments of elastic laws.
    #[serde(rename = "law_stiffness_n")]
    law_stiffness: Option<[f64; 2]>,
    grade: Option<Grade>,
    source: Option<String>,
    assumed: Vec<String>,
}

pub(super) fn run(settings: &Settings) -> Result<(), ProgramError> {
    let robot = questions::open_robot(settings.robot.path())?;
    Ok(settings.printing.format().print(&Shown::new(&robot), print)?)
}

impl Shown {
    fn new(robot: &Robot) -> Self {
        let cables = &robot.cables;
        let limits = || (0..cables.len()).map(|i| robot.limits(i));
        let ends = (0..cables.len()).map(|i| robot.max_at(i));
        let anchor_points: Vec<_> = cables.iter().map(|cable| cable.anchor_point).collect();
        let radii: Vec<f64> = cables.iter().filter_map(|cable| Some(cable.pulley?.radius)).collect();
        let breaking = cables.iter().filter_map(|cable| cable.properties.breaking_force);
        Self {
            name: robot.name.clone(),
            cables: cables.len(),
            pulleys: radii.len(),
            pulley_radius: (!radii.is_empty()).then(|| range(radii.iter().copied())),
            lead: cables
                .iter()
                .any(|cable| cable.lead != 0.0)
                .then(|| range(cables.iter().map(|cable| cable.lead))),
            free_motions: robot.freedoms().count(),
            mass: robot.platform.mass,
            center_of_mass: robot.platform.center_of_mass.into(),
            has_inertia: robot.platform.inertia.is_some(),
            is_point: robot.platform.point,
            exit_points: extent(&exit_points(robot)),
            anchor_points: extent(&anchor_points),
            linear_density: range(cables.iter().map(|cable| cable.properties.linear_density)),
            axial_stiffness: range(cables.iter().map(|cable| cable.properties.axial_stiffness())),
            min_tension: range(limits().map(|limits| limits.min)),
            max_tension: range(limits().map(|limits| limits.max)),
            breaking_force: (breaking.clone().count() > 0).then(|| range(breaking.clone())),
            unknown_breaking_forces: cables.len() - breaking.count(),
            max_at: ends.fold(Vec::new(), |mut ends, end| {
                if !ends.contains(&end) {
                    ends.push(end);
                }
                ends
            }),
            distribution: robot.distribution.name(),
            has_reference: robot.tension_reference.is_some(),
            law_stiffness: law_stiffness(robot),
            has_laws: cables.iter().any(|cable| cable.properties.law.is_some()),
            grade: robot.provenance.grade,
            source: robot.provenance.source.clone(),
            assumed: robot.provenance.assumed.clone(),
        }
    }
}

/// EA of the segments of all elastic laws [N], the least and the greatest.
fn law_stiffness(robot: &Robot) -> Option<[f64; 2]> {
    let laws = || robot.cables.iter().filter_map(|cable| Some((cable, cable.properties.law.as_ref()?)));
    let stiffness = laws().flat_map(|(cable, law)| {
        let scale = cable.properties.axial_stiffness();
        law.segments().map(move |segment| scale * segment.ratio).collect::<Vec<_>>()
    });
    laws().next().map(|_| range(stiffness))
}

/// Least and greatest of several values.
fn range(values: impl Iterator<Item = f64>) -> [f64; 2] {
    values.fold([f64::INFINITY, f64::NEG_INFINITY], |[min, max], value| [min.min(value), max.max(value)])
}

/// One number, or two.
fn words([min, max]: [f64; 2]) -> String {
    let short = |value: f64| {
        let decimals = 3 - value.abs().max(1e-12).log10().floor() as i32;
        rounded(value, decimals)
    };
    if min == max { short(min).to_string() } else { format!("{} to {}", short(min), short(max)) }
}

fn print(robot: &Shown) {
    let sides = |sides: [f64; 3]| {
        let decimals = decimals_of(sides, 2);
        format!("{} m", sides.map(|side| format!("{side:.decimals$}")).join(" x "))
    };
    let (platform, inertia) = match (robot.is_point, robot.has_inertia) {
        (true, _) => ("point mass", ""),
        (false, true) => ("platform", ""),
        (false, false) => ("platform", ", inertia not known"),
    };
    print_sentence(&format!(
        "{}: {}, {} free motions, {platform} of {} kg{inertia}",
        shown(&robot.name),
        counted(robot.cables, "cable"),
        robot.free_motions,
        robot.mass
    ));
    println!("exit points in a box of    {}", sides(robot.exit_points));
    if !robot.is_point {
        println!("anchor points in a box of  {}", sides(robot.anchor_points));
    }
    let law = robot
        .law_stiffness
        .map_or_else(String::new, |law| format!(" by youngs_modulus, {} N by the elastic law", words(law)));
    let radius = robot.pulley_radius;
    let radius = radius.map_or_else(String::new, |radius| format!(" of radius {} m", words(radius)));
    let lead = robot.lead.map_or_else(String::new, |lead| format!("; leads of {} m", words(lead)));
    print_sentence(&format!(
        "cables: {} kg/m, EA {} N{law}; {}{radius}{lead}",
        words(robot.linear_density),
        words(robot.axial_stiffness),
        counted(robot.pulleys, "pulley")
    ));
    let ends: Vec<&str> = robot
        .max_at
        .iter()
        .map(|end| match end {
            CableEnd::Anchor => "platform",
            CableEnd::Exit => "exit point",
        })
        .collect();
    let unknown = match robot.unknown_breaking_forces {
        0 => String::new(),
        unknown => format!(", that of {} not known", counted(unknown, "cable")),
    };
    let breaking = robot
        .breaking_force
        .map_or_else(String::new, |force| format!("; breaking force {} N{unknown}", words(force)));
    let [least, greatest] = [robot.min_tension, robot.max_tension].map(words);
    let limits = match [robot.min_tension, robot.max_tension].iter().all(|[low, high]| low == high) {
        true => format!("{least} to {greatest} N"),
        false => format!("at least {least} N, at most {greatest} N"),
    };
    print_sentence(&format!("tensions: {limits} at the {}{breaking}", ends.join(" and ")));
    let grade = robot.grade.map_or_else(|| "not graded".to_owned(), |grade| grade.to_string());
    println!("grade: {grade}");
    print_sentence(&format!("source: {}", shown(robot.source.as_deref().unwrap_or("not known"))));
    for assumed in &robot.assumed {
        print_sentence(&format!("assumed: {}", shown(assumed)));
    }
}
