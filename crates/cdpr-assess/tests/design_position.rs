//! Position errors by tolerances as objective and demand of a design.

use crate::design::{data, planar, solve, with};
use cdpr_assess::DesignProblem;
use cdpr_robot::{Matrix3, Parameter, Pose, Robot, Vector3};
use cdpr_sensitivity::{Estimate, Law, RandomDesign, SampleDesign};
use cdpr_statics::{DirectStart, Load, direct, inverse};
use cdpr_study::Study;
use serde_json::{Value, json};
use std::path::Path;

/// Deviations of points, mass and modulus as errors of normal and uniform laws, times a share.
fn errors(share: f64) -> Value {
    let normal = |std: f64| json!({"law": {"normal": {"mean": 0, "std": share * std}}});
    let b = json!({"law": {"uniform": {"min": -1.5e-3 * share, "max": 1.5e-3 * share}}});
    json!({"a": normal(5e-4), "b": b, "mass": normal(0.5), "youngs_modulus": normal(1e9)})
}

/// The position errors [mm] of a robot as it is.
fn of(robot: Robot, poses: &[[f64; 3]], errors: &Value) -> Vec<f64> {
    let list: Vec<Value> = poses.iter().map(|pose| json!({"position": pose})).collect();
    let height = robot.cables[0].exit_point.z;
    let file = json!({
        "format": "cdpr-design/1", "poses": {"list": list}, "errors": errors,
        "variables": [{"parameters": ["b1.z"], "choices": [height]}],
        "objective": {"output": "position", "over": "worst"},
    });
    solve(&file, robot).best.unwrap().outputs
}

const ROBOTS: [(&str, [f64; 3]); 3] =
    [("caroca", [0.4, -0.3, 1.6]), ("cogiro", [1.0, 0.5, 1.2]), ("ipanema-3", [0.5, -0.4, 1.3])];

/// Small enough for the first order.
const SMALL: f64 = 0.1;

#[test]
fn a_sample_of_three_robots_has_the_error_of_the_first_order_as_its_quantile() {
    for (name, pose) in ROBOTS {
        let study = json!({
            "format": "cdpr-study/1", "name": name, "robot": format!("../robots/{name}.json"),
            "seed": 1, "replicates": 0, "confidence": 0.95, "bootstrap_resamples": 10,
            "output": "position", "error_models": {"all": errors(SMALL)},
            "samplings": {"point": {
                "title": name, "pose": {"position": pose}, "error_model": "all", "observations": 16,
            }},
        });
        let place = concat!(env!("CARGO_MANIFEST_DIR"), "/../../data/studies/position.json");
        let study = Study::from_json(&study.to_string(), Path::new(place)).unwrap();
        let sampling = study.sampling("point").unwrap();
        let design = RandomDesign::new(sampling.errors.inputs.clone(), 6000, 7).unwrap();
        let mut rows = vec![0.0; 6000 * sampling.errors.inputs.len()];
        design.rows(0, &mut rows).unwrap();
        let observed = sampling.observer.observe(&sampling.errors.deviations(&rows));
        let mut away: Vec<f64> = observed.into_iter().map(|found| found.unwrap().value()).collect();
        away.sort_by(f64::total_cmp);
        let sample = Estimate::of_quantile(&away, 0.95, 0.999).unwrap();
        let [found] = of(data(name), &[pose], &errors(SMALL))[..] else { panic!() };
        assert!(sample.low <= found && found <= sample.high, "{name}: {found} {sample:?}");
    }
}

/// The distance within which 95 % of normal displacements with a covariance are, by bisection of the mean
/// over directions on Fibonacci's lattice of the sphere.
fn distance(covariance: &Matrix3<f64>) -> f64 {
    const DIRECTIONS: usize = 40_000;
    let turn = std::f64::consts::PI * (3.0 - 5.0_f64.sqrt());
    let sizes: Vec<f64> = (0..DIRECTIONS)
        .map(|k| {
            let z = 1.0 - (2.0 * k as f64 + 1.0) / DIRECTIONS as f64;
            let (r, angle) = ((1.0 - z * z).sqrt(), turn * k as f64);
            let u = Vector3::new(r * angle.cos(), r * angle.sin(), z);
            u.dot(&(covariance * u)).sqrt()
        })
        .collect();
    let normal = Law::Normal { mean: 0.0, std: 1.0 };
    let chi =
        |x: f64| 2.0 * normal.cdf(x) - 1.0 - (2.0 / std::f64::consts::PI).sqrt() * x * (-0.5 * x * x).exp();
    let (mut low, mut high) = (0.0, 4.0 * covariance.trace().sqrt());
    for _ in 0..40 {
        let middle = 0.5 * (low + high);
        let within = sizes.iter().map(|size| chi(middle / size)).sum::<f64>() / DIRECTIONS as f64;
        *(if within < 0.95 { &mut low } else { &mut high }) = middle;
    }
    low
}

#[test]
fn a_loop_over_the_parameters_with_the_direct_model_has_the_same_position_errors() {
    for (name, place) in ROBOTS {
        let (robot, pose) = (data(name), Pose::at(place[0], place[1], place[2]));
        let held = inverse(&robot, &pose, &Load::none()).unwrap();
        let mut covariance = Matrix3::zeros();
        for parameter in Parameter::of(&robot) {
            let (std, step) = match parameter.group() {
                "a" => (5e-4, 1e-5),
                "b" => (1.5e-3 / 3.0_f64.sqrt(), 1e-5),
                "mass" => (0.5, 1e-2),
                "youngs_modulus" => (1e9, 1e7),
                _ => continue,
            };
            let moved = |by: f64| {
                let value = parameter.nominal(&robot) + by;
                let moved = robot.with_values(&[(parameter.to_string().as_str(), value)]).unwrap();
                let start = DirectStart::Near(&held.equilibrium);
                direct(&moved, &held.lengths, &Load::none(), start).unwrap().equilibrium.pose.position
            };
            let slope = std * (moved(step) - moved(-step)) / (2.0 * step);
            covariance += slope * slope.transpose();
        }
        let [found] = of(robot, &[place], &errors(1.0))[..] else { panic!() };
        let by_hand = 1e3 * distance(&covariance);
        assert!((found / by_hand - 1.0).abs() < 1e-5, "{name}: {found} {by_hand}");
    }
}

/// The robot of [`planar`] on cables that hardly stretch: `(±h, H)`, H = 2 m.
fn stiff() -> Robot {
    let mut robot = planar(1.0, 1e6);
    robot.cables.iter_mut().for_each(|cable| cable.properties.youngs_modulus = 1e16);
    robot
}

/// Both exits move apart; each coordinate of them deviates by 1 mm.
fn tolerant(objective: &Value) -> Value {
    json!({
        "format": "cdpr-design/1",
        "variables": [{"parameters": ["b1.x", "b2.x"], "signs": [1, -1], "bounds": [-6.0, -0.5]}],
        "poses": {"list": [{"position": [0, 0, 0]}]},
        "errors": {"b": {"law": {"normal": {"mean": 0, "std": 1e-3}}}},
        "objective": objective, "wrench": [100, 0, 0, 0, 0, 0], "starts": 5,
    })
}

/// Cables at the angle θ that do not stretch: with the errors n1, n2 of the exits along the cables, each of
/// deviation σ, `x = (n2 - n1)/(2 cos θ)` and `z = (n1 + n2)/(2 sin θ)`, so that the variances are
/// `σ²/(2 cos² θ)` and `σ²/(2 sin² θ)`. At 45° both are σ², and the distance is that of Rayleigh's law,
/// `σ √(-2 ln 0.05)`: the least.
#[test]
fn exits_as_far_apart_as_high_make_the_position_error_of_a_mass_on_two_cables_least() {
    let found = solve(&tolerant(&json!({"output": "position", "over": "worst"})), stiff());
    let best = found.best.unwrap();
    assert_eq!((found.feasible, best.same), (5, 5), "{best:?}");
    let least = (-2.0 * 0.05_f64.ln()).sqrt();
    assert!((best.objective / least - 1.0).abs() < 1e-6, "{} {least}", best.objective);
    assert!((best.variables[0].to + 2.0).abs() < 1e-4, "{:?}", best.variables);
    let error = best.gradient_error.unwrap();
    assert!(best.optimal && best.kkt_residual.unwrap() + error <= 1e-6, "{best:?}");
    assert!(found.basis.unwrap().contains("95 %") && found.basis.unwrap().contains("normal"));
}

#[test]
fn a_demanded_position_error_ends_the_design_where_it_is_reached() {
    let least = (-2.0 * 0.05_f64.ln()).sqrt();
    let deflection = tolerant(&json!({"output": "deflection", "over": "worst"}));
    let free = solve(&deflection, stiff()).best.unwrap();
    let limited = solve(&with(deflection, "/limits", json!({"position": 1.02 * least})), stiff());
    let best = limited.best.unwrap();
    assert!(free.objective < best.objective && best.active.len() == 1, "{best:?}");
    // The exits stay nearer than the stiffest ones, where the error is as demanded.
    let x = best.variables[0].to;
    let at =
        with(tolerant(&json!({"output": "position", "over": "mean"})), "/variables/0/bounds", json!(null));
    let at = solve(&with(at, "/variables/0/choices", json!([x])), stiff()).best.unwrap();
    assert!((at.objective / (1.02 * least) - 1.0).abs() < 1e-6, "{x}: {}", at.objective);
    assert!(best.gradient_error.unwrap() < 1e-6);
}

#[test]
fn the_greatest_and_the_mean_position_error_are_those_of_the_poses() {
    let poses = [[0.0, 0.0, 1.75], [1.0, 0.4, 1.2], [-1.0, 0.2, 2.0]];
    let all = of(data("caroca"), &poses, &errors(1.0));
    for (pose, one) in poses.iter().zip(&all) {
        let [alone] = of(data("caroca"), &[*pose], &errors(1.0))[..] else { panic!() };
        assert!((one / alone - 1.0).abs() < 1e-9, "{one} {alone}");
    }
    // Offsets of the tensions count, too: they enlarge the error.
    let mut with_offsets = errors(1.0);
    with_offsets["dt"] = json!({"law": {"normal": {"mean": 0, "std": 100}}});
    let more = of(data("caroca"), &poses, &with_offsets);
    assert!(more.iter().zip(&all).all(|(more, one)| more > one), "{more:?} {all:?}");
}

#[test]
fn position_errors_without_a_sound_error_model_are_refused() {
    let good = tolerant(&json!({"output": "position", "over": "worst"}));
    for (value, words) in [
        (json!(null), "errors is missing: expected the deviations that a position error follows from"),
        (json!({}), "errors is empty: expected at least one parameter"),
        (json!({"q": {"law": {"normal": {"mean": 0, "std": 1}}}}), "errors.q is q: expected a parameter"),
        (
            json!({"b": {"law": {"normal": {"mean": 0, "std": -1}}}}),
            "errors.b1.x.std is -1: expected a positive",
        ),
        (json!({"b": {"law": {"uniform": {"min": 0, "max": 1}}}}), "expected a law with mean zero"),
    ] {
        let text = with(good.clone(), "/errors", value.clone()).to_string();
        let error =
            DesignProblem::from_json(&text, Path::new("design.json"), stiff()).unwrap_err().to_string();
        assert!(error.contains(words), "{value}: {error}");
    }
}
