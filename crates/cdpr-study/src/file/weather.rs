//! The weather of a study: what it is, and which of its numbers may be uncertain.
//!
//! A wind of the speed v that comes from the azimuth ψ, from x to y of the level frame, and rises by the
//! angle η has there the velocity
//!
//! ```text
//! v (-cos η cos ψ, -cos η sin ψ, sin η)                                                (Wx1)
//! ```
//!
//! Sine and cosine are periodic: ψ may have a law over a whole turn or more.

use cdpr_robot::{Matrix3, Robot, Vector3};
use cdpr_statics::StaticsError;
use cdpr_statics::weather::{Weather, WeatherInput, Wind, WindProfile};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// The weather in which all robots are observed, on winches that hold the lengths for the pose. It comes
/// after the load. SI units unless a name says otherwise.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct WeatherSpec {
    /// Velocity of the wind on the cables in the base frame [m/s]. Wind on the platform itself is a `force`.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub wind: Option<[f64; 3]>,
    /// Speed of a horizontal wind [m/s], instead of `wind`; zero if left out.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub wind_speed: Option<f64>,
    /// Azimuth from which it blows [degrees], from the x to the y axis of the base frame: a wind from 0 blows
    /// along -x.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub wind_from_deg: Option<f64>,
    /// A wind that grows with height; without it the wind is the same everywhere.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub wind_profile: Option<WindProfileSpec>,
    /// How much warmer it is [K].
    #[serde(default, skip_serializing_if = "crate::file::is_default")]
    pub warmer: f64,
    /// Thermal expansion of the cables [1/K]: about 1.2e-5 of steel; fibres shrink.
    #[serde(default, skip_serializing_if = "crate::file::is_default")]
    pub cable_expansion: f64,
    /// Thermal expansion of the frame, from the origin of the base frame [1/K].
    #[serde(default, skip_serializing_if = "crate::file::is_default")]
    pub frame_expansion: f64,
    /// Thickness of the ice around each cable [m], of 900 kg/m³.
    #[serde(default, skip_serializing_if = "crate::file::is_default")]
    pub ice: f64,
    /// Strain by which each cable has crept.
    #[serde(default, skip_serializing_if = "crate::file::is_default")]
    pub creep: f64,
}

/// How a wind grows with height.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct WindProfileSpec {
    /// Roughness length of the ground [m]: 0.003 of a sea to 1 of a town.
    pub roughness: f64,
    /// Height above the ground at which the wind has its speed [m].
    pub reference: f64,
}

/// A number of the weather that may be uncertain.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum WeatherQuantity {
    /// Speed of the wind [m/s].
    WindSpeed,
    /// Azimuth from which it blows [degrees].
    WindFrom,
    /// How much warmer it is [K].
    Warmer,
    /// Thermal expansion of the cables [1/K].
    CableExpansion,
    /// Thermal expansion of the frame [1/K].
    FrameExpansion,
    /// Thickness of the ice [m].
    Ice,
    /// Strain by which the cables have crept.
    Creep,
}

impl WeatherQuantity {
    /// All of them, in the order of their inputs.
    pub const ALL: [Self; 7] = [
        Self::WindSpeed,
        Self::WindFrom,
        Self::Warmer,
        Self::CableExpansion,
        Self::FrameExpansion,
        Self::Ice,
        Self::Creep,
    ];

    /// Name of the group of all of them.
    pub const GROUP: &str = "weather";

    /// Its name: that of its field in [`WeatherSpec`].
    pub const fn name(self) -> &'static str {
        match self {
            Self::WindSpeed => "wind_speed",
            Self::WindFrom => "wind_from_deg",
            Self::Warmer => "warmer",
            Self::CableExpansion => "cable_expansion",
            Self::FrameExpansion => "frame_expansion",
            Self::Ice => "ice",
            Self::Creep => "creep",
        }
    }

    /// The quantity of this name.
    pub fn named(name: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|quantity| quantity.name() == name)
    }

    /// Its unit: SI, but for the azimuth.
    pub const fn unit(self) -> &'static str {
        match self {
            Self::WindSpeed => "m/s",
            Self::WindFrom => "degrees",
            Self::Warmer => "K",
            Self::CableExpansion | Self::FrameExpansion => "1/K",
            Self::Ice => "m",
            Self::Creep => "",
        }
    }

    /// The number of the models by which derivatives are taken, and how much it changes by a unit of this
    /// one.
    pub(crate) const fn of_models(self) -> (WeatherInput, f64) {
        match self {
            Self::WindSpeed => (WeatherInput::Wind, 1.0),
            Self::WindFrom => (WeatherInput::Direction, 1f64.to_radians()),
            Self::Warmer => (WeatherInput::Warmer, 1.0),
            Self::CableExpansion => (WeatherInput::CableExpansion, 1.0),
            Self::FrameExpansion => (WeatherInput::FrameExpansion, 1.0),
            Self::Ice => (WeatherInput::Ice, 1.0),
            Self::Creep => (WeatherInput::Creep, 1.0),
        }
    }

    /// Whether it cannot be below zero.
    pub(crate) const fn is_size(self) -> bool {
        matches!(self, Self::WindSpeed | Self::Ice | Self::Creep)
    }

    /// Whether it acts on the diameter of the cables.
    pub(crate) const fn needs_diameter(self) -> bool {
        matches!(self, Self::WindSpeed | Self::Ice)
    }
}

/// A value for each of [`WeatherQuantity::ALL`], in their units.
pub(crate) type WeatherNumbers = [f64; WeatherQuantity::ALL.len()];

/// The weather of a study before any of its numbers deviate.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct NominalWeather {
    pub(crate) numbers: WeatherNumbers,
    /// Sine of the angle by which the wind rises, η of (Wx1).
    rise: f64,
    profile: Option<WindProfile>,
    /// Rotation from the level frame of the robot to its base frame.
    to_base: Matrix3<f64>,
}

impl NominalWeather {
    /// The weather of a study for its robot.
    ///
    /// # Errors
    /// [`StaticsError::Invalid`] for the first wrong field.
    pub(crate) fn new(spec: &WeatherSpec, robot: &Robot) -> Result<Self, StaticsError> {
        let to_base = robot.gravity.level().map_or_else(Matrix3::identity, Matrix3::transpose);
        if let (Some(wind), true) = (spec.wind, spec.wind_speed.is_some() || spec.wind_from_deg.is_some()) {
            return Err(invalid("wind", format!("{wind:?}"), "either `wind`, or its speed and direction"));
        }
        let given = Vector3::from(spec.wind.unwrap_or_default());
        let speed = spec.wind_speed.unwrap_or_else(|| given.norm());
        let level = to_base.transpose() * given;
        let azimuth = (-level.y).atan2(-level.x).to_degrees();
        let from = spec.wind_from_deg.unwrap_or(if given == Vector3::zeros() { 0.0 } else { azimuth });
        let WeatherSpec { warmer, cable_expansion, frame_expansion, ice, creep, .. } = *spec;
        let rise = if given == Vector3::zeros() { 0.0 } else { level.z / given.norm() };
        let profile = spec
            .wind_profile
            .map(|WindProfileSpec { roughness, reference }| WindProfile { roughness, reference });
        let numbers = [speed, from, warmer, cable_expansion, frame_expansion, ice, creep];
        let found = Self { numbers, rise, profile, to_base };
        found.deviating(&[0.0; 7])?.robot(robot)?;
        Ok(found)
    }

    /// The weather with deviations of its numbers.
    ///
    /// # Errors
    /// [`StaticsError::Invalid`] for a negative speed and what [`Wind::new`] refuses.
    pub(crate) fn deviating(&self, deviations: &WeatherNumbers) -> Result<Weather, StaticsError> {
        let mut numbers = self.numbers;
        numbers.iter_mut().zip(deviations).for_each(|(number, by)| *number += by);
        let [speed, from, warmer, cable_expansion, frame_expansion, ice, creep] = numbers;
        if let Some((name, value)) = [("wind_speed", speed), ("wind_from_deg", from)]
            .into_iter()
            .find(|(name, value)| !value.is_finite() || (*name == "wind_speed" && *value < 0.0))
        {
            let expected = "a finite speed, zero or more [m/s], from a finite azimuth [degrees]";
            return Err(invalid(name, value, expected));
        }
        // Eq. (Wx1)
        let (sin, cos) = from.to_radians().sin_cos();
        let level = (1.0 - self.rise * self.rise).max(0.0).sqrt();
        let towards = Vector3::new(-level * cos, -level * sin, self.rise);
        let wind = Wind::new(speed * (self.to_base * towards))?;
        let wind = self.profile.map_or(Ok(wind), |profile| wind.over_height(profile))?;
        Ok(Weather { wind, warmer, cable_expansion, frame_expansion, ice, creep })
    }

    /// Whether it changes nothing.
    pub(crate) fn is_nothing(&self) -> bool {
        self.deviating(&[0.0; 7]).is_ok_and(|weather| weather.is_nothing())
    }

    /// Whether cables or frame expand.
    pub(crate) fn expands(&self) -> bool {
        self.numbers[3] != 0.0 || self.numbers[4] != 0.0
    }
}

fn invalid(field: &str, value: impl ToString, expected: &str) -> StaticsError {
    StaticsError::Invalid { field: field.to_owned(), value: value.to_string(), expected: expected.to_owned() }
}
