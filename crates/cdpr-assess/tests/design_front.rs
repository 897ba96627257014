//! Pareto fronts that are known in closed form, or by evaluating everything.

use crate::design::{HEIGHT, PLACES, apart, caroca, data, one_by_one, planar, with};
use cdpr_assess::{DesignProblem, Front, front};
use cdpr_robot::Robot;
use serde_json::{Value, json};
use std::path::Path;

fn solve(file: &Value, robot: Robot) -> Front {
    let problem = DesignProblem::from_json(&file.to_string(), Path::new("design.json"), robot).unwrap();
    assert!(problem.has_front());
    front(&problem).unwrap()
}

/// The deflection [mm] of [`planar`] for 1 N along x, and its stiffness along z [N/m], the lowest one below
/// 45°: by `k_x = (2 EA sin θ cos² θ + W)/H` and `k_z = (2 EA sin³ θ + W)/H`.
fn both(sine: f64) -> [f64; 2] {
    let k_x = (2e6 * sine * (1.0 - sine * sine) + 981.0) / HEIGHT;
    [1e3 / k_x, (2e6 * sine.powi(3) + 981.0) / HEIGHT]
}

#[test]
fn the_front_of_a_mass_on_two_cables_is_that_of_its_angles_between_both_optima() {
    let second = json!({"output": "stiffness", "over": "worst", "points": 7});
    let file = with(apart([-6.0, -2.1], 1.0), "/pareto", second);
    let found = solve(&file, planar(3.0, 1e6));
    assert_eq!((found.points.len(), found.dominated, found.lost), (7, 0, 0), "{found:?}");
    // The least deflection is at tan² θ = 1/2, the greatest stiffness along z where the bound is.
    let ends = [2.0_f64.sqrt() * HEIGHT, 2.1].map(|h| HEIGHT / h.hypot(HEIGHT));
    let stiffness = ends.map(|sine| both(sine)[1]);
    for (k, point) in found.points.iter().enumerate() {
        assert!(point.optimal && point.kkt_residual.unwrap() <= 1e-8, "{point:?}");
        let [deflection, along_z] = point.objectives;
        let wanted = stiffness[0] + (stiffness[1] - stiffness[0]) * k as f64 / 6.0;
        assert!((along_z / wanted - 1.0).abs() < 1e-5, "{k}: {along_z} {wanted}");
        let sine = ((along_z * HEIGHT - 981.0) / 2e6).cbrt();
        assert!((deflection / both(sine)[0] - 1.0).abs() < 1e-6, "{k}: {point:?}");
        let h = HEIGHT * (1.0 / (sine * sine) - 1.0).sqrt();
        assert!((point.variables[0] + h).abs() < 1e-4, "{k}: {h} {point:?}");
        assert_eq!(point.robot.cables[0].exit_point.x, point.variables[0]);
        let Some(exchange) = point.exchange else { continue };
        let [low, high] = [sine - 1e-6, sine + 1e-6].map(both);
        let slope = (high[0] - low[0]) / (high[1] - low[1]);
        assert!((exchange / slope - 1.0).abs() < 1e-3, "{k}: {exchange} {slope}");
    }
    let exchanged: Vec<bool> = found.points.iter().map(|point| point.exchange.is_some()).collect();
    assert_eq!(exchanged, [false, true, true, true, true, true, false]);
}

#[test]
fn the_front_of_discrete_places_is_that_of_all_of_them_one_by_one() {
    let (x, y, z) = PLACES;
    let file = caroca([json!(x), json!(y), json!(z)]);
    let file = with(file, "/pareto", json!({"output": "deflection", "over": "mean"}));
    let found = solve(&file, data("caroca"));
    let both = |(each, place): (Vec<f64>, _)| {
        ([each.iter().copied().fold(0.0, f64::max), each.iter().sum::<f64>() / 3.0], place)
    };
    let all: Vec<([f64; 2], [f64; 3])> = one_by_one().into_iter().map(both).collect();
    let is_dominated = |one: &[f64; 2]| {
        all.iter().any(|(other, _)| other[0] <= one[0] && other[1] <= one[1] && other != one)
    };
    let mut kept: Vec<_> = all.iter().filter(|(one, _)| !is_dominated(one)).collect();
    kept.sort_by(|a, b| a.0[0].total_cmp(&b.0[0]));
    assert_eq!((found.starts, found.points.len()), (0, kept.len()), "{found:?} {kept:?}");
    for (point, (objectives, values)) in found.points.iter().zip(kept) {
        assert_eq!(point.variables, values);
        assert!((point.objectives[0] / objectives[0] - 1.0).abs() < 1e-9, "{point:?} {objectives:?}");
        assert!((point.objectives[1] / objectives[1] - 1.0).abs() < 1e-9 && point.optimal);
    }
    assert_eq!(found.dominated + found.points.len(), all.len());
}

#[test]
fn no_point_of_a_front_dominates_another_and_position_errors_can_be_one_of_both() {
    let file = caroca([json!([-3.5, -2.0]), json!([1.0, 2.0]), json!([2.6, 3.5])]);
    let errors = json!({"b": {"law": {"normal": {"mean": 0, "std": 1e-3}}}});
    let file = with(with(file, "/errors", errors), "/starts", json!(2));
    let found = solve(
        &with(file, "/pareto", json!({"output": "position", "over": "mean", "points": 4})),
        data("caroca"),
    );
    assert!(!found.points.is_empty() && found.basis.is_some(), "{found:?}");
    for pair in found.points.windows(2) {
        let [before, after] = [&pair[0].objectives, &pair[1].objectives];
        assert!(before[0] < after[0] && before[1] > after[1], "{before:?} {after:?}");
    }
}

#[test]
fn an_unheld_robot_has_no_front_and_wrong_second_objectives_are_refused() {
    let second = |second: Value| with(apart([-6.0, -0.5], 1.0), "/pareto", second);
    let stiffness = second(json!({"output": "stiffness", "over": "worst"}));
    let found = solve(&stiffness, planar(1.0, 100.0));
    assert!(found.points.is_empty() && found.reason.is_some(), "{found:?}");
    for (value, words) in [
        (
            json!({"output": "deflection", "over": "worst"}),
            "pareto is the deflection as in `objective`: expected",
        ),
        (json!({"output": "amplitude", "over": "worst"}), "pareto.output is amplitude: expected deflection"),
        (
            json!({"output": "stiffness", "over": "worst", "points": 1}),
            "pareto.points is 1: expected 2 to 1000",
        ),
        (json!({"output": "position", "over": "worst"}), "errors is missing"),
    ] {
        let text = second(value.clone()).to_string();
        let error = DesignProblem::from_json(&text, Path::new("design.json"), planar(1.0, 1e6)).unwrap_err();
        assert!(error.to_string().contains(words), "{value}: {error}");
    }
    let plain = apart([-6.0, -0.5], 1.0).to_string();
    let plain = DesignProblem::from_json(&plain, Path::new("design.json"), planar(1.0, 1e6)).unwrap();
    assert!(!plain.has_front() && front(&plain).unwrap_err().to_string().contains("pareto is missing"));
}
