//! Families of laws that can be fitted to a sample.

use serde::{Deserialize, Serialize};

/// A family of laws that can be fitted: the variants of [`crate::Law`] with two parameters.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(feature = "schemars", derive(schemars::JsonSchema))]
#[serde(rename_all = "snake_case")]
pub enum Family {
    /// [`crate::Law::Uniform`]. Its estimate spans the smallest to the largest value of the sample.
    Uniform,
    /// [`crate::Law::Normal`].
    Normal,
    /// [`crate::Law::Logistic`].
    Logistic,
    /// [`crate::Law::Laplace`].
    Laplace,
    /// [`crate::Law::Gumbel`].
    Gumbel,
    /// [`crate::Law::LogNormal`], for positive values only.
    LogNormal,
    /// [`crate::Law::Weibull`], for positive values only.
    Weibull,
}

impl Family {
    /// All families, the most common ones first.
    pub const ALL: [Self; 7] = [
        Self::Uniform,
        Self::Normal,
        Self::Logistic,
        Self::Laplace,
        Self::Gumbel,
        Self::LogNormal,
        Self::Weibull,
    ];

    /// Whether the family has laws of positive values only.
    pub(crate) fn positive(self) -> bool {
        matches!(self, Self::LogNormal | Self::Weibull)
    }
}

impl std::fmt::Display for Family {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.pad(match self {
            Self::Uniform => "uniform",
            Self::Normal => "normal",
            Self::Logistic => "logistic",
            Self::Laplace => "Laplace",
            Self::Gumbel => "Gumbel",
            Self::LogNormal => "lognormal",
            Self::Weibull => "Weibull",
        })
    }
}
