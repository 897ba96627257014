//! The payload at which tensions reach a limit while it grows from zero.

use super::{Block, Rest};
use cdpr_robot::{CableEnd, Robot};
use cdpr_statics::limits::Limit;
use cdpr_statics::{Load, MAX_STRAIN, StaticsError};

/// A limit and the way to it.
#[derive(Clone, Copy)]
pub(super) struct Near {
    cable: usize,
    limit: Limit,
    value: f64,
    /// From the tension to the limit [N], negative beyond it.
    pub(super) distance: f64,
}

impl Near {
    pub(super) fn block(&self) -> Block {
        let Self { cable, limit, value, .. } = *self;
        Block::Limit { cable, limit, value, gain: None }
    }
}

/// The limits of all cables, in an order that depends on the robot alone.
fn limits(robot: &Robot, Rest { lengths, equilibrium, .. }: &Rest) -> Vec<Near> {
    let exits = equilibrium.exit_tensions(robot, lengths);
    let each = equilibrium.tensions().into_iter().zip(exits).enumerate();
    each.flat_map(|(cable, (anchor, exit))| {
        let limits = robot.limits(cable);
        let limited = if robot.max_at(cable) == CableEnd::Anchor { anchor } else { exit };
        let near = |limit, value, distance| Near { cable, limit, value, distance };
        let breaking = robot.cables[cable].properties.breaking_force;
        let breaking = breaking.map(|force| near(Limit::BreakingForce, force, force - anchor.max(exit)));
        let [min, max] = [
            near(Limit::Min, limits.min, anchor - limits.min),
            near(Limit::Max, limits.max, limits.max - limited),
        ];
        let greatest = robot.cable(cable).tension(MAX_STRAIN);
        let strain = near(Limit::Strain, greatest, greatest - anchor.max(exit));
        [Some(min), Some(max), Some(strain), breaking].into_iter().flatten()
    })
    .collect()
}

/// The limit next to the tensions, or farthest behind them.
pub(super) fn nearest(robot: &Robot, rest: &Rest, counts: impl Fn(Limit) -> bool) -> Near {
    let all = limits(robot, rest).into_iter().filter(|near| counts(near.limit));
    let none = Near { cable: 0, limit: Limit::Max, value: f64::INFINITY, distance: f64::INFINITY };
    all.fold(none, |nearest, near| if near.distance < nearest.distance { near } else { nearest })
}

/// A payload that grows until a limit is reached.
pub(super) struct Rising<'a> {
    pub(super) robot: &'a Robot,
    /// The equilibrium at a payload [kg], from one nearby.
    pub(super) answer: &'a dyn Fn(f64, &Rest) -> Result<Rest, StaticsError>,
    /// Which limits end it.
    pub(super) counts: fn(Limit) -> bool,
}

/// A payload [kg] with its equilibrium and the limit next to it.
struct Step {
    mass: f64,
    rest: Rest,
    near: Near,
}

/// First payload over the platform's mass, greatest ratio of one to the one before, accuracy of the last one.
const FIRST: f64 = 0.01;
const GROWTH: f64 = 8.0;
const ACCURACY: f64 = 1e-10;

/// A tension beyond its limit by this share is on it.
const ON_LIMIT: f64 = 1e-9;

impl Rising<'_> {
    fn at(&self, mass: f64, near: &Rest) -> Result<Step, StaticsError> {
        let rest = (self.answer)(mass, near)?;
        let near = nearest(self.robot, &rest, self.counts);
        Ok(Step { mass, rest, near })
    }

    /// Whether no limit is passed.
    fn holds(step: &Step) -> bool {
        step.near.distance >= -ON_LIMIT * step.near.value
    }

    /// The payload at which the first limit is reached; infinite where none is.
    pub(super) fn top(&self, start: &Rest) -> Result<(f64, Vec<Block>), StaticsError> {
        const MAX_STEPS: usize = 200;
        let mut low = self.at(0.0, start)?;
        if !Self::holds(&low) {
            return Ok((f64::NEG_INFINITY, vec![low.near.block()]));
        }
        let unit = self.robot.platform.mass;
        let mut next = FIRST * unit;
        // The end of the bracket: a payload that passes a limit, or why it has no equilibrium.
        let mut high: Option<(f64, Result<Near, StaticsError>)> = None;
        for step in 0..MAX_STEPS {
            let end = high.as_ref().map_or(f64::INFINITY, |(mass, _)| *mass);
            if end.is_finite() && end - low.mass <= ACCURACY * (unit + end) {
                break;
            }
            if end.is_infinite() && next > Load::LARGEST {
                return Ok((f64::INFINITY, Vec::new()));
            }
            let tried = self.at(next, &low.rest);
            match tried {
                Ok(found) if Self::holds(&found) => {
                    // Beyond what is foreseen, so that the limit is enclosed.
                    let beyond = found.mass + 0.1 * (found.mass - low.mass);
                    next = self.foreseen(&low, &found).max(beyond).min(GROWTH * found.mass);
                    low = found;
                }
                Ok(found) => {
                    next = self.foreseen(&low, &found);
                    high = Some((found.mass, Ok(found.near)));
                }
                Err(error) => {
                    let mut end = next;
                    next = f64::INFINITY;
                    if let StaticsError::BranchEnds(branch) = &error {
                        // The share is known to less than this.
                        next = low.mass + branch.share * (end - low.mass);
                        end = end.min(next + 1e-8 * (end - low.mass));
                    }
                    high = Some((end, Err(error)));
                }
            }
            if let Some((end, _)) = &high {
                // A root foreseen from two sides; in between a bisection.
                let width = end - low.mass;
                let beside = ACCURACY * (unit + end);
                let is_inside = next > low.mass && next < *end && step % 3 != 2;
                next = if is_inside {
                    next.clamp(low.mass + 0.4 * beside.min(width), end - 0.4 * beside.min(width))
                } else {
                    low.mass + 0.5 * width
                };
            }
        }
        let block = match high {
            None => return Ok((f64::INFINITY, Vec::new())),
            Some((_, Ok(near))) => near.block(),
            // What strains a cable too much is refused.
            Some((_, Err(StaticsError::Overstrained { index, .. }))) => {
                let value = self.robot.cable(index).tension(MAX_STRAIN);
                Block::Limit { cable: index, limit: Limit::Strain, value, gain: None }
            }
            Some((_, Err(error))) => Block::Lost(error),
        };
        Ok((low.mass, vec![block]))
    }

    /// The payload at which, by two others, the first limit is reached; infinite if all become more distant.
    fn foreseen(&self, one: &Step, other: &Step) -> f64 {
        let each = [one, other].map(|step| limits(self.robot, &step.rest));
        let roots = each[0].iter().zip(&each[1]).filter(|(near, _)| (self.counts)(near.limit));
        let root = |(a, b): (&Near, &Near)| {
            let slope = (b.distance - a.distance) / (other.mass - one.mass);
            if slope < 0.0 { one.mass - a.distance / slope } else { f64::INFINITY }
        };
        roots.map(root).fold(f64::INFINITY, f64::min)
    }
}
