//! Which inputs depend on each other, by the tests that find an effect, [`evidence`](crate::given::evidence).
//!
//! An input that is found may have no effect of its own if another one, found or not, depends on it: for
//! y = a - b, an input that follows a - b is found first. Each found input is therefore tested against all
//! others. Its tests, those of all found inputs and those of all outputs of a table are corrected together
//! (Bonferroni), so that of independent inputs any has such a doubt in one table of twenty at most:
//!
//! - 1 % for a dependence that is clear for all pairs of the table: it is stated;
//! - 3 % for one that is possible ([`FALSE_DOUBTS`]). One with the probability p explains the finding of an
//!   input only if this is about as clear, because an input acts through another one by less than they depend
//!   on each other. With the p* (Ve1) of the input it is a doubt where
//!
//! ```text
//! log p* > 10 log p                                                                  (Dp3)
//! ```
//!
//! - 1 % for several others that explain the input together where none does alone
//!   ([`joint`](super::joint)), which is (Dp3), too.
//!
//! Two coordinates of a [`sequence`](super::sequence) are independent by construction, but make a pattern. An
//! input without an effect is found for its pattern with a cause, but less clearly than the cause. With v the
//! ranks of the output, and m what another coordinate that is found says of them, their means in parts of it,
//! an effect is the input's own unless m may be what finds it: it is if one of these holds,
//!
//! ```text
//! p* (Ve1) < p* of the other one / 1000,   p* < p of m in the input / 1000           (Dp1)
//! R² (Ev1) of v in the input > 10 |m|² / |v|² R² of m in the input                   (Dp2)
//! ```
//!
//! Patterns of three coordinates are as strong as those of two: the products of two others that are found in
//! the output are such m, too.
//!
//! Coordinates that are no pattern but copies have a rank correlation above 0.5; those of sequences are below
//! 0.25 from 200 rows on.

use crate::given::data::Kind;
use crate::given::evidence::{MOST_OF_PAIRS, Scores, Space, Test, Tested, bonferroni};
use crate::given::rank::rows::order;
use crate::given::verdict::joint::{Joint, joint};
use crate::parallel::*;

/// Probability of one or more false findings in a table.
pub(crate) const FALSE_FINDINGS: f64 = 0.05;

/// Probability that independent inputs are said to depend on each other, or to be explained by several.
pub(crate) const FALSE_PAIRS: f64 = 0.01;

/// Probability that independent inputs which are found in a table seem to depend on others.
const FALSE_DOUBTS: f64 = 0.03;

/// How many times more clearly a coordinate must be found (Dp1).
const CLEARER: f64 = 1e3;

/// How many times a share must be that of a pattern (Dp2), or evidence that of a dependence (Dp3): several
/// may add up.
const GREATER: f64 = 10.0;

/// Parts of a coordinate that says something of the output: rows of each, and their largest number.
const ROWS_OF_PART: usize = 8;
const MOST_PARTS: usize = 32;

/// Square of the least rank correlation of coordinates that are copies.
const COPY: f64 = 0.25;

/// Inputs, and which of them are coordinates of a sequence.
pub(crate) struct Inputs<'a> {
    tested: &'a [Tested<'a>],
    coordinate: &'a [bool],
    /// Ranks of the output, unless all are equal.
    output: Option<Scores>,
    products: Vec<Product>,
    joint: Vec<Option<Joint>>,
    /// Number of outputs of the table.
    outputs: usize,
}

/// The product of two coordinates that is found in the output.
struct Product {
    pair: [usize; 2],
    scores: Scores,
    /// p in the output.
    p_value: f64,
}

/// What an input that is found depends on.
#[derive(Debug, Default, PartialEq)]
pub(crate) struct Companions {
    /// Others that it depends on.
    pub(crate) inputs: Vec<usize>,
    /// Other coordinates, or pairs of them, of which the pattern may be what finds it.
    pub(crate) patterns: Vec<Vec<usize>>,
}

impl<'a> Inputs<'a> {
    /// Inputs with the values of an output, of a table with `outputs` of them.
    pub(crate) fn new(
        tested: &'a [Tested<'a>],
        coordinate: &'a [bool],
        values: &[f64],
        outputs: usize,
    ) -> Self {
        let output = Scores::of_ranks(values);
        let scores: Vec<Option<&Scores>> = tested.iter().map(|of| of.scores.as_ref()).collect();
        let joint = joint(&scores, values.len());
        let products = products(tested, coordinate, output.as_ref());
        Self { tested, coordinate, products, output, joint, outputs }
    }

    pub(crate) fn are_coordinates(&self, [one, other]: [usize; 2]) -> bool {
        self.coordinate[one] && self.coordinate[other]
    }

    /// Others that each found input depends on, for that of its tests that leaves the fewest. Tests are those
    /// that find it, the clearest first. Where inputs are very many, found ones alone are looked at.
    pub(crate) fn companions(&self, found: &[(usize, Vec<Test>)]) -> Vec<Companions> {
        let inputs = self.tested.len();
        let clearest =
            |other: usize| found.iter().find(|(input, _)| *input == other).map(|of| of.1[0].p_value);
        let in_output: Vec<Option<f64>> = (0..inputs).map(clearest).collect();
        let all = found.len() * inputs <= MOST_OF_PAIRS * MOST_OF_PAIRS;
        let pairs = (inputs * inputs.saturating_sub(1)) as f64 / 2.0;
        let tested = (found.len() * self.outputs) as f64;
        let of_input = |(input, tests): &(usize, Vec<Test>)| {
            let is_looked_at = |other: &usize| other != input && (all || in_output[*other].is_some());
            let others: Vec<usize> = (0..inputs).filter(is_looked_at).collect();
            let count = others.len() as f64;
            let may_explain = |p: f64| tests[0].p_value.ln() > GREATER * p.ln();
            let depends = |other: usize| {
                if self.are_coordinates([*input, other]) {
                    return self.are_copies(*input, other);
                }
                let p = self.p_value([*input, other]);
                p * pairs < FALSE_PAIRS || (p * count * tested < FALSE_DOUBTS && may_explain(p))
            };
            let mut inputs: Vec<usize> = others.iter().copied().filter(|other| depends(*other)).collect();
            if inputs.is_empty() {
                let joint = self.explained(*input, FALSE_PAIRS / tested, may_explain);
                inputs.extend(joint);
            }
            let patterns = |test: &Test| match self.coordinate[*input] {
                true => self.patterns(*input, test, &in_output),
                false => vec![],
            };
            let patterns: Option<Vec<Vec<usize>>> = tests.iter().map(patterns).min_by_key(Vec::len);
            Companions { inputs, patterns: patterns.unwrap_or_default() }
        };
        found.par_iter().map(of_input).collect()
    }

    /// Pairs of inputs that depend on each other, the clearest first, corrected for the number of all pairs.
    pub(crate) fn pairs(&self) -> Vec<[usize; 2]> {
        let count = self.tested.len();
        if count > MOST_OF_PAIRS {
            return vec![];
        }
        let all: Vec<[usize; 2]> =
            (0..count).flat_map(|one| (one + 1..count).map(move |other| [one, other])).collect();
        let p_value = |&[one, other]: &[usize; 2]| match self.are_coordinates([one, other]) {
            true if self.are_copies(one, other) => 0.0,
            true => 1.0,
            false => self.p_value([one, other]),
        };
        let p_values: Vec<f64> = all.par_iter().map(p_value).collect();
        let of_all = all.len() as f64;
        let mut found: Vec<([usize; 2], f64)> =
            all.into_iter().zip(p_values).filter(|(_, p)| p * of_all < FALSE_PAIRS).collect();
        found.sort_by(|(_, one), (_, other)| one.total_cmp(other));
        let pairs: Vec<[usize; 2]> = found.into_iter().map(|(pair, _)| pair).collect();
        let in_none = |input: &usize| !pairs.iter().any(|pair| pair.contains(input));
        let of_several = |input: usize| {
            let others = self.explained(input, FALSE_PAIRS / count as f64, |_| true);
            others.iter().map(move |&other| [input.min(other), input.max(other)])
        };
        let several = (0..count).filter(in_none).flat_map(of_several);
        pairs.iter().copied().chain(several).collect()
    }

    /// Others that explain an input together, at a level and with a p that counts; none of a coordinate of a
    /// sequence.
    fn explained(&self, input: usize, level: f64, counts: impl Fn(f64) -> bool) -> &[usize] {
        let joint = self.joint[input]
            .as_ref()
            .filter(|of| !self.coordinate[input] && of.p_value < level && counts(of.p_value));
        joint.map_or(&[], |of| &of.others)
    }

    /// p of the independence of a pair.
    pub(crate) fn p_value(&self, [one, other]: [usize; 2]) -> f64 {
        p_value(&self.tested[one], &self.tested[other])
    }

    /// Other coordinates, and pairs of them, of which the pattern may be what a test finds (Dp1), (Dp2).
    fn patterns(&self, input: usize, test: &Test, in_output: &[Option<f64>]) -> Vec<Vec<usize>> {
        let space = self.tested[input].space(test.measure);
        let is_own = |p: f64| test.p_value * CLEARER < p;
        let Some(output) = &self.output else { return vec![] };
        let may_find = |said: &Scores| {
            let of_pattern = said.product(output).powi(2) * space.share(said);
            !is_own(space.p_value(said)) && space.share(output) <= GREATER * of_pattern
        };
        let by_one = |other: &usize| {
            *other != input
                && self.coordinate[*other]
                && in_output[*other].is_some_and(|p| !is_own(p))
                && self.means(*other, output).is_some_and(|said| may_find(&said))
        };
        let by_two = |of: &&Product| !of.pair.contains(&input) && !is_own(of.p_value) && may_find(&of.scores);
        let by_one = (0..self.tested.len()).filter(by_one).map(|other| vec![other]);
        by_one.chain(self.products.iter().filter(by_two).map(|of| of.pair.to_vec())).collect()
    }

    /// The means of the output in parts of an input.
    fn means(&self, input: usize, output: &Scores) -> Option<Scores> {
        let n = output.values().len();
        let parts = (n / ROWS_OF_PART).clamp(1, MOST_PARTS);
        let order = order(self.tested[input].values, input as u64, 0);
        let mut means = vec![0.0; n];
        for part in 0..parts {
            let rows = &order[part * n / parts..(part + 1) * n / parts];
            let mean = rows.iter().map(|&row| output.values()[row]).sum::<f64>() / rows.len() as f64;
            rows.iter().for_each(|&row| means[row] = mean);
        }
        Scores::new(means)
    }

    fn are_copies(&self, one: usize, other: usize) -> bool {
        let scores = self.tested[one].scores.clone().zip(self.tested[other].scores.as_ref());
        scores.is_some_and(|(one, other)| Space::Line(one).share(other) > COPY)
    }
}

/// The products of two coordinates that are found in the output, corrected for their number.
fn products(tested: &[Tested], coordinate: &[bool], output: Option<&Scores>) -> Vec<Product> {
    let all: Vec<usize> = (0..tested.len()).filter(|&input| coordinate[input]).collect();
    let Some(output) = output.filter(|_| all.len() <= MOST_OF_PAIRS) else { return vec![] };
    let output = Space::Line(output.clone());
    let count = (all.len() * all.len().saturating_sub(1)) as f64 / 2.0;
    let of_one = |(place, &one): (usize, &usize)| -> Vec<Product> {
        let of_pair = |&other: &usize| {
            let scores = tested[one].scores.as_ref()?.times(tested[other].scores.as_ref()?)?;
            let p_value = output.p_value(&scores);
            (p_value * count < FALSE_FINDINGS).then_some(Product { pair: [one, other], scores, p_value })
        };
        all[place + 1..].iter().filter_map(of_pair).collect()
    };
    let found: Vec<Vec<Product>> = all.par_iter().enumerate().map(of_one).collect();
    found.into_iter().flatten().collect()
}

/// p of the independence of two inputs: the least of all tests, times their number.
pub(crate) fn p_value(one: &Tested, other: &Tested) -> f64 {
    let mut all = [one_way(one, other), one_way(other, one)].concat();
    all.extend(of_ranks(one, other));
    bonferroni(&all)
}

fn of_ranks(one: &Tested, other: &Tested) -> Option<f64> {
    let (one, other) = one.scores.clone().zip(other.scores.as_ref())?;
    Some(Space::Line(one).p_value(other))
}

/// p of the tests of an input as if another one were the output: its ranks and their distances from the
/// middle, or for levels whether a row has each of them.
fn one_way(input: &Tested, output: &Tested) -> Vec<f64> {
    match (&output.steps, output.kind) {
        (Space::Steps(groups, sizes), Kind::Levels) => {
            let has = |level| groups.iter().map(|&group| f64::from(group == level)).collect();
            let scores = (0..sizes.len()).filter_map(|level| Scores::new(has(level)));
            scores.map(|scores| input.steps.p_value(&scores)).collect()
        }
        _ => {
            [&output.scores, &output.spread].into_iter().flatten().map(|of| input.steps.p_value(of)).collect()
        }
    }
}
