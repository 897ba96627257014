//! `cdpr derivatives`: the derivatives of lengths and deflection with respect to each parameter.

mod amplitude;
mod answer;
mod leading;
mod uncertainty;
mod weather;

use crate::program::arguments::{self, Format, UncertaintyArgument, WEATHER, WindArgument, With, with};
use crate::program::error::ProgramError;
use crate::program::output::{Details, Ending};
use crate::program::pose::at_pose::RobotAtFreePose;
use amplitude::Amplitude;
use answer::Slopes;
use cdpr_robot::Robot;
use cdpr_statics::{Load, Observer, WantedPose, derivatives};
use cdpr_study::explained_deflection;
use uncertainty::Uncertainty;
use weather::InWeather;

/// The robot, its poses, and what is uncertain.
#[derive(clap::Args)]
pub(crate) struct Settings {
    #[command(flatten)]
    at: RobotAtFreePose,
    #[command(flatten)]
    errors: UncertaintyArgument,
    /// amplitude=HZ: derivatives of the amplitude of a platform that is shaken; damping, drag, along. ice=
    /// and others, with --wind or without: derivatives of the displacement in that weather.
    ///
    /// warmer=KELVIN with cable_expansion=, frame_expansion=, ice=METRES, creep=STRAIN, wind_profile=Z0:ZREF:
    /// as those of `deflection`. Of the point --marker with the load, per newton of a force there, in the
    /// worst direction or along=x, y or z. damping=TAU and drag=RATE damp the cables, as those of `response`
    /// (2e-4 s, none).
    #[arg(long, value_name = "NAMES", value_parser = with)]
    with: Option<With>,
    #[command(flatten)]
    wind: WindArgument,
    /// Point of the platform that is shaken: x,y,z in its frame [m]; P if left out.
    #[arg(long, value_parser = arguments::components::<3>, allow_hyphen_values = true)]
    marker: Option<[f64; 3]>,
    #[command(flatten)]
    details: Details,
}

pub(crate) fn run(
    Settings { at: RobotAtFreePose { at, free }, errors, with, wind, marker, details }: &Settings,
) -> Result<Ending, ProgramError> {
    let with =
        With::known(with.as_ref(), &[&["amplitude", "damping", "drag", "along"], &WEATHER[..]].concat())?;
    let weather = wind.weather(&with)?;
    let load = at.load.load();
    let is_table = match at.printing.format() {
        Format::Csv => true,
        Format::Text => at.pose()?.is_none(),
        Format::Json => false,
    };
    let shaken = amplitude::asked(&with, *marker, is_table)?;
    if weather.is_some() && is_table {
        let expected = "expected --format json, as the table has no columns for weather";
        return Err(ProgramError::Usage(format!("--wind, --with: {expected}")));
    }
    let robot = at.robot()?;
    let model = errors.model(&robot)?;
    if model.is_some() && load == Load::none() {
        let expected = "expected --payload, --force or --moment, whose displacement is uncertain";
        return Err(ProgramError::Usage(format!("--uncertainty: {expected}")));
    }
    model.as_ref().map(|model| model.check(&robot)).transpose()?;
    let solve = |robot: &Robot, pose: &_| {
        let found = derivatives(robot, WantedPose::at(pose).free(&free.free), &load)?;
        let mut slopes = Slopes::new(robot, &load, &found);
        slopes.amplitude = shaken.map(|at| Amplitude::new(robot, &load, &found, &at)).transpose()?;
        slopes.in_weather = weather
            .map(|weather| InWeather::new(robot, WantedPose::at(pose).free(&free.free), &load, &weather))
            .transpose()?;
        slopes.uncertainty = model.as_ref().map(|model| Uncertainty::new(model, &found)).transpose()?;
        // With free coordinates the scalar models search for each robot, which takes too long.
        if let (Some(uncertainty), Some(model), []) = (&mut slopes.uncertainty, &model, &free.free[..]) {
            let observer = Observer::new(robot, WantedPose::at(pose), &load)?;
            uncertainty.explained = explained_deflection(&observer, model, &found);
        }
        Ok(slopes)
    };
    at.answer(solve, |slopes, heading| slopes.print(heading, details.details))
}
