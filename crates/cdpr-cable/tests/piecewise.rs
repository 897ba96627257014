//! Cables with a piecewise linear law.
//!
//! They are held against the linear cable, numerical integration (`data/reference/piecewise.py`) and
//! differences.

use crate::common::{by, in_space};
use approx::assert_relative_eq;
use cdpr_cable::{
    Cable, Catenary, ElasticLaw, Matrix2, PiecewiseLaw, Property, Segment, Vector2, end_force,
    end_force_near, length_for_tension,
};
use proptest::prelude::*;
use serde_json::Value;

fn cable(law: &PiecewiseLaw, weight_per_length: f64, axial_stiffness: f64) -> Cable<'_> {
    Cable { law: ElasticLaw::Piecewise(law), ..Cable::linear(weight_per_length, axial_stiffness) }
}

/// A law from the tension at which each of its segments begins and its stiffness over the cable's.
fn law(segments: &[(f64, f64)]) -> PiecewiseLaw {
    let segment = |&(tension, ratio): &(f64, f64)| Segment { tension, ratio };
    PiecewiseLaw::new(0.0, &segments.iter().map(segment).collect::<Vec<_>>()).unwrap()
}

fn stiffening() -> PiecewiseLaw {
    law(&[(0.0, 0.7), (100.0, 0.8), (500.0, 1.0), (1000.0, 1.2)])
}

#[test]
fn the_end_is_that_of_the_integrated_differential_equations() {
    let text = include_str!("../../../data/reference/piecewise.json");
    let cases: Vec<Value> = serde_json::from_str(text).unwrap();
    assert_eq!(cases.len(), 10);
    for case in &cases {
        let number = |key: &str| case[key].as_f64().unwrap();
        let digits = |key: &str| case[key].as_str().unwrap().parse::<f64>().unwrap();
        let segments: Vec<(f64, f64)> = serde_json::from_value(case["segments"].clone()).unwrap();
        let law = law(&segments);
        let force: [f64; 2] = serde_json::from_value(case["force"].clone()).unwrap();
        let catenary = Catenary {
            cable: cable(&law, number("weight_per_length"), number("axial_stiffness")),
            unstrained_length: number("unstrained_length"),
            force: force.into(),
        };
        let end = Vector2::new(digits("x"), digits("z"));
        let error = (catenary.end_position() - end).norm() / catenary.unstrained_length;
        println!("{}: {error:.1e} of the length", case["kind"]);
        assert!(error < 1e-14, "{}: {error:e}", case["kind"]);
        assert_relative_eq!(catenary.end_position().x, end.x, max_relative = 1e-9);
        // And back: the force that the end position asks for.
        let found = end_force(&catenary.cable, catenary.unstrained_length, end).unwrap().catenary.force;
        let known = 4.0 * f64::EPSILON * (end.norm() + catenary.unstrained_length);
        let bound = known * catenary.in_plane_stiffness().norm();
        assert!(
            (found - catenary.force).norm() < (1e-9 * catenary.force.norm()).max(bound),
            "{}: {found}",
            case["kind"]
        );
    }
}

/// Cables from taut to folded, whose tensions lie around the kinks of the law above.
fn any_cable() -> impl Strategy<Value = (f64, f64, f64, Vector2<f64>)> {
    (-1.0..1.5f64, 4.0..6.5f64, 0.0..1.8f64, 0.5..3.2f64, -1.4..1.5f64).prop_map(|(w, ea, l, t, angle)| {
        let force = 10f64.powf(t) * Vector2::new(angle.cos(), angle.sin());
        (10f64.powf(w), 10f64.powf(ea), 10f64.powf(l), force)
    })
}

/// Derivative along h by differences of fourth order.
fn slope<T>(step: f64, at: impl Fn(f64) -> T) -> T
where
    T: std::ops::Sub<Output = T> + std::ops::Mul<f64, Output = T> + std::ops::Div<f64, Output = T>,
{
    ((at(step) - at(-step)) * 8.0 - (at(2.0 * step) - at(-2.0 * step))) / (12.0 * step)
}

proptest! {
    #![proptest_config(ProptestConfig { failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn segments_of_the_same_modulus_are_the_linear_cable((w, ea, unstrained_length, force) in any_cable()) {
        let law = law(&[(0.0, 1.0), (50.0, 1.0), (200.0, 1.0), (700.0, 1.0)]);
        let linear = Catenary { cable: Cable::linear(w, ea), unstrained_length, force };
        let pieces = Catenary { cable: cable(&law, w, ea), ..linear };
        let scale = linear.end_position().norm() + unstrained_length;
        prop_assert!((pieces.end_position() - linear.end_position()).norm() < 1e-12 * scale);
        let (p, l) = (pieces.response(), linear.response());
        let [p_flexibility, l_flexibility] = [p, l].map(|of| of.flexibility_matrix());
        prop_assert!((p_flexibility - l_flexibility).norm() < 1e-12 * l_flexibility.norm());
        // Rounding of the flexibility across the cable beside the one along it.
        let stiff = ea / linear.exit_tension().min(linear.anchor_tension()).max(force.x);
        prop_assert!((p.determinant / l.determinant - 1.0).abs() < 1e-12 + 1e-15 * stiff);
        prop_assert!((p.lateral_flexibility / l.lateral_flexibility - 1.0).abs() < 1e-12);
        prop_assert!((Vector2::from(p.end_per_length) - Vector2::from(l.end_per_length)).norm()
            < 1e-12 * Vector2::from(l.end_per_length).norm());
        let [of_pieces, of_linear] = [&pieces, &linear].map(|of| in_space(of).slopes());
        let [pieces_weight, weight] = [&of_pieces, &of_linear].map(|of| by(of, Property::Weight));
        let weights = (pieces_weight - weight).norm();
        let rotated = l_flexibility.norm() * unstrained_length;
        prop_assert!(weights < 1e-12 * (weight.norm() + rotated));
        let stiffness = by(&of_linear, Property::Stiffness);
        let size = stiffness.norm() + force.norm() * unstrained_length / (ea * ea);
        let error = (by(&of_pieces, Property::Stiffness) - stiffness).norm();
        prop_assert!(error < 1e-12 * size + 1e-15 * scale / ea);
        let energy = force.norm() * scale;
        prop_assert!((pieces.complementary_energy() - linear.complementary_energy()).abs() < 1e-12 * energy);
        prop_assert!((pieces.potential_energy() - linear.potential_energy()).abs() < 1e-12 * energy);
        let end = linear.end_position();
        prop_assume!(end.x > 0.0);
        let solve = |c: Catenary| end_force(&c.cable, unstrained_length, end).unwrap().catenary.force;
        let [same, other] = [solve(pieces), solve(linear)];
        let known = 1e-12 * force.norm() + 1e-14 * scale * linear.in_plane_stiffness().norm();
        prop_assert!((same - other).norm() < known);
    }

    #[test]
    fn derivatives_are_those_of_differences_also_across_kinks(
        (w, ea, unstrained_length, force) in any_cable(),
    ) {
        let law = stiffening();
        let c = Catenary { cable: cable(&law, w, ea), unstrained_length, force };
        prop_assume!(c.force.x > 0.05 * force.norm() && c.exit_tension() > 1e-2 * c.weight());
        // The flexibility bends where an end's tension meets a kink: differences have no order there.
        let step = 1e-4 * force.x;
        let near = [100.0, 500.0, 1000.0].iter().any(|kink| {
            [c.anchor_tension(), c.exit_tension(), force.x].iter().any(|t| (t - kink).abs() < 10.0 * step)
        });
        prop_assume!(!near);
        let response = c.response();
        let flexibility = response.flexibility_matrix();
        let scale = c.end_position().norm() + unstrained_length;
        let tolerance = |size: f64, step: f64| 1e-6 * size + 50.0 * f64::EPSILON * scale / step;
        for (j, direction) in [Vector2::x(), Vector2::y()].into_iter().enumerate() {
            let end = slope(step, |h| Catenary { force: c.force + direction * h, ..c }.end_position());
            let error = (end - flexibility.column(j)).norm();
            prop_assert!(error < tolerance(flexibility.norm(), step), "flexibility {error:e}");
            let at = |h: f64| Catenary { force: c.force + direction * h, ..c };
            let energy = slope(step, |h| at(h).complementary_energy());
            prop_assert!((energy - response.end[j]).abs() < 1e-7 * scale, "energy");
        }
        let at = |unstrained_length| Catenary { unstrained_length, ..c }.end_position();
        let h = 1e-5 * unstrained_length;
        let per_length = slope(h, |h| at(unstrained_length + h));
        prop_assert!((per_length - Vector2::from(response.end_per_length)).norm() < 1e-6, "length {per_length}");
        let h = 1e-5 * w;
        let per_weight = slope(h, |h| Catenary { cable: cable(&law, w + h, ea), ..c }.end_position());
        let slopes = in_space(&c).slopes();
        let exact = by(&slopes, Property::Weight);
        let size = exact.norm() + flexibility.norm() * unstrained_length;
        prop_assert!((per_weight - exact).norm() < tolerance(size, h), "weight {per_weight}");
        let h = 1e-3 * ea;
        let per_stiffness = slope(h, |h| Catenary { cable: cable(&law, w, ea + h), ..c }.end_position());
        let expected = by(&slopes, Property::Stiffness);
        prop_assert!((per_stiffness - expected).norm() < tolerance(expected.norm(), h));
        let products = flexibility.m11 * flexibility.m22;
        prop_assert!((response.determinant - flexibility.determinant()).abs() < 1e-13 * products);
        prop_assert!(response.determinant > 0.0);
    }

    #[test]
    fn force_and_length_are_found_again((w, ea, unstrained_length, force) in any_cable()) {
        let law = stiffening();
        let c = Catenary { cable: cable(&law, w, ea), unstrained_length, force };
        let end = c.end_position();
        prop_assume!(end.x > 0.0);
        let known = 1e-14 * (end.norm() + unstrained_length) * c.in_plane_stiffness().norm();
        let found = end_force(&c.cable, unstrained_length, end).unwrap().catenary;
        prop_assert!((found.force - force).norm() < 1e-9 * force.norm() + known, "{}", found.force);
        let near = Catenary { force: force * 1.1, ..c };
        let found = end_force_near(&near, end).unwrap().catenary;
        prop_assert!((found.force - force).norm() < 1e-9 * force.norm() + known, "{}", found.force);
        let wound = length_for_tension(&c.cable, end, force.norm()).unwrap().catenary;
        prop_assert!((wound.end_position() - end).norm() < 1e-12 * (end.norm() + unstrained_length));
        prop_assert!((wound.anchor_tension() / force.norm() - 1.0).abs() < 1e-9);
    }
}

#[test]
fn the_potential_energy_has_the_force_for_its_gradient() {
    let law = stiffening();
    for (w, length, x, z) in [(1.0, 4.4, 4.3, 0.95), (20.0, 60.0, 40.0, 10.0), (20.0, 100.0, 20.0, 5.0)] {
        let cable = cable(&law, w, 1e5);
        let at = |end: Vector2<f64>| end_force(&cable, length, end).unwrap().catenary;
        let end = Vector2::new(x, z);
        let gradient =
            [Vector2::x(), Vector2::y()].map(|d| slope(1e-4, |h| at(end + d * h).potential_energy()));
        assert_relative_eq!(Vector2::from(gradient), at(end).force, max_relative = 1e-6);
    }
}

#[test]
fn a_cable_without_weight_is_a_spring_of_its_law() {
    let law = stiffening();
    let cable = cable(&law, 0.0, 1e4);
    // 100 N/0.7 + 400 N/0.8 + 100 N/1 over EA.
    let strain = (100.0 / 0.7 + 500.0 + 100.0) / 1e4;
    let end = Vector2::new(0.6, 0.8) * 2.0 * (1.0 + strain);
    let found = end_force(&cable, 2.0, end).unwrap();
    assert_relative_eq!(found.catenary.force, Vector2::new(360.0, 480.0), max_relative = 1e-12);
    assert!(found.residual < 1e-14);
    assert_eq!(end_force(&cable, 2.0, Vector2::new(1.0, 1.0)).unwrap().catenary.force, Vector2::zeros());
}

#[test]
fn a_vertical_cable_hangs_taut_folded_or_pulled_up() {
    let law = stiffening();
    let cable = cable(&law, 10.0, 1e4);
    for (z, length) in [(-20.5, 20.0), (-21.5, 20.0), (3.0, 20.0), (20.4, 20.0), (22.0, 20.0), (-3.0, 20.0)] {
        let solution = end_force(&cable, length, Vector2::new(0.0, z)).unwrap();
        assert_eq!(solution.catenary.force.x, 0.0);
        assert!(solution.residual < 1e-13 * length, "{z}: {:e}", solution.residual);
        let beside = end_force(&cable, length, Vector2::new(1e-9, z)).unwrap().catenary;
        assert!((beside.force.y - solution.catenary.force.y).abs() < 1e-5, "{z}");
    }
}

#[test]
fn a_cable_that_kept_strain_is_a_longer_one() {
    let kept = PiecewiseLaw::new(1e4 * 2e-3, &[Segment { tension: 0.0, ratio: 1.0 }]).unwrap();
    let cable = cable(&kept, 20.0, 1e4);
    let force = Vector2::new(200.0, 300.0);
    let c = Catenary { cable, unstrained_length: 10.0, force };
    // Its shape is that of 10.02 m of a cable that has the same weight in all and the same elongation.
    let longer =
        Catenary { cable: Cable::linear(20.0 / 1.002, 1e4 * 1.002), unstrained_length: 10.02, force };
    assert_relative_eq!(c.end_position(), longer.end_position(), max_relative = 1e-13);
    let stiffness: Matrix2<f64> = longer.in_plane_stiffness();
    assert_relative_eq!(c.in_plane_stiffness(), stiffness, max_relative = 1e-11);
}
