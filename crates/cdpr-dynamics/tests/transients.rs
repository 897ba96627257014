//! Motions over time against two programs that share no code with this one
//! (`data/reference/transients.json`).

use crate::reference::{matrix, number, numbers, vector};
use cdpr_dynamics::simulate::{Series, Settings, events_from_json, simulate};
use cdpr_evidence::accept;
use cdpr_robot::{
    CableProperties, Gravity, Platform, Pose, Robot, RobotCable, Rotation3, TensionLimits, Vector3,
};
use cdpr_statics::{DirectProblem, DirectStart, Load};
use serde_json::Value;

fn file() -> Value {
    serde_json::from_str(include_str!("../../../data/reference/transients.json")).unwrap()
}

fn robot(file: &Value) -> Robot {
    let case = &file["robot"];
    let template = Robot::from_json(include_str!("../../../data/robots/cogiro.json")).unwrap();
    let stiffness = number(&case["axial_stiffness"]);
    let properties = CableProperties::linear(1e-5, number(&case["linear_density"]), stiffness / 1e-5);
    let points = |name: &str| case[name].as_array().unwrap().iter().map(vector).collect::<Vec<_>>();
    let cables = points("exit_points").into_iter().zip(points("anchor_points"));
    let cables = cables.map(|(exit, anchor)| RobotCable::between(exit, anchor, properties.clone()));
    let platform = Platform {
        inertia: Some(matrix(&case["inertia_about_com"])),
        ..Platform::new(MASS, vector(&case["center_of_mass"]))
    };
    Robot {
        gravity: Gravity::from(vector(&case["gravity"])),
        platform,
        ground_z: None,
        tension_limits: TensionLimits { min: 0.0, max: 1e12 },
        cables: cables.collect(),
        ..template
    }
}

const MASS: f64 = 91.058;

fn solve(file: &Value, name: &str, settings: &Settings) -> Series {
    let case = case(file, name);
    let events = match name {
        "release" => r#"[{"t": 0, "payload": -50}]"#,
        "cut" => r#"[{"t": 0, "cut": 1, "at": "anchor"}]"#,
        "displaced" => r#"[{"t": 0, "displace": [0, 0, 0.005, 0, 0, 0]}]"#,
        "winch" => r#"[{"t": 0, "shorten": {"cable": 1, "by": 0.02, "over": 0.2}}]"#,
        "winch3" => r#"[{"t": 0, "shorten": {"cable": 1, "by": 0.003, "over": 0.2, "profile": "cosine"}}]"#,
        "wind" => r#"[{"t": 0, "force": [100, 0, 0]}]"#,
        _ => panic!("{name}"),
    };
    let robot = robot(file);
    let lengths = numbers(&file["robot"]["unstrained_lengths"]);
    let load = Load::payload(number(&case["start_mass"]) - MASS);
    let problem = DirectProblem::new(&robot, &lengths, &load).unwrap();
    let rest = problem.direct(DirectStart::Pose(&Pose::at(0.0, 0.0, 2.0))).unwrap();
    simulate(&problem, &rest.equilibrium, &events_from_json(events).unwrap(), settings).unwrap()
}

fn case<'a>(file: &'a Value, name: &str) -> &'a Value {
    file["cases"].as_array().unwrap().iter().find(|case| case["name"] == name).unwrap()
}

/// Greatest error of the position [m] and of the rotation [rad]; then of a tension [N] once the first waves
/// have passed.
fn errors(series: &Series, case: &Value) -> [f64; 3] {
    let mut errors = [0.0_f64; 3];
    for (found, expected) in series.samples.iter().zip(case["samples"].as_array().unwrap()) {
        let expected = numbers(expected);
        assert!((found.time - expected[0]).abs() < 1e-9);
        let pose = Pose {
            position: Vector3::from_column_slice(&expected[1..4]),
            rotation: Rotation3::new(Vector3::from_column_slice(&expected[4..7])),
        };
        let motion = found.pose.motion_to(&pose);
        errors[0] = errors[0].max(motion.fixed_rows::<3>(0).norm());
        errors[1] = errors[1].max(motion.fixed_rows::<3>(3).norm());
        let cables = found.tensions.len();
        for (i, [exit, anchor]) in found.tensions.iter().enumerate().filter(|_| found.time >= 0.02) {
            let tensions = [exit - expected[7 + i], anchor - expected[7 + cables + i]];
            errors[2] = tensions.into_iter().fold(errors[2], |most, error| most.max(error.abs()));
        }
    }
    errors
}

#[test]
fn platforms_on_taut_cables_move_as_chains_of_many_elements_do() {
    let file = file();
    for name in ["release", "displaced", "wind", "winch3"] {
        let series = solve(&file, name, &Settings { damping: 2e-4, ..Settings::until(2.0) });
        let [position, rotation, tension] = errors(&series, case(&file, name));
        accept("V-MOTION-008", position);
        accept("V-MOTION-009", tension);
        assert_eq!(series.samples.len(), 201);
        assert!(rotation < 3e-6, "{name}: {rotation}");
        // The difference that is printed bounds what is left, but for the error of the reference.
        assert!(position < series.difference.position + 2e-6, "{name}");
        assert!(series.slack.iter().all(|slack| !slack), "{name}");
        assert!(series.energy.drift.abs() < 1e-5 * series.energy.kinetic.max(1.0), "{name}");
    }
}

#[test]
fn platforms_on_cables_that_go_slack_move_as_chains_do() {
    let file = file();
    for name in ["cut", "winch"] {
        let series = solve(&file, name, &Settings { damping: 2e-4, ..Settings::until(0.6) });
        let [position, rotation, _] = errors(&series, case(&file, name));
        accept("V-MOTION-010", position);
        assert!(rotation < 6e-4 && series.slack.contains(&true), "{name}");
        if name == "cut" {
            let (peak, time) = series.peaks[2];
            accept("V-MOTION-011", (peak - 1087.9).abs());
            assert!((time - 0.1847).abs() < 1e-3, "{time}");
        }
    }
}

#[test]
fn without_damping_energy_stays() {
    let file = file();
    for name in ["release", "displaced"] {
        let series = solve(&file, name, &Settings { tolerance: 3e-9, ..Settings::until(1.0) });
        let energy = series.energy;
        accept("V-MOTION-012", energy.drift.abs() / energy.kinetic);
        assert_eq!(energy.lost, 0.0, "{name}: {energy:?}");
    }
}
