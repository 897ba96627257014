//! `cdpr.sensitivity`: designs of experiments for any model, laws, and estimates from its outputs.

pub(crate) mod analysis;
pub(crate) mod designs;
pub(crate) mod expansion;
mod independent;
pub(crate) mod laws;
mod observed;
