//! The operations that equations ask of a kind of number.
//!
//! The equations are written once over these traits, for doubles, intervals, dual numbers and the lanes of a
//! vector unit.

use std::ops::{Add, Div, Mul, Neg, Sub};

/// Numbers for formulas without branches: they have sums, products, quotients and square roots.
pub trait Number:
    Copy
    + Add<Output = Self>
    + Sub<Output = Self>
    + Mul<Output = Self>
    + Div<Output = Self>
    + Neg<Output = Self>
    + Add<f64, Output = Self>
    + Mul<f64, Output = Self>
{
    /// The constant `value`, of the kind of this number and on its vector unit.
    fn constant(self, value: f64) -> Self;

    /// 1/x.
    fn recip(self) -> Self;

    /// Square root of a number that is not negative.
    fn sqrt(self) -> Self;

    /// This number, known to within `error` only, as the remainder of a series.
    ///
    /// Kinds of number that do not bound errors ignore it.
    #[inline(always)]
    fn within(self, error: f64) -> Self {
        let _ = error;
        self
    }
}

/// Numbers that choose between equivalent formulas.
///
/// Those for several cables at a time cannot branch: a comparison has an answer for each.
pub trait Lanewise: Number {
    /// An answer for each cable.
    type Mask: Copy;

    /// Whether a number is at most `bound`; false for NaN, and for an interval that reaches beyond it.
    fn at_most(self, bound: f64) -> Self::Mask;

    /// Whether the answer is yes for all.
    fn all(mask: Self::Mask) -> bool;

    /// One of two numbers for each.
    fn select(mask: Self::Mask, chosen: Self, otherwise: Self) -> Self;
}

/// Numbers for formulas with branches: a double, an interval of doubles, a double with its derivative.
pub trait Real: Lanewise<Mask = bool> {
    /// The exact number `value`.
    fn of(value: f64) -> Self;

    /// A double nearby, which decides between two equivalent formulas.
    fn value(self) -> f64;
}

impl Number for f64 {
    #[inline(always)]
    fn constant(self, value: f64) -> Self {
        value
    }

    #[inline(always)]
    fn recip(self) -> Self {
        1.0 / self
    }

    #[inline(always)]
    fn sqrt(self) -> Self {
        Self::sqrt(self)
    }
}

impl Lanewise for f64 {
    type Mask = bool;

    #[inline(always)]
    fn at_most(self, bound: f64) -> bool {
        self <= bound
    }

    #[inline(always)]
    fn all(mask: bool) -> bool {
        mask
    }

    #[inline(always)]
    fn select(mask: bool, chosen: Self, otherwise: Self) -> Self {
        if mask { chosen } else { otherwise }
    }
}

impl Real for f64 {
    #[inline(always)]
    fn of(value: f64) -> Self {
        value
    }

    #[inline(always)]
    fn value(self) -> f64 {
        self
    }
}
