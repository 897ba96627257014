//! Errors of the sensors: what is sought of them, and the size of the robot that lengths are judged by, with
//! the axes along which it moves.

use crate::error::CalibrationError;
use cdpr_robot::{Axis, Robot};

/// An error of the sensors that is sought with the parameters.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum SensorError {
    /// What a winch reads at the length zero [m], a cable: lengths are relative.
    LengthOffset,
    /// Relative error of the radius of a drum, a cable.
    DrumScale,
    /// What a load cell reads without tension [N], a cable.
    TensionBias,
    /// Relative error of the slope of a load cell, a cable.
    TensionGain,
    /// What the sensor of a swivel angle reads at zero [rad], a cable.
    SwivelOffset,
    /// What an inclinometer reads of roll, pitch and yaw of a level platform [rad].
    AngleOffset,
    /// The place of every marker in the platform frame [m].
    Markers,
    /// The place of the base frame in the frame of the tracker: a translation [m] and a rotation [rad].
    Frame,
    /// Relative error of the tracker's scale.
    FrameScale,
}

impl SensorError {
    /// All with their names, in their order.
    const NAMED: [(Self, &'static str); 9] = [
        (Self::LengthOffset, "length_offset"),
        (Self::DrumScale, "drum_scale"),
        (Self::TensionBias, "tension_bias"),
        (Self::TensionGain, "tension_gain"),
        (Self::SwivelOffset, "swivel_offset"),
        (Self::AngleOffset, "angle_offset"),
        (Self::Markers, "markers"),
        (Self::Frame, "frame"),
        (Self::FrameScale, "frame_scale"),
    ];

    /// Its name.
    pub fn name(self) -> &'static str {
        Self::NAMED[self as usize].1
    }

    /// The one with this name.
    ///
    /// # Errors
    /// [`CalibrationError::Invalid`] for another name.
    pub fn from_name(name: &str) -> Result<Self, CalibrationError> {
        let found = Self::NAMED.into_iter().find(|(_, own)| *own == name).map(|(error, _)| error);
        found.ok_or_else(|| {
            let expected = format!("one of {}", Self::NAMED.map(|(_, name)| name).join(", "));
            CalibrationError::invalid("error of sensors", name, expected)
        })
    }

    /// The names of its numbers for `n` cables and `markers` markers.
    pub(crate) fn names(self, n: usize, markers: usize) -> Vec<String> {
        let name = self.name();
        let axes = |of: String| Axis::ALL.map(|axis| format!("{of}.{axis}"));
        match self {
            Self::AngleOffset => ["roll", "pitch", "yaw"].map(|angle| format!("{name}.{angle}")).to_vec(),
            Self::Markers => (1..=markers).flat_map(|k| axes(format!("marker{k}"))).collect(),
            Self::Frame => axes(name.to_owned()).into_iter().chain(axes("frame.r".to_owned())).collect(),
            Self::FrameScale => vec![name.to_owned()],
            _ => (1..=n).map(|i| format!("{name}{i}")).collect(),
        }
    }

    /// SI unit of the number `k` of these.
    pub fn unit(self, k: usize) -> &'static str {
        match self {
            Self::LengthOffset | Self::Markers => "m",
            Self::Frame if k < 3 => "m",
            Self::TensionBias => "N",
            Self::DrumScale | Self::TensionGain | Self::FrameScale => "1",
            Self::SwivelOffset | Self::AngleOffset | Self::Frame => "rad",
        }
    }

    /// A change that is great for such an error; beyond it nothing is known.
    pub(crate) fn scale(self, robot: &Robot, k: usize) -> f64 {
        match self {
            Self::LengthOffset => size(robot),
            Self::DrumScale | Self::TensionGain | Self::FrameScale => 1.0,
            Self::TensionBias => robot.limits(k).max,
            Self::SwivelOffset | Self::AngleOffset => 1.0,
            Self::Markers => robot.platform_size().max(1e-3 * size(robot)),
            Self::Frame if k < 3 => size(robot),
            Self::Frame => 1.0,
        }
    }
}

/// Refuses errors of sensors that are named twice.
///
/// # Errors
/// [`CalibrationError::Invalid`] naming it.
pub(crate) fn check_each_once(errors: impl Iterator<Item = SensorError>) -> Result<(), CalibrationError> {
    let mut before = Vec::new();
    for error in errors {
        if before.contains(&error) {
            return Err(CalibrationError::invalid("error of sensors", error.name(), "each once"));
        }
        before.push(error);
    }
    Ok(())
}

/// The greatest distance of an exit point from the first [m], or the platform's size if that is greater.
pub(crate) fn size(robot: &Robot) -> f64 {
    let first = robot.cables[0].exit_point;
    robot.cables.iter().map(|cable| (cable.exit_point - first).norm()).fold(robot.platform_size(), f64::max)
}

/// Axes along which the platform can move: of a planar robot, those of its plane.
pub(crate) fn free_axes(robot: &Robot) -> Vec<usize> {
    robot.freedoms().components().into_iter().filter(|k| *k < 3).collect()
}
