//! Rotations of quaternions as people write them: four numbers that may have another length or order.

use crate::number::rounded;
use nalgebra::{Quaternion, Rotation3, UnitQuaternion};

/// How far the length of a quaternion may be from 1: components with two decimals reach it.
const UNIT: f64 = 0.01;

/// The scalar of a rotation by 60 degrees: above it a quaternion is close to level.
const CLOSE_TO_LEVEL: f64 = 0.866;

/// Greatest qw and qx, and least other components, of what looks like a rotation about z with its scalar last.
const NO_COMPONENT: f64 = 1e-3;
const A_COMPONENT: f64 = 0.1;

/// Why four numbers are probably not the quaternion (w, x, y, z) that was meant.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[error("the quaternion {} {}: expected {}", self.value(), self.fault(), self.expected())]
pub enum QuaternionError {
    /// All components are zero, or one is not finite.
    Undefined {
        /// The quaternion.
        given: [f64; 4],
    },
    /// The length is not 1.
    Length {
        /// The quaternion.
        given: [f64; 4],
        /// Its length.
        length: f64,
    },
    /// It looks like (x, y, z, w): the first component is small and the last one large, or it is a rotation about
    /// z in that order, and a half turn that puts the platform on its side in this one.
    Order {
        /// The quaternion.
        given: [f64; 4],
        /// Its components in the other order.
        reordered: [f64; 4],
        /// Roll, pitch and yaw of the rotation as it was given [degrees].
        angles: [f64; 3],
    },
}

impl QuaternionError {
    /// The quaternion as it is typed.
    pub fn value(&self) -> String {
        let (Self::Undefined { given } | Self::Length { given, .. } | Self::Order { given, .. }) = self;
        words(given)
    }

    /// What is wrong with it.
    pub fn fault(&self) -> String {
        match self {
            Self::Undefined { .. } => "is zero or not finite".to_owned(),
            Self::Length { length, .. } => format!("has the length {length:.4}"),
            Self::Order { given: [_, _, _, qz], .. } if qz.abs() > CLOSE_TO_LEVEL => {
                "has a small qw and a large qz, as if it were qx,qy,qz,qw".to_owned()
            }
            Self::Order { .. } => {
                "has neither qw nor qx, as if it were qx,qy,qz,qw of a rotation about z".to_owned()
            }
        }
    }

    /// What would be right.
    pub fn expected(&self) -> String {
        match self {
            Self::Undefined { .. } => "one that can be normalized".to_owned(),
            Self::Length { given, length } => {
                format!("the length 1, such as {}", words(&given.map(|component| component / length)))
            }
            Self::Order { reordered, angles, .. } => format!(
                "qw,qx,qy,qz, which would be {}; or, if the platform is turned so far, its angles (roll, \
                 pitch, yaw) = {} degrees",
                words(reordered),
                words(angles)
            ),
        }
    }
}

/// The rotation of a quaternion (w, x, y, z) whose length is 1, except for the rounding of its components.
///
/// # Errors
/// [`QuaternionError::Undefined`] and [`QuaternionError::Length`].
pub fn rotation_of(given: [f64; 4]) -> Result<Rotation3<f64>, QuaternionError> {
    let [w, x, y, z] = given;
    let quaternion = UnitQuaternion::try_new(Quaternion::new(w, x, y, z), 1e-12)
        .filter(|quaternion| quaternion.coords.iter().all(|c| c.is_finite()))
        .ok_or(QuaternionError::Undefined { given })?;
    let length = given.iter().fold(0.0, |length: f64, component| length.hypot(*component));
    if (length - 1.0).abs() > UNIT {
        return Err(QuaternionError::Length { given, length });
    }
    Ok(quaternion.to_rotation_matrix())
}

/// The rotation of a quaternion without names beside its numbers: their order is questioned, too.
///
/// # Errors
/// [`QuaternionError`].
pub fn rotation_in_order(given: [f64; 4]) -> Result<Rotation3<f64>, QuaternionError> {
    let rotation = rotation_of(given)?;
    let [qw, qx, qy, qz] = given;
    let is_about_z = [qw, qx].iter().all(|c| c.abs() < NO_COMPONENT) && qy.abs().min(qz.abs()) > A_COMPONENT;
    if qz.abs() > CLOSE_TO_LEVEL || is_about_z {
        let (roll, pitch, yaw) = rotation.euler_angles();
        let angles = [roll, pitch, yaw].map(f64::to_degrees);
        return Err(QuaternionError::Order { given, reordered: [qz, qw, qx, qy], angles });
    }
    Ok(rotation)
}

/// The rotation of the angles roll, pitch, yaw [degrees]: R = Rz(yaw) Ry(pitch) Rx(roll).
pub fn rotation_by_angles(angles: [f64; 3]) -> Rotation3<f64> {
    let [roll, pitch, yaw] = angles.map(f64::to_radians);
    Rotation3::from_euler_angles(roll, pitch, yaw)
}

/// Numbers as they are typed.
fn words(numbers: &[f64]) -> String {
    numbers.iter().map(|number| rounded(*number, 6).to_string()).collect::<Vec<_>>().join(",")
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::f64::consts::FRAC_1_SQRT_2;

    #[test]
    fn a_quaternion_of_another_length_or_with_its_scalar_last_is_questioned() {
        let error = rotation_of([1.0, 1.0, 0.0, 0.0]).unwrap_err();
        assert!(error.to_string().ends_with("such as 0.707107,0.707107,0,0"), "{error}");
        assert!(rotation_of([0.0, 0.0, 0.0871557, 0.9961947]).is_ok());
        let error = rotation_in_order([0.0, 0.0, 0.0871557, 0.9961947]).unwrap_err();
        let words = "would be 0.996195,0,0,0.087156; or, if the platform is turned so far, its angles";
        assert!(error.to_string().contains(words), "{error}");
        // A rotation by 90 degrees about z as SciPy has it; with the scalar first it lies on its side.
        let error = rotation_in_order([0.0, 0.0, FRAC_1_SQRT_2, FRAC_1_SQRT_2]).unwrap_err().to_string();
        assert!(error.contains("would be 0.707107,0,0,0.707107") && error.contains("90,0,180"), "{error}");
        for undefined in [[0.0; 4], [f64::NAN, 0.0, 0.0, 1.0], [f64::INFINITY, 0.0, 0.0, 0.0]] {
            assert!(matches!(rotation_of(undefined), Err(QuaternionError::Undefined { .. })));
        }
        // As far as two decimals go, and a rotation by 100 degrees about z.
        // A planar platform that is upside down, too.
        let upside_down = [0.0, 0.0, 1.0, 0.0];
        let turned = [0.642788, 0.0, 0.0, 0.766044];
        for good in [[0.71, 0.71, 0.0, 0.0], [0.99, 0.0, 0.05, 0.1], turned, upside_down] {
            assert!(rotation_in_order(good).is_ok(), "{good:?}");
        }
    }
}
