//! Factorizations of assembled matrices, by faer. No other module names it.
//!
//! Systems of six equations do without: their size is known to the compiler, and factors of nalgebra take a
//! fifth of the time.

use faer::linalg::solvers::{Lblt, PartialPivLu, Solve};
use faer::{Mat, Side};
use nalgebra::{DMatrix, DVector};

/// `P A = L U` of a square matrix, for any number of right-hand sides.
pub(crate) struct Lu {
    factors: PartialPivLu<f64>,
    size: usize,
}

impl Lu {
    pub(crate) fn new(matrix: &DMatrix<f64>) -> Self {
        Self { factors: copy(matrix).partial_piv_lu(), size: matrix.nrows() }
    }

    /// `A⁻¹`; of a singular matrix some numbers are not finite.
    pub(crate) fn inverse(&self) -> DMatrix<f64> {
        self.solve(&DMatrix::identity(self.size, self.size))
    }

    /// `A⁻¹ right`; of a singular matrix some numbers are not finite.
    pub(crate) fn solve(&self, right: &DMatrix<f64>) -> DMatrix<f64> {
        let solution = self.factors.solve(&copy(right));
        DMatrix::from_fn(self.size, right.ncols(), |i, j| solution[(i, j)])
    }
}

/// `P A Pᵀ = L B Lᵀ` of a symmetric matrix that need not be definite, with blocks of one or two rows in B (J.
/// R. Bunch, L. Kaufman, *Some stable methods for calculating inertia and solving symmetric linear systems*,
/// Mathematics of Computation 31, 1977).
pub(crate) struct Indefinite {
    factors: Lblt<f64>,
    size: usize,
}

impl Indefinite {
    /// Of the lower triangle.
    pub(crate) fn new(matrix: &DMatrix<f64>) -> Self {
        Self { factors: Lblt::new(copy(matrix).as_ref(), Side::Lower), size: matrix.nrows() }
    }

    /// The numbers of positive and of negative eigenvalues: those of B, by Sylvester's law.
    pub(crate) fn eigenvalues_by_sign(&self) -> (usize, usize) {
        let diagonal = self.factors.B_diag().column_vector();
        let below = self.factors.B_subdiag().column_vector();
        let (mut row, mut positive, mut negative) = (0, 0, 0);
        let mut count = |value: f64| {
            positive += usize::from(value > 0.0);
            negative += usize::from(value < 0.0);
        };
        while row < self.size {
            if row + 1 < self.size && below[row] != 0.0 {
                // The smaller eigenvalue has the sign of the product of both over the larger one.
                let [a, b, c] = [diagonal[row], below[row], diagonal[row + 1]];
                let larger = (0.5 * (a + c)).abs() + (0.5 * (a - c)).hypot(b);
                let larger = larger.copysign(a + c);
                count(larger);
                count((a * c - b * b) / larger);
                row += 2;
            } else {
                count(diagonal[row]);
                row += 1;
            }
        }
        (positive, negative)
    }

    /// `A⁻¹ right`; `None` where it is not finite.
    pub(crate) fn solve(&self, right: &DVector<f64>) -> Option<DVector<f64>> {
        let solution = self.factors.solve(&Mat::from_fn(self.size, 1, |i, _| right[i]));
        let solution = DVector::from_fn(self.size, |i, _| solution[(i, 0)]);
        solution.iter().all(|x| x.is_finite()).then_some(solution)
    }
}

fn copy(matrix: &DMatrix<f64>) -> Mat<f64> {
    Mat::from_fn(matrix.nrows(), matrix.ncols(), |i, j| matrix[(i, j)])
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    proptest! {
        /// Of the form of the optimality conditions, `[H Jᵀ; J 0]` with six equations, and of any other.
        #[test]
        fn an_indefinite_system_is_solved_and_its_inertia_is_that_of_its_eigenvalues(
            entries in prop::collection::vec(-1.0..1.0_f64, 196), free in 6..=8_usize, any in any::<bool>(),
        ) {
            let n = free + 6;
            let entry = |i: usize, j: usize| match (i.min(j), i.max(j)) {
                (low, high) if any || (low < free && high >= free) || low == high && high < free => {
                    entries[14 * low + high]
                }
                _ => 0.0,
            };
            let matrix = DMatrix::from_fn(n, n, entry);
            let values = matrix.clone().symmetric_eigenvalues();
            prop_assume!(values.iter().all(|value| value.abs() > 1e-3));
            let factors = Indefinite::new(&matrix);
            let positive = values.iter().filter(|value| **value > 0.0).count();
            prop_assert_eq!(factors.eigenvalues_by_sign(), (positive, n - positive));
            let expected = DVector::from_fn(n, |i, _| entries[i]);
            let found = factors.solve(&(&matrix * &expected)).unwrap();
            prop_assert!((found - expected).amax() < 1e-10);
        }
    }

    #[test]
    fn a_singular_system_has_no_solution() {
        let matrix = DMatrix::from_element(3, 3, 1.0);
        let right = DVector::from_column_slice(&[1.0, 2.0, 3.0]);
        assert!(Indefinite::new(&matrix).solve(&right).is_none_or(|found| found.amax() > 1e12));
        let found = Lu::new(&matrix).solve(&DMatrix::from_column_slice(3, 1, right.as_slice()));
        assert!(!found.iter().all(|x| x.abs() < 1e12));
    }
}
