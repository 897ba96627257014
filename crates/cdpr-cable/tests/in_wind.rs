//! Cables in wind.

use cdpr_cable::{Cable, CableError, CableInWind, Matrix3, Vector3, WindOverHeight, spatial_end_force};
use cdpr_evidence::accept;
use serde_json::Value;

struct Case {
    kind: String,
    weight_per_length: f64,
    length: f64,
    end: Vector3<f64>,
    cable: CableInWind<'static>,
    exit_force: Vector3<f64>,
    anchor_force: Vector3<f64>,
}

fn cases() -> Vec<Case> {
    let reference: Value = serde_json::from_str(include_str!("../../../data/reference/wind.json")).unwrap();
    let cables = reference["cables"].as_array().unwrap();
    assert_eq!(cables.len(), 9);
    let case = |of: &Value| {
        let number = |key: &str| of[key].as_f64().unwrap();
        let vector = |key: &str| Vector3::from(serde_json::from_value::<[f64; 3]>(of[key].clone()).unwrap());
        let (weight_per_length, length) = (number("weight_per_length"), number("length"));
        let cable = CableInWind {
            cable: Cable::linear(weight_per_length, number("axial_stiffness")),
            weight: Vector3::new(0.0, 0.0, -weight_per_length),
            velocity: vector("wind"),
            drag: 0.5 * 1.225 * 1.2 * number("diameter"),
            unstrained_length: length,
            guided: 0.0,
            profile: serde_json::from_value::<[f64; 3]>(of["profile"].clone())
                .ok()
                .map(|[roughness, reference, height]| WindOverHeight { roughness, reference, height }),
        };
        let [end, exit_force, anchor_force] = ["end", "exit_force", "anchor_force"].map(vector);
        let kind = of["kind"].as_str().unwrap().to_owned();
        Case { kind, weight_per_length, length, end, cable, exit_force, anchor_force }
    };
    cables.iter().map(case).collect()
}

impl Case {
    /// The force at the exit point without wind.
    fn still(&self) -> Vector3<f64> {
        let force = spatial_end_force(&self.cable.cable, self.length, self.end, None).unwrap().force;
        force - Vector3::new(0.0, 0.0, self.weight_per_length * self.length)
    }
}

#[test]
fn forces_are_those_of_an_independent_integration() {
    for case in cases() {
        let held = case.cable.held_at(case.end, case.still()).unwrap();
        assert!(held.closure < 1e-10 && held.error < 1e-10 * case.length, "{}: {held:?}", case.kind);
        let apart = [held.exit_force - case.exit_force, held.anchor_force - case.anchor_force];
        let error = apart.map(|apart| apart.norm()).into_iter().fold(0.0, f64::max);
        accept("V-CABLE-010", error / case.anchor_force.norm());
    }
}

#[test]
fn without_wind_it_is_the_catenary() {
    for case in cases() {
        let cable = CableInWind { velocity: Vector3::zeros(), ..case.cable };
        let held = cable.held_at(case.end, 1.3 * case.still()).unwrap();
        assert!((held.exit_force - case.still()).norm() < 1e-8 * case.still().norm(), "{}", case.kind);
        assert!(held.drag.norm() < 1e-9 * case.still().norm(), "{}", case.kind);
    }
}

#[test]
fn the_stiffness_is_the_derivative_of_the_force() {
    for case in cases() {
        let at = |end| case.cable.held_at(end, case.exit_force).unwrap();
        let stiffness = at(case.end).stiffness;
        let step = 1e-5 * case.length;
        let column = |k: usize| {
            let aside = Vector3::ith(k, step);
            (at(case.end + aside).anchor_force - at(case.end - aside).anchor_force) / (2.0 * step)
        };
        let differences = Matrix3::from_columns(&[column(0), column(1), column(2)]);
        assert!((stiffness - differences).norm() < 1e-4 * stiffness.norm(), "{}", case.kind);
    }
}

/// Every derivative with the ends fixed, against differences.
#[test]
fn forces_follow_weight_drag_length_stiffness_lead_and_height() {
    for case in cases() {
        let guided = CableInWind { guided: 0.2, unstrained_length: case.length + 0.2, ..case.cable };
        let held = guided.held_at(case.end, case.exit_force).unwrap();
        let slopes = guided.slopes(&held).unwrap();
        let mut compared = 0;
        let mut compare =
            |what: &str, slope: Vector3<f64>, step: f64, changed: &dyn Fn(f64) -> CableInWind<'static>| {
                let at = |by: f64| changed(by).held_at(case.end, held.exit_force).unwrap().anchor_force;
                let difference = |step: f64| (at(step) - at(-step)) / (2.0 * step);
                let difference = (4.0 * difference(0.5 * step) - difference(step)) / 3.0;
                let noise = 1e-10 * held.anchor_force.norm() / step;
                let apart = (slope - difference).norm();
                assert!(apart < 1e-6 * slope.norm() + noise, "{}, {what}: {slope} {difference}", case.kind);
                compared += 1;
            };
        let CableInWind { cable, weight, drag, unstrained_length, guided: lead, .. } = guided;
        let tension = held.anchor_force.norm();
        for k in 0..3 {
            let step = 1e-3 * weight.norm();
            compare("weight", slopes.per_weight.column(k).into(), step, &|by| CableInWind {
                weight: weight + Vector3::ith(k, by),
                ..guided
            });
        }
        compare("drag", slopes.per_drag, 1e-3 * drag, &|by| CableInWind { drag: drag + by, ..guided });
        let step = (1e-3 * tension * case.length / cable.axial_stiffness).max(1e-6 * case.length);
        compare("length", slopes.per_length, step, &|by| CableInWind {
            unstrained_length: unstrained_length + by,
            ..guided
        });
        let step = 1e-3 * cable.axial_stiffness;
        compare("stiffness", slopes.per_axial_stiffness, step, &|by| {
            let stiffer = Cable::linear(cable.weight_per_length, cable.axial_stiffness + by);
            CableInWind { cable: stiffer, ..guided }
        });
        compare("lead", slopes.per_guided, 1e-5, &|by| CableInWind { guided: lead + by, ..guided });
        let raised = |by: f64| guided.profile.map(|over| WindOverHeight { height: over.height + by, ..over });
        compare("height", slopes.per_height, 1e-3, &|by| CableInWind { profile: raised(by), ..guided });
        assert_eq!(compared, 8);
        assert!(guided.profile.is_none() == (slopes.per_height == Vector3::zeros()), "{}", case.kind);
    }
}

/// The drag has a kink at the ground, where a profile ends, and where a cable points along the wind: only the
/// steps next to it are short.
#[test]
fn kinks_of_the_drag_take_few_steps() {
    for case in cases() {
        let over_ground = WindOverHeight { roughness: 0.03, reference: 10.0, height: -0.3 * case.end[2] };
        for profile in [case.cable.profile, Some(over_ground)] {
            let held = CableInWind { profile, ..case.cable }.held_at(case.end, case.still()).unwrap();
            assert!(held.steps <= 40, "{}: {held:?}", case.kind);
        }
    }
}

/// Above a very rough ground and far up, the law is that of the reference height again.
#[test]
fn at_its_height_of_reference_a_profile_is_the_wind_itself() {
    let case = &cases()[1];
    let level = |height: f64, reference: f64| {
        let profile = Some(WindOverHeight { roughness: 0.3, reference, height });
        CableInWind { profile, ..case.cable }.held_at(case.end, case.exit_force).unwrap().drag
    };
    let everywhere = case.cable.held_at(case.end, case.exit_force).unwrap().drag;
    let far = level(1e9, 1e9);
    assert!((far - everywhere).norm() < 1e-6 * everywhere.norm(), "{far} {everywhere}");
    assert!(level(-100.0, 10.0).norm() < 1e-9 * everywhere.norm());
    assert!(level(40.0, 10.0).norm() > 1.5 * everywhere.norm());
}

#[test]
fn what_has_no_answer_says_so() {
    let case = &cases()[0];
    let cable = CableInWind { unstrained_length: 7.0, ..case.cable };
    let error = cable.held_at(case.end, case.still()).unwrap_err();
    assert!(matches!(error, CableError::Overstrained { .. }), "{error}");
    let error = case.cable.held_at(case.end, Vector3::repeat(f64::NAN)).unwrap_err();
    assert!(matches!(error, CableError::NotConverged { .. }), "{error}");
}
