//! Convergence of Sobol's indices over a growing number of blocks.
//!
//! The first blocks of a [`SaltelliDesign`] are a design themselves. The indices of N / 8, N / 4 and N / 2
//! blocks therefore need no further observation, and a design that turns out to be too small is doubled
//! instead of replaced.

use serde::{Deserialize, Serialize};

use crate::design::SampleDesign;
use crate::design::observation::{check_outputs, observe_rows};
use crate::design::saltelli::SaltelliDesign;
use crate::error::{SensitivityError, require};
use crate::measure::sobol_indices::{SobolIndices, sobol_indices};
use crate::sample::random::Bootstrap;

/// Condition on which doubling ends.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schemars", derive(schemars::JsonSchema))]
pub struct Target {
    /// Largest width that an interval may have.
    pub width: f64,
    /// Confidence level of the intervals, in (0, 1).
    pub level: f64,
    /// Largest number of blocks.
    pub max_blocks: usize,
}

/// Result of [`until_tight`].
#[derive(Debug, Clone)]
pub struct Tightened {
    /// Design with the number of blocks at the end.
    pub design: SaltelliDesign,
    /// All outputs of the design.
    pub outputs: Vec<Option<f64>>,
    /// Indices after each doubling.
    pub steps: Vec<SobolIndices>,
    /// Whether the last indices are tight. If not, the next doubling would have exceeded the maximum.
    pub tight: bool,
}

/// Indices of the first N / 8, N / 4, N / 2 and of all N blocks.
///
/// # Errors
/// [`SensitivityError::InvalidParameter`] unless N is a power of two from 8 on; those of [`sobol_indices`]
/// for N / 8 blocks.
pub fn convergence(
    design: &SaltelliDesign,
    outputs: &[Option<f64>],
    bootstrap: Bootstrap,
    level: f64,
) -> Result<Vec<SobolIndices>, SensitivityError> {
    let blocks = design.blocks();
    require(blocks.is_power_of_two() && blocks >= 8, "blocks", blocks as f64, "a power of two from 8 on")?;
    check_outputs(design, outputs)?;
    let of_first = |divisor| {
        let part = design.resized(blocks / divisor)?;
        sobol_indices(&part, &outputs[..part.points()], bootstrap, level)
    };
    [8, 4, 2, 1].into_iter().map(of_first).collect()
}

/// Finds the first of `steps` in which no interval is wider than `width`.
#[must_use]
pub fn first_tight(steps: &[SobolIndices], width: f64) -> Option<&SobolIndices> {
    steps.iter().find(|indices| indices.widest() <= width)
}

/// Runs a model on a design and doubles its blocks until no interval is wider than the target.
///
/// It also ends if the next doubling would exceed the maximum of the target. The test after each doubling
/// makes the last intervals slightly optimistic, because one of several tests may succeed by chance.
///
/// # Errors
/// Those of [`sobol_indices`]; [`SensitivityError::InvalidParameter`] for a width that is not positive.
pub fn until_tight(
    design: SaltelliDesign,
    target: Target,
    bootstrap: Bootstrap,
    model: impl Fn(&[f64]) -> Option<f64> + Sync,
) -> Result<Tightened, SensitivityError> {
    require(target.width > 0.0, "width", target.width, "a positive number")?;
    let mut run = Tightened { design, outputs: Vec::new(), steps: Vec::new(), tight: false };
    loop {
        let rows = run.outputs.len()..run.design.points();
        run.outputs.extend(observe_rows(&run.design, rows, &model)?);
        let indices = sobol_indices(&run.design, &run.outputs, bootstrap, target.level)?;
        run.tight = indices.widest() <= target.width;
        run.steps.push(indices);
        let next = 2 * run.design.blocks();
        if run.tight || next > target.max_blocks {
            return Ok(run);
        }
        run.design = run.design.resized(next)?;
    }
}
