//! Every derivative of the catenary against dual numbers: the same equations over a number with derivative.

use cdpr_cable::kernel::{Dual, Field, response};
use cdpr_cable::{Cable, Catenary, Vector2, least_tension, length_for_tension};
use proptest::prelude::*;

/// Derivative of the end position with respect to one of (w, EA, L, fx, fz).
fn dual(catenary: &Catenary, which: usize) -> Vector2<f64> {
    let Catenary { cable, unstrained_length, force } = *catenary;
    let inputs = [cable.weight_per_length, cable.axial_stiffness, unstrained_length, force.x, force.y];
    let input = |k| Dual { value: inputs[k], slopes: [f64::from(k == which)] };
    let [w, ea, length, fx, fz] = [0, 1, 2, 3, 4].map(input);
    let [x, z] = response(w, ea.recip(), length, [fx, fz]).end;
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
