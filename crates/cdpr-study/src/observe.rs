//! Observations: made, shared out and counted.

pub(crate) mod observation;
pub(crate) mod plan;
pub(crate) mod shard;
pub(crate) mod status;
