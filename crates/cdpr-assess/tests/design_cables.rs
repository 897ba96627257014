//! Designs that choose types of cable, against enumeration by hand.

use crate::design::{apart, data, planar, solve, with};
use cdpr_assess::DesignProblem;
use cdpr_robot::{CableProperties, Pose, Robot};
use cdpr_statics::{Load, deflection};
use serde_json::{Value, json};
use std::path::Path;

/// Name, diameter [m], linear density [kg/m], modulus [Pa], breaking force [N], cost of a metre.
const TYPES: [(&str, f64, f64, f64, f64, f64); 3] = [
    ("fibre 2.5", 0.0025, 0.004, 5e10, 5800.0, 4.0),
    ("steel 4", 0.004, 0.1015, 1.022e11, 10290.0, 3.0),
    ("steel 6", 0.006, 0.18, 1.1e11, 20000.0, 7.5),
];

fn catalogue() -> Value {
    let of = |(name, diameter, linear_density, modulus, breaking, cost)| {
        json!({"name": name, "diameter": diameter, "linear_density": linear_density,
            "youngs_modulus": modulus, "breaking_force": breaking, "cost": cost})
    };
    json!(TYPES.map(of))
}

const POSES: [[f64; 3]; 2] = [[0.0, 0.0, 1.75], [1.0, 0.4, 1.2]];

fn caroca() -> Value {
    json!({
        "format": "cdpr-design/1", "payload": 50.0,
        "variables": [{"name": "height", "parameters": (1..9).map(|i| format!("b{i}.z")).collect::<Vec<_>>(),
            "choices": [3.5, 3.0]}],
        "cables": catalogue(), "cable_groups": [[1, 4, 5, 8], [2, 3, 6, 7]],
        "poses": {"list": POSES.map(|at| json!({"position": at}))},
        "objective": {"output": "deflection", "over": "worst"},
    })
}

/// Worst deflection [mm], cost and mass [kg] with these types of both groups.
fn by_hand(types: [usize; 2], height: f64) -> [f64; 3] {
    let mut robot = data("caroca");
    let group = |i: usize| usize::from(![0, 3, 4, 7].contains(&i));
    for (i, cable) in robot.cables.iter_mut().enumerate() {
        let (_, diameter, linear_density, youngs_modulus, breaking, _) = TYPES[types[group(i)]];
        let section = std::f64::consts::PI * diameter * diameter / 4.0;
        cable.properties = CableProperties::linear(section, linear_density, youngs_modulus);
        cable.properties.breaking_force = Some(breaking);
        cable.exit_point.z = height;
    }
    let found = POSES.map(|[x, y, z]| deflection(&robot, &Pose::at(x, y, z), &Load::payload(50.0)).unwrap());
    let worst = found.iter().map(|at| 1e3 * at.magnitude()).fold(0.0, f64::max);
    let (mut cost, mut mass) = (0.0, 0.0);
    for i in 0..8 {
        let length = found[0].lengths[i].max(found[1].lengths[i]);
        cost += length * TYPES[types[group(i)]].5;
        mass += length * TYPES[types[group(i)]].2;
    }
    [worst, cost, mass]
}

/// All combinations with their values, by hand.
fn all() -> Vec<([usize; 2], f64, [f64; 3])> {
    let pairs = (0..9).map(|k| [k % 3, k / 3]);
    pairs.flat_map(|types| [3.5, 3.0].map(|z| (types, z, by_hand(types, z)))).collect()
}

#[test]
fn the_best_types_are_those_of_all_combinations_one_by_one() {
    let mut all = all();
    all.sort_by(|one, other| one.2[0].total_cmp(&other.2[0]));
    for limit in [None, Some(0.6 * all[0].2[1])] {
        let file = limit.map_or_else(caroca, |limit| with(caroca(), "/limits", json!({"cost": limit})));
        let found = solve(&file, data("caroca"));
        let counts: Vec<_> = all.iter().filter(|of| limit.is_none_or(|limit| of.2[1] <= limit)).collect();
        assert_eq!((found.configurations, found.feasible), (18, counts.len()));
        let ((types, height, [worst, cost, mass]), best) = (*counts[0], found.best.unwrap());
        let names: Vec<&str> = best.cables.iter().map(|of| of.name.as_str()).collect();
        assert_eq!(names, types.map(|k| TYPES[k].0));
        assert_eq!((best.variables.len(), best.variables[0].to), (1, height));
        let of = |value: f64, reference: f64| (value / reference - 1.0).abs() < 1e-9;
        assert!(of(best.objective, worst), "{} {worst}", best.objective);
        assert!(of(best.cables.iter().map(|of| of.cost.unwrap()).sum(), cost));
        assert!(of(best.cables.iter().map(|of| of.mass).sum(), mass));
        assert!(of(best.next_configuration.unwrap(), counts[1].2[0]));
        assert_eq!(best.cable_types.len(), 9);
        for row in &best.cable_types {
            let same =
                |of: &&&([usize; 2], f64, [f64; 3])| of.0.map(|k| TYPES[k].0.to_owned())[..] == row.types;
            match counts.iter().find(same) {
                Some((.., [worst, cost, mass])) => {
                    assert!(of(row.objective.unwrap(), *worst) && of(row.cost.unwrap(), *cost), "{row:?}");
                    assert!(of(row.mass.unwrap(), *mass), "{row:?}");
                }
                None => {
                    assert_eq!((row.objective, row.cost, row.mass), (None, None, None), "{row:?}");
                    assert!(row.reason.as_deref().unwrap().contains("its limit"), "{row:?}");
                }
            }
        }
        let again = Robot::from_json(&best.robot.to_json()).unwrap();
        assert_eq!(again.cables[0].properties.youngs_modulus, TYPES[types[0]].3);
    }
}

/// A type for [`planar`], of which a metre costs 2.
fn of_planar(name: &str, modulus: f64, breaking: f64) -> Value {
    json!({"name": name, "section": 1e-5, "linear_density": 0.0, "youngs_modulus": modulus,
        "breaking_force": breaking, "cost": 2.0})
}

#[test]
fn what_was_assumed_of_other_cables_is_not_said_of_the_chosen_ones() {
    let mut robot = planar(3.0, 1e6);
    let gravity = "gravity is 9.81 m/s² along -z".to_owned();
    robot.provenance.assumed = vec!["the cables are Steel rope, 4 mm".to_owned(), gravity.clone()];
    let file = with(apart([-6.0, -0.5], 100.0), "/cables", json!([of_planar("one", 1e11, 1e6)]));
    let best = solve(&file, robot.clone()).best.unwrap();
    assert_eq!(best.robot.provenance.assumed, [gravity]);
    let best = solve(&apart([-6.0, -0.5], 100.0), robot.clone()).best.unwrap();
    assert_eq!(best.robot.provenance, robot.provenance);
}

#[test]
fn a_type_that_breaks_under_the_weight_is_left_out() {
    let types = json!([of_planar("weak", 2e11, 600.0), of_planar("strong", 1e11, 1e4)]);
    let mut file = with(apart([-6.0, -0.5], 100.0), "/cables", types);
    file["variables"] = json!([]);
    let best = solve(&file, planar(3.0, 1e6)).best.unwrap();
    assert_eq!(best.cables[0].name, "strong");
    assert_eq!(best.cable_types.iter().map(|of| of.objective.is_some()).collect::<Vec<_>>(), [false, true]);
    let [weak, strong] = [0, 1].map(|k: usize| best.cable_types[k].reason.as_deref());
    assert!(weak.is_some_and(|weak| weak.contains("cable")) && strong.is_none(), "{weak:?}, {strong:?}");
    // Without the weak one's breaking force the stiffer type is the better one.
    file["cables"][0]["breaking_force"] = json!(1e4);
    assert_eq!(solve(&file, planar(3.0, 1e6)).best.unwrap().cables[0].name, "weak");
}

/// The stiffest exits are `√2 H` from the middle; cables that may cost less end before.
#[test]
fn a_cost_that_is_limited_is_spent_and_its_rate_is_that_of_the_moved_limit() {
    let at = |limit: f64| {
        let file = with(apart([-6.0, -0.5], 100.0), "/cables", json!([of_planar("one", 1e11, 1e6)]));
        let found = solve(&with(file, "/limits", json!({"cost": limit})), planar(1.0, 1e6));
        found.best.unwrap()
    };
    let best = at(10.0);
    assert!(best.optimal && best.active.is_empty(), "{best:?}");
    assert!((best.cables[0].cost.unwrap() - 10.0).abs() < 1e-6, "{:?}", best.cables);
    // Two cables of 2.5 m between (h, 2) and the origin, shorter by their strain T/EA.
    let strain = 981.0 / 2.0 / (2.0 / 2.5) / 1e6;
    let length = 2.5 * (1.0 + strain);
    let h = (length * length - 4.0_f64).sqrt();
    assert!((best.variables[0].to + h).abs() < 1e-5, "{} {h}", best.variables[0].to);
    let gained = best.objective - at(10.01).objective;
    let rate = best.cost_per_percent.unwrap();
    assert!((gained - 0.1 * rate).abs() < 0.01 * rate, "{gained} {rate}");
    assert_eq!(at(100.0).cost_per_percent, None);
}

#[test]
fn the_front_of_choices_has_the_types_of_each_point() {
    let second = json!({"output": "stiffness", "over": "worst"});
    let problem = with(caroca(), "/pareto", second).to_string();
    let problem = DesignProblem::from_json(&problem, Path::new("d.json"), data("caroca")).unwrap();
    let front = cdpr_assess::front(&problem).unwrap();
    assert_eq!(front.variables, [("height".to_owned(), "m")]);
    for point in &front.points {
        let types: Vec<usize> =
            point.cables.iter().map(|of| TYPES.iter().position(|one| one.0 == of.name).unwrap()).collect();
        let [worst, ..] = by_hand([types[0], types[1]], point.variables[0]);
        assert!((point.objectives[0] / worst - 1.0).abs() < 1e-9, "{point:?}");
    }
    assert!(!front.points.is_empty());
}

#[test]
fn a_measured_law_stays_on_its_own_cable_and_is_said_to_leave_others() {
    let robot = data("caroca-law");
    let own = robot.cables[0].properties.clone();
    assert!(own.law.is_some());
    let of = |cables: Value| {
        let mut file = with(caroca(), "/cables", cables);
        file["variables"] = json!([]);
        file.as_object_mut().unwrap().remove("cable_groups");
        DesignProblem::from_json(&file.to_string(), Path::new("d.json"), robot.clone()).unwrap()
    };
    let same = json!({"name": "own", "section": own.section, "linear_density": own.linear_density,
        "youngs_modulus": own.youngs_modulus});
    let kept = cdpr_assess::design(&of(json!([same]))).unwrap();
    assert_eq!(kept.left_laws, None);
    assert_eq!(kept.best.unwrap().robot.cables[0].properties.law, own.law);
    let left = cdpr_assess::design(&of(catalogue())).unwrap();
    let words = left.left_laws.unwrap();
    assert!(words.contains("the measured law that all cables have in the robot file"), "{words}");
    assert_eq!(left.best.unwrap().robot.cables[0].properties.law, None);
    // Linear cables lose nothing.
    let linear =
        DesignProblem::from_json(&caroca().to_string(), Path::new("d.json"), data("caroca")).unwrap();
    assert_eq!(cdpr_assess::design(&linear).unwrap().left_laws, None);
}

#[test]
fn wrong_types_are_refused_with_field_value_and_what_is_right() {
    for (field, value, words) in [
        ("/cables/1/name", json!("fibre 2.5"), "cables[1].name is fibre 2.5: expected another name"),
        ("/cables/1/youngs_modulus", json!(-1), "cables[1] is steel 4: expected a type for a valid robot"),
        ("/cables/1/cost", json!(-1), "cables[1].cost is -1: expected a finite number"),
        ("/cables/2/diameter", json!(null), "cables[2].section is missing: expected a section"),
        ("/cable_groups", json!([[1, 2], [3]]), "expected each of the cables 1 to 8 in one group"),
        ("/cable_groups", json!([[1, 2, 3, 4, 5, 6, 7, 8], []]), "expected each of the cables 1 to 8"),
        ("/cables", json!([]), "cable_groups is [[1, 4, 5, 8], [2, 3, 6, 7]]: expected none without types"),
        ("/limits", json!({"cost": 0}), "limits.cost is 0: expected a finite number above zero"),
        ("/variables/0/parameters", json!(["youngs_modulus"]), "expected no modulus and no linear density"),
    ] {
        let mut file = with(caroca(), field, value);
        if words.contains("modulus and") {
            file["variables"][0]["choices"] = json!([1e11, 2e11]);
        }
        let text = file.to_string();
        let error = DesignProblem::from_json(&text, Path::new("design.json"), data("caroca")).unwrap_err();
        assert!(error.to_string().contains(words), "{field}: {error}");
    }
    let mut file = with(caroca(), "/limits", json!({"cost": 10}));
    file["cables"][0].as_object_mut().unwrap().remove("cost");
    let error = DesignProblem::from_json(&file.to_string(), Path::new("d.json"), data("caroca")).unwrap_err();
    assert!(error.to_string().contains("cables[0].cost is missing"), "{error}");
    let file = with(apart([-6.0, -0.5], 1.0), "/limits", json!({"cost": 10}));
    let error =
        DesignProblem::from_json(&file.to_string(), Path::new("d.json"), planar(1.0, 1e6)).unwrap_err();
    assert!(error.to_string().contains("limits.cost is 10: expected none without types"), "{error}");
}
