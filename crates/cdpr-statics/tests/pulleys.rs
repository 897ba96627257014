//! Robots whose cables run over swivelling pulleys with a lead, against arithmetic of 20 digits
//! (`data/reference/README.md`) and against the same robots without.

use crate::common::{caroca, cogiro, fast, stadium};
use crate::equilibria::{number, vector};
use crate::reference::rotation;
use cdpr_evidence::accept;
use cdpr_robot::{
    CableEnd, CableProperties, Platform, Pose, Pulley, Robot, RobotCable, Rotation3, TensionLimits, Vector3,
    Wrench,
};
use cdpr_statics::stiffness::stiffness_at;
use cdpr_statics::{DirectMethod, DirectProblem, DirectStart, Load, WantedPose, deflection, direct, inverse};
use nalgebra::Matrix6;
use serde_json::Value;

/// A case of the file as a robot.
pub(crate) fn robot(case: &Value) -> Robot {
    let gravity = vector(&case["gravity"]);
    let pulleys = case["pulleys"].as_array().unwrap();
    let cables = pulleys.iter().enumerate().map(|(i, pulley)| {
        let density = number(&case["weight_per_length"][i]) / gravity.norm();
        let properties = CableProperties::linear(1.0, density, number(&case["axial_stiffness"][i]));
        let anchor = vector(&case["anchor_points"][i]);
        RobotCable {
            pulley: Some(Pulley { radius: number(&pulley["radius"]), axis: vector(&pulley["axis"]) })
                .filter(|pulley| pulley.radius > 0.0),
            lead: number(&pulley["lead"]),
            ..RobotCable::between(vector(&pulley["entry_point"]), anchor, properties)
        }
    });
    Robot {
        name: case["kind"].as_str().unwrap().to_owned(),
        provenance: Default::default(),
        gravity: if gravity.xy().norm() > 0.0 { gravity.into() } else { gravity.norm().into() },
        platform: Platform::new(number(&case["mass"]), vector(&case["center_of_mass"])),
        tension_limits: TensionLimits { min: 1e-3, max: 1e7 },
        max_at: CableEnd::Anchor,
        ground_z: None,
        plane: None,
        tension_reference: None,
        distribution: Default::default(),
        cables: cables.collect(),
    }
}

#[test]
fn equilibria_over_pulleys_match_arithmetic_of_20_digits() {
    let file: Value = serde_json::from_str(include_str!("../../../data/reference/pulleys.json")).unwrap();
    let cases = file["cases"].as_array().unwrap();
    let mut compared = 0;
    for case in cases {
        let robot = robot(case);
        robot.validate().unwrap();
        let lengths: Vec<f64> = case["unstrained_lengths"].as_array().unwrap().iter().map(number).collect();
        let load = Load::wrench(Wrench { force: vector(&case["force"]), moment: vector(&case["moment"]) });
        let start =
            Pose { position: vector(&case["start_position"]), rotation: rotation(&case["start_rotation"]) };
        let expected = Pose { position: vector(&case["position"]), rotation: rotation(&case["rotation"]) };
        let solution = direct(&robot, &lengths, &load, DirectStart::Pose(&start)).unwrap();
        let motion = expected.motion_to(&solution.equilibrium.pose);
        let (position, angle) = (motion.fixed_rows::<3>(0).norm(), motion.fixed_rows::<3>(3).norm());
        let of_cables = |name: &str| -> Vec<f64> {
            case["cables"].as_array().unwrap().iter().map(|cable| number(&cable[name])).collect()
        };
        let [tensions, exits] = ["tension_at_anchor", "tension_at_pulley"].map(of_cables);
        let found = [solution.equilibrium.tensions(), solution.equilibrium.exit_tensions(&robot, &lengths)];
        let both = found.iter().flatten().zip(tensions.iter().chain(&exits));
        let worst = both.map(|(t, e)| (t / e - 1.0).abs()).fold(0.0, f64::max);
        let problem = DirectProblem::new(&robot, &lengths, &load).unwrap();
        let exact = Matrix6::from_fn(|i, j| number(&case["stiffness"][i][j]));
        let stiffness = *problem.linearize(&solution.equilibrium).unwrap().stiffness();
        let off = (stiffness - exact).norm() / exact.norm();
        let method = solution.report.method;
        let line = format!(
            "{:18} {position:8.1e} m {angle:8.1e} rad, tensions {worst:8.1e}, stiffness {off:8.1e}, \
             {method} {}",
            robot.name, solution.report.iterations
        );
        accept("V-DIRECT-004", position);
        accept("V-DIRECT-005", worst);
        accept("V-DIRECT-006", off);
        assert!(angle < 1e-9, "{line}");
        assert!(solution.stability.is_stable());
        // So does Newton's method in lanes from an equilibrium nearby.
        let part = Wrench { force: 0.98 * load.wrench.force, moment: 0.98 * load.wrench.moment };
        let near = DirectStart::Near(&solution.equilibrium);
        let near = direct(&robot, &lengths, &Load::wrench(part), near).unwrap().equilibrium;
        let again = direct(&robot, &lengths, &load, DirectStart::Near(&near)).unwrap();
        let off = expected.motion_to(&again.equilibrium.pose).norm();
        assert!(off < 1e-9 && again.report.method == DirectMethod::Newton, "{line}: {off:e}");
        let found =
            again.equilibrium.tensions().into_iter().chain(again.equilibrium.exit_tensions(&robot, &lengths));
        let worst =
            found.zip(tensions.iter().chain(&exits)).map(|(t, e)| (t / e - 1.0).abs()).fold(0.0, f64::max);
        assert!(worst < 1e-9, "{line}: {worst:e}");
        // The inverse model asks for those very tensions and finds those lengths.
        let pose = solution.equilibrium.pose;
        let held = inverse(&robot, WantedPose::at(&pose).tension_reference(&tensions), &load).unwrap();
        for (i, (found, length)) in held.lengths.iter().zip(&lengths).enumerate() {
            assert!((found - length).abs() < 1e-9 * length, "{line}: length {i} {found} {length}");
        }
        compared += 1;
    }
    println!("{compared} of {}", cases.len());
    assert_eq!(compared, 12);
}

/// CAROCA and CoGiRo with pulleys of this radius [m] and this lead [m].
pub(crate) fn led(robot: Robot, radius: f64, lead: f64) -> Robot {
    let cables = robot.cables.into_iter().map(|cable| RobotCable {
        pulley: Some(Pulley { radius, axis: Vector3::z() }),
        lead,
        ..cable
    });
    Robot { cables: cables.collect(), ..robot }
}

/// The robot with the axis of every pulley tilted in a direction of its own, on a base that is not level.
pub(crate) fn tilted(mut robot: Robot) -> Robot {
    for (i, cable) in robot.cables.iter_mut().enumerate() {
        let angle = i as f64;
        let pulley = cable.pulley.as_mut().unwrap();
        pulley.axis = Vector3::new(0.4 * angle.cos(), 0.4 * angle.sin(), 1.0).normalize();
    }
    Robot { gravity: Vector3::new(0.4, -0.3, -9.79).into(), ..robot }
}

/// The robot in another base frame: everything in space turned by a rotation.
pub(crate) fn turned(robot: &Robot, rotation: &Rotation3<f64>) -> Robot {
    let cables = robot.cables.iter().map(|cable| RobotCable {
        exit_point: rotation * cable.exit_point,
        pulley: cable.pulley.map(|pulley| Pulley { axis: rotation * pulley.axis, ..pulley }),
        ..cable.clone()
    });
    let cables = cables.collect();
    Robot { gravity: (rotation * robot.gravity.vector()).into(), cables, ..robot.clone() }
}

#[test]
fn nothing_depends_on_the_base_frame() {
    let cases = [
        (caroca(), Pose::at(1.2, -0.7, 2.0)),
        (cogiro(), Pose::at(-1.0, 2.0, 2.0)),
        (led(caroca(), 0.045, 3.0), Pose::at(1.2, -0.7, 2.0)),
        (tilted(led(cogiro(), 0.1, 1.0)), Pose::at(-1.0, 2.0, 2.0)),
        (stadium(), Pose::at(-8.0, -4.667, 10.0)),
        (fast(), Pose::at(0.0, 0.0, 140.0)),
    ];
    for (robot, pose) in cases {
        let moment = Vector3::new(3.0, -2.0, 1.0);
        let wrench = Wrench { force: Vector3::new(20.0, 10.0, -5.0), moment };
        let load = Load { payload: 10.0, wrench };
        let expected = deflection(&robot, &pose, &load).unwrap();
        let stiffness = stiffness_at(&robot, pose, &load).unwrap();
        for rotation in [
            Rotation3::from_euler_angles(0.02, -0.03, 0.5),
            Rotation3::from_euler_angles(1.2, 0.3, -2.0),
            Rotation3::from_euler_angles(std::f64::consts::PI, 0.0, 0.0),
        ] {
            let other = turned(&robot, &rotation);
            let at =
                |pose: &Pose| Pose { position: rotation * pose.position, rotation: rotation * pose.rotation };
            let wrench = Wrench { force: rotation * wrench.force, moment: rotation * wrench.moment };
            let load = Load { wrench, ..load };
            let found = deflection(&other, &at(&pose), &load).unwrap();
            for (one, two) in expected.lengths.iter().zip(&found.lengths) {
                assert!((one - two).abs() < 1e-11 * one, "{}: {one} {two}", robot.name);
            }
            for (one, two) in [(&expected.unloaded, &found.unloaded), (&expected.loaded, &found.loaded)] {
                let off = at(&one.equilibrium.pose).motion_to(&two.equilibrium.pose).norm();
                assert!(off < 1e-10 * robot.platform_size(), "{}: {off:e}", robot.name);
            }
            // The stiffness turns with the base.
            let two = stiffness_at(&other, at(&pose), &load).unwrap();
            let mut turn = Matrix6::zeros();
            for block in [0, 3] {
                turn.fixed_view_mut::<3, 3>(block, block).copy_from(rotation.matrix());
            }
            let off = turn.transpose() * two.matrix * turn - stiffness.matrix;
            let off = off.norm() / stiffness.matrix.norm();
            assert!(off < 1e-8, "{}: stiffness {off:e}", robot.name);
        }
    }
}

#[test]
fn pulleys_and_leads_of_caroca_deflect_as_an_independent_program_says() {
    // Deflections under 50 kg [mm], from the same program as the reference.
    let cases = [
        ([0.0, 0.0, 1.75], 0.0, [1.331, 1.631, 2.229]),
        ([0.0, 0.0, 1.75], 0.045, [1.262, 1.542, 2.103]),
        ([3.2, 1.7, 3.0], 0.0, [0.822, 1.164, 1.886]),
        ([3.2, 1.7, 3.0], 0.045, [0.689, 0.955, 1.530]),
    ];
    for ([x, y, z], radius, expected) in cases {
        for (lead, expected) in [0.0, 1.0, 3.0].into_iter().zip(expected) {
            let robot = led(caroca(), radius, lead);
            let found = deflection(&robot, &Pose::at(x, y, z), &Load::payload(50.0)).unwrap();
            let found = 1e3 * found.displacement().norm();
            // Printed to a micrometre, from tensions that differ by a few tenths of a newton.
            assert!(
                (found - expected).abs() < 1e-3,
                "r {radius} m, lead {lead} m: {found} mm, {expected} mm"
            );
        }
    }
}

#[test]
fn a_robot_with_pulleys_is_found_again_from_its_lengths() {
    for (robot, pose) in [(caroca(), Pose::at(1.2, -0.7, 2.0)), (cogiro(), Pose::at(-1.0, 2.0, 2.0))] {
        let robot = led(robot, 0.06, 2.5);
        let held = inverse(&robot, &pose, &Load::none()).unwrap();
        assert!(held.stationarity < 1e-9);
        let start = pose.moved(Vector3::new(0.3, -0.2, 0.1), Vector3::new(0.05, 0.1, -0.1));
        let found = direct(&robot, &held.lengths, &Load::none(), DirectStart::Pose(&start)).unwrap();
        assert!(pose.motion_to(&found.equilibrium.pose).norm() < 1e-11);
    }
}

#[test]
fn no_radius_and_no_lead_change_no_bit() {
    let pose = Pose::at(1.2, -0.7, 2.0);
    let (plain, led) = (caroca(), led(caroca(), 0.0, 0.0));
    let [a, b] = [&plain, &led].map(|robot| deflection(robot, &pose, &Load::payload(50.0)).unwrap());
    assert_eq!(a.displacement(), b.displacement());
    assert_eq!(a.lengths, b.lengths);
}

#[test]
fn an_anchor_point_next_to_the_axis_of_its_pulley_is_refused_by_the_distance() {
    let robot = Robot::from_library("ipanema-3").unwrap();
    let below = robot.cables[0].exit_point - robot.cables[0].anchor_point;
    let error = inverse(&robot, &Pose::at(below.x, below.y, 1.0), &Load::none()).unwrap_err();
    assert_eq!(error.kind(), "cable_at_its_pulley", "{error}");
    let said = error.to_string();
    assert!(
        said.starts_with("cable 1: its anchor point is 0") && said.contains("m from the swivel axis"),
        "{said}"
    );
}
