//! The weather that a robot is in: `--wind 20,0,0 --with ice=0.003`, or `--with wind=20`.

use crate::program::arguments::{With, components, number};
use crate::program::error::ProgramError;
use crate::program::said::note;
use cdpr_assess::AnyWeather;
use cdpr_robot::Robot;
use cdpr_statics::weather::{Weather, Wind, WindProfile};
use std::sync::Once;

/// Names of `--with` that change the weather, `wind` aside.
pub(crate) const WEATHER: [&str; 6] =
    ["warmer", "cable_expansion", "frame_expansion", "ice", "creep", "wind_profile"];

/// Wind of one velocity.
#[derive(clap::Args)]
pub(crate) struct WindArgument {
    /// Velocity of the wind on the cables, in the base frame: vx,vy,vz [m/s].
    ///
    /// Air of 1.225 kg/m³ and cables with a drag coefficient of 1.2; with others, the wind that is
    /// sqrt(density coefficient/1.47) times as fast. Wind on the platform itself is a load, as --force.
    #[arg(long, value_name = "VX,VY,VZ", value_parser = components::<3>, allow_hyphen_values = true)]
    wind: Option<[f64; 3]>,
}

impl WindArgument {
    /// The weather, if any is given.
    pub(crate) fn weather(&self, with: &With) -> Result<Option<Weather>, ProgramError> {
        weather(with, self.wind, self.wind.is_some())
    }
}

/// The weather with a wind of any direction, `wind=SPEED`, or of one velocity, `wind=VX:VY:VZ`; if any is
/// given.
pub(crate) fn any_weather(with: &With) -> Result<Option<AnyWeather>, ProgramError> {
    let (speed, velocity) = match with.value("wind", None, speed_or_velocity)? {
        None => (None, None),
        Some(Blowing::From(velocity)) => (None, Some(velocity)),
        Some(Blowing::AtSpeed(speed)) => {
            Wind::new([speed, 0.0, 0.0].into())?;
            (Some(speed), None)
        }
    };
    let found = weather(with, velocity, speed.is_some() || velocity.is_some())?;
    Ok(found.map(|weather| AnyWeather { weather, speed }))
}

/// How a wind is given.
enum Blowing {
    AtSpeed(f64),
    From([f64; 3]),
}

fn speed_or_velocity(text: &str) -> Result<Blowing, String> {
    let expected = || {
        "expected a speed above 0 m/s, from any direction, as in wind=20, or a velocity, as in wind=20:0:0"
            .to_owned()
    };
    let numbers: Vec<f64> = text.split(':').map(number).collect::<Result<_, _>>().map_err(|_| expected())?;
    match numbers[..] {
        [speed] if speed > 0.0 => Ok(Blowing::AtSpeed(speed)),
        [x, y, z] => Ok(Blowing::From([x, y, z])),
        _ => Err(expected()),
    }
}

fn weather(with: &With, velocity: Option<[f64; 3]>, blows: bool) -> Result<Option<Weather>, ProgramError> {
    let mut some = blows;
    let mut value = |name| {
        let value = with.value(name, None, number)?;
        some |= value.is_some();
        Ok::<_, ProgramError>(value.unwrap_or_default())
    };
    let mut found = Weather {
        wind: Wind::new(velocity.unwrap_or_default().into())?,
        warmer: value("warmer")?,
        cable_expansion: value("cable_expansion")?,
        frame_expansion: value("frame_expansion")?,
        ice: value("ice")?,
        creep: value("creep")?,
    };
    // In a sweep over temperatures one may be none.
    if with.value("warmer", None, number)? == Some(0.0) {
        (found.cable_expansion, found.frame_expansion) = (0.0, 0.0);
    }
    if let Some(profile) = with.value("wind_profile", None, profile)? {
        if !blows {
            let expected = "--with wind_profile: expected a wind, too, which it changes";
            return Err(ProgramError::Usage(expected.to_owned()));
        }
        found.wind = found.wind.over_height(profile)?;
    }
    Ok(some.then_some(found))
}

/// `0.3:10`.
fn profile(text: &str) -> Result<WindProfile, String> {
    let numbers = text.split_once(':').and_then(|(a, b)| Some([number(a).ok()?, number(b).ok()?]));
    let expected = "expected the roughness length of the ground and the height at which the wind has its \
                    speed [m], such as wind_profile=0.3:10";
    numbers
        .map(|[roughness, reference]| WindProfile { roughness, reference })
        .ok_or_else(|| expected.to_owned())
}

/// Notes what the models leave out of a wind on cables over pulleys.
pub(crate) fn note_pulleys(robot: &Robot, is_windy: bool) {
    let over_pulleys =
        robot.cables.iter().any(|cable| cable.pulley.is_some_and(|pulley| pulley.radius > 0.0));
    static NOTED: Once = Once::new();
    if over_pulleys && is_windy {
        NOTED.call_once(|| {
            note(format_args!(
                "cables leave their pulleys as they do without wind, where the wheels would turn: some per cent of \
                 what the wind displaces"
            ));
        });
    }
}

/// ` towards 30 degrees` of an azimuth [rad]; nothing of a wind of one velocity.
pub(crate) fn towards(azimuth: Option<f64>) -> String {
    azimuth.map_or_else(String::new, |azimuth| {
        format!(" towards {:.0} degrees", azimuth.to_degrees().rem_euclid(360.0))
    })
}
