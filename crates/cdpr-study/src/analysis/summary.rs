//! All results of a study.

use crate::analysis::keys::in_file;
use crate::analysis::part::StudySummary;
use crate::error::StudyError;
use crate::model::study::Study;
use cdpr_robot::{Vector3, Wrench};
use cdpr_statics::Load;
use indexmap::IndexMap;
use serde::{Deserialize, Serialize};

/// All results of a study; `summary.json`.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Summary {
    /// Name of the study.
    pub study: String,
    /// Its hash ([`Study::hash`]); empty in results of earlier versions.
    #[serde(default, skip_serializing_if = "String::is_empty")]
    pub hash: String,
    /// Name of the robot.
    pub robot: String,
    /// Version of the program.
    pub version: String,
    /// Mass added [kg].
    pub payload: f64,
    /// Force and moment that come with it [N, N m], of a study that has them.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub wrench: Option<[[f64; 3]; 2]>,
    /// Seed.
    pub seed: u64,
    /// Results by name.
    #[serde(serialize_with = "in_file")]
    pub studies: IndexMap<String, StudySummary>,
}

impl Summary {
    /// The load whose effect is the deflection.
    pub fn load(&self) -> Load {
        let [force, moment] = self.wrench.unwrap_or_default().map(Vector3::from);
        Load { payload: self.payload, wrench: Wrench { force, moment } }
    }

    /// The summary of a study from the results of its samplings and surfaces.
    ///
    /// # Errors
    /// As [`Study::hash`].
    pub fn new(study: &Study, studies: IndexMap<String, StudySummary>) -> Result<Self, StudyError> {
        Ok(Self {
            study: study.file.name.clone(),
            hash: study.hash()?,
            robot: study.robot.name.clone(),
            version: env!("CARGO_PKG_VERSION").to_owned(),
            payload: study.file.payload,
            wrench: Some([study.file.force, study.file.moment]).filter(|wrench| *wrench != [[0.0; 3]; 2]),
            seed: study.file.seed,
            studies,
        })
    }
}
