//! Derivatives of the displacement in weather.

use crate::program::output::{print_sentence, table};
use crate::program::pose::derivatives::leading::{LEADING, handy_unit};
use cdpr_robot::{Parameter, Robot, significant};
use cdpr_statics::weather::{Weather, WeatherDerivatives, WeatherInput, weather_derivatives};
use cdpr_statics::{Load, StaticsError, Vector3, WantedPose};
use serde::Serialize;

/// The displacement from the pose without load and weather, with its derivatives.
#[derive(Serialize)]
pub(super) struct InWeather {
    displacement_mm: [f64; 3],
    magnitude_mm: f64,
    /// Derivatives of the displacement by each parameter, in their order [mm per SI unit].
    derivatives_mm: Vec<[f64; 3]>,
    /// Of its norm; absent where that is zero.
    #[serde(skip_serializing_if = "Option::is_none")]
    magnitude_derivatives_mm: Option<Vec<f64>>,
    by_weather: Vec<ByWeather>,
}

/// The derivative by a number of the weather; `without` says why it does not exist.
#[derive(Serialize)]
struct ByWeather {
    name: &'static str,
    unit: &'static str,
    #[serde(skip_serializing_if = "Option::is_none")]
    displacement_mm: Option<[f64; 3]>,
    #[serde(skip_serializing_if = "Option::is_none")]
    magnitude_mm: Option<f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    without: Option<String>,
    /// A step of usual size.
    #[serde(skip)]
    step: (&'static str, f64),
}

/// A step of the size that such a number changes by.
fn step(input: WeatherInput) -> (&'static str, f64) {
    match input {
        WeatherInput::Warmer => ("K", 1.0),
        WeatherInput::CableExpansion | WeatherInput::FrameExpansion => ("1e-6/K", 1e-6),
        WeatherInput::Ice => ("mm", 1e-3),
        WeatherInput::Creep => ("0.01 %", 1e-4),
        WeatherInput::Wind => ("m/s", 1.0),
        WeatherInput::Direction => ("degree", 1f64.to_radians()),
    }
}

impl InWeather {
    pub(super) fn new(
        robot: &Robot,
        wanted: WantedPose,
        load: &Load,
        weather: &Weather,
    ) -> Result<Self, StaticsError> {
        let found = weather_derivatives(robot, wanted, load, weather)?;
        let by_weather = WeatherInput::ALL.into_iter().zip(&found.per_weather);
        Ok(Self {
            displacement_mm: (1e3 * found.displaced()).into(),
            magnitude_mm: 1e3 * found.displaced().norm(),
            derivatives_mm: parameters(&found).map(|slope| (1e3 * slope).into()).collect(),
            magnitude_derivatives_mm: parameters(&found)
                .map(|slope| Some(1e3 * found.magnitude(&slope)?))
                .collect(),
            by_weather: by_weather.map(|(input, slope)| ByWeather::new(&found, input, slope)).collect(),
        })
    }

    /// The displacement, and what changes it most.
    pub(super) fn print(&self, inputs: &[Parameter]) {
        print_sentence(&format!(
            "In the weather and under the load it is displaced by {} mm.",
            significant(self.magnitude_mm, 4)
        ));
        let by_weather = self.by_weather.iter().filter_map(|by| {
            let (unit, step) = by.step;
            Some((by.name.to_owned(), 1e3 * by.magnitude_mm? * step, unit))
        });
        let by_parameter = inputs.iter().zip(self.magnitude_derivatives_mm.iter().flatten());
        let by_parameter = by_parameter.map(|(parameter, slope)| {
            let (unit, step) = handy_unit(parameter);
            (parameter.to_string(), 1e3 * slope * step, unit)
        });
        let mut parameters: Vec<_> = by_parameter.collect();
        parameters.sort_by(|one, other| other.1.abs().total_cmp(&one.1.abs()));
        let mut lines = table(&["in the weather", "d|dp| [\u{b5}m]", "per"]);
        for (name, change, unit) in by_weather.chain(parameters.into_iter().take(LEADING)) {
            lines.add_row([name, significant(change, 4), unit.to_owned()]);
        }
        println!("{lines}");
        for by in &self.by_weather {
            by.without.iter().for_each(|reason| print_sentence(&format!("{}: {reason}.", by.name)));
        }
    }
}

/// Derivatives by the parameters of the robot.
fn parameters(found: &WeatherDerivatives) -> impl Iterator<Item = Vector3<f64>> {
    let count = found.inputs.parameters.len();
    found.displacement.column_iter().take(count).map(Into::into)
}

impl ByWeather {
    fn new(
        found: &WeatherDerivatives,
        input: WeatherInput,
        slope: &Result<Vector3<f64>, StaticsError>,
    ) -> Self {
        let known = slope.as_ref().ok();
        Self {
            name: input.name(),
            unit: input.unit(),
            displacement_mm: known.map(|slope| (1e3 * slope).into()),
            magnitude_mm: known.and_then(|slope| Some(1e3 * found.magnitude(slope)?)),
            without: slope.as_ref().err().map(ToString::to_string),
            step: step(input),
        }
    }
}
