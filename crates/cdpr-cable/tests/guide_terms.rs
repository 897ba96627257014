//! What the equations of a guide say in closed form against dual numbers and differences.

use crate::common::{by, in_space};
use approx::assert_relative_eq;
use cdpr_cable::kernel::{GuideTerms, LawSegment, Material, SwivelAxis, Way};
use cdpr_cable::{Cable, Catenary, ElasticLaw, Entry, Guide, PiecewiseLaw, Property, Segment, Vector2};
use cdpr_number::Dual;
use proptest::prelude::*;

fn law() -> PiecewiseLaw {
    let segments = [(0.0, 0.7), (400.0, 1.3)].map(|(tension, ratio)| Segment { tension, ratio });
    PiecewiseLaw::new(0.0, &segments).unwrap()
}

/// A cable on a guide and the force at A.
fn led() -> impl Strategy<Value = (Cable<'static>, f64, Vector2<f64>)> {
    let guide = (prop_oneof![Just(0.0), 0.1..5.0f64], prop_oneof![Just(0.0), 0.01..0.5f64], any::<bool>());
    (guide, 0.0..5.0f64, 1e4..1e7f64, 2.0..30.0f64, 1.0..2e3f64, -2.0..3.0f64).prop_map(
        |((lead, radius, up), w, ea, length, fx, slope)| {
            let entry = if up { Entry::Upwards } else { Entry::Downwards };
            let guide = Some(Guide { lead, radius, entry });
            (Cable { guide, ..Cable::linear(w, ea) }, length, Vector2::new(fx, slope * fx))
        },
    )
}

fn compare(catenary: &Catenary, segments: &[LawSegment]) {
    let Catenary { cable, unstrained_length, force } = *catenary;
    let (w, flexibility, guide) =
        (cable.weight_per_length, 1.0 / cable.axial_stiffness, cable.guide.unwrap());
    let (free, force) = (catenary.free_length(), force.into());
    let axis = SwivelAxis::Vertical(guide.radius * guide.entry.axis()[2]);
    let terms = GuideTerms { lead: guide.lead, radius: guide.radius, axis };
    let leave = terms.leave_point(w, free, force);
    let material = Material { law: segments, weight_per_length: w, axial_flexibility: flexibility };
    let way = terms.way(w, free, leave, material.stretch(leave.tension));
    assert_relative_eq!(way.length, unstrained_length, max_relative = 1e-11);
    compare_slopes(catenary, &terms, &way, segments);
    // dLf by the force and by the length, against differences.
    let at = |length: f64, force: [f64; 2]| {
        Catenary { unstrained_length: length, force: force.into(), ..*catenary }.free_length()
    };
    let step = 1e-4 * force[0];
    let slope = |along: [f64; 2]| {
        let [x, z] = along.map(|component| component * step);
        let ends = [1.0, -1.0].map(|sign| at(unstrained_length, [force[0] + sign * x, force[1] + sign * z]));
        (ends[0] - ends[1]) / (2.0 * step)
    };
    let per_length = (at(unstrained_length + 1e-4, force) - at(unstrained_length - 1e-4, force)) / 2e-4;
    let kinked = !segments.is_empty() && (leave.tension - 400.0).abs() < 2.0 * step + 10.0;
    if !kinked {
        let error = 1e-10 * unstrained_length / step;
        let scale = (guide.radius + guide.lead * leave.tension * flexibility) / leave.tension;
        for (found, expected) in way.free_per_force.into_iter().zip([slope([1.0, 0.0]), slope([0.0, 1.0])]) {
            assert_relative_eq!(found, expected, epsilon = 1e-5 * scale + error);
        }
        assert_relative_eq!(way.free_per_length, per_length, epsilon = 1e-6);
    }
}

fn compare_slopes(catenary: &Catenary, guide: &GuideTerms<f64>, way: &Way<f64>, segments: &[LawSegment]) {
    let Catenary { cable, force, .. } = *catenary;
    let (w, flexibility, free) =
        (cable.weight_per_length, 1.0 / cable.axial_stiffness, catenary.free_length());
    let force = <[f64; 2]>::from(force).map(Dual::<_, 1>::constant);
    let end = |w, flexibility| {
        let free = Dual::constant(free);
        let end =
            Material { law: segments, weight_per_length: w, axial_flexibility: flexibility }.end(free, force);
        end.end.map(|component| component.slopes[0])
    };
    let heavier = end(Dual::input(w, 0), Dual::constant(flexibility));
    let softer = end(Dual::constant(w), Dual::input(flexibility, 0));
    let found = guide.end_slopes(way, [flexibility, free], [heavier, softer]);
    let close = |found: [f64; 2], expected: Vector2<f64>, scale: f64| {
        assert_relative_eq!(Vector2::from(found), expected, epsilon = 1e-10 * scale);
    };
    let slopes = in_space(catenary).slopes();
    let weight = by(&slopes, Property::Weight);
    close(found.per_weight, weight, weight.norm());
    let softer = by(&slopes, Property::Stiffness) * -cable.axial_stiffness.powi(2);
    close(found.per_flexibility, softer, softer.norm());
    close(found.per_lead, by(&slopes, Property::Lead), 1.0);
    if guide.radius > 0.0 {
        close(found.per_radius, by(&slopes, Property::Radius), 3.0);
        let axis = slopes.fixed_columns::<3>(Property::Axis as usize);
        close(found.per_axis, Vector2::new(axis[(0, 0)], axis[(2, 0)]), guide.radius);
        assert_relative_eq!(axis[(1, 0)], 0.0, epsilon = 1e-10);
        close([found.across_per_axis, 0.0], Vector2::new(axis[(1, 1)], axis[(2, 1)]), axis.norm());
    }
}

proptest! {
    #![proptest_config(ProptestConfig { failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn the_closed_forms_of_a_guide_are_what_dual_numbers_and_differences_say((cable, length, force) in led()) {
        let guide = cable.guide.unwrap();
        let length = length + guide.lead + 4.0 * guide.radius;
        compare(&Catenary { cable, unstrained_length: length, force }, &[]);
        let law = law();
        let cable = Cable { law: ElasticLaw::Piecewise(&law), ..cable };
        let catenary = Catenary { cable, unstrained_length: length, force };
        compare(&catenary, law.terms());
    }
}
