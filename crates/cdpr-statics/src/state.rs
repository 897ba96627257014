//! Plain data of the models: loads, equilibria, residuals.

mod equilibrium;
mod load;
mod residual;
mod wanted;

pub use equilibrium::Equilibrium;
pub use load::Load;
pub use residual::Residual;
pub(crate) use residual::rounding_of_closure;
pub(crate) use wanted::one_by_one;
pub use wanted::{Wanted, WantedPose};
