//! Direct elasto-geometrical model (DEGM): the pose for given unstrained lengths.

mod continuation;
mod multistart;
mod near;
mod newton;
mod search;
mod solution;
mod stability;
mod subproblem;
mod trust_region;

pub use continuation::{Loss, LossKind, Path, PathStep, Setting, follow_load};
pub(crate) use continuation::{follow_change, follow_from};
pub use multistart::{Equilibria, Found, Starts};
pub use search::{DirectStart, direct, rough_pose};
pub use solution::{DirectMethod, DirectReport, DirectSolution};
pub use stability::{Mode, Stability};
