//! `cdpr calibrate identify`: what measurements identify.

use crate::arguments::poses;
use crate::arguments::{self, FreeArguments, Preference, Printing, RobotArgument};
use crate::calibrate::candidates::{Candidates, Known, add, ending};
use crate::error::ProgramError;
use crate::output::{Ending, patiently, table};
use crate::questions;
use cdpr_calibration::{Calibration, Combination, Identifiability, ParameterValue};
use cdpr_robot::{Pose, Robot, counted, rounded, shown};
use cdpr_statics::Load;
use serde::Serialize;
use std::collections::BTreeMap;

/// The robot, the candidate poses and the measurements.
#[derive(clap::Args)]
pub(crate) struct Settings {
    #[command(flatten)]
    robot: RobotArgument,
    #[command(flatten)]
    candidates: Candidates,
    #[command(flatten)]
    known: Known,
    /// Known mass added at the platform's centre of mass [kg].
    #[arg(long, value_parser = arguments::mass, default_value = "0", allow_hyphen_values = true)]
    payload: f64,
    #[command(flatten)]
    free: FreeArguments,
    #[command(flatten)]
    preference: Preference,
    /// Number of best poses that are printed.
    #[arg(long = "number", value_name = "N", default_value_t = 10)]
    #[arg(value_parser = arguments::count::<0, 100_000>)]
    count: usize,
    #[command(flatten)]
    printing: Printing,
}

pub(super) fn run(settings: &Settings) -> Result<Ending, ProgramError> {
    let robot = settings.preference.open_robot(settings.robot.path())?;
    let candidates = settings.candidates.read(&robot)?;
    let measurements = settings.known.measurements(&robot)?;
    let uncertainties = settings.known.deviations(&robot)?;
    let mut calibration = Calibration::new(&robot, &uncertainties)?.with_free(&settings.free.free);
    let load = Load::payload(settings.payload);
    questions::about_load(&robot, &load);
    let all = candidates.len();
    let (poses, refused) = add(&mut calibration, candidates, &load, &measurements)?;
    let output = patiently("choosing poses", || {
        let found = calibration.identify(0..poses.len());
        Output::new(poses, refused, &found, &calibration, settings.count)
    });
    settings.printing.format().print(&output, |output| print(&robot, output))?;
    Ok(ending(output.poses, all))
}

/// The results.
#[derive(Serialize)]
struct Output {
    /// Poses that the robot holds.
    poses: usize,
    /// Numbers of the other poses, by the reason why they are not held.
    refused: BTreeMap<&'static str, usize>,
    identifiable: Vec<Part>,
    unidentifiable: Vec<Part>,
    /// Standard deviation of each uncertain parameter after the calibration over that before.
    remaining: BTreeMap<String, f64>,
    best_poses: Vec<Best>,
}

#[derive(Serialize)]
struct Part {
    signal_to_noise: f64,
    weights: Vec<(String, f64)>,
}

#[derive(Serialize)]
struct Best {
    /// x, y, z [m], qw, qx, qy, qz.
    pose: [f64; 7],
    information_bits: f64,
}

impl Output {
    fn new(
        poses: Vec<Pose>,
        refused: BTreeMap<&'static str, usize>,
        found: &Identifiability,
        calibration: &Calibration,
        choose: usize,
    ) -> Self {
        let part = |combination: &Combination| Part {
            signal_to_noise: combination.signal_to_noise,
            weights: pairs(&combination.weights),
        };
        Self {
            refused,
            identifiable: found.identifiable.iter().map(part).collect(),
            unidentifiable: found.unidentifiable.iter().map(part).collect(),
            remaining: pairs(&found.remaining),
            best_poses: calibration
                .best_poses(choose)
                .iter()
                .map(|chosen| Best {
                    pose: poses::pose_numbers(&poses[chosen.pose]),
                    information_bits: chosen.information,
                })
                .collect(),
            poses: poses.len(),
        }
    }
}

fn print(robot: &Robot, output: &Output) {
    println!("{}: measured at {}", shown(&robot.name), counted(output.poses, "pose"));
    for (reason, count) in &output.refused {
        println!("{} left out: {reason}", counted(*count, "pose"));
    }
    let words = |part: &Part| {
        let largest = part.weights.iter().take(5).map(|(name, weight)| format!("{weight:+.2} {name}"));
        largest.collect::<Vec<_>>().join(" ")
    };
    let mut rows = table(&["signal/noise", "combination of parameters, each in units of its uncertainty"]);
    for part in &output.identifiable {
        rows.add_row([format!("{:.3e}", part.signal_to_noise), words(part)]);
    }
    for part in &output.unidentifiable {
        rows.add_row(["0".to_owned(), words(part)]);
    }
    println!("{rows}");
    let mut rows = table(&["parameter", "uncertainty left [%]"]);
    for (name, ratio) in &output.remaining {
        rows.add_row([name.clone(), format!("{:.2}", 100.0 * ratio)]);
    }
    println!("{rows}");
    let mut rows = table(&["best poses: x, y, z [m], qw, qx, qy, qz", "adds [bit]"]);
    for best in &output.best_poses {
        let pose = best.pose.map(|number| rounded(number, 6).to_string()).join(", ");
        rows.add_row([pose, format!("{:.2}", best.information_bits)]);
    }
    println!("{rows}");
}

/// Names of parameters with their numbers.
fn pairs<C: FromIterator<(String, f64)>>(values: &[ParameterValue]) -> C {
    values.iter().map(|of| (of.parameter.to_string(), of.value)).collect()
}
