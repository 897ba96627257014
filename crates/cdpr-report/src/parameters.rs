//! Words, symbols and units for the parameters of a robot.

use crate::error::ReportError;
use cdpr_robot::{Axis, Parameter, TiltAxis};
use cdpr_study::WeatherQuantity;

/// Words for a parameter or a group of parameters, with its symbol.
pub(crate) fn parameter(name: &str) -> String {
    let words = match name {
        "mass" => "mass of the platform m",
        "linear_density" => "linear density \u{3c1} of all cables",
        "youngs_modulus" => "Young's modulus E of all cables",
        "a" => "anchor points, each coordinate of each",
        "b" => "exit points, each coordinate of each",
        "cog" => "centre of mass, each coordinate",
        "dt" => "tension set-points, each",
        "r" => "radii of the pulleys, each",
        "lead" => "leads, each",
        "tilt" => "tilts of the swivel axes, two of each",
        "gravity" => "gravity, each component",
        "wind_speed" => "speed of the wind",
        "wind_from_deg" => "azimuth from which the wind blows",
        "warmer" => "how much warmer it is",
        "cable_expansion" => "thermal expansion of the cables",
        "frame_expansion" => "thermal expansion of the frame",
        "ice" => "thickness of the ice",
        "creep" => "creep of the cables, a strain",
        other => other,
    };
    words.to_owned()
}

/// Shortest name of a parameter: `E`, `\u{3c1}`, `m`, or its own name.
pub(crate) fn symbol(name: &str) -> &str {
    match name {
        "mass" => "m",
        "linear_density" => "\u{3c1}",
        "youngs_modulus" => "E",
        other => other,
    }
}

/// Unit in which a parameter or a group of parameters is shown, and how many of it make one SI unit.
pub(crate) fn reading_unit(name: &str) -> (&'static str, f64) {
    let parameter = match name {
        "a" => Some(Parameter::AnchorPoint(0, Axis::X)),
        "b" => Some(Parameter::ExitPoint(0, Axis::X)),
        "cog" => Some(Parameter::CenterOfMass(Axis::X)),
        "dt" => Some(Parameter::TensionOffset(0)),
        "r" => Some(Parameter::PulleyRadius(0)),
        "lead" => Some(Parameter::Lead(0)),
        "tilt" => Some(Parameter::Tilt(0, TiltAxis::U)),
        "gravity" => Some(Parameter::Gravity(Axis::X)),
        name => name.parse().ok(),
    };
    let unit = parameter.map(|parameter| parameter.unit());
    match unit.or_else(|| WeatherQuantity::named(name).map(WeatherQuantity::unit)) {
        Some("Pa") => ("GPa", 1e-9),
        Some("m") => ("mm", 1e3),
        Some("kg/m") => ("g/m", 1e3),
        Some("rad") => ("mrad", 1e3),
        Some(unit) => (unit, 1.0),
        None => ("", 1.0),
    }
}

/// Label of the axis of a parameter, and how many of the unit in the label make one SI unit.
pub(crate) fn axis_of(name: &str) -> Result<(String, f64), ReportError> {
    let parameter: Parameter =
        name.parse().map_err(|_| ReportError::invalid("parameters", &name, "a parameter of a robot"))?;
    Ok(match parameter {
        Parameter::YoungsModulus => ("Young's modulus E [GPa]".to_owned(), 1e-9),
        Parameter::LinearDensity => ("linear density \u{3c1} [kg/m]".to_owned(), 1.0),
        Parameter::Mass => ("mass of the platform m [kg]".to_owned(), 1.0),
        Parameter::AnchorPoint(..) => (format!("anchor point, {name} [m]"), 1.0),
        Parameter::ExitPoint(..) => (format!("exit point, {name} [m]"), 1.0),
        Parameter::CenterOfMass(_) => (format!("centre of mass, {name} [m]"), 1.0),
        Parameter::TensionOffset(_) => (format!("offset of the tension set-point, {name} [N]"), 1.0),
        Parameter::PulleyRadius(_) => (format!("radius of the pulley, {name} [m]"), 1.0),
        Parameter::Lead(_) => (format!("lead, {name} [m]"), 1.0),
        Parameter::Tilt(..) => (format!("tilt of the swivel axis, {name} [rad]"), 1.0),
        Parameter::Gravity(_) => (format!("gravity, {name} [m/s\u{b2}]"), 1.0),
    })
}
