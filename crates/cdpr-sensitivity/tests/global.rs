//! Global sensitivity: designs and estimators on functions whose indices are known.

mod brackets;
#[cfg(feature = "faer")]
mod bures;
mod dgsm;
pub(crate) mod functions;
mod gradient_pce;
mod groups;
mod indices;
mod morris;
mod pce;
mod regression;
mod sequential;
mod shapley;
mod space_filling;
#[cfg(feature = "faer")]
mod subspace;
