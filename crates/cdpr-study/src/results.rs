//! Tables and summaries in a folder of results, written and read back.

#[cfg(feature = "parquet")]
pub(crate) mod parquet;
pub(crate) mod read;
pub(crate) mod table;
pub(crate) mod write;
