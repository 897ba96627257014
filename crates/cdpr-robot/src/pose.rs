//! Pose of the platform and wrench on it.

use nalgebra::{Quaternion, Rotation3, UnitQuaternion, Vector3, Vector6};

/// Position and orientation of the platform frame in the base frame.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Pose {
    /// Position p of the platform's reference point P in the base frame [m].
    pub position: Vector3<f64>,
    /// Rotation R from the platform frame to the base frame.
    pub rotation: Rotation3<f64>,
}

impl Pose {
    /// The pose at (x, y, z) [m], not rotated.
    pub fn at(x: f64, y: f64, z: f64) -> Self {
        Self { position: Vector3::new(x, y, z), rotation: Rotation3::identity() }
    }

    /// The pose with a unit quaternion (w, x, y, z), which is normalised. `None` if it is zero or not finite.
    pub fn with_quaternion(position: Vector3<f64>, [w, x, y, z]: [f64; 4]) -> Option<Self> {
        let quaternion = UnitQuaternion::try_new(Quaternion::new(w, x, y, z), 1e-12)?;
        let finite = quaternion.coords.iter().chain(position.iter()).all(|c| c.is_finite());
        finite.then(|| Self { position, rotation: quaternion.to_rotation_matrix() })
    }

    /// Its rotation as a unit quaternion (w, x, y, z), w >= 0: the inverse of [`Pose::with_quaternion`].
    pub fn quaternion(&self) -> [f64; 4] {
        let quaternion = UnitQuaternion::from_rotation_matrix(&self.rotation);
        let sign = if quaternion.w < 0.0 { -1.0 } else { 1.0 };
        // Adding 0 turns -0 into 0.
        [quaternion.w, quaternion.i, quaternion.j, quaternion.k].map(|component| sign * component + 0.0)
    }

    /// The pose moved by `translation` [m] and turned by the rotation vector `rotation` [rad], both in the base frame:
    /// `p + dp`, `exp(dphi) R`.
    #[inline]
    pub fn moved(&self, translation: Vector3<f64>, rotation: Vector3<f64>) -> Self {
        Self { position: self.position + translation, rotation: Rotation3::new(rotation) * self.rotation }
    }

    /// The motion (dp, dphi) [m, rad] from this pose to another, in the base frame: the inverse of [`Pose::moved`].
    #[inline]
    pub fn motion_to(&self, other: &Self) -> Vector6<f64> {
        let translation = other.position - self.position;
        // Through the quaternion: the angle of a matrix comes from its trace, which knows nothing of small turns.
        let turn = other.rotation * self.rotation.inverse();
        let rotation = UnitQuaternion::from_rotation_matrix(&turn).scaled_axis();
        Vector6::new(translation.x, translation.y, translation.z, rotation.x, rotation.y, rotation.z)
    }

    /// Whether all components are finite.
    #[inline]
    pub fn is_finite(&self) -> bool {
        self.position.iter().chain(self.rotation.matrix().iter()).all(|c| c.is_finite())
    }
}

/// Force and moment on the platform, in the base frame, the moment about P.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Wrench {
    /// Force [N].
    pub force: Vector3<f64>,
    /// Moment about P [N m].
    pub moment: Vector3<f64>,
}

impl Wrench {
    /// No force, no moment.
    #[inline]
    pub fn zero() -> Self {
        Self { force: Vector3::zeros(), moment: Vector3::zeros() }
    }

    /// (force, moment) as one vector [N, N m].
    pub fn to_vector(&self) -> Vector6<f64> {
        Vector6::new(self.force.x, self.force.y, self.force.z, self.moment.x, self.moment.y, self.moment.z)
    }

    /// From (force, moment) [N, N m].
    pub fn from_vector(v: &Vector6<f64>) -> Self {
        Self { force: Vector3::new(v[0], v[1], v[2]), moment: Vector3::new(v[3], v[4], v[5]) }
    }
}

impl std::ops::Add for Wrench {
    type Output = Self;

    fn add(self, other: Self) -> Self {
        Self { force: self.force + other.force, moment: self.moment + other.moment }
    }
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
        let turn = Vector3::new(3e-11, -1e-11, 2e-11);
        let small = start.motion_to(&start.moved(Vector3::zeros(), turn));
        assert_relative_eq!(small.fixed_rows::<3>(3).into_owned(), turn, epsilon = 1e-15);
    }

    #[test]
    fn a_quaternion_that_is_none_is_refused() {
        assert!(Pose::with_quaternion(Vector3::zeros(), [0.0; 4]).is_none());
        assert!(Pose::with_quaternion(Vector3::zeros(), [f64::NAN, 0.0, 0.0, 0.0]).is_none());
        let half_turn = Pose::with_quaternion(Vector3::zeros(), [0.0, 0.0, 0.0, 2.0]).unwrap();
        assert_relative_eq!(half_turn.rotation * Vector3::x(), -Vector3::x(), epsilon = 1e-15);
    }

    #[test]
    fn the_quaternion_of_a_pose_gives_the_pose_again() {
        assert_eq!(Pose::at(1.0, 2.0, 3.0).quaternion(), [1.0, 0.0, 0.0, 0.0]);
        for quaternion in [[0.5, -0.5, 0.5, 0.5], [0.6, 0.0, -0.8, 0.0]] {
            let negative = quaternion.map(|component: f64| -component);
            let pose = Pose::with_quaternion(Vector3::zeros(), negative).unwrap();
            assert_relative_eq!(&pose.quaternion()[..], &quaternion[..], epsilon = 1e-15);
        }
    }
}
