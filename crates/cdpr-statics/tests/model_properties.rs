//! The models keep what holds of any robot: inverses, symmetries, derivatives.

use crate::common::{caroca, cogiro};
use crate::models::drum;
use cdpr_robot::{Pose, Rotation3, Vector3, Wrench};
use cdpr_statics::{DirectMethod, DirectProblem, DirectStart, Load, deflection, direct, inverse};
use proptest::prelude::*;

fn assert_same_pose(a: &Pose, b: &Pose, meters: f64, radians: f64) -> Result<(), TestCaseError> {
    let motion = a.motion_to(b);
    let (position, angle) = (motion.fixed_rows::<3>(0).norm(), motion.fixed_rows::<3>(3).norm());
    prop_assert!(position < meters && angle < radians, "{position:e} m, {angle:e} rad");
    Ok(())
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 300, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn the_direct_model_is_the_inverse_of_the_inverse_model(
        x in -0.8..0.8f64, y in -0.8..0.8f64, z in 0.1..0.8f64, turn in prop::array::uniform3(-0.1..0.1f64),
        away in prop::array::uniform6(-0.02..0.02f64), payload in 0.0..50.0f64, which in any::<bool>(),
    ) {
        let robot = if which { caroca() } else { cogiro() };
        let top = robot.cables[0].exit_point;
        let pose = Pose::at(x * top.x, y * top.y, z * top.z).moved(Vector3::zeros(), turn.into());
        let load = Load::payload(payload);
        let wanted = inverse(&robot, &pose, &load);
        prop_assume!(wanted.is_ok());
        let wanted = wanted.unwrap();
        let forces = wanted.tensions.iter().sum::<f64>();
        prop_assert!(wanted.residual.force < 1e-11 * forces, "{:?}", wanted.residual);
        prop_assert!(wanted.residual.closure < 1e-13 * top.norm(), "{:?}", wanted.residual);
        let start = pose.moved(
            Vector3::new(away[0], away[1], away[2]), Vector3::new(away[3], away[4], away[5]));
        for start in [DirectStart::Near(&wanted.equilibrium), DirectStart::Pose(&start)] {
            let found = direct(&robot, &wanted.lengths, &load, start).unwrap();
            // A cable that is longer than its chord lets several equilibria exist side by side.
            if matches!(start, DirectStart::Near(_)) || found.report.longer_than_chord.is_empty() {
                assert_same_pose(&found.equilibrium.pose, &pose, 1e-9, 1e-9)?;
            }
        }
    }

    #[test]
    fn every_number_of_cables_from_6_to_16_finds_its_balance(
        n in 6..=16usize, jitter in prop::collection::vec(-0.5..0.5f64, 48), mass in 5.0..500.0f64,
        slack in prop::collection::vec(-5e-4..2e-2f64, 16), turn in -0.2..0.2f64,
    ) {
        let robot = drum(n, &jitter, mass);
        robot.validate().unwrap();
        let start = Pose::at(0.2, -0.1, 1.5).moved(Vector3::zeros(), Vector3::new(0.0, 0.0, turn));
        let lengths: Vec<f64> = (0..n).map(|i| robot.span(&start, i).norm() * (1.0 + slack[i])).collect();
        let found = direct(&robot, &lengths, &Load::none(), DirectStart::Pose(&start)).unwrap();
        let weight = mass * 9.81;
        prop_assert!(found.report.residual.force < 1e-8 * weight, "{:?}", found.report);
        prop_assert!(found.report.residual.closure < 1e-12);
        // Stable: the stiffness is positive definite.
        let problem = DirectProblem::new(&robot, &lengths, &Load::none()).unwrap();
        let linearization = problem.linearize(&found.equilibrium).unwrap();
        prop_assert!(linearization.symmetric_stiffness().symmetric_eigenvalues().min() > 0.0);
    }

    #[test]
    fn inverse_and_direct_model_agree_for_6_to_16_cables(
        n in 6..=16usize, jitter in prop::collection::vec(-0.5..0.5f64, 48), mass in 5.0..500.0f64,
        x in -0.5..0.5f64, y in -0.5..0.5f64, turn in -0.05..0.05f64,
    ) {
        let robot = drum(n, &jitter, mass);
        let pose = Pose::at(x, y, 1.5).moved(Vector3::zeros(), Vector3::new(0.0, 0.0, turn));
        match inverse(&robot, &pose, &Load::none()) {
            Ok(wanted) => {
                let near = DirectStart::Near(&wanted.equilibrium);
                let found = direct(&robot, &wanted.lengths, &Load::none(), near).unwrap();
                // A pose of six cables may be an unstable equilibrium: then another one is found, and said
                // so.
                if found.report.method == DirectMethod::Newton {
                    assert_same_pose(&found.equilibrium.pose, &pose, 1e-8, 1e-8)?;
                }
            }
            Err(error) => {
                prop_assert!(error.kind() == "infeasible_tension", "{error}");
            }
        }
    }

    #[test]
    fn turning_the_whole_robot_about_the_vertical_turns_the_answer(
        about in -3.0..3.0f64, x in -2.0..2.0f64, y in -1.0..1.0f64,
        shift in prop::array::uniform3(-10.0..10.0f64),
    ) {
        let robot = caroca();
        let turn = Rotation3::new(Vector3::new(0.0, 0.0, about));
        let shift = Vector3::from(shift);
        let mut turned = robot.clone();
        turned.cables.iter_mut().for_each(|cable| cable.exit_point = turn * cable.exit_point + shift);
        let pose = Pose::at(x, y, 1.5);
        let turned_pose = Pose { position: turn * pose.position + shift, rotation: turn };
        let (force, moment) = (Vector3::new(20.0, -30.0, -200.0), Vector3::new(5.0, 3.0, -8.0));
        let wrench = Wrench { force, moment };
        let turned_wrench = Wrench { force: turn * wrench.force, moment: turn * wrench.moment };
        let here = deflection(&robot, &pose, &Load::wrench(wrench)).unwrap();
        let there = deflection(&turned, &turned_pose, &Load::wrench(turned_wrench)).unwrap();
        prop_assert!((turn * here.displacement() - there.displacement()).norm() < 1e-12);
    }

    #[test]
    fn the_mirrored_robot_gives_the_mirrored_answer(
        x in 0.1..2.0f64, y in -1.0..1.0f64, fy in -50.0..50.0f64,
    ) {
        let robot = caroca();
        let mirror = |v: &Vector3<f64>| Vector3::new(-v.x, v.y, v.z);
        let mut mirrored = robot.clone();
        for cable in &mut mirrored.cables {
            cable.exit_point = mirror(&cable.exit_point);
            cable.anchor_point = mirror(&cable.anchor_point);
        }
        let force = Vector3::new(30.0, fy, -400.0);
        let load = |force| Load::wrench(Wrench { force, moment: Vector3::zeros() });
        let here = deflection(&robot, &Pose::at(x, y, 1.5), &load(force)).unwrap();
        let there = deflection(&mirrored, &Pose::at(-x, y, 1.5), &load(mirror(&force))).unwrap();
        prop_assert!((mirror(&here.displacement()) - there.displacement()).norm() < 1e-12);
    }

    #[test]
    fn the_tangent_is_the_derivative_of_the_direct_model(
        x in -2.5..2.5f64, y in -1.3..1.3f64, z in 0.5..2.8f64, payload in 0.0..50.0f64, cable in 0..8usize,
        component in 0..6usize,
    ) {
        let robot = caroca();
        let load = Load::payload(payload);
        let wanted = inverse(&robot, &Pose::at(x, y, z), &load);
        prop_assume!(wanted.is_ok());
        let wanted = wanted.unwrap();
        let solve = |lengths: &[f64], load: &Load| {
            direct(&robot, lengths, load, DirectStart::Near(&wanted.equilibrium)).unwrap().equilibrium.pose
        };
        let pose = solve(&wanted.lengths, &load);
        let problem = DirectProblem::new(&robot, &wanted.lengths, &load).unwrap();
        let linearization = problem.linearize(&wanted.equilibrium).unwrap();
        // One cable is lengthened by h.
        let at = |h: f64| {
            let mut lengths = wanted.lengths.clone();
            lengths[cable] += h;
            pose.motion_to(&solve(&lengths, &load))
        };
        // Neither at a cable that is about to go slack: there the stiffness changes within micrometres.
        prop_assume!(wanted.tensions.iter().all(|t| *t > 30.0));
        let h = 1e-6;
        let slope = (8.0 * (at(h) - at(-h)) - (at(2.0 * h) - at(-2.0 * h))) / (12.0 * h);
        let exact: nalgebra::Vector6<f64> = linearization.pose_per_length().column(cable).into_owned();
        prop_assert!((slope - exact).norm() < 1e-5 * exact.norm(), "{slope} {exact}");
        // Pushing.
        let mut unit = nalgebra::Vector6::zeros();
        unit[component] = 1.0;
        let at = |h: f64| {
            let load = Load { wrench: Wrench::from_vector(&(unit * h)), ..load };
            pose.motion_to(&solve(&wanted.lengths, &load))
        };
        let h = 0.05;
        let slope = (8.0 * (at(h) - at(-h)) - (at(2.0 * h) - at(-2.0 * h))) / (12.0 * h);
        let exact = linearization.displacement(&Wrench::from_vector(&unit));
        prop_assert!((slope - exact).norm() < 1e-5 * exact.norm(), "{slope} {exact}");
        // The Cartesian stiffness is what is left of the assembled equations without the cables.
        let inverse = linearization.stiffness().try_inverse().unwrap();
        prop_assert!((inverse * unit - exact).norm() < 1e-6 * exact.norm());
    }
}
