//! Observations: the deflection of perturbed robots.
//!
//! One observation perturbs all parameters of the robot; the inverse model runs on the *perturbed* robot at the wanted pose;
//! its tensions are offset by dt_i and the unstrained lengths computed for the offset tensions; the direct model runs on the
//! perturbed robot with those lengths, under its own weight and with the payload added; dp is the difference (Eq. (4)).
//!
//! Observations are made in blocks of consecutive indices. What is kept of a block are sums, which are merged in the order of the
//! indices: memory does not grow with the observations, and the numbers do not depend on the threads.

use crate::study::Sampling;
use cdpr_sensitivity::{EffectSums, SampleDesign, SobolDesign};
use cdpr_statics::{Observation, StaticsError};
use rayon::prelude::*;
use std::collections::BTreeMap;
use std::ops::Range;

/// Observations of a block.
const BLOCK: usize = 256;

/// Blocks under way at a time.
const WAVE: usize = 64;

/// Outputs that are kept for quantiles and histogram: the first ones.
pub const KEPT: usize = 1 << 16;

/// Outputs that laws are fitted to, the first ones: each of the bootstrap's resamples is as long.
pub const FITTED: usize = 1 << 13;

/// Consecutive observations.
#[derive(Clone, Debug, PartialEq)]
pub struct Block {
    /// Index of the first one.
    pub first: usize,
    /// Values of the inputs of each observation, one after the other.
    pub rows: Vec<f64>,
    /// For each observation what was observed, or why nothing was.
    pub outcomes: Vec<Result<Observation, StaticsError>>,
}

/// What all observations of a sampling add up to.
#[derive(Clone, Debug, PartialEq)]
pub struct Tally {
    /// Sums behind moments and effects of the RMS [mm].
    pub sums: EffectSums,
    /// Number of failed observations by kind of failure; the usual kinds are always listed.
    pub failed: BTreeMap<String, usize>,
    /// RMS [mm] of the first [`KEPT`] observations, `None` where one failed.
    pub first_rms_mm: Vec<Option<f64>>,
}

impl Tally {
    fn new(sampling: &Sampling) -> Self {
        Self {
            sums: EffectSums::new(sampling.design.inputs(), rms_mm(sampling.nominal.rms())),
            failed: count_failed(std::iter::empty()),
            first_rms_mm: Vec::new(),
        }
    }

    fn of_block(sampling: &Sampling, block: &Block) -> Self {
        let mut tally = Self::new(sampling);
        let inputs = sampling.design.inputs().len();
        for (outcome, row) in block.outcomes.iter().zip(block.rows.chunks_exact(inputs)) {
            let rms = outcome.as_ref().ok().map(|observation| rms_mm(observation.rms()));
            tally.sums.add(row, rms);
            tally.first_rms_mm.push(rms);
        }
        tally.failed = count_failed(block.outcomes.iter().filter_map(|outcome| outcome.as_ref().err()));
        tally
    }

    /// Adds the observations that follow.
    fn merge(&mut self, next: &Self) {
        self.sums.merge(&next.sums);
        for (kind, count) in &next.failed {
            *self.failed.entry(kind.clone()).or_default() += count;
        }
        let room = KEPT.saturating_sub(self.first_rms_mm.len()).min(next.first_rms_mm.len());
        self.first_rms_mm.extend_from_slice(&next.first_rms_mm[..room]);
    }
}

/// RMS in the unit of tables and figures.
pub(crate) fn rms_mm(rms: f64) -> f64 {
    1e3 * rms
}

/// Failures by kind; the usual kinds are always listed.
pub(crate) fn count_failed<'a>(errors: impl Iterator<Item = &'a StaticsError>) -> BTreeMap<String, usize> {
    let usual = ["infeasible_tension", "inverse_not_converged", "direct_not_converged"];
    let mut failed: BTreeMap<String, usize> = usual.map(|kind| (kind.to_owned(), 0)).into();
    for error in errors {
        *failed.entry(error.kind().to_owned()).or_default() += 1;
    }
    failed
}

/// Makes all observations of a sampling in parallel; `tick` is told how many more are done.
pub fn observe(sampling: &Sampling, tick: &(dyn Fn(usize) + Sync)) -> Tally {
    observe_design(sampling, &sampling.design, tick)
}

/// The same, and hands every block to `sink` in the order of the indices. Ends where `sink` fails.
///
/// # Errors
/// That of `sink`.
pub fn observe_into<E>(
    sampling: &Sampling,
    tick: &(dyn Fn(usize) + Sync),
    mut sink: impl FnMut(&Block) -> Result<(), E>,
) -> Result<Tally, E> {
    let mut whole = Tally::new(sampling);
    for wave in waves(sampling.design.points()) {
        let blocks: Vec<(Block, Tally)> = wave
            .into_par_iter()
            .map(|range| {
                let block = observe_block(sampling, &sampling.design, range, tick);
                let tally = Tally::of_block(sampling, &block);
                (block, tally)
            })
            .collect();
        for (block, tally) in &blocks {
            sink(block)?;
            whole.merge(tally);
        }
    }
    Ok(whole)
}

/// [`observe`] for another design over the same inputs.
pub(crate) fn observe_design(
    sampling: &Sampling,
    design: &SobolDesign,
    tick: &(dyn Fn(usize) + Sync),
) -> Tally {
    let mut whole = Tally::new(sampling);
    for wave in waves(design.points()) {
        let tallies: Vec<Tally> = wave
            .into_par_iter()
            .map(|range| Tally::of_block(sampling, &observe_block(sampling, design, range, tick)))
            .collect();
        tallies.iter().for_each(|tally| whole.merge(tally));
    }
    whole
}

/// RMS [mm] of each observation of a design over the inputs of the sampling, `None` where it fails.
pub(crate) fn observe_rms<D: SampleDesign>(
    sampling: &Sampling,
    design: &D,
    tick: &(dyn Fn(usize) + Sync),
) -> Vec<Option<f64>> {
    let rms_of = |rows: &mut [f64]| {
        let outcomes = sampling.observer.observe_all(&sampling.errors.deviations(rows));
        tick(outcomes.len());
        let rms = |outcome: Result<Observation, _>| outcome.ok().map(|found| rms_mm(found.rms()));
        outcomes.into_iter().map(rms).collect()
    };
    observe_rows(design, rms_of)
}

/// What `observed` says of each row of a design, in parallel and in the order of the rows, from some rows at a time that follow one another.
pub(crate) fn observe_rows<D: SampleDesign, T: Send>(
    design: &D,
    observed: impl Fn(&mut [f64]) -> Vec<T> + Sync,
) -> Vec<T> {
    let points = design.points();
    let of_block = |block: usize| {
        let range = block * BLOCK..points.min((block + 1) * BLOCK);
        observed(&mut draw(design, range))
    };
    (0..points.div_ceil(BLOCK)).into_par_iter().flat_map_iter(of_block).collect()
}

/// The indices of all blocks, as many at a time as are under way together.
fn waves(points: usize) -> impl Iterator<Item = Vec<Range<usize>>> {
    let blocks = move |wave: usize| {
        (wave..points.min(wave + WAVE * BLOCK))
            .step_by(BLOCK)
            .map(move |first| first..points.min(first + BLOCK))
    };
    (0..points).step_by(WAVE * BLOCK).map(move |wave| blocks(wave).collect())
}

fn observe_block(
    sampling: &Sampling,
    design: &impl SampleDesign,
    range: Range<usize>,
    tick: &(dyn Fn(usize) + Sync),
) -> Block {
    let rows = draw(design, range.clone());
    let deviations = sampling.errors.deviations(&rows);
    let outcomes = sampling.observer.observe_all(&deviations);
    tick(range.len());
    Block { first: range.start, rows, outcomes }
}

fn draw(design: &impl SampleDesign, range: Range<usize>) -> Vec<f64> {
    let mut rows = vec![0.0; range.len() * design.inputs().len()];
    // The range is one of the design, and the rows are whole.
    let drawn = design.rows(range.start, &mut rows);
    debug_assert_eq!(drawn, Ok(()));
    rows
}
