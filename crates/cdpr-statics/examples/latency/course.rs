//! A random smooth course of a robot: moves between poses of its workspace, and a load that always changes.

use cdpr_robot::{Coordinate, Pose, Robot, Vector3, Wrench};
use cdpr_statics::{InversePath, Load, StaticsError, WantedPose, inverse};
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;
use std::f64::consts::TAU;

/// Mean distance of the set-points of a move, relative to the largest distance of an exit point from the
/// middle: 1 m/s at 1 kHz where this is 10 m.
const PACE: f64 = 1e-4;
/// Largest rotation vector of a pose [rad].
const LARGEST_ROTATION: f64 = 0.05;
/// Share of the way from the middle to the limit of the workspace at which every third move ends.
const NEXT_TO_LIMIT: f64 = 0.99;
/// Moves that may fail one after the other, because the workspace is not convex.
const MOST_TRIALS: usize = 200;

/// Set-points of a course that goes forwards and backwards, at rest at both of its ends.
pub(crate) struct Course {
    /// Pose that is wanted, and the lengths [m] that hold it under the platform's weight.
    pub(crate) points: Vec<(Pose, Vec<f64>)>,
    weight: f64,
    size: f64,
    payload: f64,
    /// Angular frequency by step and phase of the payload, three forces and three moments.
    waves: [[f64; 2]; 7],
}

/// A place of the course: position [m] and rotation vector [rad].
type Place = [Vector3<f64>; 2];

fn pose([position, rotation]: &Place) -> Pose {
    Pose { position: *position, ..Pose::at(0.0, 0.0, 0.0) }.moved(Vector3::zeros(), *rotation)
}

/// The lengths that hold a platform at a place [m], with fewer cables than free motions turned as it rests.
fn held(robot: &Robot, place: &Place) -> Result<Vec<f64>, StaticsError> {
    let missing = robot.freedoms().count().saturating_sub(robot.cables.len());
    let free = &[Coordinate::Roll, Coordinate::Pitch, Coordinate::Yaw][..missing];
    Ok(inverse(robot, WantedPose { free, ..pose(place).into() }, &Load::none())?.lengths)
}

fn random(rng: &mut ChaCha8Rng) -> Vector3<f64> {
    loop {
        let vector = Vector3::from_fn(|_, _| rng.random_range(-1.0..1.0));
        if (0.01..1.0).contains(&vector.norm_squared()) {
            return vector;
        }
    }
}

impl Course {
    /// A course of `count` set-points or more around `middle` [m].
    pub(crate) fn new(
        robot: &Robot,
        middle: Vector3<f64>,
        count: usize,
        seed: u64,
    ) -> Result<Self, StaticsError> {
        let rng = &mut ChaCha8Rng::seed_from_u64(seed);
        let far = robot.cables.iter().map(|cable| (cable.exit_point - middle).norm()).fold(0.0, f64::max);
        let weight = robot.weight(&Pose::at(0.0, 0.0, 0.0), 0.0).force.norm();
        let arms = robot.cables.iter().map(|cable| cable.anchor_point.norm()).fold(0.0, f64::max);
        let waves =
            std::array::from_fn(|_| [TAU / rng.random_range(2000.0..9000.0), rng.random_range(0.0..TAU)]);
        let payload = 0.25 * robot.platform.mass;
        let mut last: Place = [middle, Vector3::zeros()];
        let first = held(robot, &last)?;
        let mut course = Self { points: vec![(pose(&last), first)], weight, size: arms, payload, waves };
        let (mut trials, mut moves) = (0, 0);
        while course.points.len() < count {
            let next = course.end_of_move(robot, middle, far, moves % 3 == 0, rng);
            match course.moved(robot, &last, &next, PACE * far) {
                Ok(points) => {
                    course.points.extend(points);
                    (last, trials, moves) = (next, 0, moves + 1);
                }
                Err(error) if trials == MOST_TRIALS => return Err(error),
                Err(_) => trials += 1,
            }
        }
        Ok(course)
    }

    /// A random place on a ray from the middle, next to the limit of the workspace or anywhere below it.
    fn end_of_move(
        &self,
        robot: &Robot,
        middle: Vector3<f64>,
        far: f64,
        at_limit: bool,
        rng: &mut ChaCha8Rng,
    ) -> Place {
        let (ray, rotation) = (random(rng).normalize() * far, LARGEST_ROTATION * random(rng));
        let at = |share: f64| [middle + share * ray, rotation];
        let (mut feasible, mut infeasible) = (0.0, 1.0);
        for _ in 0..10 {
            let share = 0.5 * (feasible + infeasible);
            match held(robot, &at(share)) {
                Ok(_) => feasible = share,
                Err(_) => infeasible = share,
            }
        }
        at(feasible * if at_limit { NEXT_TO_LIMIT } else { rng.random_range(0.0..0.9) })
    }

    /// The set-points of a move that begins and ends at rest, without the first.
    fn moved(
        &self,
        robot: &Robot,
        from: &Place,
        to: &Place,
        pace: f64,
    ) -> Result<Vec<(Pose, Vec<f64>)>, StaticsError> {
        let count = ((to[0] - from[0]).norm() / pace).ceil().max(20.0) as usize;
        let at = |k: usize| {
            let s = k as f64 / count as f64;
            let share = s * s * s * (10.0 + s * (6.0 * s - 15.0));
            (share, pose(&std::array::from_fn(|i| from[i] + share * (to[i] - from[i]))))
        };
        if !robot.is_fully_actuated() {
            // The lengths change in proportion: the platform turns as it likes.
            let [first, last] = [held(robot, from)?, held(robot, to)?];
            let between =
                |share: f64| first.iter().zip(&last).map(move |(a, b)| a + share * (b - a)).collect();
            return Ok((1..=count).map(at).map(|(share, near)| (near, between(share))).collect());
        }
        let mut path = InversePath::new(robot);
        path.solve(pose(from), &Load::none())?;
        let mut held = |(_, wanted)| Ok((wanted, path.solve(wanted, &Load::none())?.solution.lengths));
        (1..=count).map(at).map(&mut held).collect()
    }

    /// The set-point of step `k`: there and back again.
    pub(crate) fn point(&self, k: usize) -> &(Pose, Vec<f64>) {
        let last = self.points.len() - 1;
        let along = k % (2 * last);
        &self.points[if along <= last { along } else { 2 * last - along }]
    }

    /// The load of step `k`: a payload up to half of the platform's mass, a force up to a fifth of its weight
    /// along each axis, and a moment about each axis up to that of a twentieth at the farthest anchor point.
    pub(crate) fn load(&self, k: usize) -> Load {
        let wave = |i: usize| (self.waves[i][0] * k as f64 + self.waves[i][1]).sin();
        Load {
            payload: self.payload * (1.0 + wave(0)),
            wrench: Wrench {
                force: 0.2 * self.weight * Vector3::from_fn(|i, _| wave(1 + i)),
                moment: 0.05 * self.weight * self.size * Vector3::from_fn(|i, _| wave(4 + i)),
            },
        }
    }
}
