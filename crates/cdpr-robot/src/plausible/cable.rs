//! Doubts about the properties of a cable.

use super::doubt::{Doubt, Doubts, four_digits, in_other_unit, is_possible};
use crate::robot::CableProperties;
use std::f64::consts::PI;
use std::ops::Range;

/// From rubber to carbon fibre [Pa].
const MODULUS: Range<f64> = 1e8..1e12;
/// Mass per length over section [kg/m³]: from loose fibre to glass and aluminium, from steel to tungsten.
const MATERIALS: [Range<f64>; 2] = [500.0..3000.0, 7000.0..20_000.0];
/// Steel [kg/m³].
const STEEL: f64 = 7850.0;
/// Breaking force over section, from weak to the strongest fibre [Pa].
const STRENGTH: Range<f64> = 2e7..1e10;
/// Strength of steel wire [Pa].
const STEEL_WIRE: f64 = 1e9;
/// Greatest modulus of a steel rope over its metallic section [Pa].
const STIFFEST_ROPE: f64 = 1.3e11;
/// Metallic section over that of the full circle.
const FILL: Range<f64> = 0.3..1.001;
/// A section this near to the full circle was computed from the diameter, with few digits.
const FULL: f64 = 0.01;
/// From a fine wire to the ropes of telescopes and bridges [m].
const DIAMETER: Range<f64> = 2e-5..0.15;

/// Mass per length, from a fine wire to a rope of 10 cm [kg/m].
const LINEAR_DENSITY: Range<f64> = 1e-6..50.0;
/// Stiffness EA over weight per length, from rubber to carbon fibre [m].
const SPECIFIC: Range<f64> = 5e3..1e8;

/// Whether a tension [N] is next to nothing for a cable: some thousandths of what breaks it.
pub(super) fn is_idle(properties: &CableProperties, tension: f64) -> bool {
    tension < 2e-3 * properties.breaking_force.unwrap_or(STEEL_WIRE * properties.section)
}

/// Whether a cable bears a tension [N].
pub(super) fn is_borne(properties: &CableProperties, tension: f64) -> bool {
    tension <= 1.01 * properties.breaking_force.unwrap_or(STRENGTH.end * properties.section)
}

/// Doubts about a Young's modulus [Pa].
pub(super) fn modulus(quantity: &str, value: f64) -> Option<Doubt> {
    let meant = || {
        let others = [("GPa", 1e9), ("MPa", 1e6), ("kPa", 1e3)];
        in_other_unit(value, "Pa", &others, |value| (1e9..5e11).contains(&value))
    };
    (is_possible(value) && !MODULUS.contains(&value)).then(|| {
        let why = "all cables lie between rubber (0.1 GPa) and carbon fibre (1000 GPa)";
        let meant = meant().unwrap_or_else(|| "a modulus in Pa: 100 GPa is 1e11".to_owned());
        Doubt::new(quantity, format!("{} Pa", four_digits(value)), why, meant)
    })
}

/// A mass per length [kg/m] of a piece of cable that was weighed.
pub fn linear_density(value: f64) -> Option<Doubt> {
    (is_possible(value) && !LINEAR_DENSITY.contains(&value)).then(|| {
        let others = [("g/m", 1e-3), ("kg/mm", 1e3), ("kg/km", 1e-3)];
        let meant = in_other_unit(value, "kg/m", &others, |value| (1e-4..10.0).contains(&value));
        Doubt::new(
            "linear_density",
            format!("{} kg/m", four_digits(value)),
            "cables have 1e-6 kg/m, a fine wire, to 50 kg/m, a rope of 10 cm",
            meant.unwrap_or_else(|| "the mass in kg and the length in m".to_owned()),
        )
    })
}

/// A cable between two points: its weight per length [N/m] compared with its stiffness EA [N], and its length
/// [m] with its chord [m].
pub fn span(weight: f64, stiffness: f64, length: Option<f64>, chord: Option<f64>) -> Doubts {
    let specific = stiffness / weight;
    let are_possible = [weight, stiffness].into_iter().all(is_possible);
    let odd = (are_possible && !SPECIFIC.contains(&specific)).then(|| {
        let fits = |stiffness: f64| SPECIFIC.contains(&(stiffness / weight));
        let meant = in_other_unit(stiffness, "N", &[("kN", 1e3), ("MN", 1e6), ("GN", 1e9)], fits);
        Doubt::new(
            "stiffness",
            format!("{} N at {} N/m", four_digits(stiffness), four_digits(weight)),
            "the stiffness of cables is the weight of 5 km (rubber) to 100 000 km (carbon fibre) of them",
            meant.unwrap_or_else(|| "EA in N, the weight per length in N/m".to_owned()),
        )
    });
    let [length, chord] = [length, chord].map(|value| value.unwrap_or(0.0));
    let uneven = (length > 0.0 && chord > 0.0 && !(1e-2..100.0).contains(&(length / chord))).then(|| {
        let ratio = four_digits(length / chord);
        let fits = |length: f64| (0.5..10.0).contains(&(length / chord));
        let meant = in_other_unit(length, "m", &[("mm", 1e-3), ("cm", 1e-2)], fits);
        Doubt::new(
            "length",
            format!("{} m", four_digits(length)),
            format!("{ratio} times the distance of its ends, {} m", four_digits(chord)),
            meant.unwrap_or_else(|| "length and end in m".to_owned()),
        )
    });
    odd.into_iter().chain(uneven).collect()
}

/// Doubts about the properties in `path`. What follows from a doubtful diameter or
/// section is not questioned again.
pub(super) fn properties(path: &str, properties: &CableProperties) -> Doubts {
    let mut doubts = Doubts::new();
    // EA may be given as the modulus of a unit section: such a section means nothing else.
    if properties.section != 1.0 {
        let diameter = diameter(path, properties);
        let full = properties.diameter.is_some_and(|d| (fill(properties.section, d) - 1.0).abs() < FULL);
        doubts.extend(diameter.clone());
        doubts.extend(modulus(&format!("{path}.youngs_modulus"), properties.youngs_modulus));
        let section = section(path, properties).filter(|_| diameter.is_none());
        if diameter.is_none() && section.is_none() {
            doubts.extend(density(path, properties, full));
            doubts.extend(strength(path, properties));
        }
        doubts.extend(section);
    }
    doubts
}

fn fill(section: f64, diameter: f64) -> f64 {
    section / (0.25 * PI * diameter * diameter)
}

fn diameter(path: &str, properties: &CableProperties) -> Option<Doubt> {
    let diameter = properties.diameter.filter(|diameter| !DIAMETER.contains(diameter))?;
    let meant = in_other_unit(diameter, "m", &[("mm", 1e-3), ("\u{b5}m", 1e-6)], |d| DIAMETER.contains(&d));
    Some(Doubt::new(
        format!("{path}.diameter"),
        format!("{} m", four_digits(diameter)),
        "cables have 0.02 mm to 0.15 m",
        meant.unwrap_or_else(|| "a diameter in m".to_owned()),
    ))
}

fn density(path: &str, properties: &CableProperties, full: bool) -> Option<Doubt> {
    let CableProperties { section, linear_density, diameter, .. } = *properties;
    let density = linear_density / section;
    if linear_density <= 0.0 || MATERIALS.iter().any(|material| material.contains(&density)) {
        return None;
    }
    let is_between = (MATERIALS[0].end..MATERIALS[1].start).contains(&density);
    if let Some(diameter) = diameter.filter(|_| full && is_between) {
        let metal = linear_density / STEEL;
        // A modulus of the full circle, as files have it that state EA.
        if properties.youngs_modulus * section <= STIFFEST_ROPE * metal {
            return None;
        }
        return Some(Doubt::new(
            format!("{path}.section"),
            format!("{section:.4e} m\u{b2}, the full circle of {} mm", four_digits(1e3 * diameter)),
            format!(
                "with linear_density it makes {density:.0} kg/m\u{b3}, which no material of cables has; \
                 stretch would be too small"
            ),
            format!(
                "the section that carries: {metal:.3e} m\u{b2} of steel ({STEEL:.0} kg/m\u{b3}) has this mass"
            ),
        ));
    }
    let fits = |density: f64| (900.0..12_000.0).contains(&(density / section));
    let meant = in_other_unit(linear_density, "kg/m", &[("g/m", 1e-3), ("kg per 100 m", 1e-2)], fits);
    Some(Doubt::new(
        format!("{path}.linear_density"),
        format!("{linear_density} kg/m on {section:.4e} m\u{b2}"),
        format!("makes a density of {} kg/m\u{b3}; steel has 7850, fibre 970 to 1600", four_digits(density)),
        meant.filter(|_| !is_between).unwrap_or_else(|| {
            "linear_density in kg/m; section in m\u{b2}, not in mm\u{b2}, of what carries alone".to_owned()
        }),
    ))
}

fn section(path: &str, properties: &CableProperties) -> Option<Doubt> {
    let (section, diameter) = (properties.section, properties.diameter?);
    let fill = fill(section, diameter);
    (!FILL.contains(&fill)).then(|| {
        Doubt::new(
            format!("{path}.section"),
            format!("{section:.4e} m\u{b2} at a diameter of {diameter} m"),
            format!("{} % of the full circle", four_digits(100.0 * fill)),
            "section in m\u{b2} and diameter in m; leave the section out for the full circle",
        )
    })
}

fn strength(path: &str, properties: &CableProperties) -> Option<Doubt> {
    let force = properties.breaking_force?;
    let strength = force / properties.section;
    (!STRENGTH.contains(&strength)).then(|| {
        let fits = |force: f64| STRENGTH.contains(&(force / properties.section));
        let meant = in_other_unit(force, "N", &[("kN", 1e3), ("t", 9806.65)], fits);
        Doubt::new(
            format!("{path}.breaking_force"),
            format!("{force} N on {:.4e} m\u{b2}", properties.section),
            format!("makes a strength of {strength:.3e} Pa; steel wire has 1e9 to 2e9"),
            meant.unwrap_or_else(|| "a force in N".to_owned()),
        )
    })
}
