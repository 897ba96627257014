//! Poses of which some coordinates are found: the inverse model, deflection and derivatives of robots with
//! fewer cables than free motions.

use crate::common::cogiro;
use crate::equilibria::{number, vector};
use crate::few_cables::{cases, load, pose, solve, string, suspended};
use crate::pulleys::robot;
use cdpr_robot::{
    CableProperties, Coordinate, Matrix3, Plane, Platform, Pose, Robot, Rotation3, Vector3, Wrench,
};
use cdpr_statics::free_coordinates::{FreeSolution, FreeSolutions, free_solutions};
use cdpr_statics::stiffness::stiffness_at;
use cdpr_statics::vibration::modes_at;
use cdpr_statics::{
    DirectProblem, DirectStart, Load, StaticsError, Unstable, WantedPose, deflection, inverse,
};
use serde_json::Value;

#[test]
fn lengths_and_free_coordinates_match_arithmetic_of_20_digits() {
    let mut compared = 0;
    for case in cases() {
        let (kind, robot) = (case["kind"].as_str().unwrap(), robot(&case));
        let Value::Object(found) = &case["found"] else { continue };
        let free: Vec<Coordinate> = found.keys().map(|name| name.parse().unwrap()).collect();
        let [roll, pitch, yaw] = [0, 1, 2].map(|k| number(&case["start_angles"][k]));
        let wanted = Pose {
            position: vector(&case["start_position"]),
            rotation: Rotation3::from_euler_angles(roll, pitch, yaw),
        };
        let FreeSolutions { first, others } =
            free_solutions(&robot, WantedPose::at(&wanted).free(&free), &load(&case)).unwrap();
        let expected = pose(&case);
        let away = |one: &FreeSolution| expected.motion_to(&one.equilibrium.pose).norm();
        let all = [&first].into_iter().chain(&others);
        let nearest = all.min_by(|one, other| away(one).total_cmp(&away(other))).unwrap();
        let motion = away(nearest);
        let lengths = case["unstrained_lengths_found"].as_array().unwrap();
        let each = nearest.lengths.iter().zip(lengths).map(|(l, exact)| (l / number(exact) - 1.0).abs());
        let worst = each.fold(0.0, f64::max);
        // Of two stable solutions the one with taut cables comes first.
        let longest = |one: &FreeSolution| {
            let chord = |i| robot.span(&one.equilibrium.pose, i).norm();
            one.lengths.iter().enumerate().map(|(i, length)| length / chord(i)).fold(0.0, f64::max)
        };
        assert!(std::ptr::eq(nearest, &raw const first) || longest(&first) < longest(nearest));
        let line = format!(
            "{kind:22} {motion:8.1e} m, rad, lengths {worst:8.1e}, {} iterations, {} others",
            first.iterations,
            others.len()
        );
        println!("{line}");
        assert!(
            motion < 1e-9 && worst < 1e-9 && nearest.stability.is_stable() && first.stability.is_stable(),
            "{line}"
        );
        // Every other is a solution, too: the direct model stays there.
        for other in &others {
            let problem = DirectProblem::new(&robot, &other.lengths, &load(&case)).unwrap();
            let again = problem
                .with_unstable(Unstable::Accepted)
                .direct(DirectStart::Near(&other.equilibrium))
                .unwrap();
            let motion = other.equilibrium.pose.motion_to(&again.equilibrium.pose).norm();
            assert!(motion < 1e-9 && again.stability.is_stable() == other.stability.is_stable(), "{line}");
            let (roll, pitch, yaw) = other.equilibrium.pose.rotation.euler_angles();
            let angles = [roll, pitch, yaw];
            for (k, coordinate) in Coordinate::ALL[3..].iter().enumerate() {
                let kept =
                    free.contains(coordinate) || (angles[k] - number(&case["start_angles"][k])).abs() < 1e-9;
                assert!(kept || angles[1].abs() > 1.0, "{line}: {angles:?}");
            }
        }
        compared += 1;
    }
    assert_eq!(compared, 3);
}

#[test]
fn a_pendulum_hangs_below_its_exit_point_or_stands_above_its_anchor() {
    // Given the height and all angles but those of the pendulum, x and y follow, and it hangs or stands.
    let platform = Platform {
        inertia: Some(Matrix3::from_diagonal(&Vector3::new(0.2, 0.3, 0.1))),
        ..Platform::new(5.0, Vector3::new(0.0, 0.0, -0.4))
    };
    let robot = suspended(&[[[1.0, 2.0, 3.0], [0.0; 3]]], &string(), platform);
    let wanted = Pose::at(1.2, 1.9, 1.0).moved(Vector3::zeros(), Vector3::new(0.2, -0.1, 0.0));
    use Coordinate::{Pitch, Roll, X, Y, Yaw};
    let free = [X, Y, Roll, Pitch, Yaw];
    let FreeSolutions { first, .. } =
        free_solutions(&robot, WantedPose::at(&wanted).free(&free), &Load::none()).unwrap();
    assert!(first.stability.is_stable() && first.stability.neutral().len() == 1);
    let position = first.equilibrium.pose.position;
    assert!((position - Vector3::new(1.0, 2.0, 1.0)).norm() < 1e-9, "{position}");
    assert!((first.tensions[0] - 5.0 * 9.81).abs() < 1e-9 && first.residual.force < 1e-9);
    // Two frequencies of a double pendulum, about each horizontal axis, with that of the yaw zero.
    let modes = modes_at(&robot, WantedPose::at(&wanted).free(&free), &Load::none()).unwrap().modes;
    let frequencies: Vec<f64> = modes.iter().map(|mode| mode.frequency).collect();
    assert_eq!((frequencies.len(), frequencies[0]), (6, 0.0));
    // M q'' + K q = 0 in the angle of the string, times its length l, and that of the platform:
    // M = [m, -m d; -m d, J + m d²], K = [m g/l, 0; 0, m g d].
    for inertia in [0.2, 0.3] {
        let (m, d, l, g): (f64, f64, f64, f64) = (5.0, 0.4, 2.0, 9.81);
        let (a, b) = (m * inertia, -m * m * g * d - (inertia + m * d * d) * m * g / l);
        let c = m * g / l * m * g * d;
        for sign in [-1.0, 1.0] {
            let square: f64 = (-b + sign * (b * b - 4.0 * a * c).sqrt()) / (2.0 * a);
            let expected = square.sqrt() / std::f64::consts::TAU;
            let nearest =
                frequencies.iter().map(|f| (f / expected - 1.0).abs()).fold(f64::INFINITY, f64::min);
            assert!(nearest < 1e-8, "{expected}: {frequencies:?}");
        }
    }
}

#[test]
fn two_cables_hold_a_planar_platform_at_a_place_and_its_tilt_follows() {
    let points = [[[-3.0, 0.0, 4.0], [-0.3, 0.0, 0.1]], [[3.0, 0.0, 4.0], [0.3, 0.0, 0.1]]];
    let platform = Platform::new(8.0, Vector3::new(0.0, 0.0, -0.1));
    let rope = CableProperties::linear(1.0, 0.08, 5e4);
    let robot = Robot { plane: Some(Plane::Xz), ..suspended(&points, &rope, platform) };
    let wanted = Pose::at(0.5, 0.0, 1.5);
    let FreeSolutions { first, .. } =
        free_solutions(&robot, WantedPose::at(&wanted).free(&[Coordinate::Pitch]), &Load::none()).unwrap();
    let pose = &first.equilibrium.pose;
    assert_eq!(pose.position, wanted.position);
    let turn = wanted.motion_to(pose);
    assert!(turn[4].abs() > 1e-3 && turn[3].abs() < 1e-15 && turn[5].abs() < 1e-15, "{turn}");
    let again = solve(&robot, &first.lengths, &Pose::at(0.3, 0.0, 1.8));
    assert!(pose.motion_to(&again.equilibrium.pose).norm() < 1e-9);
    // Its mirror image is the mirror image.
    let mirrored = Pose::at(-0.5, 0.0, 1.5);
    let mirrored =
        free_solutions(&robot, WantedPose::at(&mirrored).free(&[Coordinate::Pitch]), &Load::none())
            .unwrap()
            .first;
    let [a, b] = [&first.lengths, &mirrored.lengths];
    assert!((a[0] - b[1]).abs() < 1e-10 && (a[1] - b[0]).abs() < 1e-10, "{a:?} {b:?}");
    // A load swings it about, which the linearization predicts.
    let load = Load::wrench(Wrench { force: Vector3::new(1e-3, 0.0, 0.0), moment: Vector3::zeros() });
    let free = [Coordinate::Pitch];
    let moved = deflection(&robot, WantedPose::at(&wanted).free(&free), &load).unwrap();
    let predicted = moved.small_displacement(&robot, &load).unwrap();
    assert!((moved.displacement() - predicted).norm() < 1e-3 * predicted.norm(), "{predicted}");
    let stiffness = stiffness_at(&robot, WantedPose::at(&wanted).free(&free), &Load::none()).unwrap();
    assert!(stiffness.stability.is_stable() && stiffness.stability.eigenvalues().len() == 3);
}

#[test]
fn four_cables_of_cogiro_hold_chosen_coordinates() {
    let whole = cogiro();
    let cables: Vec<_> = [1, 3, 5, 7].map(|i| whole.cables[i].clone()).to_vec();
    let robot = Robot { cables, ..whole };
    let wanted = Pose::at(1.0, -0.3, 2.0);
    use Coordinate::{Pitch, Roll, Yaw};
    // Its upper cables cross and turn the platform by about 70 degrees: where the yaw is given, or
    // the roll, they do not hold it.
    for free in [[Roll, Pitch], [Yaw, Pitch]] {
        let error =
            free_solutions(&robot, WantedPose::at(&wanted).free(&free), &Load::payload(20.0)).unwrap_err();
        assert!(matches!(error, StaticsError::NoRest { .. }), "{error}");
    }
    let found =
        free_solutions(&robot, WantedPose::at(&wanted).free(&[Yaw, Roll]), &Load::payload(20.0)).unwrap();
    assert!(found.first.stability.is_stable());
    for one in [&found.first].into_iter().chain(&found.others) {
        assert!(one.residual.force < 1e-7 && one.residual.closure < 1e-12, "{:?}", one.residual);
        assert_eq!(one.equilibrium.pose.position, wanted.position);
    }
    // Level it rests nowhere at this height.
    let free = [Coordinate::X, Coordinate::Y];
    let error =
        free_solutions(&robot, WantedPose::at(&wanted).free(&free), &Load::payload(20.0)).unwrap_err();
    assert!(matches!(error, StaticsError::NoRest { starts: 182, .. }), "{error}");
    let names = |free: &[Coordinate]| {
        free_solutions(&robot, WantedPose::at(&wanted).free(free), &Load::none()).unwrap_err()
    };
    let error = inverse(&robot, &wanted, &Load::none()).unwrap_err();
    assert_eq!(error.kind(), "free_coordinates");
    assert!(error.to_string().contains("leave 2 coordinates"), "{error}");
    assert_eq!(names(&[Coordinate::Roll]).kind(), "free_coordinates");
    assert!(names(&[Coordinate::Roll; 2]).to_string().contains("each coordinate once"));
    let point = Robot { platform: Platform { point: true, ..robot.platform }, ..robot.clone() };
    let point = Robot { cables: robot.cables[..2].to_vec(), ..point };
    let error =
        free_solutions(&point, WantedPose::at(&wanted).free(&[Coordinate::Yaw]), &Load::none()).unwrap_err();
    assert!(error.to_string().contains("not constrained"), "{error}");
}

#[test]
fn a_search_in_which_a_force_vanishes_ends() {
    let grab = Robot::from_json(include_str!("../../../data/robots/grab.json")).unwrap();
    let turn = Rotation3::from_matrix_unchecked(Matrix3::new(
        0.9107793265479509,
        -0.22034043235554412,
        -0.3491863574113868,
        0.25557044488467395,
        0.9650711768968285,
        0.05763133890879302,
        0.32429117477093133,
        -0.14173114475069415,
        0.9352793788881197,
    ));
    let pose = Pose {
        position: Vector3::new(1.793502340224425, -0.3698671657541377, -0.06522360935803889),
        rotation: turn,
    };
    match free_solutions(
        &grab,
        WantedPose::at(&pose).free(&[Coordinate::Roll, Coordinate::Pitch]),
        &Load::none(),
    ) {
        Ok(FreeSolutions { first, others }) => {
            assert!(others.iter().chain([&first]).all(|found| found.residual.force < 1e-9));
        }
        Err(error) => assert!(matches!(error, StaticsError::NoRest { .. }), "{error}"),
    }
}

#[test]
fn a_rest_with_free_coordinates_is_followed_to_many_times_its_load() {
    let path = format!("{}/../../data/robots/four-cables.json", env!("CARGO_MANIFEST_DIR"));
    let robot = Robot::from_json(&std::fs::read_to_string(path).unwrap()).unwrap();
    let free = [Coordinate::Roll, Coordinate::Pitch];
    for pose in [Pose::at(0.5, 0.3, 2.0), Pose::at(0.3, 0.2, 1.5), Pose::at(0.6, 0.4, 2.5)] {
        let Ok(unloaded) = cdpr_statics::inverse(&robot, WantedPose::at(&pose).free(&free), &Load::none())
        else {
            continue;
        };
        for times in [3.0, 10.0, 30.0, 100.0] {
            let load = Load::payload(times * robot.platform.mass);
            let at_once =
                cdpr_statics::free_coordinates::rest_near(&robot, &unloaded.equilibrium, &load, &free)
                    .unwrap();
            let mut stepwise = unloaded.equilibrium.clone();
            for step in 1..=20 {
                let share = f64::from(step) / 20.0;
                let load = Load::payload(((1.0 + times).powf(share) - 1.0) * robot.platform.mass);
                let rest =
                    cdpr_statics::free_coordinates::rest_near(&robot, &stepwise, &load, &free).unwrap();
                stepwise = rest.equilibrium;
            }
            let apart = at_once.equilibrium.pose.motion_to(&stepwise.pose).norm();
            assert!(apart < 1e-7, "{times} times the load at {:?}: {apart}", pose.position);
        }
    }
}

#[test]
fn a_rest_with_infinitely_many_tensions_next_to_it_is_refused() {
    let robot = Robot::from_json(include_str!("../../../data/robots/four-cables.json")).unwrap();
    // Seen from above, its anchor points are a tenth of its exit points: while the platform is not turned,
    // the chords make no moment about the vertical through P, wherever it is, so that five equations are
    // left.
    let free = [Coordinate::X, Coordinate::Y];
    for wanted in [Pose::at(0.0, 0.0, 2.0), Pose::at(0.17, -0.09, 2.0), Pose::at(0.3, 0.0, 1.0)] {
        for error in [
            free_solutions(&robot, WantedPose::at(&wanted).free(&free), &Load::none()).unwrap_err(),
            inverse(&robot, WantedPose::at(&wanted).free(&free), &Load::none()).unwrap_err(),
        ] {
            let StaticsError::NotUnique { tensions: [one, other], .. } = error else { panic!("{error}") };
            assert!((one / other - 1.0).abs() > 0.02, "{one} {other}");
            assert_eq!(error.kind(), "not_unique");
        }
    }
    // With the roll or the yaw free the sixth equation determines something.
    let free = [Coordinate::Roll, Coordinate::Pitch];
    let found =
        free_solutions(&robot, WantedPose::at(&Pose::at(0.5, 0.3, 2.0)).free(&free), &Load::none()).unwrap();
    assert!(found.first.stability.is_stable());
}

#[test]
fn a_platform_on_one_cable_hangs_at_every_height() {
    let wanted = Pose::at(1.0, 2.0, 1.5);
    let platform = Platform { mass: 40.0, ..cogiro().platform };
    let robot = suspended(&[[[1.0, 2.0, 5.0], [0.0, 0.0, 0.3]]], &string(), platform);
    use Coordinate::{Pitch, Roll, X, Y, Yaw, Z};
    // At a height that is given its turn about the vertical is neutral, and its length is one.
    let found =
        free_solutions(&robot, WantedPose::at(&wanted).free(&[X, Y, Roll, Pitch, Yaw]), &Load::none())
            .unwrap();
    assert_eq!(found.first.stability.neutral().len(), 1);
    // With the yaw given and the height free, every length is right.
    let error = free_solutions(&robot, WantedPose::at(&wanted).free(&[X, Y, Z, Roll, Pitch]), &Load::none())
        .unwrap_err();
    let StaticsError::NotUnique { lengths: [one, other], .. } = error else { panic!("{error}") };
    assert!((one - other).abs() > 0.01, "{one} {other}");
}
