//! Pose of the platform.

pub(crate) mod quaternion;

use nalgebra::{Matrix3, Quaternion, Rotation3, UnitQuaternion, Vector3, Vector6};

/// Position and orientation of the platform frame in the base frame.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Pose {
    /// Position p of the platform's reference point P in the base frame [m].
    pub position: Vector3<f64>,
    /// Rotation R from the platform frame to the base frame.
    pub rotation: Rotation3<f64>,
}

impl Pose {
    /// Names of the six coordinates: position, then rotation vector.
    pub const COORDINATES: [&str; 6] = ["x", "y", "z", "rx", "ry", "rz"];

    /// The pose at (x, y, z) [m], not rotated.
    pub fn at(x: f64, y: f64, z: f64) -> Self {
        Self { position: Vector3::new(x, y, z), rotation: Rotation3::identity() }
    }

    /// The pose with a quaternion (w, x, y, z), which is normalized; `None` if it is zero or not finite.
    pub fn with_quaternion(position: Vector3<f64>, [w, x, y, z]: [f64; 4]) -> Option<Self> {
        let quaternion = UnitQuaternion::try_new(Quaternion::new(w, x, y, z), 1e-12)?;
        let finite = quaternion.coords.iter().chain(position.iter()).all(|c| c.is_finite());
        finite.then(|| Self { position, rotation: quaternion.to_rotation_matrix() })
    }

    /// Rotation as a unit quaternion (w, x, y, z) with w >= 0: the inverse of [`Pose::with_quaternion`].
    pub fn quaternion(&self) -> [f64; 4] {
        let quaternion = UnitQuaternion::from_rotation_matrix(&self.rotation);
        let sign = if quaternion.w < 0.0 { -1.0 } else { 1.0 };
        // Adding 0 turns -0 into 0.
        [quaternion.w, quaternion.i, quaternion.j, quaternion.k].map(|component| sign * component + 0.0)
    }

    /// The pose moved by `translation` [m] and rotated by the vector `rotation` [rad] in the base frame.
    ///
    /// The new position is `p + dp`, the new rotation `exp(dphi) R`. A pose that is moved many times keeps a
    /// rotation to rounding: see [`orthonormalized`].
    #[inline]
    pub fn moved(&self, translation: Vector3<f64>, rotation: Vector3<f64>) -> Self {
        let product = Rotation3::new(rotation) * self.rotation;
        Self { position: self.position + translation, rotation: orthonormalized(product.matrix()) }
    }

    /// The motion (dp, dphi) [m, rad] from this pose to another: the inverse of [`Pose::moved`].
    #[inline]
    pub fn motion_to(&self, other: &Self) -> Vector6<f64> {
        let translation = other.position - self.position;
        // A quaternion keeps small angles, which the trace of a matrix loses.
        let relative = other.rotation * self.rotation.inverse();
        let rotation = UnitQuaternion::from_rotation_matrix(&relative).scaled_axis();
        Vector6::new(translation.x, translation.y, translation.z, rotation.x, rotation.y, rotation.z)
    }

    /// The angle of the rotation from this pose to another [rad], from 0 to π.
    ///
    /// It is that of a quaternion: of equal rotations and of half turns, the cosine from the trace of a
    /// matrix may exceed 1 by rounding.
    pub fn angle_to(&self, other: &Self) -> f64 {
        let [from, to] = [self, other].map(|pose| UnitQuaternion::from_rotation_matrix(&pose.rotation));
        from.angle_to(&to)
    }

    /// Whether all components are finite.
    #[inline]
    pub fn is_finite(&self) -> bool {
        self.position.iter().chain(self.rotation.matrix().iter()).all(|c| c.is_finite())
    }
}

/// The rotation next to a matrix that differs from a rotation by rounding.
///
/// Products of rotations drift away from the rotations, and this is the one place that takes the drift out.
/// The first two columns are made orthonormal by one step of Newton's method for `1/|v|`, which needs no
/// root, and the third is their cross product. What is left is of the order of the drift squared.
#[inline]
pub fn orthonormalized(matrix: &Matrix3<f64>) -> Rotation3<f64> {
    let unit = |v: Vector3<f64>| v * (1.5 - 0.5 * v.norm_squared());
    let x = unit(matrix.column(0).into());
    let y: Vector3<f64> = matrix.column(1).into();
    let y = unit(y - x * x.dot(&y));
    Rotation3::from_matrix_unchecked(Matrix3::from_columns(&[x, y, x.cross(&y)]))
}

#[cfg(test)]
mod tests {
    use super::*;
    use approx::assert_relative_eq;

    #[test]
    fn the_motion_between_two_poses_takes_one_to_the_other() {
        let start = Pose::at(1.0, 2.0, 3.0).moved(Vector3::zeros(), Vector3::new(0.3, -0.2, 0.5));
        let end = start.moved(Vector3::new(0.1, 0.0, -0.2), Vector3::new(-0.4, 0.9, 0.1));
        let motion = start.motion_to(&end);
        assert_relative_eq!(motion, Vector6::new(0.1, 0.0, -0.2, -0.4, 0.9, 0.1), epsilon = 1e-14);
        let angle = Vector3::new(3e-11, -1e-11, 2e-11);
        let small = start.motion_to(&start.moved(Vector3::zeros(), angle));
        assert_relative_eq!(small.fixed_rows::<3>(3).into_owned(), angle, epsilon = 1e-15);
    }

    #[test]
    fn the_angle_between_two_poses_is_a_number_for_equal_rotations_and_half_turns() {
        let mut undefined = 0;
        for k in 0..1000 {
            let axis = Vector3::new(f64::from(k).sin(), f64::from(k).cos(), f64::from(k % 7) - 3.0);
            let start = Pose::at(0.0, 0.0, 0.0).moved(Vector3::zeros(), 0.7 * axis);
            let half = start.moved(Vector3::zeros(), axis.normalize() * std::f64::consts::PI);
            assert!(start.angle_to(&start) < 1e-7);
            assert!((start.angle_to(&half) - std::f64::consts::PI).abs() < 1e-7);
            let by_trace = [start, half].map(|end| start.rotation.angle_to(&end.rotation));
            undefined += by_trace.iter().filter(|angle| angle.is_nan()).count();
        }
        assert!(undefined > 0);
    }

    #[test]
    fn a_pose_moved_a_million_times_keeps_a_rotation() {
        let mut pose = Pose::at(0.0, 0.0, 0.0);
        for k in 0..1_000_000 {
            pose = pose.moved(Vector3::zeros(), Vector3::new(0.1, -0.2, 1e-6 * f64::from(k)));
        }
        let rotation = pose.rotation.matrix();
        assert_relative_eq!(rotation.transpose() * rotation, Matrix3::identity(), epsilon = 2e-15);
        assert_relative_eq!(rotation.determinant(), 1.0, epsilon = 2e-15);
    }

    #[test]
    fn a_zero_or_undefined_quaternion_is_refused() {
        assert!(Pose::with_quaternion(Vector3::zeros(), [0.0; 4]).is_none());
        assert!(Pose::with_quaternion(Vector3::zeros(), [f64::NAN, 0.0, 0.0, 0.0]).is_none());
        let half_turn = Pose::with_quaternion(Vector3::zeros(), [0.0, 0.0, 0.0, 2.0]).unwrap();
        assert_relative_eq!(half_turn.rotation * Vector3::x(), -Vector3::x(), epsilon = 1e-15);
    }

    #[test]
    fn a_pose_is_that_of_its_quaternion() {
        assert_eq!(Pose::at(1.0, 2.0, 3.0).quaternion(), [1.0, 0.0, 0.0, 0.0]);
        for quaternion in [[0.5, -0.5, 0.5, 0.5], [0.6, 0.0, -0.8, 0.0]] {
            let negative = quaternion.map(|component: f64| -component);
            let pose = Pose::with_quaternion(Vector3::zeros(), negative).unwrap();
            assert_relative_eq!(&pose.quaternion()[..], &quaternion[..], epsilon = 1e-15);
        }
    }
}
