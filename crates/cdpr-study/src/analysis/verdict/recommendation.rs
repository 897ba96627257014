//! The one measure of sensitivity that is recommended for the inputs of a sampling, and what it settles.
//!
//! An input *matters* if its total share T of the variance is above [`MATTERS`]. Three measures bound T:
//!
//! | basis | ends | confidence |
//! |---|---|---|
//! | exact derivatives | bounds (Br3) to (Br5) with their intervals | of the study, all inputs together |
//! | Sobol' indices | the interval of the index | the same |
//! | expansion | (Rc1), with its leave-one-out error e | none: e is an estimate |
//!
//! ```text
//! √(T_g (1 - e)) - √e <= √T <= √(T_g (1 - e)) + √e                                   (Rc1)
//! 1 - level of each bound = (1 - confidence) / (number of inputs x number of bases)  (Rc2)
//! ```
//!
//! - (Rc1): T_g is the index of the expansion g, which has the share 1 - e of the output's variance. What an
//!   input takes part in is a projection of the output, √T its norm, and the rest of the output, which g
//!   lacks, has the norm √e.
//! - (Rc2): by C. E. Bonferroni: a verdict on many inputs is as certain as one on a single input.
//!
//! Of derivatives and Sobol' indices the one that settles more inputs is recommended, derivatives where both
//! settle as many; an input that it leaves open has the bounds of the other where these settle it. The
//! expansion follows, then Shapley effects or ranks, which have no bounds and put the inputs in an order.

use cdpr_sensitivity::is_resolved;
use serde::{Deserialize, Serialize};

/// Share of the variance from which on an input matters.
pub const MATTERS: f64 = 0.01;

/// What a recommendation rests on.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Basis {
    /// Exact derivatives at points of a scrambled sequence.
    Derivatives,
    /// The polynomial model (chaos expansion).
    Expansion,
    /// Saltelli's blocks.
    Sobol,
    /// Shapley effects of inputs that may be correlated.
    Shapley,
    /// Squared coefficients of a regression of ranks.
    Ranks,
    /// The t-Student index.
    Student,
}

/// Whether an input matters.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Standing {
    /// Its share is above [`MATTERS`].
    Matters,
    /// Its share is below [`MATTERS`].
    Negligible,
    /// The bounds are on both sides of [`MATTERS`].
    Open,
}

/// The recommended measure of one input.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct RecommendedIndex {
    /// Name of the input.
    pub input: String,
    /// Its value; `None` where bounds alone are known, and where the interval is wider than the value.
    pub value: Option<f64>,
    /// Lower bound.
    pub low: Option<f64>,
    /// Upper bound.
    pub high: Option<f64>,
    /// Whether it matters; `None` for a basis without bounds of the total share.
    pub standing: Option<Standing>,
}

/// The recommended measure of all inputs of a sampling.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Recommendation {
    /// What it rests on.
    pub basis: Basis,
    /// The measure in words.
    pub measure: String,
    /// Confidence of all bounds together; `None` where they have none.
    pub confidence: Option<f64>,
    /// All inputs, the leading one first.
    pub inputs: Vec<RecommendedIndex>,
    /// What would settle the inputs that are open, in words.
    pub remedy: Option<String>,
    /// Share of the variance that the linear law of the nominal robot explains, where this rests on
    /// derivatives.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub explained: Option<f64>,
}

/// Bounds of the total share of an input: estimates of both bounds, and the outer ends of their intervals.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct TotalBounds {
    pub(crate) low: f64,
    pub(crate) at_least: f64,
    pub(crate) at_most: f64,
    pub(crate) high: f64,
    /// Whether few points decide the upper bound, so that its distance from the end says little.
    pub(crate) few: bool,
    /// Whether the law has no bound by derivatives, so that what the others have bounds it from above.
    pub(crate) by_others: bool,
}

/// A basis with what it says of the inputs, in their order.
pub(crate) struct Candidate {
    pub(crate) basis: Basis,
    /// The measure in words, and what it is known by.
    pub(crate) measure: &'static str,
    pub(crate) by: String,
    /// Observations or points that failed.
    pub(crate) failed: usize,
    /// Points of derivatives or blocks.
    pub(crate) count: usize,
    /// Observations of one more point or block.
    pub(crate) observations: usize,
    pub(crate) said: Said,
}

#[derive(Clone)]
pub(crate) enum Said {
    /// Bounds of the total share.
    Bounds(Vec<TotalBounds>),
    /// Values, with an interval where there is one.
    Values(Vec<(f64, Option<[f64; 2]>)>),
}

/// Level of each of some bounds for the confidence of all (Rc2).
pub(crate) fn joint_level(confidence: f64, bounds: usize) -> f64 {
    1.0 - (1.0 - confidence) / bounds.max(1) as f64
}

/// Bounds of the total share by an expansion (Rc1).
pub(crate) fn by_expansion(total: f64, error: f64) -> TotalBounds {
    let (norm, error) = ((total * (1.0 - error)).max(0.0).sqrt(), error.max(0.0).sqrt());
    let [low, high] = [(norm - error).max(0.0), norm + error].map(|norm| (norm * norm).min(1.0));
    let value = norm * norm;
    TotalBounds { low, at_least: value, at_most: value, high, few: false, by_others: false }
}

/// The recommendation of the candidate that says most; `None` without candidates.
pub(crate) fn recommend(
    names: &[String],
    mut candidates: Vec<Candidate>,
    confidence: f64,
) -> Option<Recommendation> {
    let rank = |of: &Candidate| {
        let settled = of.settled();
        let is_certain = settled > 0 && of.basis != Basis::Expansion;
        let is_order = matches!(of.said, Said::Values(_));
        (!is_certain, settled == 0, !is_order, std::cmp::Reverse(settled), of.basis)
    };
    // Polynomials of inputs that no longer have their laws, because observations failed, have no shares.
    candidates.retain(|of| of.basis != Basis::Expansion || of.failed == 0);
    // Derivatives do not see the jumps of an output.
    let refuted = candidates.iter().any(|of| of.basis == Basis::Sobol && of.contradicts(&candidates));
    candidates.retain(|of| of.basis != Basis::Derivatives || !refuted);
    candidates.sort_by_key(rank);
    complete(&mut candidates);
    let first = candidates.first()?;
    let remedy = first.remedy_with(candidates.iter().find(|of| of.basis == Basis::Sobol), names);
    let found = candidates.into_iter().next()?.recommendation(names, confidence);
    Some(Recommendation { remedy, ..found })
}

/// Gives inputs that derivatives leave open the bounds by Sobol' indices that settle them, and the other way.
fn complete(candidates: &mut [Candidate]) {
    let alone =
        |basis| candidates.iter().find(|of| of.basis == basis).map(|of| (of.by.clone(), of.said.clone()));
    let [derivatives, blocks] = [Basis::Derivatives, Basis::Sobol].map(alone);
    for of in candidates {
        let other = match of.basis {
            Basis::Derivatives => &blocks,
            Basis::Sobol => &derivatives,
            _ => continue,
        };
        let (Said::Bounds(own), Some((by, Said::Bounds(others)))) = (&mut of.said, other) else { continue };
        let pairs = own.iter_mut().zip(others);
        let mut settled = pairs.filter(|(own, other)| own.is_open() && !other.is_open()).peekable();
        if settled.peek().is_some() {
            of.by += &format!(" or {by}");
        }
        settled.for_each(|(own, other)| *own = *other);
    }
}

impl TotalBounds {
    pub(crate) fn is_open(&self) -> bool {
        self.standing() == Standing::Open
    }

    pub(crate) fn standing(&self) -> Standing {
        if self.low > MATTERS {
            Standing::Matters
        } else if self.high < MATTERS {
            Standing::Negligible
        } else {
            Standing::Open
        }
    }
}

impl Candidate {
    /// The t-Student index, where nothing else is known of the inputs.
    pub(crate) fn of_student(values: Vec<f64>) -> Self {
        Self {
            basis: Basis::Student,
            measure: "t-Student index, ",
            by: "without bounds".to_owned(),
            failed: 0,
            count: 0,
            observations: 1,
            said: Said::Values(values.into_iter().map(|value| (value, None)).collect()),
        }
    }

    /// Number of inputs whose bounds are on one side of [`MATTERS`].
    pub(crate) fn settled(&self) -> usize {
        match &self.said {
            Said::Bounds(bounds) => bounds.iter().filter(|of| !of.is_open()).count(),
            Said::Values(_) => 0,
        }
    }

    /// Whether its bounds and those of derivatives exclude each other for some input.
    fn contradicts(&self, others: &[Self]) -> bool {
        let Said::Bounds(own) = &self.said else { return false };
        others.iter().filter(|of| of.basis == Basis::Derivatives).any(|of| match &of.said {
            Said::Bounds(bounds) => own.iter().zip(bounds).any(|(a, b)| a.low > b.high || a.high < b.low),
            Said::Values(_) => false,
        })
    }

    fn recommendation(self, names: &[String], confidence: f64) -> Recommendation {
        let index = |input: &String, value, [low, high]: [Option<f64>; 2], standing| RecommendedIndex {
            input: input.clone(),
            value,
            low,
            high,
            standing,
        };
        let named = names.iter();
        let (mut inputs, joint): (Vec<([f64; 2], RecommendedIndex)>, bool) = match &self.said {
            Said::Bounds(bounds) => {
                let one = |(name, of): (&String, &TotalBounds)| {
                    let is_value = of.at_least == of.at_most;
                    let value = Some(of.at_least).filter(|v| is_value && is_resolved(*v, [of.low, of.high]));
                    let ends = [of.low, of.high].map(Some);
                    ([of.at_least, of.at_most], index(name, value, ends, Some(of.standing())))
                };
                (named.zip(bounds).map(one).collect(), self.basis != Basis::Expansion)
            }
            Said::Values(values) => {
                let one = |(name, (value, ends)): (&String, &(f64, Option<[f64; 2]>))| {
                    let resolved = ends.is_none_or(|ends| is_resolved(*value, ends));
                    let ends = ends.map_or([None, None], |ends| ends.map(Some));
                    ([*value; 2], index(name, resolved.then_some(*value), ends, None))
                };
                (named.zip(values).map(one).collect(), false)
            }
        };
        // Those that certainly matter first, then by the share that is certain.
        let greater =
            |one: &[f64; 2], other: &[f64; 2]| other[0].total_cmp(&one[0]).then(other[1].total_cmp(&one[1]));
        let is_other = |of: &RecommendedIndex| of.standing != Some(Standing::Matters);
        inputs.sort_by(|one, other| {
            is_other(&one.1).cmp(&is_other(&other.1)).then_with(|| greater(&one.0, &other.0))
        });
        let failed = match self.failed {
            0 => String::new(),
            failed => format!("; {failed} failed, and the shares are those of the others"),
        };
        Recommendation {
            basis: self.basis,
            measure: format!("{}{}{failed}", self.measure, self.by),
            confidence: joint.then_some(confidence),
            inputs: inputs.into_iter().map(|(_, index)| index).collect(),
            remedy: None,
            explained: None,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn bounds(low: f64, at_least: f64, at_most: f64, high: f64) -> TotalBounds {
        TotalBounds { low, at_least, at_most, high, few: false, by_others: false }
    }

    fn candidate(basis: Basis, count: usize, of: Vec<TotalBounds>) -> Candidate {
        let by = format!("{count} of {basis:?}");
        let said = Said::Bounds(of);
        Candidate { basis, measure: "measure by ", by, failed: 0, count, observations: 10, said }
    }

    fn names(count: usize) -> Vec<String> {
        (0..count).map(|i| format!("x{i}")).collect()
    }

    #[test]
    fn an_input_matters_is_negligible_or_open_by_its_bounds_and_never_by_its_estimate() {
        let of = vec![
            bounds(0.005, 0.02, 0.02, 0.04),
            bounds(0.9, 0.95, 0.95, 0.97),
            bounds(0.0, 0.001, 0.001, 0.009),
        ];
        let found = recommend(&names(3), vec![candidate(Basis::Sobol, 100, of)], 0.95).unwrap();
        let inputs: Vec<&str> = found.inputs.iter().map(|of| of.input.as_str()).collect();
        assert_eq!(inputs, ["x1", "x0", "x2"]);
        let standings: Vec<Standing> = found.inputs.iter().filter_map(|of| of.standing).collect();
        assert_eq!(standings, [Standing::Matters, Standing::Open, Standing::Negligible]);
        // A value that is smaller than its interval is not given.
        assert_eq!(
            found.inputs.iter().map(|of| of.value.is_some()).collect::<Vec<_>>(),
            [true, false, false]
        );
        // 0.015 from the estimate to its end, 0.01 from the estimate to the limit: 2.25 times the blocks.
        let remedy = found.remedy.unwrap();
        assert!(remedy.contains("about 1560 more observations") && remedy.contains(": 256"), "{remedy}");
        let near = vec![bounds(0.0095, 0.01 + 1e-9, 0.01 + 1e-9, 0.0105)];
        let near = recommend(&names(1), vec![candidate(Basis::Sobol, 100, near)], 0.95).unwrap();
        assert_eq!(near.remedy.unwrap(), "The share of x0 is so near 1 % that no study settles it.");
    }

    #[test]
    fn the_basis_that_settles_most_inputs_is_recommended_and_values_where_none_does() {
        let loose = || candidate(Basis::Derivatives, 64, vec![bounds(0.0, 0.1, 0.9, 0.9)]);
        let narrow = candidate(Basis::Sobol, 64, vec![bounds(0.3, 0.4, 0.4, 0.5)]);
        let found = recommend(&names(1), vec![loose(), narrow], 0.95).unwrap();
        assert_eq!((found.basis, found.confidence), (Basis::Sobol, Some(0.95)));
        assert_eq!(recommend(&names(1), vec![loose()], 0.95).unwrap().basis, Basis::Derivatives);
        let student = Candidate::of_student(vec![2.0]);
        assert_eq!(recommend(&names(1), vec![loose(), student], 0.95).unwrap().basis, Basis::Student);
        assert_eq!(recommend(&names(1), vec![], 0.95), None);
    }

    #[test]
    fn blocks_settle_what_derivatives_cannot() {
        let (certain, apart) = (bounds(0.9, 0.95, 0.95, 0.97), bounds(0.0, 0.001, 0.9, 1.0));
        let found = |blocks: TotalBounds| {
            let derivatives = candidate(Basis::Derivatives, 64, vec![certain, apart]);
            let blocks = candidate(Basis::Sobol, 64, vec![certain, blocks]);
            recommend(&names(2), vec![derivatives, blocks], 0.95).unwrap()
        };
        let settled = found(bounds(0.0, 0.0, 0.0, 0.001));
        assert_eq!((settled.basis, settled.remedy), (Basis::Sobol, None));
        assert_eq!(settled.inputs[1].standing, Some(Standing::Negligible));
        let open = found(bounds(0.0, 0.1, 0.1, 0.2)).remedy.unwrap();
        assert!(open.contains("`sensitivity.saltelli_blocks`: 128"), "{open}");
    }

    #[test]
    fn an_input_that_derivatives_leave_open_and_blocks_settle_matters() {
        let (apart, certain) = (bounds(0.0, 0.001, 0.9, 1.0), bounds(0.0, 0.0, 0.0, 0.001));
        let derivatives = vec![apart, certain, certain, apart];
        let blocks =
            vec![bounds(0.6, 0.7, 0.7, 0.8), bounds(0.0, 0.0, 0.0, 0.1), bounds(0.0, 0.0, 0.0, 0.1), apart];
        let both = vec![candidate(Basis::Derivatives, 64, derivatives), candidate(Basis::Sobol, 128, blocks)];
        let found = recommend(&names(4), both, 0.95).unwrap();
        assert_eq!((found.with(Standing::Matters), found.with(Standing::Open)), (vec!["x0"], vec!["x3"]));
        assert_eq!((found.inputs[0].input.as_str(), found.inputs[0].value), ("x0", Some(0.7)));
        assert_eq!(found.measure, "measure by 64 of Derivatives or 128 of Sobol");
        // The bounds of x3 lie on both sides for both.
        assert!(found.remedy.unwrap().contains("The share of x3 is so near"));
    }

    #[test]
    fn four_times_as_many_points_are_tried_where_few_decide_a_bound() {
        let few = TotalBounds { few: true, ..bounds(0.0, 0.0, 1e-3, 0.2) };
        let certain = bounds(0.9, 0.95, 0.95, 0.97);
        let found = recommend(&names(2), vec![candidate(Basis::Derivatives, 64, vec![few, certain])], 0.95);
        assert!(found.unwrap().remedy.unwrap().contains(": 256"));
    }

    #[test]
    fn the_index_of_an_output_lies_within_the_bounds_of_an_expansion_that_lacks_a_part_of_it() {
        // f = g + c ψ(x1) with g = x1 + x2, all of variance 1 and orthogonal: T_1 = (1 + c²) / (2 + c²).
        let c: f64 = 0.3;
        let variance = 2.0 + c * c;
        let of = by_expansion(0.5, c * c / variance);
        let [first, second] = [(1.0 + c * c) / variance, 1.0 / variance];
        assert!(of.low < second && second < first && first < of.high, "{of:?}");
        // An input that g does not have may have all of the error.
        assert!((by_expansion(0.0, 0.04).high - 0.04).abs() < 1e-12);
        assert_eq!(by_expansion(0.0, 0.0).high, 0.0);
    }

    #[test]
    fn the_level_of_each_of_many_inputs_is_above_that_of_all() {
        assert_eq!(joint_level(0.95, 1), 0.95);
        assert!((joint_level(0.95, 50) - 0.999).abs() < 1e-12);
    }
}
