//! Inverse, direct and linearized model against each other and against what mechanics demands.

use crate::common::{caroca, ring};
use cdpr_evidence::accept;
use cdpr_robot::{Platform, Pose, Robot, TensionLimits, Vector3, Wrench};
use cdpr_statics::{
    DirectProblem, DirectStart, Equilibrium, Load, PoseLengths, StaticsError, WantedPose, deflection,
    derivatives, direct, inverse, lengths_for_tensions,
};

/// A suspended robot with a heavy drum on `n` cables.
pub(crate) fn drum(n: usize, jitter: &[f64], mass: f64) -> Robot {
    let mut jitter = jitter.iter().copied();
    Robot {
        platform: Platform::new(mass, Vector3::new(0.02, -0.01, -0.05)),
        tension_limits: TensionLimits { min: 1.0, max: 1e5 },
        cables: ring(n, || jitter.next().unwrap()),
        ..caroca()
    }
}

pub(crate) fn moment(x: f64, y: f64, z: f64) -> Wrench {
    Wrench { force: Vector3::zeros(), moment: Vector3::new(x, y, z) }
}

#[test]
fn nominal_deflections_of_caroca() {
    let robot = caroca();
    let magnitude = |pose: Pose| 1e3 * deflection(&robot, &pose, &Load::payload(50.0)).unwrap().magnitude();
    accept("V-DIRECT-012", (magnitude(Pose::at(0.0, 0.0, 1.75)) - 1.331_244_9).abs());
    accept("V-DIRECT-012", (magnitude(Pose::at(3.2, 1.7, 3.0)) - 0.821_858_8).abs());
}

#[test]
fn a_symmetric_platform_sinks_straight_down_and_opposite_cables_share_the_load() {
    let robot = caroca();
    let found = deflection(&robot, &Pose::at(0.0, 0.0, 1.75), &Load::payload(50.0)).unwrap();
    let dp = found.displacement();
    assert!(dp.z < 0.0 && dp.xy().norm() < 1e-12);
    for tensions in [found.unloaded.equilibrium.tensions(), found.loaded.equilibrium.tensions()] {
        // Half a turn about the vertical takes cable 1 to 8, 2 to 7, 3 to 6 and 4 to 5.
        assert!((0..4).all(|i| (tensions[i] - tensions[7 - i]).abs() < 1e-8), "{tensions:?}");
    }
}

#[test]
fn the_stiffness_at_the_unloaded_pose_predicts_more_than_the_deflection() {
    let robot = caroca();
    // The load tightens the cables, which then sag less and give less.
    for (pose, expected) in [(Pose::at(0.0, 0.0, 1.75), 1.33640), (Pose::at(3.2, 1.7, 3.0), 0.85871)] {
        let load = Load::payload(50.0);
        let exact = deflection(&robot, &pose, &load).unwrap();
        let small = exact.small_displacement(&robot, &load).unwrap();
        println!(
            "{:?}: exact {:.5} mm, small {:.5} mm",
            pose.position,
            1e3 * exact.magnitude(),
            1e3 * small.norm()
        );
        assert!(small.norm() > exact.magnitude());
        assert!((1e3 * small.norm() - expected).abs() < 1e-5);
        // For a small load both agree.
        let gram = Load::payload(1e-3);
        let exact = deflection(&robot, &pose, &gram).unwrap();
        let small = exact.small_displacement(&robot, &gram).unwrap();
        assert!((small - exact.displacement()).norm() < 1e-4 * exact.magnitude());
    }
}

#[test]
fn one_bad_pose_of_many_spoils_no_other() {
    let robot = caroca();
    let poses = vec![Pose::at(0.0, 0.0, 1.75), Pose::at(0.0, 0.0, 9.0), Pose::at(1.0, 0.5, 2.0)];
    for load in [Load::none(), Load::payload(50.0), Load::wrench(moment(10.0, 0.0, 5.0))] {
        let found = deflection(&robot, &poses, &load);
        let slopes = derivatives(&robot, &poses, &load);
        for (j, pose) in poses.iter().enumerate() {
            assert_eq!(found[j], deflection(&robot, pose, &load));
            assert_eq!(slopes[j], derivatives(&robot, pose, &load));
        }
        assert!(matches!(&found[1], Err(error) if error.kind() == "infeasible_tension"));
        assert!(found[0].is_ok() && found[2].is_ok());
    }
    assert!(deflection(&robot, &poses, &Load::none())[0].as_ref().unwrap().magnitude() < 1e-12);
}

#[test]
fn a_pose_above_the_frame_is_refused_with_what_stays_open() {
    let error = inverse(&caroca(), &Pose::at(0.0, 0.0, 5.0), &Load::none()).unwrap_err();
    let text = error.to_string();
    assert!(
        text.starts_with(
            "at position (0, 0, 5) m: no tensions between 1 N and 10290 N balance the wrench: the best"
        ),
        "{text}"
    );
}

#[test]
fn invalid_inputs_are_named() {
    let robot = caroca();
    let pose = Pose::at(0.0, 0.0, 1.75);
    let lengths = inverse(&robot, &pose, &Load::none()).unwrap().lengths;
    let text = |result: Result<_, StaticsError>| result.unwrap_err().to_string();
    let solve = |lengths: &[f64], load: &Load, start: &Pose| {
        direct(&robot, lengths, load, DirectStart::Pose(start)).map(|_| ())
    };
    assert_eq!(
        text(solve(&lengths[..7], &Load::none(), &pose)),
        "lengths is a list of 7: expected one value for each of the 8 cables"
    );
    let mut negative = lengths.clone();
    negative[2] = -1.0;
    assert_eq!(
        text(solve(&negative, &Load::none(), &pose)),
        "lengths[2] is -1: expected a finite, positive unstrained length [m]"
    );
    assert_eq!(
        text(solve(&lengths, &Load::payload(f64::NAN), &pose)),
        "load.payload is NaN: expected a mass from -1e12 to 1e12 kg"
    );
    assert!(text(solve(&lengths, &Load::none(), &Pose::at(f64::NAN, 0.0, 0.0))).starts_with("start is [NaN"));
}

#[test]
fn a_tension_below_what_the_span_demands_is_raised_to_it() {
    let robot = caroca();
    let pose = Pose::at(3.2, 1.7, 3.0);
    let PoseLengths { lengths, equilibrium } = lengths_for_tensions(&robot, &pose, &[1.0; 8]).unwrap();
    assert!(equilibrium.tensions()[0] > 4.0 && equilibrium.tensions()[0] < 6.0);
    // There is no less: paying out more cable raises the tension again.
    let mut longer = lengths;
    longer[0] *= 1.05;
    let span = robot.span(&pose, 0);
    let end = cdpr_robot::Vector2::new(span.xy().norm(), span.z);
    let more = cdpr_cable::end_force(&robot.cable(0), longer[0], end).unwrap().catenary;
    assert!(more.anchor_tension() > equilibrium.tensions()[0]);
}

#[test]
fn poses_are_held_where_a_cable_carries_less_than_its_own_weight_or_rests_on_a_limit() {
    let mut robot = caroca();
    let (mut hang_loosely, mut at_bound) = (0, 0);
    for (i, min) in (0..300).flat_map(|i| [1.0, 250.0].map(|min| (i, min))) {
        robot.tension_limits.min = min;
        let share = |k: usize| (i * k % 300) as f64 / 300.0;
        let pose = Pose::at(6.4 * share(1) - 3.2, 3.4 * share(7) - 1.7, 0.3 + 2.7 * share(53));
        let wanted = match inverse(&robot, &pose, &Load::none()) {
            Ok(wanted) => wanted,
            Err(error) => {
                assert_eq!(error.kind(), "infeasible_tension", "{error}");
                continue;
            }
        };
        let mut cables = wanted.tensions.iter().zip(&wanted.lengths).enumerate();
        let loose = |(i, (t, length)): (usize, (&f64, &f64))| *t < robot.cable(i).weight_per_length * length;
        hang_loosely += usize::from(cables.any(loose));
        at_bound += usize::from(wanted.active.iter().any(Option::is_some));
        assert!(wanted.residual.force < 1e-7, "{:?}", wanted.residual);
        let found =
            direct(&robot, &wanted.lengths, &Load::none(), DirectStart::Near(&wanted.equilibrium)).unwrap();
        assert!(pose.motion_to(&found.equilibrium.pose).norm() < 1e-8);
    }
    assert!(hang_loosely > 0 && at_bound > 10, "{hang_loosely} {at_bound}");
}

#[test]
fn a_cable_that_carries_many_times_its_weight_is_not_slack_however_long_it_is() {
    // A camera over a stadium: 12 mm Dyneema, 0.078 kg/m, 40 kg.
    let exits = [[45.0, 30.0], [-45.0, 30.0], [-45.0, -30.0], [45.0, -30.0]];
    let cables =
        exits.map(|[x, y]| format!("{{\"exit_point\": [{x}, {y}, 25], \"anchor_point\": [0, 0, 0]}}"));
    let robot = Robot::from_json(&format!(
        "{{\"format\": \"cdpr-robot/1\", \"name\": \"camera\", \"gravity\": 9.81, \
          \"platform\": {{\"mass\": 40, \"center_of_mass\": [0, 0, 0], \"point\": true}}, \
          \"cable\": {{\"diameter\": 0.012, \"linear_density\": 0.078, \"youngs_modulus\": 38e9}}, \
          \"tension_limits\": {{\"min\": 10, \"max\": 20000}}, \"cables\": [{}]}}",
        cables.join(", ")
    ));
    let robot = robot.unwrap();
    let wanted = inverse(&robot, &Pose::at(0.0, 0.0, 14.0), &Load::none()).unwrap();
    let found =
        direct(&robot, &wanted.lengths, &Load::none(), DirectStart::Near(&wanted.equilibrium)).unwrap();
    println!("tensions {:?}", wanted.tensions);
    assert_eq!(found.report.longer_than_chord, [0, 1, 2, 3]);
    assert!(found.report.slack.is_empty(), "{:?}", found.report);
    // Fifteen metres more of one of them let it hang.
    let mut lengths = wanted.lengths.clone();
    lengths[0] += 15.0;
    let found = direct(&robot, &lengths, &Load::none(), DirectStart::Near(&wanted.equilibrium)).unwrap();
    assert_eq!(found.report.slack, [0], "{:?}", found.equilibrium.tensions());
}

#[test]
fn a_slack_cable_without_weight_is_the_limit_of_a_light_one() {
    let solve = |density: f64| {
        let mut robot = caroca();
        robot.cables.iter_mut().for_each(|cable| cable.properties.linear_density = density);
        let wanted = inverse(&robot, &Pose::at(0.0, 0.0, 1.75), &Load::none()).unwrap();
        let mut lengths = wanted.lengths;
        lengths[0] *= 1.05;
        let found = direct(&robot, &lengths, &Load::none(), DirectStart::Near(&wanted.equilibrium)).unwrap();
        assert!(found.report.slack.contains(&0));
        let linearization = DirectProblem::new(&robot, &lengths, &Load::none())
            .unwrap()
            .linearize(&found.equilibrium)
            .unwrap();
        (found.equilibrium.pose, linearization.displacement(&moment(1.0, 0.0, 0.0)))
    };
    let (pose, turn) = solve(0.0);
    for density in [1e-6, 1e-9, 1e-12] {
        let (near, near_turn) = solve(density);
        assert!(pose.motion_to(&near).norm() < 1e-7 + 10.0 * density, "{density}");
        assert!((turn - near_turn).norm() < 1e-3 * turn.norm());
    }
}

#[test]
fn a_greatest_tension_below_what_a_cable_weighs_is_refused() {
    let mut robot = caroca();
    robot.tension_limits = TensionLimits { min: 0.5, max: 4.5 };
    robot.platform.mass = 0.55;
    let error = inverse(&robot, &Pose::at(3.2, 1.7, 3.0), &Load::none()).unwrap_err();
    assert!(error.kind() == "tension_too_small", "{error}");
}

#[test]
fn an_offset_that_is_no_number_is_named() {
    let mut offsets = [0.0; 8];
    offsets[2] = f64::NAN;
    let error = deflection(
        &caroca(),
        WantedPose::at(&Pose::at(0.0, 0.0, 1.75)).tension_offsets(&offsets),
        &Load::payload(50.0),
    )
    .unwrap_err();
    assert_eq!(error.to_string(), "tension_offsets[2] is NaN: expected a finite offset [N]");
}

#[test]
fn the_start_is_not_returned_as_an_answer() {
    let robot = caroca();
    let lengths = inverse(&robot, &Pose::at(0.0, 0.0, 1.75), &Load::none()).unwrap().lengths;
    let start = Pose::at(1.0, 0.7, 0.9).moved(Vector3::zeros(), Vector3::new(0.2, 0.1, -0.2));
    let found = direct(&robot, &lengths, &Load::none(), DirectStart::Pose(&start)).unwrap();
    assert!(start.motion_to(&found.equilibrium.pose).norm() > 0.5);
    assert!(found.report.residual.force < 1e-8);
}

#[test]
fn forces_that_do_not_fit_the_robot_are_refused_as_a_start() {
    let robot = caroca();
    let wanted = inverse(&robot, &Pose::at(0.0, 0.0, 1.75), &Load::none()).unwrap();
    let short = Equilibrium { pose: wanted.equilibrium.pose, cable_forces: Vec::new() };
    let error = direct(&robot, &wanted.lengths, &Load::none(), DirectStart::Near(&short)).unwrap_err();
    assert_eq!(
        error.to_string(),
        "start.cable_forces is a list of 0: expected one force for each of the 8 cables"
    );
}
