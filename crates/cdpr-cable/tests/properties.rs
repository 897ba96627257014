//! Properties of the cable's inverse problems over many decades of weight, stiffness, length and slack.

use cdpr_cable::{Cable, CableError, Catenary, Known, MAX_STRAIN, Vector2, end_force, length_for_tension};
use proptest::prelude::*;

/// A cable, its unstrained length, and an end position.
///
/// The end lies between level with the exit point and right below or above it. The chord is between a
/// hundredth of the length (folded) and one percent more than the length.
fn any_span() -> impl Strategy<Value = (Cable<'static>, f64, Vector2<f64>)> {
    (
        -5.0..2.5f64,
        4.0..9.0f64,
        -0.5..2.5f64,
        prop_oneof![-9.0..0.0f64, Just(f64::NEG_INFINITY)],
        any::<bool>(),
        chord(),
    )
        .prop_map(|(w, ea, l, x, up, chord)| {
            let cable = Cable::linear(10f64.powf(w), 10f64.powf(ea));
            let length = 10f64.powf(l);
            let x = 10f64.powf(x);
            let z = (1.0 - x * x).sqrt() * if up { 1.0 } else { -1.0 };
            (cable, length, Vector2::new(x, z) * (chord * length))
        })
}

/// Chord over unstrained length.
fn chord() -> impl Strategy<Value = f64> {
    prop_oneof![
        0.01..1.0f64,
        (-9.0..-1.0f64).prop_map(|e| 1.0 - 10f64.powf(e)),
        (-9.0..-2.0f64).prop_map(|e| 1.0 + 10f64.powf(e))
    ]
}

proptest! {
    #![proptest_config(ProptestConfig {
        cases: 20_000,
        failure_persistence: None,
        ..ProptestConfig::default()
    })]

    #[test]
    fn every_span_has_an_end_force_to_rounding((cable, length, end) in any_span()) {
        let solution = end_force(&cable, length, end);
        prop_assert!(solution.is_ok(), "{solution:?}");
        let solution = solution.unwrap();
        prop_assert!(solution.iterations <= 30, "{} iterations", solution.iterations);
        prop_assert!(solution.catenary.force.x >= 0.0);
    }

    #[test]
    fn the_end_force_gives_back_the_length_for_its_tension((cable, length, end) in any_span()) {
        let catenary = end_force(&cable, length, end).unwrap().catenary;
        let tension = catenary.anchor_tension();
        // One unit in the last place of the length is worth EA epsilon newtons.
        let rounding = 8.0 * f64::EPSILON * cable.axial_stiffness;
        match length_for_tension(&cable, end, tension) {
            Ok(solution) => {
                let found = solution.catenary;
                prop_assert!(found.unstrained_length <= length * (1.0 + 1e-6));
                prop_assert!((found.anchor_tension() - tension).abs() < 1e-9 * tension + rounding);
                let residual = (found.end_position() - end).norm();
                prop_assert!(residual < 1e-12 * (end.norm() + found.unstrained_length), "{residual:e}");
            }
            // At the very bottom of the tension curve, rounding decides on which side the tension lies.
            Err(CableError::TensionTooSmall { least, .. }) => {
                prop_assert!(least < tension * (1.0 + 1e-9) + rounding, "{least} {tension}");
            }
            Err(error) => prop_assert!(false, "{error}"),
        }
    }

    #[test]
    fn a_tension_that_is_too_small_is_below_that_of_any_length(
        (cable, length, end) in any_span(), fraction in 0.01..1.0f64,
    ) {
        let tension = fraction * cable.weight_per_length * end.norm();
        if let Err(error) = length_for_tension(&cable, end, tension) {
            let CableError::TensionTooSmall { least, .. } = error else { panic!("{error}") };
            let any = end_force(&cable, length, end).unwrap().catenary.anchor_tension();
            let rounding = 8.0 * f64::EPSILON * cable.axial_stiffness;
            let bound = any * (1.0 + 1e-9) + rounding;
            prop_assert!(tension < least && least <= bound, "{tension} {least} {any}");
        }
    }

    #[test]
    fn more_cable_means_less_tension_until_its_weight_takes_over((cable, length, end) in any_span()) {
        // The potential energy is convex in the end position: stiffness is positive definite.
        let k = end_force(&cable, length, end).unwrap().catenary.in_plane_stiffness();
        prop_assert!(k.m11 > 0.0 && k.m22 > 0.0 && k.determinant() > 0.0, "{k}");
    }
}

#[test]
fn an_invalid_input_is_refused_with_its_field() {
    let cable = Cable::linear(1.0, 1e6);
    let end = Vector2::new(3.0, -1.0);
    let field = |result: Result<_, CableError>| match result {
        Err(CableError::InvalidInput { field, .. }) => field,
        other => panic!("{other:?}"),
    };
    assert_eq!(field(end_force(&Cable { weight_per_length: -1.0, ..cable }, 3.0, end)), "weight_per_length");
    assert_eq!(field(end_force(&Cable { axial_stiffness: 0.0, ..cable }, 3.0, end)), "axial_stiffness");
    assert_eq!(field(end_force(&cable, f64::NAN, end)), "unstrained_length");
    assert_eq!(field(end_force(&cable, 3.0, Vector2::new(-1.0, 0.0))), "end.x");
    assert_eq!(field(end_force(&cable, 3.0, Vector2::new(1.0, f64::INFINITY))), "end.z");
    assert_eq!(field(length_for_tension(&cable, end, 0.0)), "tension");
    assert_eq!(field(length_for_tension(&cable, Vector2::zeros(), 5.0)), "end");
}

#[test]
fn a_slack_weightless_cable_carries_nothing() {
    let cable = Cable::linear(0.0, 1e6);
    let slack = end_force(&cable, 5.0, Vector2::new(3.0, -1.0)).unwrap().catenary;
    assert_eq!(slack.force, Vector2::zeros());
    assert_eq!(slack.sag(), 0.0);
}

#[test]
fn the_force_is_continuous_from_nearly_vertical_to_vertical() {
    let cable = Cable::linear(1.0, 1e6);
    for z in [-6.0, -4.0, 0.0, 4.0, 6.0] {
        let vertical = end_force(&cable, 5.0, Vector2::new(0.0, z)).unwrap().catenary;
        for x in [1e-6, 1e-12, 1e-25, 1e-40, 1e-300] {
            let near: Catenary = end_force(&cable, 5.0, Vector2::new(x, z)).unwrap().catenary;
            let error = (near.force - vertical.force).norm();
            let stiffness = 1e6 / 5.0;
            assert!(error < 1e-6 + 2.0 * stiffness * x, "z {z}, x {x:e}: {error:e}");
        }
    }
}

#[test]
fn a_cable_just_as_long_as_its_nearly_vertical_chord_has_an_answer() {
    // Found by fuzzing: the first useful step of the iteration is a ten billionth of Newton's.
    for (w, ea, length, x, z) in [
        (0.5, 210271321.24244624, 9.180005734997088, 5.925331874304136e-9, 9.180005734997087),
        (0.9237890551427004, 12988399.791309489, 7.836113166613779, 1.5618510981075536e-8, -7.83611316661323),
    ] {
        let cable = Cable::linear(w, ea);
        let solution = end_force(&cable, length, Vector2::new(x, z)).unwrap();
        assert!(solution.residual < 1e-14 * length, "{solution:?}");
    }
}

#[test]
fn magnitudes_whose_quotients_overflow_are_refused() {
    let text = |w, ea, length, x| {
        let cable = Cable::linear(w, ea);
        end_force(&cable, length, Vector2::new(x, 0.0)).unwrap_err().to_string()
    };
    assert_eq!(
        text(1.0, 1e6, 1e-180, 1e-151),
        "unstrained_length is 1e-180: expected an unstrained length from 1e-30 to 1e30 [m]"
    );
    assert!(
        text(0.5, 1e-40, 1.0, 1.0).starts_with("axial_stiffness is 1e-40:"),
        "{}",
        text(0.5, 1e-40, 1.0, 1.0)
    );
    assert!(text(1e-40, 1e6, 1.0, 1.0).contains("zero or from 1e-30 to 1e30"));
}

#[test]
fn a_cable_strained_by_more_than_the_models_hold_for_has_no_answer_whichever_values_are_known() {
    let cable = Cable::linear(1.0, 1000.0);
    let end = Vector2::new(4.0, -1.0);
    for (length, holds) in [(4.0, true), (3.7, false), (3.0, false)] {
        let found = end_force(&cable, length, end).unwrap().catenary;
        let tension = found.anchor_tension();
        assert_eq!(cable.strain(tension.max(found.exit_tension())) <= MAX_STRAIN, holds);
        for known in [
            Known::LengthAndEnd { length, end },
            Known::LengthAndForce { length, force: found.force },
            Known::EndAndTension { end, tension },
        ] {
            match known.solve(&cable) {
                Ok(_) => assert!(holds, "{known:?}"),
                Err(CableError::Overstrained { strain, .. }) => assert!(!holds && strain > MAX_STRAIN),
                Err(error) => panic!("{error}"),
            }
        }
    }
}
