//! The result of an observation, or the reason of its failure.

use crate::file::output::Output;
use cdpr_robot::Vector3;
use cdpr_statics::{ScalarReason, StaticsError};
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;

/// What was observed of a robot, or the reason of its failure.
pub type Observed = Result<Measured, Failure>;

/// What was observed of a robot.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Measured {
    /// What was observed.
    pub quantity: MeasuredQuantity,
    /// Why the scalar models observed it, and not the lanes of the vector unit.
    pub scalar: Option<ScalarReason>,
}

/// An output of a robot.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum MeasuredQuantity {
    /// A displacement [m], whose length is the output.
    Displacement(Vector3<f64>),
    /// The output in its unit.
    Number(f64),
}

impl Measured {
    /// The output in its unit.
    pub fn value(&self) -> f64 {
        match &self.quantity {
            MeasuredQuantity::Displacement(displacement) => 1e3 * displacement.norm(),
            MeasuredQuantity::Number(number) => *number,
        }
    }

    /// Its cells in tables, under [`Output::columns`].
    pub fn cells(&self) -> impl Iterator<Item = f64> {
        let displacement = match &self.quantity {
            MeasuredQuantity::Displacement(displacement) => Some(1e3 * displacement),
            MeasuredQuantity::Number(_) => None,
        };
        displacement.into_iter().flat_map(<[f64; 3]>::from).chain([self.value()])
    }
}

impl MeasuredQuantity {
    /// Its numbers in blocks.
    pub(crate) fn numbers(&self) -> &[f64] {
        match self {
            Self::Displacement(displacement) => displacement.as_slice(),
            Self::Number(number) => std::slice::from_ref(number),
        }
    }
}

impl Output {
    /// What stands for a failed observation where there has to be a number.
    pub fn nothing(self) -> Measured {
        let quantity = if self.is_length() {
            MeasuredQuantity::Displacement(Vector3::repeat(f64::NAN))
        } else {
            MeasuredQuantity::Number(f64::NAN)
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
