//! Motions over time against two programs that share no code with this one (`data/reference/transients.json`).

use crate::reference::{matrix, number, numbers, vector};
use cdpr_dynamics::simulate::{Discretization, Settings, events_from_json, simulate};
use cdpr_robot::{
    CableProperties, Gravity, Platform, Pose, Robot, RobotCable, Rotation3, TensionLimits, Vector3,
};
use cdpr_statics::{DirectProblem, DirectStart, Load};
use serde_json::Value;

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
        ..Platform::new(91.058, vector(&case["center_of_mass"]))
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

#[test]
fn platforms_move_as_chains_of_many_elements_do() {
    let file: Value = serde_json::from_str(include_str!("../../../data/reference/transients.json")).unwrap();
    let robot = robot(&file);
    let lengths = numbers(&file["robot"]["unstrained_lengths"]);
    let only = std::env::var("CASE").ok();
    let env = |name: &str, usual: f64| std::env::var(name).map_or(usual, |text| text.parse().unwrap());
    for case in file["cases"].as_array().unwrap() {
        let name = case["name"].as_str().unwrap();
        if only.as_ref().is_some_and(|only| only != name) {
            continue;
        }
        let events = match name {
            "release" => r#"[{"t": 0, "payload": -50}]"#,
            "cut" => r#"[{"t": 0, "cut": 1, "at": "anchor"}]"#,
            "displaced" => r#"[{"t": 0, "displace": [0, 0, 0.005, 0, 0, 0]}]"#,
            "winch" => r#"[{"t": 0, "shorten": {"cable": 1, "by": 0.02, "over": 0.2}}]"#,
            "winch3" => {
                r#"[{"t": 0, "shorten": {"cable": 1, "by": 0.003, "over": 0.2, "profile": "cosine"}}]"#
            }
            _ => r#"[{"t": 0, "force": [100, 0, 0]}]"#,
        };
        let events = events_from_json(events).unwrap();
        let load = Load::payload(number(&case["start_mass"]) - 91.058);
        let problem = DirectProblem::new(&robot, &lengths, &load).unwrap();
        let rest = problem.direct(DirectStart::Pose(&Pose::at(0.0, 0.0, 2.0))).unwrap();
        let usual = Settings::until(2.0);
        let settings = Settings {
            damping: env("TAU", 2e-4),
            tolerance: env("TOL", usual.tolerance),
            discretization: std::env::var("EL").ok().map(|_| Discretization {
                elements: env("EL", 3.0) as usize,
                degree: env("DEG", 5.0) as usize,
            }),
            ..usual
        };
        let clock = std::time::Instant::now();
        let series = match simulate(&problem, &rest.equilibrium, &events, &settings) {
            Ok(series) => series,
            Err(error) => {
                println!("{name}: {error}");
                continue;
            }
        };
        let (mut position, mut rotation, mut tension) = (0.0f64, 0.0f64, 0.0f64);
        for (found, expected) in series.samples.iter().zip(case["samples"].as_array().unwrap()) {
            let expected = numbers(expected);
            assert!((found.time - expected[0]).abs() < 1e-9);
            let pose = Pose {
                position: Vector3::from_column_slice(&expected[1..4]),
                rotation: Rotation3::new(Vector3::from_column_slice(&expected[4..7])),
            };
            let motion = found.pose.motion_to(&pose);
            position = position.max(motion.fixed_rows::<3>(0).norm());
            rotation = rotation.max(motion.fixed_rows::<3>(3).norm());
            if found.time >= 0.02 {
                for (i, [exit, anchor]) in found.tensions.iter().enumerate() {
                    tension = tension.max((exit - expected[7 + i]).abs());
                    tension = tension.max((anchor - expected[15 + i]).abs());
                }
            }
        }
        println!(
            "{name}: position {position:.2e} m, rotation {rotation:.2e}, tension {tension:.3} N; difference {:?}; energy {:?}; rest {:.1e}; {:?}; peak 3 {:?}; {:.2?}",
            series.difference,
            series.energy,
            series.residual,
            series.work,
            series.peaks[2],
            clock.elapsed()
        );
    }
}
