//! Statistics of the output of a sampling.

use crate::model::study::Sampling;
use crate::observe::observation::Tally;
use cdpr_sensitivity::{Sample, SensitivityError, Summary};
use serde::{Deserialize, Serialize};

/// Summary of the output in its unit.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct ValueSummary {
    /// Mean.
    pub mean: f64,
    /// Standard deviation, with n - 1.
    pub std: f64,
    /// Least value of robots that differ from the nominal one.
    pub min: f64,
    /// Greatest value of them.
    pub max: f64,
    /// Value of the nominal robot.
    pub nominal: f64,
    /// 1 % quantile (Hyndman and Fan's type 7, as the others).
    pub q01: f64,
    /// Lower quartile.
    pub q25: f64,
    /// Median.
    pub median: f64,
    /// Upper quartile.
    pub q75: f64,
    /// 99 % quantile.
    pub q99: f64,
}

impl ValueSummary {
    /// Of all observations of a tally; `None` if fewer than two of them succeeded.
    pub fn of(sampling: &Sampling, tally: &Tally) -> Option<Self> {
        let moments = tally.sums.outputs().summary().ok()?;
        let sample = Sample::new(&tally.first_values).ok()?;
        Self::new(&moments, &sample, tally.range()?, sampling.nominal_value).ok()
    }

    pub(crate) fn new(
        summary: &Summary,
        sample: &Sample,
        [min, max]: [f64; 2],
        nominal: f64,
    ) -> Result<Self, SensitivityError> {
        Ok(Self {
            mean: summary.mean,
            std: summary.std,
            min,
            max,
            nominal,
            q01: sample.quantile(0.01)?,
            q25: sample.quantile(0.25)?,
            median: sample.quantile(0.5)?,
            q75: sample.quantile(0.75)?,
            q99: sample.quantile(0.99)?,
        })
    }
}
