//! What a calibration takes, and its summary.

use crate::fitted::{FitSettings, FitStatus, UNLIKELY};
use crate::results::patterns::{Split, Trend};
use crate::results::predicted::UncertaintyMap;
use crate::table::Measurements;
use crate::unknowns::Unknowns;
use cdpr_robot::Robot;
use cdpr_study::ErrorModel;
use indexmap::IndexMap;
use serde::Serialize;
use std::collections::BTreeMap;

/// A parameter before and after, in its SI unit.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct ParameterSummary {
    /// SI unit.
    pub unit: &'static str,
    /// Value in the robot file; of a tilt or an error of a sensor, zero.
    pub before: f64,
    /// Value found.
    pub after: f64,
    /// Standard deviation of what is left, by data and priors; none for what neither tells.
    pub std: Option<f64>,
    /// Standard deviation by the data alone, without priors; none for what they do not tell.
    pub std_of_data: Option<f64>,
    /// Standard deviation before.
    pub prior_std: Option<f64>,
    /// The change in standard deviations before.
    pub moved_by_prior_std: Option<f64>,
    /// Whether the data alone tell it: more exactly than the prior or, without one, than to its own size.
    pub identifiable: bool,
}

impl ParameterSummary {
    /// A parameter that has moved by this, with its standard deviations: after, by the data alone, and
    /// before.
    pub(super) fn new(
        before: f64,
        moved: f64,
        [std, std_of_data, prior_std]: [Option<f64>; 3],
        unit: &'static str,
    ) -> Self {
        Self {
            unit,
            before,
            after: before + moved,
            std,
            std_of_data,
            prior_std,
            moved_by_prior_std: prior_std.map(|std| moved / std),
            identifiable: std_of_data.is_some(),
        }
    }
}

/// Residuals of the sensors of one kind.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct SensorSummary {
    /// SI unit.
    pub unit: &'static str,
    /// Numbers measured.
    pub count: usize,
    /// Root mean square of measured less modelled, with the robot file.
    pub rms_before: f64,
    /// With the calibrated robot.
    pub rms_after: f64,
    /// With the calibrated robot, in standard deviations of the noise.
    pub standardized_rms_after: f64,
    /// Root mean square of errors of prediction, with robots calibrated without the rows predicted.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub rms_predicted: Option<f64>,
}

/// A measured number far from the model.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct OutlierSummary {
    /// Line in the file of measurements.
    pub line: usize,
    /// Column, by its name in the file.
    pub column: String,
    /// Measured less modelled, in the SI unit.
    pub difference: f64,
    /// In standard deviations of the noise.
    pub standard_deviations: f64,
}

/// The one row that is far from the model, where that makes most of the misfit.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct RowApart {
    /// Line in the file of measurements.
    pub line: usize,
    /// Its share of the sum of squares.
    pub share: f64,
    /// Whether the other rows fit within their noise.
    pub others_fit: bool,
}

/// A summary of a calibration.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct CalibrationSummary {
    /// Name of the robot.
    pub robot: String,
    /// Version of the program.
    pub version: &'static str,
    /// Rows of measurements.
    pub rows: usize,
    /// The parameters by name.
    pub parameters: IndexMap<String, ParameterSummary>,
    /// Errors of sensors by name.
    #[serde(skip_serializing_if = "IndexMap::is_empty")]
    pub sensors: IndexMap<String, ParameterSummary>,
    /// Sum of squares of all residuals in standard deviations, priors included.
    pub chi_square: f64,
    /// Its expectation, if model and noise are right.
    pub degrees_of_freedom: usize,
    /// Probability of such a chi-square or a greater one.
    pub p_value: Option<f64>,
    /// Probability of residuals of the measurements as small as these or smaller.
    pub p_value_of_less: Option<f64>,
    /// Factor by which standard deviations were multiplied, because no noise is stated: that of the
    /// residuals.
    pub noise_scale: f64,
    /// Combinations of parameters that the data do not tell, weights in units of their scales.
    pub not_identifiable: Vec<Vec<(String, f64)>>,
    /// Residuals by sensor.
    pub residuals: BTreeMap<&'static str, SensorSummary>,
    /// Measured numbers that are far from the model.
    pub outliers: Vec<OutlierSummary>,
    /// The row that is far from all others, where there is one.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub row_apart: Option<RowApart>,
    /// One constant error of all lengths that would explain a chi-square that is unlikely.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub length_constant: Option<LengthConstant>,
    /// Clear trends of residuals against place and load.
    pub trends: Vec<Trend>,
    /// Variances of means over consecutive rows.
    pub splits: Vec<Split>,
    /// Standard deviation of the position over the plane of the measured poses.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub workspace: Option<UncertaintyMap>,
    /// Mean standard deviation of the position at the poses measured, per coordinate, before [m]; none
    /// without prior, and with errors of the winches.
    #[serde(rename = "position_std_before_m")]
    pub position_std_before: Option<f64>,
    /// The same after [m], with the lengths by the offsets and scales of the winches that were found; none
    /// where unknowns that nothing identifies displace the platform.
    #[serde(rename = "position_std_after_m")]
    pub position_std_after: Option<f64>,
    /// Unknowns that nothing identifies, where they displace the platform.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub position_depends_on: Vec<String>,
    /// Steps of the search.
    pub steps: usize,
    /// Whether it ended at a minimum, and what shows that it is the least.
    pub status: FitStatus,
    /// Starts, and how many of them ended at the least chi-square.
    pub starts: [usize; 2],
    /// What is odd about the result, a sentence each.
    pub warnings: Vec<String>,
}

/// One constant error of all lengths, by a linearization.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct LengthConstant {
    /// Measured less right lengths [m].
    #[serde(rename = "error_m")]
    pub metres: f64,
    /// Share of chi-square that it explains.
    pub share: f64,
}

impl CalibrationSummary {
    /// Whether right models and noise seldom leave such a chi-square: what is stated of the accuracy is void.
    pub fn is_unlikely(&self) -> bool {
        self.p_value.is_some_and(|p| p < UNLIKELY)
    }
}

/// What a calibration takes.
#[derive(Clone, Copy, Debug)]
pub struct Campaign<'a> {
    /// The robot before.
    pub robot: &'a Robot,
    /// The tolerances, if they are known.
    pub prior: Option<&'a ErrorModel>,
    /// What is sought.
    pub unknowns: &'a Unknowns,
    /// What was measured.
    pub measured: &'a Measurements,
    /// Name of the file of measurements, for the provenance of the robot.
    pub name: &'a str,
    /// How the fit is made.
    pub settings: FitSettings,
    /// Parts that are predicted by robots calibrated without them; below 2 none, at most one a row.
    pub folds: usize,
}

impl Campaign<'_> {
    /// Parts at most.
    pub const MOST_FOLDS: usize = 10_000;
}
