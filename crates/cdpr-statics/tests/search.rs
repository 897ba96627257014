//! Stability, certificates, many starts and continuation.

use crate::common::{caroca, cogiro};
use cdpr_robot::{Plane, Platform, Pose, Robot, RobotCable, TensionLimits, Vector3, Wrench};
use cdpr_statics::continuation::{LossKind, Setting, follow};
use cdpr_statics::multistart::Starts;
use cdpr_statics::{
    DirectMethod, DirectProblem, DirectSolution, DirectStart, Load, StaticsError, Unstable, direct, inverse,
    rough_pose,
};

/// A platform on six cables in threefold symmetry, drawn up and down at a triangle of radius `radius`, with
/// its centre of mass `height` above it.
fn tripod(radius: f64, height: f64, mass: f64) -> Robot {
    let properties = caroca().cables[0].properties.clone();
    let cable = |i: usize| {
        let around = std::f64::consts::TAU * (i / 2) as f64 / 3.0;
        let up = if i.is_multiple_of(2) { 2.0 } else { -2.0 };
        RobotCable::between(
            Vector3::new(3.0 * around.cos(), 3.0 * around.sin(), up),
            Vector3::new(radius * (around + 0.3 * up).cos(), radius * (around + 0.3 * up).sin(), 0.0),
            properties.clone(),
        )
    };
    Robot {
        platform: Platform::new(mass, Vector3::new(0.0, 0.0, height)),
        tension_limits: TensionLimits { min: 1.0, max: 1e5 },
        cables: (0..6).map(cable).collect(),
        ..caroca()
    }
}

/// Its cables, shortened by a share of their spans at the origin.
fn tightened(robot: &Robot, share: f64) -> Vec<f64> {
    let pose = Pose::at(0.0, 0.0, 0.0);
    (0..robot.cables.len()).map(|i| robot.span(&pose, i).norm() * (1.0 - share)).collect()
}

fn distance(a: &DirectSolution, b: &DirectSolution) -> f64 {
    a.equilibrium.pose.motion_to(&b.equilibrium.pose).norm()
}

#[test]
fn a_platform_standing_on_its_head_is_an_equilibrium_but_not_a_stable_one() {
    let robot = tripod(0.1, 1.0, 300.0);
    let lengths = tightened(&robot, 1e-3);
    let upright = Pose::at(0.0, 0.0, 0.0);
    let head = DirectProblem::new(&robot, &lengths, &Load::none())
        .unwrap()
        .with_unstable(Unstable::Accepted)
        .direct(DirectStart::Pose(&upright))
        .unwrap();
    let axis = |solution: &DirectSolution| solution.equilibrium.pose.rotation * Vector3::z();
    assert!((axis(&head) - Vector3::z()).norm() < 1e-9, "{}", axis(&head));
    assert!(!head.stability.is_stable() && head.stability.least_stiffness() < 0.0);
    // It may fall to either side, and being symmetric equally fast.
    let eigenvalues = head.stability.eigenvalues();
    assert_eq!(eigenvalues.iter().filter(|value| **value < 0.0).count(), 2);
    let [first, second, ..] = eigenvalues[..] else { panic!("six motions") };
    assert!((first - second).abs() < 1e-6 * first.abs());
    // Asked for a stable one, the platform turns over and hangs.
    let hanging = direct(&robot, &lengths, &Load::none(), DirectStart::Pose(&upright)).unwrap();
    assert!(hanging.stability.is_stable() && hanging.report.residual.force < 1e-8);
    assert!(axis(&hanging).z < 0.0);
}

#[test]
fn many_starts_find_the_platform_on_its_head_and_hanging() {
    let robot = tripod(0.1, 1.0, 300.0);
    let lengths = tightened(&robot, 1e-3);
    let starts = Starts { center: Pose::at(0.0, 0.0, 0.0), reach: 0.2, rotation: 1.5, count: 60 };
    let all = DirectProblem::new(&robot, &lengths, &Load::none()).unwrap().equilibria(&starts).unwrap();
    assert_eq!(all.failed, []);
    for found in &all.found {
        assert!(found.solution.report.residual.force < 1e-7, "{:?}", found.solution.report);
    }
    let (stable, unstable): (Vec<_>, Vec<_>) =
        all.found.iter().partition(|found| found.solution.stability.is_stable());
    println!("{} stable, {} unstable equilibria", stable.len(), unstable.len());
    assert!(!stable.is_empty() && !unstable.is_empty());
    // Stable ones first; no equilibrium twice.
    assert_eq!(all.found.iter().position(|found| !found.solution.stability.is_stable()), Some(stable.len()));
    for (i, first) in all.found.iter().enumerate() {
        for second in &all.found[..i] {
            assert!(distance(&first.solution, &second.solution) > 1e-6);
        }
    }
    assert_eq!(
        DirectProblem::new(&robot, &lengths, &Load::none()).unwrap().equilibria(&starts).unwrap(),
        all
    );
}

#[test]
fn starts_of_a_planar_robot_stay_in_its_plane() {
    let mut robot = tripod(0.1, 1.0, 300.0);
    robot.plane = Some(Plane::Xz);
    let lengths = tightened(&robot, 1e-3);
    let starts = Starts { center: Pose::at(0.0, 0.0, 0.0), reach: 0.2, rotation: 1.0, count: 8 };
    let all = DirectProblem::new(&robot, &lengths, &Load::none()).unwrap().equilibria(&starts).unwrap();
    assert!(!all.found.is_empty());
    for found in &all.found {
        let pose = &found.solution.equilibrium.pose;
        assert_eq!(pose.position.y, 0.0);
        assert!((pose.rotation * Vector3::y() - Vector3::y()).norm() < 1e-12);
    }
}

#[test]
fn invalid_starts_are_named() {
    let robot = tripod(0.3, 0.0, 50.0);
    let lengths = tightened(&robot, 1e-3);
    let starts = Starts { center: Pose::at(0.0, 0.0, 0.0), reach: 0.1, rotation: 0.1, count: 0 };
    let text = |starts: Starts| {
        DirectProblem::new(&robot, &lengths, &Load::none())
            .unwrap()
            .equilibria(&starts)
            .unwrap_err()
            .to_string()
    };
    assert_eq!(text(starts), "starts.count is 0: expected one start or more");
    let text = text(Starts { count: 1, reach: f64::NAN, ..starts });
    assert!(text.starts_with("starts.reach is NaN: expected a finite number, zero or more"), "{text}");
}

#[test]
fn a_platform_loaded_on_top_falls_over_and_the_fall_is_reported() {
    // Upright and stable while light; the payload sits a metre above the cables.
    for (aside, kind) in [(0.0, LossKind::Bifurcation), (0.003, LossKind::TurningPoint)] {
        let mut robot = tripod(0.1, 1.0, 5.0);
        robot.platform.center_of_mass.x = aside;
        let lengths = tightened(&robot, 2e-4);
        let setting = |payload| Setting { lengths: lengths.clone(), load: Load::payload(payload) };
        let start = Pose::at(0.0, 0.0, 0.0);
        let (empty, full) = (setting(0.0), setting(3000.0));
        let path = follow(&robot, &empty, &full, DirectStart::Pose(&start)).unwrap();
        let loss = path.lost.unwrap();
        println!(
            "{kind:?}: lost at {:.3} kg, {:.2e} N/m left",
            3000.0 * loss.share,
            loss.before.stability.least_stiffness()
        );
        assert_eq!(loss.kind, kind);
        assert!(loss.share > 0.0 && loss.share < 1.0);
        let stiffness: Vec<f64> =
            path.steps.iter().map(|step| step.solution.stability.least_stiffness()).collect();
        assert!(loss.before.stability.least_stiffness() < 1e-2 * stiffness[0], "{stiffness:?}");
        // It jumps, and far.
        let after = loss.after.unwrap();
        assert!(after.stability.is_stable() && distance(&loss.before, &after) > 0.5);
        // A ten thousandth earlier there is an equilibrium close by, a ten thousandth later none.
        for (share, stays) in [(loss.share - 1e-4, true), (loss.share + 1e-4, false)] {
            let load = Load::payload(3000.0 * share);
            let found = direct(&robot, &lengths, &load, DirectStart::Near(&loss.before.equilibrium)).unwrap();
            assert_eq!(distance(&found, &loss.before) < 0.2, stays, "{share}");
        }
    }
}

#[test]
fn changing_lengths_there_and_back_ends_at_the_same_pose() {
    let robot = caroca();
    let pose = Pose::at(0.5, -0.3, 1.5);
    let wanted = inverse(&robot, &pose, &Load::none()).unwrap();
    let mut wound = wanted.lengths.clone();
    wound[0] -= 0.02;
    wound[5] += 0.3;
    let from = Setting { lengths: wanted.lengths.clone(), load: Load::none() };
    let to = Setting { lengths: wound, load: Load::payload(50.0) };
    let there = follow(&robot, &from, &to, DirectStart::Near(&wanted.equilibrium)).unwrap();
    assert_eq!(there.lost, None);
    let end = &there.steps.last().unwrap().solution;
    assert_eq!((there.steps[0].share, there.steps.last().unwrap().share), (0.0, 1.0));
    assert_eq!(end.report.method, DirectMethod::Continuation);
    assert!(end.report.residual.force < 1e-7, "{:?}", end.report);
    assert!(!end.report.longer_than_chord.is_empty(), "{:?}", end.report);
    let back = follow(&robot, &to, &from, DirectStart::Near(&end.equilibrium)).unwrap();
    assert!(distance(&back.steps.last().unwrap().solution, &there.steps[0].solution) < 1e-9);
}

#[test]
fn cables_half_as_long_as_they_should_be_are_too_short() {
    let robot = caroca();
    let pose = Pose::at(0.0, 0.0, 1.75);
    let lengths: Vec<f64> = (0..8).map(|i| 0.5 * robot.span(&pose, i).norm()).collect();
    let error = direct(&robot, &lengths, &Load::none(), DirectStart::Pose(&pose)).unwrap_err();
    assert_eq!(error.kind(), "cable_overstrained");
    let StaticsError::Overstrained { length, distance, strain, .. } = error else { panic!("{error}") };
    assert!(strain > 0.1 && distance > 1.1 * length);
}

#[test]
fn a_moment_that_no_equilibrium_can_bear_is_said_so() {
    // Hung on loose cables from above, a platform of 50 kg and 0.3 m bears about m g r = 147 N m before it
    // tips over.
    let mut robot = tripod(0.3, 0.0, 50.0);
    robot.cables.iter_mut().for_each(|cable| cable.exit_point.z = 2.0);
    let lengths = tightened(&robot, -0.05);
    let load = |x| Load::wrench(Wrench { force: Vector3::zeros(), moment: Vector3::new(x, 0.0, 0.0) });
    let start = Pose::at(0.0, 0.0, 0.0);
    assert!(direct(&robot, &lengths, &load(10.0), DirectStart::Pose(&start)).unwrap().stability.is_stable());
    let error = direct(&robot, &lengths, &load(1000.0), DirectStart::Pose(&start)).unwrap_err();
    let StaticsError::EquilibriumLost { share, .. } = error else { panic!("{error}") };
    assert!(share > 0.05 && share < 0.5, "{error}");
}

#[test]
fn a_platform_that_nothing_holds_stands_anywhere() {
    let mut robot = tripod(0.3, 0.0, 50.0);
    robot.gravity = (0.0).into();
    let lengths = tightened(&robot, -0.05);
    let error =
        direct(&robot, &lengths, &Load::none(), DirectStart::Pose(&Pose::at(0.0, 0.0, 0.0))).unwrap_err();
    assert_eq!(error.kind(), "indifferent");
    robot.platform.mass = f64::NAN;
    let error =
        direct(&robot, &lengths, &Load::none(), DirectStart::Pose(&Pose::at(0.0, 0.0, 0.0))).unwrap_err();
    assert!(error.to_string().contains("platform.mass is NaN"), "{error}");
}

#[test]
fn a_cable_that_becomes_vertical_on_the_way_is_passed() {
    let mut robot = caroca();
    // The exit point of the first cable right above its anchor point at the start.
    let start = Pose::at(0.3, 0.2, 1.5);
    let above = start.position + robot.cables[0].anchor_point;
    robot.cables[0].exit_point = Vector3::new(above.x, above.y, 3.5);
    for (x, y) in [(0.0, 0.0), (-0.4, 0.3), (0.6, -0.2)] {
        let pose = Pose::at(0.3 + x, 0.2 + y, 1.6);
        let lengths: Vec<f64> = (0..8).map(|i| 1.0005 * robot.span(&pose, i).norm()).collect();
        let found = direct(&robot, &lengths, &Load::none(), DirectStart::Pose(&start)).unwrap();
        assert!(found.report.residual.force < 1e-8 && found.stability.is_stable(), "{:?}", found.report);
    }
}

#[test]
fn a_certificate_bounds_the_distance_of_a_solution_that_is_off() {
    let robot = caroca();
    let pose = Pose::at(1.0, 0.5, 2.0);
    let wanted = inverse(&robot, &pose, &Load::none()).unwrap();
    let load = Load::payload(50.0);
    let exact = direct(&robot, &wanted.lengths, &load, DirectStart::Near(&wanted.equilibrium)).unwrap();
    let proof = DirectProblem::new(&robot, &wanted.lengths, &load).unwrap().certify(&exact).unwrap();
    println!("proved: {proof:?}");
    assert!(proof.position < 1e-12 && proof.rotation < 1e-12 && proof.force < 1e-7);
    let least = exact.stability.least_stiffness();
    assert!(proof.is_stable() && proof.least_stiffness <= least && proof.least_stiffness > 0.9 * least);
    for off in [1e-12, 1e-9, 1e-6, 1e-3] {
        let mut moved = exact.clone();
        let away = off * Vector3::new(0.6, 0.0, -0.8);
        moved.equilibrium.pose = exact.equilibrium.pose.moved(away, away);
        match DirectProblem::new(&robot, &wanted.lengths, &load).unwrap().certify(&moved) {
            Ok(proof) => {
                assert!(proof.position > 0.99 * off && proof.rotation > 0.99 * off, "{off}: {proof:?}");
            }
            Err(error) => assert!(error.kind() == "not_certified" && off > 1e-8, "{off}: {error}"),
        }
    }
}

#[test]
fn what_cannot_be_proved_says_why() {
    // A cable that hangs exactly vertical: its plane has no direction.
    let mut robot = tripod(0.3, -0.5, 50.0);
    for i in 0..6 {
        let cable = &mut robot.cables[i];
        let radius = [0.3, 0.5][i % 2];
        cable.anchor_point *= radius / 0.3;
        cable.exit_point = cable.anchor_point + Vector3::new(0.0, 0.0, 2.0);
    }
    let lengths = vec![2.0; 6];
    let found = direct(&robot, &lengths, &Load::none(), DirectStart::Pose(&Pose::at(0.0, 0.0, 0.0)));
    let error =
        DirectProblem::new(&robot, &lengths, &Load::none()).unwrap().certify(&found.unwrap()).unwrap_err();
    assert!(error.to_string().starts_with("not certified: a cable hangs vertically or folded"), "{error}");
}

#[test]
fn winding_all_cables_in_ends_where_they_are_strained_and_keeps_what_was_found() {
    let robot = caroca();
    let pose = Pose::at(0.0, 0.0, 1.75);
    let wanted = inverse(&robot, &pose, &Load::none()).unwrap();
    let from = Setting { lengths: wanted.lengths.clone(), load: Load::none() };
    let to = Setting { lengths: wanted.lengths.iter().map(|length| 0.8 * length).collect(), ..from.clone() };
    let path = follow(&robot, &from, &to, DirectStart::Near(&wanted.equilibrium)).unwrap();
    let loss = path.lost.unwrap();
    assert_eq!((loss.kind, loss.after.unwrap_err().kind()), (LossKind::Overstrained, "cable_overstrained"));
    // Every equilibrium that was kept is strained by less than 10 %.
    assert_eq!(path.steps.last().unwrap().share, loss.share);
    assert!(path.steps.len() > 2 && loss.share > 0.0 && loss.share < 1.0);
    let stiffness = robot.cables[0].properties.axial_stiffness();
    for step in &path.steps {
        let largest = step.solution.equilibrium.tensions().into_iter().fold(0.0, f64::max);
        assert!(largest < 0.1 * stiffness, "{largest} N at {}", step.share);
    }
}

#[test]
fn lengths_alone_tell_where_to_start_from() {
    let cogiro = cogiro();
    let mut held = 0;
    for k in 0..200 {
        // Places and turns that fill the region evenly.
        let draw = |irrational: f64| 2.0 * (f64::from(k) * irrational).fract() - 1.0;
        let wanted = Pose::at(6.0 * draw(0.618), 4.0 * draw(0.755), 2.0 + 1.3 * draw(0.57));
        let wanted = wanted
            .moved(Vector3::zeros(), Vector3::new(0.15 * draw(0.31), 0.15 * draw(0.77), 0.3 * draw(0.19)));
        let Ok(wound) = inverse(&cogiro, &wanted, &Load::none()) else { continue };
        let start = rough_pose(&cogiro, &wound.lengths);
        let found = direct(&cogiro, &wound.lengths, &Load::none(), DirectStart::Pose(&start)).unwrap();
        assert!(found.equilibrium.pose.motion_to(&wanted).norm() < 1e-8, "{wanted:?} from {start:?}");
        held += 1;
    }
    assert!(held > 150, "{held}");
}
