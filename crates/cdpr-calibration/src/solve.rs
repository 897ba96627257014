//! Linear least squares for many rows with unknowns of their own. No other module names faer.
//!
//! A row of measurements has residuals `ρ + A δ + B η` with the unknowns δ of all rows and η of its own.
//! The orthogonal factor of `B = Q [S; 0]` leaves rows without η (the Schur complement, without squares):
//!
//! ```text
//! Qᵀ [A ρ] = [A_1 ρ_1; A_2 ρ_2],     S η = -(ρ_1 + A_1 δ)                                       (K5)
//! ```
//!
//! and the triangular factor of all `[A_2 ρ_2]` is all that the unknowns of all rows depend on.

use faer::linalg::solvers::Qr;
use nalgebra::{DMatrix, DVector};
use rayon::prelude::*;

/// A row whose own unknowns are eliminated, equation (K5).
pub(crate) struct Eliminated {
    /// [A_2 ρ_2].
    pub(crate) rest: DMatrix<f64>,
    /// [A_1 ρ_1] and S.
    own: Option<(DMatrix<f64>, DMatrix<f64>)>,
}

impl Eliminated {
    /// Eliminates the unknowns of `own` (B) from `row` ([A ρ]).
    pub(crate) fn new(row: DMatrix<f64>, own: &DMatrix<f64>) -> Self {
        let unknowns = own.ncols();
        if unknowns == 0 {
            return Self { rest: row, own: None };
        }
        let qr = own.clone().qr();
        let mut row = row;
        qr.q_tr_mul(&mut row);
        let rest = row.rows(unknowns, row.nrows() - unknowns).into_owned();
        let top = row.rows(0, unknowns).into_owned();
        Self { rest, own: Some((top, qr.r())) }
    }

    /// What a step of the row's own unknowns alone takes from the sum of its squares.
    pub(crate) fn gain(&self) -> f64 {
        self.own.as_ref().map_or(0.0, |(top, _)| top.column(top.ncols() - 1).norm_squared())
    }

    /// The row's own unknowns for a step of the others.
    pub(crate) fn own(&self, step: &DVector<f64>) -> Vec<f64> {
        let Some((top, triangle)) = &self.own else { return Vec::new() };
        let count = step.len();
        let mut right = -(top.columns(0, count) * step + top.column(count));
        // A row's own unknown that nothing depends on is not moved.
        if !triangle.solve_upper_triangular_mut(&mut right) || right.iter().any(|of| !of.is_finite()) {
            right.fill(0.0);
        }
        right.as_slice().to_vec()
    }
}

/// Rows that one task reduces: the same for any number of threads.
const CHUNK: usize = 16;

/// The triangular factor of all rows, one below the other, each with `columns` columns.
pub(crate) fn reduce(rows: &[Eliminated], columns: usize) -> DMatrix<f64> {
    let chunk = |rows: &[Eliminated]| {
        let count: usize = rows.iter().map(|row| row.rest.nrows()).sum();
        let mut stacked = DMatrix::zeros(count.max(columns), columns);
        let mut at = 0;
        for row in rows {
            stacked.rows_mut(at, row.rest.nrows()).copy_from(&row.rest);
            at += row.rest.nrows();
        }
        triangular_factor(&stacked)
    };
    let triangles: Vec<_> = rows.par_chunks(CHUNK).map(chunk).collect();
    let add = |sum: DMatrix<f64>, part: &DMatrix<f64>| triangle(sum, part);
    triangles.iter().fold(DMatrix::zeros(columns, columns), add)
}

/// The triangular factor of two matrices, one below the other.
pub(crate) fn triangle(above: DMatrix<f64>, below: &DMatrix<f64>) -> DMatrix<f64> {
    let rows = above.nrows();
    let mut stacked = above.resize_vertically(rows + below.nrows(), 0.0);
    stacked.rows_mut(rows, below.nrows()).copy_from(below);
    triangular_factor(&stacked)
}

/// R of `A = Q R`, for a matrix with at least as many rows as columns.
fn triangular_factor(matrix: &DMatrix<f64>) -> DMatrix<f64> {
    let qr = Qr::new(faer::Mat::from_fn(matrix.nrows(), matrix.ncols(), |i, j| matrix[(i, j)]).as_ref());
    let r = qr.thin_R();
    DMatrix::from_fn(r.nrows(), r.ncols(), |i, j| if i <= j { r[(i, j)] } else { 0.0 })
}

/// Singular values of a matrix, from the greatest to the least, with its left vectors in columns and its
/// right vectors in rows. All are zero for a matrix that is not finite.
pub(crate) struct Svd {
    pub(crate) left: DMatrix<f64>,
    pub(crate) values: DVector<f64>,
    pub(crate) vectors: DMatrix<f64>,
}

impl Svd {
    pub(crate) fn of(matrix: &DMatrix<f64>) -> Self {
        let (rows, columns) = matrix.shape();
        let size = rows.min(columns);
        let copy = faer::Mat::from_fn(rows, columns, |i, j| matrix[(i, j)]);
        let found = if matrix.iter().all(|entry| entry.is_finite()) { copy.thin_svd().ok() } else { None };
        let Some(found) = found else {
            return Self {
                left: DMatrix::zeros(rows, size),
                values: DVector::zeros(size),
                vectors: DMatrix::zeros(size, columns),
            };
        };
        let (u, s, v) = (found.U(), found.S().column_vector(), found.V());
        Self {
            left: DMatrix::from_fn(rows, size, |i, k| u[(i, k)]),
            values: DVector::from_fn(size, |k, _| s[k]),
            vectors: DMatrix::from_fn(size, columns, |k, j| v[(j, k)]),
        }
    }
}

/// Singular values and vectors of the scaled matrix of a least-squares problem, with what it is to reach.
pub(crate) struct Decomposed {
    /// From the greatest to the least.
    pub(crate) values: DVector<f64>,
    /// Right singular vectors, a row each.
    pub(crate) vectors: DMatrix<f64>,
    /// Unknowns that keep their values and count as known: their columns are zero.
    fixed: Vec<usize>,
    /// Residual along each left singular vector.
    along: DVector<f64>,
}

/// One but for rounding: the singular value of a combination that its prior alone tells.
const UNIT: f64 = 0.999;

/// Singular values below this share of the greatest are rounding.
pub(crate) const ROUNDING: f64 = 1e-12;

impl Decomposed {
    /// The problem `|matrix δ + right|` to be least.
    pub(crate) fn new(matrix: DMatrix<f64>, right: &DVector<f64>) -> Self {
        let Svd { left, values, vectors } = Svd::of(&matrix);
        Self { along: left.tr_mul(right), values, vectors, fixed: Vec::new() }
    }

    /// The same where these unknowns, whose columns are zero, count as known.
    pub(crate) fn with_fixed(self, fixed: Vec<usize>) -> Self {
        Self { fixed, ..self }
    }

    /// Whether the data tell combination k: better than its unit, and better than rounding.
    pub(crate) fn tells(&self, k: usize) -> bool {
        self.values[k] >= UNIT && self.values[k] > ROUNDING * self.values[0]
    }

    /// Damped step over the combinations that the data tell.
    pub(crate) fn step(&self, damping: f64) -> DVector<f64> {
        let mut step = DVector::zeros(self.vectors.ncols());
        for k in (0..self.values.len()).filter(|k| self.tells(*k)) {
            let s = self.values[k];
            step -= self.vectors.row(k).transpose() * (s * self.along[k] / (s * s + damping));
        }
        step
    }

    /// The part of a change that the data tell, each combination by `most` of its standard deviations at
    /// most.
    pub(crate) fn told_part(&self, change: &DVector<f64>, most: f64) -> DVector<f64> {
        let mut part = DVector::zeros(change.len());
        for k in (0..self.values.len()).filter(|k| self.tells(*k)) {
            let v = self.vectors.row(k).transpose();
            let most = most / self.values[k];
            part += &v * v.dot(change).clamp(-most, most);
        }
        part
    }

    /// A change along each combination that the data tell, in standard deviations.
    pub(crate) fn in_deviations(&self, change: &DVector<f64>) -> DVector<f64> {
        let along = |k: usize| self.values[k] * self.vectors.row(k).transpose().dot(change);
        DVector::from_vec((0..self.values.len()).filter(|k| self.tells(*k)).map(along).collect())
    }

    /// Length of the full step in standard deviations.
    pub(crate) fn distance(&self) -> f64 {
        let of = |k: &usize| self.tells(*k);
        (0..self.values.len()).filter(of).map(|k| self.along[k].powi(2)).sum::<f64>().sqrt()
    }

    /// A root of the covariance over all combinations, however little is known of them: the variance of a sum
    /// with weights w is `|root w|²`.
    pub(crate) fn root(&self) -> DMatrix<f64> {
        let floor = ROUNDING * self.values.max().max(1.0);
        let mut root = self.vectors.clone();
        for (mut row, value) in root.row_iter_mut().zip(self.values.iter()) {
            row /= value.max(floor);
        }
        self.fixed.iter().for_each(|known| root.column_mut(*known).fill(0.0));
        root
    }

    /// Covariance over the combinations that the data tell.
    pub(crate) fn covariance(&self) -> DMatrix<f64> {
        let n = self.vectors.ncols();
        let mut covariance = DMatrix::zeros(n, n);
        for k in (0..self.values.len()).filter(|k| self.tells(*k)) {
            let v = self.vectors.row(k).transpose() / self.values[k];
            covariance.ger(1.0, &v, &v, 1.0);
        }
        covariance
    }
}

/// Shares of unit combinations below this are rounding.
const NO_SHARE: f64 = 1e-9;

/// Combines the rows, by Gauss and Jordan with complete pivoting, so that each has a column that is zero in
/// all others.
pub(crate) fn own_parameters(rows: &mut DMatrix<f64>) {
    for k in 0..rows.nrows() {
        let below = rows.rows(k, rows.nrows() - k).iamax_full();
        let (pivot, column) = (k + below.0, below.1);
        // The rows that are left have no share in these columns.
        if rows[(pivot, column)].abs() < NO_SHARE {
            break;
        }
        rows.swap_rows(k, pivot);
        let own = rows.row(k) / rows[(k, column)];
        rows.set_row(k, &own);
        for other in (0..rows.nrows()).filter(|other| *other != k) {
            let share = rows[(other, column)];
            let mut row = rows.row_mut(other);
            row -= &own * share;
        }
    }
}
