//! Tensions that a cable is not to have: what is named about a solution, whichever model found it.

use crate::state::Equilibrium;
use cdpr_cable::MAX_STRAIN;
use cdpr_robot::{CableEnd, Robot, TensionLimits, significant, visible};
use std::fmt;

/// A tension outside of what a cable is to bear, or can bear.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct OutOfLimits {
    /// Index of the cable, from 0.
    pub cable: usize,
    /// The end at which it has this tension.
    pub end: CableEnd,
    /// The tension [N].
    pub tension: f64,
    /// The limit that it passes.
    pub limit: Limit,
    /// The limit [N].
    pub value: f64,
}

/// A limit of a tension, the most serious one first.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Limit {
    /// The breaking force of the cable.
    BreakingForce,
    /// The tension that strains the cable by [`cdpr_cable::MAX_STRAIN`]: no model is valid beyond it, so that
    /// it only ends what grows.
    Strain,
    /// Its greatest tension, limited at this end.
    Max,
    /// Its greatest tension, which is limited at the other end.
    MaxElsewhere,
    /// Its least tension.
    Min,
}

/// Share by which rounding may put a tension beyond a limit on which it rests.
const ON_LIMIT: f64 = 1e-9;

/// Strain that rounding of the length leaves open.
const ROUNDED_STRAIN: f64 = 1e-12;

impl Limit {
    /// Its name in result files: that of the robot file's field, or `strain`.
    pub fn name(self) -> &'static str {
        match self {
            Self::BreakingForce => "breaking_force",
            Self::Strain => "strain",
            Self::Max | Self::MaxElsewhere => "max",
            Self::Min => "min",
        }
    }
}

impl OutOfLimits {
    /// How far the tension is beyond the limit, as a share of it.
    pub fn excess(&self) -> f64 {
        (self.tension / self.value - 1.0).abs()
    }

    /// Whether the cable breaks or is strained beyond what is allowed; a slack cable is worth knowing only.
    pub fn is_too_much(&self) -> bool {
        matches!(self.limit, Limit::BreakingForce | Limit::Strain | Limit::Max)
    }

    /// The one of a cable: beyond the most serious limit of all, at the anchor point if it is passed there,
    /// and farthest beyond it.
    fn of_cable(robot: &Robot, cable: usize, tensions: impl Iterator<Item = [f64; 2]>) -> Option<Self> {
        let TensionLimits { min, max } = robot.limits(cable);
        let (breaking, max_at) = (robot.cables[cable].properties.breaking_force, robot.max_at(cable));
        let rounding = ROUNDED_STRAIN * robot.cable(cable).axial_stiffness;
        let strained = robot.cable(cable).tension(MAX_STRAIN);
        let mut worst: Option<Self> = None;
        for (end, tension) in tensions.flat_map(|[t, exit]| [(CableEnd::Anchor, t), (CableEnd::Exit, exit)]) {
            let above = |limit: f64| tension > limit * (1.0 + ON_LIMIT) + rounding;
            let (limit, value) = match breaking {
                Some(force) if above(force) => (Limit::BreakingForce, force),
                _ if above(strained) => (Limit::Strain, strained),
                _ if above(max) && end == max_at => (Limit::Max, max),
                _ if above(max) => (Limit::MaxElsewhere, max),
                _ if end == CableEnd::Anchor && tension < min * (1.0 - ON_LIMIT) - rounding => {
                    (Limit::Min, min)
                }
                _ => continue,
            };
            let rank =
                |found: &Self| (found.limit, !found.end.is_anchor(), -(found.tension - found.value).abs());
            let found = Self { cable, end, tension, limit, value };
            if worst.is_none_or(|worst| rank(&found) < rank(&worst)) {
                worst = Some(found);
            }
        }
        worst
    }
}

/// The tensions that the models choose for cable `i`: within its limits, and at most the breaking force where
/// its greatest tension is limited.
pub fn allowed(robot: &Robot, i: usize) -> TensionLimits {
    let TensionLimits { min, max } = robot.limits(i);
    let breaking = robot.cables[i].properties.breaking_force.unwrap_or(f64::INFINITY);
    TensionLimits { min, max: max.min(breaking.max(min)) }
}

/// The tensions of a robot with these unstrained lengths [m] that are out of limits in any of the equilibria,
/// at either end: at most one for each cable, that beyond the most serious limit.
pub fn out_of_limits(robot: &Robot, lengths: &[f64], equilibria: &[&Equilibrium]) -> Vec<OutOfLimits> {
    let ends: Vec<_> = equilibria.iter().map(|at| at.end_tensions(robot, lengths)).collect();
    tensions_out_of_limits(robot, &ends)
}

/// The same for equilibria that are known by the tension of every cable at the platform and at its exit point
/// [N].
pub fn tensions_out_of_limits(robot: &Robot, equilibria: &[Vec<[f64; 2]>]) -> Vec<OutOfLimits> {
    let of_cable = |cable| OutOfLimits::of_cable(robot, cable, equilibria.iter().map(|ends| ends[cable]));
    let cables = equilibria.iter().map(Vec::len).min().unwrap_or(0);
    (0..cables.min(robot.cables.len())).filter_map(of_cable).collect()
}

impl Equilibrium {
    /// Tension of every cable at the platform and at its exit point [N], see [`Equilibrium::exit_tensions`].
    pub(crate) fn end_tensions(&self, robot: &Robot, lengths: &[f64]) -> Vec<[f64; 2]> {
        let exits = self.exit_tensions(robot, lengths);
        self.tensions().into_iter().zip(exits).map(|(anchor, exit)| [anchor, exit]).collect()
    }
}

/// Share of a limit within which the distance from it is said, as the tension reads like the limit.
const NEAR: f64 = 1e-3;

impl OutOfLimits {
    /// Its limit in words.
    fn limit_in_words(&self) -> String {
        let value = self.value;
        match self.limit {
            Limit::BreakingForce => format!("its breaking force, {value} N"),
            Limit::Strain => format!("the one of the greatest strain, {value} N"),
            Limit::Max => format!("tension_limits.max, {value} N"),
            Limit::MaxElsewhere => format!("tension_limits.max, {value} N, of its other end"),
            Limit::Min => format!("tension_limits.min, {value} N"),
        }
    }

    /// Where the tension is, and `above` or `below`.
    fn sides(&self) -> [&'static str; 2] {
        let end = if self.end.is_anchor() { "" } else { " at the exit point" };
        [end, if self.limit == Limit::Min { "below" } else { "above" }]
    }

    /// Distance from the limit [N] in words, where the tension reads like the limit.
    fn distance_in_words(&self) -> Option<String> {
        (self.excess() < NEAR).then(|| significant((self.tension - self.value).abs(), 2))
    }
}

impl fmt::Display for OutOfLimits {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let ([end, side], limit, cable) = (self.sides(), self.limit_in_words(), self.cable + 1);
        match self.distance_in_words() {
            Some(distance) => write!(f, "cable {cable}: its tension{end} is {distance} N {side} {limit}"),
            None => {
                let tension = visible(self.tension, 3);
                write!(f, "cable {cable}: its tension of {tension} N{end} is {side} {limit}")
            }
        }
    }
}

/// Tensions out of limits in words: one line for all cables that pass the same limit.
pub fn in_words(list: &[OutOfLimits]) -> Vec<String> {
    let is_same =
        |a: &OutOfLimits, b: &OutOfLimits| a.limit == b.limit && a.end == b.end && a.value == b.value;
    let is_first = |(k, one): &(usize, &OutOfLimits)| !list[..*k].iter().any(|other| is_same(one, other));
    let firsts = list.iter().enumerate().filter(is_first).map(|(_, one)| one);
    let line = |one: &OutOfLimits| {
        let same: Vec<&OutOfLimits> = list.iter().filter(|other| is_same(one, other)).collect();
        let worst = same.iter().copied().max_by(|a, b| a.excess().total_cmp(&b.excess())).unwrap_or(one);
        if same.len() < 2 {
            return worst.to_string();
        }
        let cables = cables_in_words(&same.iter().map(|one| one.cable).collect::<Vec<_>>());
        let ([end, side], limit) = (worst.sides(), worst.limit_in_words());
        if let Some(distance) = worst.distance_in_words() {
            return format!("{cables}: tension{end} is up to {distance} N {side} {limit}");
        }
        let (to, tension) = (if side == "below" { "down to" } else { "up to" }, visible(worst.tension, 3));
        format!("{cables}: tension {to} {tension} N{end} is {side} {limit}")
    };
    firsts.map(line).collect()
}

/// Cables by their indices, from 0, in words: `cable 3`, `cables 1, 4`, `cables 1 to 8`.
pub fn cables_in_words(indices: &[usize]) -> String {
    let mut runs: Vec<[usize; 2]> = Vec::new();
    for number in indices.iter().map(|i| i + 1) {
        match runs.last_mut() {
            Some([_, last]) if *last + 1 == number => *last = number,
            _ => runs.push([number; 2]),
        }
    }
    let run = |[first, last]: &[usize; 2]| match last - first {
        0 => first.to_string(),
        1 => format!("{first}, {last}"),
        _ => format!("{first} to {last}"),
    };
    let runs: Vec<String> = runs.iter().map(run).collect();
    format!("cable{} {}", if indices.len() == 1 { "" } else { "s" }, runs.join(", "))
}
