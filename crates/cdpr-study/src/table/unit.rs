//! Units behind the names of columns.

/// What a unit measures.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Dimension {
    /// Length [m].
    Length,
    /// Angle [rad].
    Angle,
    /// Force [N].
    Force,
    /// Moment [N m].
    Moment,
    /// Mass [kg].
    Mass,
    /// Time [s].
    Time,
}

impl Dimension {
    /// Its name in a sentence.
    pub fn name(self) -> &'static str {
        match self {
            Self::Length => "length",
            Self::Angle => "angle",
            Self::Force => "force",
            Self::Moment => "moment",
            Self::Mass => "mass",
            Self::Time => "time",
        }
    }
}

/// A unit.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Unit {
    /// What it measures.
    pub dimension: Dimension,
    /// Its size in SI units.
    pub factor: f64,
}

impl Unit {
    /// The unit of a name, in any letters: `mm`, `deg`, `kN`, `N m`.
    pub fn of(name: &str) -> Option<Self> {
        const DEGREE: f64 = std::f64::consts::PI / 180.0;
        let name: String = name.trim().to_lowercase().replace([' ', '.', '*', '\u{b7}', '\u{22c5}', '-'], "");
        let (dimension, factor) = match name.as_str() {
            "m" => (Dimension::Length, 1.0),
            "cm" => (Dimension::Length, 1e-2),
            "mm" => (Dimension::Length, 1e-3),
            "um" | "\u{b5}m" | "\u{3bc}m" => (Dimension::Length, 1e-6),
            "km" => (Dimension::Length, 1e3),
            "rad" => (Dimension::Angle, 1.0),
            "mrad" => (Dimension::Angle, 1e-3),
            "deg" | "degree" | "degrees" | "\u{b0}" => (Dimension::Angle, DEGREE),
            "n" => (Dimension::Force, 1.0),
            "kn" => (Dimension::Force, 1e3),
            "nm" => (Dimension::Moment, 1.0),
            "nmm" => (Dimension::Moment, 1e-3),
            "knm" => (Dimension::Moment, 1e3),
            "kg" => (Dimension::Mass, 1.0),
            "g" => (Dimension::Mass, 1e-3),
            "s" => (Dimension::Time, 1.0),
            "ms" => (Dimension::Time, 1e-3),
            _ => return None,
        };
        Some(Self { dimension, factor })
    }
}

/// The quantity of a name in small letters, and its unit: of `x_mm`, `x [mm]`, `x (mm)`, `x_m_y_m`, the last.
pub(super) fn split(name: &str) -> (String, Option<Unit>) {
    let name = plain(name);
    match name.rsplit_once('_').and_then(|(base, unit)| Some((base, Unit::of(unit)?))) {
        Some((base, unit)) => (base.to_owned(), Some(unit)),
        None => (name, None),
    }
}

/// A name in small letters, with a unit in brackets behind a `_`: `x_mm` of `X [mm]`.
pub(super) fn plain(name: &str) -> String {
    let name = name.trim().to_lowercase();
    let bracketed = name.strip_suffix([']', ')']).and_then(|inner| inner.rsplit_once(['[', '(']));
    match bracketed.filter(|(_, unit)| Unit::of(unit).is_some()) {
        Some((base, unit)) => format!("{}_{}", base.trim_end(), unit.trim().replace(' ', "")),
        None => name,
    }
}
