//! Published figures beside the computed ones.
//!
//! The rule: a number is *reproduced* if it lies within half of the published figure's last digit plus 1 % of
//! it; a word is reproduced if it is the same. A law is compared by its name only where the observations
//! decide on one: it is *undecided* while they leave the published one possible, and not reproduced once they
//! reject it.

use crate::analysis::part::StudySummary;
use crate::analysis::sampling::{FitSummary, SamplingSummary};
use crate::analysis::surface::SurfaceSummary;
use crate::file::study_file::{ComparisonSpec, Statistic};
use crate::file::value::Value;
use cdpr_robot::Axis;
use cdpr_sensitivity::{Evidence, Family, is_possible};
use indexmap::IndexMap;
use serde::{Deserialize, Serialize};
use std::fmt;

/// Whether a published figure is reproduced.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub enum Verdict {
    /// Within the rule.
    #[serde(rename = "reproduced")]
    Reproduced,
    /// Outside it.
    #[serde(rename = "not reproduced")]
    NotReproduced,
    /// The observations do not say.
    #[serde(rename = "undecided")]
    Undecided,
}

impl fmt::Display for Verdict {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Reproduced => "reproduced",
            Self::NotReproduced => "not reproduced",
            Self::Undecided => "undecided",
        })
    }
}

/// One row of the comparison.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct ComparisonRow {
    /// Where it is published.
    pub figure: String,
    /// The quantity, in words.
    pub quantity: String,
    /// Name of the sampling or surface it was computed from.
    pub study: String,
    /// The published figure.
    pub paper: Value,
    /// The computed figure.
    pub computed: Value,
    /// Unit of both; empty for a word.
    pub unit: String,
    /// Whether they agree.
    pub verdict: Verdict,
    /// Note from the study file.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub note: Option<String>,
}

/// The largest t of a point may be this many times the smallest for all to count as nearly equal.
const NEARLY_EQUAL: f64 = 1.5;

/// Compares published figures with results. A statistic that a study does not have is computed as `none`.
pub(crate) fn compare(
    rows: &[ComparisonSpec],
    studies: &IndexMap<String, StudySummary>,
) -> Vec<ComparisonRow> {
    rows.iter()
        .map(|row| {
            let computed = studies.get(&row.study).and_then(|study| computed(row.statistic, study));
            let computed = computed.unwrap_or_else(|| Value::Text("none".to_owned()));
            let open = match studies.get(&row.study) {
                Some(StudySummary::Sampling(of)) => {
                    row.statistic == Statistic::BestFit && open(&row.paper, of)
                }
                _ => false,
            };
            ComparisonRow {
                figure: row.figure.clone(),
                quantity: row.quantity.clone(),
                study: row.study.clone(),
                paper: row.paper.clone(),
                verdict: if open {
                    Verdict::Undecided
                } else {
                    verdict(&row.paper, &computed, row.last_digit)
                },
                computed,
                unit: row.unit.clone(),
                note: row.note.clone(),
            }
        })
        .collect()
}

fn verdict(paper: &Value, computed: &Value, last_digit: f64) -> Verdict {
    let within = match (paper, computed) {
        (Value::Number(paper), Value::Number(computed)) => {
            (computed - paper).abs() <= 0.5 * last_digit + 0.01 * paper.abs()
        }
        (paper, computed) => paper == computed,
    };
    if within { Verdict::Reproduced } else { Verdict::NotReproduced }
}

fn computed(statistic: Statistic, study: &StudySummary) -> Option<Value> {
    match study {
        StudySummary::Sampling(sampling) => of_sampling(statistic, sampling),
        StudySummary::Surface(surface) => of_surface(statistic, surface),
        // The study file has no such row.
        StudySummary::Poses(_) => None,
    }
}

fn of_sampling(statistic: Statistic, sampling: &SamplingSummary) -> Option<Value> {
    let values = sampling.values.as_ref()?;
    let largest = |tensions: &[f64]| tensions.iter().copied().reduce(f64::max);
    let number = match statistic {
        Statistic::Mean => values.mean,
        Statistic::Std => values.std,
        Statistic::Min => values.min,
        Statistic::Max => values.max,
        Statistic::Spread => values.max - values.min,
        Statistic::RelativeSpread => 100.0 * (values.max - values.min) / values.mean,
        Statistic::UnloadedTension => largest(&sampling.nominal.unloaded_tensions)?,
        Statistic::LoadedTension => largest(&sampling.nominal.loaded_tensions)?,
        Statistic::BestFit => {
            let best = sampling.best_fit?;
            let text = match best.evidence {
                Evidence::Decided => name(best.family)?,
                Evidence::Undecided | Evidence::Rejected => best.to_string(),
            };
            return Some(Value::Text(text));
        }
        Statistic::DominantAnchorPoints => return dominant(&point_effects(sampling, 'a')),
        Statistic::DominantExitPoints => return dominant(&point_effects(sampling, 'b')),
        Statistic::AnchorPointEquality => return equality(&point_effects(sampling, 'a')),
        Statistic::ExitPointEquality => return equality(&point_effects(sampling, 'b')),
    };
    Some(Value::Number(number))
}

/// Name of a family as a study file has it.
fn name(family: Family) -> Option<String> {
    Some(serde_json::to_value(family).ok()?.as_str()?.to_owned())
}

/// Whether the observations leave several laws possible, the published one among them.
fn open(paper: &Value, sampling: &SamplingSummary) -> bool {
    let published = |fit: &&FitSummary| name(fit.law).map(Value::Text).as_ref() == Some(paper);
    sampling.best_fit.is_some_and(|best| best.evidence == Evidence::Undecided)
        && sampling.fits.iter().find(published).is_some_and(|fit| is_possible(fit.probability, fit.p_value))
}

fn of_surface(statistic: Statistic, surface: &SurfaceSummary) -> Option<Value> {
    let (min, max) = (surface.values.min?, surface.values.max?);
    match statistic {
        Statistic::Min => Some(Value::Number(min)),
        Statistic::Max => Some(Value::Number(max)),
        Statistic::Spread => Some(Value::Number(max - min)),
        _ => None,
    }
}

/// Largest t of the coordinates of each point `a1`, `a2`, ... (or `b1`, ...), in the order of their numbers.
fn point_effects(sampling: &SamplingSummary, letter: char) -> Vec<(String, f64)> {
    (1..)
        .map_while(|i| {
            let point = format!("{letter}{i}");
            let t = Axis::ALL.iter().filter_map(|axis| sampling.t_student.get(&format!("{point}.{axis}")));
            t.copied().reduce(f64::max).map(|t| (point, t))
        })
        .collect()
}

fn dominant(effects: &[(String, f64)]) -> Option<Value> {
    let mut effects = effects.to_vec();
    effects.sort_by(|a, b| b.1.total_cmp(&a.1));
    let mut names: Vec<String> = effects.get(..2)?.iter().map(|(name, _)| name.to_uppercase()).collect();
    names.sort();
    Some(Value::Text(names.join(" ")))
}

fn equality(effects: &[(String, f64)]) -> Option<Value> {
    let largest = effects.iter().map(|(_, t)| *t).reduce(f64::max)?;
    let smallest = effects.iter().map(|(_, t)| *t).reduce(f64::min)?;
    let equal = largest <= NEARLY_EQUAL * smallest;
    Some(Value::Text(if equal { "nearly equal" } else { "unequal" }.to_owned()))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_verdict_follows_the_rule_at_its_edges() {
        let number = Value::Number;
        // 1.34 printed to 0.01: 0.005 + 0.0134.
        assert_eq!(verdict(&number(1.34), &number(1.3583), 0.01), Verdict::Reproduced);
        assert_eq!(verdict(&number(1.34), &number(1.3585), 0.01), Verdict::NotReproduced);
        assert_eq!(verdict(&number(1.34), &number(1.3215), 0.01), Verdict::NotReproduced);
        let word = |text: &str| Value::Text(text.to_owned());
        assert_eq!(verdict(&word("normal"), &word("normal"), 0.0), Verdict::Reproduced);
        assert_eq!(verdict(&word("normal"), &word("uniform"), 0.0), Verdict::NotReproduced);
        assert_eq!(verdict(&number(1.0), &word("none"), 0.01), Verdict::NotReproduced);
    }

    #[test]
    fn points_are_ranked_and_judged_by_their_largest_coordinate() {
        let effects =
            [("b1", 1.0), ("b2", 9.0), ("b3", 2.0), ("b4", 8.0)].map(|(name, t)| (name.to_owned(), t));
        assert_eq!(dominant(&effects), Some(Value::Text("B2 B4".to_owned())));
        assert_eq!(equality(&effects), Some(Value::Text("unequal".to_owned())));
        assert_eq!(equality(&effects[1..2]), Some(Value::Text("nearly equal".to_owned())));
    }
}
