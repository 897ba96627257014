//! `cdpr path`: what a robot does along a path of poses.

use crate::answer::OutOfLimits;
use crate::error::ProgramError;
use crate::output::Ending;
use crate::pose::at_pose::{RobotAtPose, Row, cells, numbered};
use cdpr_robot::{Pose, Robot};
use cdpr_statics::{Deflection, DirectProblem, InversePath, Load, StaticsError, deflection_from};
use serde::Serialize;

pub(crate) fn run(at: &RobotAtPose) -> Result<Ending, ProgramError> {
    let (robot, load) = (at.robot()?, at.load.load());
    let mut path = InversePath::new(&robot);
    at.answer_in_order(&robot, |pose| Passed::new(&robot, &mut path, pose, &load))
}

/// A pose of a path, in SI units unless a name says otherwise.
#[derive(Serialize)]
struct Passed {
    /// Whether the lengths may jump here.
    jump: bool,
    /// Unstrained lengths.
    lengths: Vec<f64>,
    tensions: Vec<f64>,
    exit_tensions: Vec<f64>,
    /// Greatest distance of each cable across its chord.
    sags: Vec<f64>,
    /// dp under the load.
    deflection_mm: [f64; 3],
    /// |dp|.
    rms_mm: f64,
    /// Stiffness of the softest motion with the load.
    least_stiffness: f64,
    /// With the load; `null` for a robot that lacks `platform.inertia`.
    lowest_frequency_hz: Option<f64>,
    /// Numbers, from 1, of the cables that are slack with the load.
    slack_cables: Vec<usize>,
    /// Tensions without and with the load.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    out_of_limits: Vec<OutOfLimits>,
}

impl Passed {
    fn new(robot: &Robot, path: &mut InversePath, pose: &Pose, load: &Load) -> Result<Self, StaticsError> {
        let found = path.solve(pose, &Load::none(), None)?;
        let wanted = found.solution;
        let Deflection { lengths, unloaded, loaded } =
            deflection_from(robot, wanted.lengths, load, &wanted.equilibrium)?;
        let dp = 1e3 * (loaded.equilibrium.pose.position - unloaded.equilibrium.pose.position);
        let problem = DirectProblem::new(robot, &lengths, load)?;
        Ok(Self {
            jump: found.jump,
            tensions: wanted.tensions,
            exit_tensions: unloaded.equilibrium.exit_tensions(robot, &lengths),
            sags: DirectProblem::new(robot, &lengths, &Load::none())?.sags(&unloaded.equilibrium)?,
            deflection_mm: dp.into(),
            rms_mm: dp.norm(),
            least_stiffness: loaded.stability.least_stiffness(),
            lowest_frequency_hz: problem.lowest_frequency(&loaded.equilibrium).ok(),
            slack_cables: loaded.report.slack.iter().map(|i| i + 1).collect(),
            out_of_limits: OutOfLimits::all(robot, &lengths, &[&unloaded.equilibrium, &loaded.equilibrium]),
            lengths,
        })
    }
}

impl Row for Passed {
    fn columns(robot: &Robot) -> Vec<String> {
        let cables = robot.cables.len();
        let of_cables = [("length", "m"), ("tension", "n"), ("exit_tension", "n"), ("sag", "m")];
        let of_cables = of_cables.into_iter().flat_map(|(name, unit)| numbered(name, unit, cables));
        let of_platform =
            ["dx_mm", "dy_mm", "dz_mm", "rms_mm", "least_stiffness", "lowest_frequency_hz", "slack_cables"];
        let platform = of_platform.into_iter().map(str::to_owned);
        ["jump".to_owned()].into_iter().chain(of_cables).chain(platform).collect()
    }

    fn cells(&self) -> Vec<String> {
        let Self { lengths, tensions, exit_tensions, sags, deflection_mm, .. } = self;
        let of_cables = lengths.iter().chain(tensions).chain(exit_tensions).chain(sags);
        let numbers = of_cables.chain(deflection_mm).chain([&self.rms_mm, &self.least_stiffness]);
        let slack: Vec<_> = self.slack_cables.iter().map(ToString::to_string).collect();
        let frequency = self.lowest_frequency_hz.map(|frequency| format!("{frequency:?}"));
        let first = [self.jump.to_string()].into_iter().chain(cells(numbers));
        first.chain([frequency.unwrap_or_default(), slack.join(" ")]).collect()
    }

    fn out_of_limits(&self) -> Vec<&[OutOfLimits]> {
        vec![&self.out_of_limits]
    }
}
