//! `cdpr deflection`: how far a load or the weather displaces and rotates the platform.

use crate::program::answer::{Borne, Found, OutOfLimits, Residual, decimal, vector};
use crate::program::arguments::poses::as_numbers;
use crate::program::arguments::{WEATHER, WindArgument, With, note_pulleys, with};
use crate::program::error::ProgramError;
use crate::program::output::{Details, Ending, print_sentence, table};
use crate::program::pose::at_pose::{Brief, RobotAtFreePose, Row, cells, numbered};
use crate::program::questions;
use cdpr_robot::{Pose, Robot, Vector3, Vector6, decimals_of, visible};
use cdpr_statics::weather::{RestInWeather, Weather, in_weather};
use cdpr_statics::{Deflection, Load, WantedPose, deflection};
use serde::Serialize;

/// The robot, its poses, the load and the weather.
#[derive(clap::Args)]
pub(crate) struct Settings {
    #[command(flatten)]
    at: RobotAtFreePose,
    #[command(flatten)]
    wind: WindArgument,
    /// What else changes while the winches hold: warmer=KELVIN with cable_expansion=, frame_expansion= [1/K];
    /// ice=METRES around each cable; creep=STRAIN of each cable; wind_profile=Z0:ZREF, a wind that grows with
    /// height.
    #[arg(long, value_name = "NAME=VALUE,..", value_parser = with)]
    with: Option<With>,
    #[command(flatten)]
    details: Details,
}

pub(crate) fn run(settings: &Settings) -> Result<Ending, ProgramError> {
    let RobotAtFreePose { at, free } = &settings.at;
    let details = settings.details.details;
    let with = With::known(settings.with.as_ref(), &WEATHER)?;
    let Some(weather) = settings.wind.weather(&with)? else {
        let load = at.load.some_load()?;
        let solve = |robot: &Robot, pose: &Pose| {
            let found = deflection(robot, WantedPose::at(pose).free(&free.free), &load)?;
            let [unloaded, loaded] = [&found.unloaded, &found.loaded].map(|found| &found.equilibrium.pose);
            questions::about_displaced(robot, unloaded, loaded);
            let found_pose = free.found(unloaded);
            Ok(Answer { found_pose, ..Answer::new(robot, &found, &load) })
        };
        return at.answer(solve, |answer, heading| answer.print(heading, details));
    };
    let load = at.load.load();
    let solve = |robot: &Robot, pose: &Pose| {
        let (still, rest) = in_weather(robot, WantedPose::at(pose).free(&free.free), &load, &weather)?;
        let mut answer = AnswerInWeather::new(robot, (&still, &load), &rest, &weather);
        answer.still.found_pose = free.found(&still.unloaded.equilibrium.pose);
        Ok(answer)
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
    /// Unstrained lengths, with the load a case of `cdpr direct`.
    lengths: Vec<f64>,
    #[serde(flatten)]
    load: Borne,
    /// The pose with its free coordinates as they are found.
    #[serde(skip_serializing_if = "Option::is_none", serialize_with = "as_numbers")]
    found_pose: Option<Pose>,
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

    fn found_pose(&self) -> Option<Pose> {
        self.found_pose
    }

    fn brief(&self) -> Vec<Brief> {
        let most = Brief::Most("|dp|", "mm", Some(self.magnitude_mm));
        vec![most, Brief::tensions("loaded at", &self.loaded.tensions)]
    }

    fn out_of_limits(&self) -> Vec<&[OutOfLimits]> {
        vec![&self.unloaded.out_of_limits, &self.loaded.out_of_limits]
    }
}

impl Answer {
    fn new(robot: &Robot, found: &Deflection, load: &Load) -> Self {
        let rounding = found.rounding(robot);
        let displacement = if found.magnitude() > rounding { found.displacement() } else { Vector3::zeros() };
        let motion = found.unloaded.equilibrium.pose.motion_to(&found.loaded.equilibrium.pose);
        Self {
            deflection_mm: (1e3 * displacement).into(),
            magnitude_mm: 1e3 * displacement.norm(),
            rounding_mm: 1e3 * rounding,
            rotation_deg: [3, 4, 5].map(|row| motion[row].to_degrees()),
            lengths: found.lengths.clone(),
            load: load.into(),
            found_pose: None,
            unloaded: Found::new(robot, &found.lengths, &found.unloaded),
            loaded: Found::new(robot, &found.lengths, &found.loaded),
        }
    }

    /// What cables do that bear too much, with the load or already without it.
    fn beyond(&self) -> String {
        let [without, with] =
            [&self.unloaded, &self.loaded].map(|of| OutOfLimits::verdict(&of.out_of_limits));
        match (with.is_empty(), without.is_empty()) {
            (true, false) => format!("{without} without the load"),
            _ => with,
        }
    }

    fn print(&self, heading: &str, details: bool) {
        let beyond = self.beyond();
        let stays = match self.loaded.is_stable() {
            true if beyond.is_empty() => "; it stays stable",
            true => "",
            false => "; it is unstable then",
        };
        let moved = visible(self.magnitude_mm, 5);
        print_sentence(&format!("{heading} is displaced by {moved} mm{beyond}{stays}."));
        println!("dp = {} mm", vector(&self.deflection_mm, decimals_of(self.deflection_mm, 5)));
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
        let decimals = decimals_of(self.unloaded.tensions.iter().chain(&self.loaded.tensions).copied(), 3);
        let tensions = self.unloaded.tensions.iter().zip(&self.loaded.tensions);
        for (i, (length, (unloaded, loaded))) in self.lengths.iter().zip(tensions).enumerate() {
            let numbers = [unloaded, loaded].map(|tension| decimal(*tension, decimals));
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

/// The same in weather.
#[derive(Serialize)]
struct AnswerInWeather {
    #[serde(flatten)]
    still: Answer,
    in_weather: InWeather,
}

/// The platform in the weather and under the load.
#[derive(Serialize)]
struct InWeather {
    /// Displacement of P from the pose without load and weather, its norm and the rotation vector.
    deflection_mm: [f64; 3],
    magnitude_mm: f64,
    rotation_deg: [f64; 3],
    tensions: Vec<f64>,
    exit_tensions: Vec<f64>,
    /// Force of the wind on all cables [N], of which the platform bears a part.
    #[serde(rename = "drag_n", skip_serializing_if = "Option::is_none")]
    drag: Option<[f64; 3]>,
    #[serde(skip_serializing_if = "Vec::is_empty")]
    out_of_limits: Vec<OutOfLimits>,
    residual: Residual,
    /// Error of the integration along the cables [m].
    #[serde(rename = "integration_m")]
    integration: f64,
}

impl AnswerInWeather {
    fn new(
        robot: &Robot,
        (still, load): (&Deflection, &Load),
        rest: &RestInWeather,
        weather: &Weather,
    ) -> Self {
        note_pulleys(robot, !weather.wind.is_calm());
        let motion: Vector6<f64> = still.unloaded.equilibrium.pose.motion_to(&rest.pose);
        let displacement = Vector3::from(motion.fixed_rows::<3>(0));
        let (tensions, exit_tensions) = (rest.tensions(), rest.exit_tensions.clone());
        let ends = tensions.iter().zip(&exit_tensions).map(|(anchor, exit)| [*anchor, *exit]).collect();
        let found = cdpr_statics::limits::tensions_out_of_limits(robot, &[ends]);
        Self {
            still: Answer::new(robot, still, load),
            in_weather: InWeather {
                deflection_mm: (1e3 * displacement).into(),
                magnitude_mm: 1e3 * displacement.norm(),
                rotation_deg: [3, 4, 5].map(|row| motion[row].to_degrees()),
                tensions,
                exit_tensions,
                drag: (!weather.wind.is_calm()).then(|| rest.drags.iter().sum::<Vector3<f64>>().into()),
                out_of_limits: found.into_iter().map(OutOfLimits::new).collect(),
                residual: Residual::new(&rest.residual),
                integration: rest.integration,
            },
        }
    }

    fn print(&self, heading: &str, details: bool) {
        let Self { still, in_weather } = self;
        print_sentence(&format!(
            "{heading} is displaced by {} mm in this weather{}.",
            visible(in_weather.magnitude_mm, 5),
            OutOfLimits::verdict(&in_weather.out_of_limits)
        ));
        println!("dp = {} mm", vector(&in_weather.deflection_mm, decimals_of(in_weather.deflection_mm, 5)));
        println!("rotated by {} degrees", vector(&in_weather.rotation_deg, 5));
        if still.magnitude_mm > 0.0 {
            println!("without the weather the load displaces it by {} mm", visible(still.magnitude_mm, 5));
        }
        if let Some(drag) = &in_weather.drag {
            println!("force of the wind on all cables {} N", vector(drag, decimals_of(*drag, 3)));
        }
        let mut rows = table(&[
            "cable",
            "unstrained length [m]",
            "tension [N]",
            "in the weather [N]",
            "at exit point [N]",
        ]);
        let decimals =
            decimals_of(still.unloaded.tensions.iter().chain(&in_weather.exit_tensions).copied(), 3);
        let tensions =
            still.unloaded.tensions.iter().zip(&in_weather.tensions).zip(&in_weather.exit_tensions);
        for (i, (length, ((unloaded, blown), exit))) in still.lengths.iter().zip(tensions).enumerate() {
            let numbers = [*unloaded, *blown, *exit].map(|tension| decimal(tension, decimals));
            rows.add_row([(i + 1).to_string(), format!("{length:.6}")].into_iter().chain(numbers));
        }
        println!("{rows}");
        OutOfLimits::print(&in_weather.out_of_limits);
        in_weather.residual.print();
        if details {
            println!();
            still.loaded.print("Without the weather the platform", &still.lengths);
        }
    }
}

impl Row for AnswerInWeather {
    fn columns(robot: &Robot) -> Vec<String> {
        let motion = ["dx", "dy", "dz", "magnitude"].map(|name| format!("weather_{name}_mm"));
        let rotation = ["rx", "ry", "rz"].map(|name| format!("weather_{name}_deg"));
        let tensions = ["weather_tension", "weather_exit_tension"].into_iter();
        let of_cables = tensions.flat_map(|name| numbered(name, "n", robot.cables.len()));
        Answer::columns(robot).into_iter().chain(motion).chain(rotation).chain(of_cables).collect()
    }

    fn cells(&self) -> Vec<String> {
        let InWeather { deflection_mm, magnitude_mm, rotation_deg, tensions, exit_tensions, .. } =
            &self.in_weather;
        let motion = deflection_mm.iter().chain([magnitude_mm]).chain(rotation_deg);
        let own = cells(motion.chain(tensions).chain(exit_tensions));
        self.still.cells().into_iter().chain(own).collect()
    }

    fn found_pose(&self) -> Option<Pose> {
        self.still.found_pose
    }

    fn brief(&self) -> Vec<Brief> {
        let InWeather { magnitude_mm, tensions, .. } = &self.in_weather;
        let most = Brief::Most("displaced", "mm", Some(*magnitude_mm));
        vec![most, Brief::tensions("in the weather at", tensions)]
    }

    fn out_of_limits(&self) -> Vec<&[OutOfLimits]> {
        let mut lists = self.still.out_of_limits();
        lists.push(&self.in_weather.out_of_limits);
        lists
    }
}
