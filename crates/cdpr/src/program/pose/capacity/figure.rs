//! A payload or a margin, and what blocks a greater one.

use crate::program::answer::vector;
use crate::program::pose::at_pose::Failure;
use cdpr_assess::{Block, Figure, WrenchSet};
use cdpr_statics::StaticsError;
use serde::Serialize;

/// A figure, or why it does not exist.
#[derive(Serialize)]
pub(super) struct Shown {
    /// `null` where the figure does not exist, a limit is passed without a payload, or none is too much.
    pub(super) value: Option<f64>,
    /// Whether no payload is too much.
    #[serde(skip_serializing_if = "std::ops::Not::not")]
    pub(super) unbounded: bool,
    /// The wrench of the set that leaves the least, fx to mz; absent for a single one.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(super) wrench: Option<[f64; 6]>,
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub(super) blocking: Vec<Blocking>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(super) error: Option<Failure>,
}

/// Why no payload is too much.
pub(super) const WEIGHTLESS: &str = "its weight does not pull at the cables";

/// A limit that blocks a greater value.
#[derive(Serialize)]
pub(super) struct Blocking {
    pub(super) cable: usize,
    /// `min`, `max`, `breaking_force` or `strain`.
    pub(super) limit: &'static str,
    /// The limit [N].
    #[serde(rename = "value_n")]
    pub(super) value: f64,
    /// By how much the figure grows where the limit gives way [kg/N, N/N].
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(super) gain: Option<f64>,
    #[serde(skip)]
    pub(super) words: String,
}

impl Blocking {
    /// `None` where the platform is lost and no limit reached.
    pub(super) fn new(block: &Block) -> Option<Self> {
        let Block::Limit { cable, limit, value, gain } = *block else { return None };
        Some(Self { cable: cable + 1, limit: limit.name(), value, gain, words: block.to_string() })
    }
}

impl Shown {
    pub(super) fn new(figure: Result<Figure, StaticsError>, set: &WrenchSet) -> Self {
        let none = Self { value: None, unbounded: false, wrench: None, blocking: Vec::new(), error: None };
        let Figure { value, wrench, blocking } = match figure {
            Ok(figure) => figure,
            Err(error) => return Self { error: Some(error.into()), ..none },
        };
        let wrenches = set.wrenches();
        let mut shown = Self {
            value: value.is_finite().then_some(value),
            unbounded: value == f64::INFINITY,
            wrench: (wrenches.len() > 1).then(|| wrenches[wrench].to_vector().into()),
            ..none
        };
        for block in blocking {
            shown.blocking.extend(Blocking::new(&block));
            let message = block.to_string();
            if let Block::Lost(error) = block {
                // At this payload, and not at a share of one.
                let mut failure = Failure::from(error.with_share(|_| 1.0));
                failure.message = message;
                shown.error = Some(failure);
            }
        }
        shown
    }

    /// What blocks, in words.
    pub(super) fn words(&self) -> String {
        let mut words: Vec<_> = self.blocking.iter().map(|blocking| blocking.words.clone()).collect();
        if let Some(wrench) = &self.wrench {
            words.push(format!("under the wrench {}", vector(wrench, 1)));
        }
        words.extend(self.error.as_ref().map(|error| error.message.clone()));
        words.extend(self.unbounded.then(|| WEIGHTLESS.to_owned()));
        words.join("; ")
    }

    /// Why it does not exist, in a few words.
    pub(super) fn cause(&self) -> &str {
        let message = self.error.as_ref().map_or("", |error| error.message.as_str());
        message.split(';').next().unwrap_or_default()
    }

    pub(super) fn number(&self) -> String {
        self.value.map_or_else(String::new, |value| format!("{value:?}"))
    }
}
