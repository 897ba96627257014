//! Cables over pulleys with tilted axes: references, limits, derivatives.

use crate::common::lifted;
use crate::guided::{number, vector};
use cdpr_cable::{
    Cable, Entry, Guide, HeldCable, Matrix3, Property, SpatialCable, Vector2, Vector3, end_force,
    spatial_end_force,
};
use cdpr_evidence::accept;
use proptest::prelude::*;
use serde_json::Value;

/// The rotation that turns `up` into the z axis.
fn level(up: Vector3<f64>) -> Matrix3<f64> {
    let turn = up.cross(&Vector3::z());
    let s = turn.cross_matrix();
    Matrix3::identity() + s + s * s / (1.0 + up.z)
}

/// Every cable of `data/reference/pulleys.json`, whatever its axis and the direction of gravity, over the
/// span that its platform gives it.
#[test]
fn cables_over_any_axis_match_arithmetic_of_20_digits() {
    let file: Value = serde_json::from_str(include_str!("../../../data/reference/pulleys.json")).unwrap();
    let (mut compared, mut worst) = (0, [0.0_f64; 3]);
    for case in file["cases"].as_array().unwrap() {
        let level = level(-vector(&case["gravity"]).normalize());
        let rows: Vec<_> = case["rotation"].as_array().unwrap().iter().map(vector).collect();
        for (i, expected) in case["cables"].as_array().unwrap().iter().enumerate() {
            let pulley = &case["pulleys"][i];
            let anchor = vector(&case["anchor_points"][i]);
            let arm = Vector3::from_fn(|row, _| rows[row].dot(&anchor));
            let end = level * (vector(&case["position"]) + arm - vector(&pulley["entry_point"]));
            let axis = level * vector(&pulley["axis"]).normalize();
            let guide = Guide {
                lead: number(&pulley["lead"]),
                radius: number(&pulley["radius"]),
                entry: Entry::Along(axis.into()),
            };
            let ea = number(&case["axial_stiffness"][i]);
            let cable =
                Cable { guide: Some(guide), ..Cable::linear(number(&case["weight_per_length"][i]), ea) };
            let length = number(&case["unstrained_lengths"][i]);
            let found = spatial_end_force(&cable, length, end, None).unwrap();
            let force = level * -vector(&expected["force_on_platform"]);
            let stiffness = found.response().flexibility.try_inverse().unwrap();
            let rounding = 16.0 * f64::EPSILON * stiffness.norm() * (end.norm() + length);
            let error = (found.force - force).norm();
            worst[0] = worst[0].max(error / force.norm());
            assert!(error <= 1e-9 * force.norm() + rounding, "{} {i}: {error:e}", case["kind"]);
            let (in_plane, azimuth) = found.in_plane();
            assert!(
                (in_plane.free_length() - number(&expected["free_unstrained_length"])).abs()
                    <= 1e-12 * length
            );
            let leave = level * (vector(&expected["leave_point"]) - vector(&pulley["entry_point"]));
            let own = in_plane.leave_point();
            let forwards = Vector2::new(leave.x, leave.y).dot(&azimuth);
            assert!((own - Vector2::new(forwards, leave.z)).norm() <= 1e-9 * guide.radius);
            assert!((guide.radius * in_plane.wrap() - number(&expected["arc"])).abs() <= 1e-9 * guide.radius);
            // The same cable by its tension and by its chord force.
            let held = HeldCable::of(found, end);
            let far = held.with_chord_force(1.7 * held.chord_force).unwrap();
            let again = far.with_tension(found.anchor_tension()).unwrap();
            if held.tension_slope() > 1e-3 {
                let off = (again.catenary.unstrained_length - length).abs() / length;
                worst[1] = worst[1].max(off);
                assert!(off <= 1e-9, "{} {i}: {off:e}", case["kind"]);
            }
            compared += 1;
        }
    }
    accept("V-CABLE-008", worst[0]);
    assert_eq!(compared, 91);
}

/// Cables over a tilted axis with their end, from taut to about the least tension.
fn any_tilted() -> impl Strategy<Value = (Cable<'static>, Vector3<f64>, f64)> {
    let direction = || prop::array::uniform3(-1.0..1.0f64).prop_map(Vector3::from);
    let parts = (direction(), direction(), 0.3..1.3f64, 0.0..3.0f64, 0.005..0.04f64);
    let material = (-1.5..1.5f64, 4.5..7.0f64, -0.2..1.5f64);
    (parts, material).prop_filter_map("no direction", |((way, axis, chord, lead, radius), (w, ea, sigma))| {
        let end = 10f64.powf(chord) * way.try_normalize(0.1)?;
        let axis = axis.try_normalize(0.1)?;
        let away = (end - axis * axis.dot(&end)).norm();
        let radius = radius * end.norm();
        // A cable that turns back, or goes straight on, leaves the plane of its wheel undecided.
        let turned_back = end.dot(&axis).abs() > 0.75 * end.norm();
        if away < 4.0 * radius || turned_back || end.x.hypot(end.y) < 0.1 * end.norm() {
            return None;
        }
        let guide = Guide { lead, radius, entry: Entry::Along(axis.into()) };
        let cable = Cable { guide: Some(guide), ..Cable::linear(10f64.powf(w), 10f64.powf(ea)) };
        let sigma = cable.weight_per_length * end.norm() * 10f64.powf(sigma);
        (sigma < 0.02 * cable.axial_stiffness).then_some((cable, end, sigma))
    })
}

/// A central difference of the fourth order.
fn slope(at: impl Fn(f64) -> Vector3<f64>, h: f64) -> Vector3<f64> {
    (8.0 * (at(h) - at(-h)) - (at(2.0 * h) - at(-2.0 * h))) / (12.0 * h)
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 300, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn the_flexibility_in_space_is_the_derivative_of_the_end(
        (cable, end, sigma) in any_tilted(), stretch in 1.0..1.5f64,
    ) {
        let held = HeldCable::at_chord_force(&cable, end, stretch * sigma).unwrap();
        let SpatialCable { force, unstrained_length, .. } = held.in_space();
        let response = held.in_space().response();
        let at = |force, unstrained_length| SpatialCable { cable, unstrained_length, force }.response().end;
        let h = 1e-4 * horizontal(force);
        for axis in 0..3 {
            let step = Vector3::ith(axis, 1.0);
            let by_force = slope(|h| at(force + h * step, unstrained_length), h);
            let error = (by_force - response.flexibility.column(axis)).norm();
            let rounding = 1e-15 * (end.norm() + unstrained_length) / h;
            prop_assert!(error < 1e-6 * response.flexibility.norm() + 20.0 * rounding, "{axis} {error:e}");
        }
        let by_length = slope(|h| at(force, unstrained_length + h), 1e-4 * unstrained_length);
        prop_assert!((by_length - response.end_per_length).norm() < 1e-6);
    }

    #[test]
    fn the_end_moves_with_material_and_guide_as_its_slopes_say((cable, end, sigma) in any_tilted()) {
        let held = HeldCable::at_chord_force(&cable, end, sigma).unwrap();
        let slopes = held.in_space().slopes();
        let per = |property: Property| Vector3::from(slopes.fixed_columns::<1>(property as usize));
        let per_axis = slopes.fixed_columns::<3>(Property::Axis as usize);
        let at = |cable| SpatialCable { cable, ..held.in_space() }.response().end;
        let Guide { lead, radius, entry } = cable.guide.unwrap();
        let near = |one: Vector3<f64>, other: Vector3<f64>, unit: f64| {
            let size = end.norm() + held.catenary.unstrained_length;
            (one - other).norm() * unit < 1e-7 * size
        };
        let led = |lead, radius, axis: Vector3<f64>| {
            let entry = Entry::Along(axis.into());
            at(Cable { guide: Some(Guide { lead, radius, entry }), ..cable })
        };
        let axis = Vector3::from(entry.axis());
        let (w, ea) = (cable.weight_per_length, cable.axial_stiffness);
        let by_weight = slope(|h| at(Cable { weight_per_length: w + h, ..cable }), 2e-4 * w);
        prop_assert!(near(by_weight, per(Property::Weight), w));
        let by_stiffness = slope(|h| at(Cable { axial_stiffness: ea + h, ..cable }), 1e-3 * ea);
        prop_assert!(near(by_stiffness, per(Property::Stiffness), ea));
        let by_lead = slope(|h| led(lead + h, radius, axis), 1e-3);
        prop_assert!(near(by_lead, per(Property::Lead), 1.0));
        let by_radius = slope(|h| led(lead, radius + h, axis), 1e-3 * radius);
        prop_assert!(near(by_radius, per(Property::Radius), radius));
        for turn in [Vector3::x(), Vector3::y(), Vector3::z()] {
            let across = turn.cross(&axis);
            // Along the unit sphere to second order; the rest of a step is symmetric.
            let by_axis = slope(|h| led(lead, radius, (axis + h * across).normalize()), 1e-4);
            prop_assert!(near(by_axis, per_axis * across, 1.0), "{by_axis} {}", per_axis * across);
        }
    }

    #[test]
    fn derivatives_by_the_chord_force_and_the_tension_are_those_of_differences(
        (cable, end, sigma) in any_tilted(),
    ) {
        let held = HeldCable::at_chord_force(&cable, end, sigma).unwrap();
        prop_assume!(held.tension_slope() > 0.3);
        let h = 1e-3 * sigma;
        let at = |h: f64| held.with_chord_force(sigma + h).unwrap();
        let first = slope(|h| at(h).force(), h);
        prop_assert!((first - held.force_slope).norm() < 1e-6 * held.force_slope.norm());
        let length = slope(|h| Vector3::x() * at(h).catenary.unstrained_length, h).x;
        prop_assert!((length - held.length_slope).abs() < 1e-6 * length.abs() + 1e-12 * end.norm() / h);
        let second = slope(|h| at(h).force_slope, h);
        let error = (second - held.force_curvature()).norm();
        prop_assert!(error < 1e-6 * (second.norm() + held.force_slope.norm() / sigma), "{error:e}");
        let slopes = held.in_space().tension_slopes();
        let v = |held: &HeldCable| held.force_slope / held.tension_slope();
        prop_assert!((v(&held) - slopes.value).norm() < 1e-9 * slopes.value.norm());
        let t = held.tension();
        let by_tension = slope(|h| v(&held.with_tension(t + h).unwrap()), 1e-4 * t);
        let size = slopes.per_actuation.norm() + v(&held).norm() / t;
        prop_assert!((by_tension - slopes.per_actuation).norm() < 1e-5 * size);
        let at = |cable: Cable<'static>, end: Vector3<f64>| {
            v(&HeldCable::at_chord_force(&cable, end, sigma).unwrap().with_tension(t).unwrap())
        };
        for axis in 0..3 {
            let by_end = slope(|h| at(cable, end + h * Vector3::ith(axis, 1.0)), 1e-4 * end.norm());
            let exact = Vector3::from(slopes.per_end.column(axis));
            let size = slopes.per_end.norm() + v(&held).norm() / end.norm();
            prop_assert!((by_end - exact).norm() < 1e-5 * size, "{axis} {by_end} {exact}");
        }
        let radius = cable.guide.unwrap().radius;
        let led = |radius| Cable { guide: Some(Guide { radius, ..cable.guide.unwrap() }), ..cable };
        let by_radius = slope(|h| at(led(radius + h), end), 1e-3 * radius);
        let exact = Vector3::from(slopes.per_property.column(Property::Radius as usize));
        let size = exact.norm() + v(&held).norm() / radius;
        prop_assert!((by_radius - exact).norm() < 1e-5 * size);
    }

    #[test]
    fn an_axis_that_is_vertical_after_all_is_that_of_the_plane(
        (cable, end, sigma) in any_tilted(), up in any::<bool>(),
    ) {
        let entry = if up { Entry::Upwards } else { Entry::Downwards };
        let guide = Guide { entry, ..cable.guide.unwrap() };
        let plane = Cable { guide: Some(guide), ..cable };
        let along = Cable { guide: Some(Guide { entry: Entry::Along(entry.axis()), ..guide }), ..cable };
        let flat = Vector2::new(horizontal(end), end.z);
        prop_assume!(flat.x > 4.0 * guide.radius);
        let expected = HeldCable::at_chord_force(&plane, lifted(flat), sigma).unwrap();
        let found = HeldCable::at_chord_force(&along, end, sigma).unwrap();
        let length = expected.catenary.unstrained_length;
        prop_assert!((found.catenary.unstrained_length - length).abs() < 1e-12 * length);
        let force = found.catenary.force;
        prop_assert!((force - expected.catenary.force).norm() < 1e-9 * force.norm());
        let slope = expected.force_slope;
        prop_assert!((found.force_slope.norm() - slope.norm()).abs() < 1e-8 * slope.norm());
        let again = end_force(&plane, length, flat).unwrap().catenary.force;
        let spatial = spatial_end_force(&along, length, end, None).unwrap().force;
        let rounding = 1e-15 * cable.axial_stiffness;
        prop_assert!((spatial.norm() - again.norm()).abs() < 1e-9 * again.norm() + rounding);
    }
}

fn horizontal(v: Vector3<f64>) -> f64 {
    v.x.hypot(v.y)
}

/// The axis hardly tilts, so that the least tension is nearly that of a vertical one, near the rim of the
/// wheel and far from it.
#[test]
fn the_least_tension_over_a_tilted_axis_is_near_that_over_a_vertical_one() {
    let tilt = 1e-6_f64;
    let axis = [tilt.sin(), 0.0, tilt.cos()];
    for (radius, depth) in [(0.05, 3.0), (0.7, 20.0)] {
        let of = |entry| Cable { guide: Some(Guide { lead: 0.0, radius, entry }), ..Cable::linear(2.0, 1e5) };
        for beyond in [1e-2, 1.0, 30.0] {
            let (x, z) = (radius * (2.0 + beyond), -depth);
            let upright = HeldCable::at_least_tension(&of(Entry::Upwards), Vector3::new(x, 0.0, z)).unwrap();
            let tilted = of(Entry::Along(axis));
            let tilted = HeldCable::at_least_tension(&tilted, Vector3::new(x, 0.0, z)).unwrap();
            let weight = 2.0 * depth;
            let [upright, tilted] = [upright.tension(), tilted.tension()];
            assert!((upright - tilted).abs() < 1e-3 * weight, "{radius} {beyond}: {upright} {tilted}");
        }
    }
}
