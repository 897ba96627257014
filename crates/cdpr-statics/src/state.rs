//! Plain data of the models: loads, equilibria, residuals.

mod equilibrium;
mod load;
mod out_of_limits;
mod residual;

pub use equilibrium::Equilibrium;
pub use load::Load;
pub use out_of_limits::{Limit, OutOfLimits, out_of_limits};
pub use residual::Residual;
pub(crate) use residual::rounding_of_closure;
