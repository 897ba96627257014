//! Designs of experiments. A design is a type, and an estimator takes that type: see [`SampleDesign`].
//!
//! Any row is had from its index alone, so that a map over the rows gives the same numbers on one thread and on many.

pub mod correlated;
pub mod halton;
pub mod input;
pub mod latin_hypercube;
pub mod morris;
pub(crate) mod observation;
pub(crate) mod random;
pub mod saltelli;
pub mod sobol;

use crate::design::input::{Input, Prepared};
use crate::error::{SensitivityError, check_length, check_range};

/// Points to run a model at, of any structure. Rows may be drawn from any thread.
///
/// What an estimator may conclude from them it asks for by type: [`IndependentSample`], [`JointSample`], or a design of
/// its own such as [`crate::SaltelliDesign`].
pub trait SampleDesign: Sized + Sync {
    /// Inputs, one a column.
    fn inputs(&self) -> &[Input];

    /// Number of rows.
    fn points(&self) -> usize;

    /// Seed of the randomisation, `None` for a deterministic design.
    fn seed(&self) -> Option<u64>;

    /// A design of the same inputs and size under a randomisation of its own. Different seeds give independent ones.
    #[must_use]
    fn replicate(&self, seed: u64) -> Self;

    /// Writes observation `index` as a point of the unit cube: for each input, the probability of its value.
    ///
    /// # Errors
    /// [`SensitivityError::OutOfRange`] for an index beyond the last row, [`SensitivityError::LengthMismatch`] for a
    /// point that has not one element an input.
    fn unit_point(&self, index: usize, point: &mut [f64]) -> Result<(), SensitivityError>;

    /// Writes the values of the inputs of observation `index` into `row`.
    ///
    /// # Errors
    /// As [`SampleDesign::unit_point`].
    fn row(&self, index: usize, row: &mut [f64]) -> Result<(), SensitivityError> {
        self.unit_point(index, row)?;
        for (value, input) in row.iter_mut().zip(self.inputs()) {
            *value = input.value(*value);
        }
        Ok(())
    }

    /// Writes consecutive points of the unit cube into `points`, one after the other, from that of observation `first` on.
    ///
    /// # Errors
    /// As [`SampleDesign::unit_point`], and [`SensitivityError::LengthMismatch`] unless `points` holds whole points.
    fn unit_points(&self, first: usize, points: &mut [f64]) -> Result<(), SensitivityError> {
        for (index, point) in (first..).zip(points.chunks_mut(self.inputs().len())) {
            self.unit_point(index, point)?;
        }
        Ok(())
    }

    /// Writes consecutive rows from that of observation `first` on into `rows`, one after the other: those of
    /// [`SampleDesign::row`], but faster.
    ///
    /// # Errors
    /// As [`SampleDesign::unit_points`].
    fn rows(&self, first: usize, rows: &mut [f64]) -> Result<(), SensitivityError> {
        self.unit_points(first, rows)?;
        let inputs: Vec<Prepared> = self.inputs().iter().map(Input::prepare).collect();
        for row in rows.chunks_exact_mut(inputs.len()) {
            for (value, input) in row.iter_mut().zip(&inputs) {
                *value = input.value(*value);
            }
        }
        Ok(())
    }
}

/// A design whose rows are a sample of the joint law of its inputs: regression asks for no more.
pub trait JointSample: SampleDesign {}

/// A [`JointSample`] of independent inputs: what effects, chaos expansions and derivative-based measures rely on.
pub trait IndependentSample: JointSample {}

pub(crate) fn check_row(
    design: &impl SampleDesign,
    index: usize,
    row: &[f64],
) -> Result<(), SensitivityError> {
    check_range("index", index as u64, 0, design.points() as u64 - 1)?;
    check_length("row", row.len(), design.inputs().len())
}

/// Consecutive indices of a sequence of 2^32 points.
pub(crate) fn check_points(first_index: u32, points: usize) -> Result<(), SensitivityError> {
    check_range("points", points as u64, 1, (1_u64 << 32) - u64::from(first_index))
}

/// Point 0 of an unscrambled sequence is all zeros.
pub(crate) fn check_origin(inputs: &[Input], first_index: u32) -> Result<(), SensitivityError> {
    match inputs.iter().find(|input| input.law.support().0 == f64::NEG_INFINITY) {
        Some(input) if first_index == 0 => {
            Err(SensitivityError::UnboundedAtZero { name: input.name.clone() })
        }
        _ => Ok(()),
    }
}
