//! Designs of experiments. A design is a type, and an estimator takes that type: see [`SampleDesign`].
//!
//! Any row is had from its index alone, so that a map over the rows gives the same numbers on one thread and on many.

use rand::{Rng, SeedableRng};
use rand_chacha::ChaCha8Rng;

use crate::error::SensitivityError;
use crate::input::{Input, Prepared};
use crate::sobol::Sobol;

/// A design whose rows are a sample of the joint law of independent inputs: that is what the estimators of
/// [`crate::effect`] rely on. A design of another structure is another type, with estimators of its own. Rows may be
/// drawn from any thread.
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

    /// Writes the values of the inputs of observation `index` into `row`.
    ///
    /// # Errors
    /// [`SensitivityError::OutOfRange`] for an index beyond the last row, [`SensitivityError::LengthMismatch`] for a
    /// row that has not one element an input.
    fn row(&self, index: usize, row: &mut [f64]) -> Result<(), SensitivityError>;

    /// Writes consecutive rows from that of observation `first` on into `rows`, one after the other.
    ///
    /// # Errors
    /// As [`SampleDesign::row`], and [`SensitivityError::LengthMismatch`] unless `rows` holds whole rows.
    fn rows(&self, first: usize, rows: &mut [f64]) -> Result<(), SensitivityError> {
        for (index, row) in (first..).zip(rows.chunks_mut(self.inputs().len())) {
            self.row(index, row)?;
        }
        Ok(())
    }
}

/// Consecutive points of Sobol's sequence, plain or scrambled. Sizes of 2^k, from index 0, keep its balance.
#[derive(Debug, Clone)]
pub struct SobolDesign {
    inputs: Vec<Input>,
    prepared: Vec<Prepared>,
    sobol: Sobol,
    first_index: u32,
    points: usize,
}

impl SobolDesign {
    /// Points `first_index` to `first_index + points - 1` of the plain sequence.
    ///
    /// # Errors
    /// - [`SensitivityError::InvalidInput`] for an input that is not valid;
    /// - [`SensitivityError::OutOfRange`] for no input or too many, no point, or points beyond 2^32;
    /// - [`SensitivityError::UnboundedAtZero`] if point 0 is among them and the law of an input has no lower end.
    pub fn new(inputs: Vec<Input>, first_index: u32, points: usize) -> Result<Self, SensitivityError> {
        let unbounded = inputs.iter().find(|input| input.law.support().0 == f64::NEG_INFINITY);
        if let (0, Some(input)) = (first_index, unbounded) {
            return Err(SensitivityError::UnboundedAtZero { name: input.name.clone() });
        }
        let sobol = Sobol::new(inputs.len())?;
        Self::over(sobol, inputs, first_index, points)
    }

    /// The first points of the sequence under Owen's scrambling.
    ///
    /// # Errors
    /// As [`SobolDesign::new`], but point 0 may be among the points: it is not zero.
    pub fn scrambled(inputs: Vec<Input>, points: usize, seed: u64) -> Result<Self, SensitivityError> {
        let sobol = Sobol::scrambled(inputs.len(), seed)?;
        Self::over(sobol, inputs, 0, points)
    }

    /// Index in the sequence of the first row.
    #[must_use]
    pub fn first_index(&self) -> u32 {
        self.first_index
    }

    fn over(
        sobol: Sobol,
        inputs: Vec<Input>,
        first_index: u32,
        points: usize,
    ) -> Result<Self, SensitivityError> {
        inputs.iter().try_for_each(Input::validate)?;
        let maximum = (1_u64 << 32) - u64::from(first_index);
        check_range("points", points as u64, 1, maximum)?;
        let prepared = inputs.iter().map(Input::prepare).collect();
        Ok(Self { inputs, prepared, sobol, first_index, points })
    }
}

impl SampleDesign for SobolDesign {
    fn inputs(&self) -> &[Input] {
        &self.inputs
    }

    fn points(&self) -> usize {
        self.points
    }

    fn seed(&self) -> Option<u64> {
        self.sobol.seed()
    }

    fn replicate(&self, seed: u64) -> Self {
        Self { sobol: self.sobol.rescrambled(seed), ..self.clone() }
    }

    fn row(&self, index: usize, row: &mut [f64]) -> Result<(), SensitivityError> {
        check_row(self, index, row)?;
        // Below 2^32: `over` has checked it.
        self.sobol.point(self.first_index + index as u32, row)?;
        for (value, input) in row.iter_mut().zip(&self.prepared) {
            *value = input.value(*value);
        }
        Ok(())
    }

    fn rows(&self, first: usize, rows: &mut [f64]) -> Result<(), SensitivityError> {
        let last = (first + rows.len() / self.inputs.len()).saturating_sub(1);
        check_range("index", first.max(last) as u64, 0, self.points as u64 - 1)?;
        self.sobol.points(self.first_index + first as u32, rows)?;
        for row in rows.chunks_exact_mut(self.inputs.len()) {
            for (value, input) in row.iter_mut().zip(&self.prepared) {
                *value = input.value(*value);
            }
        }
        Ok(())
    }
}

/// Independent random points. Row i is stream i of the generator `ChaCha8` (D. J. Bernstein, 2008): an input added
/// at the end leaves the other columns as they were.
#[derive(Debug, Clone)]
pub struct RandomDesign {
    inputs: Vec<Input>,
    points: usize,
    seed: u64,
}

impl RandomDesign {
    /// `points` independent rows.
    ///
    /// # Errors
    /// [`SensitivityError::InvalidInput`] for an input that is not valid, [`SensitivityError::OutOfRange`] for no
    /// input or no point.
    pub fn new(inputs: Vec<Input>, points: usize, seed: u64) -> Result<Self, SensitivityError> {
        inputs.iter().try_for_each(Input::validate)?;
        check_range("inputs", inputs.len() as u64, 1, u64::MAX)?;
        check_range("points", points as u64, 1, u64::MAX)?;
        Ok(Self { inputs, points, seed })
    }
}

impl SampleDesign for RandomDesign {
    fn inputs(&self) -> &[Input] {
        &self.inputs
    }

    fn points(&self) -> usize {
        self.points
    }

    fn seed(&self) -> Option<u64> {
        Some(self.seed)
    }

    fn replicate(&self, seed: u64) -> Self {
        Self { seed, ..self.clone() }
    }

    fn row(&self, index: usize, row: &mut [f64]) -> Result<(), SensitivityError> {
        check_row(self, index, row)?;
        let mut generator = ChaCha8Rng::seed_from_u64(self.seed);
        generator.set_stream(index as u64);
        for (value, input) in row.iter_mut().zip(&self.inputs) {
            // The middle of a cell of 2^-52: neither 0 nor 1.
            let u = ((generator.next_u64() >> 12) as f64 + 0.5) / (1_u64 << 52) as f64;
            *value = input.value(u);
        }
        Ok(())
    }
}

fn check_row(design: &impl SampleDesign, index: usize, row: &[f64]) -> Result<(), SensitivityError> {
    check_range("index", index as u64, 0, design.points() as u64 - 1)?;
    let expected = design.inputs().len();
    if row.len() != expected {
        return Err(SensitivityError::LengthMismatch { field: "row", value: row.len(), expected });
    }
    Ok(())
}

fn check_range(field: &'static str, value: u64, minimum: u64, maximum: u64) -> Result<(), SensitivityError> {
    if (minimum..=maximum).contains(&value) {
        Ok(())
    } else {
        Err(SensitivityError::OutOfRange { field, value, minimum, maximum })
    }
}
