//! Which inputs matter: the union of all tests, under conditions that are checked.
//!
//! All tests of all inputs ([`evidence`]) are corrected together: the m p-values in
//! ascending order,
//!
//! ```text
//! p*_k = max over j <= k of (m - j + 1) p_j                                           (H1)
//! ```
//!
//! and an input matters where one of its p* is below 5 %. Whatever the tests have in common, the probability of
//! one or more false findings in a table is 5 % at most: S. Holm, *A simple sequentially rejective multiple test
//! procedure*, Scand. J. Stat. 6 (1979).
//!
//! The tests hold for rows that are independent of each other, and what they find is the effect of an input
//! where inputs are independent. An input is therefore *certain* to matter only if
//!
//! - no other input that is found depends on it: the same tests between the two, at 5 % over the number of the
//!   others, find nothing. Each is at least as sensitive as those of the verdict, so that an input that is
//!   found for what another causes is not certain;
//! - it and the output have no order together ([`conditions`](crate::given::conditions)).
//!
//! Otherwise it is *related* to the output, with the reasons. Rows that repeat count once.

use serde::{Deserialize, Serialize};

use crate::design::observation::Observed;
use crate::given::conditions::{Concern, Condition, clusters, in_order};
use crate::given::data::Kind;
use crate::given::evidence::{self, MOST_OF_PAIRS, Measure, Test, Tested};
use crate::given::hsic::{self, Dependence, Rows};
use crate::sample::random::derived_seed;

/// Probability of one or more false findings in a table.
pub const FALSE_FINDINGS: f64 = 0.05;

/// An input that matters.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schemars", derive(schemars::JsonSchema))]
pub struct Finding {
    /// Its name.
    pub input: String,
    /// The measure that finds it first.
    pub measure: Measure,
    /// p (H1) of this measure, corrected for all inputs and measures. Below 1e-4 it is an indication of its
    /// size.
    pub p_value: f64,
    /// Why it need not be a cause.
    pub reasons: Vec<String>,
}

/// An input of which nothing can be said.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schemars", derive(schemars::JsonSchema))]
pub struct Doubt {
    /// Its name.
    pub input: String,
    /// Why.
    pub reason: String,
}

/// Which inputs matter.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
#[cfg_attr(feature = "schemars", derive(schemars::JsonSchema))]
pub struct Verdict {
    /// Number of rows that count: repeated rows do once.
    pub rows: usize,
    /// Number of tests that are corrected for.
    pub tests: usize,
    /// Inputs that are certain to matter, the smallest p first.
    pub certain: Vec<Finding>,
    /// Inputs that are related to the output and need not be causes, the smallest p first.
    pub related: Vec<Finding>,
    /// Inputs of which nothing can be said.
    pub doubtful: Vec<Doubt>,
    /// What was found of the conditions of the tests, and of values that may be wrong.
    pub conditions: Vec<Condition>,
    /// The verdict in words, one sentence each.
    pub sentences: Vec<String>,
}

impl Verdict {
    /// Whether there is something to look at before the numbers of the table are used.
    #[must_use]
    pub fn has_questions(&self) -> bool {
        self.conditions.iter().any(Condition::is_question)
    }
}

/// What the tests of a table take.
pub(crate) struct Table<'a> {
    pub(crate) names: &'a [&'a str],
    pub(crate) kinds: &'a [Kind],
    /// Rows that repeat none before them; no input is constant.
    pub(crate) observed: &'a Observed,
    /// HSIC of these, where it is known.
    pub(crate) dependence: Option<&'a [Dependence]>,
    pub(crate) rows: Rows,
    /// Largest number of rows of tests, and the function that draws them.
    pub(crate) thinned: fn(&Observed, u64) -> Observed,
}

impl Table<'_> {
    /// The verdict of all tests; doubts and conditions of columns are those of the caller.
    pub(crate) fn verdict(&self) -> Verdict {
        let seed = |part| derived_seed(self.rows.seed, part);
        let mut verdict = Verdict::default();
        let clusters = clusters(self.observed, seed(0));
        let units = clusters.as_ref().unwrap_or(self.observed);
        verdict.rows = units.outputs.len();
        if clusters.is_some() {
            verdict.note(
                Concern::RepeatedRows,
                format!(
                    "{} rows have {} different sets of inputs: the verdict takes the mean output of each",
                    self.observed.outputs.len(),
                    verdict.rows
                ),
            );
        }
        if verdict.rows < evidence::MIN_ROWS {
            verdict.note(
                Concern::FewRows,
                format!("{} different rows: {} are needed for a verdict", verdict.rows, evidence::MIN_ROWS),
            );
            return verdict;
        }
        let in_order = in_order(units, self.kinds, seed(1));
        let drawn = (self.thinned)(units, seed(1));
        let tested: Vec<Tested> = (drawn.columns.iter().zip(self.kinds).enumerate())
            .map(|(input, (column, &kind))| Tested::new(column, kind, seed(2 + input as u64)))
            .collect();
        let mut tests = evidence::tests(&tested, &drawn.outputs, seed(1));
        let again = || hsic::of_output(&units.columns, self.kinds, &units.outputs, self.rows).ok();
        let dependence = match self.dependence {
            Some(known) if clusters.is_none() => Some(known.to_vec()),
            _ => again(),
        };
        for (tests, found) in tests.iter_mut().zip(dependence.iter().flatten()) {
            // The gamma law is too light in its far tail: p counts twice.
            let p_value = (2.0 * found.p_value).min(1.0);
            tests.push(Test { measure: Measure::Dependence, p_value });
        }
        verdict.tests = tests.iter().map(Vec::len).sum();
        if self.names.len() > MOST_OF_PAIRS {
            let text =
                format!("more than {MOST_OF_PAIRS} inputs: what acts with another one only is not found");
            verdict.note(Concern::DependentInputs, text);
        }
        let found = corrected(&tests);
        let others = found.len().saturating_sub(1).max(1) as f64;
        for &(input, measure, p_value) in &found {
            let mut reasons = Vec::new();
            let depends = |&&(other, ..): &&(usize, Measure, f64)| {
                other != input && tested[input].depends_on(&tested[other]) * others < FALSE_FINDINGS
            };
            let depends: Vec<String> =
                found.iter().filter(depends).map(|(other, ..)| format!("`{}`", self.names[*other])).collect();
            if !depends.is_empty() {
                reasons.push(format!("depends on {}", depends.join(", ")));
            }
            if in_order[input] {
                reasons.push("rows next to each other are alike in it and in the output".to_owned());
            }
            let input = self.names[input].to_owned();
            let list = if reasons.is_empty() { &mut verdict.certain } else { &mut verdict.related };
            list.push(Finding { input, measure, p_value, reasons });
        }
        self.note_dependence(&mut verdict, &in_order);
        verdict
    }

    fn note_dependence(&self, verdict: &mut Verdict, in_order: &[bool]) {
        let of = |marked: &dyn Fn(&Finding) -> bool| -> Vec<String> {
            verdict.related.iter().filter(|finding| marked(finding)).map(|of| of.input.clone()).collect()
        };
        let depending = of(&|finding| finding.reasons.iter().any(|reason| reason.starts_with("depends")));
        if !depending.is_empty() {
            verdict.conditions.push(Condition {
                concern: Concern::DependentInputs,
                text:
                    "inputs depend on each other: first-order indices, shares and tests count for each what \
                       they cause together"
                        .to_owned(),
                inputs: depending,
            });
        }
        let ordered = || (0..self.names.len()).filter(|&input| in_order[input]);
        if ordered().next().is_some() {
            verdict.conditions.push(Condition {
                concern: Concern::RowsInOrder,
                inputs: ordered().map(|input| self.names[input].to_owned()).collect(),
                text:
                    "rows next to each other are alike in the output and in inputs: p-values and intervals \
                       are too small for these"
                        .to_owned(),
            });
        }
    }
}

impl Verdict {
    pub(crate) fn note(&mut self, concern: Concern, text: String) {
        self.conditions.push(Condition { concern, inputs: vec![], text });
    }

    /// Writes the sentences.
    pub(crate) fn concluded(mut self) -> Self {
        let names = |list: &[Finding]| -> String {
            list.iter().map(|finding| finding.input.as_str()).collect::<Vec<_>>().join(", ")
        };
        let few = self.conditions.iter().any(|condition| condition.concern == Concern::FewRows);
        self.sentences = if few {
            vec![format!("no verdict: {} different rows are too few", self.rows)]
        } else {
            let certain = if self.certain.is_empty() { "none".to_owned() } else { names(&self.certain) };
            vec![format!("certain to matter: {certain}")]
        };
        if !self.related.is_empty() {
            self.sentences.push(format!("related, cause or not: {}", names(&self.related)));
            let reason = |finding: &Finding| format!("{}: {}", finding.input, finding.reasons.join("; "));
            self.sentences.extend(self.related.iter().map(reason));
        }
        let doubt = |doubt: &Doubt| format!("{}: {}", doubt.input, doubt.reason);
        self.sentences.extend(self.doubtful.iter().map(doubt));
        self
    }
}

/// The inputs of which a corrected p (H1) is below [`FALSE_FINDINGS`], with the measure of the least one, the
/// smallest p first.
fn corrected(tests: &[Vec<Test>]) -> Vec<(usize, Measure, f64)> {
    let of_input = |(input, tests): (usize, &Vec<Test>)| -> Vec<(usize, Test)> {
        tests.iter().map(|test| (input, *test)).collect()
    };
    let mut all: Vec<(usize, Test)> = tests.iter().enumerate().flat_map(of_input).collect();
    all.sort_by(|(_, one), (_, other)| one.p_value.total_cmp(&other.p_value));
    let (count, mut most) = (all.len(), 0.0_f64);
    let mut found: Vec<(usize, Measure, f64)> = Vec::new();
    for (place, (input, test)) in all.into_iter().enumerate() {
        most = most.max((count - place) as f64 * test.p_value);
        if most >= FALSE_FINDINGS {
            break;
        }
        if !found.iter().any(|(known, ..)| *known == input) {
            found.push((input, test.measure, most));
        }
    }
    found
}
