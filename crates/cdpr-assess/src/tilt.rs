//! How far a platform may tilt at a position: its orientation workspace.
//!
//! Towards the azimuth θ the platform is rotated by the angle α about the horizontal axis at right angles,
//!
//! ```text
//! R(α) = exp(α e_z x d(θ)) R,      d = (cos θ, sin θ, 0) in the level frame                         (W3)
//! ```
//!
//! so that its upward axis leans towards θ. As α grows from zero, the margin of the tensions distributed anew
//! ([`cdpr_statics::tension_margin`]) falls and meets zero where no tensions within the limits hold the
//! platform any longer. Steps of at most 15° see to it that this is the first such angle, of margins that
//! change over such an angle; a secant and bisections find it. The orientation workspace of cable-driven
//! robots is defined so by Gouttefarde, Merlet, Daney (*Wrench-feasible workspace of parallel cable-driven
//! mechanisms*, ICRA 2007), as the orientations at a position that are wrench-feasible.

use cdpr_robot::{Matrix3, Plane, Pose, Robot, Rotation3, Vector3};
use cdpr_statics::{Blocking, Load, StaticsError, tension_margin};
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
    /// where no limit ends it before.
    pub angle: f64,
    /// The limit next to the tensions there; `None` at a right angle.
    pub blocking: Option<Blocking>,
}

impl Tilt {
    /// The direction in which the platform may tilt least.
    pub fn least(&self) -> Option<&TiltTowards> {
        self.directions.iter().min_by(|a, b| a.angle.total_cmp(&b.angle))
    }
}

/// Largest step of the angle [rad].
const STEP: f64 = 15.0 * PI / 180.0;

/// How far the platform may tilt from `pose` under `load` towards `directions` azimuths, equally spaced from
/// the x axis, to an `accuracy` [rad]. A planar robot has the two azimuths of its plane.
///
/// # Errors
/// - Those of [`cdpr_statics::tension_margin`] at the pose itself.
/// - [`StaticsError::NoTensions`] where no tensions within the limits hold it there.
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
    let level = tension_margin(robot, pose, load)?;
    if level.value < 0.0 {
        // Says what is missing.
        cdpr_statics::inverse(robot, pose, load, None)?;
    }
    let to_base = robot.gravity.level().map_or_else(Matrix3::identity, Matrix3::transpose);
    let first = Reached { angle: 0.0, margin: level.value, blocking: level.blocking.first().copied() };
    let towards = |azimuth: f64| {
        let axis = to_base * Vector3::new(-azimuth.sin(), azimuth.cos(), 0.0);
        let at = |angle: f64| {
            let rotation = Rotation3::new(angle * axis) * pose.rotation;
            match tension_margin(robot, &Pose { rotation, ..*pose }, load) {
                Ok(found) => {
                    Some(Reached { angle, margin: found.value, blocking: found.blocking.first().copied() })
                }
                // Held nevertheless.
                Err(StaticsError::InverseNotConverged { .. }) => {
                    Some(Reached { angle, margin: 0.0, blocking: None })
                }
                Err(_) => None,
            }
        };
        let Reached { angle, blocking, .. } = first_limit(first, accuracy, at);
        TiltTowards { azimuth, angle, blocking: blocking.filter(|_| angle < FRAC_PI_2) }
    };
    Ok(Tilt { directions: azimuths.into_iter().map(towards).collect() })
}

/// An angle [rad] with its margin [N].
#[derive(Clone, Copy)]
struct Reached {
    angle: f64,
    margin: f64,
    blocking: Option<Blocking>,
}

/// The largest angle before the first at which the margin is negative or does not exist.
fn first_limit(first: Reached, accuracy: f64, at: impl Fn(f64) -> Option<Reached>) -> Reached {
    let (mut low, mut before) = (first, None);
    let mut high: Option<(f64, Option<Reached>)> = None;
    let mut bisect = false;
    loop {
        // Where the margin would be zero by the last two that are known.
        let other = high.map_or(before, |(_, reached)| reached);
        let foreseen = other.and_then(|other: Reached| {
            let slope = (other.margin - low.margin) / (other.angle - low.angle);
            (slope < 0.0).then(|| low.angle - low.margin / slope)
        });
        let next = match high {
            Some((end, _)) if end - low.angle <= accuracy => return low,
            Some((end, _)) => match foreseen {
                // Beyond the root, so that it is enclosed.
                Some(root) if !bisect => {
                    (root + 0.4 * accuracy).clamp(low.angle + 0.5 * accuracy, end - 0.5 * accuracy)
                }
                _ => 0.5 * (low.angle + end),
            },
            None if low.angle >= FRAC_PI_2 => return low,
            None => {
                let step = foreseen.map_or(STEP, |root| root + 0.4 * accuracy - low.angle);
                (low.angle + step.clamp(accuracy, STEP)).min(FRAC_PI_2)
            }
        };
        let width = high.map(|(end, _)| end - low.angle);
        match at(next) {
            Some(reached) if reached.margin >= 0.0 => (low, before) = (reached, Some(low)),
            reached => high = Some((next, reached)),
        }
        // A secant that does not halve the interval is followed by a bisection.
        bisect = matches!((width, high), (Some(width), Some((end, _))) if end - low.angle > 0.5 * width);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_first_root_is_found_to_the_accuracy() {
        type Margin = fn(f64) -> f64;
        let margins: [(Margin, f64); 4] = [
            (|angle| 1.0 - 2.0 * angle, 0.5),
            (|angle| (0.3 - angle) * (1.0 + angle), 0.3),
            (|angle| if angle < 0.7 { 1e-3 } else { -100.0 }, 0.7),
            (|_| 1.0, FRAC_PI_2),
        ];
        for (margin, root) in margins {
            let at = |angle| Some(Reached { angle, margin: margin(angle), blocking: None });
            let first = Reached { angle: 0.0, margin: margin(0.0), blocking: None };
            let found = first_limit(first, 1e-4, at);
            assert!(found.angle <= root && found.angle > root - 1e-4, "{} {root}", found.angle);
            // A margin that ends does as well.
            let ends = |angle: f64| at(angle).filter(|reached| reached.margin >= 0.0);
            assert!((first_limit(first, 1e-4, ends).angle - root).abs() <= 1e-4);
        }
    }
}
