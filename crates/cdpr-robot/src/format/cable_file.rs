//! The cable file, `cdpr-cable/1`: one cable with its source, as the catalogue has it.

use crate::error::RobotError;
use crate::format::{PropertiesEntry, properties};
use crate::json::from_json;
use crate::robot::CableProperties;
use schemars::JsonSchema;
use serde::Deserialize;

/// Name and version of the format.
pub const CABLE_FORMAT: &str = "cdpr-cable/1";

/// A cable with its source.
#[derive(Clone, Debug, PartialEq)]
pub struct CatalogueCable {
    /// Name.
    pub name: String,
    /// Where the values come from, and what about them is assumed.
    pub source: Option<String>,
    /// Its properties.
    pub properties: CableProperties,
}

/// A cable for robots that are made without one. SI units.
#[derive(Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(title = "cdpr-cable/1")]
struct CableFile {
    /// Always "cdpr-cable/1".
    format: String,
    /// Name of the cable.
    name: String,
    /// Where the values come from, and what about them is assumed.
    #[serde(default)]
    source: Option<String>,
    /// Its properties, as the entry `cable` of a robot file has them.
    cable: PropertiesEntry,
}

/// The JSON Schema of the cable file, as pretty-printed text.
pub fn cable_schema() -> String {
    format!("{:#}\n", schemars::schema_for!(CableFile).as_value())
}

impl CatalogueCable {
    /// Reads and validates a cable file.
    ///
    /// # Errors
    /// As [`crate::Robot::from_json`].
    pub fn from_json(text: &str) -> Result<Self, RobotError> {
        let file: CableFile = from_json(text)?;
        file.checked().map_err(|error| error.placed(text))
    }
}

impl CableFile {
    fn checked(self) -> Result<CatalogueCable, RobotError> {
        if self.format != CABLE_FORMAT {
            let expected = format!("{CABLE_FORMAT:?}");
            return Err(RobotError::invalid("format", format!("{:?}", self.format), expected));
        }
        let properties = properties(&self.cable, "cable")?;
        properties.validate(|name| format!("cable.{name}"))?;
        Ok(CatalogueCable { name: self.name, source: self.source, properties })
    }
}
