//! Every derivative of the catenary against dual numbers: the same equations over a number with derivative.

use cdpr_cable::kernel::{Field, Real, response};
use cdpr_cable::{Cable, Catenary, Vector2, least_tension, length_for_tension};
use proptest::prelude::*;
use std::ops::{Add, Div, Mul, Neg, Sub};

/// A number and its derivative.
#[derive(Clone, Copy)]
struct Dual(f64, f64);

impl Add for Dual {
    type Output = Self;
    fn add(self, b: Self) -> Self {
        Self(self.0 + b.0, self.1 + b.1)
    }
}

impl Sub for Dual {
    type Output = Self;
    fn sub(self, b: Self) -> Self {
        Self(self.0 - b.0, self.1 - b.1)
    }
}

impl Mul for Dual {
    type Output = Self;
    fn mul(self, b: Self) -> Self {
        Self(self.0 * b.0, self.0 * b.1 + self.1 * b.0)
    }
}

impl Div for Dual {
    type Output = Self;
    fn div(self, b: Self) -> Self {
        let quotient = self.0 / b.0;
        Self(quotient, (self.1 - quotient * b.1) / b.0)
    }
}

impl Neg for Dual {
    type Output = Self;
    fn neg(self) -> Self {
        Self(-self.0, -self.1)
    }
}

impl Add<f64> for Dual {
    type Output = Self;
    fn add(self, b: f64) -> Self {
        Self(self.0 + b, self.1)
    }
}

impl Mul<f64> for Dual {
    type Output = Self;
    fn mul(self, b: f64) -> Self {
        Self(self.0 * b, self.1 * b)
    }
}

impl Field for Dual {
    fn recip(self) -> Self {
        Self(1.0, 0.0) / self
    }

    fn sqrt(self) -> Self {
        let root = self.0.sqrt();
        Self(root, 0.5 * self.1 / root)
    }
}

impl Real for Dual {
    fn of(value: f64) -> Self {
        Self(value, 0.0)
    }

    fn value(self) -> f64 {
        self.0
    }

    fn upper(self) -> f64 {
        self.0
    }

    fn ln(self) -> Self {
        Self(self.0.ln(), self.1 / self.0)
    }

    fn within(self, _error: f64) -> Self {
        self
    }
}

/// Derivative of the end position with respect to one of (w, EA, L, fx, fz).
fn dual(catenary: &Catenary, which: usize) -> Vector2<f64> {
    let Catenary { cable, unstrained_length, force } = *catenary;
    let mut inputs = [cable.weight_per_length, cable.axial_stiffness, unstrained_length, force.x, force.y]
        .map(|value| Dual(value, 0.0));
    inputs[which].1 = 1.0;
    let [w, ea, length, fx, fz] = inputs;
    let [x, z] = response(w, ea.recip(), length, [fx, fz]).end;
    Vector2::new(x.1, z.1)
}

/// Cables from taut to folded: weights, stiffnesses, lengths and forces over many decades.
fn any_catenary() -> impl Strategy<Value = Catenary<'static>> {
    (-2.0..2.0f64, 4.0..8.0f64, -0.3..2.0f64, -2.0..3.0f64, -3.0..3.0f64).prop_map(|(w, ea, l, fx, fz)| {
        let cable = Cable::linear(10f64.powf(w), 10f64.powf(ea));
        let length = 10f64.powf(l);
        let weight = cable.weight_per_length * length;
        Catenary {
            cable,
            unstrained_length: length,
            force: Vector2::new(weight * 10f64.powf(fx), weight * fz.sinh()),
        }
    })
}

proptest! {
    #![proptest_config(ProptestConfig {
        cases: 20_000,
        failure_persistence: None,
        ..ProptestConfig::default()
    })]

    #[test]
    fn derivatives_are_those_of_dual_numbers(c in any_catenary()) {
        let compliance = c.compliance();
        let flexibility = compliance.flexibility;
        let derivatives = [
            (c.end_per_weight(), "w"), (c.end_per_stiffness(), "EA"), (compliance.end_per_length, "L"),
            (flexibility.column(0).into(), "fx"), (flexibility.column(1).into(), "fz"),
        ];
        for (which, (derivative, name)) in derivatives.into_iter().enumerate() {
            let expected = dual(&c, which);
            let error = (derivative - expected).norm() / expected.norm();
            // Dual numbers differentiate T0 and s as differences, of which the formulas are free.
            prop_assert!(error < 1e-10, "{name}: {error:e}");
        }
    }

    #[test]
    fn no_length_has_less_than_the_least_tension(
        w in 0.01..100.0f64, stiffness in 2.0..6.0f64,
        x in 0.01..10.0f64, z in -10.0..10.0f64, share in 0.01..0.99f64,
    ) {
        let end = Vector2::new(x, z);
        let cable = Cable::linear(w, w * end.norm() * 10f64.powf(stiffness));
        let least = least_tension(&cable, end).unwrap();
        prop_assert!((least.end_position() - end).norm() < 1e-12 * end.norm());
        let slope = least.force.dot(&least.compliance().force_per_length());
        let scale = least.force.norm() * least.compliance().force_per_length().norm();
        prop_assert!(slope.abs() < 1e-6 * scale, "{slope} of {scale}");
        let tension = least.anchor_tension();
        prop_assert!(length_for_tension(&cable, end, tension * (1.0 - 1e-3 * share)).is_err());
        prop_assert!(length_for_tension(&cable, end, tension * (1.0 + 1e-3 * share)).is_ok());
    }
}
