//! Sobol's indices over a growing number of blocks.
//!
//! The first blocks of a [`SaltelliDesign`] are a design themselves, so that what N outputs give for N / 8, N / 4, N / 2
//! blocks costs no further observation, and a design that turns out to be too small is doubled, not replaced.

use serde::{Deserialize, Serialize};

use crate::design::SampleDesign;
use crate::design::observation::{check_outputs, observe_rows};
use crate::design::saltelli::SaltelliDesign;
use crate::error::{SensitivityError, require};
use crate::measure::sobol_indices::{SobolIndices, sobol_indices};
use crate::sample::random::Bootstrap;

/// When to stop.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize, schemars::JsonSchema)]
pub struct Target {
    /// Width that no interval may exceed.
    pub width: f64,
    /// Confidence level of the intervals, in (0, 1).
    pub level: f64,
    /// Blocks not to go beyond.
    pub max_blocks: usize,
}

/// What [`until_tight`] has come to.
#[derive(Debug, Clone)]
pub struct Tightened {
    /// The design, of as many blocks as were needed.
    pub design: SaltelliDesign,
    /// All its outputs.
    pub outputs: Vec<Option<f64>>,
    /// The indices after each doubling.
    pub steps: Vec<SobolIndices>,
    /// Whether the last of them are tight; if not, the next doubling would have gone beyond the maximum.
    pub tight: bool,
}

/// Indices of the first N / 8, N / 4, N / 2 and of all N blocks.
///
/// # Errors
/// [`SensitivityError::InvalidParameter`] unless N is a power of two; those of [`sobol_indices`], which N / 8 blocks
/// have to satisfy.
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

/// The first of `steps` in which no interval is wider than `width`.
#[must_use]
pub fn first_tight(steps: &[SobolIndices], width: f64) -> Option<&SobolIndices> {
    steps.iter().find(|indices| indices.widest() <= width)
}

/// Runs a model on a design, and on twice as many blocks again and again, until no interval is wider than the target
/// or the next doubling would exceed its maximum.
///
/// Looking at the intervals after each doubling makes the last ones a little optimistic: among several looks one may be
/// tight by chance.
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
