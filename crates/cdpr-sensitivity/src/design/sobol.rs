//! Sobol's sequence, plain or with a nested scrambling. Any point is computed directly from its index.
//!
//! With `V_j,k` the direction numbers of dimension j and g the Gray code of the index i,
//!
//! ```text
//! g = i ⊕ (i >> 1)                                                       (So1)
//! x_j = ⊕_k g_k V_j,k / 2^32                                             (So2)
//! m_k = 2 a_1 m_(k-1) ⊕ .. ⊕ 2^(s-1) a_(s-1) m_(k-s+1) ⊕ 2^s m_(k-s) ⊕ m_(k-s)
//! V_k = 2^(32-k) m_k                                                     (So3)
//! ```
//!
//! (So1), (So2): I. A. Antonov, V. M. Saleev, *An economic method of computing LP-tau sequences* (1979).
//! (So3) and the initial `m_k`: S. Joe, F. Y. Kuo, *Constructing Sobol sequences with better two-dimensional
//! projections*, SIAM J. Sci. Comput. 30 (2008), table `new-joe-kuo-6`. Its licence stands beside it in
//! `data/`.
//!
//! The scrambling is nested: A. B. Owen, *Randomly permuted (t,m,s)-nets and (t,s)-sequences* (1995). Each
//! binary digit is flipped by a coin that depends on all digits before it:
//!
//! ```text
//! y_k = x_k ⊕ coin(seed, j, x_1 .. x_(k-1)),   k = 1 .. 32                (So4)
//! ```
//!
//! The coins come from a permutation of integers in which a bit depends on lower bits alone, applied to the
//! digits in reverse order: S. Laine, T. Karras, *Stratified sampling for stochastic transparency* (2011);
//! B. Burley, *Practical hash-based Owen scrambling*, JCGT 9:4 (2020). With c the key of the seed and of
//! dimension j, and N. Vegdahl's constants (*Building a better LK hash*, 2021),
//!
//! ```text
//! n ⊕= 3d20adea n,  n += c,  n *= c/2^16 | 1,  n ⊕= 05526c56 n,  n ⊕= 53a22864 n  (modulo 2^32)   (So5)
//! ```
//!
//! A net stays a net of the same quality, and each point is uniform. The coins are not independent of each
//! other as Owen's are; `tests/scrambling.rs` compares the variances of means with those of independent
//! coins.

use crate::design::input::Input;
use crate::design::{
    IndependentSample, JointSample, Layout, SampleDesign, check_origin, check_points, check_row, check_rows,
};
use crate::error::{SensitivityError, check_length, check_range};

const BITS: usize = 32;
const TABLE: &str = include_str!("../../data/new-joe-kuo-6.2048");

/// Sobol's sequence of 2^32 points in up to [`Sobol::MAX_DIMENSIONS`] dimensions.
#[derive(Debug, Clone)]
pub struct Sobol {
    dimensions: usize,
    /// `V_j,k` of all dimensions for k = 1, then for k = 2, and so on. In a scrambled sequence their bits are
    /// in reverse order, the most significant digit last, as Eq. (So5) takes them.
    directions: Vec<u32>,
    scrambling: Option<Scrambling>,
}

/// A seed, and its key for each dimension.
#[derive(Debug, Clone)]
struct Scrambling {
    seed: u64,
    keys: Vec<u32>,
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
        let by_dimension: Vec<[u32; BITS]> = std::iter::once(first).chain(others).take(dimensions).collect();
        let directions = (0..BITS).flat_map(|k| by_dimension.iter().map(move |v| v[k])).collect();
        Ok(Self { dimensions, directions, scrambling: None })
    }

    /// Makes the sequence under a nested scrambling, Eq. (So4), with a key of its own in each dimension.
    ///
    /// Each point is uniform on (0, 1). The values 0 and 1 do not occur.
    ///
    /// # Errors
    /// As [`Sobol::new`].
    pub fn scrambled(dimensions: usize, seed: u64) -> Result<Self, SensitivityError> {
        Ok(Self::new(dimensions)?.rescrambled(seed))
    }

    /// Returns the same sequence under the scrambling of another seed.
    #[must_use]
    pub fn rescrambled(&self, seed: u64) -> Self {
        let directions = match self.scrambling {
            None => self.directions.iter().map(|direction| direction.reverse_bits()).collect(),
            Some(_) => self.directions.clone(),
        };
        let keys = (0..self.dimensions as u64).map(|j| key(seed, j)).collect();
        Self { directions, scrambling: Some(Scrambling { seed, keys }), dimensions: self.dimensions }
    }

    /// Returns the plain sequence with its dimensions in another order.
    pub(crate) fn reordered(&self, order: &[usize]) -> Self {
        let rows = self.directions.chunks_exact(self.dimensions);
        let directions = rows.flat_map(|row| order.iter().map(|&j| row[j])).collect();
        Self { dimensions: order.len(), directions, scrambling: None }
    }

    /// Number of dimensions.
    #[must_use]
    pub fn dimensions(&self) -> usize {
        self.dimensions
    }

    /// Seed of the scrambling, `None` for the plain sequence.
    #[must_use]
    pub fn seed(&self) -> Option<u64> {
        self.scrambling.as_ref().map(|scrambling| scrambling.seed)
    }

    /// Writes the point of this index into `point`. Plain points lie in [0, 1), scrambled ones in (0, 1).
    ///
    /// # Errors
    /// [`SensitivityError::LengthMismatch`] unless `point` has as many elements as there are dimensions.
    pub fn point(&self, index: u32, point: &mut [f64]) -> Result<(), SensitivityError> {
        check_length("point", point.len(), self.dimensions)?;
        self.coordinates(&self.digits(index), point);
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
        let dimensions = self.dimensions;
        check_length("points", points.len(), points.len().next_multiple_of(dimensions))?;
        let count = points.len() / dimensions;
        check_range("points", count as u64, 0, (1_u64 << BITS) - u64::from(first))?;
        let mut digits = self.digits(first);
        for (index, point) in (u64::from(first)..).zip(points.chunks_exact_mut(dimensions)) {
            self.coordinates(&digits, point);
            // The digit of the Gray code that changes next. After the last point there is no such digit.
            let changed = (index + 1).trailing_zeros() as usize;
            if changed < BITS {
                self.flip(changed, &mut digits);
            }
        }
        Ok(())
    }

    /// Digits of all coordinates of a point, Eq. (So2), as integers; reversed where they are to be scrambled.
    fn digits(&self, index: u32) -> Vec<u32> {
        let mut digits = vec![0; self.dimensions];
        let mut gray = index ^ (index >> 1); // Eq. (So1)
        while gray != 0 {
            self.flip(gray.trailing_zeros() as usize, &mut digits);
            gray &= gray - 1;
        }
        digits
    }

    /// Changes digit k of the Gray code.
    fn flip(&self, k: usize, digits: &mut [u32]) {
        let directions = &self.directions[k * self.dimensions..][..self.dimensions];
        for (digits, direction) in digits.iter_mut().zip(directions) {
            *digits ^= direction;
        }
    }

    /// Coordinates of these digits. They are scrambled if the sequence is scrambled.
    fn coordinates(&self, digits: &[u32], point: &mut [f64]) {
        const CELL: f64 = 1.0 / (1_u64 << BITS) as f64;
        match &self.scrambling {
            None => {
                for (x, digits) in point.iter_mut().zip(digits) {
                    *x = f64::from(*digits) * CELL;
                }
            }
            Some(Scrambling { keys, .. }) => {
                // Two loops at a time, each of which fills the lanes of any vector unit.
                const TOGETHER: usize = 64;
                let parts = digits.chunks(TOGETHER).zip(keys.chunks(TOGETHER));
                for (point, (digits, keys)) in point.chunks_mut(TOGETHER).zip(parts) {
                    let mut scrambled = [0; TOGETHER];
                    for ((scrambled, digits), key) in scrambled.iter_mut().zip(digits).zip(keys) {
                        *scrambled = scramble(*digits, *key);
                    }
                    for (x, scrambled) in point.iter_mut().zip(scrambled) {
                        // The point is the middle of its cell of 2^-32.
                        *x = (f64::from(scrambled.reverse_bits()) + 0.5) * CELL;
                    }
                }
            }
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

    /// Makes a design of the first points of the scrambled sequence.
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
        check_rows(self, first, points)?;
        // `check_points` has ensured that the index is below 2^32.
        self.sobol.points(self.first_index + first as u32, points)
    }
}

impl JointSample for SobolDesign {}
impl IndependentSample for SobolDesign {}

/// Direction numbers, Eq. (So3), from a line `a m_1 .. m_s` of the table.
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

/// Scrambles digits in reverse order, Eq. (So5).
#[inline]
fn scramble(mut n: u32, key: u32) -> u32 {
    n ^= n.wrapping_mul(0x3d20_adea);
    n = n.wrapping_add(key).wrapping_mul((key >> 16) | 1);
    n ^= n.wrapping_mul(0x0552_6c56);
    n ^ n.wrapping_mul(0x53a2_2864)
}

/// Key of a seed and a dimension: half of the number that `SplitMix64` gives, G. L. Steele, D. Lea, C. H.
/// Flood, *Fast splittable pseudorandom number generators* (2014).
fn key(seed: u64, dimension: u64) -> u32 {
    let seeded = mix(seed.wrapping_add(GOLDEN));
    (mix(seeded.wrapping_add(dimension.wrapping_mul(GOLDEN))) >> 32) as u32
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
}
