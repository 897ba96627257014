//! Poses as they are typed, as files list them and as headings state them.
//!
//! A rotation is a unit quaternion (w, x, y, z), or angles: R = Rz(yaw) Ry(pitch) Rx(roll).

use crate::arguments::{components, number, numbers};
use crate::error::{POSE, PoseError, ProgramError};
use cdpr_robot::{Pose, Rotation3, Vector3, rotation_by_angles, rotation_in_order, rotation_of, rounded};
use cdpr_study::{InputKind, read_text};
use csv::{ReaderBuilder, StringRecord, Trim};
use std::path::Path;

/// `x,y,z` [m], followed by the quaternion `qw,qx,qy,qz` where the platform is rotated.
pub(crate) fn pose(text: &str) -> Result<Pose, PoseError> {
    pose_of(&numbers(text).map_err(|error| PoseError::Number(format!("{error}: {POSE}")))?)
}

/// `qw,qx,qy,qz`.
pub(crate) fn rotation(text: &str) -> Result<Rotation3<f64>, PoseError> {
    Ok(rotation_in_order(components(text).map_err(PoseError::Number)?)?)
}

/// The pose of three or seven finite numbers.
pub(crate) fn pose_of(numbers: &[f64]) -> Result<Pose, PoseError> {
    match *numbers {
        [x, y, z] => Ok(Pose::at(x, y, z)),
        [x, y, z, qw, qx, qy, qz] => {
            Ok(Pose { position: Vector3::new(x, y, z), rotation: rotation_in_order([qw, qx, qy, qz])? })
        }
        _ => Err(PoseError::Count(numbers.len())),
    }
}

/// A rotation that is typed as its angles.
#[derive(clap::Args)]
pub(crate) struct Angles {
    /// Rotation by angles [degrees] in place of a quaternion: R = Rz(yaw) Ry(pitch) Rx(roll).
    #[arg(long, num_args = 3, value_names = ["ROLL", "PITCH", "YAW"], value_parser = number)]
    #[arg(allow_negative_numbers = true)]
    rpy: Option<Vec<f64>>,
}

impl Angles {
    /// The rotation, if the angles are given.
    pub(crate) fn rotation(&self) -> Option<Rotation3<f64>> {
        let [roll, pitch, yaw] = *self.rpy.as_deref()? else { return None };
        Some(rotation_by_angles([roll, pitch, yaw]))
    }

    /// The pose, rotated by the angles if they are given.
    pub(crate) fn of(&self, pose: &Pose) -> Result<Pose, ProgramError> {
        match self.rotation() {
            Some(_) if !is_level(pose) => Err(ProgramError::Usage(
                "the pose has a quaternion and --rpy: expected one of them".to_owned(),
            )),
            Some(rotation) => Ok(Pose { rotation, ..*pose }),
            None => Ok(*pose),
        }
    }
}

/// Whether the platform is not rotated.
fn is_level(pose: &Pose) -> bool {
    pose.rotation == Rotation3::identity()
}

/// Where a pose is, for a heading: its position, and its angles unless it is level.
pub(crate) fn place(pose: &Pose) -> String {
    let [x, y, z] = pose.position.into();
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

/// Poses from a file (CSV), one a line below a header; plain numbers need no header.
pub(crate) fn pose_file(path: &Path) -> Result<Vec<Pose>, ProgramError> {
    let text = read_text(path, InputKind::Poses)?;
    let mut lines =
        ReaderBuilder::new().has_headers(false).flexible(true).trim(Trim::All).from_reader(text.as_bytes());
    let mut columns = None;
    let mut poses = Vec::new();
    let mut start = lines.position().byte();
    let mut record = StringRecord::new();
    let at = |start, reason| ProgramError::Poses {
        path: path.to_owned(),
        line: line(&text, start),
        reason: Box::new(reason),
    };
    let unread = |start, error: csv::Error| at(start, PoseError::Number(error.to_string()));
    while lines.read_record(&mut record).map_err(|error| unread(start, error))? {
        let is_empty = record.iter().all(str::is_empty);
        let has_no_number = record.iter().all(|cell| number(cell).is_err());
        if !is_empty && has_no_number && columns.is_none() && poses.is_empty() {
            columns = Some(Columns::of(&record).map_err(|reason| at(start, reason))?);
        } else if !is_empty {
            poses.push(row(columns.as_ref(), &record).map_err(|reason| at(start, reason))?);
        }
        start = lines.position().byte();
    }
    if poses.is_empty() {
        let empty = "--poses: the file is empty, expected a pose on each line";
        return Err(ProgramError::Usage(empty.to_owned()));
    }
    Ok(poses)
}

/// Number of the line that begins at a byte or, where empty lines begin there, follows them.
fn line(text: &str, start: u64) -> usize {
    let rest = text.get(start as usize..).unwrap_or_default().trim_start();
    1 + text[..text.len() - rest.len()].matches('\n').count()
}

/// The pose of a line.
fn row(columns: Option<&Columns>, record: &StringRecord) -> Result<Pose, PoseError> {
    let numbers: Vec<f64> =
        record.iter().map(|cell| number(cell).map_err(PoseError::Number)).collect::<Result<_, _>>()?;
    columns.map_or_else(|| pose_of(&numbers), |columns| columns.pose(&numbers))
}

/// Where the numbers of a pose stand in a line: x, y, z, and a quaternion or angles.
struct Columns(Vec<usize>);

impl Columns {
    fn of(header: &StringRecord) -> Result<Self, PoseError> {
        let names: Vec<_> = header.iter().map(|name| name.strip_suffix("_m").unwrap_or(name)).collect();
        let rotations: [&[&str]; 3] = [&[], &["qw", "qx", "qy", "qz"], &["roll_deg", "pitch_deg", "yaw_deg"]];
        let found = rotations.iter().find_map(|rotation| {
            let wanted = ["x", "y", "z"].iter().chain(*rotation);
            let places: Option<Vec<_>> =
                wanted.map(|one| names.iter().position(|name| name == one)).collect();
            places.filter(|places| places.len() == names.len())
        });
        let given = || header.iter().collect::<Vec<_>>().join(",");
        found.map(Self).ok_or_else(|| PoseError::Columns(given()))
    }

    fn pose(&self, numbers: &[f64]) -> Result<Pose, PoseError> {
        let ordered: Option<Vec<f64>> = self.0.iter().map(|place| numbers.get(*place).copied()).collect();
        let ordered = ordered.filter(|_| numbers.len() == self.0.len());
        let rotated = |x, y, z, rotation| Pose { position: Vector3::new(x, y, z), rotation };
        match ordered.as_deref() {
            Some(&[x, y, z]) => Ok(Pose::at(x, y, z)),
            Some(&[x, y, z, roll, pitch, yaw]) => {
                Ok(rotated(x, y, z, rotation_by_angles([roll, pitch, yaw])))
            }
            Some(&[x, y, z, qw, qx, qy, qz]) => Ok(rotated(x, y, z, rotation_of([qw, qx, qy, qz])?)),
            _ => Err(PoseError::Number(format!(
                "{} numbers: expected {}, one below each name",
                numbers.len(),
                self.0.len()
            ))),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_pose_is_three_numbers_or_seven() {
        assert_eq!(pose("1,-2.5, 3e-1"), Ok(Pose::at(1.0, -2.5, 0.3)));
        let turned = pose("0,0,1,0,0,1,0").unwrap();
        assert!((turned.rotation * Vector3::x() + Vector3::x()).norm() < 1e-15);
        for (text, words) in [
            ("", "`` is not a finite number: expected x,y,z"),
            ("1,2", "2 numbers: expected x,y,z"),
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
        let angles = |rpy: [f64; 3]| Angles { rpy: Some(rpy.to_vec()) };
        let turned = angles([90.0, 0.0, 90.0]).of(&Pose::at(0.0, 0.0, 1.0)).unwrap();
        // Rx takes y to z, which Rz keeps; Rx keeps x, which Rz takes to y.
        assert!((turned.rotation * Vector3::y() - Vector3::z()).norm() < 1e-15);
        assert!((turned.rotation * Vector3::x() - Vector3::y()).norm() < 1e-15);
        let pitched = angles([90.0, 90.0, 0.0]).of(&Pose::at(0.0, 0.0, 1.0)).unwrap();
        // Rx takes y to z, which Ry takes to x.
        assert!((pitched.rotation * Vector3::y() - Vector3::x()).norm() < 1e-15);
        assert!(angles([0.0; 3]).of(&turned).is_err());
    }

    #[test]
    fn a_heading_has_the_angles_of_a_rotated_platform() {
        let level = Pose::at(0.0, -1.5, 2.0);
        assert_eq!(place(&level), "(0, -1.5, 2) m");
        let turned = Angles { rpy: Some(vec![5.0, -10.0, 30.0]) }.of(&level).unwrap();
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
