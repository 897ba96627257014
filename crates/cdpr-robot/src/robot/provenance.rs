//! Where the values of a robot come from, and how far they can be trusted.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use std::fmt;

/// Where the values of a robot come from. No model depends on it.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Provenance {
    /// The source, if known.
    pub source: Option<String>,
    /// How far the values can be trusted, if known.
    pub grade: Option<Grade>,
    /// Values that the source does not give and that were chosen, a sentence each.
    pub assumed: Vec<String>,
}

/// How far the values of a robot can be trusted.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "lowercase")]
pub enum Grade {
    /// Measured on the robot itself and published with mass and centre of mass.
    Surveyed,
    /// From a paper or a file of its makers.
    Paper,
    /// Design values or placeholders.
    Nominal,
}

impl fmt::Display for Grade {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Surveyed => "surveyed",
            Self::Paper => "paper",
            Self::Nominal => "nominal",
        })
    }
}
