//! Tension, length and cost of all cables as objectives and limits: by hand, and in closed form.

use crate::design::{HEIGHT, apart, data, planar, solve, with};
use cdpr_assess::{DesignProblem, Goal, front};
use cdpr_robot::{Coordinate, Pose, Robot};
use cdpr_statics::{Load, WantedPose, deflection};
use serde_json::{Value, json};
use std::path::Path;

/// A robot with poses, a payload [kg], free coordinates, and the parameters of a variable with two values.
struct Case {
    robot: &'static str,
    poses: [[f64; 3]; 2],
    payload: f64,
    free: &'static [&'static str],
    choices: [f64; 2],
}

const CASES: [Case; 4] = [
    Case {
        robot: "caroca",
        poses: [[0.0, 0.0, 1.75], [1.0, 0.4, 1.2]],
        payload: 50.0,
        free: &[],
        choices: [3.5, 3.0],
    },
    Case {
        robot: "cogiro",
        poses: [[0.0, 0.0, 2.0], [3.0, 2.0, 1.5]],
        payload: 100.0,
        free: &[],
        choices: [5.4, 6.2],
    },
    Case {
        robot: "ipanema-3",
        poses: [[0.0, 0.0, 1.5], [1.0, -1.0, 1.8]],
        payload: 20.0,
        free: &[],
        choices: [3.9, 4.1],
    },
    Case {
        robot: "four-cables",
        poses: [[0.3, 0.2, 2.0], [0.4, 0.3, 1.8]],
        payload: 5.0,
        free: &["roll", "pitch"],
        choices: [5.0, 5.3],
    },
];

impl Case {
    /// The exits of the first cables rise together.
    fn raised(&self) -> Vec<String> {
        (1..=4).map(|i| format!("b{i}.z")).collect()
    }

    fn file(&self, goal: &str, over: &str) -> Value {
        let robot = data(self.robot);
        let offset = robot.cables[0].exit_point.z;
        json!({
            "format": "cdpr-design/1", "payload": self.payload, "free": self.free,
            "variables": [{"parameters": self.raised(), "choices": self.heights(offset)}],
            "poses": {"list": self.poses.map(|at| json!({"position": at}))},
            "objective": {"output": goal, "over": over},
        })
    }

    /// Both heights [m], the second by as much higher as the choices say.
    fn heights(&self, offset: f64) -> [f64; 2] {
        [offset, offset + self.choices[1] - self.choices[0]]
    }

    /// Of each height: the tensions at the exits of each pose [N], and the greatest length of each cable [m].
    fn by_hand(&self) -> [(Vec<Vec<f64>>, Vec<f64>); 2] {
        let robot = data(self.robot);
        let nominal = robot.cables[0].exit_point.z;
        let free: Vec<Coordinate> = self.free.iter().map(|name| name.parse().unwrap()).collect();
        self.heights(nominal).map(|z| {
            let mut robot = robot.clone();
            robot.cables[..4].iter_mut().for_each(|cable| cable.exit_point.z += z - nominal);
            let (mut tensions, mut longest) = (Vec::new(), vec![0.0_f64; robot.cables.len()]);
            for [x, y, z] in self.poses {
                let pose = Pose::at(x, y, z);
                let found =
                    deflection(&robot, WantedPose::at(&pose).free(&free), &Load::payload(self.payload))
                        .unwrap();
                tensions.push(found.loaded.equilibrium.exit_tensions(&robot, &found.lengths));
                longest.iter_mut().zip(&found.lengths).for_each(|(most, length)| *most = most.max(*length));
            }
            (tensions, longest)
        })
    }
}

fn greatest(of: &[f64]) -> f64 {
    of.iter().copied().fold(0.0, f64::max)
}

fn is_near(one: f64, other: f64) -> bool {
    (one / other - 1.0).abs() < 1e-9
}

#[test]
fn tension_and_length_of_the_best_height_are_those_of_a_loop_over_the_heights() {
    for case in CASES {
        let by_hand = case.by_hand();
        let per_pose = |k: usize| by_hand[k].0.iter().map(|of| greatest(of)).collect::<Vec<_>>();
        let solved = |goal: &str, over: &str| {
            let found = solve(&case.file(goal, over), data(case.robot));
            let best = found.best.unwrap_or_else(|| panic!("{}: {:?}", case.robot, found.reason));
            (found.before.unwrap(), best)
        };
        for (over, of) in [
            ("worst", Box::new(|each: &[f64]| greatest(each)) as Box<dyn Fn(&[f64]) -> f64>),
            ("mean", Box::new(|each: &[f64]| each.iter().sum::<f64>() / each.len() as f64)),
        ] {
            let (before, best) = solved("tension", over);
            let both = [0, 1].map(|k| of(&per_pose(k)));
            let least = usize::from(both[1] < both[0]);
            assert!(
                is_near(before, both[0]) && is_near(best.objective, both[least]),
                "{} {both:?}",
                case.robot
            );
            let outputs = best.outputs.iter().zip(per_pose(least));
            assert!(best.outputs.len() == 2 && outputs.into_iter().all(|(one, other)| is_near(*one, other)));
        }
        let (before, best) = solved("length", "worst");
        let both = [0, 1].map(|k| by_hand[k].1.iter().sum::<f64>());
        assert!(is_near(before, both[0]) && is_near(best.objective, both[0].min(both[1])), "{both:?}");
        assert_eq!(best.outputs, [best.objective], "{}", case.robot);
        // A limit between both heights leaves one of them; one below both leaves none, and says so.
        for (goal, both) in [("tension", [0, 1].map(|k| greatest(&per_pose(k)))), ("length", both)] {
            let file = |limit: f64| with(case.file("deflection", "worst"), "/limits", json!({goal: limit}));
            let found = solve(&file(0.5 * (both[0] + both[1])), data(case.robot));
            assert_eq!(found.feasible, 1, "{} {goal} {both:?}", case.robot);
            assert_eq!(found.feasible_before, both[0] < both[1]);
            let found = solve(&file(0.9 * both[0].min(both[1])), data(case.robot));
            let reason = found.reason.unwrap();
            let noun =
                if goal == "tension" { "the exit tension of cable" } else { "the length of all cables" };
            assert!(found.best.is_none() && reason.contains(noun), "{reason}");
        }
    }
}

/// Two weightless cables from `(±h, H)` to a mass at `(x, 0)`: with the angles `θ` to the horizontal the
/// tensions are `W cos θ_2/sin(θ_1 + θ_2)` and `W cos θ_1/sin(θ_1 + θ_2)`.
fn tensions(h: f64, x: f64) -> [f64; 2] {
    let [left, right] = [h + x, h - x].map(|across| across.hypot(HEIGHT));
    let [one, two] = [(h + x) / left, (h - x) / right];
    let sine = HEIGHT * (one / right + two / left);
    [981.0 * two / sine, 981.0 * one / sine]
}

/// Poses of the mass at both sides of the middle.
fn aside(goal: &str) -> Value {
    let file = with(
        apart([-6.0, -0.5], 0.0),
        "/poses",
        json!({"list": [{"position": [0.4, 0, 0]}, {"position": [-0.4, 0, 0]}]}),
    );
    with(file, "/objective", json!({"output": goal}))
}

#[test]
fn the_least_length_and_the_least_tension_of_a_mass_on_two_cables_are_those_of_the_closed_form() {
    // Straight up is least of both in the middle; both ends of the bounds are met exactly.
    for goal in ["length", "tension"] {
        let found =
            solve(&with(apart([-6.0, -0.5], 0.0), "/objective", json!({"output": goal})), planar(1.0, 1e6));
        let best = found.best.unwrap();
        assert_eq!((best.variables[0].to, best.variables[0].bound, best.optimal), (-0.5, Some("max"), true));
        let straight = 0.5_f64.hypot(HEIGHT);
        let expected = match goal {
            "length" => 2.0 * straight / (1.0 + tensions(0.5, 0.0)[0] / 1e6),
            _ => tensions(0.5, 0.0)[0],
        };
        assert!((best.objective / expected - 1.0).abs() < 1e-8, "{goal}: {} {expected}", best.objective);
    }
    // Off the middle the nearer cable bears more the nearer its exit is to the plumb line, but less where the
    // exits are wide apart: the greatest tension has a minimum within the bounds, found on a fine grid.
    let best = solve(&aside("tension"), planar(3.0, 1e6)).best.unwrap();
    let grid = (0..=550_000).map(|k| 0.5 + 1e-5 * f64::from(k));
    let (_, least) =
        grid.map(|h| (h, greatest(&tensions(h, 0.4)))).min_by(|a, b| a.1.total_cmp(&b.1)).unwrap();
    assert!((best.objective / least - 1.0).abs() < 1e-8, "{} {least}", best.objective);
    assert!(best.optimal, "{best:?}");
}

/// A mass below three exits at the corners of a triangle: by symmetry the tension of each is
/// `W L/(3 H)` with its length L, and a limit of it ends the design at its radius.
#[test]
fn a_limit_of_tension_or_length_ends_the_radius_of_three_cables_where_it_is_reached() {
    let exits =
        [0.0, 120.0, 240.0_f64].map(|angle| [angle.to_radians().cos(), angle.to_radians().sin(), HEIGHT]);
    let text = json!({
        "format": "cdpr-robot/1", "name": "Three", "gravity": 9.81,
        "platform": {"mass": 100.0, "center_of_mass": [0, 0, 0], "point": true},
        "cable": {"section": 1e-5, "youngs_modulus": 1e11, "linear_density": 0.0},
        "tension_limits": {"min": 1.0, "max": 1e5},
        "cables": exits.map(|exit| json!({"exit_point": exit, "anchor_point": [0, 0, 0]})),
    });
    let robot = || Robot::from_json(&text.to_string()).unwrap();
    // Height alone: sideways stiffness grows as the exits come down.
    let file = |limit: Value| {
        json!({
            "format": "cdpr-design/1", "starts": 4, "limits": limit, "wrench": [10, 0, 0, 0, 0, 0],
            "variables": [{"parameters": ["b1.z", "b2.z", "b3.z"], "bounds": [0.7, 4.0]}],
            "poses": {"list": [{"position": [0, 0, 0]}]}, "objective": {"output": "deflection"},
        })
    };
    let length = |z: f64| z.hypot(1.0);
    // The force along x falls on cable 1, whose exit is there: its tension falls, that of the others rises.
    let z = 1.5;
    let at_limit = (981.0 / z + 10.0) * length(z) / 3.0;
    let best = solve(&file(json!({"tension": at_limit})), robot()).best.unwrap();
    assert!((best.variables[0].to - z).abs() < 1e-3, "{best:?}");
    assert!(best.optimal && best.active.iter().all(|of| of.output == Some(Goal::Tension)), "{best:?}");
    assert!(best.active.iter().any(|of| of.cable == Some(1)) && best.active[0].per_percent > 0.0, "{best:?}");
    let all = 3.0 * length(z) / (1.0 + 981.0 / z * length(z) / 3.0 / 1e6);
    let least = json!({"length": all});
    let mut longer = file(least);
    longer["objective"] = json!({"output": "tension"});
    let best = solve(&longer, robot()).best.unwrap();
    assert!((best.variables[0].to - z).abs() < 1e-6, "{best:?}");
    let gained = best.objective
        - solve(&with(longer, "/limits", json!({"length": 1.0001 * all})), robot()).best.unwrap().objective;
    let rate = best.length_per_percent.unwrap();
    assert!((gained - 0.01 * rate).abs() < 0.01 * gained, "{gained} {rate}");
}

#[test]
fn a_cost_to_be_small_is_that_of_the_cheapest_types_that_keep_the_limits() {
    let type_of = |name: &str, modulus: f64, cost: f64| {
        json!({"name": name, "section": 1e-5, "linear_density": 0.0, "youngs_modulus": modulus,
            "breaking_force": 1e4, "cost": cost})
    };
    let types =
        json!([type_of("soft", 2e10, 1.0), type_of("stiff", 1e11, 2.0), type_of("stiffest", 2e11, 5.0)]);
    let mut file = with(apart([-6.0, -0.5], 100.0), "/cables", types);
    file["objective"] = json!({"output": "cost"});
    let at =
        |limit: f64| solve(&with(file.clone(), "/limits", json!({"deflection": limit})), planar(1.0, 1e6));
    let found = at(1e3);
    assert_eq!(found.before, None);
    let best = found.best.unwrap();
    assert_eq!((best.cables[0].name.as_str(), best.variables[0].to), ("soft", -0.5));
    assert!(
        is_near(best.objective, best.cables[0].cost.unwrap())
            && is_near(best.objective, best.cables[0].length)
    );
    // Along x the two cables have the stiffness (2 EA sin θ cos² θ + W)/H, at most with tan² θ = 1/2.
    let deflection = |ea: f64, h: f64| {
        let sine = HEIGHT / h.hypot(HEIGHT);
        1e5 * HEIGHT / (2.0 * ea * sine * (1.0 - sine * sine) + 981.0)
    };
    let limit = deflection(1e6, 1.5);
    assert!(deflection(2e5, 2.0_f64.sqrt() * HEIGHT) > 1.1 * limit, "soft cables are too soft");
    let best = at(limit).best.unwrap();
    assert_eq!(best.cables[0].name, "stiff");
    assert!((best.variables[0].to + 1.5).abs() < 0.01, "{:?}", best.variables);
    assert!(best.optimal && best.active[0].output == Some(Goal::Deflection), "{best:?}");
    // The front of cost against deflection is that of one search after the other.
    let pareto = with(file.clone(), "/pareto", json!({"output": "deflection", "points": 4})).to_string();
    let problem = DesignProblem::from_json(&pareto, Path::new("d.json"), planar(1.0, 1e6)).unwrap();
    let front = front(&problem).unwrap();
    assert!(front.points.len() >= 3 && front.points[0].cables[0].name == "soft", "{front:?}");
    for point in &front.points {
        let cheapest = at((1.0 + 1e-8) * point.objectives[1]).best.unwrap().objective;
        assert!(point.objectives[0] <= 1.001 * cheapest, "{cheapest} {point:?}");
    }
}

#[test]
fn wrong_tensions_lengths_and_costs_are_refused_with_field_value_and_what_is_right() {
    let good = apart([-6.0, -0.5], 100.0);
    for (field, value, words) in [
        ("/objective", json!({"output": "cost"}), "cables is empty: expected types of cable with the cost"),
        (
            "/objective",
            json!({"output": "length", "over": "mean"}),
            "objective.over is mean: expected worst, or none",
        ),
        (
            "/pareto",
            json!({"output": "length", "over": "mean"}),
            "pareto.over is mean: expected worst, or none",
        ),
        ("/pareto", json!({"output": "cost"}), "cables is empty: expected types of cable"),
        ("/limits", json!({"tension": 0}), "limits.tension is 0: expected a finite number above zero [N]"),
        ("/limits", json!({"length": -1}), "limits.length is -1: expected a finite number above zero [m]"),
        ("/limits", json!({"tension": "2 kN"}), "limits.tension"),
    ] {
        let text = with(good.clone(), field, value).to_string();
        let error = DesignProblem::from_json(&text, Path::new("design.json"), planar(1.0, 1e6)).unwrap_err();
        assert!(error.to_string().contains(words), "{field}: {error}");
    }
    let priceless = json!([{"name": "one", "section": 1e-5, "linear_density": 0.0, "youngs_modulus": 1e11}]);
    let file = with(with(good, "/cables", priceless), "/objective", json!({"output": "cost"}));
    let error =
        DesignProblem::from_json(&file.to_string(), Path::new("d.json"), planar(1.0, 1e6)).unwrap_err();
    assert!(
        error
            .to_string()
            .contains("cables[0].cost is missing: expected the cost of a metre, as the objective"),
        "{error}"
    );
}

/// Of the page `how-to/blank-frame`: with the thickest cable the search ends next to robots that no tensions
/// hold, where steps of differences twice as long have no values. The robot that it had found was lost.
#[test]
fn a_search_that_ends_next_to_robots_that_are_not_held_keeps_its_robot() {
    let page = |name: &str| {
        let path = format!("{}/../../docs/how-to/blank-frame/{name}", env!("CARGO_MANIFEST_DIR"));
        std::fs::read_to_string(path).unwrap()
    };
    let mut file: Value = serde_json::from_str(&page("cost.json")).unwrap();
    file["limits"] = json!({"position": 1});
    file["starts"] = json!(1);
    let poses = [[2.0, 1.5, 1.0], [-2.0, 1.5, 1.0], [2.0, 1.5, 2.5], [-2.0, 1.5, 2.5], [0.0, 0.0, 1.75]];
    file["poses"] = json!({"list": poses.map(|at| json!({"position": at}))});
    file["cables"] = json!([file["cables"][2]]);
    let rows = page("frame.csv");
    let cable = |row: &str| {
        let place: Vec<f64> = row.split(',').map(|cell| cell.parse().unwrap()).collect();
        json!({"exit_point": place[..3], "anchor_point": place[3..]})
    };
    let text = json!({
        "format": "cdpr-robot/1", "name": "Frame", "gravity": 9.81,
        "platform": {"mass": 160, "center_of_mass": [0, 0, 0]},
        "cable": {"section": 6.688e-6, "linear_density": 0.06096, "youngs_modulus": 1e11},
        "tension_limits": {"min": 50, "max": 3000}, "cables": rows.lines().skip(1).map(cable).collect::<Vec<_>>(),
    });
    let found = solve(&file, Robot::from_json(&text.to_string()).unwrap());
    let best = found.best.unwrap_or_else(|| panic!("{:?}", found.reason));
    // 71.47 m at 3 each before.
    assert!(best.objective < 0.99 * 3.0 * 71.47 && best.objective > 200.0, "{best:?}");
    assert!(best.outputs.len() == 1 && best.gradient_error.is_some());
}
