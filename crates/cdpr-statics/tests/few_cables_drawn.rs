//! Random robots on few cables rest, and are found again.

use crate::few_cables::suspended;
use cdpr_robot::{CableProperties, Coordinate, Plane, Platform, Pose, Robot, Rotation3, Vector3};
use cdpr_statics::free_coordinates::free_solutions;
use cdpr_statics::{DirectProblem, DirectSolution, DirectStart, Load, WantedPose};
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;

/// Suspended robots with one to five cables, point masses and planar robots, straight or sagging, with the
/// spans of a pose as lengths at rest; and a start.
fn random(seed: u64) -> Option<(Robot, Vec<f64>, Pose)> {
    let rng = &mut ChaCha8Rng::seed_from_u64(seed);
    let size = 10.0_f64.powf(rng.random_range(0.0..2.0));
    let platform = size * rng.random_range(0.03..0.2);
    let kind = rng.random_range(0..3);
    let n = if kind == 0 { rng.random_range(1..=5) } else { rng.random_range(1..=3) };
    let mass = 10.0_f64.powf(rng.random_range(0.0..3.0));
    let mut cube = |scale: f64| Vector3::from_fn(|_, _| scale * rng.random_range(-1.0..1.0));
    let in_plane = |v: Vector3<f64>| if kind == 2 { Vector3::new(v.x, 0.0, v.z) } else { v };
    let mut points = Vec::new();
    for _ in 0..n {
        let (mut exit, anchor) = (in_plane(cube(size)), in_plane(cube(platform)));
        exit.z = size;
        points.push([exit.into(), if kind == 1 { [0.0; 3] } else { anchor.into() }]);
    }
    let center = in_plane(cube(platform));
    let turn = cube(0.6);
    let (rest, start) = (in_plane(cube(0.5 * size)), in_plane(cube(0.3 * size)));
    let strain = 10.0_f64.powf(rng.random_range(-5.0..-2.5));
    let sag = if rng.random_bool(0.3) { 0.0 } else { 10.0_f64.powf(rng.random_range(-4.0..-0.5)) };
    let rope = CableProperties::linear(1.0, sag * mass / size, mass * 9.81 / strain);
    let base = Platform { point: kind == 1, ..Platform::new(mass, center) };
    let robot = Robot {
        plane: (kind == 2).then_some(Plane::Xz),
        name: format!("{} {n}", ["space", "point", "plane"][kind]),
        ..suspended(&points, &rope, base)
    };
    let rest = Pose::at(rest.x, rest.y, rest.z);
    let lengths: Vec<f64> = (0..n).map(|i| robot.span(&rest, i).norm()).collect();
    let turn = if kind == 2 { Vector3::new(0.0, turn.y, 0.0) } else { turn };
    let start = rest.moved(start, if kind == 1 { Vector3::zeros() } else { turn });
    (lengths.iter().all(|length| *length > 0.05 * size)).then_some((robot, lengths, start))
}

/// How near the inverse model comes to a rest from as many of its coordinates as it has cables, and the
/// others; `None` where these lengths move the given coordinates hardly or not at all.
fn found_again(robot: &Robot, lengths: &[f64], found: &DirectSolution) -> Option<(f64, Vec<Coordinate>)> {
    let (freedoms, pose) = (robot.freedoms(), &found.equilibrium.pose);
    let m = freedoms.count();
    if !found.stability.neutral().is_empty() || lengths.len() >= m {
        return None;
    }
    let free: Vec<Coordinate> = Coordinate::ALL
        .into_iter()
        .filter(|coordinate| freedoms.contains(coordinate.component()))
        .rev()
        .take(m - lengths.len())
        .collect();
    // The lengths must move the others: below its exit point one cable holds any height, and no x.
    let problem = DirectProblem::new(robot, lengths, &Load::none()).unwrap();
    let moves = problem.linearize(&found.equilibrium).unwrap().pose_per_length();
    let given = Coordinate::ALL.into_iter().map(Coordinate::component);
    let given: Vec<usize> = given
        .filter(|k| freedoms.contains(*k) && free.iter().all(|coordinate| coordinate.component() != *k))
        .collect();
    let scale = problem_size(lengths);
    let moves = nalgebra::DMatrix::from_fn(given.len(), lengths.len(), |i, j| {
        moves[(given[i], j)] * if given[i] < 3 { 1.0 } else { scale }
    });
    let values = moves.singular_values();
    if values.min() < 0.02 {
        return None;
    }
    let turned = |coordinate: &&Coordinate| coordinate.is_angle();
    let turn = free.iter().filter(turned).fold(Vector3::zeros(), |turn: Vector3<f64>, coordinate| {
        turn + 0.05 * Vector3::ith(coordinate.component() - 3, 1.0)
    });
    let (roll, pitch, yaw) = pose.rotation.euler_angles();
    let wanted = Pose {
        position: pose.position,
        rotation: match robot.plane {
            None => Rotation3::from_euler_angles(roll + turn.x, pitch + turn.y, yaw + turn.z),
            Some(_) => Rotation3::new(turn) * pose.rotation,
        },
    };
    let wanted = match free.contains(&Coordinate::Z) {
        true => wanted.moved(Vector3::new(0.0, 0.0, 0.02 * problem_size(lengths)), Vector3::zeros()),
        false => wanted,
    };
    let solutions = free_solutions(robot, WantedPose::at(&wanted).free(&free), &Load::none());
    let all = solutions.iter().flat_map(|solutions| [&solutions.first].into_iter().chain(&solutions.others));
    let nearest = all.map(|one| {
        let worst = one.lengths.iter().zip(lengths).map(|(a, b)| (a / b - 1.0).abs());
        worst.fold(pose.motion_to(&one.equilibrium.pose).norm(), f64::max)
    });
    Some((nearest.fold(f64::INFINITY, f64::min), free))
}

#[test]
fn random_robots_on_few_cables_rest_and_are_found_again_from_some_of_their_coordinates() {
    let (mut tried, mut rest, mut again, mut missed) = (0, 0, 0, 0);
    for seed in 0..1200 {
        let Some((robot, lengths, start)) = random(seed) else { continue };
        tried += 1;
        let line = format!("seed {seed}: {}", robot.name);
        let problem = DirectProblem::new(&robot, &lengths, &Load::none()).unwrap();
        let found = match problem.direct(DirectStart::Pose(&start)) {
            Ok(found) => found,
            Err(error) => {
                // A cable that carries all the others' load is too short for it.
                assert_eq!(error.kind(), "cable_overstrained", "{line}: {error}");
                continue;
            }
        };
        rest += 1;
        let forces: f64 = found.equilibrium.tensions().iter().sum();
        assert!(found.stability.is_stable() && found.report.residual.force < 1e-11 * forces, "{line}");
        let neutral = found.stability.neutral().len();
        let freedoms = robot.freedoms();
        assert_eq!(found.stability.eigenvalues().len() + neutral, freedoms.count(), "{line}");
        // Pushed a little it comes back, but for its neutral motions.
        let pose = &found.equilibrium.pose;
        let push = 1e-6 * problem_size(&lengths);
        let nudged = pose.moved(
            if robot.plane.is_some() { Vector3::new(push, 0.0, push) } else { Vector3::repeat(push) },
            Vector3::zeros(),
        );
        let back = problem.direct(DirectStart::Pose(&nudged)).unwrap();
        let motion = pose.motion_to(&back.equilibrium.pose);
        let left = found.stability.neutral().iter().map(|mode| mode.translation.norm()).fold(0.0, f64::max);
        assert!(motion.norm() < 1e-7 * problem_size(&lengths) || left > 0.0, "{line}: {motion}");
        let Some((nearest, free)) = found_again(&robot, &lengths, &found) else { continue };
        // A cable that hangs down deeply has as many shapes as tensions: not every one is found.
        if nearest > 1e-6 * problem_size(&lengths) {
            assert!(!found.report.longer_than_chord.is_empty(), "{line}: {nearest}, free {free:?}");
            missed += 1;
            continue;
        }
        again += 1;
    }
    let line = format!("{tried} robots, {rest} at rest, {again} found again, {missed} not");
    println!("{line}");
    assert!(rest > 1100 && again > 150 && 30 * missed < again, "{line}");
}

fn problem_size(lengths: &[f64]) -> f64 {
    lengths.iter().copied().fold(0.0, f64::max)
}
