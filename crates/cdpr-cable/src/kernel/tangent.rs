//! Numbers with a derivative along one direction, over any kind of number for several cables at a time.

use super::field::{Field, Lanewise};
use std::ops::{Add, Div, Mul, Neg, Sub};

/// A number with its derivative along one direction, carried through every operation.
///
/// Tangents of tangents have second derivatives: `slope.slope` is the one along both directions.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Tangent<T> {
    /// The number.
    pub value: T,
    /// Its derivative.
    pub slope: T,
}

impl<T: Field> Tangent<T> {
    /// A number that does not change along the direction.
    #[inline(always)]
    pub fn constant(value: T) -> Self {
        Self { value, slope: value * 0.0 }
    }

    /// A number that the direction changes by itself.
    #[inline(always)]
    pub fn input(value: T) -> Self {
        Self { value, slope: value * 0.0 + 1.0 }
    }
}

impl<T: Field> Add for Tangent<T> {
    type Output = Self;
    #[inline(always)]
    fn add(self, other: Self) -> Self {
        Self { value: self.value + other.value, slope: self.slope + other.slope }
    }
}

impl<T: Field> Sub for Tangent<T> {
    type Output = Self;
    #[inline(always)]
    fn sub(self, other: Self) -> Self {
        Self { value: self.value - other.value, slope: self.slope - other.slope }
    }
}

impl<T: Field> Mul for Tangent<T> {
    type Output = Self;
    #[inline(always)]
    fn mul(self, other: Self) -> Self {
        let slope = self.slope * other.value + self.value * other.slope;
        Self { value: self.value * other.value, slope }
    }
}

impl<T: Field> Div for Tangent<T> {
    type Output = Self;
    #[inline(always)]
    fn div(self, other: Self) -> Self {
        let inverse = other.value.recip();
        let value = self.value / other.value;
        Self { value, slope: (self.slope - value * other.slope) * inverse }
    }
}

impl<T: Field> Neg for Tangent<T> {
    type Output = Self;
    #[inline(always)]
    fn neg(self) -> Self {
        Self { value: -self.value, slope: -self.slope }
    }
}

impl<T: Field> Add<f64> for Tangent<T> {
    type Output = Self;
    #[inline(always)]
    fn add(self, other: f64) -> Self {
        Self { value: self.value + other, ..self }
    }
}

impl<T: Field> Mul<f64> for Tangent<T> {
    type Output = Self;
    #[inline(always)]
    fn mul(self, other: f64) -> Self {
        Self { value: self.value * other, slope: self.slope * other }
    }
}

impl<T: Field> Field for Tangent<T> {
    #[inline(always)]
    fn recip(self) -> Self {
        let value = self.value.recip();
        Self { value, slope: -(value * value * self.slope) }
    }

    #[inline(always)]
    fn sqrt(self) -> Self {
        let value = self.value.sqrt();
        Self { value, slope: self.slope * (value * 2.0).recip() }
    }
}

impl<T: Lanewise> Lanewise for Tangent<T> {
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
        Self {
            value: T::select(mask, chosen.value, otherwise.value),
            slope: T::select(mask, chosen.slope, otherwise.slope),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::kernel::lane_end;
    use approx::assert_relative_eq;

    #[test]
    fn tangents_of_tangents_are_mixed_derivatives_of_a_cable() {
        // d²z/dw dfx of a sagging cable, against differences of exact first derivatives.
        let (w, flexibility, length, [fx, fz]) = (1.3, 1e-6, 40.0, [25.0, 31.0]);
        let per_weight = |fx: f64| {
            let [f, l, x, z] = [flexibility, length, fx, fz].map(Tangent::constant);
            lane_end(Tangent::input(w), f, l, [x, z]).end[1].slope
        };
        let [f, l, z] = [flexibility, length, fz].map(Tangent::constant).map(Tangent::constant);
        let along = Tangent { value: Tangent::constant(fx), slope: Tangent::constant(1.0) };
        let weight = Tangent::constant(Tangent::input(w));
        let end = lane_end(weight, f, l, [along, z]).end[1];
        assert_relative_eq!(end.value.slope, per_weight(fx), max_relative = 1e-15);
        let step = 1e-3;
        let at = |h: f64| (per_weight(fx + h) - per_weight(fx - h)) / (2.0 * h);
        let difference = (4.0 * at(step) - at(2.0 * step)) / 3.0;
        assert_relative_eq!(end.slope.slope, difference, max_relative = 1e-9);
    }
}
