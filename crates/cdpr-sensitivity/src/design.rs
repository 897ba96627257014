//! Designs of experiments: at which points a model is run.
//!
//! A design is a type, and an estimator asks for the type that it can interpret: see [`SampleDesign`]. A row
//! follows from its index alone, so that a parallel map over the rows gives the same numbers on any number of
//! threads.

pub mod correlated;
pub mod group;
pub mod halton;
pub mod input;
pub mod latin_hypercube;
pub mod morris;
pub(crate) mod observation;
pub(crate) mod random;
pub mod saltelli;
pub mod shapley;
pub mod sobol;

use crate::design::input::{Input, Prepared};
use crate::error::{SensitivityError, check_length, check_range};

/// Version of the points of all designs. It rises where the same arguments give other points, so that rows
/// that were observed before are not continued by others.
pub const POINTS_VERSION: u32 = 2;

/// What every design has: its inputs, its size and the seed of its randomization.
#[derive(Debug, Clone, PartialEq)]
pub struct Layout {
    /// Inputs, one per column.
    pub inputs: Vec<Input>,
    /// Number of rows, at least 1.
    pub points: usize,
    /// Seed of the randomization, `None` for a deterministic design.
    pub seed: Option<u64>,
}

impl Layout {
    /// Checks the inputs one by one, and that there is at least one input and one row.
    pub(crate) fn new(
        inputs: Vec<Input>,
        points: usize,
        seed: Option<u64>,
    ) -> Result<Self, SensitivityError> {
        inputs.iter().try_for_each(Input::validate)?;
        check_range("inputs", inputs.len() as u64, 1, u64::MAX)?;
        check_range("points", points as u64, 1, u64::MAX)?;
        Ok(Self { inputs, points, seed })
    }

    /// The same layout under another seed.
    pub(crate) fn reseeded(&self, seed: u64) -> Self {
        Self { seed: Some(seed), ..self.clone() }
    }
}

/// Points at which a model is run. Rows may be drawn from any thread.
///
/// The structure of the points decides which estimators apply. An estimator therefore asks for a type:
/// [`IndependentSample`], [`JointSample`], or a design of its own such as [`crate::SaltelliDesign`].
pub trait SampleDesign: Sized + Sync {
    /// Inputs, size and seed.
    fn layout(&self) -> &Layout;

    /// Inputs, one per column.
    fn inputs(&self) -> &[Input] {
        &self.layout().inputs
    }

    /// Number of rows.
    fn points(&self) -> usize {
        self.layout().points
    }

    /// Seed of the randomization, `None` for a deterministic design.
    fn seed(&self) -> Option<u64> {
        self.layout().seed
    }

    /// Returns a design of the same inputs and size under the randomization of `seed`. Designs of different
    /// seeds are independent of each other.
    #[must_use]
    fn replicate(&self, seed: u64) -> Self;

    /// Writes row `index` as a point of the unit cube: for each input, the probability of its value.
    ///
    /// # Errors
    /// [`SensitivityError::OutOfRange`] for an index beyond the last row,
    /// [`SensitivityError::LengthMismatch`] unless `point` has one element per input.
    fn unit_point(&self, index: usize, point: &mut [f64]) -> Result<(), SensitivityError>;

    /// Writes the values of the inputs in row `index` into `row`.
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

    /// Writes consecutive points of the unit cube into `points`, one after the other, starting with row
    /// `first`.
    ///
    /// # Errors
    /// As [`SampleDesign::unit_point`], and [`SensitivityError::LengthMismatch`] unless `points` holds whole
    /// points.
    fn unit_points(&self, first: usize, points: &mut [f64]) -> Result<(), SensitivityError> {
        for (index, point) in (first..).zip(points.chunks_mut(self.inputs().len())) {
            self.unit_point(index, point)?;
        }
        Ok(())
    }

    /// Writes consecutive rows into `rows`, one after the other, starting with row `first`. They are those of
    /// [`SampleDesign::row`], but computed faster.
    ///
    /// # Errors
    /// As [`SampleDesign::unit_points`].
    fn rows(&self, first: usize, rows: &mut [f64]) -> Result<(), SensitivityError> {
        self.unit_points(first, rows)?;
        to_values(self.inputs(), rows);
        Ok(())
    }
}

/// Makes values of the inputs from points of the unit cube.
pub(crate) fn to_values(inputs: &[Input], points: &mut [f64]) {
    let inputs: Vec<Prepared> = inputs.iter().map(Input::prepare).collect();
    for point in points.chunks_exact_mut(inputs.len()) {
        for (value, input) in point.iter_mut().zip(&inputs) {
            *value = input.value(*value);
        }
    }
}

/// A design whose rows are a sample of the joint law of its inputs. Regression needs no more.
pub trait JointSample: SampleDesign {}

/// A [`JointSample`] of independent inputs. Effects, chaos expansions and derivative-based measures rely on
/// it.
pub trait IndependentSample: JointSample {}

/// Checks an index and the length of a row against a design.
pub(crate) fn check_row(
    design: &impl SampleDesign,
    index: usize,
    row: &[f64],
) -> Result<(), SensitivityError> {
    check_range("index", index as u64, 0, design.points() as u64 - 1)?;
    check_length("row", row.len(), design.inputs().len())
}

/// Checks that consecutive rows from `first` on are whole ones of a design.
pub(crate) fn check_rows(
    design: &impl SampleDesign,
    first: usize,
    rows: &[f64],
) -> Result<(), SensitivityError> {
    let width = design.inputs().len();
    check_length("rows", rows.len(), rows.len().next_multiple_of(width))?;
    let last = (first + rows.len() / width).saturating_sub(1);
    check_range("index", first.max(last) as u64, 0, design.points() as u64 - 1)
}

/// Checks that consecutive points lie within a sequence of 2^32 points.
pub(crate) fn check_points(first_index: u32, points: usize) -> Result<(), SensitivityError> {
    check_range("points", points as u64, 1, (1_u64 << 32) - u64::from(first_index))
}

/// Checks that point 0 of an unscrambled sequence, which is all zeros, is not used for a law that is infinite
/// there.
pub(crate) fn check_origin(inputs: &[Input], first_index: u32) -> Result<(), SensitivityError> {
    match inputs.iter().find(|input| input.law.support().min == f64::NEG_INFINITY) {
        Some(input) if first_index == 0 => {
            Err(SensitivityError::UnboundedAtZero { name: input.name.clone() })
        }
        _ => Ok(()),
    }
}
