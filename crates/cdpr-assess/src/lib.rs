//! Assessments of a robot: where it can work, which tolerances matter, how reliably its pose is found, and
//! which values of its file look wrong.
//!
//! | question | function |
//! |---|---|
//! | Where is the platform held, how far does a load deflect it, how stiff is it? | [`compute_workspace`] |
//! | What can it carry at a pose, how far are the limits of tension? | [`capacity_at`] |
//! | Where does it come to rest when a cable breaks, and do the others bear that? | [`safety_at`] |
//! | Are its cables within their design resistance, by partial factors? | [`factored_cases`] |
//! | Where does it rest in weather, and from which direction is wind worst? | [`winds`] |
//! | Where do the exits go for the least deflection? | [`design`] |
//! | What has to be given up of one objective for another? | [`front`] |
//! | How near do cables come to each other and to the platform? | [`clearance_at`] |
//! | How far may it tilt there? | [`tilt_at`] |
//! | What happens along a path of poses, and how uncertain is it? | [`Path`] |
//! | How much do robots swing after a move, if they are not the nominal one? | [`DrawnRobots`] |
//! | Which tolerances have to be tightened for a limit on deflection or position? | [`tolerance_budget`] |
//! | How often does the direct model find the true pose from a wrong start? | [`run_robustness`] |
//! | Which values of a robot file look wrong? | [`inspect`] |

mod boundary;
mod capacity;
mod clearance;
mod design;
mod error;
mod inspection;
mod path;
mod robustness;
mod safety;
mod tilt;
mod tolerance;
mod vibration;
mod workspace;
mod write;

pub use boundary::Boundary;
pub use capacity::{Block, Capacity, Figure, WrenchSet, capacity_at};
pub use clearance::{CableDistance, Clearance, PlatformDistance, clearance_at, clearance_under};
pub use design::{
    ActiveDemand, BestDesign, BestOfTypes, CableSpec, ChosenCable, Crossings, DESIGN_FORMAT, Design,
    DesignFile, DesignProblem, DesignedVariable, Front, FrontPoint, Goal, LimitsSpec, ObjectiveSpec, Over,
    OwnStiffness, ParetoSpec, VariableSpec, design, design_schema, front,
};
pub use error::AssessError;
pub use inspection::{Finding, Severity, assumed_ground, below_floor, doubtful_rest, inspect};
pub use path::{Bands, Path, PathPose};
pub use robustness::{
    Answer, Assignment, Draws, FOUND_ANGLE, Outcome, PoseRegion, Protocol, ProtocolSummary, Published,
    Refusal, RefusedPose, RobustnessResult, RobustnessRow, RobustnessSummary, Solve, Spread, StartOffset,
    anchor_distance, protocols, run_robustness,
};
pub use safety::factored::{
    FactoredCase, FactoredRest, FactoredSwing, Situation, Utilization, factored_cases, governing,
};
pub use safety::factors::{CaseFactors, PartialFactors};
pub use safety::winds::{AnyWeather, DIRECTIONS, InWind, Winds, winds};
pub use safety::{Breaks, Broken, BrokenRest, Safety, Swing, safety_at};
pub use tilt::{Tilt, TiltTowards, tilt_at};
pub use tolerance::{
    Limit, Limited, PricedCalibration, Reached, Tolerance, ToleranceBudget, tolerance_budget,
};
pub use vibration::{Compared, DrawnRobots, ratio_of_best};
pub use workspace::breaks::AfterBreaks;
pub use workspace::question::{Further, Shaking, TiltDirections, Way, Workspace};
pub use workspace::results::{Dominant, HELD, Held, Recomputed, WorkspacePose};
pub use workspace::row::WorkspaceRow;
pub use workspace::summary::{BoundarySummary, ShakingSummary, WeatherSummary, WorkspaceSummary};
pub use workspace::{compute_workspace, workspace_boundary};
pub use write::{FoundRegion, read_region};
pub use write::{begin_robustness, begin_workspace, write_robustness, write_workspace};
