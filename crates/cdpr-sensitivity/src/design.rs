//! Designs of experiments. A design is a type, and an estimator takes that type: see [`SampleDesign`].
//!
//! Any row is had from its index alone, so that a map over the rows gives the same numbers on one thread and on many.

use rand::{Rng, SeedableRng};
use rand_chacha::ChaCha8Rng;

use crate::error::{SensitivityError, check_length, check_range};
use crate::input::{Input, Prepared};
use crate::sobol::Sobol;

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

/// Consecutive points of Sobol's sequence, plain or scrambled. Sizes of 2^k, from index 0, keep its balance.
#[derive(Debug, Clone)]
pub struct SobolDesign {
    inputs: Vec<Input>,
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
        check_origin(&inputs, first_index)?;
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
        check_points(first_index, points)?;
        Ok(Self { inputs, sobol, first_index, points })
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

    fn unit_point(&self, index: usize, point: &mut [f64]) -> Result<(), SensitivityError> {
        check_row(self, index, point)?;
        // Below 2^32: `check_points` has seen to it.
        self.sobol.point(self.first_index + index as u32, point)
    }

    fn unit_points(&self, first: usize, points: &mut [f64]) -> Result<(), SensitivityError> {
        let last = (first + points.len() / self.inputs.len()).saturating_sub(1);
        check_range("index", first.max(last) as u64, 0, self.points as u64 - 1)?;
        self.sobol.points(self.first_index + first as u32, points)
    }
}

impl JointSample for SobolDesign {}
impl IndependentSample for SobolDesign {}

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

    fn unit_point(&self, index: usize, point: &mut [f64]) -> Result<(), SensitivityError> {
        check_row(self, index, point)?;
        let mut generator = stream(self.seed, index as u64);
        point.fill_with(|| uniform(&mut generator));
        Ok(())
    }
}

impl JointSample for RandomDesign {}
impl IndependentSample for RandomDesign {}

/// Stream `number` of the generator of a seed.
pub(crate) fn stream(seed: u64, number: u64) -> ChaCha8Rng {
    let mut generator = ChaCha8Rng::seed_from_u64(seed);
    generator.set_stream(number);
    generator
}

/// The middle of a cell of 2^-52: neither 0 nor 1.
pub(crate) fn uniform(generator: &mut ChaCha8Rng) -> f64 {
    ((generator.next_u64() >> 12) as f64 + 0.5) / (1_u64 << 52) as f64
}

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
