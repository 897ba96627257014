//! Sets of wrenches as they are given on the command line.

use crate::arguments::components;
use crate::error::ProgramError;
use crate::lists::wrench_file;
use cdpr_assess::WrenchSet;
use cdpr_robot::{Vector6, Wrench};
use std::path::PathBuf;

/// A set of wrenches that act on the platform beside the load.
#[derive(clap::Args)]
pub(crate) struct WrenchArguments {
    /// Wrench about P: fx,fy,fz,mx,my,mz [N, N m]; several times for a set.
    #[arg(long, value_name = "WRENCH", value_parser = components::<6>, allow_hyphen_values = true)]
    wrench: Vec<[f64; 6]>,
    /// File of wrenches (CSV): fx,fy,fz,mx,my,mz on each line, below a header or without one.
    #[arg(long, value_name = "FILE", conflicts_with = "wrench")]
    wrenches: Option<PathBuf>,
    /// Half widths of a box about each wrench, or about zero, whose corners are the set:
    /// fx,fy,fz,mx,my,mz [N, N m].
    #[arg(long, value_name = "WRENCH", value_parser = components::<6>, allow_hyphen_values = true)]
    wrench_box: Option<[f64; 6]>,
}

impl WrenchArguments {
    /// Whether any of them is given.
    pub(crate) fn are_given(&self) -> bool {
        !self.wrench.is_empty() || self.wrenches.is_some() || self.wrench_box.is_some()
    }

    pub(crate) fn set(&self) -> Result<WrenchSet, ProgramError> {
        let wrench = |numbers: &[f64; 6]| Wrench::from_vector(&Vector6::from(*numbers));
        let listed = self.wrenches.as_deref().map(wrench_file).transpose()?;
        let set = WrenchSet::of(listed.as_ref().unwrap_or(&self.wrench).iter().map(wrench).collect());
        Ok(self.wrench_box.as_ref().map_or_else(|| set.clone(), |widths| set.widened(&wrench(widths))))
    }
}
