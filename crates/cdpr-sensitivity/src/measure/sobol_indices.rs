//! Sobol's first-order indices, total indices and indices of pairs of inputs, from Saltelli's blocks.
//!
//! With a, b, `ab_i` and `ba_i` the outputs of a block less the mean of all outputs, and with means over the
//! blocks,
//!
//! ```text
//! V = mean((a² + b²) / 2) - mean((a + b) / 2)²                           (Si1)
//! S_i = mean(b (ab_i - a)) / V                                           (Si2)
//! T_i = mean((a - ab_i)²) / (2 V)                                        (Si3)
//! S_ij = mean(ba_i ab_j - a b) / V - S_i - S_j,   i < j                  (Si4)
//! ```
//!
//! - (Si2): A. Saltelli et al., *Variance based sensitivity analysis of model output*, Comput. Phys. Commun.
//!   181 (2010).
//! - (Si3): M. J. W. Jansen, *Analysis of variance designs for model output*, Comput. Phys. Commun. 117
//!   (1999).
//! - (Si4): A. Saltelli, *Making best use of model evaluations to compute sensitivity indices*, Comput. Phys.
//!   Commun. 145 (2002).
//!
//! Those of a plain sequence agree with the estimators of SALib up to rounding.
//!
//! **A scrambled design of 256 blocks or more separates the linear part**, whose shares are known. With the
//! slope of input i by the pairs (a, `ab_i`), and with the deviations of the inputs from the means of their
//! laws,
//!
//! ```text
//! β_i = Σ (ab_i - a) (x_i(b) - x_i(a)) / Σ (x_i(b) - x_i(a))²,   r = f - Σ β_i x_i               (Si6)
//! S_i V = β_i² σ_i² + S_i(r) V(r),   T_i V = β_i² σ_i² + T_i(r) V(r),   V = Σ β_i² σ_i² + V(r)   (Si7)
//! ```
//!
//! where (Si1) to (Si4) are applied to r. The covariance of `x_i` and r is 0 for the slopes of all points.
//! Without (Si6) the errors of the means of linear terms are most of the error of a smooth function. The
//! estimate and each replicate have slopes of their own, so that the differences between replicates show the
//! error of the slopes, too.
//!
//! Of a design with groups, i and j stand for groups: the indices are those of all inputs of a group. No
//! linear part is separated, since several inputs of a group move at once.
//!
//! Of an output with several components ([`vector_sobol_indices`]), each product is the sum over the
//! components: with C_u the covariance of `E (f | x_u)`, the indices are `tr C_u / tr C`. F. Gamboa, A.
//! Janon, T. Klein, A. Lagnoux, *Sensitivity analysis for multidimensional and functional outputs*, Electron.
//! J. Stat. 8 (2014): the only indices of this kind that do not depend on rotations of the output.
//!
//! Each index is a quotient of sums over blocks. Those of a scrambled design come from its one sequence of M
//! blocks, half of all. The R replicates together have as many blocks. With s* the deviation over a bootstrap
//! of them ([`crate::sample::interval`], Eq. (CI2)), and S' the index of all replicates together, the
//! interval has the half width
//!
//! ```text
//! max(t_(R-1) √(s*² + (S - S')² / R), 1 / M)                             (Si5)
//! ```
//!
//! A scrambled sequence converges at least as 1 / √n, so that one of M blocks is no worse than the mean of R
//! of M / R. The second term shows directly where it is. The floor 1 / M is the resolution of M blocks:
//! effects that occur in a smaller share of them are often not seen. The inputs lie on other dimensions of
//! Sobol's sequence in each scrambling. On the same dimensions, single inputs had intervals that held in 38 %
//! of the cases, because short and long pieces of two dimensions differ in kind. `cargo xtask statistics
//! measures` counts how often the intervals hold.
//!
//! A plain sequence has no replicates. Its intervals are from a bootstrap over its blocks, as in SALib. They
//! depend on each other, so that such intervals are an indication: see [`SobolIndices::reliable`].
//!
//! **A failed observation is left out of the terms that need it**: that of `ab_i` of the indices of input i
//! only. The indices describe the model where a, b and `ab_i` do not fail. If failures depend on the inputs,
//! no estimator can recover the rest.

mod sums;

use std::collections::BTreeMap;

use rand::RngExt;
use serde::{Deserialize, Serialize};

use crate::design::SampleDesign;
use crate::design::observation::check_outputs;
use crate::design::saltelli::SaltelliDesign;
use crate::error::{SensitivityError, check_length, check_level, check_range};
use crate::measure::linear_part::Lines;
use crate::measure::sobol_indices::sums::{Sums, pairs};
use crate::parallel::*;
use crate::sample::interval::Estimate;
use crate::sample::random::{Bootstrap, stream};
use crate::sample::summary::check_varies;

/// Indices of one input, or of a group.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schemars", derive(schemars::JsonSchema))]
pub struct SobolIndex {
    /// Name of the input, or of the group.
    pub input: String,
    /// Number of blocks behind both indices: those in which a, b and `ab_i` were observed, and of a scrambled
    /// design twice those of its smaller half.
    pub blocks: usize,
    /// First-order index (Si2): share of the variance that the input causes alone.
    pub first: Estimate,
    /// Total index (Si3): share of the variance in which the input takes part.
    pub total: Estimate,
}

/// Index of a pair of inputs.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schemars", derive(schemars::JsonSchema))]
pub struct PairIndex {
    /// Names of the inputs.
    pub inputs: [String; 2],
    /// Index (Si4): share of the variance that the two cause together, beyond what each causes alone.
    pub second: Estimate,
}

/// Indices of all inputs of a [`SaltelliDesign`].
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schemars", derive(schemars::JsonSchema))]
pub struct SobolIndices {
    /// Number of blocks of the design.
    pub blocks: usize,
    /// Number of blocks with a failed observation.
    pub failed_blocks: usize,
    /// Number of failed observations.
    pub failed: usize,
    /// Variance V (Si1), in the square of the unit of the output; of several components the sum.
    pub variance: f64,
    /// Confidence level of the intervals.
    pub level: f64,
    /// Whether the intervals have this level: those of a scrambled design have, from
    /// [`SobolIndices::RELIABLE_BLOCKS`] blocks on. Others are an indication.
    pub reliable: bool,
    /// Indices, one per input in the order of the design.
    pub inputs: Vec<SobolIndex>,
    /// Indices, one per pair (1, 2), (1, 3), .. The list is empty for [`crate::Order::First`].
    pub pairs: Vec<PairIndex>,
}

impl SobolIndices {
    /// Least number of blocks without a failure from which indices are estimated.
    pub const MIN_BLOCKS: usize = 16;

    /// Least number of blocks of a scrambled design from which the intervals have their level: 64, of which a
    /// quarter may have failed.
    pub const RELIABLE_BLOCKS: usize = 48;

    /// Width of the widest interval.
    #[must_use]
    pub fn widest(&self) -> f64 {
        let of_inputs = self.inputs.iter().flat_map(|index| [index.first.width(), index.total.width()]);
        let of_pairs = self.pairs.iter().map(|index| index.second.width());
        of_inputs.chain(of_pairs).fold(0.0, f64::max)
    }
}

/// Estimates indices from one output per row of the design, `None` for a failed observation.
///
/// The intervals are from a bootstrap and have the confidence `level` in (0, 1). The estimator needs eight
/// bytes per index and unit, and per index and resample.
///
/// # Errors
/// - [`SensitivityError::LengthMismatch`] unless there is one output per row;
/// - [`SensitivityError::NotFinite`] for a value that is not finite, even in a block with a failed
///   observation;
/// - [`SensitivityError::InvalidInput`] with [`SensitivityError::OutOfRange`] for an input with fewer than
///   [`SobolIndices::MIN_BLOCKS`] blocks ([`SobolIndex::blocks`]);
/// - [`SensitivityError::OutOfRange`] for fewer than two resamples;
/// - [`SensitivityError::ConstantSample`] if the outputs a and b of all blocks are equal;
/// - [`SensitivityError::InvalidParameter`] for a level outside (0, 1).
pub fn sobol_indices(
    design: &SaltelliDesign,
    outputs: &[Option<f64>],
    bootstrap: Bootstrap,
    level: f64,
) -> Result<SobolIndices, SensitivityError> {
    check_outputs(design, outputs)?;
    indices(design, &[outputs], bootstrap, level)
}

/// Estimates the indices of an output of several components, which need a common unit: one element per row,
/// `None` for a failed observation.
///
/// # Errors
/// As [`sobol_indices`], and [`SensitivityError::LengthMismatch`] for an output without components or with
/// another number than the others.
pub fn vector_sobol_indices(
    design: &SaltelliDesign,
    outputs: &[Option<Vec<f64>>],
    bootstrap: Bootstrap,
    level: f64,
) -> Result<SobolIndices, SensitivityError> {
    check_length("outputs", outputs.len(), design.points())?;
    let size = outputs.iter().flatten().next().map_or(1, |output| output.len().max(1));
    outputs.iter().flatten().try_for_each(|output| check_length("components", output.len(), size))?;
    let component = |c: usize| outputs.iter().map(|output| Some(output.as_ref()?[c])).collect();
    let components: Vec<Vec<Option<f64>>> = (0..size).map(component).collect();
    components.iter().try_for_each(|outputs| check_outputs(design, outputs))?;
    let components: Vec<&[Option<f64>]> = components.iter().map(Vec::as_slice).collect();
    indices(design, &components, bootstrap, level)
}

/// Indices of checked outputs, one list per component.
fn indices(
    design: &SaltelliDesign,
    components: &[&[Option<f64>]],
    bootstrap: Bootstrap,
    level: f64,
) -> Result<SobolIndices, SensitivityError> {
    check_level(level)?;
    check_range("resamples", bootstrap.resamples as u64, 2, u64::MAX)?;
    check_components(design, components)?;
    let summed = Summed::of(design, components)?;
    for (i, group) in design.groups().iter().enumerate() {
        let (behind, least) = (summed.blocks(i) as u64, SobolIndices::MIN_BLOCKS as u64);
        check_range("blocks without a failure", behind, least, u64::MAX).map_err(|source| {
            SensitivityError::InvalidInput { name: group.name.clone(), source: Box::new(source) }
        })?;
    }
    let (variance, estimates) = summed.estimates(bootstrap, level)?;
    let k = design.groups().len();
    let name = |i: usize| design.groups()[i].name.clone();
    let outputs = components[0];
    let (of_inputs, of_pairs) = estimates.split_at(2 * k);
    let input = |i| SobolIndex {
        input: name(i),
        blocks: summed.blocks(i),
        first: of_inputs[i],
        total: of_inputs[k + i],
    };
    let pair = |((i, j), &second)| PairIndex { inputs: [name(i), name(j)], second };
    let is_reliable = |i| summed.blocks(i) >= SobolIndices::RELIABLE_BLOCKS;
    Ok(SobolIndices {
        blocks: design.blocks(),
        failed_blocks: outputs.chunks(design.block_points()).filter(|block| block.contains(&None)).count(),
        failed: outputs.iter().filter(|output| output.is_none()).count(),
        variance,
        level,
        reliable: design.is_scrambled() && (0..k).all(is_reliable),
        inputs: (0..k).map(input).collect(),
        pairs: pairs(k).zip(of_pairs).map(pair).collect(),
    })
}

/// Whether a block belongs to the sequence of the estimate.
fn is_of_estimate(design: &SaltelliDesign, number: usize) -> bool {
    !design.is_scrambled() || design.replicate_of(number).is_none()
}

/// Refuses outputs of which no component varies.
fn check_components(design: &SaltelliDesign, components: &[&[Option<f64>]]) -> Result<(), SensitivityError> {
    let size = design.block_points();
    let varies = |outputs: &&[Option<f64>]| {
        let ends = (0..design.blocks()).filter(|number| is_of_estimate(design, *number));
        let ends = ends.flat_map(|number| [outputs[number * size], outputs[(number + 1) * size - 1]]);
        let ends: Vec<f64> = ends.flatten().collect();
        check_range("observed outputs", ends.len() as u64, 2, u64::MAX)?;
        check_varies(&ends)
    };
    let checks: Vec<Result<(), SensitivityError>> = components.iter().map(varies).collect();
    match checks.iter().find(|check| check.is_ok()).or(checks.first()) {
        Some(Err(error)) => Err(error.clone()),
        _ => Ok(()),
    }
}

/// Sums of the estimate and of the units that show its error: the replicates, or single blocks.
struct Summed {
    is_scrambled: bool,
    estimate: Sums,
    units: Vec<Sums>,
    /// All units together.
    pool: Sums,
}

impl Summed {
    fn of(design: &SaltelliDesign, components: &[&[Option<f64>]]) -> Result<Self, SensitivityError> {
        let mean = |outputs: &&[Option<f64>]| {
            let observed = outputs.iter().flatten();
            observed.clone().sum::<f64>() / observed.count() as f64
        };
        let means: Vec<f64> = components.iter().map(mean).collect();
        let lines = Lines::of(design, components)?;
        let (size, is_scrambled) = (design.block_points(), design.is_scrambled());
        let (mut estimate, mut pool) = (Sums::default(), Sums::default());
        let mut units: BTreeMap<usize, Sums> = BTreeMap::new();
        for number in 0..design.blocks() {
            let mut terms = Sums::of(components.len());
            for (component, (outputs, mean)) in components.iter().zip(&means).enumerate() {
                let block = &outputs[number * size..(number + 1) * size];
                terms.observe(block, *mean, component, design, lines.at(number, component));
            }
            if is_of_estimate(design, number) {
                estimate.add(1, &terms);
            }
            let unit = if is_scrambled { design.replicate_of(number) } else { Some(number) };
            if let Some(unit) = unit {
                units.entry(unit).or_default().add(1, &terms);
            }
        }
        let units: Vec<Sums> = units.into_values().collect();
        units.iter().for_each(|unit| pool.add(1, unit));
        Ok(Self { is_scrambled, estimate, units, pool })
    }

    /// [`SobolIndex::blocks`] of input or group i.
    fn blocks(&self, i: usize) -> usize {
        let of_estimate = self.estimate.count(i);
        if self.is_scrambled { 2 * of_estimate.min(self.pool.count(i)) } else { of_estimate }
    }

    /// V, and the indices with their intervals (Si5).
    fn estimates(&self, bootstrap: Bootstrap, level: f64) -> Result<(f64, Vec<Estimate>), SensitivityError> {
        let units = &self.units;
        let ((variance, values), (_, pooled)) = (self.estimate.quotients(), self.pool.quotients());
        let resampled: Vec<Vec<f64>> = (0..bootstrap.resamples)
            .into_par_iter()
            .map(|resample| {
                let mut sums = Sums::default();
                for (unit, times) in units.iter().zip(multiplicities(units.len(), bootstrap.seed, resample)) {
                    sums.add(times, unit);
                }
                sums.quotients()
            })
            // Drawn units whose outputs a and b are constant up to rounding have no indices.
            .filter(|(resampled, _)| *resampled > 1e-12 * variance)
            .map(|(_, indices)| indices)
            .collect();
        check_range("resamples with a variance", resampled.len() as u64, 2, u64::MAX)?;
        let interval = |(index, &value): (usize, &f64)| {
            let of_index = resampled.iter().map(|indices| indices[index]);
            let of_resamples: Vec<f64> = of_index.filter(|value| value.is_finite()).collect();
            let resolution = 1.0 / self.estimate.count(index) as f64;
            let bias = (value - pooled[index]).powi(2) / SaltelliDesign::REPLICATES as f64;
            Ok(Estimate::of_resamples(value, &of_resamples, bias, units.len(), level)?.at_least(resolution))
        };
        let estimates = values.par_iter().enumerate().map(interval).collect::<Result<_, _>>()?;
        Ok((variance, estimates))
    }
}

/// Number of times that each of n units occurs in n random draws.
fn multiplicities(n: usize, seed: u64, resample: usize) -> Vec<u32> {
    let mut generator = stream(seed, resample as u64);
    let mut multiplicities = vec![0; n];
    for _ in 0..n {
        multiplicities[generator.random_range(0..n)] += 1;
    }
    multiplicities
}
