//! Observations: the output of perturbed robots.
//!
//! One observation perturbs all parameters of the robot; the inverse model runs on the *perturbed* robot at
//! the wanted pose; its tensions are offset by dt_i and the unstrained lengths computed for the offset
//! tensions; the direct model runs on the perturbed robot with those lengths, under its own weight and with
//! the payload added; dp is the difference (Eq. (4)). Other outputs are of the same chain, except the
//! position ([`crate::Output`]).
//!
//! Observations are made in blocks of consecutive indices, which a [`Session`] may keep on disk, and blocks
//! in parts, one for each thread. Only the sums of a part stay in memory; they are merged in the order of the
//! indices. Memory does not grow with the observations, and the numbers depend neither on the threads nor on
//! the blocks that existed before.

use crate::error::StudyError;
use crate::file::output::{Output, Recorded};
use crate::model::designs::{OWN, Points, replicate_name};
use crate::model::observed::{Failure, Measured, Observed, ScalarCount, count_failed, failures, value_of};
use crate::model::study::Sampling;
use crate::store::block::{BLOCK, blocks};
use crate::store::blocks::{BlockId, Blocks};
use cdpr_sensitivity::{EffectSums, SampleDesign};
use rayon::prelude::*;
use std::collections::BTreeMap;
use std::ops::Range;

/// Observations of a part of a block.
const PART: usize = 256;

/// Number of outputs, from the first on, that are kept for quantiles and histogram.
pub const KEPT: usize = 1 << 16;

/// Number of outputs, from the first on, to which laws are fitted; each resample of the bootstrap has as
/// many.
pub const FITTED: usize = 1 << 13;

/// Consecutive observations with their inputs.
#[derive(Clone, Debug, PartialEq)]
pub struct Part {
    /// Index of the first one.
    pub first: usize,
    /// Values of the inputs of each observation, one after the other.
    pub rows: Vec<f64>,
    /// Result of each observation.
    pub outcomes: Vec<Observed>,
    /// What is observed.
    pub output: Output,
}

/// A design to be observed.
#[derive(Clone, Copy)]
pub(crate) struct Task<'a> {
    /// Name of its blocks.
    pub(crate) name: &'a str,
    pub(crate) points: &'a dyn Points,
    /// What is kept of an observation.
    pub(crate) recorded: Recorded,
}

/// Where observations are kept, and who is notified of them.
#[derive(Clone, Copy)]
pub struct Session<'a> {
    /// Blocks on disk: existing ones are not made again, new ones are kept. `None` keeps nothing.
    pub blocks: Option<&'a Blocks>,
    /// Called with the number of new observations.
    pub tick: &'a (dyn Fn(usize) + Sync),
    /// Called for each damaged block, which is made again.
    pub warn: &'a (dyn Fn(&StudyError) + Sync),
    /// Called before each block; true ends the run.
    pub stop: &'a (dyn Fn() -> bool + Sync),
}

impl Session<'static> {
    /// A session that keeps nothing and notifies nobody.
    pub fn in_memory() -> Self {
        Self { blocks: None, tick: &|_| (), warn: &|_| (), stop: &|| false }
    }
}

/// The sums over all observations of a sampling.
#[derive(Clone, Debug, PartialEq)]
pub struct Tally {
    /// Sums behind moments and effects of the output in its unit.
    pub sums: EffectSums,
    /// Number of failed observations by kind of failure; the usual kinds are always listed.
    pub failed: BTreeMap<String, usize>,
    /// Observations of the scalar models.
    pub scalar: ScalarCount,
    /// Output of the first [`KEPT`] observations, `None` where one failed.
    pub first_values: Vec<Option<f64>>,
    /// Least and greatest output; `None` where all observations failed.
    range: Option<[f64; 2]>,
    /// The same without observations of the nominal robot, such as the middle of Sobol's sequence.
    range_of_others: Option<[f64; 2]>,
}

/// The range of the values of two ranges.
fn joined(one: Option<[f64; 2]>, other: Option<[f64; 2]>) -> Option<[f64; 2]> {
    one.into_iter().chain(other).reduce(|[a, b], [c, d]| [a.min(c), b.max(d)])
}

impl Tally {
    fn new(sampling: &Sampling) -> Self {
        Self {
            sums: EffectSums::new(sampling.design.inputs(), sampling.nominal_value),
            failed: count_failed(std::iter::empty()),
            scalar: ScalarCount::default(),
            first_values: Vec::new(),
            range: None,
            range_of_others: None,
        }
    }

    /// Least and greatest output of the observations: of robots that differ from the nominal one, if any do.
    pub fn range(&self) -> Option<[f64; 2]> {
        self.range_of_others.or(self.range)
    }

    fn of_part(sampling: &Sampling, part: &Part) -> Self {
        /// An input that is smaller than this share of its standard deviation is rounding.
        const ROUNDING: f64 = 1e-9;
        let mut tally = Self::new(sampling);
        let inputs = sampling.design.inputs().len();
        let least: Vec<f64> = sampling.design.inputs().iter().map(|input| ROUNDING * input.std()).collect();
        for (outcome, row) in part.outcomes.iter().zip(part.rows.chunks_exact(inputs)) {
            let value = value_of(outcome);
            tally.sums.add(row, value);
            tally.first_values.push(value);
            let of_value = value.map(|value| [value; 2]);
            tally.range = joined(tally.range, of_value);
            if row.iter().zip(&least).any(|(input, least)| input.abs() > *least) {
                tally.range_of_others = joined(tally.range_of_others, of_value);
            }
        }
        tally.failed = count_failed(failures(&part.outcomes));
        tally.scalar = ScalarCount::of(&part.outcomes);
        tally
    }

    /// Adds the observations that follow.
    fn merge(&mut self, next: &Self) {
        self.sums.merge(&next.sums);
        for (kind, count) in &next.failed {
            *self.failed.entry(kind.clone()).or_default() += count;
        }
        self.scalar.merge(&next.scalar);
        let room = KEPT.saturating_sub(self.first_values.len()).min(next.first_values.len());
        self.first_values.extend_from_slice(&next.first_values[..room]);
        self.range = joined(self.range, next.range);
        self.range_of_others = joined(self.range_of_others, next.range_of_others);
    }
}

/// Makes all observations of a sampling in parallel.
///
/// # Errors
/// Those of the session's blocks, and [`StudyError::Stopped`]; a session in memory has no others.
pub fn observe(sampling: &Sampling, session: &Session) -> Result<Tally, StudyError> {
    observe_into(sampling, session, |_| (), |()| Ok(()))
}

/// The same. `each` runs on every part in parallel, and its results go to `sink` in the order of the indices.
/// Ends if `sink` fails.
///
/// # Errors
/// As [`observe`], and that of `sink`.
pub fn observe_into<T: Send>(
    sampling: &Sampling,
    session: &Session,
    each: impl Fn(&Part) -> T + Sync,
    mut sink: impl FnMut(T) -> Result<(), StudyError>,
) -> Result<Tally, StudyError> {
    let mut whole = Tally::new(sampling);
    let own = sampling.own().map_err(|source| {
        sampling.study.statistics(format!("samplings.{}.correlations", sampling.name), source)
    })?;
    observe_design(
        sampling,
        Task { name: OWN, points: own.as_ref(), recorded: Recorded::Output },
        session,
        |part| (Tally::of_part(sampling, part), each(part)),
        |(tally, made)| {
            whole.merge(&tally);
            sink(made)
        },
    )?;
    Ok(whole)
}

/// [`observe`] for a scrambled replicate of the sampling's design, by its number from 1.
///
/// # Errors
/// As [`observe`].
pub fn observe_replicate(sampling: &Sampling, number: usize, session: &Session) -> Result<Tally, StudyError> {
    let (name, points) = (&replicate_name(number), &sampling.replicate(number));
    observe_tally(sampling, Task { name, points, recorded: Recorded::Output }, session)
}

/// [`observe`] for another design over the same inputs.
fn observe_tally(sampling: &Sampling, design: Task, session: &Session) -> Result<Tally, StudyError> {
    let mut whole = Tally::new(sampling);
    let each = |part: &Part| Tally::of_part(sampling, part);
    observe_design(sampling, design, session, each, |tally| {
        whole.merge(&tally);
        Ok(())
    })?;
    Ok(whole)
}

/// What is observed at each row of a design over the inputs of the sampling, `None` where it fails.
pub(crate) fn observe_quantities(
    sampling: &Sampling,
    design: Task,
    session: &Session,
) -> Result<Vec<Option<Measured>>, StudyError> {
    let mut all = Vec::with_capacity(design.points.size());
    let each = |part: &Part| part.outcomes.iter().map(|of| of.as_ref().ok().cloned()).collect::<Vec<_>>();
    observe_design(sampling, design, session, each, |values| {
        all.extend(values);
        Ok(())
    })?;
    Ok(all)
}

/// The result of `observed` for each of these rows of a design, computed in parallel for some consecutive
/// rows at a time, in the order of the rows.
pub fn observe_rows<T: Send>(
    design: &impl SampleDesign,
    rows: Range<usize>,
    observed: impl Fn(&mut [f64]) -> Vec<T> + Sync,
) -> Vec<T> {
    let parts: Vec<usize> = rows.clone().step_by(PART).collect();
    let of_part = |first: usize| observed(&mut draw(design, first..rows.end.min(first + PART)));
    parts.into_par_iter().flat_map_iter(of_part).collect()
}

fn observe_design<T: Send>(
    sampling: &Sampling,
    design: Task,
    session: &Session,
    each: impl Fn(&Part) -> T + Sync,
    mut sink: impl FnMut(T) -> Result<(), StudyError>,
) -> Result<(), StudyError> {
    for (number, range) in blocks(design.points.size()) {
        let made = observe_block(sampling, design, (number, range), session, &each)?;
        made.into_iter().try_for_each(&mut sink)?;
    }
    Ok(())
}

/// The results of `each` for the parts of a block. Observations on disk are read; if others have to be made,
/// the block is written.
pub(crate) fn observe_block<T: Send>(
    sampling: &Sampling,
    design: Task,
    (number, range): (usize, Range<usize>),
    session: &Session,
    each: &(impl Fn(&Part) -> T + Sync),
) -> Result<Vec<T>, StudyError> {
    debug_assert!(range.len() <= BLOCK);
    if (session.stop)() {
        return Err(StudyError::Stopped);
    }
    let id = BlockId { sampling: &sampling.name, design: design.name, number, recorded: design.recorded };
    let known = match session.blocks {
        Some(blocks) => blocks.known(&id, session.warn)?,
        None => Vec::new(),
    };
    let known = &known[..known.len().min(range.len())];
    let parts: Vec<usize> = range.clone().step_by(PART).collect();
    let observed = |first: usize| {
        let part = first..range.end.min(first + PART);
        let known = &known[known.len().min(first - range.start)..known.len().min(part.end - range.start)];
        let part = observe_part(sampling, design, part, known);
        (session.tick)(part.outcomes.len());
        (each(&part), part.outcomes)
    };
    let (made, outcomes): (Vec<T>, Vec<Vec<Observed>>) = parts.into_par_iter().map(observed).unzip();
    if let Some(blocks) = session.blocks.filter(|_| known.len() < range.len()) {
        blocks.write(&id, &outcomes.concat())?;
    }
    Ok(made)
}

/// A part of a design, whose first observations may be known already.
fn observe_part(sampling: &Sampling, design: Task, range: Range<usize>, known: &[Observed]) -> Part {
    let rows = draw(design.points, range.clone());
    let unknown = &rows[known.len() * sampling.errors.inputs.len()..];
    let observed = sampling.observer.observe_inputs(&sampling.errors, unknown, design.recorded);
    let observed = observed.into_iter().map(|outcome| outcome.map_err(Failure::from));
    let outcomes = known.iter().cloned().chain(observed).collect();
    Part { first: range.start, rows, outcomes, output: sampling.output() }
}

pub(crate) fn draw(design: &dyn Points, range: Range<usize>) -> Vec<f64> {
    let mut rows = vec![0.0; range.len() * design.columns()];
    design.fill(range.start, &mut rows);
    rows
}
