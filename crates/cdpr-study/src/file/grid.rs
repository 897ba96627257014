//! A grid of positions as it stands in a study file.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// Coordinates along one axis, equally spaced from `min` to `max`.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct GridAxis {
    /// First coordinate [m].
    pub min: f64,
    /// Last coordinate [m].
    pub max: f64,
    /// Number of coordinates; 1 where `min` is `max`.
    pub points: usize,
}

impl GridAxis {
    pub(crate) fn is_sound(&self) -> bool {
        let Self { min, max, points } = *self;
        let many = points > 1 && min < max;
        min.is_finite() && max.is_finite() && (many || (points == 1 && min == max))
    }

    /// The coordinates [m].
    pub fn coordinates(&self) -> Vec<f64> {
        (0..self.points).map(|k| self.coordinate(k)).collect()
    }

    pub(crate) fn coordinate(&self, k: usize) -> f64 {
        let last = (self.points.max(2) - 1) as f64;
        // Weighted ends: the last coordinate is `max` itself.
        self.min * ((last - k as f64) / last) + self.max * (k as f64 / last)
    }
}

/// Positions on a grid of the base frame: a plane where one axis has one point.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[allow(missing_docs)]
pub struct GridSpec {
    pub x: GridAxis,
    pub y: GridAxis,
    pub z: GridAxis,
}
