//! A doubt, and the sizes of a robot with which numbers are compared.

use crate::json::numbered;
use crate::robot::Robot;
use serde::Serialize;
use std::fmt;

/// A number that is probably not what was meant.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
pub struct Doubt {
    /// What it is: the path of a field such as `cables[2].lead`, or a name such as `payload`.
    pub quantity: String,
    /// The value with its unit.
    pub value: String,
    /// Why it is improbable.
    pub why: String,
    /// What was probably meant, or what to check.
    pub meant: String,
}

/// Doubts in their order.
pub type Doubts = Vec<Doubt>;

impl Doubt {
    /// A doubt about a quantity.
    pub fn new(
        quantity: impl Into<String>,
        value: impl Into<String>,
        why: impl Into<String>,
        meant: impl Into<String>,
    ) -> Self {
        Self { quantity: quantity.into(), value: value.into(), why: why.into(), meant: meant.into() }
    }
}

impl fmt::Display for Doubt {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { quantity, value, why, meant } = self;
        write!(f, "{} is {value}: {why}\n    meant? {meant}", numbered(quantity))
    }
}

/// A result of which more than half of the observations are missing; `name` says what was observed.
pub fn more_than_half_failed(name: &str, failed: usize, all: usize) -> Option<Doubt> {
    let share = 100.0 * failed as f64 / all as f64;
    (2 * failed > all).then(|| {
        Doubt::new(
            name,
            format!("the result of {} observations", all - failed),
            format!("{failed} of {all} failed ({share:.0} %): what is left is no sample of the model"),
            "smaller deviations, a smaller load or another pose; the tables have the reasons",
        )
    })
}

/// A map without a position that the robot holds.
pub fn nothing_held(positions: usize) -> Doubt {
    Doubt::new(
        "the map",
        format!("empty: none of {positions} positions is held"),
        "maps are made of where a robot works",
        "a plane or box among the exit points, in m, or below them; a smaller load",
    )
}

/// Least and greatest coordinate of the exit points along x, y and z [m].
pub fn frame(robot: &Robot) -> [[f64; 2]; 3] {
    [0, 1, 2].map(|axis| {
        let exits = || robot.cables.iter().map(|cable| cable.exit_point[axis]);
        [exits().fold(f64::INFINITY, f64::min), exits().fold(f64::NEG_INFINITY, f64::max)]
    })
}

/// Longest side of the box around the exit points [m].
pub(super) fn frame_size(robot: &Robot) -> f64 {
    frame(robot).iter().map(|[low, high]| high - low).fold(0.0, f64::max)
}

/// Distance of the farthest anchor point from P [m].
pub(super) fn reach(robot: &Robot) -> f64 {
    robot.cables.iter().map(|cable| cable.anchor_point.norm()).fold(0.0, f64::max)
}

/// Sum of the greatest tensions [N].
pub(super) fn capacity(robot: &Robot) -> f64 {
    (0..robot.cables.len()).map(|i| robot.limits(i).max).sum()
}

/// Whether a quantity can have this value at all. What cannot be is refused where it is read and not
/// questioned.
pub(super) fn is_possible(value: f64) -> bool {
    value.is_finite() && value > 0.0
}

/// The text of a number with four digits: as it is where it is neither large nor small.
pub(super) fn four_digits(value: f64) -> String {
    let size = value.abs();
    if size == 0.0 || (1e-3..1e5).contains(&size) {
        let digits = if size == 0.0 { 0 } else { 3 - size.log10().floor() as i32 };
        return crate::number::rounded(value, digits).to_string();
    }
    format!("{value:.3e}")
}

/// The value in its unit if it was typed in one of `others`, the first in which it fits.
pub(super) fn in_other_unit(
    value: f64,
    unit: &str,
    others: &[(&str, f64)],
    fits: impl Fn(f64) -> bool,
) -> Option<String> {
    let first = others.iter().position(|(_, factor)| fits(value * factor))?;
    in_other_units(value, unit, &others[first..=first], fits)
}

/// The value in its unit for each of `others` in which it fits, if it was typed in that.
pub(super) fn in_other_units(
    value: f64,
    unit: &str,
    others: &[(&str, f64)],
    fits: impl Fn(f64) -> bool,
) -> Option<String> {
    let mut typed = four_digits(value);
    let fitting = others.iter().filter(|(_, factor)| fits(value * factor));
    let texts = fitting.map(|(other, factor)| {
        let typed = std::mem::replace(&mut typed, "it".to_owned());
        format!("{} {unit}, if {typed} is in {other}", four_digits(value * factor))
    });
    Some(texts.collect::<Vec<_>>().join("; ")).filter(|text| !text.is_empty())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn exactly_half_is_not_more_than_half() {
        assert_eq!(more_than_half_failed("s", 32, 64), None);
        assert_eq!(more_than_half_failed("s", 0, 0), None);
        let doubt = more_than_half_failed("s", 41, 64).unwrap();
        assert!(doubt.why.starts_with("41 of 64 failed (64 %)"), "{doubt}");
    }

    #[test]
    fn numbers_have_four_digits() {
        let texts = [0.0, 3000.0, 0.0012345, 4881.2, 1e100, -0.00002].map(four_digits);
        assert_eq!(texts, ["0", "3000", "0.001235", "4881", "1.000e100", "-2.000e-5"]);
    }
}
