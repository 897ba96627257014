//! `cdpr calibrate simulate`: what a campaign would read.

use crate::program::arguments::endings;
use crate::program::arguments::{
    self, Format, FreeArguments, LoadArguments, Overwrite, Preference, RobotArgument, UncertaintyArgument,
};
use crate::program::calibrate::candidates::{Candidates, ending};
use crate::program::calibrate::sensors::{NoiseArgument, SensorArguments};
use crate::program::error::ProgramError;
use crate::program::output::Ending;
use crate::program::questions;
use crate::program::said;
use cdpr_calibration::{Noise, SensorError, Simulated, drawn_errors, simulate, write_measurements};
use cdpr_robot::{CableEnd, counted, listing};
use serde_json::json;
use std::path::PathBuf;

/// A robot that deviates from its file, and what is measured.
#[derive(clap::Args)]
pub(crate) struct Settings {
    #[command(flatten)]
    robot: RobotArgument,
    #[command(flatten)]
    candidates: Candidates,
    #[command(flatten)]
    uncertainty: UncertaintyArgument,
    #[command(flatten)]
    noise: NoiseArgument,
    #[command(flatten)]
    sensors: SensorArguments,
    /// winch-cells: load cells sit at the winches, where they are at the platform otherwise.
    #[arg(long, value_name = "NAMES", value_parser = arguments::with)]
    with: Option<arguments::With>,
    #[command(flatten)]
    load: LoadArguments,
    #[command(flatten)]
    free: FreeArguments,
    #[command(flatten)]
    preference: Preference,
    /// Seed of deviations and noise.
    #[arg(long, value_parser = arguments::seed, allow_negative_numbers = true)]
    seed: u64,
    /// File for the measurements (CSV).
    #[arg(short, long, value_parser = endings::csv())]
    out: PathBuf,
    /// File for the robot as it truly is (JSON).
    #[arg(long, value_parser = endings::json())]
    truth: Option<PathBuf>,
    #[command(flatten)]
    overwrite: Overwrite,
    /// How the counts of rows and poses are printed.
    #[arg(long, value_enum, default_value_t = Format::Text)]
    format: Format,
}

pub(super) fn run(settings: &Settings) -> Result<Ending, ProgramError> {
    let robot = settings.preference.open_robot(settings.robot.path())?;
    let with = arguments::With::known(settings.with.as_ref(), &["winch-cells"])?;
    let poses = settings.candidates.read(&robot)?;
    let model = settings.uncertainty.needed(&robot)?;
    let noise = settings.noise.named(&robot);
    if noise.is_empty() {
        let missing = "expected --noise of the sensors that are there, such as position=1e-4,rotation=1e-4";
        return Err(ProgramError::Usage(missing.to_owned()));
    }
    questions::about_load(&robot, &settings.load.load());
    let noise = Noise::named(noise)?;
    if model.has_offsets() {
        said::note(format_args!(
            "dt changes nothing: it is of tensions that are set, and winches set lengths here"
        ));
    }
    let deviations = cdpr_calibration::drawn(&model, settings.seed);
    let markers = settings.sensors.markers(&robot);
    let errors = settings.sensors.errors()?;
    let sized = |(error, std): (SensorError, Option<f64>)| {
        let name = error.name();
        let missing = || ProgramError::Usage(format!("--unknown {name}: expected {name}=STD"));
        Ok((error, std.ok_or_else(missing)?))
    };
    let errors: Vec<_> = errors.into_iter().map(sized).collect::<Result<_, ProgramError>>()?;
    let errors = drawn_errors(&robot, &errors, markers.len(), settings.seed);
    let rows = simulate(&Simulated {
        nominal: &robot,
        deviations: &deviations,
        poses: &poses,
        free: &settings.free.free,
        load: settings.load.load(),
        noise,
        markers: &markers,
        errors: &errors,
        tension_at: if with.has("winch-cells")? { CableEnd::Exit } else { CableEnd::Anchor },
        seed: settings.seed,
    })?;
    let left_out: Vec<usize> = (1..=poses.len()).filter(|k| rows.iter().all(|row| row.line != *k)).collect();
    if rows.is_empty() {
        let reasons = format!("the robot of the file does not hold any of {}", counted(poses.len(), "pose"));
        return Err(ProgramError::NoPoseHeld { reasons });
    }
    let (header, lines) = write_measurements(&rows);
    let mut text = header.join(",") + "\n";
    lines.iter().for_each(|line| text += &(line.join(",") + "\n"));
    let truth = robot.perturbed(&deviations).map_err(cdpr_calibration::CalibrationError::from)?.robot;
    let truth = truth.to_json() + "\n";
    let truth = settings.truth.iter().map(|path| (path.as_path(), truth.as_str()));
    let files: Vec<_> = truth.chain([(settings.out.as_path(), text.as_str())]).collect();
    settings.overwrite.write_all(&files)?;
    let (held, all) = (rows.len(), poses.len());
    let written = json!({ "measurements": settings.out.to_string_lossy(), "rows": held, "poses": all,
        "left_out": left_out });
    settings.format.print(&written, |_| {
        let [rows, poses] = [counted(held, "row"), counted(all, "pose")];
        let of = if held < all { format!("{held} of {poses}") } else { poses };
        println!("{}: {rows} at {of}", settings.out.display());
        let numbers: Vec<String> = left_out.iter().map(ToString::to_string).collect();
        if !numbers.is_empty() {
            println!("{}", listing("left out, not held by the robot of the file: poses ", &numbers, ""));
        }
    })?;
    Ok(ending(held, all))
}
