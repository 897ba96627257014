//! The answer of one part of a study in words: what comes out, which inputs matter for certain, which do not,
//! and what would settle the others. The program, the report and `summary.json` have these words.

pub(crate) mod recommendation;
mod remedy;

use crate::analysis::linear_law::little_explained;
use crate::analysis::values::ValueSummary;
use crate::analysis::verdict::recommendation::{Basis, MATTERS, Recommendation, RecommendedIndex, Standing};
use crate::file::output::Output;
use crate::model::study::Sampling;
use crate::observe::observation::Tally;
use cdpr_robot::{counted, listing, significant};
use cdpr_sensitivity::SampleDesign;
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;

/// The answer of one part of a study.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct PartVerdict {
    /// What comes out, one sentence each.
    pub sentences: Vec<String>,
    /// The recommended measure of the inputs; of a sampling at one pose alone.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub recommendation: Option<Recommendation>,
}

impl PartVerdict {
    /// What comes out of a sampling at one pose: the first sentences of its verdict, from its observations.
    /// Statistics are absent where fewer than two observations succeeded.
    pub fn outcome(sampling: &Sampling, tally: &Tally, values: Option<&ValueSummary>) -> Vec<String> {
        let output = sampling.output();
        let (noun, unit) = (output.noun(), output.unit());
        let first = match values {
            Some(ValueSummary { mean, std, min, max, .. }) => {
                let [mean, min, max] = [mean, min, max].map(|value| number(*value));
                let std = significant(*std, 3);
                format!("Mean {noun} {mean} {unit}, std {std} {unit}, range {min} to {max} {unit}.")
            }
            None => format!("No {noun}: fewer than two observations succeeded."),
        };
        [Some(first), of_failed(&tally.failed, sampling.design.points())].into_iter().flatten().collect()
    }

    /// Of a sampling at one pose.
    pub(crate) fn of_sampling(
        sampling: &Sampling,
        tally: &Tally,
        values: Option<&ValueSummary>,
        recommendation: Option<Recommendation>,
    ) -> Self {
        let mut sentences = Self::outcome(sampling, tally, values);
        sentences.extend(recommendation.iter().flat_map(Recommendation::sentences));
        Self { sentences, recommendation }
    }

    /// Of a sampling whose outputs are zero within rounding.
    pub(crate) fn of_zero(sampling: &Sampling, tally: &Tally, rounding: f64) -> Self {
        let output = sampling.output();
        let (noun, unit) = (output.noun(), output.unit());
        let mut sentences = vec![format!("The {noun} is zero for all robots, within {rounding:.1e} {unit}.")];
        sentences.extend(of_failed(&tally.failed, sampling.design.points()));
        Self { sentences, recommendation: None }
    }
}

/// Digits of an output in a sentence.
const DIGITS: usize = 4;

/// A value of an output with its digits.
pub(crate) fn number(value: f64) -> String {
    significant(value, DIGITS)
}

/// The noun of an output at the start of a sentence.
pub(crate) fn subject(output: Output) -> String {
    let noun = output.noun();
    let mut letters = noun.chars();
    letters.next().map_or_else(String::new, |first| first.to_uppercase().chain(letters).collect())
}

/// A sentence with as many names as a line has room for, and the number of the others; three names, if there
/// are as many, whatever their length: the number of the others says less.
pub fn listing_three<T: AsRef<str>>(before: &str, names: &[T], after: &str) -> String {
    let (first, others) = names.split_at(names.len().min(3));
    let first = first.iter().map(AsRef::as_ref).collect::<Vec<_>>().join(", ");
    let rest = others.iter().map(|name| name.as_ref().to_owned());
    listing(before, &[first].into_iter().chain(rest).collect::<Vec<_>>(), after)
}

/// How many observations failed, by kind; `None` for none.
pub(crate) fn of_failed(failed: &BTreeMap<String, usize>, observations: usize) -> Option<String> {
    let count: usize = failed.values().sum();
    if count == 0 {
        return None;
    }
    let kinds = failed.iter().filter(|(_, count)| **count > 0);
    let kinds: Vec<String> =
        kinds.map(|(kind, count)| format!("{count} {}", kind.replace('_', " "))).collect();
    let all = counted(observations, "observation");
    Some(listing(&format!("{count} of {all} failed: "), &kinds, "."))
}

impl Recommendation {
    /// Names of the inputs with a standing, the leading ones first.
    pub fn with(&self, standing: Standing) -> Vec<&str> {
        let of = self.inputs.iter().filter(|of| of.standing == Some(standing));
        of.map(|of| of.input.as_str()).collect()
    }

    /// The inputs of a short table: five, or all that certainly matter up to ten.
    pub fn leading(&self) -> &[RecommendedIndex] {
        let count = self.with(Standing::Matters).len().clamp(5, 10);
        &self.inputs[..count.min(self.inputs.len())]
    }

    /// Which inputs matter, which do not, and what would settle the others.
    pub(crate) fn sentences(&self) -> Vec<String> {
        let percent = 100.0 * MATTERS;
        let [matter, below, open] =
            [Standing::Matters, Standing::Negligible, Standing::Open].map(|standing| self.with(standing));
        let mut sentences = Vec::new();
        if self.inputs.iter().any(|of| of.standing.is_some()) {
            let (matters, is_below) = match self.confidence {
                Some(_) => ("Certain to matter", "Certainly below"),
                None => ("Matter by the polynomial model", "Below"),
            };
            let none = ["none"];
            sentences.push(listing_three(
                &format!("{matters} (above {percent} % of the variance): "),
                if matter.is_empty() { &none } else { &matter },
                ".",
            ));
            if !below.is_empty() {
                sentences.push(listing(&format!("{is_below} {percent} % each: "), &below, "."));
            }
            if !open.is_empty() {
                sentences.push(listing("Not settled: ", &open, "."));
            }
        } else {
            // Shares below that are no lead.
            let leads = |of: &&RecommendedIndex| match self.basis {
                Basis::Student => true,
                Basis::Ranks => of.value.is_some_and(|share| share >= MATTERS),
                _ => of.value.is_none_or(|share| share >= MATTERS),
            };
            let leading: Vec<&str> =
                self.inputs.iter().take(3).filter(leads).map(|of| of.input.as_str()).collect();
            let leading = if leading.is_empty() { vec!["none"] } else { leading };
            sentences.push(listing_three("Leading, without bounds: ", &leading, "."));
            sentences.extend(self.missed_by_ranks());
        }
        let little = little_explained(self.explained);
        sentences.extend(
            little.map(|little| format!("{little}: the bounds are valid, nominal derivatives mislead.")),
        );
        sentences.extend(self.remedy.clone());
        sentences
    }

    /// What a regression of ranks leaves out, where that is much.
    fn missed_by_ranks(&self) -> Option<String> {
        const MOST: f64 = 0.8;
        // No value has the sum -0.
        let explained = self.inputs.iter().filter_map(|of| of.value).fold(0.0, |sum, value| sum + value);
        (self.basis == Basis::Ranks && explained < MOST).then(|| {
            format!(
                "The regression of ranks explains {:.0} % of the variance: an input whose effect is not to raise or \
                 to lower the output, such as a direction, may matter and be last.",
                100.0 * explained
            )
        })
    }

    /// The measure in words, with the confidence of its bounds.
    pub fn caption(&self) -> String {
        match self.confidence {
            Some(confidence) => {
                format!("{}; {} % confidence for all inputs together", self.measure, 100.0 * confidence)
            }
            None => self.measure.clone(),
        }
    }

    /// The value of an input in a cell of a table; shares in percent.
    pub fn cell(&self, of: &RecommendedIndex) -> String {
        let (scale, unit) = match self.basis {
            Basis::Student => (1.0, ""),
            _ => (100.0, " %"),
        };
        let text = |value: f64| significant(scale * value, 3);
        match (of.value, of.low.zip(of.high)) {
            // One form for all inputs: of some the estimates of both bounds coincide.
            (_, Some((low, high))) if self.basis == Basis::Derivatives && low > 0.0 => {
                format!("{} to {}{unit}", text(low), text(high))
            }
            (Some(value), Some((low, high))) => {
                format!("{}{unit} ({} to {})", text(value), text(low), text(high))
            }
            (Some(value), None) => format!("{}{unit}", text(value)),
            (None, Some((_, high))) if of.standing == Some(Standing::Negligible) => {
                format!("at most {}{unit}", text(high))
            }
            (None, _) => "not resolved".to_owned(),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::listing_three;

    #[test]
    fn up_to_three_names_are_all_there_and_of_more_as_many_as_a_line_has_room_for() {
        let before = "Certain to matter (above 1 % of the variance): ";
        let name = |names: &[&str]| listing_three(before, names, ".");
        assert_eq!(name(&["mass"]), format!("{before}mass."));
        let three = ["mass", "linear_density", "youngs_modulus"];
        assert_eq!(name(&three), format!("{before}mass, linear_density, youngs_modulus."));
        assert_eq!(name(&["a", "b", "c", "d"]), format!("{before}a, b, c, d."));
        let more = ["mass", "linear_density", "youngs_modulus", "a1.x", "a2.x"];
        assert_eq!(name(&more), format!("{before}mass, linear_density, youngs_modulus and 2 more."));
    }
}
