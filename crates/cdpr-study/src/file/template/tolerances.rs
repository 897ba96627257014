//! Tolerances of a template: the usual ones, or smaller ones where the robot would not be held with them.
//!
//! With as many cables as free motions or more, a robot is held with any small errors. With fewer, the
//! coordinates that are given may nearly follow from each other, as the yaw of a platform whose anchor points
//! are laid out as its exit points are: errors of millimetres are then more than the tensions can make up
//! for.

use cdpr_robot::{Coordinate, Parameter, Pose, Robot, frame};
use cdpr_statics::{Load, WantedPose, deflection};

/// Shares of the usual tolerances that are tried.
const SHARES: [f64; 5] = [1.0, 0.5, 0.2, 0.1, 0.05];

/// Robots at corners of the tolerances that must be held: each parameter deviates by all of its tolerance.
const CORNERS: u64 = 8;

/// Half widths of uniform laws by groups of parameters, in SI units.
pub(super) struct Tolerances {
    halves: Vec<(&'static str, f64)>,
    /// Share of the usual tolerances that those of points, set-points and guides are.
    pub(super) share: f64,
}

impl Tolerances {
    /// Those of a robot whose mean tension is `tension` [N].
    pub(super) fn usual(robot: &Robot, tension: f64) -> Self {
        Self::of_share(robot, tension, 1.0)
    }

    fn of_share(robot: &Robot, tension: f64, share: f64) -> Self {
        let properties = || robot.cables.iter().map(|cable| &cable.properties);
        let density = properties().map(|cable| cable.linear_density).fold(f64::INFINITY, f64::min);
        let modulus = properties().map(|cable| cable.youngs_modulus).fold(f64::INFINITY, f64::min);
        let platform = robot.assumed_radius();
        let size = frame(robot).map(|[low, high]| high - low).into_iter().fold(0.0, f64::max);
        let of_values = [
            ("mass", 0.05 * robot.platform.mass),
            ("linear_density", 0.05 * density),
            ("youngs_modulus", 0.1 * modulus),
        ];
        let of_points = [
            // Of small platforms and frames a share of their size.
            ("a", f64::min(0.002, 0.01 * platform)),
            ("b", f64::min(0.005, 0.002 * size)),
            ("cog", f64::min(0.01, 0.05 * platform)),
            ("dt", two_digits(0.01 * tension)),
            ("r", 0.0005),
            ("lead", 0.05),
            ("tilt", 0.01),
            ("gravity", 0.05),
        ];
        let parameters = Parameter::of(robot);
        let is_there = |(group, half): &(&str, f64)| {
            // Cables without weight have none that could vary.
            let is_of = |one: &&Parameter| one.group() == *group && has_tolerance(robot, one);
            *half > 0.0 && parameters.iter().find(is_of).is_some()
        };
        let of_points = of_points.map(|(group, half)| (group, share * half));
        let all = of_values.into_iter().chain(of_points).filter(is_there);
        Self { halves: all.map(|(group, half)| (group, two_digits(half))).collect(), share }
    }

    /// The largest with which a robot of few cables is held at a pose under a load, if there are any.
    pub(super) fn held(
        robot: &Robot,
        tension: f64,
        pose: &Pose,
        load: &Load,
        free: &[Coordinate],
    ) -> Option<Self> {
        let each = SHARES.map(|share| Self::of_share(robot, tension, share));
        each.into_iter().find(|one| one.are_held(robot, pose, load, free))
    }

    /// The smallest.
    pub(super) fn least(robot: &Robot, tension: f64) -> Self {
        Self::of_share(robot, tension, SHARES[SHARES.len() - 1])
    }

    fn are_held(&self, robot: &Robot, pose: &Pose, load: &Load, free: &[Coordinate]) -> bool {
        let parameters = Parameter::of(robot);
        let deviation = |corner: u64, index: usize| {
            let half = self.half(parameters[index].group());
            if is_plus(corner, index as u64) { half } else { -half }
        };
        (0..CORNERS).all(|corner| {
            let deviations: Vec<f64> = (0..parameters.len()).map(|index| deviation(corner, index)).collect();
            robot.perturbed(&deviations).is_ok_and(|perturbed| {
                deflection(
                    &perturbed.robot,
                    WantedPose::at(pose).free(free).tension_offsets(&perturbed.tension_offsets),
                    load,
                )
                .is_ok()
            })
        })
    }

    /// The half width of a group; zero where it does not vary.
    pub(super) fn half(&self, group: &str) -> f64 {
        self.halves.iter().find(|(name, _)| *name == group).map_or(0.0, |(_, half)| *half)
    }

    /// Entries of an error model of a study file, one a line.
    pub(super) fn entries(&self) -> String {
        let entry = |(group, half): &(&str, f64)| {
            format!(
                r#"      "{group}": {{ "law": {{ "uniform": {{ "min": -{half:?}, "max": {half:?} }} }} }}"#
            )
        };
        self.halves.iter().map(entry).collect::<Vec<_>>().join(",\n")
    }
}

/// Whether a template has a tolerance of this parameter. A point mass has no offsets of cables and of the
/// centre of mass: the format of robots does not know them. Where the balance alone gives the tensions, there
/// are no set-points that could be off.
pub fn has_tolerance(robot: &Robot, parameter: &Parameter) -> bool {
    match parameter.group() {
        "a" | "cog" => !robot.platform.point,
        "dt" => robot.cables.len() > robot.freedoms().count(),
        _ => true,
    }
}

/// A sign that looks random and is always the same: the last step of SplitMix64 (Steele, Lea, Flood, 2014).
fn is_plus(corner: u64, index: u64) -> bool {
    let mut mixed = (corner << 32 | index).wrapping_add(1).wrapping_mul(0x9e37_79b9_7f4a_7c15);
    mixed = (mixed ^ (mixed >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    mixed = (mixed ^ (mixed >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
    (mixed ^ (mixed >> 31)) & 1 == 1
}

/// To two digits.
pub(super) fn two_digits(value: f64) -> f64 {
    format!("{value:.1e}").parse().unwrap_or(value)
}
