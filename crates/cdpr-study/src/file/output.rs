//! The output of a study: which number is observed of every robot, and what it is called.

use cdpr_dynamics::{AmplitudeAt, Damping};
use cdpr_robot::Axis;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use std::fmt;

/// The number that is observed of every robot. All statistics and measures of sensitivity are of this number.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum Output {
    /// Length of the displacement of P under the payload [mm]: the magnitude of the static deflection.
    #[default]
    Deflection,
    /// Distance of P from where the nominal robot stands, if the robot is given the nominal robot's
    /// unstrained lengths [mm]: the accuracy of the position without payload. Offsets of tension set-points
    /// are in these lengths.
    Position,
    /// Lowest natural frequency [Hz] of platform and cables with the payload, where the platform stands after
    /// the deflection. Motions that nothing resists do not count.
    Frequency,
    /// Natural frequency [Hz] with which the platform swings with the payload, where it stands after the
    /// deflection: of the motion that contains most of the platform's slowest one on cables without mass.
    PlatformFrequency,
    /// How far the platform vibrates for each newton [mm/N] of a force that shakes it at one frequency, with
    /// the payload, where it stands after the deflection. `amplitude` in the study file names the frequency.
    Amplitude,
    /// Lowest stiffness [N/m] of the platform with the payload, where it stands after the deflection.
    /// Rotations are times the characteristic length, and motions that nothing resists do not count.
    Stiffness,
}

/// The vector whose indices (`vector_first`, `vector_total`, `bures`) a study has with those of its output,
/// where this is a length.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case", deny_unknown_fields)]
pub enum VectorOutput {
    /// The displacement of P.
    #[default]
    Displacement,
    /// The displacement of P, and the rotation of the platform that belongs to it as a rotation vector in the
    /// base frame times a length: how far a point at this distance from P moves.
    Pose {
        /// This length [m], such as the distance of the tool from P. It says how much a rotation counts
        /// compared with a displacement.
        characteristic_length: f64,
    },
}

impl VectorOutput {
    /// What is kept of an observation for it.
    pub(crate) fn recorded(self) -> Recorded {
        match self {
            Self::Displacement => Recorded::Output,
            Self::Pose { .. } => Recorded::Motion,
        }
    }
}

impl fmt::Display for VectorOutput {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Displacement => f.write_str("displacement as a vector"),
            Self::Pose { characteristic_length } => {
                write!(f, "displacement and the rotation times {characteristic_length} m as a vector")
            }
        }
    }
}

/// The force that shakes the platform where the output is an amplitude. SI units.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct AmplitudeSpec {
    /// Frequency of the force [Hz].
    pub frequency: f64,
    /// Damping of the stretch of the cables, a time [s]: a cable that is stretched at a rate bears its axial
    /// stiffness times this time and the rate more. 2e-4 if left out.
    #[serde(default = "AmplitudeSpec::usual_damping")]
    pub damping: f64,
    /// Drag of the air on the cables [1/s]: a force of this number times the mass for each m/s; none if left
    /// out.
    #[serde(default)]
    pub drag: f64,
    /// Point of the platform at which the force acts and whose motion is measured, in the platform frame [m];
    /// P if left out.
    #[serde(default)]
    pub marker: [f64; 3],
    /// Axis of the base frame along which the force acts and the motion is measured; without it the worst
    /// direction.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub along: Option<AlongAxis>,
}

/// An axis of the base frame.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum AlongAxis {
    /// The first axis.
    X,
    /// The second axis.
    Y,
    /// The third axis.
    Z,
}

impl AmplitudeSpec {
    fn usual_damping() -> f64 {
        Damping::USUAL.stretch
    }

    /// The amplitude that it names.
    pub fn at(&self) -> AmplitudeAt {
        let axis = |along| match along {
            AlongAxis::X => Axis::X,
            AlongAxis::Y => Axis::Y,
            AlongAxis::Z => Axis::Z,
        };
        AmplitudeAt {
            frequency: self.frequency,
            damping: Damping { stretch: self.damping, drag: self.drag },
            marker: self.marker.into(),
            along: self.along.map(axis),
        }
    }

    /// The first invalid field, its value, and what is expected.
    pub(crate) fn invalid(&self) -> Option<(&'static str, String, &'static str)> {
        let Self { frequency, damping, drag, marker, .. } = self;
        if !(frequency.is_finite() && *frequency > 0.0) {
            return Some(("frequency", format!("{frequency:?}"), "a finite frequency above 0 [Hz]"));
        }
        for (field, value) in [("damping", damping), ("drag", drag)] {
            if !(value.is_finite() && *value >= 0.0) {
                return Some((field, format!("{value:?}"), "a finite number, zero or more"));
            }
        }
        let is_finite = marker.iter().all(|component| component.is_finite());
        (!is_finite).then(|| ("marker", format!("{marker:?}"), "finite components [m]"))
    }
}

/// What is kept of an observation.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub(crate) enum Recorded {
    /// The output, with its displacement where it is a length.
    #[default]
    Output,
    /// The displacement whose length is the output, and its rotation.
    Motion,
}

/// What an output is called.
struct Words {
    columns: &'static [&'static str],
    unit: &'static str,
    /// Ending of the names of its statistics.
    ending: &'static str,
    label: &'static str,
    short: &'static str,
    fine: (&'static str, f64),
}

impl Output {
    const fn words(self) -> Words {
        match self {
            Self::Deflection => Words {
                columns: &["dx_mm", "dy_mm", "dz_mm", "magnitude_mm"],
                unit: "mm",
                ending: "_mm",
                label: "magnitude of the static deflection",
                short: "magnitude",
                fine: ("\u{b5}m", 1e3),
            },
            Self::Position => Words {
                columns: &["dx_mm", "dy_mm", "dz_mm", "position_error_mm"],
                unit: "mm",
                ending: "_mm",
                label: "position error without payload",
                short: "position error",
                fine: ("\u{b5}m", 1e3),
            },
            Self::Frequency => Words {
                columns: &["frequency_hz"],
                unit: "Hz",
                ending: "_hz",
                label: "lowest natural frequency",
                short: "frequency",
                fine: ("mHz", 1e3),
            },
            Self::PlatformFrequency => Words {
                columns: &["platform_frequency_hz"],
                unit: "Hz",
                ending: "_hz",
                label: "natural frequency of the platform",
                short: "platform frequency",
                fine: ("mHz", 1e3),
            },
            Self::Amplitude => Words {
                columns: &["amplitude_mm_per_n"],
                unit: "mm/N",
                ending: "_mm_per_n",
                label: "amplitude of the shaken platform",
                short: "amplitude",
                fine: ("\u{b5}m/N", 1e3),
            },
            Self::Stiffness => Words {
                columns: &["least_stiffness_n_per_m"],
                unit: "N/m",
                ending: "_n_per_m",
                label: "lowest stiffness",
                short: "stiffness",
                fine: ("N/m", 1.0),
            },
        }
    }

    /// The columns of an observation in tables; the last one is the output.
    pub const fn columns(self) -> &'static [&'static str] {
        self.words().columns
    }

    /// Name of the output in files.
    pub const fn name(self) -> &'static str {
        let columns = self.columns();
        columns[columns.len() - 1]
    }

    /// Its unit.
    pub const fn unit(self) -> &'static str {
        self.words().unit
    }

    /// What it is, in words.
    pub const fn label(self) -> &'static str {
        self.words().label
    }

    /// The same in one word or two.
    pub const fn short(self) -> &'static str {
        self.words().short
    }

    /// The quantity that is observed, whose size the output is.
    pub const fn noun(self) -> &'static str {
        match self {
            Self::Deflection => "deflection",
            _ => self.short(),
        }
    }

    /// Label and unit, for an axis.
    pub fn axis(self) -> String {
        format!("{} [{}]", self.label(), self.unit())
    }

    /// Unit of small changes of the output, and how many of these its unit has.
    pub const fn fine_unit(self) -> (&'static str, f64) {
        self.words().fine
    }

    /// The name in files of a quantity of this output, from the one that it has for deflections:
    /// `magnitude_mm` and `mean_mm` are `frequency_hz` and `mean_hz` of a frequency.
    pub fn named(self, of_deflection: &str) -> String {
        if let Some(before) = of_deflection.strip_suffix(Self::Deflection.name()) {
            return format!("{before}{}", self.name());
        }
        match of_deflection.strip_suffix(Self::Deflection.words().ending) {
            Some(before) => format!("{before}{}", self.words().ending),
            None => of_deflection.to_owned(),
        }
    }

    /// Whether it depends on the inertia of the platform.
    pub(crate) fn needs_inertia(self) -> bool {
        matches!(self, Self::Frequency | Self::PlatformFrequency | Self::Amplitude)
    }

    /// Whether it is the length of a displacement.
    pub(crate) fn is_length(self) -> bool {
        matches!(self, Self::Deflection | Self::Position)
    }
}

impl fmt::Display for Output {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.pad(match self {
            Self::Deflection => "deflection",
            Self::Position => "position",
            Self::Frequency => "frequency",
            Self::PlatformFrequency => "platform_frequency",
            Self::Amplitude => "amplitude",
            Self::Stiffness => "stiffness",
        })
    }
}
