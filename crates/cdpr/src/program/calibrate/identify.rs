//! `cdpr calibrate identify`: what measurements identify.

use crate::program::arguments::poses;
use crate::program::arguments::{self, FreeArguments, Preference, Printing, RobotArgument};
use crate::program::calibrate::candidates::{Candidates, Known, add, ending};
use crate::program::error::ProgramError;
use crate::program::output::{Details, Ending, patiently, print_sentence, table};
use crate::program::questions;
use cdpr_calibration::{Calibration, Combination, Identifiability};
use cdpr_robot::{Pose, Robot, counted, rounded, shown, significant};
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
    #[command(flatten)]
    details: Details,
}

pub(super) fn run(settings: &Settings) -> Result<Ending, ProgramError> {
    let robot = settings.preference.open_robot(settings.robot.path())?;
    let candidates = settings.candidates.read(&robot)?;
    let measurements = settings.known.measurements(&robot)?;
    let mut calibration = settings.known.calibration(&robot, &settings.free.free)?;
    let load = Load::payload(settings.payload);
    questions::about_load(&robot, &load);
    let all = candidates.len();
    let (poses, refused) = add(&mut calibration, candidates, &load, &measurements)?;
    let output = patiently("choosing poses", || {
        let found = calibration.identify(0..poses.len());
        Output::new(poses, refused, &found, &calibration, settings.count)
    });
    settings.printing.format().print(&output, |output| print(&robot, output, settings.details.details))?;
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
            weights: combination.weights.iter().map(|of| (of.cause.clone(), of.value)).collect(),
        };
        Self {
            refused,
            identifiable: found.identifiable.iter().map(part).collect(),
            unidentifiable: found.unidentifiable.iter().map(part).collect(),
            remaining: found.remaining.iter().map(|of| (of.parameter.to_string(), of.value)).collect(),
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

/// What measurements at all poses identify, and which poses contribute most.
fn print(robot: &Robot, output: &Output, details: bool) {
    let (known, unknown) = (output.identifiable.len(), output.unidentifiable.len());
    let poses = counted(output.poses, "pose");
    let all = known + unknown;
    let better = output.identifiable.iter().filter(|part| part.signal_to_noise >= 1.0).count();
    print_sentence(&format!(
        "{}: {poses} identify {known} of {all} combinations of the parameters, {better} of them better than they \
         are known.",
        shown(&robot.name)
    ));
    let mut left: Vec<_> = output.remaining.iter().collect();
    left.sort_by(|(_, one), (_, other)| other.total_cmp(one));
    if let (Some((worst, most)), Some((best, least))) = (left.first(), left.last()) {
        let [most, least] = [most, least].map(|ratio| significant(100.0 * **ratio, 3));
        print_sentence(&format!("Uncertainty left: {least} % ({best}) to {most} % ({worst})."));
    }
    for (reason, count) in &output.refused {
        println!("{} left out: {}", counted(*count, "pose"), reason.replace('_', " "));
    }
    if details {
        print_details(output);
    }
    let mut rows = table(&["best poses: x, y, z [m], qw, qx, qy, qz", "adds [bit]"]);
    for best in &output.best_poses {
        let pose = best.pose.map(|number| rounded(number, 6).to_string()).join(", ");
        rows.add_row([pose, format!("{:.2}", best.information_bits)]);
    }
    println!("{rows}");
}

/// Each combination of parameters and each parameter.
fn print_details(output: &Output) {
    let words = |part: &Part| {
        let largest = part.weights.iter().take(5).map(|(name, weight)| format!("{weight:+.2} {name}"));
        largest.collect::<Vec<_>>().join(" ")
    };
    let mut rows =
        table(&["signal/noise", "combination of what is uncertain, each in units of its uncertainty"]);
    for part in output.identifiable.iter().chain(&output.unidentifiable) {
        rows.add_row([significant(part.signal_to_noise, 4), words(part)]);
    }
    println!("{rows}");
    let mut rows = table(&["parameter", "uncertainty left [%]"]);
    for (name, ratio) in &output.remaining {
        rows.add_row([name.clone(), format!("{:.2}", 100.0 * ratio)]);
    }
    println!("{rows}");
}
