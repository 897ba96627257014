//! Tables that somebody has: read from CSV, Parquet or a folder of results, and analysed without a design.

mod analyse;
mod columns;
mod open;
#[cfg(feature = "parquet")]
mod parquet;
mod write;

pub use analyse::{TableAnalysis, TableRequest, VectorAnalysis, analyse_table};
pub use columns::{BadCell, GivenColumn, GivenTable};
pub use open::open_table;
pub use write::{begin_analysis, write_analysis};
