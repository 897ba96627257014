//! How often an output fails a limit, and which inputs make it fail.

use serde::{Deserialize, Serialize};

use crate::design::observation::Observed;
use crate::error::SensitivityError;
use crate::given::data::Kind;
use crate::given::hsic::{self, Dependence, Rows, of_event};
use crate::sample::interval::Estimate;
use crate::sample::summary::check_varies;

/// What the outputs are to satisfy.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schemars", derive(schemars::JsonSchema))]
#[serde(rename_all = "snake_case")]
pub enum Limit {
    /// They are to stay below this value.
    Below(f64),
    /// They are to be this value or less.
    AtMost(f64),
    /// They are to stay above this value.
    Above(f64),
    /// They are to be this value or more.
    AtLeast(f64),
}

impl Limit {
    /// Whether an output satisfies the limit.
    #[must_use]
    pub fn holds(&self, output: f64) -> bool {
        match *self {
            Self::Below(value) => output < value,
            Self::AtMost(value) => output <= value,
            Self::Above(value) => output > value,
            Self::AtLeast(value) => output >= value,
        }
    }
}

/// How often a limit fails.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schemars", derive(schemars::JsonSchema))]
pub struct LimitFailures {
    /// The limit.
    pub limit: Limit,
    /// Number of rows with an output; repeated ones count once.
    pub rows: usize,
    /// Number of these that do not satisfy it.
    pub count: usize,
    /// Their share, with its interval for independent rows.
    pub share: Estimate,
}

/// How an input makes a limit fail.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schemars", derive(schemars::JsonSchema))]
pub struct InputAtLimit {
    /// Dependence of the failure of the limit (target HSIC).
    pub target: Dependence,
    /// Dependence of the output within the rows that fail (conditional HSIC), if the input varies there.
    pub conditional: Option<Dependence>,
    /// Share of all values of the input below the median of those that fail: 0.5 without a relation, near 1
    /// where large values fail. An input of words has none.
    pub place: Option<f64>,
}

/// Least number of rows on either side of a limit.
pub(crate) const LEAST_FAILING: usize = 5;

/// A table and its limit.
pub(crate) struct AtLimit<'a> {
    pub(crate) limit: Limit,
    /// Outputs of all rows that count.
    pub(crate) outputs: &'a [f64],
    /// One row for each set of inputs.
    pub(crate) observed: &'a Observed,
    pub(crate) kinds: &'a [Kind],
    pub(crate) rows: Rows,
    pub(crate) level: f64,
}

impl AtLimit<'_> {
    /// How often the limit fails, and how each input makes it fail, if enough rows are on both of its sides;
    /// otherwise a note of what is missing.
    pub(crate) fn found(
        &self,
        notes: &mut Vec<String>,
    ) -> Result<(LimitFailures, Vec<InputAtLimit>), SensitivityError> {
        let (observed, columns) = (self.observed, &self.observed.columns);
        let fail = |outputs: &[f64]| -> Vec<bool> {
            outputs.iter().map(|&output| !self.limit.holds(output)).collect()
        };
        let number = |fails: &[bool]| fails.iter().filter(|fails| **fails).count();
        let (rows, count) = (self.outputs.len(), number(&fail(self.outputs)));
        let share = Estimate::of_share(count, rows, self.level)?;
        let failures = LimitFailures { limit: self.limit, rows, count, share };
        let fails = fail(&observed.outputs);
        let (n, count) = (fails.len(), number(&fails));
        if count.min(n - count) < LEAST_FAILING {
            let fail = if count == 1 { "fails" } else { "fail" };
            notes.push(format!(
                "causes at the limit: {count} of {n} rows {fail}, {LEAST_FAILING} are needed on either side"
            ));
            return Ok((failures, vec![]));
        }
        let target = of_event(columns, self.kinds, &fails, self.rows)?;
        let within = |values: &[f64]| -> Vec<f64> {
            values.iter().zip(&fails).filter(|(_, fails)| **fails).map(|(value, _)| *value).collect()
        };
        let columns_within: Vec<Vec<f64>> = columns.iter().map(|column| within(column)).collect();
        let conditional = hsic::of_output(&columns_within, self.kinds, &within(&observed.outputs), self.rows);
        let conditional = conditional
            .map_err(|error| notes.push(format!("dependence among the rows that fail: {error}")))
            .ok();
        let input = |i: usize| InputAtLimit {
            target: target[i],
            conditional: conditional
                .as_ref()
                .map(|conditional| conditional[i])
                .filter(|_| check_varies(&columns_within[i]).is_ok()),
            place: (self.kinds[i] == Kind::Numbers).then(|| place(&columns[i], &columns_within[i])),
        };
        Ok((failures, (0..columns.len()).map(input).collect()))
    }
}

/// Share of values below the median of some of them; values equal to it count by half.
fn place(all: &[f64], some: &[f64]) -> f64 {
    let mut some = some.to_vec();
    let middle = some.len() / 2;
    let (_, &mut median, _) = some.select_nth_unstable_by(middle, f64::total_cmp);
    let weight = |x: &f64| match x.total_cmp(&median) {
        std::cmp::Ordering::Less => 1.0,
        std::cmp::Ordering::Equal => 0.5,
        std::cmp::Ordering::Greater => 0.0,
    };
    all.iter().map(weight).sum::<f64>() / all.len() as f64
}
