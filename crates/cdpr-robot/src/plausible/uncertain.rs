//! Doubts about deviations and about the noise of measurements.

use super::doubt::{Doubt, capacity, four_digits, frame_size, reach};
use crate::parameter::Parameter;
use crate::robot::Robot;

/// Noise of a distance over the size of the frame.
const DISTANCE: f64 = 0.01;
/// Noise of an angle [rad].
const ANGLE: f64 = 0.1;
/// A mean this near to the value itself, relative to it, is the value.
const SAME: f64 = 1e-3;
/// Differences of equal numbers, relative to them.
const ROUNDING: f64 = 1e-9;
/// Least standard deviation of a modulus over the modulus.
const LEAST_MODULUS: f64 = 1e-6;

/// What deviations of a parameter are compared with.
struct Scale {
    /// Greatest mean or standard deviation that is no reason for a question.
    most: f64,
    /// What `most` is, for people.
    of: String,
}

/// What deviations of a parameter are compared with; `None` where nothing is known.
fn scale(robot: &Robot, parameter: Parameter) -> Option<Scale> {
    let nominal = parameter.nominal(robot).abs();
    let (frame, platform) = (frame_size(robot), reach(robot));
    let share = |share: f64, of: f64, what: &str| Scale {
        most: share * of,
        of: format!("{} % of {what}, {} {}", 100.0 * share, four_digits(of), parameter.unit()),
    };
    let of_frame = || share(0.02, frame, "the size of the frame");
    let scale = match parameter {
        Parameter::Mass | Parameter::LinearDensity | Parameter::YoungsModulus => {
            share(0.5, nominal, "the value itself")
        }
        Parameter::AnchorPoint(..) if platform > 0.0 => share(0.2, platform, "the reach of the platform"),
        Parameter::CenterOfMass(_) if platform > 0.0 => share(0.5, platform, "the reach of the platform"),
        Parameter::AnchorPoint(..) | Parameter::CenterOfMass(_) | Parameter::ExitPoint(..) => of_frame(),
        Parameter::PulleyRadius(_) | Parameter::Lead(_) if nominal > 0.0 => {
            share(0.5, nominal, "the value itself")
        }
        Parameter::PulleyRadius(_) | Parameter::Lead(_) => of_frame(),
        Parameter::TensionOffset(i) => share(0.5, robot.limits(i).max, "the greatest tension"),
        Parameter::Tilt(..) => Scale { most: 0.35, of: "0.35 rad, 20 degrees".to_owned() },
        Parameter::Gravity(_) => share(0.2, robot.gravity.magnitude(), "gravity"),
    };
    (scale.most > 0.0).then_some(scale)
}

/// A deviation of a parameter with this mean and standard deviation that is too large or too small, or whose
/// mean is the parameter's own value; `of` is its name.
pub fn deviation(robot: &Robot, parameter: Parameter, of: &str, [mean, std]: [f64; 2]) -> Option<Doubt> {
    let nominal = parameter.nominal(robot);
    (shifted(robot, parameter, of, mean, |away| away < SAME * nominal.abs()))
        .or_else(|| size(robot, parameter, of, [mean, std]))
}

/// The greatest deviation of a parameter on an axis that is too large; `of` is its name.
pub fn farthest(robot: &Robot, parameter: Parameter, of: &str, deviation: f64) -> Option<Doubt> {
    size(robot, parameter, of, [deviation, 0.0])
}

/// A mean that is the value of the parameter, as far as `is_value` says of the difference of both, and not
/// the deviation from it.
fn shifted(
    robot: &Robot,
    parameter: Parameter,
    of: &str,
    mean: f64,
    is_value: impl Fn(f64) -> bool,
) -> Option<Doubt> {
    let (nominal, unit) = (parameter.nominal(robot), parameter.unit());
    let text = |value: f64| format!("{} {unit}", four_digits(value));
    let away = mean - nominal;
    // What is left of a difference of equal numbers is rounding; so are coordinates such as 1e-17.
    let is_rounding = nominal.abs() <= ROUNDING * frame_size(robot).max(reach(robot));
    (mean != 0.0 && !is_rounding && is_value(away.abs())).then(|| {
        let left = if away.abs() <= ROUNDING * nominal.abs() { 0.0 } else { away };
        let why = format!("deviations count from {}, the value of the robot file", text(nominal));
        Doubt::new(format!("mean of {of}"), text(mean), why, format!("mean {}", text(left)))
    })
}

/// A mean or a standard deviation that is too large or too small.
fn size(robot: &Robot, parameter: Parameter, of: &str, [mean, std]: [f64; 2]) -> Option<Doubt> {
    let (scale, unit) = (scale(robot, parameter)?, parameter.unit());
    let nominal = parameter.nominal(robot);
    let text = |value: f64| format!("{} {unit}", four_digits(value));
    if mean.abs() > scale.most {
        let of_value = shifted(robot, parameter, of, mean, |away| away < 0.5 * nominal.abs());
        return of_value.or_else(|| {
            let why = format!("deviations count from {}; above {}", text(nominal), scale.of);
            let meant = in_other(mean, &parameter, &scale);
            Some(Doubt::new(format!("mean of {of}"), text(mean), why, meant))
        });
    }
    if std > scale.most {
        let why = format!("above {}", scale.of);
        return Some(Doubt::new(format!("std of {of}"), text(std), why, in_other(std, &parameter, &scale)));
    }
    let is_tiny = parameter == Parameter::YoungsModulus && std > 0.0 && std < LEAST_MODULUS * nominal;
    is_tiny.then(|| {
        let why = format!("{:.0e} of the modulus, {}", std / nominal, text(nominal));
        let meant = [("GPa", 1e9), ("MPa", 1e6), ("%", 0.01 * nominal)].into_iter();
        let mut fits = meant.filter(|(_, factor)| std * factor < scale.most && std * factor > 1e-4 * nominal);
        let meant = fits.next().map_or_else(
            || "a standard deviation in Pa".to_owned(),
            |(other, factor)| format!("{}, if {} is in {other}", text(std * factor), four_digits(std)),
        );
        Doubt::new(format!("std of {of}"), text(std), why, meant)
    })
}

/// What a deviation that is too large may be.
fn in_other(value: f64, parameter: &Parameter, scale: &Scale) -> String {
    let (other, factor) = match parameter.unit() {
        "m" => ("mm", 1e-3),
        "kg" => ("g", 1e-3),
        "kg/m" => ("g/m", 1e-3),
        "rad" => ("degrees", 1.0_f64.to_radians()),
        "N" => ("mN", 1e-3),
        unit => return format!("a standard deviation in {unit}"),
    };
    if value.abs() * factor > scale.most {
        return format!("a standard deviation in {}, not the value", parameter.unit());
    }
    let (meant, typed) = (four_digits(value * factor), four_digits(value));
    format!("{meant} {}, if {typed} is in {other}", parameter.unit())
}

/// Noise of measurements, in `unit`, that is larger than any sensor's: `of` says of which.
pub fn noise(robot: &Robot, of: &str, unit: &str, std: f64) -> Option<Doubt> {
    let frame = frame_size(robot);
    let (most, why, other, factor) = match unit {
        "m" => {
            let share = four_digits(100.0 * std / frame);
            let why = format!("{share} % of the size of the frame, {} m", four_digits(frame));
            (DISTANCE * frame, why, "mm", 1e-3)
        }
        "rad" => {
            let why = format!("{} degrees", four_digits(std.to_degrees()));
            (ANGLE, why, "degrees", 1.0_f64.to_radians())
        }
        "N" => {
            let greatest = capacity(robot) / robot.cables.len() as f64;
            (0.5 * greatest, format!("the greatest tension is {} N", four_digits(greatest)), "mN", 1e-3)
        }
        _ => return None,
    };
    (most > 0.0 && std > most).then(|| {
        let meant = format!("{} {unit}, if {} is in {other}", four_digits(std * factor), four_digits(std));
        Doubt::new(format!("noise of {of}"), format!("{} {unit}", four_digits(std)), why, meant)
    })
}
