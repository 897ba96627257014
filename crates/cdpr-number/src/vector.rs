//! Vectors in space over any kind of number, and the wrench of a force.
//!
//! Arrays, because the lanes of a vector unit are no scalars of nalgebra.

use crate::number::Number;

/// a x b.
#[inline(always)]
pub fn cross<T: Number>(a: &[T; 3], b: &[T; 3]) -> [T; 3] {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}

/// a·b.
#[inline(always)]
pub fn dot<T: Number, const N: usize>(a: &[T; N], b: &[T; N]) -> T {
    let mut sum = a[0] * b[0];
    for k in 1..N {
        sum = sum + a[k] * b[k];
    }
    sum
}

/// Wrench [F; s x F] about P of a force F at the arm s.
#[inline(always)]
pub fn wrench<T: Number>(arm: &[T; 3], force: &[T; 3]) -> [T; 6] {
    let ([x, y, z], [mx, my, mz]) = (*force, cross(arm, force));
    [x, y, z, mx, my, mz]
}
