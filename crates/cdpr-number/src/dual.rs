//! Numbers with their derivatives with respect to N inputs, over any kind of number.

// Indices: iterators of two arrays at a time take the compiler minutes in lanes.
#![allow(clippy::needless_range_loop)]

use crate::number::{Lanewise, Number, Real};
use std::ops::{Add, Div, Mul, Neg, Sub};

/// A number with its exact first derivatives with respect to N inputs, carried through every operation.
///
/// Dual numbers of dual numbers have second derivatives.
// Loops instead of closures, which may be compiled without the vector unit of their caller.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Dual<T, const N: usize> {
    /// The number.
    pub value: T,
    /// Its derivative with respect to each input.
    pub slopes: [T; N],
}

impl<T: Number, const N: usize> Dual<T, N> {
    /// A number that depends on no input.
    #[inline(always)]
    pub fn constant(value: T) -> Self {
        Self { value, slopes: [value.constant(0.0); N] }
    }

    /// The input number `input`: its derivative with respect to itself is one.
    #[inline(always)]
    pub fn input(value: T, input: usize) -> Self {
        let mut slopes = [value.constant(0.0); N];
        slopes[input] = value.constant(1.0);
        Self { value, slopes }
    }

    /// f(x) from its value and derivative at `self.value`.
    #[inline(always)]
    fn chain(self, value: T, slope: T) -> Self {
        let mut slopes = self.slopes;
        for own in &mut slopes {
            *own = slope * *own;
        }
        Self { value, slopes }
    }

    /// f(x, y) from its value and its derivatives with respect to both.
    #[inline(always)]
    fn combined(self, other: Self, value: T, [a, b]: [T; 2]) -> Self {
        let mut slopes = self.slopes;
        for k in 0..N {
            slopes[k] = a * slopes[k] + b * other.slopes[k];
        }
        Self { value, slopes }
    }
}

impl<T: Number, const N: usize> Add for Dual<T, N> {
    type Output = Self;
    #[inline(always)]
    fn add(self, other: Self) -> Self {
        let mut slopes = self.slopes;
        for k in 0..N {
            slopes[k] = slopes[k] + other.slopes[k];
        }
        Self { value: self.value + other.value, slopes }
    }
}

impl<T: Number, const N: usize> Sub for Dual<T, N> {
    type Output = Self;
    #[inline(always)]
    fn sub(self, other: Self) -> Self {
        let mut slopes = self.slopes;
        for k in 0..N {
            slopes[k] = slopes[k] - other.slopes[k];
        }
        Self { value: self.value - other.value, slopes }
    }
}

impl<T: Number, const N: usize> Mul for Dual<T, N> {
    type Output = Self;
    #[inline(always)]
    fn mul(self, other: Self) -> Self {
        self.combined(other, self.value * other.value, [other.value, self.value])
    }
}

impl<T: Number, const N: usize> Div for Dual<T, N> {
    type Output = Self;
    #[inline(always)]
    fn div(self, other: Self) -> Self {
        let (value, inverse) = (self.value / other.value, other.value.recip());
        self.combined(other, value, [inverse, -(value * inverse)])
    }
}

impl<T: Number, const N: usize> Neg for Dual<T, N> {
    type Output = Self;
    #[inline(always)]
    fn neg(self) -> Self {
        let mut slopes = self.slopes;
        for own in &mut slopes {
            *own = -*own;
        }
        Self { value: -self.value, slopes }
    }
}

impl<T: Number, const N: usize> Add<f64> for Dual<T, N> {
    type Output = Self;
    #[inline(always)]
    fn add(self, other: f64) -> Self {
        Self { value: self.value + other, ..self }
    }
}

impl<T: Number, const N: usize> Mul<f64> for Dual<T, N> {
    type Output = Self;
    #[inline(always)]
    fn mul(self, other: f64) -> Self {
        let mut slopes = self.slopes;
        for own in &mut slopes {
            *own = *own * other;
        }
        Self { value: self.value * other, slopes }
    }
}

impl<T: Number, const N: usize> Number for Dual<T, N> {
    #[inline(always)]
    fn constant(self, value: f64) -> Self {
        Self::constant(self.value.constant(value))
    }

    #[inline(always)]
    fn recip(self) -> Self {
        let value = self.value.recip();
        self.chain(value, -(value * value))
    }

    #[inline(always)]
    fn sqrt(self) -> Self {
        let value = self.value.sqrt();
        self.chain(value, (value * 2.0).recip())
    }

    #[inline(always)]
    fn within(self, error: f64) -> Self {
        Self { value: self.value.within(error), ..self }
    }
}

impl<T: Lanewise, const N: usize> Lanewise for Dual<T, N> {
    type Mask = T::Mask;

    #[inline(always)]
    fn at_most(self, bound: f64) -> T::Mask {
        self.value.at_most(bound)
    }

    #[inline(always)]
    fn all(mask: T::Mask) -> bool {
        T::all(mask)
    }

    #[inline(always)]
    fn select(mask: T::Mask, chosen: Self, otherwise: Self) -> Self {
        let mut slopes = chosen.slopes;
        for k in 0..N {
            slopes[k] = T::select(mask, slopes[k], otherwise.slopes[k]);
        }
        Self { value: T::select(mask, chosen.value, otherwise.value), slopes }
    }
}

impl<T: Real, const N: usize> Real for Dual<T, N> {
    fn of(value: f64) -> Self {
        Self { value: T::of(value), slopes: [T::of(0.0); N] }
    }

    fn value(self) -> f64 {
        self.value.value()
    }
}
