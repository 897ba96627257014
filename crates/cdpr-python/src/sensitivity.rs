//! `cdpr.sensitivity`: designs of experiments for any model, and estimates from its outputs.

pub(crate) mod analysis;
pub(crate) mod designs;
pub(crate) mod estimates;
