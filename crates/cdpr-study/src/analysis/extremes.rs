//! Extremes over the positions of a workspace.

use serde::{Deserialize, Serialize};

/// Extremes over the positions with feasible tensions, and the positions of the extremes [m].
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Extremes {
    /// Least value.
    pub min: f64,
    /// Its position.
    pub min_at: [f64; 3],
    /// Greatest value.
    pub max: f64,
    /// Its position.
    pub max_at: [f64; 3],
}

impl Extremes {
    /// The extremes of values with their positions; `None` without values.
    pub fn of(values: impl Iterator<Item = (f64, [f64; 3])>) -> Option<Self> {
        values.fold(None, |found, (value, at)| {
            let mut all = found.unwrap_or(Self { min: value, min_at: at, max: value, max_at: at });
            if value < all.min {
                (all.min, all.min_at) = (value, at);
            }
            if value >= all.max {
                (all.max, all.max_at) = (value, at);
            }
            Some(all)
        })
    }
}
