//! Which inputs matter: the union of all tests, under conditions that are checked.
//!
//! All tests of all inputs ([`evidence`]) are corrected together: the m p-values in
//! ascending order,
//!
//! ```text
//! p*_k = max over j <= k of (m - j + 1) p_j                                          (Ve1)
//! ```
//!
//! and an input matters where one of its p* is below 5 %. Whatever the tests have in common, the probability
//! of one or more false findings in a table is 5 % at most: S. Holm, *A simple sequentially rejective
//! multiple test procedure*, Scand. J. Stat. 6 (1979).
//!
//! The tests hold for rows that are independent of each other, and what they find is the effect of an input
//! where inputs are independent. An input is therefore *certain* to matter only if
//!
//! - no other input depends on it (`verdict/dependence.rs`), so that an input that is found for what
//!   another causes is not certain;
//! - it and the output have no order together (`verdict/order.rs`).
//!
//! Otherwise it is *related* to the output, with the reasons. Rows that repeat count once.
//!
//! The tests stand for all measures of a table. A first-order share is tested by the location and by the
//! neighbours, whose p have no floor; δ and PAWN are compared with 19 and 199 random deals, whose least p,
//! 1/20 and 1/200, survives no correction for dozens of tests. What they see is what spread and HSIC test.
//!
//! Rows of a sequence (`verdict/sequence.rs`) are not independent of each other: trend and location alone are
//! tested, and a coordinate that is found no more clearly than its pattern with another one is related.

mod dependence;
mod joint;
mod order;
mod partner;
mod selection;
pub(super) mod sequence;

use std::collections::HashSet;

use serde::{Deserialize, Serialize};

use crate::design::observation::Observed;
use crate::given::conditions::{Concern, Condition, listed, numbers_rows};
use crate::given::data::Kind;
use crate::given::evidence::{self, MOST_OF_PAIRS, Measure, Test, Tested, Tests};
use crate::given::hsic::{self, Dependence, Rows};
use crate::given::verdict::dependence::{FALSE_FINDINGS, Inputs};
use crate::given::verdict::order::{Order, in_order};
use crate::given::verdict::partner::partner;
use crate::sample::random::derived_seed;

/// An input that matters.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schemars", derive(schemars::JsonSchema))]
pub struct Finding {
    /// Its name.
    pub input: String,
    /// The measure that finds it first.
    pub measure: Measure,
    /// p (Ve1) of this measure, corrected for all inputs and measures. Below 1e-4 it is an indication of its
    /// size.
    pub p_value: f64,
    /// The input with which it acts, where the measure is [`Measure::Together`] and one is clear.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub with: Option<String>,
    /// Why it need not be a cause.
    pub reasons: Vec<String>,
}

/// How the reason begins that is no more than a possible dependence.
const MAY_DEPEND: &str = "may depend on ";

impl Finding {
    /// The word for the measure that finds it.
    pub(crate) fn by(&self) -> String {
        let with = self.with.as_ref().map_or_else(String::new, |other| format!(" with {other}"));
        format!("{}{with}", self.measure.word())
    }

    /// The others on which it may depend, where nothing else keeps it from being certain.
    fn unless(&self) -> Option<&str> {
        let [reason] = &self.reasons[..] else { return None };
        reason.strip_prefix(MAY_DEPEND)
    }
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
    /// Inputs that are certain to matter, that of the largest first-order share first.
    pub certain: Vec<Finding>,
    /// Inputs that are related to the output and need not be causes, in the same order.
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
    /// One row for each set of inputs; no input is constant.
    pub(crate) units: &'a Observed,
    /// At most as many of them as tests take.
    pub(crate) drawn: &'a Observed,
    /// Which inputs are coordinates of a sequence.
    pub(crate) coordinate: &'a [bool],
    /// HSIC of these, where it is known.
    pub(crate) dependence: Option<&'a [Dependence]>,
    pub(crate) rows: Rows,
    /// All rows, with 1 for those that failed and 0 for the others, where some failed.
    pub(crate) every: Option<&'a Observed>,
    /// Number of outputs of the table.
    pub(crate) outputs: usize,
}

impl Table<'_> {
    /// The verdict of all tests; doubts and conditions of columns and of repeated rows are the caller's.
    pub(crate) fn verdict(&self) -> Verdict {
        let seed = |part| derived_seed(self.rows.seed, part);
        let mut verdict = Verdict { rows: self.units.outputs.len(), ..Verdict::default() };
        if verdict.rows < evidence::MIN_ROWS {
            let (rows, least) = (counted(verdict.rows, "different row"), evidence::MIN_ROWS);
            verdict.note(Concern::FewRows, format!("{rows}: {least} are needed for a verdict"));
            return verdict;
        }
        let in_order = in_order(self.units, self.kinds, self.coordinate, seed(1));
        let tested: Vec<Tested> = (self.drawn.columns.iter().zip(self.kinds).enumerate())
            .map(|(input, (column, &kind))| Tested::new(column, kind, seed(2 + input as u64)))
            .collect();
        let tests = self.tests(&tested);
        verdict.tests = tests.iter().map(Vec::len).sum();
        self.note_tests(&mut verdict);
        let inputs = Inputs::new(&tested, self.coordinate, &self.drawn.outputs, self.outputs);
        let found = corrected(&tests);
        let (pairs, mut likely) = (inputs.pairs(), Vec::new());
        let selected = match self.every {
            Some(every) => selection::selected(every, self.kinds, &inputs, &pairs),
            None => vec![],
        };
        for ((input, tests), companions) in found.iter().zip(inputs.companions(&found)) {
            let mut reasons = Vec::new();
            let with = companions.inputs.iter().map(|other| [*input.min(other), *input.max(other)]);
            let only = if with.clone().all(|pair| selected.contains(&pair)) { selection::ONLY } else { "" };
            let doubtful: Vec<[usize; 2]> = with.filter(|pair| !pairs.contains(pair)).collect();
            if !companions.inputs.is_empty() {
                let depends = if doubtful.is_empty() { "depends on " } else { MAY_DEPEND };
                reasons.push(format!("{depends}{}{only}", self.named(&companions.inputs)));
            }
            likely.extend(doubtful);
            if !companions.patterns.is_empty() {
                let together = |inputs: &Vec<usize>| {
                    let names: Vec<&str> = inputs.iter().map(|&input| self.names[input]).collect();
                    format!("`{}`", names.join("` with `"))
                };
                let names = listed(&companions.patterns, 3, together);
                reasons.push(format!(
                    "found no more clearly than the pattern that the sequence has with {names}"
                ));
            }
            reasons.extend(in_order[*input].map(|order| order.reason().to_owned()));
            let name = self.names[*input].to_owned();
            let Test { measure, p_value } = tests[0];
            let list = if reasons.is_empty() { &mut verdict.certain } else { &mut verdict.related };
            let acts = (measure == Measure::Together).then(|| partner(&tested, &self.drawn.outputs, *input));
            let with = acts.flatten().map(|other| self.names[other].to_owned());
            list.push(Finding { input: name, measure, p_value, with, reasons });
        }
        let of_design = pairs.into_iter().filter(|pair| !selected.contains(pair)).collect();
        self.note_dependence(&mut verdict, "depend", of_design);
        verdict.conditions.extend(selection::condition(&selected, self.names));
        self.note_dependence(&mut verdict, "may depend", likely);
        self.note_order(&mut verdict, &in_order);
        verdict
    }

    /// All tests of each input.
    fn tests(&self, tested: &[Tested]) -> Vec<Vec<Test>> {
        let which = if self.coordinate.contains(&true) { Tests::Means } else { Tests::All };
        let seed = derived_seed(self.rows.seed, 1);
        let mut tests = evidence::tests(tested, &self.drawn.outputs, which, seed);
        if which == Tests::Means {
            return tests;
        }
        let units = self.units;
        let computed = || hsic::of_output(&units.columns, self.kinds, &units.outputs, self.rows).ok();
        let dependence = self.dependence.map(<[Dependence]>::to_vec).or_else(computed);
        for (tests, found) in tests.iter_mut().zip(dependence.iter().flatten()) {
            // The gamma law is too light in its far tail: p counts twice.
            let p_value = (2.0 * found.p_value).min(1.0);
            tests.push(Test { measure: Measure::Dependence, p_value });
        }
        tests
    }

    /// Names of inputs, of many the first ones.
    fn named(&self, inputs: &[usize]) -> String {
        let name = |&input: &usize| format!("`{}`", self.names[input]);
        listed(inputs, 8, name)
    }

    /// What is not tested.
    fn note_tests(&self, verdict: &mut Verdict) {
        let count = self.coordinate.iter().filter(|is| **is).count();
        if count > 0 {
            let all = count == self.names.len();
            let text = format!(
                "the rows are those of a sequence of low discrepancy, as in studies and designs of Sobol': \
                 {} independent by construction; what acts with another input only is not found",
                if all { "the inputs are".to_owned() } else { format!("{count} inputs are") }
            );
            let names = (0..self.names.len()).filter(|&input| self.coordinate[input] && !all);
            let inputs = names.map(|input| self.names[input].to_owned()).collect();
            verdict.conditions.push(Condition { concern: Concern::Sequence, inputs, text });
        } else if self.names.len() > MOST_OF_PAIRS {
            let text =
                format!("more than {MOST_OF_PAIRS} inputs: what acts with another one only is not found");
            verdict.note(Concern::DependentInputs, text);
        }
    }

    /// Pairs of inputs that `depend` on each other.
    fn note_dependence(&self, verdict: &mut Verdict, depend: &str, mut pairs: Vec<[usize; 2]>) {
        let mut seen = HashSet::new();
        pairs.retain(|pair| seen.insert(*pair));
        if pairs.is_empty() {
            return;
        }
        let pair = |&[one, other]: &[usize; 2]| format!("`{}` and `{}`", self.names[one], self.names[other]);
        let text = format!(
            "inputs {depend} on each other ({}): first-order indices, shares and tests count for each what \
             they cause together, and what they cause against each other may not be found",
            listed(&pairs, 8, pair)
        );
        let mut inputs: Vec<usize> = pairs.into_iter().flatten().collect();
        inputs.sort_unstable();
        inputs.dedup();
        let inputs = inputs.into_iter().map(|input| self.names[input].to_owned()).collect();
        verdict.conditions.push(Condition { concern: Concern::DependentInputs, inputs, text });
    }

    fn note_order(&self, verdict: &mut Verdict, in_order: &[Option<Order>]) {
        for order in [Order::Alike, Order::Follows] {
            // A number of the rows has a question of its own.
            let is_ordered =
                |&input: &usize| in_order[input] == Some(order) && !numbers_rows(&self.units.columns[input]);
            let ordered: Vec<usize> = (0..self.names.len()).filter(is_ordered).collect();
            let inputs: Vec<String> = ordered.iter().map(|&input| self.names[input].to_owned()).collect();
            if !inputs.is_empty() {
                let text = order.note(&self.named(&ordered));
                verdict.conditions.push(Condition { concern: Concern::RowsInOrder, inputs, text });
            }
        }
    }
}

/// Inputs that are found, each with what finds it first.
fn names(list: &[&Finding]) -> String {
    let name = |finding: &&Finding| format!("{} ({})", finding.input, finding.by());
    list.iter().map(name).collect::<Vec<_>>().join(", ")
}

/// `1 row`, `2 rows`.
pub(crate) fn counted(count: usize, word: &str) -> String {
    format!("{count} {word}{}", if count == 1 { "" } else { "s" })
}

impl Verdict {
    pub(crate) fn note(&mut self, concern: Concern, text: String) {
        self.conditions.push(Condition { concern, inputs: vec![], text });
    }

    /// Puts the inputs in the order of their first-order shares; those without one follow by their p.
    pub(crate) fn by_share(&mut self, share: impl Fn(&str) -> Option<f64>) {
        for list in [&mut self.certain, &mut self.related] {
            let of = |finding: &Finding| share(&finding.input).unwrap_or(f64::NEG_INFINITY);
            list.sort_by(|one, other| of(other).total_cmp(&of(one)));
        }
    }

    /// What the first sentence says of inputs that are certain unless they depend on others.
    fn unless(&self) -> String {
        let all: Vec<&Finding> = self.related.iter().filter(|finding| finding.unless().is_some()).collect();
        let several = names(&all);
        match &all[..] {
            [] => String::new(),
            [one] => {
                let others = one.unless().unwrap_or_default();
                if self.certain.is_empty() {
                    format!("; {several} is, unless it depends on {others}")
                } else {
                    format!("; so is {several}, unless it depends on {others}")
                }
            }
            _ if self.certain.is_empty() => format!("; {several} are, unless they depend on others"),
            _ => format!("; so are {several}, unless they depend on others"),
        }
    }

    /// Writes the sentences on the inputs that vary, of `all`.
    pub(crate) fn concluded(mut self, inputs: &[&str], all: usize) -> Self {
        let few = self.conditions.iter().any(|condition| condition.concern == Concern::FewRows);
        self.sentences = if few {
            let are = if self.rows == 1 { "is" } else { "are" };
            vec![format!("no verdict: {} {are} too few", counted(self.rows, "different row"))]
        } else {
            let (certain, all) = (self.certain.len(), counted(all, "input"));
            let (unless, certain_ones) = (self.unless(), self.certain.iter().collect::<Vec<_>>());
            vec![match certain {
                0 => format!("none of {all} is certain to matter{unless}"),
                1 => format!("1 of {all} is certain to matter: {}{unless}", names(&certain_ones)),
                _ => format!("{certain} of {all} are certain to matter: {}{unless}", names(&certain_ones)),
            }]
        };
        let others: Vec<&Finding> =
            self.related.iter().filter(|finding| finding.unless().is_none()).collect();
        if !others.is_empty() {
            self.sentences.push(format!("related, cause or not: {}", names(&others)));
        }
        let is_said = self.related.len() - others.len() == 1;
        let reason = |finding: &Finding| format!("{}: {}", finding.input, finding.reasons.join("; "));
        let related = self.related.iter().filter(|finding| !is_said || finding.unless().is_none());
        self.sentences.extend(related.map(reason));
        let found = self.certain.iter().chain(&self.related).map(|finding| finding.input.as_str());
        let doubtful = self.doubtful.iter().map(|doubt| doubt.input.as_str());
        let settled: HashSet<&str> = found.chain(doubtful).collect();
        let open: Vec<&str> = inputs.iter().copied().filter(|input| !settled.contains(input)).collect();
        if !few && !open.is_empty() {
            let names = listed(&open, 8, |name| (*name).to_owned());
            let rows = counted(self.rows, "row");
            self.sentences.push(format!("not settled by {rows}, more of them may: {names}"));
        }
        // A condition says more of a constant input.
        let constant = self.conditions.iter().filter(|of| of.concern == Concern::Constant);
        let said: HashSet<&String> = constant.flat_map(|of| &of.inputs).collect();
        let doubts = self.doubtful.iter().filter(|doubt| !said.contains(&doubt.input));
        self.sentences.extend(doubts.map(|doubt| format!("{}: {}", doubt.input, doubt.reason)));
        self
    }
}

/// The inputs of which a corrected p (Ve1) is below [`FALSE_FINDINGS`], with all tests of which it is, the
/// smallest p first.
fn corrected(tests: &[Vec<Test>]) -> Vec<(usize, Vec<Test>)> {
    let of_input = |(input, tests): (usize, &Vec<Test>)| -> Vec<(usize, Test)> {
        tests.iter().map(|test| (input, *test)).collect()
    };
    let mut all: Vec<(usize, Test)> = tests.iter().enumerate().flat_map(of_input).collect();
    all.sort_by(|(_, one), (_, other)| one.p_value.total_cmp(&other.p_value));
    let (count, mut most) = (all.len(), 0.0_f64);
    let mut found: Vec<(usize, Vec<Test>)> = Vec::new();
    for (place, (input, test)) in all.into_iter().enumerate() {
        most = most.max((count - place) as f64 * test.p_value);
        if most >= FALSE_FINDINGS {
            break;
        }
        let test = Test { p_value: most, ..test };
        match found.iter_mut().find(|(known, _)| *known == input) {
            Some((_, tests)) => tests.push(test),
            None => found.push((input, vec![test])),
        }
    }
    found
}
