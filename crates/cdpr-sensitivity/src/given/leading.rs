//! The small table below the verdict of a table: the leading inputs. The program and the report have it.
//!
//! A share is the one by ranks with its interval or, where ranks have none, the first-order index of the
//! polynomial model, if this model leaves less than 5 % of the variance unexplained.

use crate::given::analysis::{Analysis, InputAnalysis};
use crate::given::conditions::{Concern, Condition};
use crate::given::rank::OF_SEQUENCE;
use crate::given::verdict::{Finding, counted};
use crate::sample::interval::{Estimate, is_resolved};

/// Inputs in the table.
const LEADING: usize = 5;
/// Share of the variance that a polynomial model may leave unexplained for its shares to be shown.
const UNEXPLAINED: f64 = 0.05;

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

    /// The inputs that are found come first. Of too few rows there is nothing to show.
    #[must_use]
    pub fn of(analysis: &Analysis) -> Self {
        let verdict = &analysis.verdict;
        if verdict.tests == 0 {
            return Self { rows: Vec::new(), captions: Vec::new() };
        }
        let row = |input: &InputAnalysis| {
            let share = Share::of(analysis, input).map_or("-".to_owned(), Share::cell);
            [input.input.clone(), share, found_by(analysis, input).unwrap_or("-".to_owned())]
        };
        let mut captions = vec![format!(
            "first-order share of the variance with its {} % interval; found by: the clearest of {}, all of \
             them corrected together",
            100.0 * analysis.level,
            counted(verdict.tests, "test")
        )];
        captions.extend(shares_caption(analysis));
        let mut words: Vec<String> = Vec::new();
        for measure in verdict.certain.iter().chain(&verdict.related).map(|found| found.measure) {
            let word = format!("{}: {}", measure.word(), measure.meaning());
            if !words.contains(&word) {
                words.push(word);
            }
        }
        captions.extend((!words.is_empty()).then(|| words.join("; ")));
        Self { rows: Self::order(analysis).into_iter().take(LEADING).map(row).collect(), captions }
    }

    /// All inputs in the order of the table: those that are found first, then by their shares.
    #[must_use]
    pub fn order(analysis: &Analysis) -> Vec<&InputAnalysis> {
        let place = |input: &InputAnalysis| {
            let share = Share::of(analysis, input).map_or(f64::NEG_INFINITY, Share::value);
            if found_by(analysis, input).is_some() { share.max(0.0) + 2.0 } else { share }
        };
        let mut inputs: Vec<&InputAnalysis> = analysis.inputs.iter().collect();
        inputs.sort_by(|one, other| place(other).total_cmp(&place(one)));
        inputs
    }
}

/// How an input was found, if it was.
fn found_by(analysis: &Analysis, input: &InputAnalysis) -> Option<String> {
    let verdict = &analysis.verdict;
    let is_it = |finding: &&Finding| finding.input == input.input;
    let certain = verdict.certain.iter().find(is_it).map(Finding::by);
    let related = || verdict.related.iter().find(is_it);
    certain.or_else(|| related().map(|found| format!("{}, cause or not", found.by())))
}

/// A first-order share.
#[derive(Clone, Copy)]
enum Share {
    ByRanks(Estimate),
    /// By the polynomial model, and what this leaves unexplained.
    OfExpansion(f64, f64),
}

impl Share {
    fn of(analysis: &Analysis, input: &InputAnalysis) -> Option<Self> {
        let unexplained = analysis.expansion.as_ref().map(|expansion| expansion.leave_one_out);
        let of_expansion = || {
            let unexplained = unexplained.filter(|share| *share < UNEXPLAINED)?;
            Some(Self::OfExpansion(input.shares?.closed, unexplained))
        };
        input.first.map(Self::ByRanks).or_else(of_expansion)
    }

    fn value(self) -> f64 {
        match self {
            Self::ByRanks(estimate) => estimate.value,
            Self::OfExpansion(value, _) => value,
        }
    }

    fn cell(self) -> String {
        match self {
            Self::ByRanks(estimate) => estimate.percent(),
            // What the model leaves may belong to the share.
            Self::OfExpansion(value, unexplained) if is_resolved(value, [value, value + unexplained]) => {
                format!("{:.1} (expansion)", 100.0 * value)
            }
            Self::OfExpansion(..) => "not resolved".to_owned(),
        }
    }
}

/// Where the shares are from, or why no input has one.
fn shares_caption(analysis: &Analysis) -> Option<String> {
    let shares = || analysis.inputs.iter().filter_map(|input| Share::of(analysis, input));
    let unexplained = shares().find_map(|share| match share {
        Share::OfExpansion(_, unexplained) => Some(unexplained),
        Share::ByRanks(_) => None,
    });
    let is_of_a_sequence = |condition: &Condition| condition.concern == Concern::Sequence;
    let by_ranks = match analysis.verdict.conditions.iter().any(is_of_a_sequence) {
        true => OF_SEQUENCE,
        false => "ranks have no shares of these inputs (the notes of the details say why)",
    };
    if let Some(unexplained) = unexplained {
        return Some(format!(
            "expansion: by a polynomial model, which leaves {:.1} % of the variance unexplained; {by_ranks}",
            100.0 * unexplained
        ));
    }
    (shares().next().is_none() && !analysis.inputs.is_empty()).then(|| {
        let limit = 100.0 * UNEXPLAINED;
        format!("no shares: {by_ranks}, and no polynomial model leaves less than {limit} % unexplained")
    })
}
