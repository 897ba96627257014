//! Poses as they are typed and as headings state them.
//!
//! A rotation is a unit quaternion (w, x, y, z), or angles: R = Rz(yaw) Ry(pitch) Rx(roll).

use crate::program::arguments::{components, numbers};
use crate::program::error::{POSE, PoseError, ProgramError};
use crate::program::questions;
use cdpr_robot::{
    Pose, Rotation3, Vector3, plausible, rotation_by_angles, rotation_in_order, rotation_of, rounded,
};
use serde::{Serialize, Serializer};

/// `x,y,z` [m], followed by the quaternion `qw,qx,qy,qz` where the platform is rotated.
pub(crate) fn pose(text: &str) -> Result<Pose, PoseError> {
    pose_of(&numbers(text).map_err(|error| PoseError::Number(format!("{error}: {POSE}")))?)
}

/// The pose of three or seven finite numbers.
pub(crate) fn pose_of(numbers: &[f64]) -> Result<Pose, PoseError> {
    match *numbers {
        [x, y, z] => Ok(Pose::at(x, y, z)),
        [x, y, z, qw, qx, qy, qz] => {
            Ok(Pose { position: Vector3::new(x, y, z), rotation: rotation_in_order([qw, qx, qy, qz])? })
        }
        [_, _, _, roll, pitch, yaw] => Err(PoseError::Angles([roll, pitch, yaw])),
        _ => Err(PoseError::Count(numbers.len())),
    }
}

/// The pose of three or seven numbers of a field of a file, which states their order.
pub(crate) fn stated_pose(numbers: &[f64]) -> Result<Pose, PoseError> {
    match *numbers {
        [x, y, z, qw, qx, qy, qz] => {
            Ok(Pose { position: Vector3::new(x, y, z), rotation: rotation_of([qw, qx, qy, qz])? })
        }
        _ => pose_of(numbers),
    }
}

/// A rotation that is typed as its angles.
#[derive(clap::Args)]
pub(crate) struct Angles {
    /// Rotation by angles [degrees], without a quaternion in the pose: R = Rz(yaw) Ry(pitch) Rx(roll).
    #[arg(long, value_name = "ROLL,PITCH,YAW", value_parser = components::<3>, allow_hyphen_values = true)]
    rpy: Option<[f64; 3]>,
}

impl Angles {
    /// The rotation, if the angles are given. Angles of more than a turn are questioned.
    pub(crate) fn rotation(&self) -> Option<Rotation3<f64>> {
        let angles = self.rpy?;
        questions::ask(plausible::angles("--rpy", angles));
        Some(rotation_by_angles(angles))
    }
}

/// A pose as it is typed.
#[derive(clap::Args)]
pub(crate) struct PoseArguments {
    /// Pose of the platform: x,y,z [m], level or rotated by --rpy, or x,y,z,qw,qx,qy,qz with a quaternion.
    #[arg(long, alias = "start", value_parser = pose, allow_hyphen_values = true)]
    pose: Option<Pose>,
    #[command(flatten)]
    angles: Angles,
}

impl PoseArguments {
    /// The pose, if one is given, rotated by the angles if these are given.
    pub(crate) fn given(&self) -> Result<Option<Pose>, ProgramError> {
        match (self.pose, self.angles.rotation()) {
            (Some(pose), Some(_)) if !is_level(&pose) => Err(ProgramError::Usage(
                "the pose has a quaternion and --rpy: expected one of them".to_owned(),
            )),
            (Some(pose), Some(rotation)) => Ok(Some(Pose { rotation, ..pose })),
            (None, Some(_)) => {
                Err(ProgramError::Usage("--rpy rotates --pose: expected --pose, too".to_owned()))
            }
            (pose, None) => Ok(pose),
        }
    }

    /// The rotation of the platform at the positions of a region.
    pub(crate) fn rotation_of_region(&self) -> Result<Rotation3<f64>, ProgramError> {
        if self.pose.is_some() {
            let expected = "--pose: expected --region alone, and --rpy where the platform is rotated";
            return Err(ProgramError::Usage(expected.to_owned()));
        }
        Ok(self.angles.rotation().unwrap_or_else(Rotation3::identity))
    }

    /// The pose, which the command needs.
    pub(crate) fn needed(&self) -> Result<Pose, ProgramError> {
        self.given()?.ok_or_else(|| ProgramError::Usage("expected --pose x,y,z [m]".to_owned()))
    }
}

/// Whether the platform is not rotated.
fn is_level(pose: &Pose) -> bool {
    pose.rotation == Rotation3::identity()
}

/// Where a pose is, for a heading: its position, and its angles unless it is level.
pub(crate) fn place(pose: &Pose) -> String {
    let [x, y, z] = <[f64; 3]>::from(pose.position).map(|value| rounded(value, 6));
    let position = format!("({x}, {y}, {z}) m");
    if is_level(pose) {
        return position;
    }
    let (roll, pitch, yaw) = pose.rotation.euler_angles();
    let [roll, pitch, yaw] = [roll, pitch, yaw].map(|angle| rounded(angle.to_degrees(), 6));
    format!("{position}, roll {roll}, pitch {pitch}, yaw {yaw} degrees")
}

/// Names of the numbers of a pose in a table.
pub(crate) const COLUMNS: [&str; 7] = ["x_m", "y_m", "z_m", "qw", "qx", "qy", "qz"];

/// Position and quaternion (w, x, y, z), as [`pose`] reads them.
pub(crate) fn pose_numbers(pose: &Pose) -> [f64; 7] {
    let [x, y, z] = pose.position.into();
    let [qw, qx, qy, qz] = pose.quaternion();
    [x, y, z, qw, qx, qy, qz]
}

/// A pose in JSON: its numbers.
pub(crate) fn as_numbers<S: Serializer>(pose: &Option<Pose>, serializer: S) -> Result<S::Ok, S::Error> {
    pose.as_ref().map(pose_numbers).serialize(serializer)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_pose_is_three_numbers_or_seven() {
        for text in ["1,-2.5, 3e-1", "1 -2.5  3e-1", "1; -2.5; 0.3", "1;-2,5;0,3"] {
            assert_eq!(pose(text), Ok(Pose::at(1.0, -2.5, 0.3)), "{text}");
        }
        let turned = pose("0,0,1,0,0,1,0").unwrap();
        assert!((turned.rotation * Vector3::x() + Vector3::x()).norm() < 1e-15);
        for (text, words) in [
            ("", "`` is not a finite number: expected x,y,z"),
            ("1,2", "2 numbers: expected x,y,z"),
            ("1,2,3,0,0,90", "6 numbers: expected x,y,z [m]; angles go apart, `--rpy 0,0,90` [degrees]"),
            ("1,2,3,1", "4 numbers"),
            ("1,2,nan", "`nan` is not a finite number"),
            ("1,2,up", "`up` is not"),
            ("1,2,3,0,0,0,0", "the quaternion 0,0,0,0 is zero"),
        ] {
            let error = pose(text).unwrap_err().to_string();
            assert!(error.starts_with(words), "{error}");
        }
    }

    #[test]
    fn angles_turn_about_x_then_y_then_z() {
        let rotated = |pose: Pose, rpy: [f64; 3]| {
            PoseArguments { pose: Some(pose), angles: Angles { rpy: Some(rpy) } }.needed()
        };
        let turned = rotated(Pose::at(0.0, 0.0, 1.0), [90.0, 0.0, 90.0]).unwrap();
        // Rx takes y to z, which Rz keeps; Rx keeps x, which Rz takes to y.
        assert!((turned.rotation * Vector3::y() - Vector3::z()).norm() < 1e-15);
        assert!((turned.rotation * Vector3::x() - Vector3::y()).norm() < 1e-15);
        let pitched = rotated(Pose::at(0.0, 0.0, 1.0), [90.0, 90.0, 0.0]).unwrap();
        // Rx takes y to z, which Ry takes to x.
        assert!((pitched.rotation * Vector3::y() - Vector3::x()).norm() < 1e-15);
        assert!(rotated(turned, [0.0; 3]).is_err());
    }

    #[test]
    fn a_heading_has_the_angles_of_a_rotated_platform() {
        let level = Pose::at(0.0, -1.5, 2.0);
        assert_eq!(place(&level), "(0, -1.5, 2) m");
        let turned = Pose { rotation: rotation_by_angles([5.0, -10.0, 30.0]), ..level };
        assert_eq!(place(&turned), "(0, -1.5, 2) m, roll 5, pitch -10, yaw 30 degrees");
    }

    #[test]
    fn a_pose_is_read_as_it_is_written() {
        let turned = pose("1,2,3,0.5,0.5,-0.5,0.5").unwrap();
        assert!(
            (0..7)
                .all(|i| (pose_numbers(&turned)[i] - [1.0, 2.0, 3.0, 0.5, 0.5, -0.5, 0.5][i]).abs() < 1e-15)
        );
    }
}
