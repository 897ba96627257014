//! Robots of other programs, imported and exported.

#![allow(clippy::unwrap_used, clippy::panic, clippy::print_stdout)]

mod broken;
mod export;
mod fixtures;
mod import;
