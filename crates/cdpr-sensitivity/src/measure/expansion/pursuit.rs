//! Sparse least squares by orthogonal matching pursuit. The leave-one-out error decides the number of terms.
//!
//! An observation has one row, that of its value, or further ones of its derivatives before it. With r the
//! residual, the next column is the one with the largest correlation with r. The chosen columns are kept
//! factored, X = Q R, so that each step costs one pass over the candidates:
//!
//! ```text
//! j = argmax |x_j · r| / |x_j|                                            (Pu1)
//! r ← r - (q · r) q,   q = x_j less its projections on Q, normalized      (Pu2)
//! H_i = Q_i Q_iᵀ,   e_i = (1 - H_i)⁻¹ r_i                                 (Pu3)
//! ε = mean(e_i²) / Var y · N / (N - P) · (1 + tr (Xᵀ X)⁻¹)                (Pu4)
//! |x_j · r| / |x_j| ≤ √(2 ln p) |r| / √(N - P)                            (Pu5)
//! ```
//!
//! - (Pu1), (Pu2): Y. C. Pati, R. Rezaiifar, P. S. Krishnaprasad, *Orthogonal matching pursuit* (1993).
//! - (Pu3): residuals of a fit without observation i, which follow from one fit of all by the rows `Q_i` and
//!   `r_i` of the observation. All of its rows are left out together: its derivatives would tell its value.
//! - (Pu4) is the leave-one-out error of the values with P terms and N rows, times the correction of O.
//!   Chapelle, V. Vapnik, Y. Bengio, *Model selection for small sample regression* (2002). G. Blatman and B.
//!   Sudret (2011) choose the terms of chaos expansions in this way.
//! - (Pu5) ends the path: T. T. Cai, L. Wang, *Orthogonal matching pursuit for sparse signal recovery with
//!   noise*, IEEE Trans. Inf. Theory 57 (2011).
//!
//! (Pu4) does not account for the choice among candidates. The best of p candidates fits even noise, and many
//! such terms make ε too small by a third. The path therefore ends where the best of the p candidates
//! correlates no better than the best of p candidates would with noise.

use crate::parallel::*;
use crate::sample::summary::Spread;

/// Sparse least-squares model.
pub(crate) struct Pursuit {
    pub(crate) constant: f64,
    /// Indices of the candidates and their coefficients.
    pub(crate) terms: Vec<(usize, f64)>,
    /// Error ε (Pu4).
    pub(crate) error: f64,
}

/// A candidate: its rows of some kinds, one per observation each. Those of other kinds are zero.
pub(crate) struct Column(pub(crate) Vec<(usize, Vec<f64>)>);

/// What is fitted: rows by their kind, that of the values being the last, one per observation each.
pub(crate) struct Rows<'a>(pub(crate) Vec<&'a [f64]>);

impl Rows<'_> {
    fn observations(&self) -> usize {
        self.0[0].len()
    }
}

/// Largest number of values of the factor Q: 512 MiB.
const MAX_FACTOR: usize = 1 << 26;

/// Finds the model of the least ε along the path. It has at most half as many terms as there are rows.
///
/// `columns` are the candidates besides the constant. The values are at least two different ones.
pub(crate) fn pursue(columns: &[Column], rows: &Rows) -> Pursuit {
    let (n, kinds) = (rows.observations(), rows.0.len());
    let limit = columns.len().min(n * kinds / 2).min(MAX_FACTOR / (n * kinds));
    let squares = Spread::of(rows.0[kinds - 1]).squares;
    // A column of zeros has no norm, but it correlates with nothing either.
    let square = |column: &Column| column.0.iter().map(|(_, part)| dot(part, part)).sum::<f64>();
    let norm = |column: &Column| square(column).sqrt().max(f64::MIN_POSITIVE);
    let norms: Vec<f64> = columns.par_iter().map(norm).collect();
    let mut open = vec![true; columns.len()];
    let mut path = Path::new(rows);
    let mut chosen = Vec::new();
    let mut best = (path.corrected_error(squares), 0);
    let mut next = 1;
    while chosen.len() < limit && !is_exhausted(best.1, chosen.len(), kinds) {
        let noise = path.noise();
        let Some((j, correlation)) = closest(columns, &norms, &open, &path) else {
            break;
        };
        if correlation <= (2.0 * (columns.len() as f64).ln()).sqrt() * noise {
            break;
        }
        open[j] = false;
        if path.push(&columns[j]) {
            chosen.push(j);
            if chosen.len() < next {
                continue;
            }
            next = if kinds == 1 { next + 1 } else { next + 1 + next / 20 };
            let error = path.corrected_error(squares);
            if error < best.0 {
                best = (error, chosen.len());
            }
        }
    }
    let (error, terms) = best;
    let coefficients = path.coefficients(terms + 1);
    Pursuit {
        constant: coefficients[0],
        terms: chosen.into_iter().zip(coefficients[1..].iter().copied()).collect(),
        error,
    }
}

/// Whether a path with derivatives, whose steps are dear, has not improved on its best model for long.
fn is_exhausted(best: usize, terms: usize, kinds: usize) -> bool {
    kinds > 1 && terms > best + 20 + best / 2
}

/// Next candidate (Pu1) and its correlation, or `None` if no candidate is left.
fn closest(columns: &[Column], norms: &[f64], open: &[bool], path: &Path) -> Option<(usize, f64)> {
    let n = path.observations;
    let product = |(kind, part): &(usize, Vec<f64>)| dot(part, &path.residual[kind * n..(kind + 1) * n]);
    let correlation = |j: usize| (j, columns[j].0.iter().map(product).sum::<f64>().abs() / norms[j]);
    let left: Vec<_> = (0..columns.len()).into_par_iter().filter(|&j| open[j]).map(correlation).collect();
    left.into_iter().reduce(|best, other| if other.1 > best.1 { other } else { best })
}

/// Dot product in eight partial sums, which the processor adds at once.
fn dot(a: &[f64], b: &[f64]) -> f64 {
    let (a_eights, a_rest) = a.as_chunks::<8>();
    let (b_eights, b_rest) = b.as_chunks::<8>();
    let mut sums = [0.0; 8];
    for (a, b) in a_eights.iter().zip(b_eights) {
        for (sum, (a, b)) in sums.iter_mut().zip(a.iter().zip(b)) {
            *sum += a * b;
        }
    }
    sums.iter().sum::<f64>() + a_rest.iter().zip(b_rest).map(|(a, b)| a * b).sum::<f64>()
}

/// Factors X = Q R of the columns chosen so far, with the constant first.
struct Path {
    observations: usize,
    /// Rows of an observation.
    kinds: usize,
    /// Columns of all rows, those of a kind together.
    q: Vec<Vec<f64>>,
    /// Columns of R⁻¹ without their zeros.
    inverse: Vec<Vec<f64>>,
    /// Qᵀ y.
    projections: Vec<f64>,
    residual: Vec<f64>,
    /// Lower triangle of `H_i`, row by row, of all observations each.
    leverages: Vec<f64>,
}

impl Path {
    fn new(rows: &Rows) -> Self {
        let (n, kinds) = (rows.observations(), rows.0.len());
        let mut path = Self {
            observations: n,
            kinds,
            q: vec![],
            inverse: vec![],
            projections: vec![],
            residual: rows.0.concat(),
            leverages: vec![0.0; n * kinds * (kinds + 1) / 2],
        };
        path.push(&Column(vec![(kinds - 1, vec![1.0; n])]));
        path
    }

    /// Adds a column, Eq. (Pu2), unless it depends linearly on the others.
    fn push(&mut self, column: &Column) -> bool {
        /// Least distance of a column from the space of the others, over its length.
        const DEPENDENT: f64 = 1e-8;
        let n = self.observations;
        let mut q = vec![0.0; self.residual.len()];
        column.0.iter().for_each(|(kind, part)| q[kind * n..(kind + 1) * n].copy_from_slice(part));
        let length = dot(&q, &q).sqrt();
        let mut r = vec![0.0; self.q.len()];
        // Gram and Schmidt's method, applied twice, is as orthogonal as Householder's (W. Kahan: "twice is
        // enough").
        for _ in 0..2 {
            for (r, other) in r.iter_mut().zip(&self.q) {
                let projection = dot(&q, other);
                *r += projection;
                add(&mut q, -projection, other);
            }
        }
        let norm = dot(&q, &q).sqrt();
        if norm <= DEPENDENT * length {
            return false;
        }
        q.iter_mut().for_each(|q| *q /= norm);
        let mut inverse = vec![0.0; r.len() + 1];
        inverse[r.len()] = 1.0 / norm;
        for (column, r) in self.inverse.iter().zip(&r) {
            add(&mut inverse, -r / norm, column);
        }
        let projection = dot(&q, &self.residual);
        add(&mut self.residual, -projection, &q);
        let pairs = (0..self.kinds).flat_map(|one| (0..=one).map(move |other| [one, other]));
        for ([one, other], leverages) in pairs.zip(self.leverages.chunks_mut(n)) {
            let [one, other] = [one, other].map(|kind| &q[kind * n..(kind + 1) * n]);
            leverages.iter_mut().zip(one.iter().zip(other)).for_each(|(sum, (a, b))| *sum += a * b);
        }
        self.projections.push(projection);
        self.inverse.push(inverse);
        self.q.push(q);
        true
    }

    /// Deviation of the residual, `|r| / √(N - P)`.
    fn noise(&self) -> f64 {
        (dot(&self.residual, &self.residual) / (self.residual.len() - self.q.len()) as f64).sqrt()
    }

    /// Error ε (Pu4). It is infinite if one value has a leverage of 1.
    fn corrected_error(&self, squares: f64) -> f64 {
        let size = self.residual.len() as f64;
        let left_out = |i: usize| self.left_out(i).map_or(f64::INFINITY, |error| error * error);
        let errors: Vec<f64> = (0..self.observations).into_par_iter().map(left_out).collect();
        let trace: f64 = self.inverse.iter().map(|column| dot(column, column)).sum();
        errors.iter().sum::<f64>() / squares * size / (size - self.q.len() as f64) * (1.0 + trace)
    }

    /// Residual `e_i` (Pu3) of the value of an observation, by the Cholesky factor of 1 - H, whose last row
    /// is that of the value. `None` if the observation alone decides a coefficient.
    fn left_out(&self, i: usize) -> Option<f64> {
        /// A smaller pivot is rounding.
        const NONE: f64 = 1e-12;
        let (n, kinds) = (self.observations, self.kinds);
        let start = |row: usize| row * (row + 1) / 2;
        let mut factor = vec![0.0; start(kinds)];
        let mut solved = vec![0.0; kinds];
        for row in 0..kinds {
            let mut sum = self.residual[row * n + i];
            for column in 0..=row {
                let [own, other] = [row, column].map(|line| &factor[start(line)..start(line) + column]);
                let product: f64 = own.iter().zip(other).map(|(a, b)| a * b).sum();
                let one = if row == column { 1.0 } else { 0.0 };
                let left = one - self.leverages[(start(row) + column) * n + i] - product;
                factor[start(row) + column] = if row == column {
                    if left <= NONE {
                        return None;
                    }
                    left.sqrt()
                } else {
                    let value = left / factor[start(column) + column];
                    sum -= value * solved[column];
                    value
                };
            }
            solved[row] = sum / factor[start(row) + row];
        }
        Some(solved[kinds - 1] / factor[start(kinds - 1) + kinds - 1])
    }

    /// Coefficients R⁻¹ Qᵀ y of the first `count` columns.
    fn coefficients(&self, count: usize) -> Vec<f64> {
        let mut coefficients = vec![0.0; count];
        for (column, projection) in self.inverse[..count].iter().zip(&self.projections) {
            add(&mut coefficients, *projection, column);
        }
        coefficients
    }
}

/// Adds `factor * vector` to the first elements of `sum`.
fn add(sum: &mut [f64], factor: f64, vector: &[f64]) {
    sum.iter_mut().zip(vector).for_each(|(sum, entry)| *sum += factor * entry);
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::measure::linear_algebra::{LeastSquares, least_squares};

    #[test]
    fn the_error_is_that_of_fits_that_leave_out_each_value_and_the_coefficients_are_those_of_householder() {
        let x: Vec<f64> = (0..12).map(|i| (1.7 * f64::from(i)).sin()).collect();
        let y: Vec<f64> = x.iter().enumerate().map(|(i, x)| x + x * x + 0.3 * (i as f64).cos()).collect();
        let columns = [vec![1.0; 12], x.clone(), x.iter().map(|x| x.exp()).collect()];
        let mut path = Path::new(&Rows(vec![&y]));
        let pushed = |path: &mut Path, j: usize| path.push(&Column(vec![(0, columns[j].clone())]));
        assert!(pushed(&mut path, 1) && pushed(&mut path, 2) && !pushed(&mut path, 1));

        let without = |values: &[f64], i: usize| [&values[..i], &values[i + 1..]].concat();
        let left_out = |i: usize| {
            let rest: Vec<_> = columns.iter().map(|column| without(column, i)).collect();
            let LeastSquares { coefficients, .. } =
                least_squares(&rest, &without(&y, i)).unwrap_or_else(|j| panic!("{j}"));
            y[i] - columns.iter().zip(&coefficients).map(|(column, c)| c * column[i]).sum::<f64>()
        };
        let sum: f64 = (0..12).map(|i| left_out(i).powi(2)).sum();
        let whole = least_squares(&columns, &y).unwrap_or_else(|j| panic!("{j}"));
        let squares = Spread::of(&y).squares;
        let corrected = sum / squares * 12.0 / 9.0 * (1.0 + whole.inverse_gram.iter().sum::<f64>());
        assert!((path.corrected_error(squares) / corrected - 1.0).abs() < 1e-10);
        for (one, other) in path.coefficients(3).iter().zip(&whole.coefficients) {
            assert!((one - other).abs() < 1e-12);
        }
        assert!((path.noise().powi(2) * 9.0 / whole.residual_squares - 1.0).abs() < 1e-10);
    }

    #[test]
    fn an_observation_is_left_out_with_its_derivatives() {
        // Values and slopes of sin x at 8 points, by 1, x, x³.
        let x: Vec<f64> = (0..8).map(|i| 0.4 * f64::from(i)).collect();
        let of = |f: &dyn Fn(f64) -> f64| -> Vec<f64> { x.iter().map(|&x| f(x)).collect() };
        let (slopes, values) = (of(&f64::cos), of(&f64::sin));
        let cube = [of(&|x| 3.0 * x * x), of(&|x| x.powi(3))];
        let mut path = Path::new(&Rows(vec![&slopes, &values]));
        assert!(path.push(&Column(vec![(0, vec![1.0; 8]), (1, x.clone())])));
        assert!(path.push(&Column(cube.iter().cloned().enumerate().collect())));

        let stacked = [[vec![0.0; 8], vec![1.0; 8]], [vec![1.0; 8], x.clone()], cube.clone()];
        for i in 0..8 {
            let rest = |parts: &[Vec<f64>; 2]| -> Vec<f64> {
                parts.iter().flat_map(|part| [&part[..i], &part[i + 1..]].concat()).collect()
            };
            let columns: Vec<Vec<f64>> = stacked.iter().map(rest).collect();
            let fitted = least_squares(&columns, &rest(&[slopes.clone(), values.clone()])).unwrap();
            let predicted: f64 = stacked.iter().zip(&fitted.coefficients).map(|(of, c)| c * of[1][i]).sum();
            assert!((path.left_out(i).unwrap() - (values[i] - predicted)).abs() < 1e-12);
        }
    }
}
