//! The result of an observation, or the reason of its failure.

use crate::file::output::{Output, Recorded};
use cdpr_robot::{Vector3, Vector6};
use cdpr_statics::StaticsError;
use cdpr_statics::batch::ScalarReason;
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;

/// What was observed of a robot, or the reason of its failure.
pub type Observed = Result<Measured, Failure>;

/// What was observed of a robot.
#[derive(Clone, Debug, PartialEq)]
pub struct Measured {
    /// What was observed.
    pub quantity: MeasuredQuantity,
    /// Why the scalar models observed it, and not the lanes of the vector unit.
    pub scalar: Option<ScalarReason>,
}

/// An output of a robot.
#[derive(Clone, Debug, PartialEq)]
pub enum MeasuredQuantity {
    /// A displacement [m], whose length is the output.
    Displacement(Vector3<f64>),
    /// The same with the rotation vector [rad] in the base frame, for indices of the pose. Its place is
    /// elsewhere, so that other observations take no more memory.
    Motion(Box<Vector6<f64>>),
    /// The output in its unit.
    Number(f64),
}

impl Measured {
    /// The output in its unit.
    pub fn value(&self) -> f64 {
        match (&self.quantity, self.quantity.displacement()) {
            (MeasuredQuantity::Number(number), _) => *number,
            (_, displacement) => 1e3 * displacement.map_or(f64::NAN, |of| of.norm()),
        }
    }

    /// Its cells in tables, under [`Output::columns`].
    pub fn cells(&self) -> impl Iterator<Item = f64> {
        let displacement = self.quantity.displacement().map(|displacement| 1e3 * displacement);
        displacement.into_iter().flat_map(<[f64; 3]>::from).chain([self.value()])
    }
}

impl MeasuredQuantity {
    /// The displacement [m] whose length is the output.
    pub fn displacement(&self) -> Option<Vector3<f64>> {
        match self {
            Self::Displacement(displacement) => Some(*displacement),
            Self::Motion(motion) => Some(motion.fixed_rows::<3>(0).into()),
            Self::Number(_) => None,
        }
    }

    /// The rotation vector that belongs to it [rad], where it is kept.
    pub fn rotation(&self) -> Option<Vector3<f64>> {
        match self {
            Self::Motion(motion) => Some(motion.fixed_rows::<3>(3).into()),
            Self::Displacement(_) | Self::Number(_) => None,
        }
    }

    /// Its numbers in blocks.
    pub(crate) fn numbers(&self) -> &[f64] {
        match self {
            Self::Displacement(displacement) => displacement.as_slice(),
            Self::Motion(motion) => motion.as_slice(),
            Self::Number(number) => std::slice::from_ref(number),
        }
    }
}

impl Output {
    /// What stands for a failed observation where there has to be a number.
    pub fn nothing(self) -> Measured {
        self.nothing_recorded(Recorded::Output)
    }

    /// The same where this is kept of observations.
    pub(crate) fn nothing_recorded(self, recorded: Recorded) -> Measured {
        let quantity = match recorded {
            Recorded::Motion => MeasuredQuantity::Motion(Box::new(Vector6::repeat(f64::NAN))),
            Recorded::Output if self.is_length() => MeasuredQuantity::Displacement(Vector3::repeat(f64::NAN)),
            Recorded::Output => MeasuredQuantity::Number(f64::NAN),
        };
        Measured { quantity, scalar: None }
    }
}

/// Why an observation failed.
#[derive(Clone, Debug, PartialEq)]
pub struct Failure {
    /// Kind of the failure, such as `infeasible_tension`.
    pub kind: String,
    /// The reason with its numbers.
    pub reason: String,
}

impl From<StaticsError> for Failure {
    fn from(error: StaticsError) -> Self {
        Self { kind: error.kind().to_owned(), reason: error.to_string() }
    }
}

/// Output of an observation that has not failed, in its unit.
pub(crate) fn value_of(outcome: &Observed) -> Option<f64> {
    outcome.as_ref().ok().map(Measured::value)
}

/// `ok`, or the kind of the failure and its reason.
pub(crate) fn status(outcome: &Observed) -> (&str, &str) {
    outcome.as_ref().map_or_else(|failure| (failure.kind.as_str(), failure.reason.as_str()), |_| ("ok", ""))
}

/// Kinds of the failures among outcomes.
pub(crate) fn failures(outcomes: &[Observed]) -> impl Iterator<Item = &str> {
    outcomes.iter().filter_map(|outcome| outcome.as_ref().err()).map(|failure| failure.kind.as_str())
}

/// Failures by kind; the usual kinds are always listed.
pub(crate) fn count_failed<'a>(kinds: impl Iterator<Item = &'a str>) -> BTreeMap<String, usize> {
    let usual = ["infeasible_tension", "inverse_not_converged", "direct_not_converged"];
    let mut failed: BTreeMap<String, usize> = usual.map(|kind| (kind.to_owned(), 0)).into();
    for kind in kinds {
        *failed.entry(kind.to_owned()).or_default() += 1;
    }
    failed
}

/// Observations with an answer of the scalar models, and why the lanes of the vector unit did not give it.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct ScalarCount {
    /// Number of all.
    pub count: usize,
    /// Number of each reason.
    pub why: BTreeMap<String, usize>,
}

impl ScalarCount {
    pub(crate) fn of(outcomes: &[Observed]) -> Self {
        let mut counted = Self::default();
        for why in outcomes.iter().flatten().filter_map(|measured| measured.scalar) {
            counted.add(why.name(), 1);
        }
        counted
    }

    pub(crate) fn merge(&mut self, other: &Self) {
        other.why.iter().for_each(|(why, count)| self.add(why, *count));
    }

    fn add(&mut self, why: &str, count: usize) {
        self.count += count;
        match self.why.get_mut(why) {
            Some(known) => *known += count,
            None => drop(self.why.insert(why.to_owned(), count)),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn poses_cost_other_observations_no_memory() {
        // Three numbers, which of the quantities it is, and why the scalar models observed it.
        assert!(size_of::<Option<Measured>>() <= 40);
    }
}
