//! What is measured at the poses of a calibration.

use crate::campaign::Noise;
use crate::error::CalibrationError;
use cdpr_robot::Robot;

/// What is measured at every pose, with the standard deviation of its noise.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Measurement {
    /// The pose, or the position alone, where the platform stands with the lengths of the nominal robot.
    Pose {
        /// Noise of each coordinate [m].
        position: f64,
        /// Noise of each component of the rotation [rad]; `None` where it is not measured, as of one
        /// reflector, and of a point mass, which has no rotation.
        rotation: Option<f64>,
    },
    /// The tensions at the platform there; noise [N].
    Tensions(f64),
    /// The lengths are not exact, but measured with this noise [m]. Alone they identify nothing.
    Lengths(f64),
}

impl Measurement {
    /// Measurements of a robot by the names of their noise: position, with or without rotation, tensions,
    /// lengths.
    ///
    /// # Errors
    /// [`CalibrationError::Invalid`] for another name, for rotation without position, for the rotation of a
    /// point mass, and for length alone.
    pub fn named(robot: &Robot, named: &[(String, f64)]) -> Result<Vec<Self>, CalibrationError> {
        let noise = Noise::named(named)?;
        const NAMES: [&str; 4] = ["position", "rotation", "tension", "length"];
        if let Some((name, value)) = named.iter().find(|(name, _)| !NAMES.contains(&Noise::sensor(name))) {
            let expected = format!("one of {}", NAMES.join(", "));
            return Err(CalibrationError::invalid(format!("noise {name}"), value, expected));
        }
        let pose = match (noise.position, noise.rotation) {
            (_, Some(rotation)) if robot.platform.point => {
                let expected = "no such noise: a point mass has no rotation, position alone is its pose";
                return Err(CalibrationError::invalid("noise rotation", rotation, expected));
            }
            (Some(position), rotation) => Some(Self::Pose { position, rotation }),
            (None, None) => None,
            (None, Some(rotation)) => {
                return Err(CalibrationError::invalid("noise rotation", rotation, "position, too"));
            }
        };
        if pose.is_none() && noise.tension.is_none() && noise.length.is_some() {
            return Err(Self::lengths_alone());
        }
        let others = [noise.tension.map(Self::Tensions), noise.length.map(Self::Lengths)];
        Ok(pose.into_iter().chain(others.into_iter().flatten()).collect())
    }

    pub(super) fn lengths_alone() -> CalibrationError {
        let expected = "position or tension, too: lengths say where the platform is, no more";
        CalibrationError::invalid("noise", "of length alone", expected)
    }
}
