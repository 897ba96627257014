//! Vectors and systems of six equations in lanes.

use crate::lanes::{Lanes, Mask, Simd};
use crate::number::Number;
use crate::vector::{dot, wrench};

/// A vector in a cable's vertical plane: along e_h, along e_z.
pub type Lanes2<S> = [Lanes<S>; 2];

/// A point or a vector in the base frame.
pub type Lanes3<S> = [Lanes<S>; 3];

/// Force and moment about P, or translation and rotation.
pub type Lanes6<S> = [Lanes<S>; 6];

/// Six rows of six.
pub type Lanes6x6<S> = [[Lanes<S>; 6]; 6];

/// Components of one formula by these numbers.
#[doc(hidden)]
#[macro_export]
macro_rules! components {
    (|$k:ident| $component:expr; $($number:literal)+) => {
        [$({
            let $k: usize = $number;
            $component
        }),+]
    };
}

/// Three components of one formula. Closures may be compiled apart from their caller, without the vector
/// unit.
#[macro_export(local_inner_macros)]
macro_rules! three {
    (|$k:ident| $component:expr) => {
        components!(|$k| $component; 0 1 2)
    };
}

/// Six components of one formula, as `three`.
#[macro_export(local_inner_macros)]
macro_rules! six {
    (|$k:ident| $component:expr) => {
        components!(|$k| $component; 0 1 2 3 4 5)
    };
}

/// Factors Uᵀ D U of a symmetric matrix, U with ones on its diagonal.
#[derive(Clone, Copy)]
pub struct SymmetricFactors<S: Simd> {
    /// U above the diagonal; the other elements are not used.
    upper: Lanes6x6<S>,
    /// 1/D.
    pivots_inv: [Lanes<S>; 6],
    /// Whether the matrix is positive definite.
    pub positive: Mask<S>,
}

impl<S: Simd> SymmetricFactors<S> {
    /// Factors of a matrix, of which the upper triangle is read.
    // Indices as in the formula.
    #[allow(clippy::needless_range_loop)]
    #[inline(always)]
    pub fn new(matrix: Lanes6x6<S>) -> Self {
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
    pub fn is_regular(&self, diagonal: &Lanes6<S>, share: f64) -> Mask<S> {
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
    pub fn product(&self) -> Lanes6x6<S> {
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

    /// Assigns another one in the lanes that are `active`.
    #[inline(always)]
    pub fn replace(&mut self, other: &Self, active: Mask<S>) {
        for row in 0..6 {
            for column in row + 1..6 {
                self.upper[row][column].replace(other.upper[row][column], active);
            }
        }
        replace(&mut self.pivots_inv, &other.pivots_inv, active);
        self.positive = (active & other.positive) | (!active & self.positive);
    }

    /// The solution for a right side.
    #[inline(always)]
    pub fn solve(&self, right: &Lanes6<S>) -> Lanes6<S> {
        let mut x = *right;
        for row in 1..6 {
            for column in 0..row {
                x[row] -= self.upper[column][row] * x[column];
            }
        }
        for row in (0..6).rev() {
            x[row] = x[row] * self.pivots_inv[row];
            for column in row + 1..6 {
                x[row] -= self.upper[row][column] * x[column];
            }
        }
        x
    }
}

/// The solution of six equations whose matrix has the columns `columns`, by orthogonalization: it needs no
/// choice of pivots, which lanes cannot make.
// Indices as in the formula.
#[allow(clippy::needless_range_loop)]
#[inline(always)]
pub fn solve_columns<S: Simd>(columns: &Lanes6x6<S>, right: &Lanes6<S>) -> Lanes6<S> {
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
pub type Frame<S> = [Lanes3<S>; 3];

/// R v.
#[inline(always)]
pub fn rotated<S: Simd>(frame: &Frame<S>, v: &Lanes3<S>) -> Lanes3<S> {
    three!(|k| v[0] * frame[0][k] + v[1] * frame[1][k] + v[2] * frame[2][k])
}

/// Force and moment of a wrench, or translation and rotation of a twist.
#[inline(always)]
pub fn halves<S: Simd>(wrench: &Lanes6<S>) -> (Lanes3<S>, Lanes3<S>) {
    (three!(|k| wrench[k]), three!(|k| wrench[3 + k]))
}

/// Assigns other components in the lanes that are `active`.
#[inline(always)]
pub fn replace<S: Simd, const N: usize>(own: &mut [Lanes<S>; N], other: &[Lanes<S>; N], active: Mask<S>) {
    for k in 0..N {
        own[k].replace(other[k], active);
    }
}

/// Adds [F; s x F].
#[inline(always)]
pub fn add<S: Simd>(sum: &mut Lanes6<S>, arm: &Lanes3<S>, force: &Lanes3<S>) {
    let wrench = wrench(arm, force);
    for k in 0..6 {
        sum[k] += wrench[k];
    }
}
