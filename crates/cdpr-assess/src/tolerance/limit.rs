//! The limit of an error that a budget keeps.

use cdpr_study::{Output, StudyError};
use indexmap::IndexMap;
use serde::{Deserialize, Serialize};

/// Most robots for the verification, which keeps one number for each.
const MOST_ROBOTS: usize = 1 << 24;

/// The error that is limited [mm].
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Limited {
    /// |dp| of the static deflection under the study's load.
    Deflection,
    /// Distance of P from the wanted pose, without the load, if the deviating robot is given the nominal
    /// robot's lengths. These lengths include the offsets of tension set-points.
    Position,
}

impl Limited {
    /// The output of a study that it is.
    pub(super) fn output(self) -> Output {
        match self {
            Self::Deflection => Output::Deflection,
            Self::Position => Output::Position,
        }
    }

    /// The error that is limited: the one that is named, or else the output of the study.
    pub(super) fn of(named: Option<Self>, output: Output) -> Result<Self, StudyError> {
        match (named, output) {
            (Some(named), _) => Ok(named),
            (None, Output::Deflection) => Ok(Self::Deflection),
            (None, Output::Position) => Ok(Self::Position),
            (None, _) => {
                let expected = "deflection or position, whose size a budget limits: name one of them";
                Err(StudyError::setting("the study's output", output, expected))
            }
        }
    }
}

/// The question that a budget answers.
#[derive(Clone, Debug, PartialEq)]
pub struct Limit {
    /// The error; `None` for the study's output.
    pub of: Option<Limited>,
    /// Its limit [mm].
    pub limit_mm: f64,
    /// Share of the robots that are to keep it, between 0 and 1.
    pub quantile: f64,
    /// Cost of each tolerance by the name of its entry, as it is now; halved it costs twice as much. 1 for
    /// those left out.
    pub costs: IndexMap<String, f64>,
    /// Independent robots that the budget is verified with.
    pub verified_with: usize,
}

impl Limit {
    /// Refuses what no budget can have.
    ///
    /// # Errors
    /// [`StudyError::Setting`] for an invalid limit, quantile, count or cost.
    pub fn check(&self) -> Result<(), StudyError> {
        let Self { limit_mm, quantile, verified_with, costs, .. } = self;
        if !(limit_mm.is_finite() && *limit_mm > 0.0) {
            return Err(StudyError::setting("limit", limit_mm, "a positive finite number of millimetres"));
        }
        if !(*quantile > 0.0 && *quantile < 1.0) {
            return Err(StudyError::setting("quantile", quantile, "a share of the robots between 0 and 1"));
        }
        if !(1..=MOST_ROBOTS).contains(verified_with) {
            let expected = format!("1 to {MOST_ROBOTS} robots to verify the budget with");
            return Err(StudyError::setting("observations", verified_with, expected));
        }
        match costs.iter().find(|(_, cost)| !(cost.is_finite() && **cost > 0.0)) {
            Some((name, cost)) => {
                Err(StudyError::setting(format!("costs.{name}"), cost, "a positive finite number"))
            }
            None => Ok(()),
        }
    }
}
