//! `cdpr robots`: the robots and cables that come with the program.

use crate::arguments::Format;
use crate::error::ProgramError;
use crate::output::table;
use crate::questions;
use cdpr_robot::library::{CABLES, ROBOTS};
use cdpr_robot::{Grade, Robot, shown};
use cdpr_study::open_cable;
use serde::Serialize;
use std::path::Path;

/// What is listed.
#[derive(clap::Args)]
pub(crate) struct Settings {
    /// Name of one robot, of which source and assumptions are printed; all robots if left out.
    #[arg(conflicts_with = "cables")]
    name: Option<String>,
    /// List the cables of the catalogue instead.
    #[arg(long)]
    cables: bool,
    /// How the list is printed.
    #[arg(long, value_enum, default_value_t = Format::Text)]
    format: Format,
}

/// A robot of the library.
#[derive(Serialize)]
struct RobotEntry {
    name: String,
    title: String,
    cables: usize,
    /// Mass of the platform [kg].
    mass_kg: f64,
    /// Sides of the box around the exit points [m].
    extent_m: [f64; 3],
    grade: Option<Grade>,
    source: Option<String>,
    assumed: Vec<String>,
}

/// A cable of the catalogue.
#[derive(Serialize)]
struct CableEntry {
    name: &'static str,
    title: String,
    section_mm2: f64,
    linear_density: f64,
    modulus_gpa: f64,
    breaking_force: Option<f64>,
    source: Option<String>,
}

pub(crate) fn run(settings: &Settings) -> Result<(), ProgramError> {
    let format = settings.format;
    match &settings.name {
        Some(name) => format.print(&RobotEntry::open(name)?, print_one)?,
        None if settings.cables => {
            let entries = CABLES.iter().map(|file| CableEntry::open(file.name));
            format.print(&entries.collect::<Result<Vec<_>, _>>()?, |entries| print_cables(entries))?;
        }
        None => {
            let entries = ROBOTS.iter().map(|file| RobotEntry::open(file.name));
            format.print(&entries.collect::<Result<Vec<_>, _>>()?, |entries| print_robots(entries))?;
        }
    }
    Ok(())
}

impl RobotEntry {
    fn open(name: &str) -> Result<Self, ProgramError> {
        let robot = questions::open_robot(Path::new(name))?;
        Ok(Self {
            name: name.to_owned(),
            cables: robot.cables.len(),
            mass_kg: robot.platform.mass,
            extent_m: extent(&robot),
            grade: robot.provenance.grade,
            title: robot.name,
            source: robot.provenance.source,
            assumed: robot.provenance.assumed,
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

fn extent(robot: &Robot) -> [f64; 3] {
    let coordinates = |axis: usize| robot.cables.iter().map(move |cable| cable.exit_point[axis]);
    std::array::from_fn(|axis| {
        coordinates(axis).fold(f64::NEG_INFINITY, f64::max) - coordinates(axis).fold(f64::INFINITY, f64::min)
    })
}

fn print_robots(robots: &[RobotEntry]) {
    let mut table = table(&["name", "robot", "cables", "platform [kg]", "exit points [m]", "grade"]);
    for robot in robots {
        let [x, y, z] = robot.extent_m;
        table.add_row([
            robot.name.clone(),
            shown(&robot.title).to_string(),
            robot.cables.to_string(),
            robot.mass_kg.to_string(),
            format!("{x:.1} x {y:.1} x {z:.1}"),
            robot.grade.map_or_else(String::new, |grade| grade.to_string()),
        ]);
    }
    println!("{table}");
    println!("grade: surveyed on the robot itself; from a paper or a file of its makers; nominal values");
    println!("cdpr robots NAME prints source and assumptions; every command takes a name for a robot file");
}

fn print_one(robot: &RobotEntry) {
    let [x, y, z] = robot.extent_m;
    let grade = robot.grade.map_or_else(|| "not graded".to_owned(), |grade| grade.to_string());
    println!("{}: {} cables, {grade}", shown(&robot.title), robot.cables);
    println!("platform of {} kg, exit points in a box of {x:.1} x {y:.1} x {z:.1} m", robot.mass_kg);
    println!("\nsource: {}", shown(robot.source.as_deref().unwrap_or("not known")));
    for assumed in &robot.assumed {
        println!("assumed: {}", shown(assumed));
    }
}

fn print_cables(cables: &[CableEntry]) {
    let mut table =
        table(&["name", "section [mm²]", "density [kg/m]", "modulus [GPa]", "breaking force [N]"]);
    for cable in cables {
        table.add_row([
            cable.name.to_owned(),
            format!("{:.4}", cable.section_mm2),
            cable.linear_density.to_string(),
            format!("{:.4}", cable.modulus_gpa),
            cable.breaking_force.map_or_else(|| "-".to_owned(), |force| force.to_string()),
        ]);
    }
    println!("{table}");
    for cable in cables {
        println!("{}: {}", cable.name, shown(cable.source.as_deref().unwrap_or("source not known")));
    }
}
