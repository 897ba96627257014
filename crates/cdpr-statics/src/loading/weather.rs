//! A platform in weather: on winches that hold, with cables and frame that expand, cables that creep or carry
//! ice, and wind on the cables.
//!
//! ```text
//! L' = L (1 + α ΔT)(1 + ε)      unstrained length, warmer by ΔT and with the creep strain ε
//! b' = b (1 + α_f ΔT)           exit points, and leads, of a frame that expands from the origin of base
//! ρ' = ρ L/L' + ρ_ice π t (d + t),  d' = d + 2t      with ice of thickness t around a diameter d
//! ```

use crate::direct::DirectStart;
use crate::error::StaticsError;
use crate::loading::deflection::{Deflection, deflection};
use crate::loading::wind::{RestInWeather, Wind};
use crate::problem::DirectProblem;
use crate::state::{Load, WantedPose};
use cdpr_number::{Dual, Real};
use cdpr_robot::{Pose, Robot};
use std::f64::consts::PI;

/// Density of glaze [kg/m³] (ISO 12494:2017, 7.3).
const ICE_DENSITY: f64 = 900.0;

/// What changes between the pose that was wanted and the one that is asked for. [`Weather::default`] changes
/// nothing.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Weather {
    /// Wind on the cables.
    pub wind: Wind,
    /// How much warmer it is [K].
    pub warmer: f64,
    /// Thermal expansion of the cables [1/K]: about 1.2e-5 of steel; fibres of polyethylene and aramid
    /// shrink.
    pub cable_expansion: f64,
    /// Thermal expansion of the frame with its leads [1/K].
    pub frame_expansion: f64,
    /// Thickness of the ice around each cable beyond its winch [m], of 900 kg/m³.
    pub ice: f64,
    /// Strain by which each cable has crept.
    pub creep: f64,
}

impl Weather {
    /// Checks its values, and that a difference of temperature and an expansion come together.
    ///
    /// # Errors
    /// [`StaticsError::Invalid`].
    pub fn check(&self) -> Result<(), StaticsError> {
        self.check_values()?;
        if self.expands() && self.warmer == 0.0 {
            return Err(self.incomplete());
        }
        Ok(())
    }

    /// Whether it changes nothing.
    pub fn is_nothing(&self) -> bool {
        self.wind.is_calm() && [self.warmer, self.ice, self.creep] == [0.0; 3]
    }

    fn expands(&self) -> bool {
        self.cable_expansion != 0.0 || self.frame_expansion != 0.0
    }

    fn incomplete(&self) -> StaticsError {
        let expected = "a difference of temperature together with the expansion of cables, frame or both";
        StaticsError::invalid("warmer".to_owned(), self.warmer, expected)
    }

    fn check_values(&self) -> Result<(), StaticsError> {
        let bounds = [
            ("warmer", self.warmer, -200.0..=200.0, "a difference from -200 to 200 K"),
            ("cable_expansion", self.cable_expansion, -1e-4..=1e-4, "-1e-4 to 1e-4 per K"),
            ("frame_expansion", self.frame_expansion, -1e-4..=1e-4, "-1e-4 to 1e-4 per K"),
            ("ice", self.ice, 0.0..=0.3, "a thickness from 0 to 0.3 m"),
            ("creep", self.creep, 0.0..=0.1, "a strain from 0 to 0.1"),
        ];
        for (name, value, range, expected) in bounds {
            if !range.contains(&value) {
                return Err(StaticsError::invalid(name.to_owned(), value, expected));
            }
        }
        if self.warmer != 0.0 && !self.expands() {
            return Err(self.incomplete());
        }
        Ok(())
    }

    /// Its numbers: warmer, expansion of cables and frame, ice, creep.
    fn numbers(&self) -> [f64; 5] {
        [self.warmer, self.cable_expansion, self.frame_expansion, self.ice, self.creep]
    }

    /// What it makes of a cable, with the derivatives by its numbers in the order of
    /// [`crate::derivatives::WeatherInput`].
    pub(crate) fn slopes(&self, robot: &Robot, i: usize) -> CableInWeather<Dual<f64, 5>> {
        let numbers = self.numbers();
        let properties = &robot.cables[i].properties;
        let diameter = properties.diameter.unwrap_or_default();
        let inputs = [0, 1, 2, 3, 4].map(|k| Dual::input(numbers[k], k));
        CableInWeather::new(inputs, properties.linear_density, diameter)
    }

    /// The robot with its frame and cables as they become.
    ///
    /// # Errors
    /// [`StaticsError::Invalid`] for a value out of its bounds, and for ice on a cable without diameter.
    pub fn robot(&self, robot: &Robot) -> Result<Robot, StaticsError> {
        self.check_values()?;
        let mut changed = robot.clone();
        for (i, cable) in changed.cables.iter_mut().enumerate() {
            let properties = &mut cable.properties;
            if self.ice > 0.0 && properties.diameter.is_none() {
                let expected = "a diameter [m], on which the weight of the ice depends";
                return Err(StaticsError::invalid(format!("cables[{i}].diameter"), "not given", expected));
            }
            let diameter = properties.diameter.unwrap_or_default();
            let made = CableInWeather::new(self.numbers(), properties.linear_density, diameter);
            cable.exit_point *= made.frame;
            cable.lead *= made.frame;
            properties.linear_density = made.linear_density;
            properties.diameter = properties.diameter.map(|_| made.diameter);
        }
        Ok(changed)
    }

    /// Unstrained lengths [m] as they become.
    pub fn lengths(&self, lengths: &[f64]) -> Vec<f64> {
        let lengthening = CableInWeather::new(self.numbers(), 0.0, 0.0).lengthening;
        lengths.iter().map(|length| length * lengthening).collect()
    }
}

/// What weather makes of a cable and of the frame, over any kind of number.
pub(crate) struct CableInWeather<T> {
    /// L'/L.
    pub(crate) lengthening: T,
    /// b'/b.
    pub(crate) frame: T,
    /// ρ' [kg/m].
    pub(crate) linear_density: T,
    /// d' [m].
    pub(crate) diameter: T,
}

impl<T: Real> CableInWeather<T> {
    /// A cable of this linear density [kg/m] and diameter [m].
    fn new([warmer, of_cable, of_frame, ice, creep]: [T; 5], density: f64, diameter: f64) -> Self {
        let lengthening = (of_cable * warmer + 1.0) * (creep + 1.0);
        Self {
            lengthening,
            frame: of_frame * warmer + 1.0,
            linear_density: lengthening.recip() * density + ice * (ice + diameter) * (ICE_DENSITY * PI),
            diameter: ice * 2.0 + diameter,
        }
    }
}

/// How a platform rests under a load without and with the weather, on winches that hold.
///
/// The weather comes to the platform as it rests with the load.
///
/// # Errors
/// As [`deflection`], [`Weather::check`] and [`rest_in_weather`].
pub fn in_weather(
    robot: &Robot,
    wanted: WantedPose,
    load: &Load,
    weather: &Weather,
) -> Result<(Deflection, RestInWeather), StaticsError> {
    weather.check()?;
    weather.robot(robot)?;
    let still = deflection(robot, wanted, load)?;
    let rest = rest_in_weather(robot, &still.lengths, load, &still.loaded.equilibrium.pose, weather)?;
    Ok((still, rest))
}

/// How a platform rests in weather under a load that rests at `still` without it, with these unstrained
/// lengths [m] before the weather comes.
///
/// # Errors
/// As [`Weather::robot`], [`DirectProblem::direct`] and [`DirectProblem::in_wind`].
pub fn rest_in_weather(
    robot: &Robot,
    lengths: &[f64],
    load: &Load,
    still: &Pose,
    weather: &Weather,
) -> Result<RestInWeather, StaticsError> {
    let changed = weather.robot(robot)?;
    let lengths = weather.lengths(lengths);
    let problem = DirectProblem::new(&changed, &lengths, load)?;
    let calm = problem.direct(DirectStart::Pose(still))?;
    problem.in_wind(&weather.wind, &calm)
}
