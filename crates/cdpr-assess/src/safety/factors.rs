//! Partial factors of a proof by limit states: design loads, and the design resistance of a cable.
//!
//! ```text
//! m' = γ_G m,  ρ' = γ_G ρ + γ_Q ρ_ice       weight of the platform, of the cables and of ice on them
//! p' = γ_Q p,  w' = γ_Q w                   payload; force and moment
//! v' = √γ_Q v,  ΔT' = γ_Q ΔT                wind, whose pressure is γ_Q times as great; temperature
//! η = T' γ_R / F_min                        utilization of a cable with the tension T' under these loads
//! ```
//!
//! The unstrained lengths, and with them the prestress, are those that hold the pose under the loads without
//! factors. A creep that is given is not multiplied.

use crate::safety::winds::AnyWeather;
use cdpr_robot::{Platform, Robot, Wrench};
use cdpr_statics::weather::Weather;
use cdpr_statics::{Load, StaticsError};
use serde::Serialize;
use std::fmt;

/// The factors of a situation.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct CaseFactors {
    /// γ_G of the weight of the platform and of the cables.
    pub permanent: f64,
    /// γ_Q of the payload, of force and moment, and of the weather: the pressure of the wind, the weight of
    /// ice, the difference of temperature.
    pub variable: f64,
    /// γ_R, by which the breaking force of a cable is divided.
    pub resistance: f64,
}

/// The factors of a proof.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct PartialFactors {
    /// Those of the whole robot, in weather, too.
    pub persistent: CaseFactors,
    /// Those of the accidental situation in which a cable is broken.
    pub accidental: CaseFactors,
}

impl CaseFactors {
    /// Loads and resistance as they are.
    pub const ONE: Self = Self { permanent: 1.0, variable: 1.0, resistance: 1.0 };

    /// Whether the loads are as they are.
    pub(super) fn has_given_loads(&self) -> bool {
        [self.permanent, self.variable] == [1.0; 2]
    }

    /// The greater factor of a load, by which an effect is multiplied that is known without factors only.
    pub(super) fn of_effects(&self) -> f64 {
        self.permanent.max(self.variable)
    }

    fn check(&self, of: &str) -> Result<(), StaticsError> {
        let fields = [
            ("permanent", self.permanent, 0.1..=10.0, "a factor from 0.1 to 10"),
            ("variable", self.variable, 0.0..=10.0, "a factor from 0 to 10"),
            ("resistance", self.resistance, 0.1..=100.0, "a divisor of the breaking force, 0.1 to 100"),
        ];
        for (name, value, range, expected) in fields {
            if !range.contains(&value) {
                let (field, value) = (format!("factors.{of}.{name}"), value.to_string());
                return Err(StaticsError::Invalid { field, value, expected: expected.to_owned() });
            }
        }
        Ok(())
    }

    /// The robot with its design weights.
    pub(super) fn robot(&self, robot: &Robot) -> Robot {
        let mut changed = robot.clone();
        changed.platform = Platform { mass: self.permanent * robot.platform.mass, ..robot.platform };
        for cable in &mut changed.cables {
            cable.properties.linear_density *= self.permanent;
        }
        changed
    }

    /// The design load.
    pub(super) fn load(&self, load: &Load) -> Load {
        let Load { payload, wrench: Wrench { force, moment } } = *load;
        let wrench = Wrench { force: self.variable * force, moment: self.variable * moment };
        Load { payload: self.variable * payload, wrench }
    }

    /// The weather of the design: the speed of its wind, its temperature. The weight of ice is that of
    /// [`CaseFactors::robot_in`].
    pub(super) fn weather(&self, question: &AnyWeather) -> Result<AnyWeather, StaticsError> {
        let AnyWeather { weather, speed } = *question;
        let share = self.variable.sqrt();
        let named = |error: StaticsError| match error {
            StaticsError::Invalid { field, value, expected } => {
                let value = format!("{value}, with the factor {} of variable loads", self.variable);
                StaticsError::Invalid { field, value, expected }
            }
            error => error,
        };
        let wind = weather.wind.with_velocity(share * weather.wind.velocity()).map_err(named)?;
        let speed = speed.map(|speed| share * speed);
        if let Some(speed) = speed {
            wind.with_velocity([speed, 0.0, 0.0].into()).map_err(named)?;
        }
        let warmer = self.variable * weather.warmer;
        Ok(AnyWeather { weather: Weather { wind, warmer, ..weather }, speed })
    }

    /// The robot with its design weights in the weather of the design.
    pub(super) fn robot_in(&self, weather: &Weather, robot: &Robot) -> Result<Robot, StaticsError> {
        let mut changed = weather.robot(robot)?;
        let bare = Weather { ice: 0.0, ..*weather }.robot(robot)?;
        changed.platform.mass *= self.permanent;
        for (cable, bare) in changed.cables.iter_mut().zip(&bare.cables) {
            let ice = cable.properties.linear_density - bare.properties.linear_density;
            cable.properties.linear_density *= self.permanent;
            cable.properties.linear_density += (self.variable - self.permanent) * ice;
        }
        Ok(changed)
    }
}

impl fmt::Display for CaseFactors {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { permanent, variable, resistance } = self;
        write!(
            f,
            "weights times {permanent}, other loads times {variable}, breaking forces over {resistance}"
        )
    }
}

impl PartialFactors {
    /// Loads and resistances as they are.
    pub const ONE: Self = Self { persistent: CaseFactors::ONE, accidental: CaseFactors::ONE };

    /// In words, as in `weights times 1.35, other loads times 1.5, breaking forces over 2; without a cable times
    /// 1, times 1, over 2`.
    pub fn conditions(&self) -> String {
        let Self { persistent, accidental } = self;
        let CaseFactors { permanent, variable, resistance } = accidental;
        format!("{persistent}; without a cable times {permanent}, times {variable}, over {resistance}")
    }

    /// Checks that each of them is plausible.
    ///
    /// # Errors
    /// [`StaticsError::Invalid`].
    pub fn check(&self) -> Result<(), StaticsError> {
        self.persistent.check("persistent")?;
        self.accidental.check("accidental")
    }
}
