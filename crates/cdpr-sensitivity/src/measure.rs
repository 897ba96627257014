//! Measures of sensitivity. Each estimator has a module and takes the type of design that it can interpret.

pub mod allocation;
pub mod bracket;
pub mod convergence;
pub mod dgsm;
pub mod distance;
pub mod effect;
pub mod expansion;
pub mod gradient_expansion;
pub(crate) mod linear_algebra;
mod linear_part;
pub mod morris;
pub mod poincare;
pub mod regression;
pub mod shapley;
pub mod sobol_indices;
#[cfg(feature = "faer")]
pub mod subspace;
