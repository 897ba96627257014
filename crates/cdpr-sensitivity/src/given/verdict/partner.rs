//! The other input with which an input acts.
//!
//! The test *together* of an input takes the ranks of the output times those of each other input, and has the
//! least p of them. The input of that p is the partner if every other one has a p that is much greater.

use crate::given::evidence::{Scores, Tested};

/// How far the least p must be below the next one.
const CLEAR: f64 = 1e-3;

/// The partner of an input, if one is clear.
pub(crate) fn partner(inputs: &[Tested], outputs: &[f64], input: usize) -> Option<usize> {
    let scores = Scores::of_ranks(outputs)?;
    let p_value = |(other, of): (usize, &Tested)| {
        let product = of.scores.as_ref().filter(|_| other != input)?.times(&scores)?;
        Some((inputs[input].steps.p_value(&product), other))
    };
    let mut all: Vec<(f64, usize)> = inputs.iter().enumerate().filter_map(p_value).collect();
    all.sort_by(|(one, _), (other, _)| one.total_cmp(other));
    match all[..] {
        [] => None,
        [(_, only)] => Some(only),
        [(least, first), (next, _), ..] => (least < CLEAR * next).then_some(first),
    }
}
