//! What a design makes as good as possible, or limits: its names, its unit and its sense.

use cdpr_study::Output;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use std::fmt;

/// A number of a robot that a design makes small or great.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum Goal {
    /// Length of the displacement of P under the load [mm].
    Deflection,
    /// Distance of P from its pose within which 95 % of the robots of `errors` are, without the load [mm].
    Position,
    /// Lowest stiffness with the load [N/m].
    Stiffness,
    /// Lowest natural frequency with the load [Hz].
    Frequency,
    /// Natural frequency with which the platform swings with the load [Hz].
    PlatformFrequency,
    /// Greatest tension of a cable at its exit point under the load [N]: what its winch pulls.
    Tension,
    /// Unstrained length of all cables [m], lead included, of each at the pose where it is longest.
    Length,
    /// Cost of all cables: that of a metre of their types times these lengths.
    Cost,
    /// An output of studies only.
    #[schemars(skip)]
    Amplitude,
}

impl Goal {
    /// What an objective may be, in words.
    pub(crate) const NAMES: &str =
        "deflection, position, stiffness, frequency, platform_frequency, tension, length or cost";

    /// The output of studies that it is, where there is one.
    pub const fn output(self) -> Option<Output> {
        Some(match self {
            Self::Deflection => Output::Deflection,
            Self::Position => Output::Position,
            Self::Stiffness => Output::Stiffness,
            Self::Frequency => Output::Frequency,
            Self::PlatformFrequency => Output::PlatformFrequency,
            Self::Amplitude => Output::Amplitude,
            Self::Tension | Self::Length | Self::Cost => return None,
        })
    }

    /// Name of the number in tables, with its unit.
    pub const fn name(self) -> &'static str {
        match self.output() {
            Some(output) => output.name(),
            None if matches!(self, Self::Tension) => "exit_tension_n",
            None if matches!(self, Self::Length) => "cable_length_m",
            None => "cable_cost",
        }
    }

    /// Its unit; empty for a cost, which may be in any currency.
    pub const fn unit(self) -> &'static str {
        match self.output() {
            Some(output) => output.unit(),
            None if matches!(self, Self::Tension) => "N",
            None if matches!(self, Self::Length) => "m",
            None => "",
        }
    }

    /// What it is in a few words.
    pub const fn noun(self) -> &'static str {
        match self.output() {
            Some(output) => output.noun(),
            None if matches!(self, Self::Tension) => "exit tension",
            None if matches!(self, Self::Length) => "length of all cables",
            None => "cost of all cables",
        }
    }

    /// A value with its unit.
    pub fn amount(self, value: &str) -> String {
        if self.unit().is_empty() { value.to_owned() } else { format!("{value} {}", self.unit()) }
    }

    /// Whether it is one number for all poses together.
    pub const fn is_of_all_poses(self) -> bool {
        matches!(self, Self::Length | Self::Cost)
    }
}

impl fmt::Display for Goal {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Tension => f.pad("tension"),
            Self::Length => f.pad("length"),
            Self::Cost => f.pad("cost"),
            _ => self.output().map_or(Ok(()), |output| output.fmt(f)),
        }
    }
}

/// 1 for a number that is to be small, -1 for one that is to be great.
pub(crate) fn sense(goal: Goal) -> f64 {
    match goal {
        Goal::Stiffness | Goal::Frequency | Goal::PlatformFrequency => -1.0,
        _ => 1.0,
    }
}
