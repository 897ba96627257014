//! A segment of an elastic law as files have it.

use cdpr_cable::Segment;
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
    /// The segments of a [`crate::PiecewiseLaw`] for a cable of this modulus [Pa].
    pub fn in_proportion(segments: &[Self], youngs_modulus: f64) -> Vec<Segment> {
        let relative =
            |&Self { tension, modulus }: &Self| Segment { tension, ratio: modulus / youngs_modulus };
        segments.iter().map(relative).collect()
    }
}
