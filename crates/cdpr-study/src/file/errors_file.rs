//! The errors file, `cdpr-errors/1`: correlated normal deviations of parameters, as a calibration leaves
//! them.

use crate::file::study_file::InputSpec;
use cdpr_robot::Parameter;
use cdpr_sensitivity::Law;
use cdpr_statics::DMatrix;
use indexmap::IndexMap;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// Name and version of the format.
pub const ERRORS_FORMAT: &str = "cdpr-errors/1";

/// Deviations of parameters that are normal together. SI units.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(title = "cdpr-errors/1")]
pub struct ErrorsFile {
    /// Always "cdpr-errors/1".
    pub format: String,
    /// Names of the parameters: `a1.x`, `mass`.
    pub parameters: Vec<String>,
    /// Mean deviation of each from the robot file.
    pub mean: Vec<f64>,
    /// Covariance of the deviations, a row for each parameter.
    pub covariance: Vec<Vec<f64>>,
}

/// Variances below this share of the greatest are rounding, after scaling.
const ROUNDING: f64 = 1e-12;

impl ErrorsFile {
    /// The same deviations as entries of an error model. Parameters without correlation have an entry each.
    /// The others follow from independent causes, the principal components of their correlation:
    /// `posterior_1` for the greatest.
    ///
    /// # Errors
    /// Field, value and what is expected.
    pub fn entries(&self) -> Result<IndexMap<String, InputSpec>, (String, String, String)> {
        let n = self.parameters.len();
        let wrong =
            |field: &str, value: String, expected: &str| Err((field.to_owned(), value, expected.to_owned()));
        if self.format != ERRORS_FORMAT {
            return wrong("format", self.format.clone(), ERRORS_FORMAT);
        }
        for (k, name) in self.parameters.iter().enumerate() {
            if name.parse::<Parameter>().is_err() || self.parameters[..k].contains(name) {
                return wrong(&format!("parameters[{k}]"), name.clone(), "a parameter, each of them once");
            }
        }
        if self.mean.len() != n || !self.mean.iter().all(|mean| mean.is_finite()) {
            let expected = "a finite number for each parameter";
            return wrong("mean", format!("a list of {}", self.mean.len()), expected);
        }
        let is_row = |row: &Vec<f64>| row.len() == n && row.iter().all(|entry| entry.is_finite());
        if self.covariance.len() != n || !self.covariance.iter().all(is_row) {
            let expected = "a square matrix of finite numbers, a row for each parameter";
            return wrong("covariance", format!("{} rows", self.covariance.len()), expected);
        }
        let std: Vec<f64> = (0..n).map(|k| self.covariance[k][k].max(0.0).sqrt()).collect();
        let correlation = DMatrix::from_fn(n, n, |i, j| match std[i] * std[j] {
            0.0 => 0.0,
            product => self.covariance[i][j] / product,
        });
        if (&correlation - correlation.transpose()).amax() > 1e-9 {
            return wrong("covariance", "not symmetric".to_owned(), "a symmetric matrix");
        }
        let is_alone = |k: usize| (0..n).all(|j| j == k || correlation[(k, j)] == 0.0);
        let mut entries = IndexMap::new();
        let normal = |mean, std, parameters| InputSpec {
            law: Law::Normal { mean, std },
            steps: None,
            parameters,
            operating_point: None,
        };
        for k in (0..n).filter(|k| is_alone(*k) && std[*k] > 0.0) {
            entries.insert(self.parameters[k].clone(), normal(self.mean[k], std[k], None));
        }
        let joint: Vec<usize> = (0..n).filter(|k| !is_alone(*k) && std[*k] > 0.0).collect();
        let fixed = (0..n).find(|k| std[*k] == 0.0 && self.mean[*k] != 0.0);
        if let Some(k) = fixed {
            let expected = "zero for a parameter without variance";
            return wrong(&format!("mean[{k}]"), self.mean[k].to_string(), expected);
        }
        let m = joint.len();
        let eigen = DMatrix::from_fn(m, m, |i, j| correlation[(joint[i], joint[j])]).symmetric_eigen();
        let mut order: Vec<usize> = (0..m).collect();
        order.sort_by(|a, b| eigen.eigenvalues[*b].total_cmp(&eigen.eigenvalues[*a]));
        if order.last().is_some_and(|k| eigen.eigenvalues[*k] < -1e-6) {
            return wrong("covariance", "not positive".to_owned(), "a matrix without negative variance");
        }
        let kept = order.iter().filter(|k| eigen.eigenvalues[**k] > ROUNDING);
        for (number, k) in kept.enumerate() {
            let vector = eigen.eigenvectors.column(*k);
            let mean: f64 = (0..m).map(|i| vector[i] * self.mean[joint[i]] / std[joint[i]]).sum();
            let factors = (0..m)
                .map(|i| (self.parameters[joint[i]].clone(), vector[i] * std[joint[i]]))
                .filter(|(_, factor)| *factor != 0.0)
                .collect();
            let name = format!("posterior_{}", number + 1);
            entries.insert(name, normal(mean, eigen.eigenvalues[*k].sqrt(), Some(factors)));
        }
        Ok(entries)
    }
}

/// The JSON Schema of the errors file, as pretty-printed text.
pub fn errors_schema() -> String {
    format!("{:#}\n", schemars::schema_for!(ErrorsFile).as_value())
}
