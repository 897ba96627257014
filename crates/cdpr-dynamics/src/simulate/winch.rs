//! How a winch takes cable in.

use std::f64::consts::PI;

/// How a length changes over the duration of a change.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, serde::Deserialize, schemars::JsonSchema)]
#[serde(rename_all = "lowercase")]
pub enum Profile {
    /// At constant speed, with jumps of the speed at both ends.
    Linear,
    /// `(1 - cos(π t/T))/2`, with jumps of the acceleration at both ends.
    #[default]
    Cosine,
    /// `10 x³ - 15 x⁴ + 6 x⁵` of `x = t/T`, without jumps of speed and acceleration.
    Polynomial,
}

/// A cable that is taken in.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Ramp {
    /// Begin and duration [s].
    pub(super) from: f64,
    pub(super) over: f64,
    /// Unstrained length [m].
    pub(super) by: f64,
    pub(super) profile: Profile,
}

impl Ramp {
    /// The length that is in at a time [m] and its rate [m/s].
    pub(super) fn at(&self, time: f64) -> [f64; 2] {
        let x = (time - self.from) / self.over;
        if x >= 1.0 {
            return [self.by, 0.0];
        }
        if x < 0.0 {
            return [0.0; 2];
        }
        let [share, slope] = match self.profile {
            Profile::Linear => [x, 1.0],
            Profile::Cosine => [0.5 * (1.0 - (PI * x).cos()), 0.5 * PI * (PI * x).sin()],
            Profile::Polynomial => {
                [x * x * x * (10.0 + x * (6.0 * x - 15.0)), 30.0 * x * x * (1.0 + x * (x - 2.0))]
            }
        };
        [self.by * share, self.by * slope / self.over]
    }
}
