//! Gravity in the base frame, and the level frame in which it points down.
//!
//! With the unit vector `u = -γ/|γ|` against the acceleration γ, the level frame has u as its z axis. Of all
//! rotations that take u to the z axis the least one turns about `u x e_z`:
//!
//! ```text
//! h = √(u_x² + u_y²),  (c, s) = (u_x, u_y)/h,  κ = 1 - u_z = h²/(1 + u_z)
//!     [ 1 - c² κ   -c s κ     -u_x ]
//! T = [ -c s κ     1 - s² κ   -u_y ]        coordinates in the level frame from those in the base frame
//!     [ u_x        u_y         u_z ]
//! ```
//!
//! Where gravity points straight upwards, every half turn about a horizontal axis is least; T is the one
//! about the y axis.

use crate::error::RobotError;
use nalgebra::{Matrix3, Vector3};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// Acceleration due to gravity, uniform in space: a number along -z of the base frame, or a vector.
///
/// As data it is what it was made from, a number or a list of three [m/s²].
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(from = "Given", into = "Given")]
#[schemars(with = "Given")]
pub struct Gravity {
    given: Given,
    magnitude: f64,
    /// Rotation to the level frame; `None` where it is the base frame.
    level: Option<Matrix3<f64>>,
}

/// Acceleration due to gravity [m/s²]: a number is along -z of the base frame, a list is a vector in it.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(untagged, expecting = "expected a number [m/s²] or a vector of three in the base frame")]
#[schemars(inline)]
enum Given {
    Magnitude(f64),
    Vector([f64; 3]),
}

impl Gravity {
    /// Standard acceleration of free fall [m/s²] (3rd General Conference on Weights and Measures, 1901),
    /// where no robot gives another one.
    pub const STANDARD: f64 = 9.80665;

    /// Magnitude [m/s²].
    #[inline]
    pub fn magnitude(&self) -> f64 {
        self.magnitude
    }

    /// The acceleration in the base frame [m/s²].
    #[inline]
    pub fn vector(&self) -> Vector3<f64> {
        match self.given {
            Given::Magnitude(g) => Vector3::new(0.0, 0.0, -g),
            Given::Vector(vector) => vector.into(),
        }
    }

    /// Whether it was given as a vector. Only then its components are parameters of a robot.
    pub fn is_vector(&self) -> bool {
        matches!(self.given, Given::Vector(_))
    }

    /// The rotation from the base frame to the level frame, whose z axis points against gravity: the least
    /// one.
    ///
    /// `None` where the base is level: gravity along -z, or zero.
    #[inline]
    pub fn level(&self) -> Option<&Matrix3<f64>> {
        self.level.as_ref()
    }

    /// Angle between gravity and -z of the base frame [rad], 0 to π; zero without gravity.
    pub fn tilt(&self) -> f64 {
        let vector = self.vector() / self.magnitude.max(f64::MIN_POSITIVE);
        // Not -z: the angle of a negative zero is π.
        vector.xy().norm().atan2(0.0 - vector.z)
    }

    /// Whether the base is level: its z axis points against gravity, up to rounding, or there is no gravity.
    pub fn is_base_level(&self) -> bool {
        self.tilt() <= LEVEL
    }

    /// Checks that gravity is finite, and not negative where it is a number.
    pub(crate) fn validate(&self) -> Result<(), RobotError> {
        match self.given {
            Given::Magnitude(g) if !(g.is_finite() && g >= 0.0) => {
                Err(RobotError::invalid("gravity", g, "a finite number, zero or more [m/s²]"))
            }
            Given::Vector(vector) => match vector.iter().position(|component| !component.is_finite()) {
                Some(axis) => {
                    let expected = "a finite component [m/s²]";
                    Err(RobotError::invalid(format!("gravity[{axis}]"), vector[axis], expected))
                }
                None if !self.magnitude.is_finite() => {
                    let expected = "a vector of finite length [m/s²]";
                    Err(RobotError::invalid("gravity", format!("{vector:?}"), expected))
                }
                None => Ok(()),
            },
            Given::Magnitude(_) => Ok(()),
        }
    }
}

/// Greatest tilt of a level base [rad]: rounding of a vector.
const LEVEL: f64 = 1e-9;

/// Along -z of the base frame.
impl From<f64> for Gravity {
    fn from(magnitude: f64) -> Self {
        Self { given: Given::Magnitude(magnitude), magnitude, level: None }
    }
}

/// A vector in the base frame.
impl From<Vector3<f64>> for Gravity {
    fn from(vector: Vector3<f64>) -> Self {
        // The square of a component may be out of range where the component is not.
        let size = vector.amax();
        let magnitude = if size > 0.0 { size * (vector / size).norm() } else { 0.0 };
        let is_level = vector.x == 0.0 && vector.y == 0.0 && vector.z <= 0.0;
        let level = (!is_level).then(|| to_level(&(vector / -size).normalize()));
        Self { given: Given::Vector(vector.into()), magnitude, level }
    }
}

impl From<Given> for Gravity {
    fn from(given: Given) -> Self {
        match given {
            Given::Magnitude(magnitude) => magnitude.into(),
            Given::Vector(vector) => Vector3::from(vector).into(),
        }
    }
}

impl From<Gravity> for Given {
    fn from(gravity: Gravity) -> Self {
        gravity.given
    }
}

/// The least rotation that takes the unit vector `up` to the z axis.
fn to_level(up: &Vector3<f64>) -> Matrix3<f64> {
    let horizontal = up.xy().norm();
    let (c, s) = if horizontal > 0.0 { (up.x / horizontal, up.y / horizontal) } else { (1.0, 0.0) };
    // 1 - u_z without cancellation
    let k = if up.z > 0.0 { horizontal * horizontal / (1.0 + up.z) } else { 1.0 - up.z };
    Matrix3::new(1.0 - c * c * k, -c * s * k, -up.x, -c * s * k, 1.0 - s * s * k, -up.y, up.x, up.y, up.z)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_level_frame_has_gravity_along_its_negative_z_axis() {
        for vector in [
            Vector3::new(0.3, 0.0, -9.8),
            Vector3::new(-4.0, 7.0, -0.1),
            Vector3::new(1e-9, -2e-9, -9.81),
            Vector3::new(1e-9, 2e-9, 9.81),
            Vector3::new(0.0, -3.0, 0.0),
            Vector3::new(0.0, 0.0, 1.62),
            Vector3::new(1e-200, 0.0, 1e-200),
            Vector3::new(1e200, 1e200, 1e200),
        ] {
            let gravity = Gravity::from(vector);
            let level = gravity.level().unwrap();
            let (g, size) = (gravity.magnitude(), vector.amax());
            assert!(((level * (vector / size)) + Vector3::z() * (g / size)).norm() < 1e-15 * 4.0, "{vector}");
            assert!((level * level.transpose() - Matrix3::identity()).norm() < 2e-15, "{vector}");
            assert!((level.determinant() - 1.0).abs() < 2e-15, "{vector}");
            // The least rotation turns by no more than the tilt.
            assert!((level.trace() - (1.0 + 2.0 * gravity.tilt().cos())).abs() < 4e-15, "{vector}");
        }
    }

    #[test]
    fn gravity_along_negative_z_is_level_however_it_is_given() {
        let (number, vector) = (Gravity::from(9.81), Gravity::from(Vector3::new(0.0, -0.0, -9.81)));
        assert_eq!((number.level(), vector.level()), (None, None));
        assert_eq!(number.magnitude().to_bits(), vector.magnitude().to_bits());
        assert_eq!(number.vector(), vector.vector());
        assert!(vector.is_vector() && !number.is_vector());
        assert_eq!(Gravity::from(Vector3::zeros()).level(), None);
        for (level, vector) in [
            (true, Vector3::zeros()),
            (true, Vector3::new(5e-10, 0.0, -9.81)),
            (false, Vector3::new(1e-7, 0.0, -9.81)),
            (false, Vector3::new(0.0, 0.0, 9.81)),
        ] {
            assert_eq!(Gravity::from(vector).is_base_level(), level, "{vector}");
        }
        assert_eq!(Gravity::from(Vector3::new(0.0, 0.0, 1.0)).tilt(), std::f64::consts::PI);
    }
}
