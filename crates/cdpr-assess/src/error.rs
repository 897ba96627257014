//! Errors of assessments.

use cdpr_statics::StaticsError;
use cdpr_study::StudyError;

/// Why a question about a robot has no answer.
///
/// Functions of this crate that can only fail as those of `cdpr-study` do return a [`StudyError`].
#[derive(Debug, thiserror::Error)]
pub enum AssessError {
    /// An invalid setting, a failed statistic, or a file that cannot be written.
    #[error(transparent)]
    Study(#[from] StudyError),
    /// A limit that no tightening of tolerances reaches.
    #[error("limit is {limit_mm} mm: expected one that tolerances reach, but {reason} ({reached_mm:.6} mm)")]
    Unreachable {
        /// The limit [mm].
        limit_mm: f64,
        /// Why it is out of reach.
        reason: &'static str,
        /// The error that is reached [mm].
        reached_mm: f64,
    },
    /// Too many robots have no equilibrium for a quantile of their error to exist.
    #[error(
        "no equilibrium at the wanted pose for {what}: expected tighter tolerances, or a pose that such robots \
         hold{}",
        because(source.as_deref())
    )]
    Unobservable {
        /// The robots.
        what: String,
        /// The reason, of a single robot or of the first one.
        source: Option<Box<StaticsError>>,
    },
    /// The robot has feasible tensions at hardly any pose of a region.
    #[error(
        "poses is {wanted}: expected at most as many as the robot holds, but of {drawn} poses drawn {found} are \
         held in a stable equilibrium, {infeasible} are infeasible and {unstable} unstable"
    )]
    TooFewPoses {
        /// Poses asked for.
        wanted: usize,
        /// Poses collected.
        found: usize,
        /// Poses drawn.
        drawn: usize,
        /// Poses without an answer of the inverse model.
        infeasible: usize,
        /// Poses from whose equilibrium the direct model moves away.
        unstable: usize,
    },
}

fn because(source: Option<&StaticsError>) -> String {
    source.map_or_else(String::new, |source| format!(": {source}"))
}
