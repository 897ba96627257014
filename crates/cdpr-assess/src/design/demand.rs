//! The demands on a robot: their order among the excesses of an evaluation.
//!
//! Of each pose come the limits of its outputs, then that of the exit tension of each cable, then, under a
//! load, the greatest tension of each cable; after all poses the limits of cost and length, then the bounds
//! of a second objective.

use crate::design::goal::Goal;
use crate::design::problem::DesignProblem;
use cdpr_statics::Load;

/// What a design has to meet; poses and cables from 0.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Demand {
    /// The limit of an output at a pose.
    Output { pose: usize, output: Goal, limit: f64 },
    /// The limit of the tension of a cable at its exit point at a pose.
    Exit { pose: usize, cable: usize, limit: f64 },
    /// The greatest tension of a cable at a pose.
    Tension { pose: usize, cable: usize },
    /// The limit of cost or length, which are of all poses together.
    Whole { of: Goal, limit: f64 },
    /// The bound of a second objective.
    Second,
}

impl DesignProblem {
    /// The demand that an excess is about, by its index.
    pub(crate) fn demand(&self, index: usize) -> Demand {
        let each = self.excesses_each();
        if let Some(after) = index.checked_sub(each * self.poses.len()) {
            let whole = self.limits.whole().nth(after);
            return whole.map_or(Demand::Second, |(of, limit)| Demand::Whole { of, limit });
        }
        let (pose, of) = (index / each, index % each);
        let outputs = self.limits.each().count();
        match (self.limits.each().nth(of), self.limits.tension) {
            (Some((output, limit)), _) => Demand::Output { pose, output, limit },
            (None, Some(limit)) if of - outputs < self.robot.cables.len() => {
                Demand::Exit { pose, cable: of - outputs, limit }
            }
            (None, _) => Demand::Tension { pose, cable: of - outputs - self.exits_each() },
        }
    }

    /// Excesses of exit tensions at each pose.
    fn exits_each(&self) -> usize {
        if self.limits.tension.is_some() { self.robot.cables.len() } else { 0 }
    }

    /// Excesses of greatest tensions at each pose.
    pub(crate) fn tensions_each(&self) -> usize {
        if self.load == Load::none() { 0 } else { self.robot.cables.len() }
    }

    /// Excesses at each pose.
    fn excesses_each(&self) -> usize {
        self.limits.each().count() + self.exits_each() + self.tensions_each()
    }

    /// Excesses before those of the bound of a second objective.
    pub(crate) fn excesses_before_bound(&self) -> usize {
        self.excesses_each() * self.poses.len() + self.limits.whole().count()
    }
}
