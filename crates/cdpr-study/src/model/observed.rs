//! The result of an observation: a displacement, or the reason of its failure.

use cdpr_robot::Vector3;
use cdpr_statics::StaticsError;
use std::collections::BTreeMap;

/// The displacement dp [m] of an observation, or the reason of its failure.
pub type Observed = Result<Vector3<f64>, Failure>;

/// Why an observation failed.
#[derive(Clone, Debug, PartialEq)]
pub struct Failure {
    /// Kind of the failure, such as `infeasible_tension`.
    pub kind: String,
    /// The reason with its numbers.
    pub reason: String,
}

impl From<StaticsError> for Failure {
    fn from(error: StaticsError) -> Self {
        Self { kind: error.kind().to_owned(), reason: error.to_string() }
    }
}

/// RMS in the unit of tables and figures.
pub(crate) fn rms_mm(rms: f64) -> f64 {
    1e3 * rms
}

/// RMS [mm] of an observation that has not failed.
pub(crate) fn outcome_rms_mm(outcome: &Observed) -> Option<f64> {
    outcome.as_ref().ok().map(|displacement| rms_mm(displacement.norm()))
}

/// dp and RMS [mm].
pub(crate) fn observed_mm(outcome: &Observed) -> [Option<f64>; 4] {
    outcome.as_ref().map_or([None; 4], |dp| [1e3 * dp.x, 1e3 * dp.y, 1e3 * dp.z, rms_mm(dp.norm())].map(Some))
}

/// `ok`, or the kind of the failure and its reason.
pub(crate) fn status(outcome: &Observed) -> (&str, &str) {
    outcome.as_ref().map_or_else(|failure| (failure.kind.as_str(), failure.reason.as_str()), |_| ("ok", ""))
}

/// Kinds of the failures among outcomes.
pub(crate) fn failures(outcomes: &[Observed]) -> impl Iterator<Item = &str> {
    outcomes.iter().filter_map(|outcome| outcome.as_ref().err()).map(|failure| failure.kind.as_str())
}

/// Failures by kind; the usual kinds are always listed.
pub(crate) fn count_failed<'a>(kinds: impl Iterator<Item = &'a str>) -> BTreeMap<String, usize> {
    let usual = ["infeasible_tension", "inverse_not_converged", "direct_not_converged"];
    let mut failed: BTreeMap<String, usize> = usual.map(|kind| (kind.to_owned(), 0)).into();
    for kind in kinds {
        *failed.entry(kind.to_owned()).or_default() += 1;
    }
    failed
}
