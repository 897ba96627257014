//! Plain data of the models: loads, equilibria, residuals.

mod equilibrium;
mod load;
mod residual;

pub use equilibrium::Equilibrium;
pub use load::Load;
pub use residual::Residual;
pub(crate) use residual::rounding_of_closure;
