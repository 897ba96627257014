//! Arguments that are more than a number or a path, as functions for clap, which names the argument and its value in what it
//! reports.

use cdpr_robot::{Pose, Vector3};

/// How results are printed.
#[derive(Clone, Copy, Debug, PartialEq, Eq, clap::ValueEnum)]
pub(crate) enum Format {
    /// Tables.
    Text,
    /// JSON, numbers to the last bit.
    Json,
}

/// A finite number.
pub(crate) fn number(text: &str) -> Result<f64, String> {
    let number = text.trim().parse().ok().filter(|number: &f64| number.is_finite());
    number.ok_or_else(|| format!("`{}` is not a finite number", text.trim()))
}

/// Finite numbers separated by commas.
pub(crate) fn numbers(text: &str) -> Result<Vec<f64>, String> {
    text.split(',').map(number).collect()
}

/// `x,y,z` [m], followed by the quaternion `qw,qx,qy,qz` where the platform is rotated.
pub(crate) fn pose(text: &str) -> Result<Pose, String> {
    let expected = "expected x,y,z [m] or x,y,z,qw,qx,qy,qz";
    let numbers = numbers(text).map_err(|error| format!("{error}: {expected}"))?;
    match numbers[..] {
        [x, y, z] => Ok(Pose::at(x, y, z)),
        [x, y, z, qw, qx, qy, qz] => Pose::with_quaternion(Vector3::new(x, y, z), [qw, qx, qy, qz])
            .ok_or_else(|| "the quaternion is zero: expected one that can be normalised".to_owned()),
        _ => Err(format!("{} numbers: {expected}", numbers.len())),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_pose_is_three_numbers_or_seven() {
        assert_eq!(pose("1,-2.5, 3e-1"), Ok(Pose::at(1.0, -2.5, 0.3)));
        let turned = pose("0,0,1,0,0,0,2").unwrap();
        assert!((turned.rotation * Vector3::x() + Vector3::x()).norm() < 1e-15);
        for (text, words) in [
            ("", "`` is not a finite number: expected x,y,z"),
            ("1,2", "2 numbers: expected x,y,z"),
            ("1,2,3,1", "4 numbers"),
            ("1,2,nan", "`nan` is not a finite number"),
            ("1,2,up", "`up` is not"),
            ("1,2,3,0,0,0,0", "the quaternion is zero"),
        ] {
            let error = pose(text).unwrap_err();
            assert!(error.starts_with(words), "{error}");
        }
    }
}
