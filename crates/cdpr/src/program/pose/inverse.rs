//! `cdpr inverse`: the unstrained lengths that hold a pose.

use crate::program::answer::{self, Borne, Neutral, OutOfLimits, Residual, bound_name};
use crate::program::arguments::poses::{COLUMNS, pose_numbers};
use crate::program::arguments::{FreeArguments, With, number, with};
use crate::program::error::ProgramError;
use crate::program::output::{Ending, print_sentence};
use crate::program::pose::at_pose::{Brief, RobotAtPose, Row, cells, numbered};
use cdpr_robot::{Pose, Robot};
use cdpr_statics::free_coordinates::{FreeSolution, FreeSolutions, free_solutions};
use cdpr_statics::limits::cables_in_words;
use cdpr_statics::{
    DirectProblem, InversePath, InverseSolution, Load, Stability, StaticsError, WantedPose, inverse,
};
use serde::Serialize;

/// The robot, its poses and the load.
#[derive(clap::Args)]
pub(crate) struct Settings {
    #[command(flatten)]
    at: RobotAtPose,
    #[command(flatten)]
    free: FreeArguments,
    /// path: the poses of the file are a path, along which lengths change steadily; `jump` says where they
    /// cannot. change=NEWTONS: no tension of a path changes by more from one pose to the next. loops: with
    /// free coordinates also solutions whose cables are of any length.
    ///
    /// Several sets of tensions may be the best of all near them. Each pose of a path then keeps to the one
    /// of the pose before, as long as it exists between them, even where another becomes better.
    #[arg(long, value_name = "NAMES", value_parser = with)]
    with: Option<With>,
}

pub(crate) fn run(Settings { at, free, with }: &Settings) -> Result<Ending, ProgramError> {
    let load = at.load.load();
    let with = With::known(with.as_ref(), &["path", "change", "loops"])?;
    let change = with.value("change", None, number)?;
    let loops = with.has("loops")?;
    if loops && free.free.is_empty() {
        return Err(ProgramError::Usage("--with loops: expected --free, too".to_owned()));
    }
    if change.is_some() && !with.has("path")? {
        return Err(ProgramError::Usage("--with change: expected --with path,change=NEWTONS".to_owned()));
    }
    if with.has("path")? {
        if !free.free.is_empty() {
            return Err(ProgramError::Usage("--with path: expected no --free".to_owned()));
        }
        let robot = at.robot()?;
        let mut path = InversePath::new(&robot);
        change.map_or(Ok(()), |change| path.limit_change(change))?;
        return at.answer_in_order(&robot, |pose| {
            let found = path.solve(pose, &load)?;
            Ok(OnPath { jump: found.jump, answer: Answer::new(&robot, &load, &found.solution)? })
        });
    }
    if !free.free.is_empty() {
        let solve = |robot: &Robot, pose: &Pose| {
            let wanted = WantedPose { free: &free.free, loops, ..pose.into() };
            Ok(Rest::new(robot, &load, &free_solutions(robot, wanted, &load)?))
        };
        return at.answer(solve, Rest::print);
    }
    let solve = |robot: &Robot, pose: &_| Answer::new(robot, &load, &inverse(robot, pose, &load)?);
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

    fn brief(&self) -> Vec<Brief> {
        self.answer.brief()
    }

    fn jumps(&self) -> bool {
        self.jump
    }

    fn out_of_limits(&self) -> Vec<&[OutOfLimits]> {
        self.answer.out_of_limits()
    }
}

/// The solutions with free coordinates.
#[derive(Serialize)]
struct Rest {
    #[serde(flatten)]
    first: Resting,
    #[serde(flatten)]
    load: Borne,
    /// Further solutions: those within the limits come first, and of them stable ones.
    others: Vec<Resting>,
}

/// A pose at which the platform rests, in SI units.
#[derive(Serialize)]
struct Resting {
    /// Position and unit quaternion (w, x, y, z).
    found_pose: [f64; 7],
    /// Angles of R = Rz(yaw) Ry(pitch) Rx(roll).
    roll_pitch_yaw_deg: [f64; 3],
    /// Both in words.
    #[serde(skip)]
    place: String,
    lengths: Vec<f64>,
    tensions: Vec<f64>,
    exit_tensions: Vec<f64>,
    #[serde(skip_serializing_if = "Vec::is_empty")]
    out_of_limits: Vec<OutOfLimits>,
    cable_forces: Vec<[f64; 2]>,
    #[serde(skip_serializing_if = "Vec::is_empty")]
    loops: Vec<LoopedCable>,
    #[serde(flatten)]
    stays: Stays,
    iterations: usize,
    residual: Residual,
}

/// Whether the platform stays there with these lengths.
#[derive(Serialize)]
struct Stays {
    stable: bool,
    /// Stiffness of the softest motion [N/m].
    #[serde(rename = "least_stiffness_n_per_m")]
    least_stiffness: f64,
    #[serde(skip_serializing_if = "Vec::is_empty")]
    neutral: Vec<Neutral>,
}

impl Stays {
    fn new(stability: &Stability) -> Self {
        Self {
            stable: stability.is_stable(),
            least_stiffness: stability.least_stiffness(),
            neutral: Neutral::all(stability),
        }
    }

    fn brief(&self, tensions: &[f64]) -> Vec<Brief> {
        let least = Brief::Shown("softest motion", "N/m", Some(self.least_stiffness));
        vec![Brief::tensions("tensions", tensions), least]
    }

    fn word(&self) -> &'static str {
        answer::stability_word(self.stable)
    }

    fn print(&self) {
        println!("softest motion with these lengths {:.1} N/m", self.least_stiffness);
        Neutral::print(&self.neutral);
    }
}

/// The sentence that a pose is held, and how.
fn held(heading: &str, tensions: &[f64], stays: &Stays, beyond: &[OutOfLimits]) -> String {
    let (range, beyond) = (answer::tension_range(tensions), OutOfLimits::verdict(beyond));
    format!("{heading}: tensions of {range} hold it, {}{beyond}.", stays.word())
}

/// A cable that hangs in a loop.
#[derive(Serialize)]
struct LoopedCable {
    /// Number of the cable, from 1.
    cable: usize,
    /// Its unstrained length over the distance of its points.
    chords: f64,
}

impl Resting {
    fn new(robot: &Robot, found: &FreeSolution) -> Self {
        let FreeSolution { lengths, tensions, equilibrium, stability, residual, iterations } = found;
        let (roll, pitch, yaw) = equilibrium.pose.rotation.euler_angles();
        Self {
            found_pose: pose_numbers(&equilibrium.pose),
            roll_pitch_yaw_deg: [roll, pitch, yaw].map(f64::to_degrees),
            place: answer::exact_place(robot, &equilibrium.pose),
            lengths: lengths.clone(),
            tensions: tensions.clone(),
            exit_tensions: equilibrium.exit_tensions(robot, lengths),
            out_of_limits: OutOfLimits::all(robot, lengths, &[equilibrium]),
            cable_forces: answer::forces(equilibrium),
            loops: found
                .loops(robot)
                .into_iter()
                .map(|(i, chords)| LoopedCable { cable: i + 1, chords })
                .collect(),
            stays: Stays::new(stability),
            iterations: *iterations,
            residual: Residual::new(residual),
        }
    }
}

impl Row for Rest {
    fn found_pose(&self) -> Option<Pose> {
        let [x, y, z, qw, qx, qy, qz] = self.first.found_pose;
        Pose::with_quaternion([x, y, z].into(), [qw, qx, qy, qz])
    }

    fn columns(robot: &Robot) -> Vec<String> {
        let cables = robot.cables.len();
        let found = COLUMNS.iter().map(|name| format!("found_{name}"));
        let tensions = ["tension", "exit_tension"].into_iter().flat_map(|name| numbered(name, "n", cables));
        let more = ["stable", "least_stiffness_n_per_m", "others"].into_iter().map(str::to_owned);
        found.chain(numbered("length", "m", cables)).chain(tensions).chain(more).collect()
    }

    fn cells(&self) -> Vec<String> {
        let Resting { found_pose, lengths, tensions, exit_tensions, stays, .. } = &self.first;
        let numbers = found_pose.iter().chain(lengths).chain(tensions).chain(exit_tensions);
        let Stays { stable, least_stiffness, .. } = stays;
        let last = cells([least_stiffness]).into_iter().chain([self.others.len().to_string()]);
        cells(numbers).into_iter().chain([stable.to_string()]).chain(last).collect()
    }

    fn brief(&self) -> Vec<Brief> {
        self.first.stays.brief(&self.first.tensions)
    }

    fn out_of_limits(&self) -> Vec<&[OutOfLimits]> {
        vec![&self.first.out_of_limits]
    }
}

impl Rest {
    fn new(robot: &Robot, load: &Load, FreeSolutions { first, others }: &FreeSolutions) -> Self {
        Self {
            first: Resting::new(robot, first),
            load: load.into(),
            others: others.iter().map(|other| Resting::new(robot, other)).collect(),
        }
    }

    fn print(&self, heading: &str) {
        let Resting { lengths, tensions, exit_tensions, stays, .. } = &self.first;
        print_sentence(&held(heading, tensions, stays, &self.first.out_of_limits));
        answer::print_cables(lengths, tensions, exit_tensions);
        self.first.stays.print();
        OutOfLimits::print(&self.first.out_of_limits);
        for LoopedCable { cable, chords } in &self.first.loops {
            println!("cable {cable} is a loop of {chords:.1} chords");
        }
        self.first.residual.print();
        for other in &self.others {
            let beyond = if other.out_of_limits.is_empty() { "" } else { ", out of limits," };
            print_sentence(&format!("also {}{beyond} at {}", other.stays.word(), other.place));
        }
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
    #[serde(flatten)]
    load: Borne,
    #[serde(flatten)]
    stays: Stays,
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
        let more = ["stable", "least_stiffness_n_per_m"].into_iter().map(str::to_owned);
        numbered("length", "m", cables).chain(tensions).chain(more).collect()
    }

    fn cells(&self) -> Vec<String> {
        let Stays { stable, least_stiffness, .. } = &self.stays;
        let numbers = cells(self.lengths.iter().chain(&self.tensions).chain(&self.exit_tensions));
        numbers.into_iter().chain([stable.to_string()]).chain(cells([least_stiffness])).collect()
    }

    fn brief(&self) -> Vec<Brief> {
        self.stays.brief(&self.tensions)
    }

    fn out_of_limits(&self) -> Vec<&[OutOfLimits]> {
        vec![&self.out_of_limits]
    }
}

impl Answer {
    fn new(robot: &Robot, load: &Load, solution: &InverseSolution) -> Result<Self, StaticsError> {
        let problem = DirectProblem::new(robot, &solution.lengths, load)?;
        Ok(Self {
            lengths: solution.lengths.clone(),
            tensions: solution.tensions.clone(),
            exit_tensions: solution.equilibrium.exit_tensions(robot, &solution.lengths),
            out_of_limits: OutOfLimits::all(robot, &solution.lengths, &[&solution.equilibrium]),
            cable_forces: answer::forces(&solution.equilibrium),
            load: load.into(),
            stays: Stays::new(&problem.stability(&solution.equilibrium)?),
            report: Report {
                iterations: solution.iterations,
                active: solution.active.iter().map(|bound| bound.map(bound_name)).collect(),
                residual: Residual::new(&solution.residual),
            },
        })
    }

    fn print(&self, heading: &str) {
        print_sentence(&held(heading, &self.tensions, &self.stays, &self.out_of_limits));
        answer::print_cables(&self.lengths, &self.tensions, &self.exit_tensions);
        self.stays.print();
        OutOfLimits::print(&self.out_of_limits);
        for bound in ["min", "max"] {
            let active = self.report.active.iter().enumerate().filter(|(_, active)| **active == Some(bound));
            let cables: Vec<usize> = active.map(|(i, _)| i).collect();
            let rests = if cables.len() == 1 { "rests on its" } else { "rest on their" };
            if !cables.is_empty() {
                print_sentence(&format!("{} {rests} {bound}imum tension", cables_in_words(&cables)));
            }
        }
        self.report.residual.print();
    }
}
