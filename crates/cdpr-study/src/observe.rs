//! Making, sharing out and counting observations.

pub(crate) mod observation;
pub(crate) mod pace;
pub(crate) mod plan;
pub(crate) mod shard;
pub(crate) mod status;
