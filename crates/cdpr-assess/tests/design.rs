//! Designs whose optimum is known, or is found by evaluating everything.

use cdpr_assess::{ActiveDemand, Design, DesignProblem, design};
use cdpr_robot::{Matrix3, Pose, Robot, Wrench};
use cdpr_statics::{Load, deflection};
use rayon::ThreadPoolBuilder;
use serde_json::{Value, json};
use std::path::Path;

/// Height of the exits of [`planar`] above the point mass [m].
pub(crate) const HEIGHT: f64 = 2.0;

/// A point mass in the plane of x and z on two weightless cables from `(-h, 0, H)` and `(h, 0, H)`.
pub(crate) fn planar(h: f64, greatest_tension: f64) -> Robot {
    let text = json!({
        "format": "cdpr-robot/1", "name": "Planar", "gravity": 9.81, "plane": "xz",
        "platform": {"mass": 100.0, "center_of_mass": [0, 0, 0], "point": true},
        "cable": {"section": 1e-5, "youngs_modulus": 1e11, "linear_density": 0.0},
        "tension_limits": {"min": 1.0, "max": greatest_tension},
        "cables": [
            {"exit_point": [-h, 0, HEIGHT], "anchor_point": [0, 0, 0]},
            {"exit_point": [h, 0, HEIGHT], "anchor_point": [0, 0, 0]},
        ],
    });
    Robot::from_json(&text.to_string()).unwrap()
}

/// Both exits move apart within bounds of `b1.x`; `force` pulls along x.
pub(crate) fn apart(bounds: [f64; 2], force: f64) -> Value {
    json!({
        "format": "cdpr-design/1",
        "variables": [{"parameters": ["b1.x", "b2.x"], "signs": [1, -1], "bounds": bounds}],
        "poses": {"list": [{"position": [0, 0, 0]}]},
        "wrench": [force, 0, 0, 0, 0, 0],
        "objective": {"output": "deflection", "over": "worst"},
        "starts": 5,
    })
}

/// The file with another value of a field, which it need not have yet.
pub(crate) fn with(mut file: Value, field: &str, value: Value) -> Value {
    let (of, name) = field.rsplit_once('/').unwrap();
    match file.pointer_mut(of).unwrap() {
        Value::Array(list) => list[name.parse::<usize>().unwrap()] = value,
        fields => fields[name] = value,
    }
    file
}

pub(crate) fn solve(file: &Value, robot: Robot) -> Design {
    design(&DesignProblem::from_json(&file.to_string(), Path::new("design.json"), robot).unwrap()).unwrap()
}

pub(crate) fn data(name: &str) -> Robot {
    let path = format!("{}/../../data/robots/{name}.json", env!("CARGO_MANIFEST_DIR"));
    Robot::from_json(&std::fs::read_to_string(path).unwrap()).unwrap()
}

#[test]
fn an_active_bound_is_met_exactly_and_its_rate_is_that_of_the_moved_bound() {
    let at = |most: f64| solve(&apart([-6.0, most], 1.0), planar(1.0, 1e6)).best.unwrap();
    let best = at(-4.0);
    let variable = &best.variables[0];
    assert_eq!((variable.to, variable.bound, best.same), (-4.0, Some("max"), 5));
    let moved = (at(-3.999).objective - at(-4.001).objective) / 0.002;
    assert!((variable.per_unit - moved).abs() < 1e-5 * moved.abs(), "{} {moved}", variable.per_unit);
    // The optimum without a bound is at -2.8284: one next to it is worth nothing.
    let next = at(-2.83).variables[0].clone();
    assert!(next.bound == Some("max") && next.flat && !variable.flat, "{next:?}");
}

#[test]
fn the_greatest_tension_ends_the_design_where_the_load_reaches_it() {
    let at = |limit: f64| solve(&apart([-6.0, -0.5], 100.0), planar(1.0, limit));
    let found = at(700.0);
    let best = found.best.as_ref().unwrap();
    assert!(best.optimal && best.variables[0].bound.is_none(), "{best:?}");
    let [ActiveDemand { pose: 0, output: None, cable: Some(0), per_percent }] = best.active[..] else {
        panic!("{:?}", best.active)
    };
    let load = Load::wrench(Wrench { force: [100.0, 0.0, 0.0].into(), moment: [0.0; 3].into() });
    let loaded = deflection(&best.robot, &Pose::at(0.0, 0.0, 0.0), &load).unwrap().loaded;
    let tension = loaded.equilibrium.tensions()[0];
    assert!((tension - 700.0).abs() < 1e-5, "{tension}");
    let gained = best.objective - at(700.7).best.unwrap().objective;
    assert!((gained - 0.1 * per_percent).abs() < 0.002 * per_percent, "{gained} {per_percent}");
}

#[test]
fn the_worst_of_several_poses_and_their_mean_are_as_small_as_on_a_fine_grid() {
    let poses = [-0.8, 0.1, 0.5].map(|x| Pose::at(x, 0.0, 0.3));
    let list: Vec<Value> = poses.iter().map(|pose| json!({"position": pose.position.as_slice()})).collect();
    let load = Load::wrench(Wrench { force: [50.0, 0.0, -80.0].into(), moment: [0.0; 3].into() });
    for over in ["worst", "mean"] {
        let file = with(apart([-6.0, -0.5], 0.0), "/wrench", json!([50, 0, -80, 0, 0, 0]));
        let file = with(with(file, "/poses/list", json!(list)), "/objective/over", json!(over));
        let found = solve(&file, planar(1.0, 1e6));
        let best = found.best.unwrap();
        assert!(best.optimal && best.same == 5, "{over}: {best:?}");
        let of_grid = |k: i32| {
            let robot = planar(0.9 + 0.001 * f64::from(k), 1e6);
            let each = poses.map(|pose| 1e3 * deflection(&robot, &pose, &load).unwrap().magnitude());
            if over == "worst" {
                each.into_iter().fold(0.0, f64::max)
            } else {
                each.iter().sum::<f64>() / 3.0
            }
        };
        let least = (0..4000).map(of_grid).fold(f64::INFINITY, f64::min);
        assert!(best.objective <= least && least < best.objective * (1.0 + 1e-5), "{over} {least} {best:?}");
    }
}

/// Places of CAROCA's exits in steps, symmetric to both middle planes.
pub(crate) fn caroca(domains: [Value; 3]) -> Value {
    let names = |axis: &str| (1..9).map(|i| format!("b{i}.{axis}")).collect::<Vec<_>>();
    let mut variables = vec![
        json!({"name": "half length", "parameters": names("x"), "signs": [1, -1, 1, -1, 1, -1, 1, -1]}),
        json!({"name": "half width", "parameters": names("y"), "signs": [1, 1, 1, 1, -1, -1, -1, -1]}),
        json!({"name": "height", "parameters": names("z")}),
    ];
    for (variable, domain) in variables.iter_mut().zip(domains) {
        let field =
            if domain[0].is_number() && domain.as_array().unwrap().len() == 2 { "bounds" } else { "choices" };
        variable[field] = domain;
    }
    json!({
        "format": "cdpr-design/1", "variables": variables, "payload": 50.0,
        "poses": {"list": [
            {"position": [0, 0, 1.75]}, {"position": [1, 0.4, 1.2]}, {"position": [-1, 0.2, 2]},
        ]},
        "objective": {"output": "deflection", "over": "worst"}, "starts": 6,
    })
}

/// Coordinates of the exits of CAROCA, at places symmetric to both middle planes [m].
pub(crate) const PLACES: ([f64; 4], [f64; 3], [f64; 3]) =
    ([-3.5, -3.0, -2.5, -2.0], [2.0, 1.5, 1.0], [3.5, 3.0, 2.75]);

/// The deflections [mm] at the poses of [`caroca`] with each of the [`PLACES`] that holds all of them.
pub(crate) fn one_by_one() -> Vec<(Vec<f64>, [f64; 3])> {
    let poses = [Pose::at(0.0, 0.0, 1.75), Pose::at(1.0, 0.4, 1.2), Pose::at(-1.0, 0.2, 2.0)];
    let mut all = Vec::new();
    let (x, y, z) = PLACES;
    for (x, y, z) in x.iter().flat_map(|x| y.iter().flat_map(move |y| z.map(|z| (*x, *y, z)))) {
        let mut robot = data("caroca");
        for (i, cable) in robot.cables.iter_mut().enumerate() {
            let [sx, sy] = [if i % 2 == 0 { 1.0 } else { -1.0 }, if i < 4 { 1.0 } else { -1.0 }];
            cable.exit_point = [sx * x, sy * y, z].into();
        }
        let each =
            poses.map(|pose| deflection(&robot, &pose, &Load::payload(50.0)).map(|at| 1e3 * at.magnitude()));
        if let Ok(each) = each.into_iter().collect::<Result<Vec<f64>, _>>() {
            all.push((each, [x, y, z]));
        }
    }
    all
}

#[test]
fn the_best_of_discrete_places_is_that_of_all_of_them_one_by_one() {
    let (x, y, z) = PLACES;
    let found = solve(&caroca([json!(x), json!(y), json!(z)]), data("caroca"));
    let best = found.best.as_ref().unwrap();
    assert_eq!((found.configurations, found.starts, best.kkt_residual), (36, 0, None));
    let worst = |(each, place): (Vec<f64>, _)| (each.into_iter().fold(0.0, f64::max), place);
    let mut all: Vec<(f64, [f64; 3])> = one_by_one().into_iter().map(worst).collect();
    all.sort_by(|a, b| a.0.total_cmp(&b.0));
    assert_eq!(found.feasible, all.len());
    assert!((best.objective / all[0].0 - 1.0).abs() < 1e-9 && all[0].0 < found.before.unwrap());
    assert!((best.next_configuration.unwrap() / all[1].0 - 1.0).abs() < 1e-9);
    let to: Vec<f64> = best.variables.iter().map(|variable| variable.to).collect();
    assert_eq!(to, all[0].1);
}

#[test]
fn the_numbers_do_not_depend_on_the_threads_and_the_robot_can_be_read_again() {
    let file = caroca([json!([-3.5, -2.0]), json!([1.0, 2.0]), json!([2.6, 2.8, 3.5])]);
    let run = |threads| {
        let pool = ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        pool.install(|| solve(&file, data("caroca")))
    };
    let found = run(1);
    assert_eq!(found, run(3));
    let best = found.best.unwrap();
    assert_eq!((found.configurations, found.starts), (3, 6));
    assert!(best.objective < found.before.unwrap() && best.optimal, "{best:?}");
    let again = Robot::from_json(&best.robot.to_json()).unwrap();
    let load = Load::payload(50.0);
    let at = deflection(&again, &Pose::at(1.0, 0.4, 1.2), &load).unwrap().magnitude();
    assert!((1e3 * at / best.outputs[1] - 1.0).abs() < 1e-9);
}

#[test]
fn a_stiffness_is_made_great_and_a_demanded_frequency_kept() {
    let file = caroca([json!([-3.5, -2.0]), json!([1.0, 2.0]), json!([2.6, 3.5])]);
    let file = with(with(file, "/objective/output", json!("stiffness")), "/starts", json!(3));
    let free = solve(&file, data("caroca"));
    let best = free.best.unwrap();
    assert!(best.objective > free.before.unwrap(), "{best:?}");
    let robot = Robot { platform: with_inertia(&data("caroca")), ..data("caroca") };
    let lowest = solve(&with(file.clone(), "/objective/output", json!("frequency")), robot.clone());
    let lowest = lowest.best.unwrap().objective;
    let limited = with(file, "/limits", json!({"frequency": 0.98 * lowest}));
    let limited = solve(&limited, robot).best.unwrap();
    assert!(limited.objective <= best.objective * (1.0 + 1e-9), "{limited:?}");
}

fn with_inertia(robot: &Robot) -> cdpr_robot::Platform {
    let mut platform = robot.platform;
    platform.inertia = Some(Matrix3::identity() * 10.0);
    platform
}

#[test]
fn each_start_is_at_a_robot_that_is_held_where_one_can_be_drawn() {
    let cable = |exit: [f64; 2], anchor: [f64; 2]| {
        let point = |of: [f64; 2]| [of[0], 0.0, of[1]];
        json!({"exit_point": point(exit), "anchor_point": point(anchor)})
    };
    let robot = json!({
        "format": "cdpr-robot/1", "name": "Redundant", "gravity": 9.81, "plane": "xz",
        "platform": {"mass": 12.0, "center_of_mass": [0.03, 0, 0.02]},
        "cable": {"section": 4e-6, "linear_density": 0.04, "youngs_modulus": 5e10},
        "tension_limits": {"min": 20.0, "max": 2500.0}, "tension_reference": 300.0,
        "cables": [
            cable([-3.0, 3.0], [-0.3, 0.15]),
            cable([3.2, 2.8], [0.25, 0.2]),
            cable([-2.9, 0.0], [-0.25, -0.2]),
            cable([3.0, 0.2], [0.3, -0.15]),
        ],
    });
    let robot = Robot::from_json(&robot.to_string()).unwrap();
    // Of robots at random in this box about a quarter holds both poses.
    let file = json!({
        "format": "cdpr-design/1",
        "variables": [
            {"parameters": ["b1.z", "b2.z"], "bounds": [2.2, 4.5]},
            {"parameters": ["b1.x", "b2.x"], "signs": [1, -1], "bounds": [-4.0, -2.2]},
        ],
        "poses": {"list": [{"position": [0.4, 0, 1.3], "rpy_deg": [0, 4, 0]}, {"position": [-0.6, 0, 1.0]}]},
        "payload": 8.0,
        "objective": {"output": "deflection", "over": "worst"},
        "starts": 4,
    });
    let found = solve(&file, robot);
    assert!(found.before.is_none() && found.feasible >= 3, "{found:?}");
}

#[test]
fn an_unheld_robot_leads_to_no_design() {
    let found = solve(&apart([-6.0, -0.5], 1.0), planar(1.0, 100.0));
    assert_eq!((found.before, found.feasible_before, found.feasible), (None, false, 0));
    assert!(found.best.is_none());
}

#[test]
fn wrong_files_are_refused_with_field_value_and_what_is_right() {
    let good = apart([-6.0, -0.5], 1.0);
    for (field, value, words) in [
        ("/format", json!("cdpr-design/2"), "format is cdpr-design/2: expected cdpr-design/1"),
        ("/variables", json!([]), "variables is empty: expected at least one variable"),
        ("/variables/0/parameters", json!(["c1.x", "b2.x"]), "variables[0].parameters[0] is c1.x: expected"),
        ("/variables/0/parameters", json!(["b3.x", "b2.x"]), "a parameter of this robot with 2 cables"),
        ("/variables/0/parameters", json!(["dt1", "b2.x"]), "no dt and no tilt"),
        ("/variables/0/parameters", json!(["a1.x", "b2.x"]), "no anchor point: those of a point mass"),
        ("/variables/0/parameters", json!(["b1.x", "b1.x"]), "a parameter of one variable alone"),
        ("/variables/0/parameters", json!(["b1.x"]), "variables[0].signs is [1.0, -1.0]: expected 1 or -1"),
        ("/variables/0/signs", json!([1, 0.5]), "variables[0].signs is [1.0, 0.5]"),
        ("/variables/0/bounds", json!([2, 1]), "variables[0].bounds is [2.0, 1.0]: expected two finite"),
        ("/variables/0/bounds", json!(null), "without bounds and choices: expected either"),
        ("/variables/0/choices", json!([1]), "bounds and choices: expected either"),
        ("/poses/list", json!([]), "poses.list is empty: expected at least one pose"),
        ("/poses/list/0/quaternion", json!([2, 0, 0, 0]), "poses.list[0].quaternion is"),
        (
            "/wrench",
            json!([0, 0, 0, 0, 0, 0]),
            "payload is 0: expected a mass above zero [kg], or a `wrench`",
        ),
        ("/payload", json!(-1), "payload is -1: expected a finite mass"),
        ("/free", json!(["x"]), "free is [x]: expected 0 different ones"),
        ("/starts", json!(0), "starts is 0: expected 1 or more"),
        ("/starts", json!(100_001), "at most 100000 configurations"),
        ("/objective/output", json!("amplitude"), "objective.output is amplitude: expected deflection"),
        ("/objective/output", json!("price"), "unknown variant `price`, expected one of"),
        ("/objective/over", json!("best"), "unknown variant `best`"),
        ("/limits", json!({"stiffness": -5}), "limits.stiffness is -5: expected a finite number above zero"),
        ("/goal", json!(1), "unknown field `goal`"),
    ] {
        let text = with(good.clone(), field, value.clone()).to_string();
        let error = DesignProblem::from_json(&text, Path::new("design.json"), planar(1.0, 1e6)).unwrap_err();
        let error = error.to_string();
        assert!(error.contains(words) && error.starts_with("design.json"), "{field} {value}: {error}");
    }
    let mut negative = caroca([json!([-3.5, -2.0]), json!([1.0, 2.0]), json!([2.6, 3.5])]);
    negative["variables"][0] = json!({"parameters": ["mass"], "bounds": [-5, 200]});
    let error =
        DesignProblem::from_json(&negative.to_string(), Path::new("d.json"), data("caroca")).unwrap_err();
    assert!(
        error.to_string().contains("variables[0].bounds is -5: expected values of a valid robot"),
        "{error}"
    );
    let nan = good.to_string().replace("-6.0", "NaN");
    assert!(DesignProblem::from_json(&nan, Path::new("d.json"), planar(1.0, 1e6)).is_err());
}
