//! Intervals that enclose: every operation is rounded outwards by one unit in the last place, which covers
//! the half unit that IEEE 754 allows `+ - * /` and `sqrt`.
//!
//! An operation without an answer (a division by an interval around zero, the root of a negative number)
//! gives the whole line, with which no proof succeeds. Moore, Kearfott, Cloud, *Introduction to Interval
//! Analysis* (2009), chapter 2.

use crate::number::{Lanewise, Number, Real};
use num_traits::{One, Zero};
use std::ops::{Add, AddAssign, Div, Mul, MulAssign, Neg, Sub, SubAssign};

/// All numbers from `low` to `high`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Interval {
    /// The least of them.
    pub low: f64,
    /// The greatest.
    pub high: f64,
}

impl Interval {
    const LINE: Self = Self { low: f64::NEG_INFINITY, high: f64::INFINITY };

    /// Encloses `low..=high`, both known to half a unit in the last place.
    #[inline]
    fn outward(low: f64, high: f64) -> Self {
        if low.is_nan() || high.is_nan() {
            return Self::LINE;
        }
        Self { low: low.next_down(), high: high.next_up() }
    }

    /// The numbers within `radius` of `middle`.
    #[inline]
    pub fn around(middle: f64, radius: f64) -> Self {
        Self::outward(middle - radius, middle + radius)
    }

    /// How far the interval reaches from `middle`, rounded up.
    #[inline]
    pub fn radius_about(self, middle: f64) -> f64 {
        (self.high - middle).max(middle - self.low).next_up().max(0.0)
    }

    /// The largest absolute value.
    #[inline]
    pub fn magnitude(self) -> f64 {
        self.low.abs().max(self.high.abs())
    }
}

impl Add for Interval {
    type Output = Self;

    #[inline]
    fn add(self, other: Self) -> Self {
        Self::outward(self.low + other.low, self.high + other.high)
    }
}

impl Sub for Interval {
    type Output = Self;

    #[inline]
    fn sub(self, other: Self) -> Self {
        Self::outward(self.low - other.high, self.high - other.low)
    }
}

impl Neg for Interval {
    type Output = Self;

    #[inline]
    fn neg(self) -> Self {
        Self { low: -self.high, high: -self.low }
    }
}

impl Mul for Interval {
    type Output = Self;

    #[inline]
    fn mul(self, other: Self) -> Self {
        if self.is_zero() || other.is_zero() {
            return Self::zero();
        }
        let [a, b, c, d] =
            [self.low * other.low, self.low * other.high, self.high * other.low, self.high * other.high];
        if a.is_nan() || b.is_nan() || c.is_nan() || d.is_nan() {
            return Self::LINE;
        }
        Self::outward(a.min(b).min(c).min(d), a.max(b).max(c).max(d))
    }
}

impl Div for Interval {
    type Output = Self;

    #[inline]
    fn div(self, other: Self) -> Self {
        // Not even zero divided by zero is zero.
        let inverse = other.recip();
        if inverse == Self::LINE { inverse } else { self * inverse }
    }
}

impl Add<f64> for Interval {
    type Output = Self;

    #[inline]
    fn add(self, other: f64) -> Self {
        self + Self::of(other)
    }
}

impl Mul<f64> for Interval {
    type Output = Self;

    #[inline]
    fn mul(self, other: f64) -> Self {
        self * Self::of(other)
    }
}

macro_rules! assigning {
    ($trait:ident, $function:ident, $operator:tt) => {
        impl $trait for Interval {
            #[inline]
            fn $function(&mut self, other: Self) {
                *self = *self $operator other;
            }
        }
    };
}

assigning!(AddAssign, add_assign, +);
assigning!(SubAssign, sub_assign, -);
assigning!(MulAssign, mul_assign, *);

impl Zero for Interval {
    #[inline]
    fn zero() -> Self {
        Self { low: 0.0, high: 0.0 }
    }

    #[inline]
    fn is_zero(&self) -> bool {
        self.low == 0.0 && self.high == 0.0
    }
}

impl One for Interval {
    #[inline]
    fn one() -> Self {
        Self { low: 1.0, high: 1.0 }
    }
}

impl Number for Interval {
    #[inline]
    fn constant(self, value: f64) -> Self {
        Self::of(value)
    }

    #[inline]
    fn recip(self) -> Self {
        if self.low <= 0.0 && self.high >= 0.0 {
            return Self::LINE;
        }
        Self::outward(1.0 / self.high, 1.0 / self.low)
    }

    #[inline]
    fn sqrt(self) -> Self {
        if self.low < 0.0 { Self::LINE } else { Self::outward(self.low.sqrt(), self.high.sqrt()) }
    }

    #[inline]
    fn within(self, error: f64) -> Self {
        self + Self::around(0.0, error)
    }
}

impl Lanewise for Interval {
    type Mask = bool;

    #[inline]
    fn at_most(self, bound: f64) -> bool {
        self.high <= bound
    }

    #[inline]
    fn all(mask: bool) -> bool {
        mask
    }

    #[inline]
    fn select(mask: bool, chosen: Self, otherwise: Self) -> Self {
        if mask { chosen } else { otherwise }
    }
}

impl Real for Interval {
    #[inline]
    fn of(value: f64) -> Self {
        if value.is_nan() { Self::LINE } else { Self { low: value, high: value } }
    }

    #[inline]
    fn value(self) -> f64 {
        0.5 * (self.low + self.high)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn encloses(interval: Interval, value: f64) -> bool {
        interval.low <= value && value <= interval.high
    }

    #[test]
    fn a_division_around_zero_and_the_root_of_a_negative_number_are_the_whole_line() {
        let around_zero = Interval { low: -1.0, high: 2.0 };
        assert_eq!(Interval::one() / around_zero, Interval::LINE);
        assert_eq!(around_zero.sqrt(), Interval::LINE);
        assert_eq!(Interval::of(f64::NAN), Interval::LINE);
        assert_eq!(Interval::LINE * Interval::of(0.0), Interval::of(0.0));
    }

    #[test]
    fn a_third_is_enclosed_though_no_double_is_one() {
        let third = Interval::one() / Interval::of(3.0);
        assert!(third.low < 1.0 / 3.0 && 1.0 / 3.0 <= third.high && third.high - third.low < 1e-15);
        let one = third + third + third;
        assert!(encloses(one, 1.0) && one.high - one.low < 2e-15);
    }

    proptest! {
        #![proptest_config(ProptestConfig { failure_persistence: None, ..ProptestConfig::default() })]

        /// What rounding takes away from sums and products of doubles is exactly known, and inside.
        #[test]
        fn rounding_goes_outwards(a in -1e3..1e3f64, b in -1e3..1e3f64) {
            let inside = |interval: Interval, rounded: f64, error: f64| {
                encloses(interval, rounded)
                    && (error <= 0.0 || rounded < interval.high)
                    && (error >= 0.0 || interval.low < rounded)
            };
            let (x, y) = (Interval::of(a), Interval::of(b));
            let product = a * b;
            prop_assert!(inside(x * y, product, a.mul_add(b, -product)));
            // Knuth's sum of two numbers.
            let sum = a + b;
            let b_rounded = sum - a;
            prop_assert!(inside(x + y, sum, (a - (sum - b_rounded)) + (b - b_rounded)));
            let quotient = a / b;
            prop_assert!(b == 0.0 || inside(x / y, quotient, -quotient.mul_add(b, -a) * b.signum()));
            let root = a.abs().sqrt();
            prop_assert!(inside(Interval::of(a.abs()).sqrt(), root, -root.mul_add(root, -a.abs())));
        }

        /// Every pair of members has its result inside.
        #[test]
        fn operations_enclose_those_of_their_members(
            a in -1e3..1e3f64, b in -1e3..1e3f64, ra in 0.0..10.0f64, rb in 0.0..10.0f64,
            s in -1.0..1.0f64, t in -1.0..1.0f64,
        ) {
            let (x, y) = (Interval::around(a, ra), Interval::around(b, rb));
            let (u, v) = (a + s * ra, b + t * rb);
            prop_assert!(encloses(x + y, u + v));
            prop_assert!(encloses(x - y, u - v));
            prop_assert!(encloses(x * y, u * v));
            prop_assert!(encloses(x / y, u / v) || v == 0.0);
            prop_assert!(encloses((x * x).sqrt(), u.abs()) || (x * x).low < 0.0);
            prop_assert!(encloses(x.within(0.5), u + 0.5 * s));
        }
    }
}
