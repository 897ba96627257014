//! Studies, their files and their protocols.

#![allow(clippy::unwrap_used, clippy::panic, clippy::print_stdout)]

mod error_model;
mod operating_point;
mod output;
mod parquet;
mod record;
mod sensitivity;
mod shared_folder;
mod tables;
