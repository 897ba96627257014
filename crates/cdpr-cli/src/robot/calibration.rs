//! `cdpr calibration`: the combinations of parameters that measurements identify, and the best poses.

use crate::arguments::{self, Format, Named, Preference};
use crate::error::ProgramError;
use crate::output::{patiently, progress, table};
use crate::poses;
use cdpr_robot::{Pose, Robot, rounded, shown};
use cdpr_statics::{Calibration, Combination, Identifiability, Load, Measurement, ParameterValue};
use cdpr_study::Grid;
use serde::Serialize;
use std::collections::BTreeMap;
use std::path::PathBuf;

/// The robot, the candidate poses and the measurements.
#[derive(clap::Args)]
#[command(group = clap::ArgGroup::new("where").required(true).args(["poses", "grid"]))]
pub(crate) struct Settings {
    /// Robot file (JSON, `cdpr-robot/1`).
    robot: PathBuf,
    /// File of candidate poses (CSV): x_m,y_m,z_m, then qw,qx,qy,qz or roll_deg,pitch_deg,yaw_deg or nothing.
    #[arg(long)]
    poses: Option<PathBuf>,
    /// Grid of candidate positions, min:max:points of each axis: -2:2:5,-1:1:3,0.5:2.5:3.
    #[arg(long, value_parser = arguments::grid, allow_hyphen_values = true)]
    grid: Option<Grid>,
    /// Standard deviations of the uncertain parameters or groups of them, SI units: a=0.001,b=0.001,mass=0.5.
    ///
    /// All other parameters are known.
    #[arg(long, value_parser = arguments::named)]
    uncertainty: Named,
    /// What is measured, with its noise, such as position=1e-4,rotation=1e-4.
    ///
    /// Position [m] and rotation [rad] go together; others are tensions [N] and lengths [m].
    #[arg(long, value_parser = arguments::named)]
    noise: Named,
    /// Known mass added at the platform's centre of mass [kg].
    #[arg(long, value_parser = arguments::mass, default_value = "0", allow_hyphen_values = true)]
    payload: f64,
    #[command(flatten)]
    preference: Preference,
    /// Number of poses to choose.
    #[arg(long, default_value_t = 10)]
    choose: usize,
    /// How the results are printed.
    #[arg(long, value_enum, default_value_t = Format::Text)]
    format: Format,
}

pub(crate) fn run(settings: &Settings) -> Result<(), ProgramError> {
    let robot = settings.preference.open_robot(&settings.robot)?;
    let candidates = match (&settings.grid, &settings.poses) {
        (Some(grid), _) => grid.poses(),
        (None, Some(path)) => poses::pose_file(path)?,
        (None, None) => return Err(ProgramError::Usage("expected --poses or --grid".to_owned())),
    };
    let measurements = measurements(&settings.noise)?;
    let mut calibration =
        Calibration::new(&robot, &arguments::uncertainties(&robot, &settings.uncertainty)?)?;
    let (mut poses, mut refused) = (Vec::new(), BTreeMap::new());
    let bar = progress(candidates.len(), "poses");
    for pose in candidates {
        bar.inc(1);
        match calibration.add(&pose, &Load::payload(settings.payload), &measurements) {
            Ok(()) => poses.push(pose),
            // Noise and payload are the same at all poses: an invalid one is no property of a pose.
            Err(error) if error.kind() == "invalid_input" => return Err(error.into()),
            Err(error) => *refused.entry(error.kind()).or_insert(0) += 1,
        }
    }
    bar.finish_and_clear();
    if poses.is_empty() {
        let reasons: Vec<_> = refused.iter().map(|(kind, count)| format!("{count} {kind}")).collect();
        return Err(ProgramError::NoPoseHeld { reasons: reasons.join(", ") });
    }
    let output = patiently("choosing poses", || {
        let found = calibration.identify(0..poses.len());
        Output::new(poses, refused, &found, &calibration, settings.choose)
    });
    Ok(settings.format.print(&output, |output| print(&robot, output))?)
}

fn measurements(Named(named): &Named) -> Result<Vec<Measurement>, ProgramError> {
    let of = |name: &str| named.iter().find(|(given, _)| given == name).map(|(_, value)| *value);
    let pose = match (of("position"), of("rotation")) {
        (Some(position), Some(rotation)) => Some(Measurement::Pose { position, rotation }),
        (None, None) => None,
        _ => return Err(ProgramError::Usage("--noise: expected position and rotation together".to_owned())),
    };
    let all = ["position", "rotation", "tensions", "lengths"];
    if let Some((name, value)) = named.iter().find(|(name, _)| !all.contains(&name.as_str())) {
        return Err(ProgramError::Usage(format!(
            "--noise {name}={value}: expected one of {}",
            all.join(", ")
        )));
    }
    let others = [of("tensions").map(Measurement::Tensions), of("lengths").map(Measurement::Lengths)];
    Ok(pose.into_iter().chain(others.into_iter().flatten()).collect())
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
    println!("{}: measured at {} poses", shown(&robot.name), output.poses);
    for (reason, count) in &output.refused {
        println!("{count} poses left out: {reason}");
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
