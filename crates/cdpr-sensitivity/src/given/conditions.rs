//! What the tests of a table assume, checked: rows that are independent of each other, and values that may be
//! what they seem to be.
//!
//! - **Repeated rows.** Rows count once if more of them repeat an earlier one than where each column is dealt
//!   to the rows at random, or if they are few settings of many rows each. Rows of equal inputs and different
//!   outputs are one *unit* with their mean output.

use std::collections::{HashMap, HashSet};

use rand::seq::SliceRandom;
use serde::{Deserialize, Serialize};

use crate::design::observation::Observed;
use crate::given::data::Kind;
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
    /// Inputs depend on each other in the rows of the runs that have not failed, and not in all rows.
    FailedRuns,
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

/// The first `most` entries in words, and how many more there are.
pub(crate) fn listed<T>(all: &[T], most: usize, word: impl Fn(&T) -> String) -> String {
    let words: Vec<String> = all.iter().take(most).map(word).collect();
    match all.len().saturating_sub(most) {
        0 => words.join(", "),
        more => format!("{} and {more} more", words.join(", ")),
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

/// The units, if rows repeat more often than by chance, or if they are less than half as many as by chance
/// and a column of numbers has another value in most of them: few settings with many rows of each. The levels
/// of a design are other than that: each has rows of several units.
fn repeated(columns: &[&[f64]], kinds: &[Kind], seed: u64) -> Option<(Vec<usize>, usize)> {
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
    let by_chance = units(&dealt.iter().map(Vec::as_slice).collect::<Vec<_>>()).1;
    let names_units = |(column, kind): (&&[f64], &Kind)| {
        let values = column.iter().map(|value| value.to_bits()).collect::<HashSet<_>>().len();
        *kind == Kind::Numbers && 4 * values >= 3 * count
    };
    let few = || 2 * count <= by_chance && columns.iter().zip(kinds).any(names_units);
    (n - count > 2 * (n - by_chance) || few()).then_some((of_rows, count))
}

/// The rows that repeat none before them, in inputs and output, if others do.
///
/// In a table of few levels only, rows repeat by the nature of their values: at least one column must have
/// values that mostly occur once.
pub(crate) fn distinct(observed: &Observed, kinds: &[Kind], seed: u64) -> Option<Observed> {
    let columns: Vec<&[f64]> =
        observed.columns.iter().chain([&observed.outputs]).map(Vec::as_slice).collect();
    let kinds = [kinds, &[Kind::Numbers]].concat();
    let (units, count) = repeated(&columns, &kinds, seed)?;
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

/// One row for all of equal inputs, with their mean output, if these repeat more often than by chance. The
/// mean is that of equally many rows of each, the first ones: means of more rows scatter less, and how often
/// inputs repeat may depend on them.
pub(crate) fn clusters(observed: &Observed, kinds: &[Kind], seed: u64) -> Option<Observed> {
    let columns: Vec<&[f64]> = observed.columns.iter().map(Vec::as_slice).collect();
    let (units, count) = if columns.is_empty() { None } else { repeated(&columns, kinds, seed) }?;
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

/// Whether an input numbers the rows, of which some may be left out.
pub(crate) fn row_number(name: &str, column: &[f64]) -> Option<Condition> {
    let text = || format!("input `{name}` numbers the rows: is it an input at all?");
    let concern = Concern::RowNumber;
    numbers_rows(column).then(|| Condition { concern, inputs: vec![name.to_owned()], text: text() })
}

/// Whether values rise by a whole number from each row to the next, by less than two on average.
pub(crate) fn numbers_rows(column: &[f64]) -> bool {
    let [first, .., last] = column else { return false };
    let rises = |pair: &[f64]| pair[1] > pair[0] && (pair[1] - pair[0]).fract() == 0.0;
    column.len() >= 8 && column.windows(2).all(rises) && last - first < 2.0 * (column.len() as f64 - 1.0)
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
