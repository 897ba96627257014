//! The equations of one cable in its vertical plane, over any kind of number.
//!
//! The kinds are doubles, intervals, dual numbers and the lanes of a vector unit.
//!
//! Solvers that evaluate a cable with numbers of their own build on these functions. For doubles the methods
//! of
//! [`crate::Catenary`] answer the same questions, for cables of any elastic law.

mod lane_guide;
mod lane_law;
mod plane;
mod response;
mod series;

pub use lane_guide::{LaneEndSlopes, LaneGuide, LaneWay, LeavePoint};
pub use lane_law::{
    LaneSegment, lane_law_end, lane_law_energy, lane_law_response, lane_law_strain, lane_law_stretch,
};
pub use plane::{closure_of_limp, in_plane_stiffness, stiffness_in_space};
pub(crate) use response::Terms;
pub use response::{LaneEnd, Response, lane_end, lane_response, response};
pub use series::{FOLDED, TAUT};
