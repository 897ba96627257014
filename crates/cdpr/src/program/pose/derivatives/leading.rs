//! The parameters that a table lists, and units for them.

use cdpr_robot::Parameter;

/// Parameters of a table without `--details`.
pub(super) const LEADING: usize = 10;

/// A unit of the size by which such a parameter is uncertain, and its value in SI units.
pub(super) fn handy_unit(parameter: &Parameter) -> (&'static str, f64) {
    match parameter.unit() {
        "kg/m" => ("g/m", 1e-3),
        "Pa" => ("GPa", 1e9),
        "m" => ("mm", 1e-3),
        "rad" => ("mrad", 1e-3),
        unit => (unit, 1.0),
    }
}
