//! The results of one part of a study.

use crate::analysis::poses::PosesSummary;
use crate::analysis::sampling::SamplingSummary;
use crate::analysis::surface::SurfaceSummary;
use crate::analysis::verdict::PartVerdict;
use crate::file::output::Output;
use cdpr_sensitivity::BestFit;
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;

/// Results of a sampling, at one pose or several, or of a surface.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(untagged, expecting = "expected the results of a sampling or of a surface")]
pub enum StudySummary {
    /// Summary of a sampling at one pose.
    Sampling(Box<SamplingSummary>),
    /// Summary of a surface.
    Surface(SurfaceSummary),
    /// Summary of a sampling at several poses.
    Poses(PosesSummary),
}

/// A value that all parts have.
macro_rules! of_part {
    ($summary:expr, $part:ident => $value:expr) => {
        match $summary {
            StudySummary::Sampling($part) => $value,
            StudySummary::Surface($part) => $value,
            StudySummary::Poses($part) => $value,
        }
    };
}

impl StudySummary {
    /// Title.
    pub fn title(&self) -> &str {
        of_part!(self, part => &part.title)
    }

    /// The answer in words.
    pub fn verdict(&self) -> &PartVerdict {
        of_part!(self, part => &part.verdict)
    }

    /// What is observed.
    pub fn output(&self) -> Output {
        of_part!(self, part => part.output)
    }

    /// Observations or points of the grid, failed ones included.
    pub fn observations(&self) -> usize {
        of_part!(self, part => part.observations)
    }

    /// Failed ones by kind.
    pub fn failed(&self) -> &BTreeMap<String, usize> {
        of_part!(self, part => &part.failed)
    }

    /// What of the nominal robot is above limits or breaking forces, as in `with the payload: cable 3 ...`.
    pub fn out_of_limits(&self) -> Vec<String> {
        match self {
            Self::Sampling(sampling) => sampling.nominal.out_of_limits.clone(),
            Self::Surface(surface) => surface.out_of_limits.clone(),
            Self::Poses(PosesSummary { out_of_limits: 0, .. }) => Vec::new(),
            Self::Poses(PosesSummary { out_of_limits, poses, .. }) => vec![format!(
                "at {out_of_limits} of {poses} poses: tensions above tension_limits.max or a breaking force"
            )],
        }
    }

    /// The row of this part in an overview of the study.
    pub fn overview(&self) -> Overview {
        match self {
            Self::Sampling(sampling) => {
                let values = sampling.values.as_ref();
                Overview {
                    nominal: values.map(|values| values.nominal),
                    mean: values.map(|values| values.mean),
                    std: values.map(|values| values.std),
                    min: values.map(|values| values.min),
                    max: values.map(|values| values.max),
                    best_fit: sampling.best_fit,
                }
            }
            Self::Surface(SurfaceSummary { values, .. }) => Overview {
                nominal: Some(values.nominal),
                min: values.min,
                max: values.max,
                ..Overview::default()
            },
            // Means over the observations, at the poses where they are least and greatest.
            Self::Poses(PosesSummary { mean, .. }) => Overview {
                min: mean.map(|mean| mean.min),
                max: mean.map(|mean| mean.max),
                ..Overview::default()
            },
        }
    }
}

/// The output of one part of a study, in its unit; what the part does not have is absent.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Overview {
    /// Value of the nominal robot.
    pub nominal: Option<f64>,
    /// Mean.
    pub mean: Option<f64>,
    /// Standard deviation.
    pub std: Option<f64>,
    /// Least value; of a sampling at several poses the least mean.
    pub min: Option<f64>,
    /// Greatest value; of a sampling at several poses the greatest mean.
    pub max: Option<f64>,
    /// The law that fits best, and what the observations say of it.
    pub best_fit: Option<BestFit>,
}
