//! Prices of tolerances and of calibrations, from which a budget of tolerances buys.

use indexmap::IndexMap;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// What a tolerance costs, by `cost` or by `grades`; or what a calibration costs, by `cost` and `leaves`.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct PriceSpec {
    /// Cost of the tolerance as it is, or of the calibration, in any currency.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub cost: Option<f64>,
    /// Power k of the cost of a tolerance that is s times as wide, `cost / s^k`; 1 if left out.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub power: Option<f64>,
    /// Least standard deviation that can be bought, in the unit of the deviation; zero if left out.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub least: Option<f64>,
    /// The only tolerances that can be bought instead of the one as it is, which costs nothing then.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub grades: Vec<GradeSpec>,
    /// Standard deviations that a calibration leaves, by entries of the error model.
    #[serde(default, skip_serializing_if = "IndexMap::is_empty")]
    pub leaves: IndexMap<String, f64>,
}

/// A tolerance that can be bought.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct GradeSpec {
    /// Standard deviation, in the unit of the deviation.
    pub std: f64,
    /// Its cost.
    pub cost: f64,
}

/// Field, value and what would be right.
type Wrong = (String, String, String);

impl PriceSpec {
    /// What is wrong with the price of this name; `is_entry` says of a name whether an error model has it.
    pub(crate) fn invalid(&self, name: &str, is_entry: impl Fn(&str) -> bool) -> Option<Wrong> {
        let wrong =
            |field: &str, value: String, expected: &str| Some((field.to_owned(), value, expected.to_owned()));
        let is_positive = |value: &f64| value.is_finite() && *value > 0.0;
        let each = self.grades.iter().enumerate().flat_map(|(k, grade)| {
            [(format!(".grades[{k}].std"), grade.std), (format!(".grades[{k}].cost"), grade.cost)]
        });
        let left = self.leaves.iter().map(|(entry, std)| (format!(".leaves.{entry}"), *std));
        let named = [("cost", self.cost), ("power", self.power), ("least", self.least)];
        let named = named.into_iter().filter_map(|(field, value)| Some((format!(".{field}"), value?)));
        if let Some((field, value)) = named.chain(each).chain(left).find(|(_, value)| !is_positive(value)) {
            return wrong(&field, value.to_string(), "a positive finite number");
        }
        if let Some(entry) = self.leaves.keys().find(|entry| !is_entry(entry)) {
            return wrong(&format!(".leaves.{entry}"), entry.clone(), "an entry of an error model");
        }
        match (is_entry(name), self.leaves.is_empty(), self.grades.is_empty(), self.cost) {
            (true, false, ..) => wrong(
                ".leaves",
                "given".to_owned(),
                "none of a tolerance: a calibration has a name of its own",
            ),
            (false, true, ..) => {
                let expected = "an entry of an error model, or a calibration with `leaves`, the standard \
                                deviations that it leaves";
                wrong("", name.to_owned(), expected)
            }
            (false, _, false, _) => wrong(".grades", "given".to_owned(), "none of a calibration"),
            (false, ..) if self.power.is_some() || self.least.is_some() => {
                let field = if self.power.is_some() { ".power" } else { ".least" };
                wrong(field, "given".to_owned(), "none of a calibration")
            }
            (true, _, false, _) if self.cost.or(self.power).or(self.least).is_some() => {
                wrong(".grades", "given".to_owned(), "either grades, or `cost` with `power` and `least`")
            }
            (_, _, true, None) => {
                let expected = "the cost of the calibration or of the tolerance as it is, or `grades`";
                wrong(".cost", "missing".to_owned(), expected)
            }
            _ => None,
        }
    }
}
