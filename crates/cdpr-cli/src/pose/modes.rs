//! `cdpr modes`: natural frequencies and motions of the platform on its cables.

use crate::answer::{self, OutOfLimits, decimal};
use crate::arguments::{self, FreeArguments};
use crate::error::ProgramError;
use crate::output::{Ending, table};
use crate::pose::at_pose::{RobotAtPose, Row, cells, numbered};
use crate::poses;
use crate::questions;
use cdpr_robot::{Pose, Robot, shown};
use cdpr_statics::vibration::{PoseModes, modes_at};
use cdpr_statics::{DirectProblem, DirectStart, StaticsError, WantedPose, rough_pose};
use serde::Serialize;

/// A robot at a pose or with lengths, and a load.
#[derive(clap::Args)]
pub(crate) struct Settings {
    #[command(flatten)]
    at: RobotAtPose,
    #[command(flatten)]
    free: FreeArguments,
    /// Unstrained lengths of the cables, in the order of the file: l1,..,ln [m]. The search for their pose
    /// starts from --pose, or where straight cables would hold a point.
    #[arg(long, value_parser = arguments::list, conflicts_with = "poses", allow_hyphen_values = true)]
    lengths: Option<arguments::List>,
}

pub(crate) fn run(settings: &Settings) -> Result<Ending, ProgramError> {
    let Settings { at, free, lengths } = settings;
    let load = at.load.load();
    let Some(arguments::List(lengths)) = lengths else {
        let solve = |robot: &Robot, pose: &Pose| {
            Ok(Answer::new(robot, &modes_at(robot, WantedPose::at(pose).free(&free.free), &load)?))
        };
        return at.answer(solve, Answer::print);
    };
    let (robot, start) = (at.robot()?, at.pose()?);
    questions::about_lengths(&robot, lengths);
    let solve = || -> Result<_, StaticsError> {
        let problem = DirectProblem::new(&robot, lengths, &load)?;
        let start = start.unwrap_or_else(|| rough_pose(&robot, lengths));
        let found = problem.direct(DirectStart::Pose(&start))?;
        questions::about_rest(&robot, "the equilibrium", (lengths, &load), &found, &start);
        PoseModes::new(&problem, found.equilibrium)
    };
    let found = solve()?;
    let answer = Answer::new(&robot, &found);
    let pose = &found.equilibrium.pose;
    let heading = format!("{} at {}", shown(&robot.name), poses::place(pose));
    at.print(&robot, pose, &answer, |answer| answer.print(&heading))
}

/// The natural motions.
#[derive(Serialize)]
struct Answer {
    /// Natural frequencies, ascending [Hz].
    frequencies_hz: Vec<f64>,
    /// The motion of each frequency.
    modes: Vec<Mode>,
    /// The lowest of each cable between ends at rest [Hz]; `null` for one without mass.
    cable_frequencies_hz: Vec<Option<f64>>,
    /// The lowest of these [Hz].
    lowest_cable_frequency_hz: Option<f64>,
    /// What follows where that is less than twice the lowest of the platform.
    #[serde(skip_serializing_if = "Option::is_none")]
    warning: Option<String>,
    #[serde(skip_serializing_if = "Vec::is_empty")]
    out_of_limits: Vec<OutOfLimits>,
}

/// A natural motion of unit mass.
#[derive(Serialize)]
struct Mode {
    /// Translation of P [1/√kg].
    translation: [f64; 3],
    /// Rotation vector [rad/(m √kg)].
    rotation: [f64; 3],
    /// Share of each cable in the energy of the motion.
    cable_shares: Vec<f64>,
    /// Share of the weight.
    weight_share: f64,
}

impl Row for Answer {
    fn columns(robot: &Robot) -> Vec<String> {
        let platform = numbered("frequency", "hz", robot.freedoms().count());
        platform.chain(["lowest_cable_frequency_hz".to_owned()]).collect()
    }

    fn cells(&self) -> Vec<String> {
        let lowest = self.lowest_cable_frequency_hz.map(|frequency| format!("{frequency:?}"));
        cells(&self.frequencies_hz).into_iter().chain([lowest.unwrap_or_default()]).collect()
    }

    fn out_of_limits(&self) -> Vec<&[OutOfLimits]> {
        vec![&self.out_of_limits]
    }

    fn warning(&self) -> Option<&str> {
        self.warning.as_deref()
    }
}

impl Answer {
    fn new(robot: &Robot, found: &PoseModes) -> Self {
        let PoseModes { modes, lengths, equilibrium, cable_frequencies } = found;
        let (slowest, platform) = found.lowest();
        Self {
            cable_frequencies_hz: cable_frequencies.clone(),
            lowest_cable_frequency_hz: slowest.map(|cable| cable.frequency),
            warning: slowest.zip(platform).and_then(|(cable, platform)| cable.warning(platform)),
            out_of_limits: OutOfLimits::all(robot, lengths, &[equilibrium]),
            frequencies_hz: modes.iter().map(|mode| mode.frequency).collect(),
            modes: modes
                .iter()
                .map(|mode| Mode {
                    translation: mode.translation.into(),
                    rotation: mode.rotation.into(),
                    cable_shares: mode.cables.clone(),
                    weight_share: mode.weight,
                })
                .collect(),
        }
    }

    fn print(&self, heading: &str) {
        println!("{heading}: natural motions, of unit mass");
        let names = [
            "frequency [Hz]",
            "translation [1/\u{221a}kg]",
            "rotation [rad/(m \u{221a}kg)]",
            "weight [%]",
            "cables [%]",
        ];
        let mut rows = table(&names);
        for (frequency, mode) in self.frequencies_hz.iter().zip(&self.modes) {
            let words = |vector: &[f64; 3]| answer::vector(vector, 4);
            let percent = |share: &f64| decimal(100.0 * share, 1);
            let cables: Vec<_> = mode.cable_shares.iter().map(percent).collect();
            let (translation, rotation) = (words(&mode.translation), words(&mode.rotation));
            let weight = percent(&mode.weight_share);
            rows.add_row([format!("{frequency:.4}"), translation, rotation, weight, cables.join(" ")]);
        }
        println!("{rows}");
        println!("weight and cables: share of each in the energy of the motion");
        let of_cable = |frequency: &Option<f64>| frequency.map_or("-".to_owned(), |f| format!("{f:.3}"));
        let cables: Vec<_> = self.cable_frequencies_hz.iter().map(of_cable).collect();
        println!("lowest of each cable itself, between ends at rest: {} Hz", cables.join(" "));
        self.warning.iter().for_each(|warning| println!("warning: {warning}"));
        OutOfLimits::print(&self.out_of_limits);
    }
}
