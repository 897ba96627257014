//! Global sensitivity: designs and estimators on functions whose indices are known.

mod dgsm;
mod functions;
mod indices;
mod morris;
mod pce;
mod regression;
mod sequential;
mod space_filling;
