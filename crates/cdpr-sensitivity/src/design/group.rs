//! Groups of inputs, which a design moves together.

use std::collections::BTreeSet;

use serde::{Deserialize, Serialize};

use crate::design::input::Input;
use crate::error::{SensitivityError, check_range};

/// Inputs that are regarded as one.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(feature = "schemars", derive(schemars::JsonSchema))]
pub struct Group {
    /// Name of the group.
    pub name: String,
    /// Indices of its inputs, from 0.
    pub inputs: Vec<usize>,
}

impl Group {
    /// The group of these inputs.
    pub fn new(name: impl Into<String>, inputs: impl IntoIterator<Item = usize>) -> Self {
        Self { name: name.into(), inputs: inputs.into_iter().collect() }
    }

    /// One group for each input, of its name.
    pub(crate) fn singles(inputs: &[Input]) -> Vec<Self> {
        inputs.iter().enumerate().map(|(i, input)| Self::new(input.name.clone(), [i])).collect()
    }

    /// Whether the group contains this input.
    pub(crate) fn contains(&self, input: usize) -> bool {
        self.inputs.contains(&input)
    }
}

/// How groups may lie to each other.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Overlap {
    /// An input may be in several groups or in none.
    Allowed,
    /// An input is in one group at most.
    Disjoint,
    /// An input is in exactly one group.
    Partition,
}

/// Checks that there is a group, that each has inputs and each of them once, and how they overlap.
pub(crate) fn check_groups(
    groups: &[Group],
    inputs: &[Input],
    overlap: Overlap,
) -> Result<(), SensitivityError> {
    check_range("groups", groups.len() as u64, 1, u64::MAX)?;
    let wrong = |group: &Group, expected| SensitivityError::WrongGroup { name: group.name.clone(), expected };
    let mut seen = BTreeSet::new();
    for group in groups {
        let own: BTreeSet<usize> = group.inputs.iter().copied().collect();
        if own.is_empty() || own.len() < group.inputs.len() {
            return Err(wrong(group, "at least one input, and none of them twice"));
        }
        if own.last().is_some_and(|&last| last >= inputs.len()) {
            return Err(wrong(group, "indices of inputs of the design"));
        }
        if overlap != Overlap::Allowed && own.iter().any(|input| !seen.insert(*input)) {
            return Err(wrong(group, "no input of a group before it"));
        }
    }
    if overlap == Overlap::Partition && seen.len() < inputs.len() {
        return Err(wrong(&groups[groups.len() - 1], "together with the others every input of the design"));
    }
    Ok(())
}
