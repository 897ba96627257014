//! `cdpr simulate`: how a robot moves after events.

use crate::program::answer::OutOfLimits;
use crate::program::arguments::poses::{PoseArguments, pose_numbers};
use crate::program::arguments::{
    self, FigureArgument, FreeArguments, Lengths, LoadArguments, Preference, Printing, RobotArgument, With,
};
use crate::program::error::ProgramError;
use crate::program::lists::winch_file;
use crate::program::output::{Ending, patiently, print_sentence, table};
use crate::program::pose::modes::with_inertia;
use crate::program::questions;
use cdpr_dynamics::DynamicsError;
use cdpr_dynamics::simulate::{
    Change, Discretization, Event, Excursion, Sample, Series, Settings as Timing, WinchLengths,
    events_from_json, simulate,
};
use cdpr_report::{Quantity, over_time};
use cdpr_robot::{Pose, Robot, counted, rounded, shown, significant};
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
    /// Unstrained lengths of the cables, in the order of the file: l1,..,ln [m], or a table of them over time,
    /// as `path --with seconds=1` writes it: t_s,length_1_m,..,length_n_m. The search for their pose starts
    /// from --pose, or where straight cables would hold a point.
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
    /// File for a figure of motion and tensions over time (.svg, .pdf, .png); behind its name: width=MM, untitled.
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
        questions::about_rest(&robot, "the equilibrium", (&lengths, &load), &rest, &start);
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
    let answer = Answer::new(&robot, &rest.pose, &lengths, &series);
    series.samples = series.samples.into_iter().step_by(finer as usize).collect();
    if let Some(file) = &settings.figure {
        file.write(&settings.printing.overwrite, &figure(&robot, &rest.pose, &series)?)?;
    }
    let records = series.samples.iter().map(|sample| record(&rest.pose, sample)).collect();
    let text = || answer.print(&shown(&robot.name), &rest.pose, settings.until);
    let whole = |samples| Whole { answer: &answer, samples };
    settings.printing.with_table(&answer.columns, records, whole, text)?;
    Ok(answer.ending())
}

impl Settings {
    fn how(&self) -> Result<Timing, ProgramError> {
        let with = self.with.clone().unwrap_or_default();
        with.check(&["elements", "degree", "tolerance"])?;
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
fn figure(robot: &Robot, rest: &Pose, series: &Series) -> Result<String, ProgramError> {
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
    let quantities =
        [motion("from the rest [mm]", 0, 1e3), motion("rotation vector [deg]", 3, 180.0 / PI), tensions];
    let title = format!("Motion of {}", shown(&robot.name));
    let [x, y, z] = <[f64; 3]>::from(rest.position).map(|value| rounded(value, 4));
    let lines = [format!("from rest at ({x}, {y}, {z}) m")];
    Ok(over_time(&title, &lines, &quantities)?)
}

/// What a motion is as a whole.
#[derive(Serialize)]
struct Answer {
    /// Pose at rest, and unstrained lengths [m].
    start: [f64; 7],
    lengths: Vec<f64>,
    /// Greatest distance of P from its rest [m], when [s], and the greatest rotation from the rest [rad].
    greatest_distance_m: f64,
    at_s: f64,
    greatest_rotation_rad: f64,
    /// Greatest distance of P from its mean place in the last quarter of the time [m].
    swing_m: f64,
    cables: Vec<CableAnswer>,
    /// Greatest differences to a coarser computation.
    difference: Difference,
    energy: Energy,
    /// Elements of each cable at the end, and the degree of the polynomial on them.
    elements: Vec<usize>,
    degree: Vec<usize>,
    steps: usize,
    columns: Vec<String>,
}

#[derive(Serialize)]
struct Whole<'a> {
    #[serde(flatten)]
    answer: &'a Answer,
    #[serde(skip_serializing_if = "Vec::is_empty")]
    samples: Vec<Vec<f64>>,
}

#[derive(Serialize)]
struct CableAnswer {
    /// At the begin and at most, at the end that is pulled more.
    rest_n: f64,
    greatest_n: f64,
    at_s: f64,
    /// Whether it carries no tension at a point at some time.
    slack: bool,
    /// What the greatest tension is above: a breaking force or a greatest tension [N].
    #[serde(skip_serializing_if = "Option::is_none")]
    above: Option<Above>,
}

#[derive(Clone, Copy, Serialize)]
struct Above {
    limit: &'static str,
    value_n: f64,
}

#[derive(Serialize)]
struct Difference {
    position_m: f64,
    rotation_rad: f64,
    tension_n: f64,
}

#[derive(Serialize)]
struct Energy {
    /// Greatest kinetic energy.
    kinetic_j: f64,
    /// Work of winches and forces, with the energy of what came and went.
    given_j: f64,
    /// What damping took.
    lost_j: f64,
    /// What is missing or too much at the end.
    drift_j: f64,
}

impl Answer {
    fn new(robot: &Robot, rest: &Pose, lengths: &[f64], series: &Series) -> Self {
        let ends = series.end_peaks.iter().map(|[exit, anchor]| [*anchor, *exit]).collect();
        let beyond = OutOfLimits::of_tensions(robot, &[ends]);
        let above = |i: usize| {
            let of_cable = beyond.iter().filter(|one| one.cable == i + 1 && one.is_too_much());
            let first = of_cable.min_by_key(|one| one.limit != "breaking_force")?;
            let limit = if first.limit == "breaking_force" { first.limit } else { "tension_limits.max" };
            Some(Above { limit, value_n: first.value })
        };
        let cables = series.peaks.iter().enumerate().map(|(i, (peak, at))| {
            let [exit, anchor] = series.samples[0].tensions[i];
            CableAnswer {
                rest_n: exit.max(anchor),
                greatest_n: *peak,
                at_s: *at,
                slack: series.slack[i],
                above: above(i),
            }
        });
        let pose = ["t_s", "x_m", "y_m", "z_m", "rx_rad", "ry_rad", "rz_rad"].map(str::to_owned);
        let tensions = (1..=lengths.len()).flat_map(|i| [format!("t_exit_{i}_n"), format!("t_anchor_{i}_n")]);
        let cdpr_dynamics::simulate::Difference { position, rotation: turn, tension } = series.difference;
        let cdpr_dynamics::simulate::Energy { kinetic, given, lost, drift } = series.energy;
        let Excursion { distance, time, rotation, swing } = series.excursion;
        Self {
            start: pose_numbers(rest),
            lengths: lengths.to_vec(),
            greatest_distance_m: distance,
            at_s: time,
            greatest_rotation_rad: rotation,
            swing_m: swing,
            cables: cables.collect(),
            difference: Difference { position_m: position, rotation_rad: turn, tension_n: tension },
            energy: Energy { kinetic_j: kinetic, given_j: given, lost_j: lost, drift_j: drift },
            elements: series.discretizations.iter().map(|of| of.elements).collect(),
            degree: series.discretizations.iter().map(|of| of.degree).collect(),
            steps: series.work.steps,
            columns: pose
                .into_iter()
                .chain(tensions)
                .chain(["qw", "qx", "qy", "qz"].map(str::to_owned))
                .collect(),
        }
    }

    fn ending(&self) -> Ending {
        let is_well = self.cables.iter().all(|cable| cable.above.is_none());
        if is_well { Ending::Well } else { Ending::SomethingWrong }
    }

    fn print(&self, name: &str, rest: &Pose, until: f64) {
        let mm = |metres: f64| significant(1e3 * metres, 3);
        let [x, y, z] = <[f64; 3]>::from(rest.position).map(|value| rounded(value, 4));
        let turned = significant(rest.rotation.angle().to_degrees(), 3);
        print_sentence(&format!("{name}, at rest at ({x}, {y}, {z}) m, turned by {turned} deg"));
        println!(
            "The platform moves up to {} mm and {} deg from its rest, at {} s.",
            mm(self.greatest_distance_m),
            significant(self.greatest_rotation_rad.to_degrees(), 3),
            significant(self.at_s, 3)
        );
        println!(
            "In the last quarter of {until} s it swings by up to {} mm about its mean place.",
            mm(self.swing_m)
        );
        let mut rows = table(&["cable", "at 0 s [N]", "greatest [N]", "at [s]", "slack", "above"]);
        for (i, cable) in self.cables.iter().enumerate() {
            let above = |above: Above| format!("{} {}", above.limit, significant(above.value_n, 4));
            rows.add_row([
                (i + 1).to_string(),
                format!("{:.1}", cable.rest_n),
                format!("{:.1}", cable.greatest_n),
                format!("{:.3}", cable.at_s),
                (if cable.slack { "yes" } else { "no" }).to_owned(),
                cable.above.map_or_else(String::new, above),
            ]);
        }
        println!("{rows}");
        println!("tensions: of the end of the cable that is pulled more");
        let Difference { position_m, rotation_rad, tension_n } = &self.difference;
        println!(
            "A coarser computation differs by up to {} mm, {} deg and {} N.",
            mm(*position_m),
            significant(rotation_rad.to_degrees(), 2),
            significant(*tension_n, 2)
        );
        println!(
            "{} a cable, {}; energy off by {} J of {} J.",
            self.elements(),
            counted(self.steps, "step"),
            significant(self.energy.drift_j, 2),
            significant(self.energy.kinetic_j, 3)
        );
    }

    /// Elements of a cable in words, those of most cables first.
    fn elements(&self) -> String {
        let all = || self.elements.iter().zip(&self.degree);
        let mut kinds: Vec<_> = all().collect();
        kinds.sort_by_key(|kind| (std::cmp::Reverse(all().filter(|of| of == kind).count()), *kind));
        kinds.dedup();
        let words = |(elements, degree): &(&usize, &usize)| {
            format!("{} of degree {degree}", counted(**elements, "element"))
        };
        kinds.iter().map(words).collect::<Vec<_>>().join(" or ")
    }
}
