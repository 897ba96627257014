//! What fits say of the family that a sample comes from: that it is one of those tried, that several are
//! possible, or that none is.
//!
//! A family is *possible* unless its probability is 1 - [`DECIDED`] or less, or its p-value is [`REJECTED`]
//! or less.
//!
//! The probability alone would be too little: it compares the families that were tried, and is 1 for the best
//! of several wrong ones. The p-value alone would be too little as well: a small sample rejects none.

use serde::{Deserialize, Serialize};

use crate::family::Family;
use crate::law::fit::Fit;

/// Probability from which on a family is decided on.
///
/// A sample of one family has a likelihood 19 times as large in another one with a probability of at most
/// 1/19 (Markov's inequality): the wrong family is decided on in about 5 % of the samples at most, whatever
/// the law.
pub const DECIDED: f64 = 0.95;

/// p-value up to which a family is rejected.
pub const REJECTED: f64 = 0.05;

/// How far a sample says which family it comes from.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(feature = "schemars", derive(schemars::JsonSchema))]
#[serde(rename_all = "snake_case")]
pub enum Evidence {
    /// One family of several is possible, with a probability of at least [`DECIDED`].
    Decided,
    /// Several families are possible, only one was tried, or the bootstrap is too small to reject any.
    Undecided,
    /// No family that was tried is possible.
    Rejected,
}

/// The family that fits a sample best, and what the sample says of it. `Display` writes it with its p-value.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schemars", derive(schemars::JsonSchema))]
pub struct BestFit {
    /// The most probable family among the possible ones; among all where none is possible.
    pub family: Family,
    /// What the sample says of it.
    pub evidence: Evidence,
    /// Probability of the family among those tried.
    pub probability: f64,
    /// p-value of its law ([`Fit::p_value`]).
    pub p_value: f64,
    /// Whether no sample of the bootstrap had so large a distance: p may be smaller.
    pub p_is_bound: bool,
}

impl BestFit {
    /// Of fits to one sample; `None` without any.
    #[must_use]
    pub fn of(fits: &[Fit]) -> Option<Self> {
        let more_probable = |one: &&Fit, other: &&Fit| one.probability.total_cmp(&other.probability);
        let possible = || fits.iter().filter(|fit| fit.is_possible());
        let best = possible().max_by(more_probable).or(fits.iter().max_by(more_probable))?;
        let evidence = match possible().count() {
            0 => Evidence::Rejected,
            1 if fits.len() > 1 && best.probability >= DECIDED && best.may_be_rejected() => Evidence::Decided,
            _ => Evidence::Undecided,
        };
        Some(Self {
            family: best.family,
            evidence,
            probability: best.probability,
            p_value: best.p_value,
            p_is_bound: best.p_is_bound(),
        })
    }
}

impl Fit {
    /// Whether neither the other families nor the distance of the sample speak against this one.
    #[must_use]
    pub fn is_possible(&self) -> bool {
        is_possible(self.probability, self.p_value)
    }

    /// Whether the bootstrap has enough samples for a p-value of [`REJECTED`]: 19.
    fn may_be_rejected(&self) -> bool {
        (self.resamples + 1) as f64 * REJECTED >= 1.0
    }

    /// Whether no sample of the bootstrap had so large a distance: p may be smaller.
    #[must_use]
    pub fn p_is_bound(&self) -> bool {
        self.p_value * (self.resamples + 1) as f64 <= 1.0
    }
}

/// Whether a family of this probability and p-value is possible.
#[must_use]
pub fn is_possible(probability: f64, p_value: f64) -> bool {
    probability > 1.0 - DECIDED && p_value > REJECTED
}

impl std::fmt::Display for BestFit {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let Self { family, p_value, .. } = self;
        let sign = if self.p_is_bound { "<=" } else { "=" };
        let text = match self.evidence {
            Evidence::Decided => format!("{family}, p {sign} {p_value:.3}"),
            Evidence::Undecided => format!("{family} (undecided), p {sign} {p_value:.3}"),
            Evidence::Rejected => {
                format!("{family}: best of those tried, and rejected (p {sign} {p_value:.3})")
            }
        };
        f.pad(&text)
    }
}
