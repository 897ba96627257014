//! A piece of an elastic law, as files have it.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// A piece of constant modulus.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct LawSegment {
    /// Tension at which the piece begins [N]; zero for the first.
    pub tension: f64,
    /// Young's modulus from there on [Pa].
    pub modulus: f64,
}

impl LawSegment {
    /// Tensions [N] and moduli over `youngs_modulus` [Pa], as [`crate::PiecewiseLaw::new`] takes them.
    pub fn in_proportion(segments: &[Self], youngs_modulus: f64) -> Vec<(f64, f64)> {
        segments.iter().map(|segment| (segment.tension, segment.modulus / youngs_modulus)).collect()
    }
}
