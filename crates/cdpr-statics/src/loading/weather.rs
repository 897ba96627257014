//! A platform in weather: on winches that hold, with cables and frame that expand, cables that creep or carry
//! ice, and wind on the cables.
//!
//! ```text
//! L' = L (1 + α ΔT)(1 + ε)      unstrained length, warmer by ΔT and with the creep strain ε
//! b' = b (1 + α_f ΔT)           exit points, and leads, of a frame that expands from the origin of the base frame
//! ρ' = ρ L/L' + ρ_ice π t (d + t),  d' = d + 2t      with ice of thickness t around a diameter d
//! ```

use crate::direct::DirectStart;
use crate::error::StaticsError;
use crate::loading::deflection::{Deflection, deflection};
use crate::loading::wind::{RestInWeather, Wind};
use crate::problem::DirectProblem;
use crate::state::{Load, WantedPose};
use cdpr_robot::Robot;
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
    fn check(&self) -> Result<(), StaticsError> {
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
        let expands = self.cable_expansion != 0.0 || self.frame_expansion != 0.0;
        if expands != (self.warmer != 0.0) {
            let expected = "a difference of temperature together with the expansion of cables, frame or both";
            return Err(StaticsError::invalid("warmer".to_owned(), self.warmer, expected));
        }
        Ok(())
    }

    /// Factor of the unstrained lengths.
    fn lengthening(&self) -> f64 {
        (1.0 + self.cable_expansion * self.warmer) * (1.0 + self.creep)
    }

    /// The robot with its frame and cables as they become.
    ///
    /// # Errors
    /// [`StaticsError::Invalid`] for a value out of its bounds, and for ice on a cable without diameter.
    pub fn robot(&self, robot: &Robot) -> Result<Robot, StaticsError> {
        self.check()?;
        let mut changed = robot.clone();
        let frame = 1.0 + self.frame_expansion * self.warmer;
        for (i, cable) in changed.cables.iter_mut().enumerate() {
            cable.exit_point *= frame;
            cable.lead *= frame;
            let properties = &mut cable.properties;
            properties.linear_density /= self.lengthening();
            if self.ice == 0.0 {
                continue;
            }
            let Some(diameter) = properties.diameter.as_mut() else {
                let expected = "a diameter [m], on which the weight of the ice depends";
                return Err(StaticsError::invalid(format!("cables[{i}].diameter"), "not given", expected));
            };
            properties.linear_density += ICE_DENSITY * PI * self.ice * (*diameter + self.ice);
            *diameter += 2.0 * self.ice;
        }
        Ok(changed)
    }

    /// Unstrained lengths [m] as they become.
    pub fn lengths(&self, lengths: &[f64]) -> Vec<f64> {
        lengths.iter().map(|length| length * self.lengthening()).collect()
    }
}

/// How a platform rests under a load without and with the weather, on winches that hold.
///
/// The weather comes to the platform as it rests with the load.
///
/// # Errors
/// As [`deflection`], [`Weather::robot`], [`DirectProblem::direct`] and [`DirectProblem::in_wind`].
pub fn in_weather(
    robot: &Robot,
    wanted: WantedPose,
    load: &Load,
    weather: &Weather,
) -> Result<(Deflection, RestInWeather), StaticsError> {
    let changed = weather.robot(robot)?;
    let still = deflection(robot, wanted, load)?;
    let lengths = weather.lengths(&still.lengths);
    let problem = DirectProblem::new(&changed, &lengths, load)?;
    let rest = problem.direct(DirectStart::Pose(&still.loaded.equilibrium.pose))?;
    let rest = problem.in_wind(&weather.wind, &rest)?;
    Ok((still, rest))
}
