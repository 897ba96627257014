//! The results of a position.

use crate::capacity::Capacity;
use crate::clearance::Clearance;
use crate::safety::winds::Winds;
use crate::tilt::Tilt;
use crate::workspace::breaks::AfterBreaks;
use cdpr_dynamics::{LargestInBand, Swing};
use cdpr_robot::{Pose, Robot, Vector3};
use cdpr_statics::StaticsError;
use cdpr_statics::batch::LoadedPose;
use cdpr_statics::limits::{Limit, OutOfLimits, tensions_out_of_limits};
use cdpr_study::ErrorModel;

/// A position and its results.
#[derive(Clone, Debug, PartialEq)]
pub struct WorkspacePose {
    /// The wanted pose.
    pub pose: Pose,
    /// The result with the lengths kept under the load, or the reason why no tensions hold the platform or
    /// bear the load.
    pub outcome: Result<Held, StaticsError>,
    /// The tensions recomputed under the load, or the reason why they cannot be; `None` without a load.
    pub recomputed: Option<Result<Recomputed, StaticsError>>,
    /// What can be carried, if asked for.
    pub capacity: Option<Box<Capacity>>,
    /// Distances of the cables that bear the load, tensions recomputed, if asked for.
    pub clearance: Option<Box<Result<Clearance, StaticsError>>>,
    /// How far the platform may tilt under the load, if asked for.
    pub tilt: Option<Box<Result<Tilt, StaticsError>>>,
    /// Its largest amplitudes where it is shaken, with the lengths kept under the load, if asked for; `None`
    /// where it is not held.
    pub shaken: Option<Box<Result<LargestInBand, StaticsError>>>,
    /// Where it rests in the weather and under the load, the lengths kept, if asked for; `None` where it is
    /// not held.
    pub weather: Option<Box<Result<Winds, StaticsError>>>,
    /// What becomes of it when cables break, the winches holding it under the load, if asked for.
    pub breaks: Option<Box<Result<AfterBreaks, StaticsError>>>,
}

/// Tensions that hold a pose under the load.
#[derive(Clone, Debug, PartialEq)]
pub struct Recomputed {
    /// Least tension at the platform [N].
    pub least_tension: f64,
    /// Greatest tension at the platform [N].
    pub greatest_tension: f64,
    /// Tensions above a breaking force or a limit.
    pub out_of_limits: Vec<OutOfLimits>,
}

/// A pose with feasible tensions, on lengths that the load does not change.
#[derive(Clone, Debug, PartialEq)]
pub struct Held {
    /// Least tension at the platform, without and with the load [N].
    pub least_tension: f64,
    /// Greatest tension at the platform, without and with the load [N].
    pub greatest_tension: f64,
    /// Tensions out of limits, without or with the load, the most serious one of each cable.
    pub out_of_limits: Vec<OutOfLimits>,
    /// dp, Eq. (4) [m].
    pub displacement: Vector3<f64>,
    /// Stiffness of the softest motion with the load [N/m], see [`cdpr_statics::Stability`].
    pub least_stiffness: f64,
    /// How fast it swings with the load, the mass of the cables included; `None` for a robot that lacks
    /// `platform.inertia`, and where a cable hangs without tension.
    pub swing: Option<Swing>,
    /// Cables (from 0) that are slack with the load.
    pub slack: Vec<usize>,
    /// The tolerance that matters most; `None` if no tolerance is wanted, nothing is uncertain, or |dp| has
    /// no derivative.
    pub dominant: Option<Dominant>,
}

impl WorkspacePose {
    /// Whether a tension there is above its greatest value or breaks the cable.
    pub(super) fn is_too_much(&self) -> bool {
        self.outcome.as_ref().is_ok_and(|held| held.out_of_limits.iter().any(OutOfLimits::is_too_much))
    }
}

/// The cause behind the largest share of the variance of |dp|, to first order.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Dominant {
    /// Index of the error model's input.
    pub input: usize,
    /// Its share, 0 to 1.
    pub share: f64,
    /// Standard deviation of |dp| from all of them [m].
    pub std: f64,
}

/// The status of a position that is held with all tensions within the limits.
pub const HELD: &str = "held";

/// That of a position that is held with a tension out of its limits.
pub(super) const BEYOND_LIMITS: &str = "beyond_limits";

impl Held {
    pub(super) fn new(robot: &Robot, loaded: LoadedPose, dominant: Option<Dominant>) -> Self {
        let each = || loaded.tensions.iter().flatten().map(|[at_platform, _]| *at_platform);
        Self {
            least_tension: each().fold(f64::INFINITY, f64::min),
            greatest_tension: each().fold(0.0, f64::max),
            out_of_limits: tensions_out_of_limits(robot, &loaded.tensions),
            displacement: loaded.displacement,
            least_stiffness: loaded.least_stiffness,
            swing: None,
            slack: loaded.slack,
            dominant,
        }
    }

    /// Whether all tensions are within the limits of their cables and below the breaking forces.
    pub fn is_within_limits(&self) -> bool {
        self.out_of_limits.iter().all(|found| found.limit == Limit::MaxElsewhere)
    }
}

impl Dominant {
    pub(super) fn of(slopes: &[f64], model: &ErrorModel) -> Option<Self> {
        let parts = model.variances(slopes);
        let variance: f64 = parts.iter().sum();
        let (input, part) = parts.iter().enumerate().max_by(|a, b| a.1.total_cmp(b.1))?;
        (variance > 0.0).then(|| Self { input, share: part / variance, std: variance.sqrt() })
    }
}
