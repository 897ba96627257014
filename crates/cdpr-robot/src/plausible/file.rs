//! Doubts about the values of a robot file, the field that is wrong first.

use super::cable;
use super::doubt::{
    Doubt, Doubts, capacity, four_digits, frame_size, in_other_unit, in_other_units, is_possible, reach,
};
use super::inertia::Gyration;
use super::layout;
use crate::number::visible;
use crate::robot::{Robot, RobotCable};
use std::ops::Range;

/// Masses of platforms [kg].
const MASS: Range<f64> = 0.01..1e5;
/// Radius of gyration over the size of the platform: the body may be larger than what its anchor points
/// span, or a ball in their middle.
const GYRATION: Range<f64> = 0.01..5.0;
/// Units in which inertia is given besides kg m².
const INERTIA_UNITS: [(&str, f64); 5] = [
    ("g mm\u{b2}", 1e-9),
    ("kg mm\u{b2}", 1e-6),
    ("g cm\u{b2}", 1e-7),
    ("kg cm\u{b2}", 1e-4),
    ("g m\u{b2} (from g mm\u{b2} multiply by 1e-9, from kg mm\u{b2} by 1e-6)", 1e-3),
];
/// Greatest lead over the size of the frame.
const LEAD: f64 = 5.0;
/// Greatest radius of a pulley [m], and over the size of the frame.
const RADIUS: [f64; 2] = [3.0, 0.5];

/// All doubts about the values of a robot file.
pub fn robot(robot: &Robot) -> Doubts {
    let mut doubts = layout::sizes(robot);
    doubts.extend(mass("platform.mass", robot.platform.mass));
    doubts.extend(center_of_mass(robot));
    doubts.extend(inertia(robot));
    doubts.extend(properties(robot));
    doubts.extend(guides(robot));
    doubts.extend(layout::mirrored(robot));
    doubts.extend(reference(robot));
    if doubts.is_empty() {
        doubts.extend(weight(robot));
    }
    doubts
}

/// Doubts about the mass of a platform [kg].
pub(super) fn mass(quantity: &str, value: f64) -> Option<Doubt> {
    (is_possible(value) && !MASS.contains(&value)).then(|| {
        let meant = in_other_unit(value, "kg", &[("g", 1e-3), ("t", 1e3)], |mass| (0.1..1e4).contains(&mass));
        Doubt::new(
            quantity,
            format!("{} kg", four_digits(value)),
            "hardly the mass of a platform",
            meant.unwrap_or_else(|| "a mass in kg, not in g or t".to_owned()),
        )
    })
}

fn center_of_mass(robot: &Robot) -> Option<Doubt> {
    let (reach, center) = (reach(robot), robot.platform.center_of_mass.norm());
    (reach > 0.0 && center > 2.0 * reach).then(|| {
        let meant = in_other_unit(center, "m from P", &[("mm", 1e-3)], |center| center < reach);
        Doubt::new(
            "platform.center_of_mass",
            format!("{} m from P", four_digits(center)),
            "more than twice as far from P as the farthest anchor point",
            meant.unwrap_or_else(|| "coordinates in the platform frame, in m".to_owned()),
        )
    })
}

/// The radius of gyration is compared with the size of the platform, or of the frame for a point mass.
fn inertia(robot: &Robot) -> Option<Doubt> {
    let inertia = robot.platform.inertia.filter(|_| !robot.platform.point)?;
    let greatest = inertia.diagonal().max();
    let size = if reach(robot) > 0.0 { reach(robot) } else { frame_size(robot) };
    let over_size = |inertia: f64| (inertia / robot.platform.mass).sqrt() / size;
    if size == 0.0 || GYRATION.contains(&over_size(greatest)) {
        return None;
    }
    let radius = four_digits((greatest / robot.platform.mass).sqrt());
    let gyration = Gyration::of(robot);
    let fits = |inertia: f64| match gyration {
        Some(gyration) => gyration.is_usual(inertia / greatest),
        None => (0.1..2.0).contains(&over_size(inertia)),
    };
    let meant = in_other_units(greatest, "kg m\u{b2}", &INERTIA_UNITS, fits);
    Some(Doubt::new(
        "platform.inertia",
        format!("up to {} kg m\u{b2}", four_digits(greatest)),
        format!(
            "a radius of gyration of {radius} m, where the anchor points reach {} m from P",
            four_digits(size)
        ),
        meant.unwrap_or_else(|| "an inertia in kg m\u{b2} about the centre of mass".to_owned()),
    ))
}

/// Properties of every cable, once where they are the same.
fn properties(robot: &Robot) -> Doubts {
    let cables = &robot.cables;
    let shared = cables.windows(2).all(|pair| pair[0].properties == pair[1].properties);
    let each = cables.iter().enumerate().take(if shared { 1 } else { cables.len() });
    let path = |i: usize| if shared { "cable".to_owned() } else { format!("cables[{i}].cable") };
    each.flat_map(|(i, cable)| cable::properties(&path(i), &cable.properties)).collect()
}

/// Leads and radii of pulleys.
fn guides(robot: &Robot) -> Doubts {
    let size = frame_size(robot);
    let lead = |cable: &RobotCable| cable.lead;
    let radius = |cable: &RobotCable| cable.pulley.map_or(0.0, |pulley| pulley.radius);
    let longest = if size > 0.0 { LEAD * size } else { f64::INFINITY };
    let widest = RADIUS[0].min(if size > 0.0 { RADIUS[1] * size } else { f64::INFINITY });
    [first(robot, "lead", lead, longest), first(robot, "pulley.radius", radius, widest)]
        .into_iter()
        .flatten()
        .collect()
}

/// The first cable whose `value` is above `most`, and how many more there are.
fn first(robot: &Robot, field: &str, value: impl Fn(&RobotCable) -> f64, most: f64) -> Option<Doubt> {
    let size = frame_size(robot);
    let beyond = || robot.cables.iter().enumerate().filter(|(_, cable)| value(cable) > most);
    let (i, cable) = beyond().next()?;
    let value = value(cable);
    let others = match beyond().count() - 1 {
        0 => String::new(),
        1 => ", and of another cable".to_owned(),
        more => format!(", and of {more} more cables"),
    };
    let meant = in_other_unit(value, "m", &[("mm", 1e-3)], |value| value <= most);
    Some(Doubt::new(
        format!("cables[{i}].{field}"),
        format!("{} m{others}", four_digits(value)),
        format!("{} times the size of the frame, {} m", four_digits(value / size), four_digits(size)),
        meant.unwrap_or_else(|| "a length in m".to_owned()),
    ))
}

/// Tensions that are preferred far above what the cables may carry: they, or the limits where these are far
/// below what such cables carry.
pub fn reference(robot: &Robot) -> Option<Doubt> {
    robot.tension_reference.as_ref()?;
    let tensions = robot.reference();
    let (i, tension) =
        tensions.iter().enumerate().find(|(i, tension)| **tension > 2.0 * robot.limits(*i).max)?;
    let most = robot.limits(i).max;
    let preferred = format!("{} N for cable {}", four_digits(*tension), i + 1);
    if *tension <= 1e3 * most
        && let Some(doubt) = limits(robot, format!("tension_reference is {preferred}"))
    {
        return Some(doubt);
    }
    let meant = in_other_unit(*tension, "N", &[("mN", 1e-3)], |tension| tension < most);
    Some(Doubt::new(
        "tension_reference",
        preferred,
        format!("its greatest tension is {} N", four_digits(most)),
        meant.unwrap_or_else(|| "tensions in N".to_owned()),
    ))
}

/// The doubt whether the limits are in kN, for a reason: all of them are far below what such cables carry,
/// and a thousand times as much is not too much.
fn limits(robot: &Robot, reason: String) -> Option<Doubt> {
    let limits = robot.cables.iter().enumerate().map(|(i, cable)| (robot.limits(i).max, &cable.properties));
    let are_low = limits.clone().all(|(max, properties)| cable::is_idle(properties, max));
    let are_kilonewtons = limits.clone().all(|(max, properties)| cable::is_borne(properties, 1e3 * max));
    let greatest = limits.map(|(max, _)| max).fold(0.0, f64::max);
    (are_low && are_kilonewtons).then(|| {
        let meant = in_other_unit(greatest, "N", &[("kN", 1e3)], |_| true);
        Doubt::new(
            "tension_limits.max",
            format!("{} N", four_digits(greatest)),
            format!("{reason}; such cables carry far more"),
            meant.unwrap_or_else(|| "tensions in N".to_owned()),
        )
    })
}

/// A platform heavier than what all cables hold: its mass, or the limits where they are far below what such
/// cables carry.
fn weight(robot: &Robot) -> Option<Doubt> {
    let mass = robot.platform.mass;
    let (weight, most) = (mass * robot.gravity.magnitude(), capacity(robot));
    if weight <= most {
        return None;
    }
    let [own, borne] = [weight, most].map(|force| visible(force, 1));
    let too_little = || {
        format!(
            "all cables at it, drawn straight up, carry {borne} N, less than the platform's weight, {own} N"
        )
    };
    if 1e3 * most > weight
        && let Some(doubt) = limits(robot, too_little())
    {
        return Some(doubt);
    }
    let meant = in_other_unit(mass, "kg", &[("g", 1e-3)], |mass| mass * robot.gravity.magnitude() < most);
    Some(Doubt::new(
        "platform.mass",
        format!("{} kg, {own} N", four_digits(mass)),
        format!("all cables at tension_limits.max, drawn straight up, carry {borne} N"),
        meant.unwrap_or_else(|| "a smaller mass or a greater limit".to_owned()),
    ))
}
