//! Sets of wrenches as they are typed or listed in a file.

use crate::arguments::components;
use crate::error::ProgramError;
use cdpr_assess::WrenchSet;
use cdpr_robot::{Vector6, Wrench};
use cdpr_study::{InputKind, read_text};
use std::path::{Path, PathBuf};

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

/// The wrenches of a file, one a line.
fn wrench_file(path: &Path) -> Result<Vec<[f64; 6]>, ProgramError> {
    let text = read_text(path, InputKind::Poses)?;
    let mut wrenches = Vec::new();
    let lines = text.lines().enumerate().filter(|(_, line)| !line.trim().is_empty());
    for (number, line) in lines {
        match components::<6>(line) {
            Ok(wrench) => wrenches.push(wrench),
            // A header has no number.
            Err(_) if wrenches.is_empty() && !line.contains(|c: char| c.is_ascii_digit()) => {}
            Err(reason) => {
                let place = format!("--wrenches {}, line {}: {reason}", path.display(), number + 1);
                return Err(ProgramError::Usage(place));
            }
        }
    }
    if wrenches.is_empty() {
        let empty = format!("--wrenches {}: expected a wrench on each line", path.display());
        return Err(ProgramError::Usage(empty));
    }
    Ok(wrenches)
}
