//! Designs of experiments for any model, and what they estimate from its outputs.

pub(crate) mod designs;
pub(crate) mod estimates;
