//! `cdpr inverse`: the unstrained lengths that hold a pose.

use crate::answer::{self, OutOfLimits, Residual, bound_name};
use crate::error::ProgramError;
use crate::output::Ending;
use crate::pose::at_pose::{RobotAtPose, Row, cells, numbered};
use cdpr_robot::Robot;
use cdpr_statics::{InversePath, InverseSolution, inverse};
use serde::Serialize;

/// The robot, its poses and the load.
#[derive(clap::Args)]
pub(crate) struct Settings {
    #[command(flatten)]
    at: RobotAtPose,
    /// The poses of the file are a path: lengths change steadily along it, and `jump` says where they cannot.
    ///
    /// Several sets of tensions may be the best of all near them. Each pose then keeps to the one of the pose
    /// before, as long as it exists between them, even where another becomes better.
    #[arg(long, requires = "poses")]
    path: bool,
}

pub(crate) fn run(Settings { at, path }: &Settings) -> Result<Ending, ProgramError> {
    let load = at.load.load();
    if *path {
        let robot = at.robot()?;
        let mut path = InversePath::new(&robot);
        return at.answer_in_order(&robot, |pose| {
            let found = path.solve(pose, &load, None)?;
            Ok(OnPath { jump: found.jump, answer: Answer::new(&robot, &found.solution) })
        });
    }
    let solve =
        |robot: &Robot, pose: &_| inverse(robot, pose, &load, None).map(|found| Answer::new(robot, &found));
    at.answer(solve, Answer::print)
}

/// The lengths at a pose of a path.
#[derive(Serialize)]
struct OnPath {
    /// Whether the lengths may jump here.
    jump: bool,
    #[serde(flatten)]
    answer: Answer,
}

impl Row for OnPath {
    fn columns(robot: &Robot) -> Vec<String> {
        ["jump".to_owned()].into_iter().chain(Answer::columns(robot)).collect()
    }

    fn cells(&self) -> Vec<String> {
        [self.jump.to_string()].into_iter().chain(self.answer.cells()).collect()
    }

    fn out_of_limits(&self) -> Vec<&[OutOfLimits]> {
        self.answer.out_of_limits()
    }
}

/// The lengths, in SI units.
#[derive(Serialize)]
struct Answer {
    /// Unstrained lengths.
    lengths: Vec<f64>,
    tensions: Vec<f64>,
    /// Tensions at the exit points.
    exit_tensions: Vec<f64>,
    #[serde(skip_serializing_if = "Vec::is_empty")]
    out_of_limits: Vec<OutOfLimits>,
    /// Force (fx, fz) on each cable at its anchor point, in its vertical plane.
    cable_forces: Vec<[f64; 2]>,
    report: Report,
}

#[derive(Serialize)]
struct Report {
    /// Iterations of distribution and Newton's method.
    iterations: usize,
    /// The bound that each tension rests on, `min` or `max`; `null` where it rests on none.
    active: Vec<Option<&'static str>>,
    residual: Residual,
}

impl Row for Answer {
    fn columns(robot: &Robot) -> Vec<String> {
        let cables = robot.cables.len();
        let tensions = ["tension", "exit_tension"].into_iter().flat_map(|name| numbered(name, "n", cables));
        numbered("length", "m", cables).chain(tensions).collect()
    }

    fn cells(&self) -> Vec<String> {
        cells(self.lengths.iter().chain(&self.tensions).chain(&self.exit_tensions))
    }

    fn out_of_limits(&self) -> Vec<&[OutOfLimits]> {
        vec![&self.out_of_limits]
    }
}

impl Answer {
    fn new(robot: &Robot, solution: &InverseSolution) -> Self {
        Self {
            lengths: solution.lengths.clone(),
            tensions: solution.tensions.clone(),
            exit_tensions: solution.equilibrium.exit_tensions(robot, &solution.lengths),
            out_of_limits: OutOfLimits::all(robot, &solution.lengths, &[&solution.equilibrium]),
            cable_forces: answer::forces(&solution.equilibrium),
            report: Report {
                iterations: solution.iterations,
                active: solution.active.iter().map(|bound| bound.map(bound_name)).collect(),
                residual: Residual::new(&solution.residual),
            },
        }
    }

    fn print(&self, heading: &str) {
        println!("{heading}");
        answer::print_cables(&self.lengths, &self.cable_forces, &self.tensions, &self.exit_tensions);
        OutOfLimits::print(&self.out_of_limits);
        for (i, bound) in self.report.active.iter().enumerate() {
            if let Some(bound) = bound {
                println!("cable {} rests on its {bound}imum tension", i + 1);
            }
        }
        self.report.residual.print();
    }
}
