//! How far a platform may tilt at a position: its orientation workspace.
//!
//! Towards the azimuth θ the platform is rotated by the angle α about the horizontal axis at right angles,
//!
//! ```text
//! R(α) = exp(α e_z x d(θ)) R,      d = (cos θ, sin θ, 0) in the level frame                         (W3)
//! ```
//!
//! so that its upward axis leans towards θ. α grows in steps of 15° while tensions within the limits,
//! recomputed, hold the platform ([`cdpr_statics::is_feasible`]); then bisection finds the angle at which
//! they end. A gap that lies between two steps is not seen. The orientation workspace of cable-driven robots
//! is defined so by Gouttefarde, Merlet, Daney (*Wrench-feasible workspace of parallel cable-driven
//! mechanisms*, ICRA 2007), as the orientations at a position that are wrench-feasible.

use cdpr_robot::{Matrix3, Plane, Pose, Robot, Rotation3, Vector3};
use cdpr_statics::{Load, StaticsError, inverse, is_feasible};
use std::f64::consts::{FRAC_PI_2, PI};

/// How far the platform may tilt in some directions.
#[derive(Clone, Debug, PartialEq)]
pub struct Tilt {
    /// Each direction, in the order of their azimuths.
    pub directions: Vec<TiltTowards>,
}

/// How far the platform may tilt towards a direction.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TiltTowards {
    /// Azimuth θ towards which the upward axis leans, from x to y of the level frame [rad].
    pub azimuth: f64,
    /// The angle reached [rad]: held there, and not at one that is larger by the accuracy; a right angle
    /// where nothing ends it before.
    pub angle: f64,
}

/// The rotation from the level frame to the base frame.
pub(crate) fn to_base(robot: &Robot) -> Matrix3<f64> {
    robot.gravity.level().map_or_else(Matrix3::identity, Matrix3::transpose)
}

impl TiltTowards {
    /// A pose tilted by this.
    pub fn of(&self, robot: &Robot, pose: &Pose) -> Pose {
        let axis = to_base(robot) * Vector3::new(-self.azimuth.sin(), self.azimuth.cos(), 0.0);
        Pose { rotation: Rotation3::new(self.angle * axis) * pose.rotation, ..*pose }
    }

    /// Whether nothing ends it below a right angle.
    pub fn is_free(&self) -> bool {
        self.angle >= FRAC_PI_2
    }
}

impl Tilt {
    /// The direction in which the platform may tilt least.
    pub fn least(&self) -> Option<&TiltTowards> {
        self.directions.iter().min_by(|a, b| a.angle.total_cmp(&b.angle))
    }
}

/// Steps of the angle [rad].
const STEP: f64 = 15.0 * PI / 180.0;

/// How far the platform may tilt from `pose` under `load` towards `directions` azimuths, equally spaced from
/// the x axis, to an `accuracy` [rad]. A planar robot has the two azimuths of its plane.
///
/// # Errors
/// - Those of [`cdpr_statics::inverse`] at the pose itself.
/// - [`StaticsError::Invalid`] for a platform that cannot tilt, an accuracy that is not positive, and without
///   directions.
pub fn tilt_at(
    robot: &Robot,
    pose: &Pose,
    load: &Load,
    directions: usize,
    accuracy: f64,
) -> Result<Tilt, StaticsError> {
    let invalid = |field: &str, value: String, expected: &str| StaticsError::Invalid {
        field: field.to_owned(),
        value,
        expected: expected.to_owned(),
    };
    let azimuths: Vec<f64> = match robot.plane {
        _ if robot.platform.point => {
            return Err(invalid("platform.point", "true".to_owned(), "a platform that can tilt"));
        }
        Some(Plane::Xy) => {
            return Err(invalid("plane", "\"xy\"".to_owned(), "one in which the platform can tilt"));
        }
        Some(Plane::Xz) => vec![0.0, PI],
        Some(Plane::Yz) => vec![FRAC_PI_2, 3.0 * FRAC_PI_2],
        None => (0..directions).map(|k| 2.0 * PI * k as f64 / directions as f64).collect(),
    };
    if azimuths.is_empty() {
        return Err(invalid("directions", "0".to_owned(), "one direction or more"));
    }
    if !(accuracy > 0.0 && accuracy.is_finite()) {
        return Err(invalid("accuracy", accuracy.to_string(), "a positive angle"));
    }
    if !is_feasible(robot, pose, load)? {
        inverse(robot, pose, load)?;
    }
    let towards = |azimuth: f64| {
        // What cannot be answered is not held.
        let holds = |angle| {
            is_feasible(robot, &TiltTowards { azimuth, angle }.of(robot, pose), load).unwrap_or(false)
        };
        TiltTowards { azimuth, angle: last_held(accuracy, holds) }
    };
    Ok(Tilt { directions: azimuths.into_iter().map(towards).collect() })
}

/// The largest angle that is held before the first that is not, to an accuracy [rad].
fn last_held(accuracy: f64, holds: impl Fn(f64) -> bool) -> f64 {
    let mut low = 0.0;
    let mut high = loop {
        let next = (low + STEP).min(FRAC_PI_2);
        if !holds(next) {
            break next;
        }
        if next == FRAC_PI_2 {
            return next;
        }
        low = next;
    };
    while high - low > accuracy {
        let middle = 0.5 * (low + high);
        if holds(middle) { low = middle } else { high = middle }
    }
    low
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_first_end_is_found_to_the_accuracy() {
        for end in [0.02, 0.3, 0.7, FRAC_PI_2] {
            let found = last_held(1e-4, |angle| angle <= end || angle > end + 0.4);
            assert!(found <= end && found > end - 1e-4, "{found} {end}");
        }
    }
}
