//! Whether inputs depend on each other only where the output has a value, because runs have failed.
//!
//! Runs that fail for x1 + x2 > c leave rows in which x1 and x2 depend on each other, however independent the
//! two are in the design (J. Berkson, *Limitations of the application of fourfold table analysis to hospital
//! data*, Biometrics Bull. 2, 1946). The runs that failed are the cause for a pair if
//!
//! - the pair depends on each other in the rows with an output, corrected for all pairs;
//! - in all rows, those of failed runs included, p of this pair alone is no less than 1 %;
//! - whether a run fails depends on one of the two, corrected for all pairs.

use crate::design::observation::Observed;
use crate::given::conditions::{Concern, Condition, listed};
use crate::given::data::Kind;
use crate::given::evidence::{Scores, Tested};
use crate::given::verdict::dependence::{FALSE_PAIRS, Inputs, p_value};

/// How the reason ends of an input that depends on others for the failed runs alone.
pub(crate) const ONLY: &str = " in the rows with an output only";

/// Those of the pairs of dependent inputs that the failed runs make so; `every` has all rows, with 1 for
/// those that failed and 0 for the others.
pub(crate) fn selected(
    every: &Observed,
    kinds: &[Kind],
    inputs: &Inputs,
    pairs: &[[usize; 2]],
) -> Vec<[usize; 2]> {
    let Some(failed) = Scores::new(every.outputs.clone()) else { return vec![] };
    let count = kinds.len() as f64 * (kinds.len() as f64 - 1.0) / 2.0;
    let of_all = |input: usize| Tested::new(&every.columns[input], kinds[input], input as u64);
    let is_selected = |pair: &[usize; 2]| {
        if inputs.are_coordinates(*pair) || inputs.p_value(*pair) * count >= FALSE_PAIRS {
            return false;
        }
        let pair = pair.map(of_all);
        let of_failure = pair.each_ref().map(|input| input.steps.p_value(&failed));
        2.0 * of_failure[0].min(of_failure[1]) * count < FALSE_PAIRS
            && p_value(&pair[0], &pair[1]) >= FALSE_PAIRS
    };
    pairs.iter().copied().filter(is_selected).collect()
}

/// What to know of pairs that the failed runs make dependent.
pub(crate) fn condition(pairs: &[[usize; 2]], names: &[&str]) -> Option<Condition> {
    let pair = |&[one, other]: &[usize; 2]| format!("`{}` and `{}`", names[one], names[other]);
    let text = format!(
        "runs fail at some values of inputs, so that these depend on each other in the rows with an output, \
         and in all rows no dependence is found ({}): which of each pair acts is not visible in what is \
         left; make the runs that failed succeed, or analyse a range of these inputs in which none fails",
        listed(pairs, 8, pair)
    );
    let mut inputs: Vec<usize> = pairs.iter().copied().flatten().collect();
    inputs.sort_unstable();
    inputs.dedup();
    let inputs = inputs.into_iter().map(|input| names[input].to_owned()).collect();
    (!pairs.is_empty()).then_some(Condition { concern: Concern::FailedRuns, inputs, text })
}
