//! All results of a study.

use crate::analysis::comparison::{ComparisonRow, compare};
use crate::analysis::part::StudySummary;
use crate::model::study::Study;
use indexmap::IndexMap;
use serde::{Deserialize, Serialize};

/// All results of a study; `summary.json`.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Summary {
    /// Name of the study.
    pub study: String,
    /// Name of the robot.
    pub robot: String,
    /// Version of the program.
    pub version: String,
    /// Mass added [kg].
    pub payload: f64,
    /// Seed.
    pub seed: u64,
    /// Results by name.
    pub studies: IndexMap<String, StudySummary>,
    /// Published figures beside the computed ones.
    pub comparison: Vec<ComparisonRow>,
}

impl Summary {
    /// The summary of a study from the results of its samplings and surfaces.
    pub fn new(study: &Study, studies: IndexMap<String, StudySummary>) -> Self {
        Self {
            study: study.file.name.clone(),
            robot: study.robot.name.clone(),
            version: env!("CARGO_PKG_VERSION").to_owned(),
            payload: study.file.payload,
            seed: study.file.seed,
            comparison: compare(&study.file.comparison, &studies),
            studies,
        }
    }
}
