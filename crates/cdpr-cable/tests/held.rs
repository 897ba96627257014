//! A cable between held ends as a function of its chord force: closure, derivatives, least tension.

use crate::common::{by, in_space, lifted};
use cdpr_cable::{
    Cable, Catenary, ElasticLaw, HeldCable, PiecewiseLaw, Property, Segment, Vector2, end_force,
};
use proptest::prelude::*;

/// Cables over spans of any direction, from taut to nearly their least tension.
fn any_held() -> impl Strategy<Value = (Cable<'static>, Vector2<f64>, f64)> {
    let span = (-1.0..2.5f64, -1.5..1.5f64)
        .prop_map(|(chord, angle): (f64, f64)| 10f64.powf(chord) * Vector2::new(angle.cos(), angle.sin()));
    (span, -3.0..2.0f64, 3.0..7.0f64, 0.45..1e3f64).prop_map(|(end, w, stiffness, level)| {
        let w = 10f64.powf(w);
        let weight = w * end.norm();
        // The strain stays below a tenth.
        let stiffness = (weight * 10f64.powf(stiffness)).max(20.0 * level * weight);
        (Cable::linear(w, stiffness), end, level * weight)
    })
}

/// The least tension [N] over the length, which has one minimum, by intervals.
fn least_of_all_lengths(cable: &Cable, end: Vector2<f64>) -> f64 {
    let tension = |length: f64| end_force(cable, length, end).unwrap().catenary.anchor_tension();
    let (mut short, mut long) = (0.5 * end.norm(), 8.0 * end.norm());
    for _ in 0..100 {
        let [left, right] = [1.0, 2.0].map(|third| short + third * (long - short) / 3.0);
        if tension(left) < tension(right) { long = right } else { short = left }
    }
    tension(0.5 * (short + long))
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 5_000, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn a_chord_force_closes_the_cable_and_has_the_derivatives_it_says((cable, end, sigma) in any_held()) {
        let held = HeldCable::at_chord_force(&cable, lifted(end), sigma).unwrap();
        let scale = end.norm() + held.catenary.unstrained_length;
        prop_assert!(held.catenary.closure(end).norm() <= 64.0 * f64::EPSILON * scale);
        let step = 1e-4 * sigma;
        let at = |h: f64| held.with_chord_force(sigma + h).unwrap();
        let (less, more) = (at(-step), at(step));
        let slope = (more.force() - less.force()) / (2.0 * step);
        prop_assert!((slope - held.force_slope).norm() < 1e-6 * slope.norm());
        let curvature = (more.force_slope - less.force_slope) / (2.0 * step);
        let size = held.force_slope.norm() / sigma;
        prop_assert!((curvature - held.force_curvature()).norm() < 1e-5 * size);
        let slope = (more.tension_slope() - less.tension_slope()) / (2.0 * step);
        prop_assert!((slope - held.tension_curvature(&held.force_curvature())).abs() < 1e-5 * size);
        prop_assert!(held.length_slope < 0.0);
        let slope = (more.catenary.unstrained_length - less.catenary.unstrained_length) / (2.0 * step);
        let rounding = 1e-14 * scale / step;
        prop_assert!((slope - held.length_slope).abs() < 1e-5 * held.length_slope.abs() + rounding);
    }

    #[test]
    fn the_least_tension_is_that_of_all_lengths((cable, end, _) in any_held()) {
        let held = HeldCable::at_least_tension(&cable, lifted(end)).unwrap();
        let searched = least_of_all_lengths(&cable, end);
        let scale = searched + cable.weight_per_length * end.norm();
        prop_assert!((held.tension() - searched).abs() <= 1e-12 * scale);
        // Above this no cable is near its least tension.
        prop_assert!(held.tension() < 1.3 * cable.weight_per_length * end.norm());
    }

    #[test]
    fn second_derivatives_at_given_tension_are_those_of_differences((cable, end, sigma) in any_held()) {
        let held = HeldCable::at_chord_force(&cable, lifted(end), sigma).unwrap();
        let (t, slopes) = (held.tension(), in_space(&held.catenary).tension_slopes());
        let per_end = |column: usize| slopes.per_end.fixed_columns::<1>(column).xz();
        let per = |property| by(&slopes.per_property, property);
        // Next to the least tension, differences say nothing.
        prop_assume!(held.tension_slope() > 0.3);
        let v = |cable: Cable<'static>, end: Vector2<f64>, t: f64| {
            let start = HeldCable::at_chord_force(&cable, lifted(end), sigma).unwrap();
            let held = start.with_tension(t).unwrap();
            (held.force_slope / held.tension_slope()).xz()
        };
        let direction = v(cable, end, t);
        prop_assert!((slopes.value.xz() - direction).norm() < 1e-12);
        let difference = |step: f64, at: &dyn Fn(f64) -> Vector2<f64>| (at(step) - at(-step)) / (2.0 * step);
        let chord = end.norm();
        let h = 1e-5;
        let (w, ea) = (cable.weight_per_length, cable.axial_stiffness);
        let cases = [
            ("t", slopes.per_actuation.xz() * t, difference(h, &|s| v(cable, end, t * (1.0 + s)))),
            ("z", per_end(2) * chord, difference(h, &|s| v(cable, end + Vector2::y() * (chord * s), t))),
            ("w", per(Property::Weight) * w, difference(h, &|s| v(Cable::linear(w * (1.0 + s), ea), end, t))),
            ("EA", per(Property::Stiffness) * ea, difference(h, &|s| v(Cable::linear(w, ea * (1.0 + s)), end, t))),
        ];
        for (name, exact, difference) in cases {
            let scale = 1.0 + exact.norm();
            prop_assert!((exact - difference).norm() < 1e-6 * scale, "{name}: {exact} {difference}");
        }
        if end.x > 1e-3 * chord {
            let difference = difference(h, &|s| v(cable, end + Vector2::x() * (chord * s), t));
            let exact = per_end(0) * chord;
            prop_assert!((exact - difference).norm() < 1e-6 * (1.0 + exact.norm()), "x: {exact} {difference}");
        }
    }
}

#[test]
fn a_weightless_cable_is_straight_at_its_chord_force() {
    let cable = Cable::linear(0.0, 1e4);
    for end in [Vector2::new(3.0, 4.0), Vector2::new(0.0, -5.0)] {
        let held = HeldCable::at_chord_force(&cable, lifted(end), 50.0).unwrap();
        assert!((held.tension() - 50.0).abs() < 1e-12);
        assert!((held.catenary.unstrained_length - 5.0 / (1.0 + 50.0 / 1e4)).abs() < 1e-14);
        assert!(
            (held.tension_slope() - 1.0).abs() < 1e-14
                && held.tension_curvature(&held.force_curvature()).abs() < 1e-14
        );
    }
}

#[test]
fn a_vertical_cable_is_regular() {
    let cable = Cable::linear(2.0, 1e5);
    for z in [3.0, -3.0] {
        let (end, beside) = (Vector2::new(0.0, z), Vector2::new(1e-9, z));
        for sigma in [3.0, 100.0] {
            let held = HeldCable::at_chord_force(&cable, lifted(end), sigma).unwrap();
            let near = HeldCable::at_chord_force(&cable, lifted(beside), sigma).unwrap();
            assert!((held.tension() / near.tension() - 1.0).abs() < 1e-8);
            assert!(
                (held.tension_curvature(&held.force_curvature())
                    - near.tension_curvature(&near.force_curvature()))
                .abs()
                    < 1e-7
            );
            // v_x is odd in x.
            let per_end = in_space(&held.catenary).tension_slopes().per_end;
            let aside = HeldCable::at_chord_force(&cable, lifted(Vector2::new(1e-4, z)), sigma).unwrap();
            let aside = aside.with_tension(held.tension()).unwrap();
            let slope = aside.force_slope.x / aside.tension_slope() / 1e-4;
            assert!((per_end.m11 / slope - 1.0).abs() < 1e-6, "{z} {sigma}");
            assert!(per_end.m31 == 0.0 && per_end.column(2).iter().all(|v| v.is_finite()));
        }
        // Hanging down from A the cable's whole weight is at A; hanging from B it may be all at B.
        let least = HeldCable::at_least_tension(&cable, lifted(end)).unwrap().tension();
        assert!((least - z.max(0.0) * 2.0).abs() < 1e-3, "{least}");
    }
}

#[test]
fn a_cable_that_hangs_from_its_anchor_point_carries_at_least_its_weight_there() {
    for (w, z) in [(1.5e-3, 123.0), (2.0, 3.0), (0.3, 40.0), (7.0, 15.0)] {
        let weight = w * z;
        let cable = Cable::linear(w, 1e4 * weight);
        let least = HeldCable::at_least_tension(&cable, lifted(Vector2::new(0.0, z))).unwrap();
        // It is strained by half of its weight on average.
        assert!((least.tension() / weight - (1.0 - 0.5e-4)).abs() < 1e-7, "{w} {z}: {}", least.tension());
    }
}

#[test]
fn a_cable_with_a_law_has_the_derivatives_of_its_segments() {
    let segment = |(tension, ratio)| Segment { tension, ratio };
    let law = PiecewiseLaw::new(100.0, &[(0.0, 0.5), (40.0, 1.0), (55.0, 2.0)].map(segment)).unwrap();
    let cable = Cable { law: ElasticLaw::Piecewise(&law), ..Cable::linear(2.0, 1e4) };
    let end = Vector2::new(6.0, 5.0);
    // Its tension lies in one segment or in two.
    for sigma in [20.0, 38.0, 50.0, 70.0] {
        let held = HeldCable::at_chord_force(&cable, lifted(end), sigma).unwrap();
        let at = |h: f64| held.with_chord_force(sigma + h).unwrap();
        let (less, more) = (at(-1e-3), at(1e-3));
        let slope = (more.force() - less.force()) / 2e-3;
        assert!((slope - held.force_slope).norm() < 1e-8, "{sigma}");
        let curvature = (more.force_slope - less.force_slope) / 2e-3;
        assert!((curvature - held.force_curvature()).norm() < 1e-8, "{sigma}");
    }
}

#[test]
fn the_tension_at_one_end_follows_from_that_at_the_other_and_the_height_alone() {
    let segments = [(0.0, 0.5), (40.0, 1.0), (900.0, 2.0)].map(|(tension, ratio)| Segment { tension, ratio });
    let law = PiecewiseLaw::new(30.0, &segments).unwrap();
    let linear = Cable::linear(2.5, 1e4);
    let cables = [linear, Cable { law: ElasticLaw::Piecewise(&law), ..linear }, Cable::linear(0.0, 1e4)];
    for cable in cables {
        for (length, fx, fz) in
            [(10.0, 300.0, 40.0), (80.0, 50.0, 90.0), (30.0, 5.0, 2000.0), (90.0, 1.0, -150.0)]
        {
            let catenary = Catenary { cable, unstrained_length: length, force: Vector2::new(fx, fz) };
            let (t, t0, z) = (catenary.anchor_tension(), catenary.exit_tension(), catenary.end_position().y);
            let above = cable.tension_above(t0, z).unwrap();
            assert!((above - t).abs() <= 1e-13 * t.max(t0), "{above} N, not {t} N");
            let below = cable.tension_above(t, -z).unwrap();
            assert!((below - t0).abs() <= 1e-13 * t.max(t0), "{below} N, not {t0} N");
            if cable.law == ElasticLaw::Linear {
                let known = |t: f64| t + t * t / (2.0 * cable.axial_stiffness);
                let open = known(t) - known(t0) - cable.weight_per_length * z;
                assert!(open.abs() < 1e-12 * known(t.max(t0)), "{open:e} N open");
            }
        }
    }
    // 200 m of this cable weigh more than the tension at its upper end.
    assert_eq!(linear.tension_above(400.0, -200.0), None);
}
