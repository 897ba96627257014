//! The results of one part of a study.

use crate::analysis::poses::PosesSummary;
use crate::analysis::sampling::SamplingSummary;
use crate::analysis::surface::SurfaceSummary;
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;

/// Results of a sampling, at one pose or several, or of a surface.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(untagged)]
pub enum StudySummary {
    /// Of a sampling.
    Sampling(Box<SamplingSummary>),
    /// Of a surface.
    Surface(SurfaceSummary),
    /// Of a sampling at several poses.
    Poses(PosesSummary),
}

impl StudySummary {
    /// Title.
    pub fn title(&self) -> &str {
        match self {
            Self::Sampling(sampling) => &sampling.title,
            Self::Surface(surface) => &surface.title,
            Self::Poses(poses) => &poses.title,
        }
    }

    /// Observations or points of the grid, failed ones included.
    pub fn observations(&self) -> usize {
        match self {
            Self::Sampling(sampling) => sampling.observations,
            Self::Surface(surface) => surface.observations,
            Self::Poses(poses) => poses.observations,
        }
    }

    /// Failed ones by kind.
    pub fn failed(&self) -> &BTreeMap<String, usize> {
        match self {
            Self::Sampling(sampling) => &sampling.failed,
            Self::Surface(surface) => &surface.failed,
            Self::Poses(poses) => &poses.failed,
        }
    }
}
