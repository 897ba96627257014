//! One solve after the other: the answers of the direct model, without allocation.

use crate::common::{caroca, ring, suspended};
use cdpr_robot::{Coordinate, Pose, Robot, Rotation3, Vector3, Wrench};
use cdpr_statics::{DirectStart, Load, StaticsError, Tracker, WantedPose, direct, inverse};
use std::f64::consts::PI;
use std::hint::black_box;
use std::sync::Arc;

/// Lengths along a path through the workspace, with loads that come and go.
fn path(robot: &Robot, steps: usize) -> Vec<(Vec<f64>, Load)> {
    (0..steps)
        .map(|k| {
            let s = k as f64 / steps as f64;
            let turn = 0.1 * (6.0 * s).sin() * Vector3::new(0.3, 0.5, 1.0);
            let pose = Pose::at(2.0 * s - 1.0, 0.8 * (5.0 * s).sin(), 1.5 + s).moved(Vector3::zeros(), turn);
            let lengths = inverse(robot, &pose, &Load::none()).unwrap().lengths;
            let mut load = Load::payload(if k % 50 < 25 { 0.0 } else { 50.0 });
            load.wrench.force = Vector3::new(20.0 * (40.0 * s).sin(), 0.0, 0.0);
            (lengths, load)
        })
        .collect()
}

#[test]
fn a_path_is_that_of_the_direct_model() {
    let robot = caroca();
    let path = path(&robot, 500);
    let start = inverse(&robot, &Pose::at(-1.0, 0.0, 1.5), &Load::none()).unwrap().equilibrium;
    let mut tracker = Tracker::new(&robot, &path[0].0, &path[0].1, &start).unwrap();
    for (lengths, load) in &path {
        let before = tracker.equilibrium().clone();
        let expected = direct(&robot, lengths, load, DirectStart::Near(&before)).unwrap().equilibrium;
        let found = tracker.update(lengths, load).unwrap();
        let motion = found.pose.motion_to(&expected.pose);
        assert!(motion.norm() < 1e-12, "{motion}");
        for (found, expected) in found.cable_forces.iter().zip(&expected.cable_forces) {
            assert!((found - expected).norm() < 1e-6);
        }
        let rotation = found.pose.rotation.matrix();
        assert!((rotation.transpose() * rotation).map_diagonal(|d| d - 1.0).norm() < 1e-15);
        let residual = tracker.residual();
        assert!(residual.closure < 3e-12 && residual.force < 1e-8 && residual.moment < 1e-8, "{residual:?}");
    }
}

#[test]
fn nothing_is_allocated_on_the_way() {
    let robot = caroca();
    let path = path(&robot, 200);
    let start = inverse(&robot, &Pose::at(-1.0, 0.0, 1.5), &Load::none()).unwrap().equilibrium;
    let mut tracker = Tracker::new(&robot, &path[0].0, &path[0].1, &start).unwrap();
    let allocated = allocation_counter::measure(|| {
        for (lengths, load) in &path {
            assert!(tracker.update(lengths, load).is_ok());
        }
    });
    assert_eq!(allocated.count_total, 0);
    assert!(allocation_counter::measure(|| drop(black_box(tracker.equilibrium().clone()))).count_total > 0);
}

#[test]
fn any_number_of_cables_fills_the_lanes() {
    for n in 6..=16 {
        let robot = Robot { cables: ring(n, || 0.0), ..caroca() };
        let pose = Pose::at(0.1, 0.2, 1.5);
        let lengths: Vec<f64> = (0..n).map(|i| 0.9999 * robot.span(&pose, i).norm()).collect();
        let wound: Vec<f64> = lengths.iter().enumerate().map(|(i, l)| l + 2e-4 * (i as f64).sin()).collect();
        let start = direct(&robot, &lengths, &Load::none(), DirectStart::Pose(&pose)).unwrap().equilibrium;
        let expected = direct(&robot, &wound, &Load::none(), DirectStart::Near(&start)).unwrap().equilibrium;
        let mut tracker = Tracker::new(&robot, &lengths, &Load::none(), &start).unwrap();
        let allocated = allocation_counter::measure(|| {
            assert!(tracker.update(&wound, &Load::none()).is_ok());
        });
        let found = tracker.equilibrium();
        assert!(found.pose.motion_to(&expected.pose).norm() < 1e-12, "{n} cables");
        for (found, expected) in found.cable_forces.iter().zip(&expected.cable_forces) {
            assert!((found - expected).norm() < 1e-6, "{n} cables");
        }
        assert_eq!(allocated.count_total, 0, "{n} cables");
    }
}

#[test]
fn slack_cables_and_moments_are_those_of_the_direct_model() {
    let robot = caroca();
    let wanted = inverse(&robot, &Pose::at(0.4, -0.3, 1.75), &Load::none()).unwrap();
    let mut tracker = Tracker::new(&robot, &wanted.lengths, &Load::none(), &wanted.equilibrium).unwrap();
    let mut slack = wanted.lengths.clone();
    slack[1] += 0.05;
    let mut moment = Load::payload(20.0);
    moment.wrench.moment = Vector3::new(5.0, -3.0, 2.0);
    for (lengths, load) in
        [(&slack, Load::none()), (&slack, moment), (&wanted.lengths, moment), (&wanted.lengths, Load::none())]
    {
        let before = tracker.equilibrium().clone();
        let expected = direct(&robot, lengths, &load, DirectStart::Near(&before)).unwrap().equilibrium.pose;
        let found = tracker.update(lengths, &load).unwrap().pose;
        assert!(found.motion_to(&expected).norm() < 1e-11);
    }
    assert!((tracker.equilibrium().pose.position - wanted.equilibrium.pose.position).norm() < 1e-11);
}

#[test]
fn what_is_no_input_leaves_the_equilibrium_at_hand() {
    let robot = caroca();
    let wanted = inverse(&robot, &Pose::at(0.0, 0.0, 1.75), &Load::none()).unwrap();
    let mut tracker = Tracker::new(&robot, &wanted.lengths, &Load::none(), &wanted.equilibrium).unwrap();
    let before = tracker.equilibrium().clone();
    let mut lengths = wanted.lengths.clone();
    lengths[3] = f64::NAN;
    match tracker.update(&lengths, &Load::none()) {
        Err(StaticsError::Invalid { field, .. }) => assert_eq!(field, "lengths[3]"),
        outcome => panic!("{outcome:?}"),
    }
    assert!(tracker.update(&wanted.lengths[..7], &Load::none()).is_err());
    // Too short by a metre all around: overstrained.
    let short: Vec<f64> = wanted.lengths.iter().map(|length| length - 1.0).collect();
    assert!(matches!(tracker.update(&short, &Load::none()), Err(StaticsError::Overstrained { .. })));
    assert_eq!(tracker.equilibrium(), &before);
    assert!(tracker.update(&wanted.lengths, &Load::none()).is_ok());
}

#[test]
fn a_platform_that_falls_is_an_error_and_not_a_step() {
    let robot = suspended();
    let [roll, pitch, yaw] = [3.0, -4.0, 6.0].map(f64::to_radians);
    let rotation = Rotation3::from_euler_angles(roll, pitch, yaw);
    let pose = Pose { position: Vector3::new(0.6, -0.4, 1.6), rotation };
    let under = |s: f64| Load {
        payload: 2.0 * s,
        wrench: Wrench { force: Vector3::zeros(), moment: s * Vector3::new(400.0, -300.0, 100.0) },
    };
    let wanted = inverse(&robot, &pose, &Load::none()).unwrap();
    let mut tracker = Tracker::new(&robot, &wanted.lengths, &Load::none(), &wanted.equilibrium).unwrap();
    for s in [0.3, 0.6, 0.9] {
        tracker.update(&wanted.lengths, &under(s)).unwrap();
    }
    let before = tracker.equilibrium().clone();
    for s in [0.93, 1.0, 1.5] {
        match tracker.update(&wanted.lengths, &under(s)) {
            Err(StaticsError::BranchEnds(end)) => {
                assert!((0.9 + end.share * (s - 0.9) - 0.9225).abs() < 0.0025, "{end}");
                assert!(end.falls_to.is_ok(), "{end}");
            }
            other => panic!("at {s}: {other:?}"),
        }
        assert_eq!(tracker.equilibrium(), &before);
    }
    tracker.update(&wanted.lengths, &under(0.92)).unwrap();
}

#[test]
fn a_step_has_the_digits_of_an_update_and_a_bounded_number_of_iterations() {
    let robot = caroca();
    let path = path(&robot, 200);
    let start = inverse(&robot, &Pose::at(-1.0, 0.0, 1.5), &Load::none()).unwrap().equilibrium;
    // The one borrows its robot, the other owns it.
    let mut updated = Tracker::new(&robot, &path[0].0, &path[0].1, &start).unwrap();
    let mut stepped = Tracker::new(Arc::new(robot.clone()), &path[0].0, &path[0].1, &start).unwrap();
    assert!(stepped.takes_steps());
    for (lengths, load) in &path {
        let mut step = None;
        let allocated = allocation_counter::measure(|| step = stepped.step(lengths, load).ok());
        let step = step.unwrap();
        assert!(step.converged && (1..=12).contains(&step.iterations), "{step:?}");
        assert_eq!(allocated.count_total, 0);
        assert_eq!(updated.update(lengths, load).unwrap(), stepped.equilibrium());
        assert_eq!(updated.residual(), stepped.residual());
    }
}

#[test]
fn a_step_that_does_not_converge_keeps_the_last_equilibrium() {
    let robot = caroca();
    let wanted = inverse(&robot, &Pose::at(0.0, 0.0, 1.75), &Load::none()).unwrap();
    let mut tracker = Tracker::new(&robot, &wanted.lengths, &Load::none(), &wanted.equilibrium).unwrap();
    let (before, residual) = (tracker.equilibrium().clone(), tracker.residual());
    // Too short by a metre all around.
    let short: Vec<f64> = wanted.lengths.iter().map(|length| length - 1.0).collect();
    let mut step = None;
    let allocated = allocation_counter::measure(|| step = tracker.step(&short, &Load::none()).ok());
    let step = step.unwrap();
    assert!(!step.converged && step.iterations <= 12, "{step:?}");
    assert_eq!((allocated.count_total, tracker.equilibrium(), tracker.residual()), (0, &before, residual));
    // The next step starts from it.
    let mut next = wanted.lengths.clone();
    next[0] -= 1e-3;
    assert!(tracker.step(&next, &Load::none()).unwrap().converged);
    assert_ne!(tracker.equilibrium(), &before);
    next[3] = f64::NAN;
    assert!(matches!(tracker.step(&next, &Load::none()), Err(StaticsError::Invalid { .. })));
}

#[test]
fn a_step_does_not_fall_to_another_equilibrium() {
    let robot = suspended();
    let [roll, pitch, yaw] = [3.0, -4.0, 6.0].map(f64::to_radians);
    let rotation = Rotation3::from_euler_angles(roll, pitch, yaw);
    let pose = Pose { position: Vector3::new(0.6, -0.4, 1.6), rotation };
    let wanted = inverse(&robot, &pose, &Load::none()).unwrap();
    let mut tracker = Tracker::new(&robot, &wanted.lengths, &Load::none(), &wanted.equilibrium).unwrap();
    let moment = 1.5 * Vector3::new(400.0, -300.0, 100.0);
    let load = Load { payload: 3.0, wrench: Wrench { force: Vector3::zeros(), moment } };
    // `update` says that the platform falls under this load.
    assert!(!tracker.step(&wanted.lengths, &load).unwrap().converged);
    assert!(matches!(tracker.update(&wanted.lengths, &load), Err(StaticsError::BranchEnds(_))));
}

/// Lengths that all change a little, and a load that grows, along 200 steps.
fn steps_from(lengths: &[f64]) -> impl Iterator<Item = (Vec<f64>, Load)> {
    (1..=200).map(|k| {
        let s = f64::from(k) / 200.0;
        let change = |(i, length): (usize, &f64)| length * (1.0 - 1e-3 * s * (1.0 + 0.2 * (i as f64).sin()));
        (lengths.iter().enumerate().map(change).collect(), Load::payload(5.0 * s))
    })
}

#[test]
fn guided_and_few_cables_are_stepped_without_allocation() {
    for (name, [x, y, z]) in [
        ("ipanema-3", [-0.25, 0.17, 1.33]),
        ("hrpcables", [-0.03, 0.01, 0.72]),
        ("expo2015-lucia", [-0.53, -0.02, 5.43]),
        ("four-cables", [0.5, 0.3, 2.0]),
        ("grab", [1.29, -0.11, 0.0]),
        ("irma4u", [0.11, 0.06, 1.31]),
    ] {
        let robot = Robot::from_library(name).unwrap();
        let pose = Pose::at(x, y, z);
        let lengths = match inverse(&robot, &pose, &Load::none()) {
            Ok(held) => held.lengths,
            // Few cables: lengths of straight ones, near which the platform hangs.
            Err(_) => (0..robot.cables.len()).map(|i| robot.span(&pose, i).norm()).collect(),
        };
        let start = direct(&robot, &lengths, &Load::none(), DirectStart::Pose(&pose)).unwrap().equilibrium;
        let mut tracker = Tracker::new(&robot, &lengths, &Load::none(), &start).unwrap();
        assert!(tracker.takes_steps(), "{name}");
        for (lengths, load) in steps_from(&lengths) {
            let before = tracker.equilibrium().clone();
            let mut step = None;
            let allocated = allocation_counter::measure(|| step = tracker.step(&lengths, &load).ok());
            assert!(step.unwrap().converged, "{name}: {step:?}");
            assert_eq!(allocated.count_total, 0, "{name}");
            let expected = direct(&robot, &lengths, &load, DirectStart::Near(&before)).unwrap().equilibrium;
            let motion = tracker.equilibrium().pose.motion_to(&expected.pose);
            assert!(motion.norm() < 1e-10, "{name}: {motion}");
        }
    }
}

#[test]
fn stiff_cables_without_weight_are_stepped_slack_ones_too() {
    // A step of the lengths is one of hundreds of newtons until the platform follows it.
    let robot = Robot::from_library("grab").unwrap();
    assert!(robot.cables.iter().all(|cable| cable.properties.linear_density == 0.0));
    let held = |x: f64, y: f64| {
        let free = &[Coordinate::Roll, Coordinate::Pitch, Coordinate::Yaw][..2];
        inverse(&robot, WantedPose { free, ..Pose::at(x, y, 0.0).into() }, &Load::none()).unwrap()
    };
    let (from, to) = (held(1.29, -0.11), held(1.24, -0.05));
    let mut tracker = Tracker::new(&robot, &from.lengths, &Load::none(), &from.equilibrium).unwrap();
    let (mut searched, mut slack) = (0, 0);
    for k in 1..=1000 {
        let s = f64::from(k) / 1000.0;
        let mut lengths: Vec<f64> =
            from.lengths.iter().zip(&to.lengths).map(|(a, b)| a + s * (b - a)).collect();
        // Paid out and taken in again.
        lengths[3] += 0.3 * (PI * s).sin().powi(2);
        let step = tracker.step(&lengths, &Load::none()).unwrap();
        if step.converged {
            assert!(step.iterations <= 6, "{k}: {step:?}");
        } else {
            searched += 1;
            tracker.update(&lengths, &Load::none()).unwrap();
        }
        let residual = tracker.residual();
        assert!(residual.closure < 1e-12 && residual.force < 1e-8, "{k}: {residual:?}");
        slack += usize::from(tracker.equilibrium().cable_forces[3].norm() == 0.0);
        let longer =
            direct(&robot, &lengths, &Load::none(), DirectStart::Near(tracker.equilibrium())).unwrap();
        let motion = tracker.equilibrium().pose.motion_to(&longer.equilibrium.pose);
        assert!(motion.norm() < 1e-9, "{k}: {motion}");
    }
    // When the cable becomes slack, and when it is taut again.
    assert!(searched <= 4 && slack > 500, "{searched} searches, {slack} steps with a slack cable");
}

#[test]
fn a_motion_that_nothing_resists_is_not_stepped() {
    let mut robot = caroca();
    robot.cables.truncate(1);
    let exit = robot.cables[0].exit_point;
    let pose = Pose::at(exit.x, exit.y, exit.z - 2.0);
    let start = direct(&robot, &[1.5], &Load::none(), DirectStart::Pose(&pose)).unwrap().equilibrium;
    let mut tracker = Tracker::new(&robot, &[1.5], &Load::none(), &start).unwrap();
    assert!(!tracker.takes_steps());
    match tracker.step(&[1.5], &Load::none()) {
        Err(StaticsError::Invalid { field, .. }) => assert_eq!(field, "robot"),
        outcome => panic!("{outcome:?}"),
    }
    assert!(tracker.update(&[1.5], &Load::none()).is_ok());
}
