//! `cdpr calibrate pulleys`: the friction of pulleys from tensions at the winches.

use crate::program::arguments::poses::PoseArguments;
use crate::program::arguments::{FreeArguments, Preference, Printing, RobotArgument};
use crate::program::calibrate::sensors::NoiseArgument;
use crate::program::error::ProgramError;
use crate::program::output::{Details, Ending, patiently, print_sentence, table};
use crate::program::questions;
use cdpr_calibration::{EstimatedValue, PulleyCalibration, calibrate_pulleys, read_measurements};
use cdpr_robot::{Robot, counted, shown, significant};
use cdpr_study::{InputKind, check_table, read_bytes};
use std::path::PathBuf;

/// The robot, the measurements and where they were taken.
#[derive(clap::Args)]
pub(crate) struct Settings {
    #[command(flatten)]
    robot: RobotArgument,
    /// Measurements in the order in which they were taken (a table with units in its header, or JSON):
    /// t1_winch_n ..., with loads (payload_kg ...) and --pose, that under the first load, or with positions;
    /// t1_n ... at the platform, dz_m ...; - for the standard input.
    measurements: PathBuf,
    #[command(flatten)]
    pose: PoseArguments,
    #[command(flatten)]
    noise: NoiseArgument,
    #[command(flatten)]
    free: FreeArguments,
    #[command(flatten)]
    preference: Preference,
    #[command(flatten)]
    printing: Printing,
    #[command(flatten)]
    details: Details,
}

pub(super) fn run(settings: &Settings) -> Result<Ending, ProgramError> {
    let robot = settings.preference.open_robot(settings.robot.path())?;
    let path = &settings.measurements;
    let in_file = ProgramError::in_file(path);
    let bytes = read_bytes(path, InputKind::Measurements)?;
    check_table(path, &bytes, InputKind::Measurements)?;
    let measured = read_measurements(&bytes, &robot, settings.noise.named(&robot)).map_err(&in_file)?;
    let pose = settings.pose.given()?;
    if let Some(pose) = &pose {
        questions::about_pose(&robot, "--pose", pose);
    }
    let found = patiently("fitting the friction", || {
        calibrate_pulleys(&robot, &measured, pose.as_ref(), &settings.free.free)
    })
    .map_err(in_file)?;
    settings.printing.format().print(&found, |found| print(&robot, found, settings.details.details))?;
    Ok(Ending::Well)
}

fn print(robot: &Robot, found: &PulleyCalibration, details: bool) {
    let of =
        |value: &EstimatedValue| format!("{} +- {}", significant(value.value, 4), significant(value.std, 2));
    let name = shown(&robot.name);
    match (&found.friction, &found.bearing) {
        (Some(friction), Some(bearing)) => print_sentence(&format!(
            "{name}: friction={} of the cables on the wheels, bearing={}.",
            of(friction),
            of(bearing)
        )),
        _ => {
            let [one, other] = found.combination.map(|share| significant(share, 3));
            let [friction, bearing] = found.modelled_with.map(|value| significant(value, 4));
            print_sentence(&format!(
                "{name}: {one} friction + {other} bearing = {}; to first order these measurements identify \
                 this sum alone. The tensions below are those of friction={friction}, bearing={bearing}.",
                of(&found.combined)
            ));
        }
    }
    let [without, with] = found.rms_n.map(|rms| significant(rms, 3));
    print_sentence(&format!(
        "{} of tensions at winches, rms of the residuals {with} N; {without} N without friction.",
        counted(found.readings.len(), "reading")
    ));
    let mut rows = table(&["cable", "wrap [deg]", "readings", "wheel slips", "rms [N]"]);
    for cable in &found.cables {
        let [least, most] = cable.wrap_deg;
        rows.add_row([
            cable.cable.to_string(),
            format!("{least:.1} to {most:.1}"),
            cable.readings.to_string(),
            cable.slipping.to_string(),
            significant(cable.rms_n, 3),
        ]);
    }
    println!("{rows}");
    if !details {
        return;
    }
    let mut rows =
        table(&["line", "cable", "platform [N]", "winch [N]", "model [N]", "residual [N]", "slip"]);
    for at in &found.readings {
        rows.add_row([
            at.line.to_string(),
            at.cable.to_string(),
            format!("{:.2}", at.platform_n),
            format!("{:.2}", at.measured_n),
            format!("{:.2}", at.modelled_n),
            format!("{:+.2}", at.measured_n - at.modelled_n),
            at.slip.to_string(),
        ]);
    }
    println!("{rows}");
    println!("slip: 1 runs to the winch, -1 to the platform, 0 sticks");
}
