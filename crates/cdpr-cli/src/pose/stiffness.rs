//! `cdpr stiffness`: the Cartesian stiffness at a pose, with its eigenvalues and their motions.

use crate::answer::{self, decimal};
use crate::arguments::RobotAtPose;
use crate::error::ProgramError;
use crate::output::table;
use cdpr_statics::{PoseStiffness, stiffness_at};
use serde::Serialize;

pub(crate) fn run(at: &RobotAtPose) -> Result<(), ProgramError> {
    let robot = at.open()?;
    at.print(&robot, &Answer::new(&stiffness_at(&robot, &at.pose, &at.load.load())?), Answer::print)
}

/// The stiffness.
#[derive(Serialize)]
struct Answer {
    /// Rows of K in (dp, dφ) [N/m, N/rad, N, N m/rad].
    stiffness: [[f64; 6]; 6],
    /// Eigenvalues, the softest motion first.
    eigenvalues: Vec<Eigenvalue>,
    least_stiffness: f64,
    stable: bool,
    /// Characteristic length ℓ, which makes rotations comparable with translations [m].
    characteristic_length: f64,
}

/// An eigenvalue of the stiffness in (dp, ℓ dφ) and its motion.
#[derive(Serialize)]
struct Eigenvalue {
    /// Stiffness of the motion [N/m].
    stiffness: f64,
    /// Translation of P [m/m], with `|translation|² + ℓ² |rotation|² = 1`.
    translation: [f64; 3],
    /// Rotation vector [rad/m].
    rotation: [f64; 3],
}

impl Answer {
    fn new(PoseStiffness { matrix, stability }: &PoseStiffness) -> Self {
        Self {
            stiffness: matrix.transpose().into(),
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
            characteristic_length: stability.characteristic_length(),
        }
    }

    fn print(&self, heading: &str) {
        println!("{heading}: K in (dp, d\u{3c6}) [N/m, N/rad, N, N m/rad]");
        for row in self.stiffness {
            println!("{}", row.map(|entry| format!("{:>14}", decimal(entry, 1))).concat());
        }
        let mut rows = table(&["eigenvalue [N/m]", "translation [m/m]", "rotation [rad/m]"]);
        for Eigenvalue { stiffness, translation, rotation } in &self.eigenvalues {
            let words = |vector: &[f64; 3]| answer::vector(vector, 4);
            rows.add_row([format!("{stiffness:.1}"), words(translation), words(rotation)]);
        }
        println!("{rows}");
        let stable = if self.stable { "stable" } else { "unstable" };
        println!(
            "{stable}; least stiffness {:.1} N/m, with rotations times \u{2113} = {:.4} m",
            self.least_stiffness, self.characteristic_length
        );
    }
}
