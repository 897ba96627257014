//! `cdpr robot list`: the robots and cables that come with the program.

use crate::program::arguments::Printing;
use crate::program::error::ProgramError;
use crate::program::output::{print_sentence, table};
use crate::program::questions;
use cdpr_robot::library::{CABLES, ROBOTS};
use cdpr_robot::{Grade, Robot, Vector3, shown};
use cdpr_study::open_cable;
use serde::Serialize;
use std::path::Path;

/// How the lists are printed.
#[derive(clap::Args)]
pub(crate) struct Settings {
    #[command(flatten)]
    printing: Printing,
}

/// What comes with the program: a row of a table.
#[derive(Serialize)]
#[serde(tag = "kind", rename_all = "lowercase")]
enum Entry {
    Robot(RobotEntry),
    Cable(CableEntry),
}

/// A robot of the library.
#[derive(Serialize)]
struct RobotEntry {
    name: &'static str,
    title: String,
    cables: usize,
    pulleys: usize,
    /// Free motions of the platform.
    free_motions: usize,
    /// Mass of the platform.
    mass_kg: f64,
    /// Sides of the box around the exit points.
    exit_extent_m: [f64; 3],
    grade: Option<Grade>,
    source: Option<String>,
}

/// A cable of the catalogue.
#[derive(Serialize)]
struct CableEntry {
    name: &'static str,
    title: String,
    section_mm2: f64,
    #[serde(rename = "linear_density_kg_per_m")]
    linear_density: f64,
    modulus_gpa: f64,
    #[serde(rename = "breaking_force_n")]
    breaking_force: Option<f64>,
    source: Option<String>,
}

pub(super) fn run(settings: &Settings) -> Result<(), ProgramError> {
    let robots = ROBOTS.iter().map(|file| RobotEntry::open(file.name).map(Entry::Robot));
    let cables = CABLES.iter().map(|file| CableEntry::open(file.name).map(Entry::Cable));
    let entries: Vec<Entry> = robots.chain(cables).collect::<Result<_, _>>()?;
    Ok(settings.printing.format().print(&entries, |entries| {
        print_robots(entries);
        print_cables(entries);
        println!("cdpr robot show NAME prints what a robot is, its source and what is assumed");
    })?)
}

impl RobotEntry {
    fn open(name: &'static str) -> Result<Self, ProgramError> {
        let robot = questions::open_robot(Path::new(name))?;
        Ok(Self {
            name,
            cables: robot.cables.len(),
            pulleys: robot.cables.iter().filter(|cable| cable.pulley.is_some()).count(),
            free_motions: robot.freedoms().count(),
            mass_kg: robot.platform.mass,
            exit_extent_m: extent(&exit_points(&robot)),
            grade: robot.provenance.grade,
            title: robot.name,
            source: robot.provenance.source,
        })
    }
}

impl CableEntry {
    fn open(name: &'static str) -> Result<Self, ProgramError> {
        let cable = open_cable(Path::new(name))?;
        let properties = cable.properties;
        Ok(Self {
            name,
            title: cable.name,
            section_mm2: 1e6 * properties.section,
            linear_density: properties.linear_density,
            modulus_gpa: 1e-9 * properties.youngs_modulus,
            breaking_force: properties.breaking_force,
            source: cable.source,
        })
    }
}

/// Sides of the box around points [m].
pub(super) fn extent(points: &[Vector3<f64>]) -> [f64; 3] {
    std::array::from_fn(|axis| {
        let coordinates = || points.iter().map(|point| point[axis]);
        coordinates().fold(f64::NEG_INFINITY, f64::max) - coordinates().fold(f64::INFINITY, f64::min)
    })
}

/// The exit points [m].
pub(super) fn exit_points(robot: &Robot) -> Vec<Vector3<f64>> {
    robot.cables.iter().map(|cable| cable.exit_point).collect()
}

fn print_robots(entries: &[Entry]) {
    let mut table = table(&["name", "cables", "mass [kg]", "exit points [m]", "grade"]);
    for entry in entries {
        let Entry::Robot(robot) = entry else { continue };
        let [x, y, z] = robot.exit_extent_m;
        table.add_row([
            robot.name.to_owned(),
            robot.cables.to_string(),
            robot.mass_kg.to_string(),
            format!("{x:.1} x {y:.1} x {z:.1}"),
            robot.grade.map_or_else(String::new, |grade| grade.to_string()),
        ]);
    }
    println!("{table}");
    print_sentence(
        "grade: surveyed on the robot itself; from a paper or a file of its makers; nominal values",
    );
}

fn print_cables(entries: &[Entry]) {
    let cables = || {
        entries.iter().filter_map(|entry| match entry {
            Entry::Cable(cable) => Some(cable),
            Entry::Robot(_) => None,
        })
    };
    let mut table = table(&["name", "section [mm²]", "mass [kg/m]", "E [GPa]", "breaks at [N]"]);
    for cable in cables() {
        table.add_row([
            cable.name.to_owned(),
            format!("{:.4}", cable.section_mm2),
            cable.linear_density.to_string(),
            format!("{:.4}", cable.modulus_gpa),
            cable.breaking_force.map_or_else(|| "-".to_owned(), |force| force.to_string()),
        ]);
    }
    println!("{table}");
    for cable in cables() {
        let source = shown(cable.source.as_deref().unwrap_or("source not known"));
        print_sentence(&format!("{}: {source}", cable.name));
    }
}
