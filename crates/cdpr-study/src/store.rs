//! Observations on disk, block by block.

pub(crate) mod block;
pub(crate) mod blocks;
pub(crate) mod folder;
