//! Designs whose optimum has a closed form, as cases of the evidence.

use crate::design::{HEIGHT, apart, data, planar, solve, with};
use cdpr_evidence::accept;
use cdpr_robot::Robot;
use serde_json::{Value, json};

/// With the cables at the angle θ to the horizontal, `T = W/(2 sin θ)`, `L = H/sin θ` and `EA (1 + T/EA)/L`
/// along a cable, the stiffness along x is `2/L (EA (1 + T/EA) cos²θ + T sin²θ)`, that is
/// `(2 EA sin θ cos²θ + W)/H`. It is greatest at tan²θ = 1/2, `h = √2 H`, whatever W is.
#[test]
fn a_mass_on_two_cables_is_stiffest_sideways_at_the_square_root_of_two_from_every_seed() {
    let mut worst = 0.0_f64;
    for seed in 0..100_u64 {
        let file = with(apart([-6.0, -0.5], 100.0), "/seed", json!(seed));
        let found = solve(&file, planar(1.0, 1e6));
        let best = found.best.unwrap();
        assert_eq!((found.feasible, best.same), (5, 5), "seed {seed}: {best:?}");
        let to = best.variables[0].to;
        worst = worst.max((to / (-(2.0_f64.sqrt()) * HEIGHT) - 1.0).abs());
        assert!(best.optimal && best.kkt_residual.unwrap() <= 1e-8, "seed {seed}: {best:?}");
        let (stiffness, ea) = ((2.0 * 1e6 * (1.0 / 3.0_f64).sqrt() * 2.0 / 3.0 + 981.0) / HEIGHT, 1e3);
        assert!((best.objective * stiffness / (100.0 * ea) - 1.0).abs() < 1e-6, "{}", best.objective);
        assert_eq!(best.robot.cables[1].exit_point.x, -to);
    }
    accept("V-DESIGN-001", worst);
}

/// A point mass in the middle of four cables from the corners `(±w, ±h)` of a rectangle, without gravity:
/// with the force T in each and `k = EA (1 + T/EA)/L`, the stiffness is `4 (k w² + T h²/L)/L²` along x and
/// `4 (k h² + T w²/L)/L²` along z. For a given h the first one grows with w up to `√2 h` and the second
/// falls. The lower of both is therefore greatest where they are equal: in the square, where the wrench
/// matrix is isotropic, its condition number 1.
#[test]
fn a_mass_between_four_cables_is_stiffest_in_the_square_whose_dexterity_is_one() {
    let (h, corners) = (1.5, [[-1.0, -1.0], [1.0, -1.0], [-1.0, 1.0], [1.0, 1.0]]);
    let text = json!({
        "format": "cdpr-robot/1", "name": "Rectangle", "gravity": 0.0, "plane": "xz",
        "platform": {"mass": 10.0, "center_of_mass": [0, 0, 0], "point": true},
        "cable": {"section": 1e-5, "youngs_modulus": 1e11, "linear_density": 0.0},
        "tension_limits": {"min": 1.0, "max": 1e5}, "tension_reference": 500.0,
        "cables": corners.map(|[x, z]| json!({"exit_point": [x, 0, h * z], "anchor_point": [0, 0, 0]})),
    });
    let file = json!({
        "format": "cdpr-design/1",
        "variables": [{"parameters": ["b1.x", "b2.x", "b3.x", "b4.x"], "signs": [1, -1, 1, -1],
            "bounds": [-2.8, -0.4]}],
        "poses": {"list": [{"position": [0, 0, 0]}]},
        "objective": {"output": "stiffness", "over": "worst"}, "starts": 8,
    });
    let found = solve(&file, Robot::from_json(&text.to_string()).unwrap());
    let best = found.best.unwrap();
    // The two stiffnesses are equal there, so that the lower one has no derivative, which the residual says.
    assert!(best.same == 8 && !best.optimal, "{best:?}");
    let [sx, sz] = best.robot.cables.iter().fold([0.0, 0.0], |[sx, sz], cable| {
        let u = cable.exit_point.normalize();
        [sx + u.x * u.x, sz + u.z * u.z]
    });
    accept("V-DESIGN-002", (sx.max(sz) / sx.min(sz)).sqrt() - 1.0);
}

/// Cables of a point mass from exits at these places and this height.
fn cables(places: &[f64], height: f64) -> Vec<Value> {
    places.iter().map(|x| json!({"exit_point": [x, 0.0, height], "anchor_point": [0, 0, 0]})).collect()
}

/// The support tension of a catenary over the half span x is `w x cosh(u)/u`, with u the half span in units
/// of its parameter. Its derivative vanishes where `u tanh u = 1`, with the sag `x (cosh u - 1)/u`. A
/// platform without weight to speak of hangs at the lowest point.
#[test]
fn heavy_cables_pull_least_at_their_exits_with_the_sag_of_the_catenary_of_least_tension() {
    let (mut u, x) = (1.2_f64, 5.0);
    for _ in 0..50 {
        u -= (u * u.tanh() - 1.0) / (u.tanh() + u / u.cosh().powi(2));
    }
    let sag = x * (u.cosh() - 1.0) / u;
    let text = json!({
        "format": "cdpr-robot/1", "name": "Heavy", "gravity": 9.81, "plane": "xz",
        "platform": {"mass": 1e-6, "center_of_mass": [0, 0, 0], "point": true},
        "cable": {"section": 1e-2, "youngs_modulus": 1e11, "linear_density": 1.0},
        "tension_limits": {"min": 0.1, "max": 1e5},
        "cables": cables(&[-x, x], 2.0),
    });
    let file = json!({
        "format": "cdpr-design/1",
        "variables": [{"parameters": ["b1.z", "b2.z"], "bounds": [1.0, 8.0]}],
        "poses": {"list": [{"position": [0, 0, 0]}]},
        "objective": {"output": "tension"}, "starts": 6,
    });
    let found = solve(&file, Robot::from_json(&text.to_string()).unwrap());
    let best = found.best.unwrap();
    assert!(best.optimal && best.same == 6, "{best:?}");
    let tension = 9.81 * x * u.cosh() / u;
    assert!((best.objective / tension - 1.0).abs() < 1e-6, "{} {tension}", best.objective);
    accept("V-DESIGN-003", (best.variables[0].to / sag - 1.0).abs());
}

/// Two steep cables bear the mass, and two others from `(∓x, 0, H)` and `(±x, 0, H)` hold it sideways, by `2
/// EA x²/(x² + H²)^(3/2)`: a robot for x and for -x. Where x may be -6 to 1 there are two optima, that of
/// `√2 H` and that on the bound 1, from which the first start begins.
#[test]
fn the_better_of_two_optima_is_found_from_every_seed() {
    let text = json!({
        "format": "cdpr-robot/1", "name": "Two pairs", "gravity": 9.81, "plane": "xz",
        "platform": {"mass": 100.0, "center_of_mass": [0, 0, 0], "point": true},
        "cable": {"section": 1e-2, "youngs_modulus": 1e11, "linear_density": 0.0},
        "tension_limits": {"min": 1.0, "max": 1e5},
        "cables": cables(&[-0.4, 0.4, 0.9, -0.9], HEIGHT),
    });
    let robot = Robot::from_json(&text.to_string()).unwrap();
    let (mut worst, mut elsewhere) = (0.0_f64, 0);
    for seed in 0..100_u64 {
        let file = json!({
            "format": "cdpr-design/1", "seed": seed, "starts": 6,
            "variables": [{"parameters": ["b3.x", "b4.x"], "signs": [1, -1], "bounds": [-6, 1]}],
            "poses": {"list": [{"position": [0, 0, 0]}]},
            "objective": {"output": "stiffness"},
        });
        let found = solve(&file, robot.clone());
        let best = found.best.unwrap();
        assert!(best.optimal && best.kkt_residual.unwrap() <= 1e-8, "seed {seed}: {best:?}");
        elsewhere += found.feasible - best.same;
        worst = worst.max((best.variables[0].to / (-(2.0_f64.sqrt()) * HEIGHT) - 1.0).abs());
    }
    assert!(elsewhere > 0);
    accept("V-DESIGN-004", worst);
}

/// The optimum of differential evolution on straight springs, which share no code with these.
#[test]
fn the_exits_of_caroca_are_at_least_as_good_as_those_of_differential_evolution() {
    let path = concat!(env!("CARGO_MANIFEST_DIR"), "/../../data/reference/design.json");
    let reference: Value = serde_json::from_str(&std::fs::read_to_string(path).unwrap()).unwrap();
    let bounds = reference["bounds"].as_array().unwrap();
    let names = |axis: &str| (1..9).map(|i| format!("b{i}.{axis}")).collect::<Vec<_>>();
    let list: Vec<Value> =
        reference["poses"].as_array().unwrap().iter().map(|at| json!({"position": at})).collect();
    let [low, high] = [0, 1].map(|k| -bounds[0][1 - k].as_f64().unwrap());
    let file = json!({
        "format": "cdpr-design/1", "payload": reference["payload"], "poses": {"list": list}, "starts": 16,
        "variables": [
            {"parameters": names("x"), "signs": [1, -1, 1, -1, 1, -1, 1, -1], "bounds": [low, high]},
            {"parameters": names("y"), "signs": [1, 1, 1, 1, -1, -1, -1, -1], "bounds": bounds[1]},
            {"parameters": names("z"), "bounds": bounds[2]},
        ],
        "objective": {"output": "deflection", "over": "worst"},
    });
    let mut robot = data("caroca");
    robot.cables.iter_mut().for_each(|cable| cable.properties.linear_density = 0.0);
    let best = solve(&file, robot).best.unwrap();
    assert!(best.optimal, "{best:?}");
    accept("V-DESIGN-005", best.objective / reference["deflection_mm"].as_f64().unwrap() - 1.0);
    let values = best.variables.iter().map(|variable| variable.to.abs());
    for (value, expected) in values.zip(reference["values"].as_array().unwrap()) {
        assert!((value - expected.as_f64().unwrap()).abs() < 1e-4, "{value} {expected}");
    }
}

/// The two-bar truss of a course of optimization at Brigham Young University (byu.apmonitor.com, ME 575, Two
/// Bar Truss), upside down with cables as bars: width 60 in, diameter 3 in, thickness 0.15 in, 30 000 ksi,
/// 66 kips. Its deflection is `P L³/(2 E A H²)`, which is least at `H = √2 B/2`.
#[test]
fn the_two_bar_truss_deflects_least_at_the_height_of_its_published_formula() {
    let (inch, kip) = (0.0254, 4448.2216);
    let (half, area) = (30.0, std::f64::consts::PI * 3.0 * 0.15);
    let text = json!({
        "format": "cdpr-robot/1", "name": "Truss", "gravity": 9.81, "plane": "xz",
        "platform": {"mass": 1.0, "center_of_mass": [0, 0, 0], "point": true},
        "cable": {
            "section": area * inch * inch, "youngs_modulus": 3e4 * kip / (inch * inch), "linear_density": 0.0,
        },
        "tension_limits": {"min": 0.1, "max": 100.0 * kip * area},
        "cables": cables(&[-half * inch, half * inch], 30.0 * inch),
    });
    let file = json!({
        "format": "cdpr-design/1", "wrench": [0, 0, -66.0 * kip, 0, 0, 0], "starts": 6,
        "variables": [{"parameters": ["b1.z", "b2.z"], "bounds": [10.0 * inch, 50.0 * inch]}],
        "poses": {"list": [{"position": [0, 0, 0]}]},
        "objective": {"output": "deflection"},
    });
    let best = solve(&file, Robot::from_json(&text.to_string()).unwrap()).best.unwrap();
    assert!(best.optimal && best.same == 6, "{best:?}");
    let formula = |height: f64| 66.0 * half.hypot(height).powi(3) / (2.0 * 3e4 * area * height * height);
    accept("V-DESIGN-006", formula(best.variables[0].to / inch) / formula(2.0_f64.sqrt() * half) - 1.0);
    // The cables stretch by a thousandth, which turns them.
    let deflection = formula(2.0_f64.sqrt() * half) * 1e3 * inch;
    assert!((best.objective / deflection - 1.0).abs() < 2e-3, "{} {deflection}", best.objective);
}

/// To which corner of the platform each cable of CoGiRo runs is what its makers chose (M. Gouttefarde, J.-F.
/// Collard, N. Riehl, C. Baradat, *Geometry selection of a redundantly actuated cable-suspended parallel
/// robot*, IEEE Trans. Robotics 31, 2015). Here the anchor points of the lower and of the upper cables
/// change sides along x or y or not, 16 arrangements.
#[test]
fn of_all_arrangements_of_the_cables_of_cogiro_the_published_one_pulls_least() {
    let robot = data("cogiro");
    let side = |cables: [usize; 4], axis: &str, signs: [i32; 4]| {
        let first = robot.cables[cables[0] - 1].anchor_point;
        let value = if axis == "x" { first.x } else { first.y };
        json!({
            "parameters": cables.map(|i| format!("a{i}.{axis}")), "signs": signs,
            "choices": vec![value, -value],
        })
    };
    let (lower, upper) = ([1, 3, 5, 7], [2, 4, 6, 8]);
    let (along_x, along_y) = ([1, -1, -1, 1], [1, 1, -1, -1]);
    let grid = json!({
        "x": {"min": -5, "max": 5, "points": 5}, "y": {"min": -3, "max": 3, "points": 4},
        "z": {"min": 0.5, "max": 2, "points": 3},
    });
    let file = json!({
        "format": "cdpr-design/1", "payload": 100, "poses": {"grid": grid},
        "variables": [
            side(lower, "x", along_x), side(lower, "y", along_y),
            side(upper, "x", along_x), side(upper, "y", along_y),
        ],
        "objective": {"output": "tension"},
    });
    let found = solve(&file, robot.clone());
    let (best, published) = (found.best.unwrap(), found.before.unwrap());
    assert_eq!((found.configurations, found.feasible), (16, 2));
    assert!(best.variables.iter().all(|of| of.to == of.from), "{best:?}");
    accept("V-DESIGN-007", best.objective / published - 1.0);
    assert!(best.next_configuration.unwrap() > 1.1 * published);
}
