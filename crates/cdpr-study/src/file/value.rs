//! A published or computed figure: a number or a word.

use cdpr_robot::rounded;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use std::fmt;

/// A published or computed figure.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(untagged, expecting = "expected a number or a word")]
pub enum Value {
    /// A number.
    Number(f64),
    /// A word.
    Text(String),
}

impl fmt::Display for Value {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            // Four decimals, without zeros that say nothing.
            Self::Number(number) => write!(f, "{}", rounded(*number, 4)),
            Self::Text(text) => f.write_str(text),
        }
    }
}
