//! A robot at a pose, or at each pose of a file: arguments and answers of several commands.

mod along;
mod row;

use crate::program::arguments::poses::{PoseArguments, place};
use crate::program::arguments::{Format, FreeArguments, LoadArguments, Preference, Printing, RobotArgument};
use crate::program::error::ProgramError;
use crate::program::lists::{PoseTable, pose_file};
use crate::program::output::{Ending, patiently, print_apart, print_sentence, progress};
use crate::program::questions;
use crate::program::said::{self, Said, is_said};
use along::Along;
use cdpr_robot::{Pose, Robot, broken, listing, plausible, shown};
use cdpr_statics::StaticsError;
use indicatif::ProgressBar;
use rayon::prelude::*;
pub(crate) use row::{Brief, Failure, Row, cell_value, cells, numbered};
use row::{at_one, print_answer, print_cases, print_line, print_names, print_row};
use std::path::{Path, PathBuf};

const POSE_EXPECTED: &str = "expected --pose x,y,z, or --poses with a table of poses";

/// Poses that are answered before their rows are printed.
const CHUNK: usize = 1024;

/// A robot at a pose or at each of a file with a load, and how the answer is printed.
#[derive(clap::Args)]
pub(crate) struct RobotAtPose {
    #[command(flatten)]
    robot: RobotArgument,
    #[command(flatten)]
    pose: PoseArguments,
    /// Table of poses: x_m,y_m,z_m, then qw,qx,qy,qz or roll_deg,pitch_deg,yaw_deg or nothing; or answers of
    /// `direct` in JSON; - for the standard input.
    ///
    /// A sentence says how many are held, and a terminal shows a short table. Files and pipes get all as
    /// CSV, or as lines of JSON with `--format json`, and the sentence is then on the standard error. A pose
    /// without an answer has a line with the reason, and the exit code is 3.
    #[arg(long, value_name = "FILE", conflicts_with_all = ["pose", "rpy"])]
    poses: Option<PathBuf>,
    #[command(flatten)]
    pub(crate) printing: Printing,
    #[command(flatten)]
    pub(crate) load: LoadArguments,
    #[command(flatten)]
    preference: Preference,
}

/// A robot at a pose, and the coordinates that are found.
#[derive(clap::Args)]
pub(crate) struct RobotAtFreePose {
    #[command(flatten)]
    pub(super) at: RobotAtPose,
    #[command(flatten)]
    pub(super) free: FreeArguments,
}

impl RobotAtPose {
    /// Answers what `solve` answers at the pose, or at each pose of the file.
    ///
    /// A single answer is one line of JSON, or what `text` prints below a heading of robot and pose.
    pub(crate) fn answer<T: Row>(
        &self,
        solve: impl Fn(&Robot, &Pose) -> Result<T, StaticsError> + Sync,
        text: impl FnOnce(&T, &str),
    ) -> Result<Ending, ProgramError> {
        let robot = self.robot()?;
        let pose = match &self.poses {
            Some(path) => {
                let solve = |pose: &Pose, progress: &ProgressBar| {
                    let answer = solve(&robot, pose);
                    progress.inc(1);
                    answer
                };
                return self.answer_all(&robot, pose_file(path, &robot)?, |poses, progress| {
                    poses.par_iter().map(|pose| solve(pose, progress)).collect()
                });
            }
            None => self.pose.given()?.ok_or_else(|| ProgramError::Usage(POSE_EXPECTED.to_owned()))?,
        };
        let format = self.printing.format();
        match patiently("solving", || solve(&robot, &pose)) {
            Err(error @ StaticsError::BranchEnds(_)) => print_fall(format, &robot, &pose, error),
            answer => self.print(&robot, &pose, &answer?, |answer| {
                text(answer, &heading(&robot, &answer.found_pose().unwrap_or(pose)));
            }),
        }
    }

    /// Prints the answer at a pose.
    pub(crate) fn print<T: Row>(
        &self,
        robot: &Robot,
        pose: &Pose,
        answer: &T,
        text: impl FnOnce(&T),
    ) -> Result<Ending, ProgramError> {
        match self.printing.format() {
            Format::Csv => match answer.cases() {
                Some(cases) => print_cases(&answer.found_pose().unwrap_or(*pose), cases),
                None => {
                    print_names::<T>(robot, &[]);
                    print_row(pose, &[], Ok(answer), 0);
                }
            },
            format => format.print(answer, text)?,
        }
        Ok(answer.ending())
    }

    /// The pose, if one is given.
    pub(crate) fn pose(&self) -> Result<Option<Pose>, ProgramError> {
        self.pose.given()
    }

    /// The robot of the file, once load and pose have been compared with it.
    pub(crate) fn robot(&self) -> Result<Robot, ProgramError> {
        let robot = self.preference.open_robot(self.robot.path())?;
        questions::about_load(&robot, &self.load.load());
        if let Some(pose) = self.pose.given()? {
            questions::about_pose(&robot, "--pose", &pose);
        }
        Ok(robot)
    }

    fn poses_path(&self) -> Result<&Path, ProgramError> {
        let expected = || ProgramError::Usage("expected --poses FILE, the poses of the path".to_owned());
        self.poses.as_deref().ok_or_else(expected)
    }

    /// The poses of the file.
    pub(crate) fn poses(&self, robot: &Robot) -> Result<Vec<Pose>, ProgramError> {
        let path = self.poses_path()?;
        let PoseTable { poses, further, .. } = pose_file(path, robot)?;
        questions::about_poses(robot, "--poses", &poses);
        if !further.is_empty() {
            let names: Vec<&str> = further.iter().map(|(name, _)| name.as_str()).collect();
            said::note(format_args!("{}", listing("columns of the table without effect: ", &names, "")));
        }
        Ok(poses)
    }

    /// Answers what `solve` answers at the poses of the file, one after the other.
    pub(crate) fn answer_in_order<T: Row>(
        &self,
        robot: &Robot,
        mut solve: impl FnMut(&Pose) -> Result<T, StaticsError>,
    ) -> Result<Ending, ProgramError> {
        let table = pose_file(self.poses_path()?, robot)?;
        let doubt = |(lines, (name, times)): (&Vec<usize>, &(String, Vec<f64>))| {
            plausible::times(name, lines, times, &table.poses)
        };
        questions::ask(table.lines.as_ref().zip(table.times.as_ref()).and_then(doubt));
        let mut solve = |pose: &Pose, progress: &ProgressBar| {
            let answer = solve(pose);
            progress.inc(1);
            answer
        };
        self.answer_all(robot, table, |poses, progress| {
            poses.iter().map(|pose| solve(pose, progress)).collect()
        })
    }

    fn answer_all<T: Row>(
        &self,
        robot: &Robot,
        PoseTable { poses, further, lines, .. }: PoseTable,
        mut solve: impl FnMut(&[Pose], &ProgressBar) -> Vec<Result<T, StaticsError>>,
    ) -> Result<Ending, ProgramError> {
        questions::about_poses(robot, "--poses", &poses);
        let (columns, format) = (T::columns(robot).len(), self.printing.format());
        let is_brief = self.printing.is_brief();
        let (mut ending, mut along) = (Ending::Well, Along::of(lines));
        let progress = progress(poses.len(), "poses");
        for (number, chunk) in poses.chunks(CHUNK).enumerate() {
            let answers = solve(chunk, &progress).into_iter().map(at_one).collect::<Result<Vec<_>, _>>()?;
            for (pose, answer) in chunk.iter().zip(&answers) {
                ending = ending.and(answer.as_ref().map_or(Ending::SomethingWrong, Row::ending));
                along.pass(pose, answer);
            }
            if is_brief {
                continue;
            }
            if number == 0 && format != Format::Json {
                print_names::<T>(robot, &further);
            }
            let print = || {
                let given = |k: usize| -> Vec<(&str, &str)> {
                    let row = number * CHUNK + k;
                    further.iter().map(|(name, cells)| (name.as_str(), cells[row].as_str())).collect()
                };
                let mut rows = chunk.iter().zip(&answers).enumerate();
                rows.try_for_each(|(k, (pose, answer))| {
                    print_answer(format, pose, &given(k), answer, columns)
                })
            };
            progress.suspend(print)?;
        }
        progress.finish_and_clear();
        if is_brief {
            along.print();
        } else if self.printing.is_to_file() {
            print_apart(&along.sentence());
        } else if is_said(Said::Usual) {
            // The standard output has the rows, which programs read.
            broken(&along.sentence()).iter().for_each(|line| eprintln!("{line}"));
        }
        Ok(ending)
    }
}

fn heading(robot: &Robot, pose: &Pose) -> String {
    format!("{} at {}", shown(&robot.name), place(pose))
}

/// Prints that the platform falls before the whole load is on it: that is an answer.
pub(crate) fn print_fall(
    format: Format,
    robot: &Robot,
    pose: &Pose,
    error: StaticsError,
) -> Result<Ending, ProgramError> {
    let failure = Failure::from(error);
    match format {
        Format::Json => print_line::<()>(pose, &[], Err(&failure))?,
        Format::Text | Format::Csv => {
            print_sentence(&format!("{}: {}", heading(robot, pose), failure.message));
        }
    }
    Ok(Ending::SomethingWrong)
}
