//! Proofs by partial factors: against closed forms, and against the answer without factors.

use cdpr_assess::{
    AnyWeather, Breaks, CaseFactors, FactoredCase, Further, PartialFactors, Safety, Situation, Workspace,
    WorkspaceSummary, compute_workspace, factored_cases, safety_at, winds,
};
use cdpr_robot::{Coordinate, Pose, Robot, Rotation3, Vector3, Wrench};
use cdpr_statics::weather::{Weather, Wind};
use cdpr_statics::{Load, StaticsError, WantedPose};
use cdpr_study::{Grid, GridAxis};

const G: f64 = 9.81;
/// Breaking force of the cables below [N].
const FORCE: f64 = 5000.0;

/// A beam of 100 kg in the plane xz, 2 m long, that hangs on two vertical cables; its centre of mass is 0.5 m
/// below their anchor points.
fn beam(linear_density: f64) -> Robot {
    let text = format!(
        r#"{{"format": "cdpr-robot/1", "name": "Beam", "gravity": {G}, "plane": "xz",
        "platform": {{"mass": 100, "center_of_mass": [0, 0, -0.5]}},
        "cable": {{"diameter": 0.01, "section": 1e-4, "youngs_modulus": 1e11,
            "linear_density": {linear_density}, "breaking_force": {FORCE}}},
        "tension_limits": {{"min": 1, "max": 4000}},
        "cables": [{{"exit_point": [-1, 0, 10], "anchor_point": [-1, 0, 0]}},
            {{"exit_point": [1, 0, 10], "anchor_point": [1, 0, 0]}}]}}"#
    );
    Robot::from_json(&text).unwrap()
}

fn library(name: &str) -> Robot {
    let path = format!("{}/../../data/robots/{name}.json", env!("CARGO_MANIFEST_DIR"));
    Robot::from_json(&std::fs::read_to_string(path).unwrap()).unwrap()
}

fn factors(persistent: [f64; 3], accidental: [f64; 3]) -> PartialFactors {
    let of = |[permanent, variable, resistance]: [f64; 3]| CaseFactors { permanent, variable, resistance };
    PartialFactors { persistent: of(persistent), accidental: of(accidental) }
}

fn hung(robot: &Robot, load: &Load) -> Safety {
    let pose = Pose::at(0.0, 0.0, 4.0);
    let wanted = WantedPose::at(&pose).free(&[Coordinate::X]);
    safety_at(robot, wanted, load, Breaks::default()).unwrap()
}

fn proof(robot: &Robot, held: &Safety, load: &Load, given: &PartialFactors) -> Vec<FactoredCase> {
    factored_cases(robot, held, load, given, None).unwrap()
}

/// The utilization of a case.
fn eta(case: &FactoredCase) -> f64 {
    case.utilization().unwrap_or_else(|| panic!("{case:?}")).value()
}

#[test]
fn two_vertical_cables_share_the_design_weight_and_one_bears_it_alone() {
    let (given, load) = (factors([1.35, 1.5, 1.6], [1.1, 0.5, 1.2]), Load::payload(20.0));
    for density in [0.0, 0.4] {
        let robot = beam(density);
        let held = hung(&robot, &load);
        let cases = proof(&robot, &held, &load, &given);
        assert_eq!(cases.len(), 3);
        // Where a cable leaves its exit its tension is greater by its weight.
        let weight = |i: usize, factor: f64| factor * density * held.lengths[i] * G;
        let whole = 0.5 * (1.35 * 100.0 + 1.5 * 20.0) * G + weight(0, 1.35);
        let expected = whole * 1.6 / FORCE;
        assert!((eta(&cases[0]) / expected - 1.0).abs() < 1e-7, "{} {expected}", eta(&cases[0]));
        for (k, case) in cases[1..].iter().enumerate() {
            assert_eq!(case.situation, Situation::Broken(vec![k]));
            let alone = (1.1 * 100.0 + 0.5 * 20.0) * G + weight(1 - k, 1.1);
            let expected = alone * 1.2 / FORCE;
            let found = case.utilization().unwrap();
            assert_eq!(found.cable, 1 - k);
            assert!((found.value() / expected - 1.0).abs() < 1e-7, "{} {expected}", found.value());
            assert_eq!(found.resistance, FORCE / 1.2);
            // The beam hangs with its centre of mass below the anchor point that is left.
            let turned = case.rest.as_ref().unwrap().turned;
            assert!((turned - 2.0_f64.atan()).abs() < 1e-6, "{turned}");
        }
    }
}

#[test]
fn utilization_grows_with_each_factor_as_it_must() {
    let (robot, load) = (beam(0.0), Load::payload(50.0));
    let held = hung(&robot, &load);
    let of = |persistent, accidental| -> [f64; 2] {
        let cases = proof(&robot, &held, &load, &factors(persistent, accidental));
        [eta(&cases[0]), eta(&cases[1])]
    };
    let [whole, alone] = of([1.0; 3], [1.0; 3]);
    let near = |one: f64, other: f64| assert!((one / other - 1.0).abs() < 1e-7, "{one} {other}");
    // 100 kg of the 150 kg are the platform.
    near(of([1.3, 1.0, 1.0], [1.0; 3])[0], whole * 180.0 / 150.0);
    near(of([1.0, 1.6, 1.0], [1.0; 3])[0], whole * 180.0 / 150.0);
    near(of([1.0, 0.0, 1.0], [1.0; 3])[0], whole * 100.0 / 150.0);
    near(of([1.0, 1.0, 2.5], [1.0; 3])[0], whole * 2.5);
    near(of([1.0; 3], [1.2, 1.2, 1.0])[1], alone * 1.2);
    near(of([1.0; 3], [1.0, 1.0, 1.7])[1], alone * 1.7);
    // The factors of one situation do not act in the other.
    assert_eq!(of([1.3, 1.6, 2.5], [1.0; 3])[1], alone);
    assert_eq!(of([1.0; 3], [1.3, 1.6, 2.5])[0], whole);
}

/// Robots that differ, each with a pose that it holds.
fn robots() -> Vec<(Robot, Pose)> {
    let at = |name: &str, [x, y, z]: [f64; 3]| (library(name), Pose::at(x, y, z));
    vec![
        at("caroca", [0.5, 0.2, 1.75]),
        at("fast", [0.0, 0.0, 140.1]),
        at("macarm", [1.17, 1.17, 1.17]),
        at("hrpcables", [-0.03, 0.01, 0.72]),
    ]
}

#[test]
fn factors_of_one_change_no_digit() {
    let wind = Wind::new(Vector3::new(8.0, 3.0, 0.0)).unwrap();
    let weather = Weather { wind, ice: 0.002, ..Weather::default() };
    let question = AnyWeather { weather, speed: None };
    for (robot, pose) in robots() {
        let load = Load::payload(0.1 * robot.platform.mass);
        let held = safety_at(&robot, WantedPose::at(&pose), &load, Breaks::default()).unwrap();
        let blown = winds(&robot, &held.lengths, &load, [&held.pose, &held.pose], &question).unwrap();
        let given = PartialFactors::ONE;
        let cases = factored_cases(&robot, &held, &load, &given, Some((&question, &blown))).unwrap();
        assert_eq!(cases.len(), 2 + held.broken.len());
        let factor = |case: &FactoredCase| 1.0 / case.known().unwrap().value();
        let near = |one: f64, other: f64| assert!((one / other - 1.0).abs() < 1e-14, "{one} {other}");
        near(factor(&cases[0]), held.safety_factor.unwrap().0);
        near(factor(cases.last().unwrap()), blown.least_safe().unwrap().1);
        for (case, broken) in cases[1..].iter().zip(&held.broken) {
            let (Ok(rest), Ok(given)) = (&case.rest, &broken.rest) else { panic!("{case:?}") };
            near(factor(case), given.safety_factor.unwrap().0);
            assert_eq!((rest.moved, rest.turned), (given.moved, given.turned));
        }
        // Factors next to 1 are no shortcut: they solve every case again.
        let close = factors([1.0 + 1e-9, 1.0 + 1e-9, 1.0], [1.0 + 1e-9, 1.0 + 1e-9, 1.0]);
        let solved = factored_cases(&robot, &held, &load, &close, Some((&question, &blown))).unwrap();
        for (one, other) in cases.iter().zip(&solved) {
            let [one, other] = [one, other].map(|case| case.known().unwrap().value());
            assert!((one / other - 1.0).abs() < 1e-6, "{}: {one} {other}", robot.name);
        }
    }
}

#[test]
fn a_payload_is_a_force_of_its_weight() {
    // The centre of mass is P, so that the weight has no moment.
    let robot = library("caroca");
    let pose = Pose::at(0.5, 0.2, 1.75);
    let weight = Wrench { force: Vector3::new(0.0, 0.0, -50.0 * 9.81), moment: Vector3::zeros() };
    let given = factors([1.35, 1.5, 1.5], [1.0, 0.7, 1.3]);
    let [payload, force] = [Load::payload(50.0), Load::wrench(weight)].map(|load| {
        let held = safety_at(&robot, WantedPose::at(&pose), &load, Breaks::default()).unwrap();
        proof(&robot, &held, &load, &given)
    });
    assert_eq!(payload.len(), 9);
    for (one, other) in payload.iter().zip(&force) {
        assert!((eta(one) / eta(other) - 1.0).abs() < 1e-6, "{one:?} {other:?}");
    }
}

#[test]
fn the_factor_of_a_wind_is_that_of_its_pressure() {
    let (robot, pose) = (library("cogiro"), Pose::at(0.0, 0.0, 2.0));
    let mut robot = robot;
    robot.cables.iter_mut().for_each(|cable| cable.properties.breaking_force = Some(8000.0));
    let load = Load::none();
    let held = safety_at(&robot, WantedPose::at(&pose), &load, Breaks::default()).unwrap();
    let blown = |speed: f64, given: PartialFactors| {
        let wind = Wind::new(Vector3::new(speed, 0.0, 0.0)).unwrap();
        let question = AnyWeather { weather: Weather { wind, ..Weather::default() }, speed: None };
        let found = winds(&robot, &held.lengths, &load, [&held.pose, &held.pose], &question).unwrap();
        eta(factored_cases(&robot, &held, &load, &given, Some((&question, &found))).unwrap().last().unwrap())
    };
    let one = blown(30.0, factors([1.0, 2.25, 1.0], [1.0; 3]));
    let other = blown(45.0, PartialFactors::ONE);
    assert!((one / other - 1.0).abs() < 1e-9, "{one} {other}");
    let fast = factors([1.0, 2.25, 1.0], [1.0; 3]);
    let question = AnyWeather { speed: Some(100.0), ..AnyWeather::default() };
    let calm = AnyWeather::default();
    let found = winds(&robot, &held.lengths, &load, [&held.pose, &held.pose], &calm).unwrap();
    let refused = factored_cases(&robot, &held, &load, &fast, Some((&question, &found))).unwrap_err();
    assert!(refused.to_string().contains("with the factor 2.25 of variable loads"), "{refused}");
}

#[test]
fn ice_is_a_variable_load_and_the_cable_a_permanent_one() {
    // A vertical cable whose tension at the exit is that of all weights below.
    let (robot, load) = (beam(0.4), Load::none());
    let held = hung(&robot, &load);
    let ice = Weather { ice: 0.01, ..Weather::default() };
    let question = AnyWeather { weather: ice, speed: None };
    let found = winds(&robot, &held.lengths, &load, [&held.pose, &held.pose], &question).unwrap();
    let given = factors([1.35, 1.5, 1.0], [1.0; 3]);
    let cases = factored_cases(&robot, &held, &load, &given, Some((&question, &found))).unwrap();
    let ice = 900.0 * std::f64::consts::PI * 0.01 * 0.02;
    let expected = (0.5 * 1.35 * 100.0 + (1.35 * 0.4 + 1.5 * ice) * held.lengths[0]) * G;
    let tension = cases.last().unwrap().utilization().unwrap().tension;
    assert!((tension / expected - 1.0).abs() < 1e-7, "{tension} {expected}");
}

#[test]
fn a_cable_without_breaking_force_leaves_its_cases_open() {
    let load = Load::none();
    let mut robot = beam(0.0);
    robot.cables[1].properties.breaking_force = None;
    let held = hung(&robot, &load);
    let cases = proof(&robot, &held, &load, &PartialFactors::ONE);
    let open: Vec<_> = cases.iter().map(FactoredCase::open).collect();
    let reason = Some("cable 2 has no breaking_force".to_owned());
    assert_eq!(open, [reason.clone(), reason, None]);
    assert_eq!(cases[0].utilization(), None);
    assert!(cases[0].known().is_some() && cases[2].utilization().is_some());
    // What is known may be too much, whatever the other cable bears.
    let cases = proof(&robot, &held, &load, &factors([1.0, 1.0, 20.0], [1.0; 3]));
    assert!(cases[0].is_exceeded() && cases[0].utilization().is_some() && cases[0].open().is_some());
    for wrong in [135.0, 0.0, f64::NAN] {
        let refused = factored_cases(&robot, &held, &load, &factors([wrong, 1.0, 1.0], [1.0; 3]), None);
        let Err(StaticsError::Invalid { field, .. }) = &refused else { panic!("{refused:?}") };
        assert_eq!(field, "factors.persistent.permanent");
    }
}

#[test]
fn a_map_has_the_greatest_utilization_of_each_position() {
    let robot = library("caroca");
    let load = Load::payload(20.0);
    let given = factors([1.35, 1.5, 8.0], [1.0, 1.0, 4.0]);
    let axis = |min: f64, max: f64, points| GridAxis { min, max, points };
    let workspace = Workspace {
        robot: &robot,
        grid: Grid::new([axis(-1.0, 1.0, 2), axis(0.5, 6.0, 2), axis(1.75, 1.75, 1)]).unwrap(),
        rotation: Rotation3::identity(),
        load,
        tolerances: None,
        free: &[],
        further: Further { breaks: Some(given), ..Further::default() },
    };
    let poses = compute_workspace(&workspace, &|| (), &|| false).unwrap();
    let summary = WorkspaceSummary::new(&workspace, &poses);
    for row in &summary.rows {
        let pose = Pose::at(row.x_m, row.y_m, row.z_m);
        let Ok(held) = safety_at(&robot, WantedPose::at(&pose), &load, Breaks::default()) else {
            // Out of the frame.
            assert!(row.utilization.is_none() && row.break_reason.is_some(), "{row:?}");
            continue;
        };
        let cases = proof(&robot, &held, &load, &given);
        let most = cases.iter().map(eta).fold(0.0, f64::max);
        assert_eq!(row.utilization, Some(most));
        let far = held.broken.iter().map(|one| one.rest.as_ref().unwrap().moved).fold(0.0, f64::max);
        assert_eq!(row.break_moved_mm, Some(1e3 * far));
        assert!(row.utilization_case.is_some() && row.utilization_cable.is_some());
    }
    assert!(summary.rows.iter().any(|row| row.utilization.is_some()));
    assert!(summary.rows.iter().any(|row| row.utilization.is_none()));
    assert_eq!(summary.factors, Some(given));
}
