//! Sobol's sequence, plain or with Owen's scrambling. Any point is computed directly from its index.
//!
//! With `V_j,k` the direction numbers of dimension j and g the Gray code of the index i,
//!
//! ```text
//! g = i ⊕ (i >> 1)                                                        (S1)
//! x_j = ⊕_k g_k V_j,k / 2^32                                              (S2)
//! m_k = 2 a_1 m_(k-1) ⊕ .. ⊕ 2^(s-1) a_(s-1) m_(k-s+1) ⊕ 2^s m_(k-s) ⊕ m_(k-s),   V_k = 2^(32-k) m_k   (S3)
//! ```
//!
//! (S1), (S2): I. A. Antonov, V. M. Saleev, *An economic method of computing LP-tau sequences* (1979). (S3)
//! and the initial `m_k`: S. Joe, F. Y. Kuo, *Constructing Sobol sequences with better two-dimensional
//! projections*, SIAM J. Sci. Comput. 30 (2008), table `new-joe-kuo-6`. Its licence stands beside it in
//! `data/`.
//!
//! The scrambling is nested and uniform: A. B. Owen, *Randomly permuted (t,m,s)-nets and (t,s)-sequences*
//! (1995). Each binary digit is flipped by a fair coin that depends on all digits before it:
//!
//! ```text
//! y_k = x_k ⊕ coin(seed, j, x_1 .. x_(k-1)),   k = 1 .. 32                 (S4)
//! ```
//!
//! The coin is a hash of these digits, as in B. Burley, *Practical hash-based Owen scrambling* (JCGT, 2020).
//! Each node of the tree of digits has a coin of its own here; Burley's Laine-Karras permutation only
//! approximates (S4). The hash is the output function of `SplitMix64`: G. L. Steele, D. Lea, C. H. Flood,
//! *Fast splittable pseudorandom number generators* (2014).

use crate::design::input::Input;
use crate::design::{
    IndependentSample, JointSample, Layout, SampleDesign, check_origin, check_points, check_row,
};
use crate::error::{SensitivityError, check_length, check_range};

const BITS: usize = 32;
const TABLE: &str = include_str!("../../data/new-joe-kuo-6.2048");

/// Sobol's sequence of 2^32 points in up to [`Sobol::MAX_DIMENSIONS`] dimensions.
#[derive(Debug, Clone)]
pub struct Sobol {
    /// `V_j,k` of each dimension, the most significant bit first.
    directions: Vec<[u32; BITS]>,
    seed: Option<u64>,
}

impl Sobol {
    /// Largest number of dimensions.
    pub const MAX_DIMENSIONS: usize = 2048;

    /// Makes the plain sequence. Its points are those of `scipy.stats.qmc.Sobol(scramble=False)`, bit for
    /// bit.
    ///
    /// Point 0 is all zeros.
    ///
    /// # Errors
    /// [`SensitivityError::OutOfRange`] unless `dimensions` is 1 to [`Sobol::MAX_DIMENSIONS`].
    pub fn new(dimensions: usize) -> Result<Self, SensitivityError> {
        check_range("dimensions", dimensions as u64, 1, Self::MAX_DIMENSIONS as u64)?;
        let first = std::array::from_fn(|k| 1 << (BITS - 1 - k));
        let others = TABLE.lines().map(directions_of_line);
        let directions = std::iter::once(first).chain(others).take(dimensions).collect();
        Ok(Self { directions, seed: None })
    }

    /// Makes the sequence under a nested uniform scrambling, Eq. (S4), which is independent in each
    /// dimension.
    ///
    /// Each point is uniform on (0, 1). The values 0 and 1 do not occur.
    ///
    /// # Errors
    /// As [`Sobol::new`].
    pub fn scrambled(dimensions: usize, seed: u64) -> Result<Self, SensitivityError> {
        Ok(Self { seed: Some(seed), ..Self::new(dimensions)? })
    }

    /// Returns the same sequence under the scrambling of another seed.
    #[must_use]
    pub fn rescrambled(&self, seed: u64) -> Self {
        Self { seed: Some(seed), ..self.clone() }
    }

    /// Returns the same sequence with its dimensions in another order.
    pub(crate) fn reordered(&self, order: impl Iterator<Item = usize>) -> Self {
        Self { directions: order.map(|j| self.directions[j]).collect(), seed: self.seed }
    }

    /// Number of dimensions.
    #[must_use]
    pub fn dimensions(&self) -> usize {
        self.directions.len()
    }

    /// Seed of the scrambling, `None` for the plain sequence.
    #[must_use]
    pub fn seed(&self) -> Option<u64> {
        self.seed
    }

    /// Writes the point of this index into `point`. Plain points lie in [0, 1), scrambled ones in (0, 1).
    ///
    /// # Errors
    /// [`SensitivityError::LengthMismatch`] unless `point` has as many elements as there are dimensions.
    pub fn point(&self, index: u32, point: &mut [f64]) -> Result<(), SensitivityError> {
        check_length("point", point.len(), self.dimensions())?;
        for (j, (x, directions)) in point.iter_mut().zip(&self.directions).enumerate() {
            *x = self.coordinate(j, digits(gray(index), directions));
        }
        Ok(())
    }

    /// Writes consecutive points into `points`, one after the other, starting at index `first`.
    ///
    /// The points are those of [`Sobol::point`]. They are computed faster, because the digits of consecutive
    /// points differ by a single direction number.
    ///
    /// # Errors
    /// [`SensitivityError::LengthMismatch`] unless `points` holds whole points,
    /// [`SensitivityError::OutOfRange`] for points beyond 2^32.
    pub fn points(&self, first: u32, points: &mut [f64]) -> Result<(), SensitivityError> {
        let dimensions = self.dimensions();
        check_length("points", points.len(), points.len().next_multiple_of(dimensions))?;
        let count = points.len() / dimensions;
        check_range("points", count as u64, 0, (1_u64 << BITS) - u64::from(first))?;
        let mut state: Vec<u32> =
            self.directions.iter().map(|directions| digits(gray(first), directions)).collect();
        for (index, point) in (u64::from(first)..).zip(points.chunks_exact_mut(dimensions)) {
            for (j, (x, digits)) in point.iter_mut().zip(&state).enumerate() {
                *x = self.coordinate(j, *digits);
            }
            // The digit of the Gray code that changes next. After the last point there is no such digit.
            let changed = (index + 1).trailing_zeros() as usize;
            if changed < BITS {
                for (digits, directions) in state.iter_mut().zip(&self.directions) {
                    *digits ^= directions[changed];
                }
            }
        }
        Ok(())
    }

    /// Coordinate of dimension `j`. It is scrambled if the sequence is scrambled.
    fn coordinate(&self, j: usize, digits: u32) -> f64 {
        const CELL: f64 = 1.0 / (1_u64 << BITS) as f64;
        match self.seed {
            None => f64::from(digits) * CELL,
            // The point is the middle of its cell of 2^-32.
            Some(seed) => (f64::from(scramble(digits, key(seed, j as u64))) + 0.5) * CELL,
        }
    }
}

/// Consecutive points of Sobol's sequence, plain or scrambled. 2^k points from index 0 keep the balance of
/// the sequence.
#[derive(Debug, Clone)]
pub struct SobolDesign {
    layout: Layout,
    sobol: Sobol,
    first_index: u32,
}

impl SobolDesign {
    /// Makes a design of the points `first_index` to `first_index + points - 1` of the plain sequence.
    ///
    /// # Errors
    /// - [`SensitivityError::InvalidInput`] for an invalid input;
    /// - [`SensitivityError::OutOfRange`] for no input or too many, no point, or points beyond 2^32;
    /// - [`SensitivityError::UnboundedAtZero`] if point 0 is among them and the law of an input has no lower
    ///   end.
    pub fn new(inputs: Vec<Input>, first_index: u32, points: usize) -> Result<Self, SensitivityError> {
        check_origin(&inputs, first_index)?;
        let sobol = Sobol::new(inputs.len())?;
        Self::over(sobol, inputs, first_index, points)
    }

    /// Makes a design of the first points of the sequence under Owen's scrambling.
    ///
    /// # Errors
    /// As [`SobolDesign::new`], but point 0 is allowed: scrambled, it is not zero.
    pub fn scrambled(inputs: Vec<Input>, points: usize, seed: u64) -> Result<Self, SensitivityError> {
        let sobol = Sobol::scrambled(inputs.len(), seed)?;
        Self::over(sobol, inputs, 0, points)
    }

    /// Index of the first row in the sequence.
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
        let layout = Layout::new(inputs, points, sobol.seed())?;
        check_points(first_index, points)?;
        Ok(Self { layout, sobol, first_index })
    }
}

impl SampleDesign for SobolDesign {
    fn layout(&self) -> &Layout {
        &self.layout
    }

    fn replicate(&self, seed: u64) -> Self {
        let sobol = self.sobol.rescrambled(seed);
        Self { layout: self.layout.reseeded(seed), sobol, first_index: self.first_index }
    }

    fn unit_point(&self, index: usize, point: &mut [f64]) -> Result<(), SensitivityError> {
        check_row(self, index, point)?;
        // `check_points` has ensured that the index is below 2^32.
        self.sobol.point(self.first_index + index as u32, point)
    }

    fn unit_points(&self, first: usize, points: &mut [f64]) -> Result<(), SensitivityError> {
        let last = (first + points.len() / self.inputs().len()).saturating_sub(1);
        check_range("index", first.max(last) as u64, 0, self.points() as u64 - 1)?;
        self.sobol.points(self.first_index + first as u32, points)
    }
}

impl JointSample for SobolDesign {}
impl IndependentSample for SobolDesign {}

/// Gray code, Eq. (S1).
fn gray(index: u32) -> u32 {
    index ^ (index >> 1)
}

/// Direction numbers, Eq. (S3), from a line `a m_1 .. m_s` of the table.
fn directions_of_line(line: &str) -> [u32; BITS] {
    let mut numbers = line.split_ascii_whitespace().filter_map(|number| number.parse::<u32>().ok());
    let inner = numbers.next().unwrap_or_default();
    let mut m = [0; BITS];
    let mut degree = 0;
    for (m, initial) in m.iter_mut().zip(numbers) {
        *m = initial;
        degree += 1;
    }
    // Written for V, 2^i m_(k-i) becomes V_(k-i), and m_(k-s) becomes V_(k-s) / 2^s.
    let mut v: [u32; BITS] = std::array::from_fn(|k| m[k] << (BITS - 1 - k));
    for k in degree..BITS {
        v[k] = v[k - degree] ^ (v[k - degree] >> degree);
        for i in 1..degree {
            if (inner >> (degree - 1 - i)) & 1 == 1 {
                v[k] ^= v[k - i];
            }
        }
    }
    v
}

/// Digits of a coordinate, Eq. (S2), as an integer.
fn digits(mut gray: u32, directions: &[u32; BITS]) -> u32 {
    let mut digits = 0;
    while gray != 0 {
        digits ^= directions[gray.trailing_zeros() as usize];
        gray &= gray - 1;
    }
    digits
}

/// Scrambles digits, Eq. (S4). In the tree of digits, a prefix of k digits leads to the node number 2^k +
/// prefix.
fn scramble(digits: u32, key: u64) -> u32 {
    let mut flips = 0;
    for k in 0..BITS {
        let node = (1 << k) + (u64::from(digits) >> (BITS - k));
        let coin = mix(key.wrapping_add(node.wrapping_mul(GOLDEN))) >> 63;
        flips = (flips << 1) | coin as u32;
    }
    digits ^ flips
}

/// Key of a seed and a dimension.
fn key(seed: u64, dimension: u64) -> u64 {
    mix(mix(seed.wrapping_add(GOLDEN)).wrapping_add(dimension.wrapping_mul(GOLDEN)))
}

/// Increment of `SplitMix64`: the odd integer closest to 2^64 over the golden ratio.
const GOLDEN: u64 = 0x9e37_79b9_7f4a_7c15;

/// Output function of `SplitMix64`.
fn mix(mut z: u64) -> u64 {
    z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
    z ^ (z >> 31)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_embedded_table_has_a_line_of_odd_numbers_below_2_to_the_k_for_each_dimension() {
        assert_eq!(TABLE.lines().count(), Sobol::MAX_DIMENSIONS - 1);
        for line in TABLE.lines() {
            let numbers: Vec<u64> = line.split(' ').map(|number| number.parse().unwrap()).collect();
            assert!(numbers.len() > 1 && numbers[0] < 1 << (numbers.len() - 2));
            for (k, m) in numbers[1..].iter().enumerate() {
                assert!(m % 2 == 1 && *m < 2 << k, "{line}");
            }
        }
    }

    #[test]
    fn scrambling_permutes_the_cells_of_each_size() {
        for depth in [1, 4, 8] {
            let mut seen = vec![false; 1 << depth];
            for cell in 0..1_u32 << depth {
                seen[(scramble(cell << (32 - depth), key(3, 1)) >> (32 - depth)) as usize] = true;
            }
            assert!(seen.iter().all(|&seen| seen));
        }
    }

    #[test]
    fn the_coin_of_a_node_is_fair_and_independent_of_that_of_its_sibling() {
        // Over seeds: the four outcomes of the coins below prefixes 0 and 1. Standard deviation of a count:
        // 27.
        let mut counts = [0_i32; 4];
        for seed in 0..4000 {
            let (left, right) = (scramble(0, key(seed, 5)), scramble(1 << 31, key(seed, 5)));
            counts[(((left >> 30) & 1) + 2 * ((right >> 30) & 1)) as usize] += 1;
        }
        assert!(counts.iter().all(|count| (count - 1000).abs() < 110), "{counts:?}");
    }
}
