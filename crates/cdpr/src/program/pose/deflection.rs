//! `cdpr deflection`: how far a load displaces and rotates the platform.

use crate::program::answer::{Found, OutOfLimits, decimal, vector};
use crate::program::error::ProgramError;
use crate::program::output::{Details, Ending, print_sentence, table};
use crate::program::pose::at_pose::{RobotAtFreePose, Row, cells, numbered};
use cdpr_robot::{Robot, Vector3};
use cdpr_statics::{Deflection, WantedPose, deflection};
use serde::Serialize;

/// The robot, its poses and the load.
#[derive(clap::Args)]
pub(crate) struct Settings {
    #[command(flatten)]
    at: RobotAtFreePose,
    #[command(flatten)]
    details: Details,
}

pub(crate) fn run(
    Settings { at: RobotAtFreePose { at, free }, details }: &Settings,
) -> Result<Ending, ProgramError> {
    let load = at.load.some_load()?;
    let solve = |robot: &Robot, pose: &_| {
        let found = deflection(robot, WantedPose::at(pose).free(&free.free), &load)?;
        Ok(Answer::new(robot, &found))
    };
    at.answer(solve, |answer, heading| answer.print(heading, details.details))
}

/// The deflection, in SI units unless the name says otherwise.
#[derive(Serialize)]
struct Answer {
    /// Displacement dp of P, Eq. (4).
    deflection_mm: [f64; 3],
    /// Its norm |dp|; zero where it is not above rounding.
    magnitude_mm: f64,
    /// Error of dp by rounding.
    rounding_mm: f64,
    /// Rotation vector from the unloaded to the loaded platform.
    rotation_deg: [f64; 3],
    /// Unstrained lengths.
    lengths: Vec<f64>,
    unloaded: Found,
    loaded: Found,
}

impl Row for Answer {
    fn columns(robot: &Robot) -> Vec<String> {
        let cables = robot.cables.len();
        let motion = ["dx_mm", "dy_mm", "dz_mm", "magnitude_mm", "rx_deg", "ry_deg", "rz_deg"];
        let motion = motion.iter().map(ToString::to_string);
        let tensions = ["unloaded_tension", "loaded_tension", "unloaded_exit_tension", "loaded_exit_tension"];
        let tensions = tensions.into_iter().flat_map(|name| numbered(name, "n", cables));
        motion.chain(numbered("length", "m", cables)).chain(tensions).collect()
    }

    fn cells(&self) -> Vec<String> {
        let motion = self.deflection_mm.iter().chain([&self.magnitude_mm]).chain(&self.rotation_deg);
        let tensions = self.unloaded.tensions.iter().chain(&self.loaded.tensions);
        let exit_tensions = self.unloaded.exit_tensions.iter().chain(&self.loaded.exit_tensions);
        cells(motion.chain(&self.lengths).chain(tensions).chain(exit_tensions))
    }

    fn out_of_limits(&self) -> Vec<&[OutOfLimits]> {
        vec![&self.unloaded.out_of_limits, &self.loaded.out_of_limits]
    }
}

impl Answer {
    fn new(robot: &Robot, found: &Deflection) -> Self {
        let rounding = found.rounding(robot);
        let displacement = if found.magnitude() > rounding { found.displacement() } else { Vector3::zeros() };
        let motion = found.unloaded.equilibrium.pose.motion_to(&found.loaded.equilibrium.pose);
        Self {
            deflection_mm: (1e3 * displacement).into(),
            magnitude_mm: 1e3 * displacement.norm(),
            rounding_mm: 1e3 * rounding,
            rotation_deg: [3, 4, 5].map(|row| motion[row].to_degrees()),
            lengths: found.lengths.clone(),
            unloaded: Found::new(robot, &found.lengths, &found.unloaded),
            loaded: Found::new(robot, &found.lengths, &found.loaded),
        }
    }

    fn print(&self, heading: &str, details: bool) {
        let stays = match self.loaded.is_stable() {
            true => "it stays stable",
            false => "it is unstable then",
        };
        print_sentence(&format!("{heading} is displaced by {:.5} mm; {stays}.", self.magnitude_mm));
        println!("dp = {} mm", vector(&self.deflection_mm, 5));
        if self.magnitude_mm == 0.0 {
            println!("no displacement above rounding, {:.1e} mm", self.rounding_mm);
        }
        println!("rotated by {} degrees", vector(&self.rotation_deg, 5));
        if details {
            println!();
            self.unloaded.print("Under its own weight the platform", &self.lengths);
            println!();
            return self.loaded.print("With the load the platform", &self.lengths);
        }
        let mut rows = table(&["cable", "unstrained length [m]", "tension [N]", "with the load [N]"]);
        let tensions = self.unloaded.tensions.iter().zip(&self.loaded.tensions);
        for (i, (length, (unloaded, loaded))) in self.lengths.iter().zip(tensions).enumerate() {
            let numbers = [decimal(*unloaded, 3), decimal(*loaded, 3)];
            rows.add_row([(i + 1).to_string(), format!("{length:.6}")].into_iter().chain(numbers));
        }
        println!("{rows}");
        if !self.unloaded.out_of_limits.is_empty() {
            println!("under its own weight:");
            OutOfLimits::print(&self.unloaded.out_of_limits);
        }
        println!("with the load:");
        self.loaded.print_rest();
    }
}
