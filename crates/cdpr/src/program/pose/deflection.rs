//! `cdpr deflection`: how far a load or the wind displaces and rotates the platform.

use crate::program::answer::{Found, OutOfLimits, Residual, decimal, vector};
use crate::program::arguments::components;
use crate::program::error::ProgramError;
use crate::program::output::{Details, Ending, print_sentence, table};
use crate::program::pose::at_pose::{RobotAtFreePose, Row, cells, numbered};
use cdpr_robot::{Pose, Robot, Vector3, Vector6};
use cdpr_statics::wind::{RestInWind, Wind};
use cdpr_statics::{Deflection, DirectProblem, WantedPose, deflection};
use serde::Serialize;

/// The robot, its poses, the load and the wind.
#[derive(clap::Args)]
pub(crate) struct Settings {
    #[command(flatten)]
    at: RobotAtFreePose,
    /// Velocity of the wind on the cables, in the base frame: vx,vy,vz [m/s].
    ///
    /// Air of 1.225 kg/m³ and cables with a drag coefficient of 1.2; with others, the wind that is
    /// sqrt(density coefficient/1.47) times as fast. Wind on the platform itself is a load, as --force.
    #[arg(long, value_name = "VX,VY,VZ", value_parser = components::<3>, allow_hyphen_values = true)]
    wind: Option<[f64; 3]>,
    #[command(flatten)]
    details: Details,
}

pub(crate) fn run(
    Settings { at: RobotAtFreePose { at, free }, wind, details }: &Settings,
) -> Result<Ending, ProgramError> {
    let details = details.details;
    let Some(velocity) = wind else {
        let load = at.load.some_load()?;
        let solve = |robot: &Robot, pose: &Pose| {
            let found = deflection(robot, WantedPose::at(pose).free(&free.free), &load)?;
            Ok(Answer::new(robot, &found))
        };
        return at.answer(solve, |answer, heading| answer.print(heading, details));
    };
    let (wind, load) = (Wind::new((*velocity).into())?, at.load.load());
    let solve = |robot: &Robot, pose: &Pose| {
        let still = deflection(robot, WantedPose::at(pose).free(&free.free), &load)?;
        let rest = DirectProblem::new(robot, &still.lengths, &load)?.in_wind(&wind, &still.loaded)?;
        Ok(AnswerInWind::new(robot, &still, &rest))
    };
    at.answer(solve, |answer, heading| answer.print(heading, details))
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

/// The same with wind on the cables.
#[derive(Serialize)]
struct AnswerInWind {
    #[serde(flatten)]
    still: Answer,
    in_wind: InWind,
}

/// The platform in the wind and under the load.
#[derive(Serialize)]
struct InWind {
    /// Displacement of P from the pose without load and wind, its norm and the rotation vector.
    deflection_mm: [f64; 3],
    magnitude_mm: f64,
    rotation_deg: [f64; 3],
    tensions: Vec<f64>,
    exit_tensions: Vec<f64>,
    /// Force of the wind on all cables [N], of which the platform bears a part.
    drag: [f64; 3],
    #[serde(skip_serializing_if = "Vec::is_empty")]
    out_of_limits: Vec<OutOfLimits>,
    residual: Residual,
    /// Error of the integration along the cables [m].
    integration: f64,
}

impl AnswerInWind {
    fn new(robot: &Robot, still: &Deflection, rest: &RestInWind) -> Self {
        let motion: Vector6<f64> = still.unloaded.equilibrium.pose.motion_to(&rest.pose);
        let displacement = Vector3::from(motion.fixed_rows::<3>(0));
        let (tensions, exit_tensions) = (rest.tensions(), rest.exit_tensions.clone());
        let ends = tensions.iter().zip(&exit_tensions).map(|(anchor, exit)| [*anchor, *exit]).collect();
        let found = cdpr_statics::limits::tensions_out_of_limits(robot, &[ends]);
        Self {
            still: Answer::new(robot, still),
            in_wind: InWind {
                deflection_mm: (1e3 * displacement).into(),
                magnitude_mm: 1e3 * displacement.norm(),
                rotation_deg: [3, 4, 5].map(|row| motion[row].to_degrees()),
                tensions,
                exit_tensions,
                drag: rest.drags.iter().sum::<Vector3<f64>>().into(),
                out_of_limits: found.into_iter().map(OutOfLimits::new).collect(),
                residual: Residual::new(&rest.residual),
                integration: rest.integration,
            },
        }
    }

    fn print(&self, heading: &str, details: bool) {
        let Self { still, in_wind } = self;
        print_sentence(&format!("{heading} is displaced by {:.5} mm in the wind.", in_wind.magnitude_mm));
        println!("dp = {} mm", vector(&in_wind.deflection_mm, 5));
        println!("rotated by {} degrees", vector(&in_wind.rotation_deg, 5));
        if still.magnitude_mm > 0.0 {
            println!("without wind the load displaces it by {:.5} mm", still.magnitude_mm);
        }
        println!("force of the wind on all cables {} N", vector(&in_wind.drag, 3));
        let mut rows =
            table(&["cable", "unstrained length [m]", "tension [N]", "in the wind [N]", "at exit point [N]"]);
        let tensions = still.unloaded.tensions.iter().zip(&in_wind.tensions).zip(&in_wind.exit_tensions);
        for (i, (length, ((unloaded, blown), exit))) in still.lengths.iter().zip(tensions).enumerate() {
            let numbers = [*unloaded, *blown, *exit].map(|tension| decimal(tension, 3));
            rows.add_row([(i + 1).to_string(), format!("{length:.6}")].into_iter().chain(numbers));
        }
        println!("{rows}");
        OutOfLimits::print(&in_wind.out_of_limits);
        in_wind.residual.print();
        if details {
            println!();
            still.loaded.print("Without wind the platform", &still.lengths);
        }
    }
}

impl Row for AnswerInWind {
    fn columns(robot: &Robot) -> Vec<String> {
        let motion = ["dx", "dy", "dz", "magnitude"].map(|name| format!("wind_{name}_mm"));
        let rotation = ["rx", "ry", "rz"].map(|name| format!("wind_{name}_deg"));
        let tensions = ["wind_tension", "wind_exit_tension"].into_iter();
        let of_cables = tensions.flat_map(|name| numbered(name, "n", robot.cables.len()));
        Answer::columns(robot).into_iter().chain(motion).chain(rotation).chain(of_cables).collect()
    }

    fn cells(&self) -> Vec<String> {
        let InWind { deflection_mm, magnitude_mm, rotation_deg, tensions, exit_tensions, .. } = &self.in_wind;
        let motion = deflection_mm.iter().chain([magnitude_mm]).chain(rotation_deg);
        let own = cells(motion.chain(tensions).chain(exit_tensions));
        self.still.cells().into_iter().chain(own).collect()
    }

    fn out_of_limits(&self) -> Vec<&[OutOfLimits]> {
        let mut lists = self.still.out_of_limits();
        lists.push(&self.in_wind.out_of_limits);
        lists
    }
}
