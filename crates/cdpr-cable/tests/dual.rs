//! Every derivative of the catenary against dual numbers: the same equations over a number with derivative.

use crate::common::lifted;
use approx::assert_relative_eq;
use cdpr_cable::kernel::{Material, response};
use cdpr_cable::{Cable, Catenary, HeldCable, Vector2, length_for_tension};
use cdpr_number::Dual;
use proptest::prelude::*;

/// Derivative of the end position with respect to one of (L, fx, fz).
fn dual(catenary: &Catenary, which: usize) -> Vector2<f64> {
    let Catenary { cable, unstrained_length, force } = *catenary;
    let inputs = [unstrained_length, force.x, force.y];
    let input = |k| Dual { value: inputs[k], slopes: [f64::from(k == which)] };
    let [length, fx, fz] = [0, 1, 2].map(input);
    let [w, flexibility] = [cable.weight_per_length, cable.axial_stiffness.recip()].map(Dual::constant);
    let [x, z] = response(w, flexibility, length, [fx, fz]).end;
    Vector2::new(x.slopes[0], z.slopes[0])
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

#[test]
fn dual_numbers_of_dual_numbers_are_mixed_derivatives_of_a_cable() {
    // d²z/dw dfx of a sagging cable, against differences of exact first derivatives.
    let (w, flexibility, length, [fx, fz]) = (1.3, 1e-6, 40.0, [25.0, 31.0]);
    let per_weight = |fx: f64| {
        let [f, l, x, z] = [flexibility, length, fx, fz].map(Dual::<f64, 1>::constant);
        let material = Material { law: &[], weight_per_length: Dual::input(w, 0), axial_flexibility: f };
        material.end(l, [x, z]).end[1].slopes[0]
    };
    let [f, l, z] = [flexibility, length, fz].map(Dual::<f64, 1>::constant).map(Dual::<_, 1>::constant);
    let along = Dual::input(Dual::constant(fx), 0);
    let weight = Dual::constant(Dual::input(w, 0));
    let material = Material { law: &[], weight_per_length: weight, axial_flexibility: f };
    let end = material.end(l, [along, z]).end[1];
    assert_relative_eq!(end.value.slopes[0], per_weight(fx), max_relative = 1e-15);
    let step = 1e-3;
    let at = |h: f64| (per_weight(fx + h) - per_weight(fx - h)) / (2.0 * h);
    let difference = (4.0 * at(step) - at(2.0 * step)) / 3.0;
    assert_relative_eq!(end.slopes[0].slopes[0], difference, max_relative = 1e-9);
}

proptest! {
    #![proptest_config(ProptestConfig {
        cases: 20_000,
        failure_persistence: None,
        ..ProptestConfig::default()
    })]

    #[test]
    fn derivatives_are_those_of_dual_numbers(c in any_catenary()) {
        let response = c.response();
        let flexibility = response.flexibility_matrix();
        let derivatives: [(Vector2<f64>, &str); 3] = [
            (response.end_per_length.into(), "L"), (flexibility.column(0).into(), "fx"),
            (flexibility.column(1).into(), "fz"),
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
        let least = HeldCable::at_least_tension(&cable, lifted(end)).unwrap().catenary;
        prop_assert!((least.end_position() - end).norm() < 1e-12 * end.norm());
        let slope = least.force.dot(&least.response().force_per_length());
        let scale = least.force.norm() * least.response().force_per_length().norm();
        prop_assert!(slope.abs() < 1e-6 * scale, "{slope} of {scale}");
        let tension = least.anchor_tension();
        prop_assert!(length_for_tension(&cable, end, tension * (1.0 - 1e-3 * share)).is_err());
        prop_assert!(length_for_tension(&cable, end, tension * (1.0 + 1e-3 * share)).is_ok());
    }
}
