//! The small table below the verdict of a table: the leading inputs. The program and the report have it.

use crate::given::analysis::{Analysis, InputAnalysis};
use crate::given::verdict::{Finding, counted};

/// Inputs in the table.
const LEADING: usize = 5;

/// The leading inputs by their first-order shares, and the test that finds each.
#[derive(Clone, Debug, PartialEq)]
pub struct LeadingInputs {
    /// A row for each: its name, its share \[%\] and how it was found.
    pub rows: Vec<[String; 3]>,
    /// What the columns are, and what the words of the tests mean.
    pub captions: Vec<String>,
}

impl LeadingInputs {
    /// Names of the columns.
    pub const HEADER: [&str; 3] = ["input", "first-order share [%]", "found by"];

    /// The inputs that are found come first.
    #[must_use]
    pub fn of(analysis: &Analysis) -> Self {
        let verdict = &analysis.verdict;
        let found_by = |of: &InputAnalysis| {
            let is_it = |finding: &&Finding| finding.input == of.input;
            let certain = verdict.certain.iter().find(is_it).map(|found| found.measure.word().to_owned());
            let related = || verdict.related.iter().find(is_it);
            certain.or_else(|| related().map(|found| format!("{}, cause or not", found.measure.word())))
        };
        let place = |input: &InputAnalysis| {
            let share = input.first.map_or(f64::NEG_INFINITY, |first| first.value);
            if found_by(input).is_some() { share.max(0.0) + 2.0 } else { share }
        };
        let mut inputs: Vec<&InputAnalysis> = analysis.inputs.iter().collect();
        inputs.sort_by(|one, other| place(other).total_cmp(&place(one)));
        let row = |input: &InputAnalysis| {
            let share = input.first.map_or("-".to_owned(), |of| of.percent());
            [input.input.clone(), share, found_by(input).unwrap_or("-".to_owned())]
        };
        let mut captions = vec![format!(
            "first-order share of the variance with its {} % interval; found by: the clearest of {}, all of \
             them corrected together",
            100.0 * analysis.level,
            counted(verdict.tests, "test")
        )];
        let mut words: Vec<String> = Vec::new();
        for measure in verdict.certain.iter().chain(&verdict.related).map(|found| found.measure) {
            let word = format!("{}: {}", measure.word(), measure.meaning());
            if !words.contains(&word) {
                words.push(word);
            }
        }
        captions.extend((!words.is_empty()).then(|| words.join("; ")));
        Self { rows: inputs.into_iter().take(LEADING).map(row).collect(), captions }
    }
}
