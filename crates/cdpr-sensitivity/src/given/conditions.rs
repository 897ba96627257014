//! What the tests of a table assume, checked: rows that are independent of each other, and values that may be
//! what they seem to be.
//!
//! - **Repeated rows.** Rows count once if more of them repeat an earlier one than where each column is dealt
//!   to the rows at random. Rows of equal inputs and different outputs are one *unit* with their mean output.
//! - **Rows in an order.** With the correlations `r_k` of the ranks of a column k rows apart,
//!
//! ```text
//! Q = n (n + 2) Σ r_k² / (n - k),   k = 1 .. min(10, n / 5),   χ² without an order     (Cd1)
//! ```
//!
//!   G. M. Ljung, G. E. P. Box, *On a measure of lack of fit in time series models*, Biometrika 65 (1978).
//!   Dealing outputs to the rows at random is a fair comparison unless both an input and the output have an
//!   order. Rows of a sequence of low discrepancy have one that makes the tests stricter; those of a design of
//!   balanced levels have one that does no harm if the output has none beyond its levels.

use std::collections::HashMap;

use rand::seq::SliceRandom;
use serde::{Deserialize, Serialize};
use statrs::distribution::{ChiSquared, ContinuousCDF};

use crate::design::observation::Observed;
use crate::given::data::Kind;
use crate::given::levels::codes;
use crate::measure::regression::{ranks, standardized};
use crate::sample::random::stream;

/// What a condition is about.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(feature = "schemars", derive(schemars::JsonSchema))]
#[serde(rename_all = "snake_case")]
pub enum Concern {
    /// Rows repeat earlier ones.
    RepeatedRows,
    /// Rows next to each other are alike.
    RowsInOrder,
    /// Inputs depend on each other.
    DependentInputs,
    /// Inputs are those of a sequence of low discrepancy.
    Sequence,
    /// An input has one value only.
    Constant,
    /// An input numbers the rows.
    RowNumber,
    /// Few values are far beyond all others.
    Diverged,
    /// One value, far from all others, is there several times: it may stand for a missing one.
    Sentinel,
    /// There are too few rows for any verdict.
    FewRows,
}

/// What was found of a condition.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schemars", derive(schemars::JsonSchema))]
pub struct Condition {
    /// What it is about.
    pub concern: Concern,
    /// Inputs that it is about; none for the output, or for all.
    pub inputs: Vec<String>,
    /// What was found, in words.
    pub text: String,
}

impl Condition {
    /// Whether the table may not be what its user means: something to look at before its numbers are used.
    #[must_use]
    pub fn is_question(&self) -> bool {
        use Concern::{Constant, Diverged, RepeatedRows, RowNumber, Sentinel};
        matches!(self.concern, RepeatedRows | Constant | RowNumber | Diverged | Sentinel)
    }
}

/// Unit of each row, numbered in the order of the first rows, and their number.
fn units(columns: &[&[f64]]) -> (Vec<usize>, usize) {
    let mut known: HashMap<Vec<u64>, usize> = HashMap::new();
    let key = |row: usize| columns.iter().map(|column| column[row].to_bits()).collect();
    let of_row = |row: usize| {
        let next = known.len();
        *known.entry(key(row)).or_insert(next)
    };
    let units = (0..columns[0].len()).map(of_row).collect();
    (units, known.len())
}

/// The units, if rows repeat more often than by chance.
fn repeated(columns: &[&[f64]], seed: u64) -> Option<(Vec<usize>, usize)> {
    let (of_rows, count) = units(columns);
    let n = of_rows.len();
    if count == n {
        return None;
    }
    let dealt = |(number, column): (usize, &&[f64])| {
        let mut dealt = column.to_vec();
        dealt.shuffle(&mut stream(seed, number as u64));
        dealt
    };
    let dealt: Vec<Vec<f64>> = columns.iter().enumerate().map(dealt).collect();
    let by_chance = n - units(&dealt.iter().map(Vec::as_slice).collect::<Vec<_>>()).1;
    (n - count > 2 * by_chance).then_some((of_rows, count))
}

/// The rows that repeat none before them, in inputs and output, if others do.
///
/// In a table of few levels only, rows repeat by the nature of their values: at least one column must have
/// values that mostly occur once.
pub(crate) fn distinct(observed: &Observed, seed: u64) -> Option<Observed> {
    let columns: Vec<&[f64]> =
        observed.columns.iter().chain([&observed.outputs]).map(Vec::as_slice).collect();
    let (units, count) = repeated(&columns, seed)?;
    let mut first = vec![usize::MAX; count];
    units.iter().enumerate().for_each(|(row, &unit)| first[unit] = first[unit].min(row));
    let select = |values: &[f64]| -> Vec<f64> { first.iter().map(|&row| values[row]).collect() };
    let varied = |values: &&[f64]| {
        let mut values = select(values);
        values.sort_unstable_by(f64::total_cmp);
        let once = values.chunk_by(|one, other| one == other).filter(|equal| equal.len() == 1).count();
        2 * once >= count
    };
    columns.iter().any(varied).then(|| Observed {
        columns: observed.columns.iter().map(|column| select(column)).collect(),
        outputs: select(&observed.outputs),
        failed: observed.failed,
    })
}

/// One row for all of equal inputs, with their mean output, if these repeat more often than by chance. The mean
/// is that of equally many rows of each, the first ones: means of more rows scatter less, and how often inputs
/// repeat may depend on them.
pub(crate) fn clusters(observed: &Observed, seed: u64) -> Option<Observed> {
    let columns: Vec<&[f64]> = observed.columns.iter().map(Vec::as_slice).collect();
    let (units, count) = if columns.is_empty() { None } else { repeated(&columns, seed) }?;
    let mut sums = vec![(0.0, 0.0); count];
    let mut first = vec![usize::MAX; count];
    let mut sizes = vec![0_usize; count];
    units.iter().for_each(|&unit| sizes[unit] += 1);
    let least = sizes.iter().min().map_or(1.0, |least| *least as f64);
    for (row, (&unit, output)) in units.iter().zip(&observed.outputs).enumerate() {
        first[unit] = first[unit].min(row);
        if sums[unit].0 < least {
            sums[unit] = (sums[unit].0 + 1.0, sums[unit].1 + output);
        }
    }
    Some(Observed {
        columns: columns.iter().map(|column| first.iter().map(|&row| column[row]).collect()).collect(),
        outputs: sums.into_iter().map(|(rows, sum)| sum / rows).collect(),
        failed: observed.failed,
    })
}

/// Level of the test of an order.
const ORDERED: f64 = 0.01;

/// Whether each input and the output have an order together, which an accident can make alike; that of the
/// coordinates of a sequence makes tests stricter.
pub(crate) fn in_order(observed: &Observed, kinds: &[Kind], coordinate: &[bool], seed: u64) -> Vec<bool> {
    let has_none = || coordinate.iter().all(|is| *is) || !has_order(&observed.outputs);
    if has_none() || is_balanced(observed, seed) {
        return vec![false; kinds.len()];
    }
    let of_input = |(column, kind): (&Vec<f64>, &Kind)| match kind {
        Kind::Numbers => has_order(column),
        Kind::Levels => {
            let (codes, count) = codes(column);
            let of_level =
                |level| order_p(&codes.iter().map(|&code| f64::from(code == level)).collect::<Vec<_>>());
            (0..count).any(|level| of_level(level) * (count as f64) < ORDERED)
        }
    };
    let all = observed.columns.iter().zip(kinds).zip(coordinate);
    all.map(|(column, coordinate)| !coordinate && of_input(column)).collect()
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

/// What may be wrong with an input, or with the output if it has no name.
pub(crate) fn of_column(name: Option<&str>, column: &[f64], kind: Kind) -> Option<Condition> {
    let called = name.map_or("the output".to_owned(), |name| format!("input `{name}`"));
    let condition =
        |concern, text| Condition { concern, inputs: name.map(str::to_owned).into_iter().collect(), text };
    let first = *column.first()?;
    if column.iter().all(|value| *value == first) {
        return Some(condition(
            Concern::Constant,
            format!("{called} is constant: nothing can be said of it"),
        ));
    }
    if kind == Kind::Levels {
        return None;
    }
    if name.is_some() && column.len() >= 8 && column.windows(2).all(|pair| pair[1] - pair[0] == 1.0) {
        return Some(condition(
            Concern::RowNumber,
            format!("{called} numbers the rows: is it an input at all?"),
        ));
    }
    if let Some((value, count, [low, high])) = sentinel(column) {
        let shown = if value.abs() < 1e9 { value.to_string() } else { format!("{value:e}") };
        let text = format!(
            "{count} of {} values of {called} are {shown}, all others from {low:.3e} to {high:.3e}: does it \
             stand for a missing value?",
            column.len()
        );
        return Some(condition(Concern::Sentinel, text));
    }
    let (count, least, next) = diverged(column)?;
    let values = if count == 1 { "1 value".to_owned() } else { format!("{count} values") };
    let text = format!(
        "{values} of {called} lie{} {least:.3e} or more from the median, all others within {next:.3e}: did \
         {} run{} fail?",
        if count == 1 { "s" } else { "" },
        if count == 1 { "this" } else { "these" },
        if count == 1 { "" } else { "s" },
    );
    Some(condition(Concern::Diverged, text))
}

/// A value that several rows have, at most 30 % of them, far below or above all others: the value, the number
/// of rows, the least and the largest of the others. Columns of few levels have none.
fn sentinel(column: &[f64]) -> Option<(f64, usize, [f64; 2])> {
    /// How many times farther from the others than these are from each other.
    const FARTHER: f64 = 2.0;
    const FEW: usize = 10;
    let mut sorted = column.to_vec();
    sorted.sort_unstable_by(f64::total_cmp);
    let n = sorted.len();
    let at = |value: f64| {
        let first = sorted.partition_point(|other| *other < value);
        (first, sorted.partition_point(|other| *other <= value) - first)
    };
    let far = |value: f64| {
        let (first, count) = at(value);
        let others = if first == 0 { &sorted[count..] } else { &sorted[..first] };
        let (low, high) = (*others.first()?, *others.last()?);
        let gap = if first == 0 { low - value } else { value - high };
        let levels = others.chunk_by(|one, other| one == other).take(FEW).count();
        let is_few = (2..=3 * n / 10).contains(&count) && levels == FEW;
        (is_few && gap > FARTHER * (high - low)).then_some((value, count, [low, high]))
    };
    far(sorted[0]).or_else(|| far(sorted[n - 1]))
}

/// Number of values that are far beyond all others, the least of their distances from the median, and the
/// largest distance of the others.
fn diverged(column: &[f64]) -> Option<(usize, f64, f64)> {
    /// How many times farther than the next value, and than half of the values.
    const FARTHER: f64 = 100.0;
    let n = column.len();
    let mut sorted = column.to_vec();
    sorted.sort_unstable_by(f64::total_cmp);
    let median = sorted[n / 2];
    let mut distances: Vec<f64> = sorted.iter().map(|value| (value - median).abs()).collect();
    distances.sort_unstable_by(f64::total_cmp);
    let half = distances[n / 2];
    let gap = |&count: &usize| {
        let (far, next) = (distances[n - count], distances[n - count - 1]);
        next > 0.0 && half > 0.0 && far > FARTHER * next && far > FARTHER * half
    };
    let count = (1..=n / 20).rev().find(gap)?;
    Some((count, distances[n - count], distances[n - count - 1]))
}
