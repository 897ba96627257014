//! Measures of sensitivity: one module an estimator, each for the design that it takes.

pub mod allocation;
pub mod convergence;
pub mod dgsm;
pub mod effect;
pub mod expansion;
mod least_squares;
pub mod morris;
pub mod regression;
pub mod sobol_indices;
