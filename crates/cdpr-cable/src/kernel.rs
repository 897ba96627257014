//! The equations of one cable in its vertical plane, over any kind of number.
//!
//! The kinds are doubles, intervals, dual numbers and the lanes of a vector unit.
//!
//! Solvers that evaluate a cable with numbers of their own build on these functions. For doubles the methods
//! of
//! [`crate::Catenary`] answer the same questions, for cables of any elastic law.

mod fixed_ends;
mod guide;
mod material;
mod plane;
mod response;
mod series;

pub use fixed_ends::AtFixedEnds;
pub use guide::{GuideTerms, GuidedEndSlopes, GuidedInSpace, LeavePoint, SwivelAxis, Way};
pub use material::{LawSegment, Material};
pub use plane::{closure_of_slack, in_plane_stiffness, stiffness_in_space};
pub(crate) use response::Terms;
pub use response::{LaneEnd, Response, response};
pub use series::TAUT;
