//! The way of a platform: a curve through poses.

use crate::error::DynamicsError;
use cdpr_robot::{Matrix3, Pose, Rotation3, Vector3, Vector6};

/// A natural cubic spline through poses, in the position of P and in the rotation vector φ from the first
/// one, over the share of the way. Between two poses it is straight.
#[derive(Clone, Debug)]
pub(crate) struct Way {
    first: Pose,
    /// Share of the way at each pose, from 0 to 1; (p, φ) there and its second derivative.
    knots: Vec<f64>,
    points: Vec<Vector6<f64>>,
    bends: Vec<Vector6<f64>>,
}

/// A pose on the way with velocity and acceleration of P, and angular velocity and acceleration, in the base
/// frame.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Motion {
    pub(crate) pose: Pose,
    /// [m/s, rad/s].
    pub(crate) velocity: Vector6<f64>,
    /// [m/s², rad/s²].
    pub(crate) acceleration: Vector6<f64>,
}

impl Way {
    /// Through poses; rotations count as far as they move points at a distance `size` from P [m].
    pub(crate) fn new(poses: &[Pose], size: f64) -> Result<Self, DynamicsError> {
        /// Least way [m]: less is no motion.
        const LEAST: f64 = 1e-9;
        let invalid = |value: String, expected: &str| DynamicsError::Invalid {
            field: "poses",
            value,
            expected: expected.to_owned(),
        };
        let [first, _, ..] = poses else {
            return Err(invalid(poses.len().to_string(), "two poses or more, the ways between them"));
        };
        if !poses.iter().all(Pose::is_finite) {
            return Err(invalid("not finite".to_owned(), "finite numbers"));
        }
        let mut knots = vec![0.0];
        for (k, pair) in poses.windows(2).enumerate() {
            let motion = pair[0].motion_to(&pair[1]);
            let turn = motion.fixed_rows::<3>(3).norm() * size;
            let way = motion.fixed_rows::<3>(0).norm().hypot(turn);
            if way < LEAST {
                return Err(invalid(
                    format!("pose {} twice", k + 1),
                    "poses that differ from the one before",
                ));
            }
            knots.push(knots[k] + way);
        }
        let whole = knots.last().copied().unwrap_or(1.0);
        knots.iter_mut().for_each(|knot| *knot /= whole);
        let mut points: Vec<Vector6<f64>> = poses.iter().map(|pose| first.motion_to(pose)).collect();
        for (point, pose) in points.iter_mut().zip(poses) {
            point.fixed_rows_mut::<3>(0).copy_from(&pose.position);
        }
        let bends = natural_bends(&knots, &points);
        Ok(Self { first: *first, knots, points, bends })
    }

    /// Length of the curve along which P moves [m], by the rule of Gauss with three points.
    pub(crate) fn length(&self) -> f64 {
        /// Parts of the way between two poses.
        const PARTS: usize = 64;
        let node = 0.6_f64.sqrt();
        let speed = |share: f64| self.at([share, 1.0, 0.0]).velocity.fixed_rows::<3>(0).norm();
        let between = |pair: &[f64]| {
            let half = 0.5 * (pair[1] - pair[0]) / PARTS as f64;
            let part = |k: usize| {
                let middle = pair[0] + (2 * k + 1) as f64 * half;
                let ends = speed(middle - node * half) + speed(middle + node * half);
                half * (5.0 * ends + 8.0 * speed(middle)) / 9.0
            };
            (0..PARTS).map(part).sum::<f64>()
        };
        self.knots.windows(2).map(between).sum()
    }

    /// The motion at a share of the way, with its rate [1/s] and the rate of that [1/s²].
    pub(crate) fn at(&self, [share, rate, growth]: [f64; 3]) -> Motion {
        let last = self.knots.len() - 1;
        let k = self.knots.partition_point(|knot| *knot <= share).clamp(1, last) - 1;
        let h = self.knots[k + 1] - self.knots[k];
        let (b, a) = ((share - self.knots[k]) / h, (self.knots[k + 1] - share) / h);
        let (from, to) = (self.points[k], self.points[k + 1]);
        let (bend, next) = (self.bends[k], self.bends[k + 1]);
        let point = from * a + to * b + (bend * (a * a * a - a) + next * (b * b * b - b)) * (h * h / 6.0);
        let slope = (to - from) / h + (next * (3.0 * b * b - 1.0) - bend * (3.0 * a * a - 1.0)) * (h / 6.0);
        let curvature = bend * a + next * b;
        let mut velocity = slope * rate;
        let mut acceleration = curvature * (rate * rate) + slope * growth;
        let of = |vector: &Vector6<f64>| Vector3::from(vector.fixed_rows::<3>(3));
        let (vector, turning, bending) = (of(&point), of(&velocity), of(&acceleration));
        let (angular, more) = angular(&vector, &turning, &bending);
        velocity.fixed_rows_mut::<3>(3).copy_from(&angular);
        acceleration.fixed_rows_mut::<3>(3).copy_from(&more);
        let pose = Pose {
            position: point.fixed_rows::<3>(0).into(),
            rotation: Rotation3::new(vector) * self.first.rotation,
        };
        Motion { pose, velocity, acceleration }
    }
}

/// Angular velocity and acceleration of `exp(φ) R` from φ and its derivatives.
fn angular(
    vector: &Vector3<f64>,
    rate: &Vector3<f64>,
    growth: &Vector3<f64>,
) -> (Vector3<f64>, Vector3<f64>) {
    /// Time of the differences [s], at the given rate.
    const STEP: f64 = 1e-5;
    let step = STEP / (1.0 + rate.norm());
    let change = (tangent(&(vector + rate * step)) - tangent(&(vector - rate * step))) / (2.0 * step);
    let tangent = tangent(vector);
    (tangent * rate, tangent * growth + change * rate)
}

/// dω/dφ' of `exp(φ)`: 1 + (1 - cos θ)/θ² [φ] + (θ - sin θ)/θ³ [φ]².
fn tangent(vector: &Vector3<f64>) -> Matrix3<f64> {
    let angle = vector.norm();
    let (one, two) = if angle > 1e-3 {
        ((1.0 - angle.cos()) / (angle * angle), (angle - angle.sin()) / angle.powi(3))
    } else {
        (0.5 - angle * angle / 24.0, 1.0 / 6.0 - angle * angle / 120.0)
    };
    let cross = vector.cross_matrix();
    Matrix3::identity() + cross * one + cross * cross * two
}

/// Second derivatives of the cubic spline through points that is straight at both ends.
fn natural_bends(knots: &[f64], points: &[Vector6<f64>]) -> Vec<Vector6<f64>> {
    let last = knots.len() - 1;
    let mut bends = vec![Vector6::zeros(); last + 1];
    let mut factors = vec![0.0; last + 1];
    for k in 1..last {
        let [before, after] = [knots[k] - knots[k - 1], knots[k + 1] - knots[k]];
        let right = (points[k + 1] - points[k]) / after - (points[k] - points[k - 1]) / before;
        let diagonal = (before + after) / 3.0 - before / 6.0 * factors[k - 1];
        factors[k] = after / 6.0 / diagonal;
        bends[k] = (right - bends[k - 1] * (before / 6.0)) / diagonal;
    }
    for k in (1..last).rev() {
        let next = bends[k + 1];
        bends[k] -= next * factors[k];
    }
    bends
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)]

    use super::*;

    #[test]
    fn a_way_goes_through_its_poses_and_its_rates_are_those_of_differences() {
        let pose = |x: f64, turn: [f64; 3]| Pose::at(x, x * x, 1.0).moved(Vector3::zeros(), turn.into());
        let poses = [pose(0.0, [0.1, 0.0, 0.0]), pose(0.5, [0.3, 0.4, 0.0]), pose(1.0, [0.0, 0.5, -0.6])];
        let way = Way::new(&poses, 0.5).unwrap();
        let end = way.at([1.0, 0.0, 0.0]).pose;
        assert!(poses[2].motion_to(&end).norm() < 1e-12);
        let share = |time: f64| [0.4 * time + 0.3 * time * time, 0.4 + 0.6 * time, 0.6];
        let h = 1e-5;
        for time in [0.1, 0.4, 0.9] {
            let [before, at, after] = [time - h, time, time + h].map(|time| way.at(share(time)));
            let velocity = before.pose.motion_to(&after.pose) / (2.0 * h);
            let acceleration = (after.velocity - before.velocity) / (2.0 * h);
            assert!((velocity - at.velocity).norm() < 1e-8, "{time}");
            assert!((acceleration - at.acceleration).norm() < 1e-7, "{time}");
        }
    }

    #[test]
    fn the_length_of_a_way_is_that_of_its_curve() {
        let poses = [[0.5, 0.0, 3.0], [1.5, 0.5, 3.0], [0.5, 1.0, 3.2], [-0.5, 0.0, 3.0]];
        let way = Way::new(&poses.map(|[x, y, z]| Pose::at(x, y, z)), 0.5).unwrap();
        let count = 20_000;
        let places: Vec<_> =
            (0..=count).map(|k| way.at([f64::from(k) / f64::from(count), 0.0, 0.0]).pose.position).collect();
        let chords: f64 = places.windows(2).map(|pair| (pair[1] - pair[0]).norm()).sum();
        assert!((way.length() - chords).abs() < 1e-6 * chords, "{} {chords}", way.length());
        // The straight distances between the poses are less.
        assert!(way.length() > 3.8);
    }

    #[test]
    fn a_way_between_two_poses_is_straight_and_one_without_length_is_refused() {
        let way = Way::new(&[Pose::at(0.0, 0.0, 1.0), Pose::at(2.0, 0.0, 1.0)], 1.0).unwrap();
        let motion = way.at([0.25, 3.0, 5.0]);
        assert!((motion.pose.position - Vector3::new(0.5, 0.0, 1.0)).norm() < 1e-15);
        assert!((motion.velocity[0] - 6.0).abs() < 1e-12 && (motion.acceleration[0] - 10.0).abs() < 1e-12);
        assert!((way.length() - 2.0).abs() < 1e-12);
        let refused = |poses: &[Pose]| Way::new(poses, 1.0).unwrap_err().to_string();
        assert!(refused(&[Pose::at(0.0, 0.0, 1.0)]).contains("two poses or more"));
        assert!(refused(&[Pose::at(0.0, 0.0, 1.0); 2]).contains("differ"));
    }
}
