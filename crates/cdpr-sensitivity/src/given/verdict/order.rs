//! Whether inputs and the output have an order of rows together.
//!
//! With the correlations `r_k` of the ranks of a column k rows apart,
//!
//! ```text
//! Q = n (n + 2) Σ r_k² / (n - k),   k = 1 .. min(10, n / 5),   χ² without an order     (Cd1)
//! ```
//!
//! G. M. Ljung, G. E. P. Box, *On a measure of lack of fit in time series models*, Biometrika 65 (1978).
//! Dealing outputs to the rows at random is a fair comparison unless both an input and the output have an
//! order. Rows of a sequence of low discrepancy have one that makes the tests stricter; those of a design of
//! balanced levels have one that does no harm if the output has none beyond its levels. An input whose values
//! follow the number of the row, as the slowest factor of a design in standard order, is never told from a
//! drift.

use rand::seq::SliceRandom;
use statrs::distribution::{ChiSquared, ContinuousCDF};

use crate::design::observation::Observed;
use crate::given::data::Kind;
use crate::given::levels::codes;
use crate::measure::regression::{ranks, standardized};
use crate::sample::random::stream;

/// Level of the test of an order.
const ORDERED: f64 = 0.01;

/// How the rows of an input are in an order that an accident can share.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Order {
    /// Neighbours are alike, as those of the output are.
    Alike,
    /// Its values follow the number of the row, as a drift does, whatever the order of the output is.
    Follows,
}

impl Order {
    /// Why an effect of the input need not be one.
    pub(crate) const fn reason(self) -> &'static str {
        match self {
            Self::Alike => "rows next to each other are alike in it and in the output",
            Self::Follows => "its values follow the order of the rows: a drift of the output looks the same",
        }
    }

    /// What holds for all `inputs` of this kind.
    pub(crate) fn note(self, inputs: &str) -> String {
        match self {
            Self::Alike => format!(
                "rows next to each other are alike in the output and in inputs ({inputs}): p-values and \
                 intervals are too small for these"
            ),
            Self::Follows => format!(
                "inputs follow the order of the rows ({inputs}), as a drift of the output does: rows in \
                 random order separate the two; a time or a count of runs is no input"
            ),
        }
    }
}

/// The order that each input and the output have together, which an accident can make alike; that of the
/// coordinates of a sequence makes tests stricter.
pub(crate) fn in_order(
    observed: &Observed,
    kinds: &[Kind],
    coordinate: &[bool],
    seed: u64,
) -> Vec<Option<Order>> {
    let has_none = || coordinate.iter().all(|is| *is) || !has_order(&observed.outputs);
    let fair = has_none() || is_balanced(observed, seed);
    let is_in_order = |(column, kind): (&Vec<f64>, &Kind)| match kind {
        Kind::Numbers => has_order(column),
        Kind::Levels => {
            let (codes, count) = codes(column);
            let of_level =
                |level| order_p(&codes.iter().map(|&code| f64::from(code == level)).collect::<Vec<_>>());
            (0..count).any(|level| of_level(level) * (count as f64) < ORDERED)
        }
    };
    let of_input = |(input, coordinate): ((&Vec<f64>, &Kind), &bool)| {
        if *coordinate || !is_in_order(input) {
            return None;
        }
        if fair { follows(input.0).then_some(Order::Follows) } else { Some(Order::Alike) }
    };
    observed.columns.iter().zip(kinds).zip(coordinate).map(of_input).collect()
}

/// Whether the means of the row numbers at the levels of an input, or in ten parts of its values, have more
/// than half of the variance of these, or of their squares from the middle: a steady drift, or one that turns
/// once, is then an effect of the input for the most part.
fn follows(column: &[f64]) -> bool {
    const PARTS: usize = 10;
    let (levels, count) = codes(column);
    let n = column.len();
    let ranks = ranks(column);
    let part = |rank: &f64| ((rank - 0.5) / n as f64 * PARTS as f64) as usize;
    let (groups, count) =
        if count <= PARTS { (levels, count) } else { (ranks.iter().map(part).collect(), PARTS) };
    let middle = 0.5 * (n as f64 - 1.0);
    let steady: Vec<f64> = (0..n).map(|row| row as f64 - middle).collect();
    let square = steady.iter().map(|x| x * x).sum::<f64>() / n as f64;
    let turning: Vec<f64> = steady.iter().map(|x| x * x - square).collect();
    let share = |drift: &[f64]| {
        let mut sums = vec![(0.0_f64, 0.0_f64); count];
        groups.iter().zip(drift).for_each(|(&g, x)| sums[g] = (sums[g].0 + 1.0, sums[g].1 + x));
        let between: f64 = sums.iter().filter(|of| of.0 > 0.0).map(|(rows, sum)| sum * sum / rows).sum();
        between / drift.iter().map(|x| x * x).sum::<f64>()
    };
    share(&steady).max(share(&turning)) > 0.5
}

fn has_order(values: &[f64]) -> bool {
    order_p(values) < ORDERED
}

/// p of (Cd1).
fn order_p(values: &[f64]) -> f64 {
    let n = values.len();
    let lags = 10.min(n / 5);
    let Some(scores) = standardized(ranks(values)).filter(|_| lags > 0) else { return 1.0 };
    let r = |lag: usize| {
        scores.iter().zip(&scores[lag..]).map(|(one, other)| one * other).sum::<f64>() / (n as f64 - 1.0)
    };
    let sum: f64 = (1..=lags).map(|lag| r(lag).powi(2) / (n - lag) as f64).sum();
    let statistic = n as f64 * (n as f64 + 2.0) * sum;
    ChiSquared::new(lags as f64).map_or(1.0, |law| law.sf(statistic))
}

/// Whether the inputs are the factors of a design, each pair of levels as often as by their own numbers, and
/// the output has no order beyond the means of their levels and of pairs of these.
fn is_balanced(observed: &Observed, seed: u64) -> bool {
    const MOST_LEVELS: usize = 10;
    const MOST_FACTORS: usize = 30;
    let n = observed.outputs.len();
    if observed.columns.len() > MOST_FACTORS {
        return false;
    }
    let factors: Vec<(Vec<usize>, usize)> = observed.columns.iter().map(|column| codes(column)).collect();
    if factors.iter().any(|(_, count)| *count > MOST_LEVELS) {
        return false;
    }
    let cells = |one: usize, other: usize| -> (Vec<usize>, usize) {
        let count = factors[other].1;
        let cell = |(a, b): (&usize, &usize)| a * count + b;
        (factors[one].0.iter().zip(&factors[other].0).map(cell).collect(), factors[one].1 * count)
    };
    let sizes = |(of_rows, count): &(Vec<usize>, usize)| {
        let mut sizes = vec![0_usize; *count];
        of_rows.iter().for_each(|&level| sizes[level] += 1);
        sizes
    };
    let pairs: Vec<[usize; 2]> =
        (0..factors.len()).flat_map(|one| (one + 1..factors.len()).map(move |other| [one, other])).collect();
    let balanced = |&[one, other]: &[usize; 2]| {
        let [of_one, of_other] = [one, other].map(|factor| sizes(&factors[factor]));
        let together = sizes(&cells(one, other));
        (0..together.len())
            .all(|cell| together[cell] * n == of_one[cell / of_other.len()] * of_other[cell % of_other.len()])
    };
    if !pairs.iter().all(balanced) {
        return false;
    }
    let mut removed = factors.clone();
    let mut freedoms = factors.iter().map(|(_, count)| count - 1).sum::<usize>();
    for &[one, other] in &pairs {
        freedoms += (factors[one].1 - 1) * (factors[other].1 - 1);
        if 4 * freedoms <= 3 * n {
            removed.push(cells(one, other));
        }
    }
    !rest_has_order(&observed.outputs, &removed, seed)
}

/// Whether what means of groups of rows leave of the outputs has an order: more of it than all but one of 199
/// deals of the outputs to the rows.
fn rest_has_order(outputs: &[f64], removed: &[(Vec<usize>, usize)], seed: u64) -> bool {
    const DEALS: u64 = 199;
    let rest = |mut values: Vec<f64>| {
        for (of_rows, count) in removed {
            let mut sums = vec![(0.0, 0.0); *count];
            of_rows.iter().zip(&values).for_each(|(&g, v)| sums[g] = (sums[g].0 + 1.0, sums[g].1 + v));
            of_rows.iter().zip(&mut values).for_each(|(&g, v)| *v -= sums[g].1 / sums[g].0);
        }
        // What is left of an output that its factors decide is rounding.
        let rounding = 1e-9 * values.len() as f64;
        values.iter_mut().filter(|v| v.abs() < rounding).for_each(|v| *v = 0.0);
        order_p(&values)
    };
    let values = ranks(outputs);
    let found = rest(values.clone());
    let dealt = |deal: u64| {
        let mut values = values.clone();
        values.shuffle(&mut stream(seed, deal));
        rest(values)
    };
    found < 1.0 && (0..DEALS).filter(|&deal| dealt(deal) <= found).count() <= 1
}
