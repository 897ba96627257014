//! `cdpr simulate`: how a robot moves after events.

mod answer;

use self::answer::Answer;
use crate::program::arguments::poses::PoseArguments;
use crate::program::arguments::{
    self, FigureArgument, FreeArguments, Lengths, LoadArguments, Preference, Printing, RobotArgument, With,
};
use crate::program::error::ProgramError;
use crate::program::lists::winch_file;
use crate::program::output::{Ending, patiently};
use crate::program::pose::modes::with_inertia;
use crate::program::questions;
use cdpr_dynamics::DynamicsError;
use cdpr_dynamics::simulate::{
    Change, Discretization, Event, Sample, Series, Settings as Timing, WinchLengths, events_from_json,
    simulate,
};
use cdpr_report::{Quantity, Sheet, over_time};
use cdpr_robot::{Pose, Robot, rounded, shown};
use cdpr_statics::{DirectProblem, DirectStart, WantedPose, inverse, rough_pose};
use cdpr_study::{InputKind, read_text};
use serde::Serialize;
use std::f64::consts::PI;
use std::path::PathBuf;

/// Samples of a motion, at least; those that are not wanted are left out of the series.
const FEWEST: f64 = 100.0;

/// A robot at rest, what happens to it, and for how long it is followed.
#[derive(clap::Args)]
pub(crate) struct Settings {
    #[command(flatten)]
    robot: RobotArgument,
    #[command(flatten)]
    pose: PoseArguments,
    #[command(flatten)]
    free: FreeArguments,
    /// Unstrained lengths of the cables, in the order of the file: l1,..,ln [m], or a table of them over
    /// time, as `path --with seconds=1` writes it: t_s,length_1_m,..,length_n_m. The search for their pose
    /// starts from --pose, or where straight cables would hold a point.
    #[arg(long, value_name = "LENGTHS", value_parser = arguments::lengths, allow_hyphen_values = true)]
    lengths: Option<Lengths>,
    #[command(flatten)]
    load: LoadArguments,
    #[command(flatten)]
    preference: Preference,
    /// What happens: JSON, a list of objects with a time `t` [s] and one change; - for the standard input.
    ///
    /// {"t": 0, "payload": -50} [kg], {"t": 0, "cut": 1, "at": "anchor"} or "exit",
    /// {"t": 0, "force": [100, 0, 0], "moment": [0, 0, 0]} [N, N m],
    /// {"t": 0, "displace": [dx, dy, dz, rx, ry, rz]} [m, rad],
    /// {"t": 0, "shorten": {"cable": 1, "by": 0.003, "over": 0.2, "profile": "cosine"}} [m, s],
    /// {"t": 0, "lengths": {"times": [0, 0.1, ..], "lengths": [[l1, .., ln], ..]}} [s, m].
    #[arg(long, value_name = "FILE")]
    events: Option<PathBuf>,
    /// How long the motion is followed [s].
    #[arg(long, value_name = "SECONDS", value_parser = arguments::number, allow_negative_numbers = true)]
    until: f64,
    /// Samples for each second [Hz].
    #[arg(long, value_name = "HZ", value_parser = arguments::number, default_value = "100",
        allow_negative_numbers = true)]
    rate: f64,
    /// Damping of the cables: the ratio of their viscous to their elastic modulus [s].
    #[arg(long, value_name = "SECONDS", value_parser = arguments::number, default_value = "0",
        allow_negative_numbers = true)]
    damping: f64,
    /// Settings of the computation: elements=N of each cable, degree=N of the polynomial on each,
    /// tolerance=M, the error of a step [m].
    #[arg(long, value_name = "NAMES", value_parser = arguments::with)]
    with: Option<With>,
    /// File for a figure of motion and tensions over time (.svg, .pdf, .png); behind its name: width=MM,
    /// untitled.
    #[arg(long, value_name = "FILE", value_parser = arguments::figure)]
    figure: Option<FigureArgument>,
    #[command(flatten)]
    printing: Printing,
}

pub(crate) fn run(settings: &Settings) -> Result<Ending, ProgramError> {
    let how = settings.how()?;
    let mut events = Vec::new();
    if let Some(file) = &settings.events {
        let text = read_text(file, InputKind::Events)?;
        events = events_from_json(&text).map_err(ProgramError::in_file(file))?;
    } else if !matches!(settings.lengths, Some(Lengths::Table(_))) {
        let missing = "expected --events, a file, or --lengths, a table of them over time";
        return Err(ProgramError::Usage(missing.to_owned()));
    }
    let robot = settings.preference.open_robot(settings.robot.path())?;
    let load = settings.load.load();
    questions::about_load(&robot, &load);
    let robot = with_inertia(&robot);
    let (lengths, start, over_time) = settings.lengths(&robot)?;
    // In the order of the file, so that errors have its numbers.
    events.extend(over_time.map(|lengths| Event { time: 0.0, change: Change::Lengths(lengths) }));
    let problem = DirectProblem::new(&robot, &lengths, &load)?;
    let rest = problem.direct(DirectStart::Pose(&start))?;
    if settings.lengths.is_some() {
        let stated = settings.pose.given()?;
        questions::about_rest(&robot, "the equilibrium", (&lengths, &load), &rest, stated.as_ref());
    }
    let rest = rest.equilibrium;
    questions::about_events(&events, load.payload, how.until);
    // Between few samples a coarser computation would differ unseen.
    let finer = (FEWEST / (how.until * how.rate)).ceil().clamp(1.0, 1e12);
    let how = Timing { rate: finer * how.rate, ..how };
    let found = patiently("simulating", || simulate(&problem, &rest, &events, &how));
    let mut series = found.map_err(|error| match error {
        DynamicsError::Event { index, .. } => match (&settings.events, &settings.lengths) {
            (_, Some(Lengths::Table(file))) if index + 1 == events.len() => {
                ProgramError::in_file(file)(error)
            }
            (Some(file), _) => ProgramError::in_file(file)(error),
            _ => error.into(),
        },
        error => error.into(),
    })?;
    questions::about_strain(&robot, &series);
    let answer = Answer::new(&robot, &rest.pose, (&lengths, &events), &series);
    series.samples = series.samples.into_iter().step_by(finer as usize).collect();
    if let Some(file) = &settings.figure {
        file.write(&settings.printing.overwrite, |sheet| figure(&robot, &rest.pose, &series, sheet))?;
    }
    let records = series.samples.iter().map(|sample| record(&rest.pose, sample)).collect();
    let text = || answer.print(&shown(&robot.name), &rest.pose, settings.until);
    let whole = |samples| Whole { answer: &answer, samples };
    settings.printing.with_table(&answer.columns, records, whole, text)?;
    Ok(answer.ending())
}

impl Settings {
    fn how(&self) -> Result<Timing, ProgramError> {
        let with = With::known(self.with.as_ref(), &["elements", "degree", "tolerance"])?;
        let elements = with.value("elements", None, arguments::count::<1, 1000>)?;
        let degree = with.value("degree", None, arguments::count::<1, 64>)?;
        let usual = Discretization::TAUT;
        let discretization = (elements.is_some() || degree.is_some()).then(|| Discretization {
            elements: elements.unwrap_or(usual.elements),
            degree: degree.unwrap_or(usual.degree),
        });
        let usual = Timing::until(self.until);
        let tolerance = with.value("tolerance", None, arguments::number)?.unwrap_or(usual.tolerance);
        Ok(Timing { rate: self.rate, damping: self.damping, discretization, tolerance, ..usual })
    }

    /// The unstrained lengths [m], where their pose is searched for, and the lengths over time.
    fn lengths(&self, robot: &Robot) -> Result<AtBegin, ProgramError> {
        let mut over_time = None;
        let table = |file: &PathBuf| winch_file(file, robot.cables.len());
        let Some(given) = &self.lengths else {
            let pose = self.pose.needed()?;
            questions::about_pose(robot, "--pose", &pose);
            let held = inverse(robot, WantedPose::at(&pose).free(&self.free.free), &self.load.load())?;
            return Ok((held.lengths, held.equilibrium.pose, None));
        };
        let lengths = match given {
            Lengths::Listed(lengths) => lengths.clone(),
            Lengths::Table(file) => {
                let found = table(file)?;
                let first = (0..found.cables()).map(|cable| found.at(cable, 0.0)[0]).collect();
                over_time = Some(found);
                first
            }
        };
        questions::about_lengths(robot, &lengths);
        cdpr_statics::check_lengths(robot, &lengths)?;
        let start = self.pose.given()?.unwrap_or_else(|| rough_pose(robot, &lengths));
        Ok((lengths, start, over_time))
    }
}

/// Lengths at the begin [m], a pose near theirs, and the lengths over time.
type AtBegin = (Vec<f64>, Pose, Option<WinchLengths>);

/// A sample as a row: time, motion from the rest, tensions, orientation.
fn record(rest: &Pose, sample: &Sample) -> Vec<f64> {
    let turn = rest.motion_to(&sample.pose).fixed_rows::<3>(3).into_owned();
    let place = sample.pose.position.iter().chain(turn.iter()).copied();
    let tensions = sample.tensions.iter().flatten().copied();
    [sample.time].into_iter().chain(place).chain(tensions).chain(sample.pose.quaternion()).collect()
}

/// Motion of P and turn from the rest, and tensions at the platform, over the time.
fn figure(robot: &Robot, rest: &Pose, series: &Series, sheet: Sheet) -> Result<String, ProgramError> {
    let curve = |name: String, of: &dyn Fn(&Sample) -> f64| {
        (name, series.samples.iter().map(|sample| (sample.time, of(sample))).collect())
    };
    let motion = |label: &str, first: usize, scale: f64| Quantity {
        label: label.to_owned(),
        curves: ["x", "y", "z"]
            .iter()
            .zip(first..)
            .map(|(name, k)| curve((*name).to_owned(), &|sample| scale * rest.motion_to(&sample.pose)[k]))
            .collect(),
    };
    let of_cable = |i: usize| curve(format!("cable {}", i + 1), &|sample| sample.tensions[i][1]);
    let tensions = Quantity {
        label: "tension at the platform [N]".to_owned(),
        curves: (0..robot.cables.len()).map(of_cable).collect(),
    };
    // A point mass does not turn.
    let turn = (!robot.platform.point).then(|| motion("rotation vector [deg]", 3, 180.0 / PI));
    let quantities: Vec<Quantity> =
        [motion("from the rest [mm]", 0, 1e3)].into_iter().chain(turn).chain([tensions]).collect();
    let title = format!("Motion of {}", shown(&robot.name));
    let [x, y, z] = <[f64; 3]>::from(rest.position).map(|value| rounded(value, 4));
    let lines = [format!("from rest at ({x}, {y}, {z}) m")];
    Ok(over_time(&title, &lines, &quantities, sheet)?)
}

#[derive(Serialize)]
struct Whole<'a> {
    #[serde(flatten)]
    answer: &'a Answer,
    #[serde(skip_serializing_if = "Vec::is_empty")]
    samples: Vec<Vec<f64>>,
}
