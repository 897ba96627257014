//! What the equations of the catenary ask of a number, so that they stand once for floating point, intervals, dual numbers or
//! the lanes of a vector unit.

use std::ops::{Add, Div, Mul, Neg, Sub};

/// Numbers for formulas without a choice: sums, products, quotients and roots.
pub trait Field:
    Copy
    + Add<Output = Self>
    + Sub<Output = Self>
    + Mul<Output = Self>
    + Div<Output = Self>
    + Neg<Output = Self>
    + Add<f64, Output = Self>
    + Mul<f64, Output = Self>
{
    /// 1/x.
    fn recip(self) -> Self;

    /// Square root of a number that is not negative.
    fn sqrt(self) -> Self;
}

/// A kind of real number: a double, an interval of them, a number with its derivative.
pub trait Real: Field {
    /// The exact number `value`.
    fn of(value: f64) -> Self;

    /// A double nearby: decides which of two equivalent formulas is used.
    fn value(self) -> f64;

    /// A double that it does not exceed.
    fn upper(self) -> f64;

    /// Natural logarithm of a positive number.
    fn ln(self) -> Self;

    /// This number, known to within `error` only: the rest of a series. Kinds that do not bound errors ignore it.
    fn within(self, error: f64) -> Self;
}

impl Field for f64 {
    fn recip(self) -> Self {
        1.0 / self
    }

    fn sqrt(self) -> Self {
        Self::sqrt(self)
    }
}

impl Real for f64 {
    fn of(value: f64) -> Self {
        value
    }

    fn value(self) -> f64 {
        self
    }

    fn upper(self) -> f64 {
        self
    }

    fn ln(self) -> Self {
        Self::ln(self)
    }

    fn within(self, _error: f64) -> Self {
        self
    }
}
