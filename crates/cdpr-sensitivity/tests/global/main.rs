//! Global sensitivity: designs and estimators on functions whose indices are known.
#![allow(clippy::panic, clippy::unwrap_used)]

mod dgsm;
mod functions;
mod indices;
mod morris;
mod pce;
mod regression;
mod sequential;
mod space_filling;
