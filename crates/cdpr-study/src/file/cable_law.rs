//! The elastic law of a cable as a file, `cdpr-law/1` (JSON, SI units): moduli over the tension, for loading
//! and unloading.

use cdpr_robot::LawSegment;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// Name and version of the format.
pub const LAW_FORMAT: &str = "cdpr-law/1";

/// A law with its source.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(title = "cdpr-law/1")]
pub struct LawFile {
    /// Always "cdpr-law/1".
    pub format: String,
    /// Where its values come from.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub source: Option<String>,
    /// The law.
    pub law: CableLaw,
}

/// Tangent moduli of a cable over its tension.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct CableLaw {
    /// Section of the cable that has these tensions [m²]. A cable of another section has the same moduli at
    /// the same stress.
    pub section: f64,
    /// Pieces of constant modulus while the tension grows, from zero tension up.
    pub loading: Vec<LawSegment>,
    /// Moduli while the tension falls. A cable without this field dissipates no energy.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub unloading: Option<UnloadingCurve>,
}

/// Moduli during unloading.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct UnloadingCurve {
    /// Tension at which the measured unloading began [N].
    pub turning_tension: f64,
    /// Pieces of constant modulus while the tension falls, from zero tension up.
    pub segments: Vec<LawSegment>,
}

/// The law as the text of a file.
///
/// # Errors
/// [`serde_json::Error`] for a value that JSON does not have.
pub fn law_json(source: Option<String>, law: CableLaw) -> Result<String, serde_json::Error> {
    serde_json::to_string_pretty(&LawFile { format: LAW_FORMAT.to_owned(), source, law })
}

/// The JSON Schema of the law file, as pretty-printed text.
pub fn law_schema() -> String {
    format!("{:#}\n", schemars::schema_for!(LawFile).as_value())
}
