//! `cdpr study new`.

use super::RunError;
use clap::Args;
use std::path::PathBuf;

#[derive(Args)]
pub(crate) struct Settings {
    /// Robot file (JSON, `cdpr-robot/1`).
    #[arg(long)]
    robot: PathBuf,
    /// File to write; printed if left out.
    #[arg(long)]
    out: Option<PathBuf>,
}

pub(super) fn run(_: &Settings) -> Result<(), RunError> {
    Ok(())
}
