//! What tensions cables may have, and which of them are preferred, as files have it.

use crate::error::RobotError;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use std::str::FromStr;

/// Limits of a cable's tension.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TensionLimits {
    /// Least tension at the anchor point [N], positive.
    pub min: f64,
    /// Greatest tension [N], at the anchor point unless the limit is the winch's, see [`CableEnd`].
    pub max: f64,
}

/// An end of a cable, such as that at which its greatest tension is limited.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum CableEnd {
    /// The anchor point, on the platform.
    #[default]
    Anchor,
    /// The exit point, on the way to the winch.
    Exit,
}

impl CableEnd {
    /// Whether this is the anchor point.
    pub fn is_anchor(&self) -> bool {
        *self == Self::Anchor
    }
}

/// Limits of one cable instead of the robot's, each on its own.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct OwnLimits {
    /// Least tension at the anchor point [N].
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub min: Option<f64>,
    /// Greatest tension [N].
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub max: Option<f64>,
    /// Where the greatest tension is limited: "anchor" or "exit".
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub max_at: Option<CableEnd>,
}

impl OwnLimits {
    /// Whether all limits are the robot's.
    pub(crate) fn is_empty(&self) -> bool {
        *self == Self::default()
    }
}

/// Which of the tensions that hold a pose the inverse model chooses.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum TensionDistribution {
    /// The nearest to the reference tensions, by the sum of squares; without a reference those of least
    /// 2-norm.
    #[default]
    Nearest,
    /// The least sum of tensions.
    #[serde(rename = "least_1_norm")]
    LeastOneNorm,
    /// The least sum of squares of the tensions.
    #[serde(rename = "least_2_norm")]
    LeastTwoNorm,
    /// The least greatest tension.
    LeastInfinityNorm,
}

impl TensionDistribution {
    /// Their names, as files and arguments have them.
    pub const NAMES: [(Self, &str); 4] = [
        (Self::Nearest, "nearest"),
        (Self::LeastOneNorm, "least_1_norm"),
        (Self::LeastTwoNorm, "least_2_norm"),
        (Self::LeastInfinityNorm, "least_infinity_norm"),
    ];

    /// Its name.
    pub fn name(self) -> &'static str {
        Self::NAMES.iter().find(|(distribution, _)| *distribution == self).map_or("", |(_, name)| name)
    }

    /// Whether it is the nearest to the reference.
    pub fn is_nearest(&self) -> bool {
        *self == Self::Nearest
    }

    /// Whether tensions change smoothly with the pose where no limit becomes active: the other norms jump
    /// from corner to corner of what the limits leave.
    pub fn is_smooth(self) -> bool {
        matches!(self, Self::Nearest | Self::LeastTwoNorm)
    }
}

/// As arguments have it.
impl FromStr for TensionDistribution {
    type Err = RobotError;

    fn from_str(text: &str) -> Result<Self, RobotError> {
        let found = Self::NAMES.iter().find(|(_, name)| *name == text.trim());
        found.map(|(distribution, _)| *distribution).ok_or_else(|| {
            let expected = "nearest, least_1_norm, least_2_norm or least_infinity_norm";
            RobotError::invalid("distribution", format!("{text:?}"), expected)
        })
    }
}

/// The tensions that the inverse model comes as near to as it can [N].
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(untagged, expecting = "expected a tension [N], a list with one for each cable, or \"mid\"")]
pub enum TensionReference {
    /// The same for all cables.
    All(f64),
    /// One for each cable.
    Each(Vec<f64>),
    /// By a name.
    Named(NamedReference),
}

/// Tensions that follow from the robot.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum NamedReference {
    /// The middle of each cable's limits.
    Mid,
}

impl TensionReference {
    /// The middle of each cable's limits.
    pub const MID: Self = Self::Named(NamedReference::Mid);

    /// Checks that there is one tension, or one for each of the cables, finite and not negative.
    pub(crate) fn validate(&self, cables: usize) -> Result<(), RobotError> {
        const FIELD: &str = "tension_reference";
        let sound = |t: &f64| t.is_finite() && *t >= 0.0;
        let expected = "a finite tension, zero or more [N]";
        match self {
            Self::All(t) if !sound(t) => Err(RobotError::invalid(FIELD, t, expected)),
            Self::Each(each) if each.len() != cables => Err(RobotError::invalid(
                FIELD,
                format!("a list of {}", each.len()),
                format!("one tension, or one for each of the {cables} cables"),
            )),
            Self::Each(each) => match each.iter().position(|t| !sound(t)) {
                Some(i) => Err(RobotError::invalid(format!("{FIELD}[{i}]"), each[i], expected)),
                None => Ok(()),
            },
            Self::All(_) | Self::Named(NamedReference::Mid) => Ok(()),
        }
    }
}

/// As arguments have it: `2000`, `2000,1500,...` or `mid`.
impl FromStr for TensionReference {
    type Err = RobotError;

    fn from_str(text: &str) -> Result<Self, RobotError> {
        if text.trim() == "mid" {
            return Ok(Self::MID);
        }
        let numbers: Result<Vec<f64>, _> = text.split(',').map(|number| number.trim().parse()).collect();
        let expected = "a tension [N], one for each cable with commas between, or mid";
        match numbers.as_deref() {
            Ok(&[tension]) => Ok(Self::All(tension)),
            Ok(tensions) => Ok(Self::Each(tensions.to_vec())),
            Err(_) => Err(RobotError::invalid("tension_reference", format!("{text:?}"), expected)),
        }
    }
}
