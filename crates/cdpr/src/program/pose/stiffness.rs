//! `cdpr stiffness`: the Cartesian stiffness at a pose, with its eigenvalues and their motions.

use crate::program::answer::{self, Neutral, OutOfLimits, decimal};
use crate::program::arguments::poses::as_numbers;
use crate::program::error::ProgramError;
use crate::program::output::{Ending, print_sentence, table};
use crate::program::pose::at_pose::{Brief, RobotAtFreePose, Row, cells};
use cdpr_robot::{Pose, Robot, decimals_of, significant, visible};
use cdpr_statics::WantedPose;
use cdpr_statics::stiffness::{PoseStiffness, stiffness_at};
use serde::Serialize;

pub(crate) fn run(RobotAtFreePose { at, free }: &RobotAtFreePose) -> Result<Ending, ProgramError> {
    let load = at.load.load();
    let solve = |robot: &Robot, pose: &_| {
        let found = stiffness_at(robot, WantedPose::at(pose).free(&free.free), &load)?;
        Ok(Answer { found_pose: free.found(&found.equilibrium.pose), ..Answer::new(robot, &found) })
    };
    at.answer(solve, Answer::print)
}

/// The stiffness.
#[derive(Serialize)]
struct Answer {
    /// Rows of K in (dp, dφ) [N/m, N/rad, N, N m/rad]: the true tangent of the balance.
    stiffness: [[f64; 6]; 6],
    /// Rows of the symmetric part of K.
    symmetric_part: [[f64; 6]; 6],
    /// Whether the platform is a point mass: it has no rotations.
    #[serde(skip)]
    is_point: bool,
    /// Eigenvalues of the symmetric part, the softest motion first.
    eigenvalues: Vec<Eigenvalue>,
    #[serde(rename = "least_stiffness_n_per_m")]
    least_stiffness: f64,
    stable: bool,
    /// Motions that nothing resists.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    neutral: Vec<Neutral>,
    /// Characteristic length ℓ, which makes rotations comparable with translations [m].
    #[serde(rename = "characteristic_length_m")]
    characteristic_length: f64,
    /// The pose with its free coordinates as they are found.
    #[serde(skip_serializing_if = "Option::is_none", serialize_with = "as_numbers")]
    found_pose: Option<Pose>,
    #[serde(skip_serializing_if = "Vec::is_empty")]
    out_of_limits: Vec<OutOfLimits>,
}

/// An eigenvalue of the stiffness in (dp, ℓ dφ) and its motion.
#[derive(Serialize)]
struct Eigenvalue {
    /// Stiffness of the motion [N/m].
    #[serde(rename = "stiffness_n_per_m")]
    stiffness: f64,
    /// Translation of P [m/m], with `|translation|² + ℓ² |rotation|² = 1`.
    translation: [f64; 3],
    /// Rotation vector [rad/m].
    rotation: [f64; 3],
}

impl Row for Answer {
    fn columns(robot: &Robot) -> Vec<String> {
        let names = ["least_stiffness_n_per_m", "characteristic_length_m"].into_iter().map(str::to_owned);
        let eigenvalues = (1..=robot.freedoms().count()).map(|i| format!("eigenvalue_{i}_n_per_m"));
        let entries = (1..=6).flat_map(|row| (1..=6).map(move |column| entry(row, column)));
        names.chain(eigenvalues).chain(entries).collect()
    }

    fn cells(&self) -> Vec<String> {
        // Neutral motions are the softest.
        let neutral = self.neutral.iter().map(|_| &0.0);
        let eigenvalues = neutral.chain(self.eigenvalues.iter().map(|eigenvalue| &eigenvalue.stiffness));
        let first = [&self.least_stiffness, &self.characteristic_length].into_iter();
        cells(first.chain(eigenvalues).chain(self.stiffness.as_flattened()))
    }

    fn found_pose(&self) -> Option<Pose> {
        self.found_pose
    }

    fn brief(&self) -> Vec<Brief> {
        vec![Brief::Least("softest motion", "N/m", Some(self.least_stiffness))]
    }

    fn out_of_limits(&self) -> Vec<&[OutOfLimits]> {
        vec![&self.out_of_limits]
    }
}

/// Name of the entry of K in a row and a column from 1, which the first three of both have of translations.
fn entry(row: usize, column: usize) -> String {
    let unit = match (row <= 3, column <= 3) {
        (true, true) => "n_per_m",
        (true, false) => "n_per_rad",
        (false, true) => "n",
        (false, false) => "nm_per_rad",
    };
    format!("k_{row}{column}_{unit}")
}

impl Answer {
    fn new(robot: &Robot, found: &PoseStiffness) -> Self {
        let PoseStiffness { matrix, symmetric_part, stability, lengths, equilibrium } = found;
        Self {
            stiffness: matrix.transpose().into(),
            symmetric_part: symmetric_part.transpose().into(),
            is_point: robot.platform.point,
            eigenvalues: stability
                .modes()
                .iter()
                .map(|mode| Eigenvalue {
                    stiffness: mode.stiffness,
                    translation: mode.translation.into(),
                    rotation: mode.rotation.into(),
                })
                .collect(),
            least_stiffness: stability.least_stiffness(),
            stable: stability.is_stable(),
            neutral: Neutral::all(stability),
            characteristic_length: stability.characteristic_length(),
            found_pose: None,
            out_of_limits: OutOfLimits::all(robot, lengths, &[equilibrium]),
        }
    }

    fn print(&self, heading: &str) {
        let stable = answer::stability_word(self.stable);
        let least = significant(self.least_stiffness, 5);
        print_sentence(&format!("{heading} is {stable}; its softest motion has {least} N/m."));
        let names = ["eigenvalue [N/m]", "translation [m/m]", "rotation [rad/m]"];
        let shown = if self.is_point { 2 } else { 3 };
        let mut rows = table(&names[..shown]);
        let decimals = decimals_of(self.eigenvalues.iter().map(|of| of.stiffness), 1);
        for Eigenvalue { stiffness, translation, rotation } in &self.eigenvalues {
            let words = |vector: &[f64; 3]| answer::vector(vector, 4);
            let cells = [decimal(*stiffness, decimals), words(translation), words(rotation)];
            rows.add_row(cells.into_iter().take(shown));
        }
        println!("{rows}");
        if !self.is_point {
            println!("rotations times \u{2113} = {} m", visible(self.characteristic_length, 4));
        }
        Neutral::print(&self.neutral);
        OutOfLimits::print(&self.out_of_limits);
        let head = if self.is_point { "K [N/m]:" } else { "K in (dp, d\u{3c6}) [N/m, N/rad, N, N m/rad]:" };
        let [whole, symmetric] = [&self.stiffness, &self.symmetric_part].map(|matrix| self.lines(matrix));
        println!("{head}");
        whole.iter().for_each(|line| println!("{line}"));
        // The other part may be too small for the digits that are printed.
        if whole != symmetric {
            println!("its symmetric part, which has these eigenvalues:");
            symmetric.iter().for_each(|line| println!("{line}"));
        }
    }

    /// The rows of a matrix, those of translations alone of a point mass.
    fn lines(&self, matrix: &[[f64; 6]; 6]) -> Vec<String> {
        // Forces and moments have blocks of their own, which may differ by far.
        let of_block = |k: usize| {
            let rows = matrix.iter().skip(3 * (k / 2)).take(3);
            decimals_of(rows.flat_map(|row| row.iter().skip(3 * (k % 2)).take(3).copied()), 1).min(8)
        };
        let decimals = [0, 1, 2, 3].map(of_block);
        let size = if self.is_point { 3 } else { 6 };
        let line = |(i, row): (usize, &[f64; 6])| {
            let entry =
                |(k, entry): (usize, &f64)| format!("{:>13}", decimal(*entry, decimals[2 * (i / 3) + k / 3]));
            row.iter().enumerate().take(size).map(entry).collect()
        };
        matrix.iter().enumerate().take(size).map(line).collect()
    }
}
