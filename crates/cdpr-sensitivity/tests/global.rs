//! Global sensitivity: designs and estimators on functions whose indices are known.

mod brackets;
mod dgsm;
pub(crate) mod functions;
mod indices;
mod morris;
mod pce;
mod regression;
mod sequential;
mod space_filling;
