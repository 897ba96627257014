//! Factors and eigenvectors of dense matrices, by faer. No other module names it.

use faer::{Mat, MatRef, Side};
use nalgebra::DMatrix;

/// The factor L of a positive definite matrix, `A = L Lᵀ`; `None` where it is not definite.
pub(crate) fn cholesky(matrix: &DMatrix<f64>) -> Option<DMatrix<f64>> {
    let factor = copy(matrix).llt(Side::Lower).ok()?;
    Some(back(factor.L()))
}

/// Eigenvalues of a symmetric matrix, ascending, and its eigenvectors as columns; `None` where they are not
/// found.
pub(crate) fn eigenvectors(matrix: &DMatrix<f64>) -> Option<(Vec<f64>, DMatrix<f64>)> {
    let found = copy(matrix).self_adjoint_eigen(Side::Lower).ok()?;
    Some((found.S().column_vector().iter().copied().collect(), back(found.U())))
}

fn copy(matrix: &DMatrix<f64>) -> Mat<f64> {
    Mat::from_fn(matrix.nrows(), matrix.ncols(), |i, j| matrix[(i, j)])
}

fn back(matrix: MatRef<'_, f64>) -> DMatrix<f64> {
    DMatrix::from_fn(matrix.nrows(), matrix.ncols(), |i, j| matrix[(i, j)])
}
