//! `cdpr calibration simulate`: what a campaign would read.

use crate::arguments::{self, FreeArguments, LoadArguments, Named, Overwrite, Preference};
use crate::endings;
use crate::error::ProgramError;
use crate::questions;
use crate::robot::calibrate::{Sought, sensor_errors};
use crate::robot::calibration::candidates::Candidates;
use cdpr_calibration::{Noise, SensorError, Simulated, drawn_errors, simulate, write_measurements};
use cdpr_robot::{CableEnd, Vector3, counted};
use std::path::PathBuf;

#[derive(Clone, Copy, Debug, PartialEq, Eq, clap::ValueEnum)]
enum CellsAt {
    Platform,
    Winch,
}

/// A robot that deviates from its file, and what is measured.
#[derive(clap::Args)]
pub(crate) struct SimulateSettings {
    /// Robot file (JSON, `cdpr-robot/1`): what the controller knows.
    robot: PathBuf,
    #[command(flatten)]
    candidates: Candidates,
    #[command(flatten)]
    sought: Sought,
    /// Noise of the sensors that are there: position=1e-4,rotation=1e-4,length=1e-4,tension=5.
    #[arg(long, value_parser = arguments::named)]
    noise: Named,
    /// Errors of the sensors to draw, with their standard deviations: length_offset=0.01,tension_bias=20.
    ///
    /// The names are those of `cdpr calibrate --unknown`.
    #[arg(long, value_name = "ERRORS", value_delimiter = ',')]
    unknown: Vec<String>,
    /// Where a marker stands on the platform: x,y,z [m], once for each in their order.
    #[arg(long = "marker", value_parser = arguments::components::<3>, allow_hyphen_values = true)]
    markers: Vec<[f64; 3]>,
    /// Where the load cells sit.
    #[arg(long, value_enum, default_value_t = CellsAt::Platform)]
    tension_at: CellsAt,
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
    #[arg(long, value_parser = endings::csv())]
    out: PathBuf,
    /// File for the robot as it truly is (JSON).
    #[arg(long, value_parser = endings::json())]
    truth: Option<PathBuf>,
    #[command(flatten)]
    overwrite: Overwrite,
}

pub(super) fn simulated(settings: &SimulateSettings) -> Result<(), ProgramError> {
    let robot = settings.preference.open_robot(&settings.robot)?;
    let poses = settings.candidates.read(&robot)?;
    let Some(model) = settings.sought.prior(&robot)? else {
        return Err(ProgramError::Usage(
            "expected --model, the tolerances to draw deviations from".to_owned(),
        ));
    };
    let Named(noise) = &settings.noise;
    questions::about_noise(&robot, noise);
    questions::about_load(&robot, &settings.load.load());
    let noise = Noise::named(noise)?;
    let deviations = cdpr_calibration::drawn(&model, settings.seed);
    let markers: Vec<Vector3<f64>> = settings.markers.iter().map(|marker| Vector3::from(*marker)).collect();
    questions::about_markers(&robot, markers.iter().copied());
    let errors = sensor_errors(&settings.unknown)?;
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
        tension_at: match settings.tension_at {
            CellsAt::Platform => CableEnd::Anchor,
            CellsAt::Winch => CableEnd::Exit,
        },
        seed: settings.seed,
    })?;
    let (header, lines) = write_measurements(&rows);
    let mut text = header.join(",") + "\n";
    lines.iter().for_each(|line| text += &(line.join(",") + "\n"));
    let truth = robot.perturbed(&deviations).map_err(cdpr_calibration::CalibrationError::from)?.robot;
    let truth = truth.to_json() + "\n";
    let truth = settings.truth.iter().map(|path| (path.as_path(), truth.as_str()));
    let files: Vec<_> = truth.chain([(settings.out.as_path(), text.as_str())]).collect();
    settings.overwrite.write_all(&files)?;
    let [rows, poses] = [counted(rows.len(), "row"), counted(poses.len(), "pose")];
    println!("{}: {rows} at {poses}", settings.out.display());
    Ok(())
}
