//! A cable over a lead and a swivelling pulley: references, limits, derivatives.

use crate::common::{by as in_plane, in_space, lifted};
use cdpr_cable::{
    Cable, CableError, Catenary, Entry, Guide, HeldCable, Property, Vector2, Vector3, end_force,
    end_force_near, length_for_tension,
};
use cdpr_evidence::accept;
use proptest::prelude::*;
use serde_json::Value;

pub(crate) fn number(value: &Value) -> f64 {
    value.as_str().map_or_else(|| value.as_f64().unwrap(), |digits| digits.parse().unwrap())
}

pub(crate) fn vector(value: &Value) -> Vector3<f64> {
    Vector3::from_iterator(value.as_array().unwrap().iter().map(number))
}

/// Each cable with a vertical swivel axis of `data/reference/pulleys.json`, over the span that its platform
/// gives it.
#[test]
fn cables_on_pulleys_match_arithmetic_of_20_digits() {
    let file: Value = serde_json::from_str(include_str!("../../../data/reference/pulleys.json")).unwrap();
    let mut compared = 0;
    for case in file["cases"].as_array().unwrap() {
        let gravity = vector(&case["gravity"]);
        if gravity.x != 0.0 || gravity.y != 0.0 {
            continue;
        }
        let rows = case["rotation"].as_array().unwrap().iter().map(vector);
        let rotation: Vec<_> = rows.collect();
        for (i, expected) in case["cables"].as_array().unwrap().iter().enumerate() {
            let pulley = &case["pulleys"][i];
            let axis = vector(&pulley["axis"]);
            if axis.x != 0.0 || axis.y != 0.0 {
                continue;
            }
            let anchor = vector(&case["anchor_points"][i]);
            let arm = Vector3::from_fn(|row, _| rotation[row].dot(&anchor));
            let span = vector(&case["position"]) + arm - vector(&pulley["entry_point"]);
            let horizontal = Vector2::new(span.x, span.y);
            let guide = Guide {
                lead: number(&pulley["lead"]),
                radius: number(&pulley["radius"]),
                entry: if axis.z > 0.0 { Entry::Upwards } else { Entry::Downwards },
            };
            let ea = number(&case["axial_stiffness"][i]);
            let cable =
                Cable { guide: Some(guide), ..Cable::linear(number(&case["weight_per_length"][i]), ea) };
            let length = number(&case["unstrained_lengths"][i]);
            let end = Vector2::new(horizontal.norm(), span.z);
            let solution = end_force(&cable, length, end).unwrap();
            let catenary = solution.catenary;
            let force = -vector(&expected["force_on_platform"]);
            let force = Vector2::new(force.x.hypot(force.y), force.z);
            // The positions of the file have 20 digits, doubles 16: the stiffness of the cable between.
            let rounding = 4.0 * f64::EPSILON * catenary.in_plane_stiffness().norm() * (end.norm() + length);
            let error = (catenary.force - force).norm();
            assert!(error <= 1e-9 * force.norm() + rounding, "{} {i}: {error:e}", case["kind"]);
            accept("V-CABLE-009", error / force.norm());
            let free = number(&expected["free_unstrained_length"]);
            assert!((catenary.free_length() - free).abs() <= 1e-12 * length);
            let at_pulley = number(&expected["tension_at_pulley"]);
            assert!((catenary.exit_tension() - at_pulley).abs() <= 1e-9 * at_pulley + rounding);
            let leave = vector(&expected["leave_point"]) - vector(&pulley["entry_point"]);
            let leave = Vector2::new(leave.x.hypot(leave.y), leave.z);
            assert!((catenary.leave_point() - leave).norm() <= 1e-9 * guide.radius);
            let arc = number(&expected["arc"]);
            assert!((guide.radius * catenary.wrap() - arc).abs() <= 1e-9 * guide.radius);
            let found = length_for_tension(&cable, end, force.norm()).unwrap().catenary.unstrained_length;
            let per_tension = -1.0 / cable.axial_stiffness;
            assert!((found - length).abs() <= 1e-9 * length + per_tension.abs() * rounding);
            compared += 1;
        }
    }
    assert_eq!(compared, 52);
}

/// Cables over a guide, from taut to a sag of a third of the span, with their end.
fn any_guided() -> impl Strategy<Value = (Cable<'static>, Vector2<f64>, f64)> {
    let span = (0.0..2.0f64, -1.4..1.4f64)
        .prop_map(|(chord, angle): (f64, f64)| 10f64.powf(chord) * Vector2::new(angle.cos(), angle.sin()));
    let guide = (0.0..1.0f64, 0.0..0.05f64, any::<bool>());
    (span, -3.0..1.0f64, 3.0..6.0f64, 0.7..300.0f64, guide).prop_map(
        |(end, w, stiffness, level, (lead, radius, up))| {
            let w = 10f64.powf(w);
            let weight = w * end.norm();
            let stiffness = (weight * 10f64.powf(stiffness)).max(20.0 * level * weight);
            let guide = Guide {
                lead: (0.001 + lead) * end.norm(),
                radius: (0.001 + radius) * end.norm(),
                entry: if up { Entry::Upwards } else { Entry::Downwards },
            };
            (Cable { guide: Some(guide), ..Cable::linear(w, stiffness) }, end, level * weight)
        },
    )
}

fn heavier(cable: Cable<'static>, share: f64) -> Cable<'static> {
    Cable { weight_per_length: cable.weight_per_length * (1.0 + share), ..cable }
}

fn stiffer(cable: Cable<'static>, share: f64) -> Cable<'static> {
    Cable { axial_stiffness: cable.axial_stiffness * (1.0 + share), ..cable }
}

/// The cable with a longer lead and a larger pulley [m].
fn led_by(cable: Cable<'static>, [lead, radius]: [f64; 2]) -> Cable<'static> {
    let more = |guide: Guide| Guide { lead: guide.lead + lead, radius: guide.radius + radius, ..guide };
    Cable { guide: cable.guide.map(more), ..cable }
}

/// Central differences of the fourth order.
fn difference(step: f64, at: &dyn Fn(f64) -> Vector2<f64>) -> Vector2<f64> {
    (8.0 * (at(step) - at(-step)) - (at(2.0 * step) - at(-2.0 * step))) / (12.0 * step)
}

proptest! {
    #![proptest_config(ProptestConfig {
        cases: 2_000, failure_persistence: None, ..ProptestConfig::default()
    })]

    #[test]
    fn the_response_is_the_derivative_of_the_end_position((cable, end, sigma) in any_guided()) {
        let guide = cable.guide.unwrap();
        // Beside the wheel and less than its diameter away from the axis no cable leaves it forwards.
        prop_assume!(end.x > 3.0 * guide.radius);
        let held = HeldCable::at_chord_force(&cable, lifted(end), sigma).unwrap();
        let catenary = held.catenary;
        let scale = end.norm() + catenary.unstrained_length;
        prop_assert!(catenary.closure(end).norm() <= 64.0 * f64::EPSILON * scale);
        let response = catenary.response();
        let h = 1e-3 * catenary.force.x.min(catenary.exit_tension());
        let with = |force: Vector2<f64>| Catenary { force, ..catenary }.end_position();
        let columns = [Vector2::x(), Vector2::y()]
            .map(|axis| difference(h, &|s| with(catenary.force + axis * s)));
        // The two shears differ by the asymmetry, and by no more than it says.
        let shear = 0.5 * (columns[0].y + columns[1].x);
        let asymmetry = (columns[0].y - columns[1].x).abs();
        let led = catenary.unstrained_length - catenary.free_length();
        let w = cable.weight_per_length;
        let bound = 2.0 * led / cable.axial_stiffness * w
            * (guide.radius / catenary.exit_tension() + led / cable.axial_stiffness);
        let c = response.flexibility_matrix();
        let size = c.norm();
        prop_assert!(asymmetry <= bound + 1e-7 * size, "{asymmetry:e} {bound:e}");
        prop_assert!((c.m11 - columns[0].x).abs() < 1e-7 * size);
        prop_assert!((c.m22 - columns[1].y).abs() < 1e-7 * size);
        prop_assert!((c.m12 - shear).abs() < 1e-7 * size);
        let determinant = response.determinant;
        prop_assert!((determinant / c.determinant() - 1.0).abs() < 1e-13 * size * size / determinant);
        prop_assert!((end.x / response.lateral_flexibility / catenary.force.x - 1.0).abs() < 1e-12);
        let by = |of: &dyn Fn(f64) -> Catenary<'static>| difference(1e-4, &|s| of(s).end_position());
        let (ea, length) = (cable.axial_stiffness, catenary.unstrained_length);
        let made = |cable: Cable<'static>| Catenary { cable, ..catenary };
        let longer = |more: f64| Catenary { unstrained_length: length + more, ..catenary };
        let slopes = in_space(&catenary).slopes();
        let per = |property| in_plane(&slopes, property);
        let size = end.norm();
        let cases = [
            ("L", Vector2::from(response.end_per_length) * length, by(&|s| longer(length * s))),
            ("w", per(Property::Weight) * w, by(&|s| made(heavier(cable, s)))),
            ("EA", per(Property::Stiffness) * ea, by(&|s| made(stiffer(cable, s)))),
            ("lead", per(Property::Lead) * size, by(&|s| made(led_by(cable, [size * s, 0.0])))),
            ("radius", per(Property::Radius) * size, by(&|s| made(led_by(cable, [0.0, size * s])))),
        ];
        for (name, exact, difference) in cases {
            let error = (exact - difference).norm();
            prop_assert!(error < 1e-7 * (exact.norm() + size), "{name}: {exact} {difference}");
        }
    }

    #[test]
    fn a_held_cable_on_a_guide_has_the_derivatives_it_says((cable, end, sigma) in any_guided()) {
        let guide = cable.guide.unwrap();
        prop_assume!(end.x > 4.0 * guide.radius);
        let held = HeldCable::at_chord_force(&cable, lifted(end), sigma).unwrap();
        let step = 1e-4 * sigma;
        let at = |h: f64| held.with_chord_force(sigma + h).unwrap();
        let (less, more) = (at(-step), at(step));
        let slope = (more.force() - less.force()) / (2.0 * step);
        prop_assert!((slope - held.force_slope).norm() < 1e-6 * slope.norm());
        let curvature = (more.force_slope - less.force_slope) / (2.0 * step);
        let size = held.force_slope.norm() / sigma;
        prop_assert!((curvature - held.force_curvature()).norm() < 1e-5 * size);
        // Next to the least tension, differences say nothing.
        prop_assume!(held.tension_slope() > 0.3);
        let (t, slopes) = (held.tension(), in_space(&held.catenary).tension_slopes());
        let chord = end.norm();
        let per_end = |column: usize| slopes.per_end.fixed_columns::<1>(column).xz();
        let per = |property| in_plane(&slopes.per_property, property);
        let v = |cable: Cable<'static>, end: Vector2<f64>, t: f64| {
            let held = HeldCable::at_chord_force(&cable, lifted(end), sigma).unwrap().with_tension(t).unwrap();
            (held.force_slope / held.tension_slope()).xz()
        };
        let direction = v(cable, end, t);
        prop_assert!((slopes.value.xz() - direction).norm() < 1e-10);
        let (w, ea) = (cable.weight_per_length, cable.axial_stiffness);
        let by = |at: &dyn Fn(f64) -> Vector2<f64>| difference(1e-4, at);
        let cases = [
            ("t", slopes.per_actuation.xz() * t, by(&|s| v(cable, end, t * (1.0 + s)))),
            ("x", per_end(0) * chord, by(&|s| v(cable, end + Vector2::x() * (chord * s), t))),
            ("z", per_end(2) * chord, by(&|s| v(cable, end + Vector2::y() * (chord * s), t))),
            ("w", per(Property::Weight) * w, by(&|s| v(heavier(cable, s), end, t))),
            ("EA", per(Property::Stiffness) * ea, by(&|s| v(stiffer(cable, s), end, t))),
            ("lead", per(Property::Lead) * chord, by(&|s| v(led_by(cable, [chord * s, 0.0]), end, t))),
            ("radius", per(Property::Radius) * chord, by(&|s| v(led_by(cable, [0.0, chord * s]), end, t))),
        ];
        for (name, exact, difference) in cases {
            let error = (exact - difference).norm();
            prop_assert!(error < 1e-6 * (1.0 + exact.norm()), "{name}: {exact} {difference}");
        }
    }

    #[test]
    fn a_guide_without_lead_and_radius_changes_no_bit((cable, end, sigma) in any_guided()) {
        let plain = Cable { guide: None, ..cable };
        let guide = Guide { lead: 0.0, radius: 0.0, entry: cable.guide.unwrap().entry };
        let guided = Cable { guide: Some(guide), ..cable };
        let held = HeldCable::at_chord_force(&plain, lifted(end), sigma).unwrap().catenary;
        let same = Catenary { cable: guided, ..held };
        prop_assert_eq!(same.end_position(), held.end_position());
        prop_assert_eq!(same.response().flexibility, held.response().flexibility);
        prop_assert_eq!(same.response().determinant, held.response().determinant);
        prop_assert_eq!(same.exit_tension(), held.exit_tension());
        let (length, tension) = (held.unstrained_length, held.anchor_tension());
        let with = end_force(&guided, length, end).unwrap().catenary.force;
        let force = end_force(&plain, length, end).unwrap().catenary.force;
        let rounding = 8.0 * f64::EPSILON * held.in_plane_stiffness().norm() * length;
        prop_assert!((with - force).norm() <= 1e-12 * tension + rounding);
    }

    #[test]
    fn the_energy_has_the_force_for_its_gradient_but_for_what_is_not_conservative(
        (cable, end, sigma) in any_guided(),
    ) {
        let guide = cable.guide.unwrap();
        prop_assume!(end.x > 4.0 * guide.radius);
        let catenary = HeldCable::at_chord_force(&cable, lifted(end), sigma).unwrap().catenary;
        let h = 1e-3 * catenary.anchor_tension() / catenary.in_plane_stiffness().norm();
        let energy = |end| end_force_near(&catenary, end).unwrap().catenary.potential_energy();
        for (axis, force) in [(Vector2::x(), catenary.force.x), (Vector2::y(), catenary.force.y)] {
            let slope = (energy(end + axis * h) - energy(end - axis * h)) / (2.0 * h);
            // (C25): w B_z times what lead and arc stretch, which is less than A moves.
            let led = (catenary.unstrained_length - catenary.free_length()) / catenary.unstrained_length;
            let bound = cable.weight_per_length * catenary.leave_point().y.abs() * led;
            let rounding = 1e-5 * catenary.anchor_tension();
            prop_assert!((slope - force).abs() <= bound + rounding, "{slope} {force} {bound}");
        }
    }
}

#[test]
fn a_weightless_cable_on_a_pulley_is_straight_beyond_it() {
    // By hand: under a wheel of 0.5 m a level cable leaves at its lowest point, a quarter turn from D.
    let guide = Guide { lead: 2.0, radius: 0.5, entry: Entry::Downwards };
    let cable = Cable { guide: Some(guide), ..Cable::linear(0.0, 1e4) };
    let quarter = 0.25 * std::f64::consts::PI;
    let straight = 3.0 + quarter + 2.0;
    let end = Vector2::new(0.5 + 3.0, -0.5);
    let catenary = end_force(&cable, straight / 1.01, end).unwrap().catenary;
    assert!((catenary.force - Vector2::new(100.0, 0.0)).norm() < 1e-9);
    assert!((catenary.leave_point() - Vector2::new(0.5, -0.5)).norm() < 1e-14);
    assert!((catenary.potential_energy() - 0.5 * 100.0 * 0.01 * straight / 1.01).abs() < 1e-9);
    // Longer than the way, it is slack and carries nothing.
    let slack = end_force(&cable, straight + 0.1, end).unwrap();
    assert!(slack.catenary.is_slack_and_weightless() && slack.residual == 0.0);
}

#[test]
fn an_end_within_the_wheel_or_behind_it_is_refused() {
    let guide = Guide { lead: 0.0, radius: 0.5, entry: Entry::Upwards };
    let cable = Cable { guide: Some(guide), ..Cable::linear(1.0, 1e6) };
    for end in [Vector2::new(0.6, 0.1), Vector2::new(0.3, -5.0)] {
        assert_eq!(end_force(&cable, 6.0, end).unwrap_err(), CableError::AtPulley { distance: end.x });
    }
    let cable = Cable { guide: Some(Guide { radius: -0.1, ..guide }), ..cable };
    let error = end_force(&cable, 6.0, Vector2::new(3.0, 0.0)).unwrap_err().to_string();
    assert!(error.contains("pulley.radius is -0.1"), "{error}");
}

/// Near the rim of its wheel a cable hangs down almost vertically, whatever the direction of its whole span.
#[test]
fn the_least_tension_over_a_pulley_is_that_of_all_chord_forces() {
    for (radius, lead, depth) in [(0.05, 0.0, 3.0), (0.7, 2.0, 20.0), (0.3, 0.0, 0.5)] {
        let guide = Guide { lead, radius, entry: Entry::Upwards };
        let cable = Cable { guide: Some(guide), ..Cable::linear(2.0, 1e5) };
        for beyond in [1e-4, 1e-2, 1.0, 30.0] {
            let end = Vector2::new(radius * (2.0 + beyond), -depth);
            let least = HeldCable::at_least_tension(&cable, lifted(end)).unwrap();
            let weight = cable.weight_per_length * end.norm();
            let mut lowest = f64::INFINITY;
            for k in -60..=20 {
                let sigma = weight * 10f64.powf(f64::from(k) / 10.0);
                if let Ok(held) = HeldCable::at_chord_force(&cable, lifted(end), sigma) {
                    lowest = lowest.min(held.tension());
                }
            }
            assert!(
                least.tension() <= lowest + 1e-9 * weight,
                "{radius} {beyond}: {} {lowest}",
                least.tension()
            );
            assert!(
                least.tension() >= lowest - 0.02 * weight,
                "{radius} {beyond}: {} {lowest}",
                least.tension()
            );
        }
    }
}
