//! `cdpr calibrate plan`: the poses to measure.

use crate::program::arguments::endings;
use crate::program::arguments::poses;
use crate::program::arguments::{
    self, Format, FreeArguments, LoadArguments, Overwrite, Preference, Region, RobotArgument, region,
};
use crate::program::calibrate::candidates::{Candidates, Known, add, ending};
use crate::program::error::ProgramError;
use crate::program::output::{Details, Ending, patiently, print_sentence, table};
use crate::program::questions;
use cdpr_calibration::{AtWork, Criterion, PosePlan, Quality};
use cdpr_robot::{Pose, Robot, counted, rounded, shown, significant};
use cdpr_study::OutputLimit;
use clap::ValueEnum;
use serde::Serialize;
use std::collections::BTreeMap;
use std::path::PathBuf;

/// The robot, the candidates, and what is to be exact.
#[derive(clap::Args)]
pub(crate) struct Settings {
    #[command(flatten)]
    robot: RobotArgument,
    #[command(flatten)]
    candidates: Candidates,
    #[command(flatten)]
    known: Known,
    /// Number of poses.
    #[arg(long = "number", value_name = "N", default_value_t = 20)]
    #[arg(value_parser = arguments::count::<1, 100_000>)]
    count: usize,
    /// criterion=NAME, what the set is to be best in: information about all parameters together (D-optimal,
    /// if left out), parameters, for their mean variance (A-optimal), mean-position, worst-position
    /// (G-optimal) or mean-deflection, where the robot works.
    #[arg(long, value_name = "NAMES", value_parser = arguments::with)]
    with: Option<arguments::With>,
    /// Positions where the robot works, as those of --region: the position with given lengths, or the
    /// deflection by the load, is to be exact there.
    #[arg(long, value_name = "REGION", value_parser = region, allow_hyphen_values = true)]
    work: Option<Region>,
    /// How exact it is to be there, the standard deviation of a coordinate (the mean, or with worst-position
    /// and worst-deflection the greatest): position_error_mm<VALUE or deflection_mm<VALUE [mm]. How many
    /// poses does that take?
    #[arg(long, value_name = "COLUMN<VALUE", value_parser = arguments::limit, requires = "work")]
    limit: Option<(String, OutputLimit)>,
    #[command(flatten)]
    load: LoadArguments,
    #[command(flatten)]
    free: FreeArguments,
    #[command(flatten)]
    preference: Preference,
    /// Seed of the random sets that are compared with it.
    #[arg(long, default_value_t = 1, value_parser = arguments::seed, allow_negative_numbers = true)]
    seed: u64,
    /// File for the poses (CSV), as --poses reads them.
    #[arg(short, long, value_parser = endings::csv())]
    out: Option<PathBuf>,
    #[command(flatten)]
    overwrite: Overwrite,
    #[command(flatten)]
    details: Details,
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
    /// Mean variance of the position where the robot works.
    MeanPosition,
    /// Greatest variance of the position where the robot works (G-optimal).
    WorstPosition,
    /// Mean variance of the deflection where the robot works.
    MeanDeflection,
    /// Greatest variance of the deflection where the robot works.
    WorstDeflection,
}

impl CriterionName {
    /// The criterion, and what is to be exact where the robot works, if it is one of that.
    fn meant(self) -> (Criterion, Option<AtWork>) {
        match self {
            Self::Information => (Criterion::Information, None),
            Self::Parameters => (Criterion::Parameters, None),
            Self::MeanPosition => (Criterion::MeanAtWork, Some(AtWork::Position)),
            Self::WorstPosition => (Criterion::WorstAtWork, Some(AtWork::Position)),
            Self::MeanDeflection => (Criterion::MeanAtWork, Some(AtWork::Deflection)),
            Self::WorstDeflection => (Criterion::WorstAtWork, Some(AtWork::Deflection)),
        }
    }
}

impl Settings {
    fn criterion(&self) -> Result<CriterionName, ProgramError> {
        let with = arguments::With::known(self.with.as_ref(), &["criterion"])?;
        let found = with.value("criterion", None, |name| {
            let names = || CriterionName::value_variants().iter().filter_map(ValueEnum::to_possible_value);
            CriterionName::from_str(name, true).map_err(|_| {
                let names: Vec<_> = names().map(|name| name.get_name().to_owned()).collect();
                format!("expected {}", names.join(", "))
            })
        })?;
        Ok(found.unwrap_or(CriterionName::Information))
    }

    /// What is to be exact where the robot works, and how exact [m].
    fn at_work(&self) -> Result<(AtWork, Option<f64>), ProgramError> {
        let (_, of_criterion) = self.criterion()?.meant();
        let Some(limit) = &self.limit else { return Ok((of_criterion.unwrap_or(AtWork::Position), None)) };
        let (name, most) =
            arguments::upper(limit, &[arguments::POSITION, "deflection_mm"]).map_err(ProgramError::Usage)?;
        let of = if name == arguments::POSITION { AtWork::Position } else { AtWork::Deflection };
        if of_criterion.is_some_and(|criterion| criterion != of) {
            let usage = format!("--limit {name} and --with criterion: expected both of the same quantity");
            return Err(ProgramError::Usage(usage));
        }
        Ok((of, Some(1e-3 * most)))
    }
}

pub(super) fn run(settings: &Settings) -> Result<Ending, ProgramError> {
    let (criterion, of_work) = settings.criterion()?.meant();
    let (of, accuracy) = settings.at_work()?;
    if of_work.is_some() && settings.work.is_none() {
        let usage = "--with criterion: expected --work, too, where the robot works";
        return Err(ProgramError::Usage(usage.to_owned()));
    }
    let robot = settings.preference.open_robot(settings.robot.path())?;
    let candidates = settings.candidates.read(&robot)?;
    let measurements = settings.known.measurements(&robot)?;
    let mut calibration = settings.known.calibration(&robot, &settings.free.free)?;
    let work = match &settings.work {
        Some(region) => region.grid(&robot)?.poses(),
        None => Vec::new(),
    };
    questions::about_poses(&robot, "--work", &work);
    let load = settings.load.load();
    questions::about_load(&robot, &load);
    questions::about_accuracy(&robot, accuracy);
    let all = candidates.len();
    let (poses, refused) = add(&mut calibration, candidates, &load, &measurements)?;
    let worked = work.iter().filter(|pose| calibration.add_work(pose, &load, of).is_ok()).count();
    if (of_work.is_some() || accuracy.is_some()) && worked == 0 {
        return Err(ProgramError::NoPoseHeld { reasons: "none of --work is held".to_owned() });
    }
    let (found, needed) = patiently("choosing poses", || {
        let needed = accuracy.map(|accuracy| {
            let reaches = |of: &Quality| of.at_work(criterion).is_some_and(|std| std <= accuracy);
            calibration.needed(settings.count, criterion, reaches)
        });
        (calibration.plan(settings.count, criterion, settings.seed), needed)
    });
    if let Some(out) = &settings.out {
        let lines: Vec<String> = found
            .poses
            .iter()
            .map(|pose| poses::pose_numbers(&poses[*pose]).map(|number| number.to_string()).join(","))
            .collect();
        settings.overwrite.write(out, format!("{}\n{}\n", poses::COLUMNS.join(","), lines.join("\n")))?;
    }
    let left_out = work.len() - worked;
    let is_worst = criterion == Criterion::WorstAtWork;
    let output = Plan { work_left_out: left_out, needed, is_worst, ..Plan::new(&poses, refused, found) };
    let text = |output: &Plan| print_plan(&robot, output, settings.details.details);
    settings.format.print(&output, text)?;
    Ok(ending(output.candidates, all))
}

/// A plan as it is printed.
#[derive(Serialize)]
struct Plan {
    /// Poses that the robot holds.
    candidates: usize,
    refused: BTreeMap<&'static str, usize>,
    /// Positions where the robot works that it does not hold, and that no figure is of.
    work_left_out: usize,
    /// x, y, z [m], qw, qx, qy, qz.
    poses: Vec<[f64; 7]>,
    plan: Left,
    random: Left,
    outermost: Left,
    /// With the first 1, 2, 3, ... poses of a set that grows one by one.
    growing: Vec<Left>,
    /// The least number of poses whose plan reaches the accuracy; none where more are needed.
    #[serde(skip_serializing_if = "Option::is_none")]
    needed: Option<Option<usize>>,
    /// Whether the greatest standard deviation at work is made small, where it is the mean otherwise.
    #[serde(skip)]
    is_worst: bool,
}

/// What a set of poses leaves.
#[derive(Clone, Copy, Serialize)]
struct Left {
    information_bits: f64,
    parameters: f64,
    #[serde(rename = "mean_at_work_m")]
    mean_at_work: Option<f64>,
    #[serde(rename = "worst_at_work_m")]
    worst_at_work: Option<f64>,
}

impl From<Quality> for Left {
    fn from(of: Quality) -> Self {
        let Quality { information, parameters, mean_at_work, worst_at_work } = of;
        Self { information_bits: information, parameters, mean_at_work, worst_at_work }
    }
}

impl Plan {
    fn new(poses: &[Pose], refused: BTreeMap<&'static str, usize>, found: PosePlan) -> Self {
        Self {
            candidates: poses.len(),
            refused,
            work_left_out: 0,
            poses: found.poses.iter().map(|pose| poses::pose_numbers(&poses[*pose])).collect(),
            plan: found.quality.into(),
            random: found.random.into(),
            outermost: found.corners.into(),
            growing: found.growing.into_iter().map(Left::from).collect(),
            needed: None,
            is_worst: false,
        }
    }
}

/// How many poses reach the accuracy.
fn reached(robot: &Robot, output: &Plan, needed: Option<usize>) -> String {
    let name = shown(&robot.name);
    match needed {
        Some(1) => format!("{name} reaches the accuracy with 1 pose."),
        Some(needed) => format!("{name} reaches the accuracy with {needed} poses."),
        None => format!("{name} does not reach the accuracy with {}.", counted(output.poses.len(), "pose")),
    }
}

/// What the planned poses leave, compared with other sets.
fn answer(robot: &Robot, output: &Plan) -> String {
    let (poses, name) = (counted(output.poses.len(), "pose"), shown(&robot.name));
    let leave = if output.poses.len() == 1 { "leaves" } else { "leave" };
    let at_work = if output.is_worst { "mm at worst" } else { "mm at work" };
    let of_work = |of: &Left| if output.is_worst { of.worst_at_work } else { of.mean_at_work };
    let millimetres = |of: &Left| of_work(of).map(|std| significant(1e3 * std, 3));
    let sets = [&output.plan, &output.random, &output.outermost];
    match sets.map(millimetres) {
        [Some(plan), Some(random), Some(outermost)] => {
            format!("{poses} of {name} {leave} {plan} {at_work} (random {random}, outermost {outermost}).")
        }
        _ => {
            let [plan, random, outermost] = sets.map(|of| significant(100.0 * of.parameters, 3));
            format!(
                "{poses} of {name} {leave} {plan} % of parameters' std (random {random}, outermost \
                 {outermost})."
            )
        }
    }
}

fn print_plan(robot: &Robot, output: &Plan, details: bool) {
    output.needed.iter().for_each(|needed| print_sentence(&reached(robot, output, *needed)));
    print_sentence(&answer(robot, output));
    let all = if output.poses.len() == output.candidates { ", which are all there are" } else { "" };
    println!("chosen of {}{all}", counted(output.candidates, "pose"));
    for (reason, count) in &output.refused {
        println!("{} left out: {reason}", counted(*count, "pose"));
    }
    if output.work_left_out > 0 {
        println!("{} of --work left out: not held", counted(output.work_left_out, "position"));
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
    let growing = output.growing.iter().enumerate().filter(|(k, _)| details && (k + 1).is_power_of_two());
    for (k, of) in growing {
        add(format!("growing, {}", k + 1), of);
    }
    println!("{rows}");
    let mut rows = table(&["x, y, z [m], qw, qx, qy, qz"]);
    for pose in &output.poses {
        rows.add_row([pose.map(|number| rounded(number, 6).to_string()).join(", ")]);
    }
    println!("{rows}");
}
