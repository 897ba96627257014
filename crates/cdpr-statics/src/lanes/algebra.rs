//! Vectors and systems of six equations in lanes.

use crate::equations::vector::{dot, wrench};
use crate::lanes::simd::{Lanes, Mask, Simd};
use cdpr_cable::kernel::Field;
use cdpr_robot::Freedoms;

/// A vector in a cable's vertical plane: along e_h, along e_z.
pub(crate) type Lanes2<S> = [Lanes<S>; 2];

/// A point or a vector in the base frame.
pub(crate) type Lanes3<S> = [Lanes<S>; 3];

/// Force and moment about P, or translation and rotation.
pub(crate) type Lanes6<S> = [Lanes<S>; 6];

/// Six rows of six.
pub(crate) type Lanes6x6<S> = [[Lanes<S>; 6]; 6];

/// Three components of one formula. Closures may be compiled apart from their caller, without the vector
/// unit.
macro_rules! three {
    (|$k:ident| $component:expr) => {
        $crate::lanes::algebra::components!(|$k| $component; 0, 1, 2)
    };
}

/// Six components of one formula.
macro_rules! six {
    (|$k:ident| $component:expr) => {
        $crate::lanes::algebra::components!(|$k| $component; 0, 1, 2, 3, 4, 5)
    };
}

macro_rules! components {
    (|$k:ident| $component:expr; $($index:literal),+) => {
        [$({
            let $k: usize = $index;
            $component
        }),+]
    };
}

/// Factors Uᵀ D U of a symmetric matrix, U with ones on its diagonal.
#[derive(Clone, Copy)]
pub(crate) struct SymmetricFactors<S: Simd> {
    /// U above the diagonal; the other elements are not used.
    upper: Lanes6x6<S>,
    /// 1/D.
    pivots_inv: [Lanes<S>; 6],
    /// Whether the matrix is positive definite.
    pub(crate) positive: Mask<S>,
}

impl<S: Simd> SymmetricFactors<S> {
    /// Factors of a matrix, of which the upper triangle is read.
    // Indices as in the formula.
    #[allow(clippy::needless_range_loop)]
    #[inline(always)]
    pub(crate) fn new(matrix: Lanes6x6<S>) -> Self {
        let mut upper = matrix;
        let mut pivots_inv = [upper[0][0]; 6];
        let tiny = upper[0][0].all(f64::MIN_POSITIVE);
        let mut positive = tiny.less_or_equal(upper[0][0]);
        for k in 0..6 {
            positive = positive & tiny.less_or_equal(upper[k][k]);
            pivots_inv[k] = upper[k][k].recip();
            for row in k + 1..6 {
                let share = upper[k][row] * pivots_inv[k];
                for column in row..6 {
                    upper[row][column] -= share * upper[k][column];
                }
            }
            for column in k + 1..6 {
                upper[k][column] = upper[k][column] * pivots_inv[k];
            }
        }
        Self { upper, pivots_inv, positive }
    }

    /// The lanes in which every pivot is more than `share` of its element of `diagonal`, that of the matrix
    /// itself: others lost as many digits, or are singular.
    #[inline(always)]
    pub(crate) fn is_regular(&self, diagonal: &Lanes6<S>, share: f64) -> Mask<S> {
        let most = diagonal[0].all(share.recip());
        let mut regular = most.less_or_equal(most);
        for (element, pivot_inv) in diagonal.iter().zip(&self.pivots_inv) {
            regular = regular & (*element * *pivot_inv).abs().less_or_equal(most);
        }
        regular
    }

    /// The upper triangle of the matrix itself; the other elements are zero.
    // Indices as in the formula.
    #[allow(clippy::needless_range_loop)]
    #[inline(always)]
    pub(crate) fn product(&self) -> Lanes6x6<S> {
        let zero = self.pivots_inv[0].all(0.0);
        let mut matrix = [[zero; 6]; 6];
        for k in 0..6 {
            let mut of_k = [zero; 6];
            of_k[k] = zero + 1.0;
            of_k[k + 1..].copy_from_slice(&self.upper[k][k + 1..]);
            let pivot = self.pivots_inv[k].recip();
            for row in k..6 {
                let share = of_k[row] * pivot;
                for column in row..6 {
                    matrix[row][column] += share * of_k[column];
                }
            }
        }
        matrix
    }

    /// Takes over another one in the lanes that are `going`.
    #[inline(always)]
    pub(crate) fn replace(&mut self, other: &Self, going: Mask<S>) {
        for row in 0..6 {
            for column in row + 1..6 {
                self.upper[row][column].replace(other.upper[row][column], going);
            }
        }
        replace(&mut self.pivots_inv, &other.pivots_inv, going);
        self.positive = (going & other.positive) | (!going & self.positive);
    }

    #[inline(always)]
    pub(crate) fn solve(&self, right: &Lanes6<S>) -> Lanes6<S> {
        let mut x = self.forwards(right);
        for row in (0..6).rev() {
            x[row] = x[row] * self.pivots_inv[row];
            for column in row + 1..6 {
                x[row] -= self.upper[row][column] * x[column];
            }
        }
        x
    }

    /// U⁻ᵀ times a vector.
    #[inline(always)]
    fn forwards(&self, right: &Lanes6<S>) -> Lanes6<S> {
        let mut x = *right;
        for row in 1..6 {
            for column in 0..row {
                x[row] -= self.upper[column][row] * x[column];
            }
        }
        x
    }

    /// D^-½ U⁻ᵀ K U⁻¹ D^-½ for a symmetric matrix K, of which the upper triangle is read: with this one as
    /// M, its eigenvalues are those of `K v = λ M v`.
    // Indices as in the formula.
    #[allow(clippy::needless_range_loop)]
    #[inline(always)]
    pub(crate) fn reduced(&self, matrix: &Lanes6x6<S>) -> Lanes6x6<S> {
        let roots = six!(|k| self.pivots_inv[k].sqrt());
        let mut rows = *matrix;
        for row in 1..6 {
            for column in 0..row {
                rows[row][column] = matrix[column][row];
            }
        }
        for _ in 0..2 {
            let mut columns = rows;
            for i in 0..6 {
                let solved = self.forwards(&rows[i]);
                for j in 0..6 {
                    columns[j][i] = solved[j] * roots[j];
                }
            }
            rows = columns;
        }
        rows
    }
}

/// The solution of six equations whose matrix has the columns `columns`, by orthogonalisation: it needs no
/// choice of pivots, which lanes cannot make.
// Indices as in the formula.
#[allow(clippy::needless_range_loop)]
#[inline(always)]
pub(crate) fn solve_columns<S: Simd>(columns: &Lanes6x6<S>, right: &Lanes6<S>) -> Lanes6<S> {
    let (mut columns, mut right) = (*columns, *right);
    let mut upper = columns;
    let mut x = right;
    for k in 0..6 {
        let column = columns[k];
        let inverse = dot(&column, &column).recip();
        for later in k + 1..6 {
            let share = dot(&column, &columns[later]) * inverse;
            upper[k][later] = share;
            for row in 0..6 {
                columns[later][row] -= column[row] * share;
            }
        }
        x[k] = dot(&column, &right) * inverse;
        for row in 0..6 {
            right[row] -= column[row] * x[k];
        }
    }
    for k in (0..6).rev() {
        for later in k + 1..6 {
            x[k] -= upper[k][later] * x[later];
        }
    }
    x
}

/// The columns of a frame.
pub(crate) type Frame<S> = [Lanes3<S>; 3];

/// R v.
#[inline(always)]
pub(crate) fn rotated<S: Simd>(frame: &Frame<S>, v: &Lanes3<S>) -> Lanes3<S> {
    three!(|k| v[0] * frame[0][k] + v[1] * frame[1][k] + v[2] * frame[2][k])
}

pub(crate) use {components, six, three};

#[inline(always)]
pub(crate) fn halves<S: Simd>(wrench: &Lanes6<S>) -> (Lanes3<S>, Lanes3<S>) {
    (three!(|k| wrench[k]), three!(|k| wrench[3 + k]))
}

/// A wrench or a twist without its components along the motions that are held.
#[inline(always)]
pub(crate) fn hold<S: Simd>(freedoms: Freedoms, v: Lanes6<S>) -> Lanes6<S> {
    if freedoms.are_all() {
        return v;
    }
    six!(|k| if freedoms.contains(k) { v[k] } else { v[k].all(0.0) })
}

/// The same of the upper triangle of a matrix, with `diagonal` for those motions.
#[inline(always)]
pub(crate) fn hold_matrix<S: Simd>(freedoms: Freedoms, matrix: &mut Lanes6x6<S>, diagonal: Lanes<S>) {
    if freedoms.are_all() {
        return;
    }
    for (row, elements) in matrix.iter_mut().enumerate() {
        match freedoms.contains(row) {
            true => *elements = hold(freedoms, *elements),
            false => {
                *elements = [diagonal.all(0.0); 6];
                elements[row] = diagonal;
            }
        }
    }
}

/// Takes over other components in the lanes that are `going`.
#[inline(always)]
pub(crate) fn replace<S: Simd, const N: usize>(
    own: &mut [Lanes<S>; N],
    other: &[Lanes<S>; N],
    going: Mask<S>,
) {
    for k in 0..N {
        own[k].replace(other[k], going);
    }
}

/// Adds [F; s x F].
#[inline(always)]
pub(crate) fn add<S: Simd>(sum: &mut Lanes6<S>, arm: &Lanes3<S>, force: &Lanes3<S>) {
    let wrench = wrench(arm, force);
    for k in 0..6 {
        sum[k] += wrench[k];
    }
}
