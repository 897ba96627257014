//! Dual numbers: a double with its derivatives with respect to N inputs.

use super::field::{Field, Real};
use std::array::from_fn;
use std::ops::{Add, Div, Mul, Neg, Sub};

/// A double with its exact first derivatives with respect to N inputs, carried through every operation.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Dual<const N: usize> {
    /// The number.
    pub value: f64,
    /// Its derivative with respect to each input.
    pub slopes: [f64; N],
}

impl<const N: usize> Dual<N> {
    /// The input number `input`: its derivative with respect to itself is one.
    pub fn input(value: f64, input: usize) -> Self {
        Self { value, slopes: from_fn(|k| f64::from(k == input)) }
    }

    /// f(x) from its value and derivative at `self.value`.
    #[inline(always)]
    fn chain(self, value: f64, slope: f64) -> Self {
        Self { value, slopes: self.slopes.map(|own| slope * own) }
    }

    /// f(x, y) from its value and its derivatives with respect to both.
    #[inline(always)]
    fn combined(self, other: Self, value: f64, [a, b]: [f64; 2]) -> Self {
        Self { value, slopes: from_fn(|k| a * self.slopes[k] + b * other.slopes[k]) }
    }
}

impl<const N: usize> Add for Dual<N> {
    type Output = Self;
    #[inline(always)]
    fn add(self, other: Self) -> Self {
        self.combined(other, self.value + other.value, [1.0, 1.0])
    }
}

impl<const N: usize> Sub for Dual<N> {
    type Output = Self;
    #[inline(always)]
    fn sub(self, other: Self) -> Self {
        self + -other
    }
}

impl<const N: usize> Mul for Dual<N> {
    type Output = Self;
    #[inline(always)]
    fn mul(self, other: Self) -> Self {
        self.combined(other, self.value * other.value, [other.value, self.value])
    }
}

impl<const N: usize> Div for Dual<N> {
    type Output = Self;
    #[inline(always)]
    fn div(self, other: Self) -> Self {
        let (value, inverse) = (self.value / other.value, 1.0 / other.value);
        self.combined(other, value, [inverse, -value * inverse])
    }
}

impl<const N: usize> Neg for Dual<N> {
    type Output = Self;
    #[inline(always)]
    fn neg(self) -> Self {
        self.chain(-self.value, -1.0)
    }
}

impl<const N: usize> Add<f64> for Dual<N> {
    type Output = Self;
    #[inline(always)]
    fn add(self, other: f64) -> Self {
        Self { value: self.value + other, ..self }
    }
}

impl<const N: usize> Mul<f64> for Dual<N> {
    type Output = Self;
    #[inline(always)]
    fn mul(self, other: f64) -> Self {
        self.chain(self.value * other, other)
    }
}

impl<const N: usize> Field for Dual<N> {
    #[inline(always)]
    fn recip(self) -> Self {
        let value = 1.0 / self.value;
        self.chain(value, -value * value)
    }

    #[inline(always)]
    fn sqrt(self) -> Self {
        let value = self.value.sqrt();
        self.chain(value, 0.5 / value)
    }
}

impl<const N: usize> Real for Dual<N> {
    fn of(value: f64) -> Self {
        Self { value, slopes: [0.0; N] }
    }

    fn value(self) -> f64 {
        self.value
    }

    fn upper(self) -> f64 {
        self.value
    }

    fn ln(self) -> Self {
        self.chain(self.value.ln(), 1.0 / self.value)
    }

    fn atan2(self, x: Self) -> Self {
        let square = self.value * self.value + x.value * x.value;
        self.combined(x, self.value.atan2(x.value), [x.value / square, -self.value / square])
    }

    fn within(self, _error: f64) -> Self {
        self
    }
}
