//! `cdpr calibration`: what measurements identify, the poses to measure, and what a campaign would read.

use crate::arguments::{self, Format, FreeArguments, LoadArguments, Named, Preference};
use crate::error::ProgramError;
use crate::output::{patiently, progress, table};
use crate::poses;
use crate::robot::calibrate::{Sought, sensor_errors};
use cdpr_calibration::{
    AtWork, Calibration, Combination, Criterion, Identifiability, Measurement, Noise, ParameterValue,
    PosePlan, Quality, SensorError, Simulated, drawn_errors, simulate, write_measurements,
};
use cdpr_robot::{CableEnd, Parameter, Pose, Robot, Vector3, rounded, shown};
use cdpr_statics::Load;
use cdpr_study::{ErrorModel, Grid, write_text};
use clap::Subcommand;
use serde::Serialize;
use std::collections::BTreeMap;
use std::path::PathBuf;

#[derive(Subcommand)]
pub(crate) enum Command {
    /// Find the combinations of parameters that measurements identify, and the poses that identify most.
    #[command(after_help = "Example: cdpr calibration identify caroca --grid=-2:2:5,-1:1:3,1:2.5:3 \
                      --uncertainty a=0.002,b=0.002,youngs_modulus=5e9 --noise position=1e-4,rotation=1e-4")]
    Identify(Box<Settings>),
    /// Choose the poses that together leave least uncertainty, beside random and outermost ones.
    #[command(after_help = "Example: cdpr calibration plan caroca --grid=-2:2:5,-1:1:3,1:2.5:3 \
                      --uncertainty a=0.002,b=0.002,youngs_modulus=5e9 --noise position=1e-4,rotation=1e-4 \
                      --work=-1:1:3,-1:1:3,1.5:2:2 --criterion mean-at-work --count 20")]
    Plan(Box<PlanSettings>),
    /// Write what the sensors of a robot with deviations drawn from its tolerances would read.
    #[command(after_help = "Example: cdpr calibration simulate caroca --grid=-2:2:5,-1:1:3,1:2.5:3 \
                      --model tolerances.json --noise position=1e-4,rotation=1e-4,length=1e-4 --seed 1 \
                      --out measurements.csv")]
    Simulate(Box<SimulateSettings>),
}

/// Where a robot may be measured.
#[derive(clap::Args)]
#[command(group = clap::ArgGroup::new("where").required(true).args(["poses", "grid"]))]
pub(crate) struct Candidates {
    /// File of candidate poses (CSV): x_m,y_m,z_m, then qw,qx,qy,qz or roll_deg,pitch_deg,yaw_deg or nothing.
    #[arg(long)]
    poses: Option<PathBuf>,
    /// Grid of candidate positions, min:max:points of each axis: -2:2:5,-1:1:3,0.5:2.5:3.
    #[arg(long, value_parser = arguments::grid, allow_hyphen_values = true)]
    grid: Option<Grid>,
}

impl Candidates {
    fn read(&self) -> Result<Vec<Pose>, ProgramError> {
        match (&self.grid, &self.poses) {
            (Some(grid), _) => Ok(grid.poses()),
            (None, Some(path)) => poses::pose_file(path),
            (None, None) => Err(ProgramError::Usage("expected --poses or --grid".to_owned())),
        }
    }
}

/// The robot, the candidate poses and the measurements.
#[derive(clap::Args)]
pub(crate) struct Settings {
    /// Robot file (JSON, `cdpr-robot/1`).
    robot: PathBuf,
    #[command(flatten)]
    candidates: Candidates,
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
    free: FreeArguments,
    #[command(flatten)]
    preference: Preference,
    /// Number of poses to choose.
    #[arg(long, default_value_t = 10)]
    choose: usize,
    /// How the results are printed.
    #[arg(long, value_enum, default_value_t = Format::Text)]
    format: Format,
}

/// The robot, the candidates, and what is to be exact.
#[derive(clap::Args)]
pub(crate) struct PlanSettings {
    /// Robot file (JSON, `cdpr-robot/1`).
    robot: PathBuf,
    #[command(flatten)]
    candidates: Candidates,
    /// Standard deviations of the uncertain parameters or groups of them, in place of --model.
    #[arg(long, value_parser = arguments::named, conflicts_with = "model", required_unless_present = "model")]
    uncertainty: Option<Named>,
    #[command(flatten)]
    sought: Sought,
    /// What is measured, with its noise, such as position=1e-4,rotation=1e-4, tensions=5, lengths=1e-3.
    #[arg(long, value_parser = arguments::named)]
    noise: Named,
    /// Number of poses.
    #[arg(long, default_value_t = 20)]
    count: usize,
    /// What the set is to be best in.
    #[arg(long, value_enum, default_value_t = CriterionName::Information)]
    criterion: CriterionName,
    /// Positions where the robot works, min:max:points of each axis.
    #[arg(long, value_parser = arguments::grid, allow_hyphen_values = true)]
    work: Option<Grid>,
    /// What is to be exact there: the position with given lengths, or the deflection by the load.
    #[arg(long, value_enum, default_value_t = OfWork::Position)]
    of: OfWork,
    /// How exact it is to be there, the standard deviation of a coordinate [m]: how many poses does that
    /// take?
    #[arg(long, value_parser = arguments::payload, requires = "work")]
    accuracy: Option<f64>,
    #[command(flatten)]
    load: LoadArguments,
    #[command(flatten)]
    free: FreeArguments,
    #[command(flatten)]
    preference: Preference,
    /// Seed of the random sets beside it.
    #[arg(long, default_value_t = 1)]
    seed: u64,
    /// File for the poses (CSV), as --poses reads them.
    #[arg(long)]
    out: Option<PathBuf>,
    /// How the results are printed.
    #[arg(long, value_enum, default_value_t = Format::Text)]
    format: Format,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, clap::ValueEnum)]
enum CriterionName {
    /// Information about all parameters together (D-optimal).
    Information,
    /// Mean variance of the parameters (A-optimal).
    Parameters,
    /// Mean variance where the robot works.
    MeanAtWork,
    /// Greatest variance where the robot works (G-optimal).
    WorstAtWork,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, clap::ValueEnum)]
enum OfWork {
    Position,
    Deflection,
}

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
    #[arg(long)]
    seed: u64,
    /// File for the measurements (CSV).
    #[arg(long)]
    out: PathBuf,
    /// File for the robot as it truly is (JSON).
    #[arg(long)]
    truth: Option<PathBuf>,
}

pub(crate) fn run(command: &Command) -> Result<(), ProgramError> {
    match command {
        Command::Identify(settings) => identify(settings),
        Command::Plan(settings) => plan(settings),
        Command::Simulate(settings) => simulated(settings),
    }
}

/// Adds the candidates that the robot holds; the others are counted by the reason.
fn add(
    calibration: &mut Calibration,
    candidates: Vec<Pose>,
    load: &Load,
    measurements: &[Measurement],
) -> Result<(Vec<Pose>, BTreeMap<&'static str, usize>), ProgramError> {
    let (mut poses, mut refused) = (Vec::new(), BTreeMap::new());
    let bar = progress(candidates.len(), "poses");
    for pose in candidates {
        bar.inc(1);
        match calibration.add(&pose, load, measurements) {
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
    Ok((poses, refused))
}

fn identify(settings: &Settings) -> Result<(), ProgramError> {
    let robot = settings.preference.open_robot(&settings.robot)?;
    let candidates = settings.candidates.read()?;
    let measurements = measurements(&settings.noise)?;
    let uncertainties = arguments::uncertainties(&robot, &settings.uncertainty)?;
    let mut calibration = Calibration::new(&robot, &uncertainties)?.with_free(&settings.free.free);
    let load = Load::payload(settings.payload);
    let (poses, refused) = add(&mut calibration, candidates, &load, &measurements)?;
    let output = patiently("choosing poses", || {
        let found = calibration.identify(0..poses.len());
        Output::new(poses, refused, &found, &calibration, settings.choose)
    });
    Ok(settings.format.print(&output, |output| print(&robot, output))?)
}

/// The standard deviation of each parameter by an error model; correlations do not count.
fn deviations(robot: &Robot, model: &ErrorModel) -> Vec<f64> {
    let mut variances = vec![0.0; Parameter::of(robot).len()];
    for term in &model.terms {
        variances[term.parameter] += (term.factor * model.inputs[term.input].law.std()).powi(2);
    }
    variances.iter().map(|variance: &f64| variance.sqrt()).collect()
}

fn plan(settings: &PlanSettings) -> Result<(), ProgramError> {
    let robot = settings.preference.open_robot(&settings.robot)?;
    let candidates = settings.candidates.read()?;
    let measurements = measurements(&settings.noise)?;
    let uncertainties = match (&settings.uncertainty, settings.sought.prior(&robot)?) {
        (Some(named), _) => arguments::uncertainties(&robot, named)?,
        (None, Some(model)) => deviations(&robot, &model),
        (None, None) => return Err(ProgramError::Usage("expected --model or --uncertainty".to_owned())),
    };
    let criterion = match settings.criterion {
        CriterionName::Information => Criterion::Information,
        CriterionName::Parameters => Criterion::Parameters,
        CriterionName::MeanAtWork => Criterion::MeanAtWork,
        CriterionName::WorstAtWork => Criterion::WorstAtWork,
    };
    let at_work = matches!(criterion, Criterion::MeanAtWork | Criterion::WorstAtWork);
    if at_work && settings.work.is_none() {
        return Err(ProgramError::Usage(
            "--criterion at work: expected --work, where the robot works".to_owned(),
        ));
    }
    let mut calibration = Calibration::new(&robot, &uncertainties)?.with_free(&settings.free.free);
    let load = settings.load.load();
    let (poses, refused) = add(&mut calibration, candidates, &load, &measurements)?;
    let of = match settings.of {
        OfWork::Position => AtWork::Position,
        OfWork::Deflection => AtWork::Deflection,
    };
    let work = settings.work.map(|grid| grid.poses()).unwrap_or_default();
    let worked = work.iter().filter(|pose| calibration.add_work(pose, &load, of).is_ok()).count();
    if at_work && worked == 0 {
        return Err(ProgramError::NoPoseHeld { reasons: "none of --work is held".to_owned() });
    }
    let found = patiently("choosing poses", || calibration.plan(settings.count, criterion, settings.seed));
    if let Some(out) = &settings.out {
        let lines: Vec<String> = found
            .poses
            .iter()
            .map(|pose| poses::pose_numbers(&poses[*pose]).map(|number| number.to_string()).join(","))
            .collect();
        write_text(out, &format!("{}\n{}\n", poses::COLUMNS.join(","), lines.join("\n")), "x_m,y_m,z_m")?;
    }
    let output = Plan::new(&poses, refused, found, settings.accuracy);
    Ok(settings.format.print(&output, |output| print_plan(&robot, output))?)
}

fn simulated(settings: &SimulateSettings) -> Result<(), ProgramError> {
    let robot = settings.preference.open_robot(&settings.robot)?;
    let poses = settings.candidates.read()?;
    let Some(model) = settings.sought.prior(&robot)? else {
        return Err(ProgramError::Usage(
            "expected --model, the tolerances to draw deviations from".to_owned(),
        ));
    };
    let Named(noise) = &settings.noise;
    let noise = Noise::named(noise)?;
    let deviations = cdpr_calibration::drawn(&model, settings.seed);
    let markers: Vec<Vector3<f64>> = settings.markers.iter().map(|marker| Vector3::from(*marker)).collect();
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
    write_text(&settings.out, &text, "l1_m,")?;
    if let Some(path) = &settings.truth {
        let truth = robot.perturbed(&deviations).map_err(cdpr_calibration::CalibrationError::from)?.robot;
        write_text(path, &(truth.to_json() + "\n"), cdpr_robot::FORMAT)?;
    }
    println!("{}: {} rows at {} poses", settings.out.display(), rows.len(), poses.len());
    Ok(())
}

/// A plan as it is printed.
#[derive(Serialize)]
struct Plan {
    /// Poses that the robot holds.
    candidates: usize,
    refused: BTreeMap<&'static str, usize>,
    /// x, y, z [m], qw, qx, qy, qz.
    poses: Vec<[f64; 7]>,
    plan: Left,
    random: Left,
    outermost: Left,
    /// With the first 1, 2, 3, ... poses of a set that grows one by one.
    growing: Vec<Left>,
    /// Poses that reach the accuracy; none where more are needed.
    #[serde(skip_serializing_if = "Option::is_none")]
    needed: Option<Option<usize>>,
}

/// What a set of poses leaves.
#[derive(Clone, Copy, Serialize)]
struct Left {
    information_bits: f64,
    parameters: f64,
    mean_at_work: Option<f64>,
    worst_at_work: Option<f64>,
}

impl From<Quality> for Left {
    fn from(of: Quality) -> Self {
        let Quality { information, parameters, mean_at_work, worst_at_work } = of;
        Self { information_bits: information, parameters, mean_at_work, worst_at_work }
    }
}

impl Plan {
    fn new(
        poses: &[Pose],
        refused: BTreeMap<&'static str, usize>,
        found: PosePlan,
        accuracy: Option<f64>,
    ) -> Self {
        let needed = accuracy.map(|accuracy| {
            let reached = |of: &Quality| of.mean_at_work.is_some_and(|std| std <= accuracy);
            found.growing.iter().position(reached).map(|k| k + 1)
        });
        Self {
            candidates: poses.len(),
            refused,
            poses: found.poses.iter().map(|pose| poses::pose_numbers(&poses[*pose])).collect(),
            plan: found.quality.into(),
            random: found.random.into(),
            outermost: found.corners.into(),
            growing: found.growing.into_iter().map(Left::from).collect(),
            needed,
        }
    }
}

fn print_plan(robot: &Robot, output: &Plan) {
    let count = output.poses.len();
    println!("{}: {count} of {} poses", shown(&robot.name), output.candidates);
    for (reason, count) in &output.refused {
        println!("{count} poses left out: {reason}");
    }
    let mut rows = table(&[
        "set of poses",
        "information [bit]",
        "std of parameters left [%]",
        "mean std at work [mm]",
        "worst [mm]",
    ]);
    let millimetres =
        |std: Option<f64>| std.map_or_else(|| "-".to_owned(), |std| format!("{:.4}", 1e3 * std));
    let mut add = |name: String, of: &Left| {
        rows.add_row([
            name,
            format!("{:.2}", of.information_bits),
            format!("{:.2}", 100.0 * of.parameters),
            millimetres(of.mean_at_work),
            millimetres(of.worst_at_work),
        ]);
    };
    add("planned".to_owned(), &output.plan);
    add("random, median".to_owned(), &output.random);
    add("outermost".to_owned(), &output.outermost);
    for (k, of) in output.growing.iter().enumerate().filter(|(k, _)| (k + 1).is_power_of_two()) {
        add(format!("growing, {}", k + 1), of);
    }
    println!("{rows}");
    match output.needed {
        Some(Some(needed)) => println!("{needed} poses reach the accuracy"),
        Some(None) => println!("{count} poses do not reach the accuracy"),
        None => {}
    }
    let mut rows = table(&["x, y, z [m], qw, qx, qy, qz"]);
    for pose in &output.poses {
        rows.add_row([pose.map(|number| rounded(number, 6).to_string()).join(", ")]);
    }
    println!("{rows}");
}

fn measurements(Named(named): &Named) -> Result<Vec<Measurement>, ProgramError> {
    Measurement::named(named).map_err(|error| ProgramError::Usage(format!("--{error}")))
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
