//! All measures of the inputs of a table.

use rand::seq::index::sample;

use crate::design::observation::Observed;
use crate::error::{SensitivityError, check_range};
use crate::given::analysis::{Analyser, CorrelatedPair, InputAnalysis, MOST_INPUTS, MOST_ROWS};
use crate::given::conditions::{self, Concern, Condition, listed};
use crate::given::data::{GivenData, Kind};
use crate::given::delta;
use crate::given::expansion::{self, GivenExpansion, affordable};
use crate::given::halves;
use crate::given::hsic::{self, Dependence, Rows};
use crate::given::levels;
use crate::given::limit::LEAST_FAILING;
use crate::given::pawn;
use crate::given::rank;
use crate::given::verdict::sequence::coordinates;
use crate::given::verdict::{Doubt, Table, Verdict};
use crate::measure::regression::{self, Of, ranks, standardized};
use crate::sample::interval::{Estimate, effective};
use crate::sample::random::{derived_seed, stream};
use crate::sample::summary::check_varies;

/// A table without repeated rows and without constant inputs.
pub(crate) struct Work<'a> {
    analyser: Analyser,
    /// Numbers and names of the inputs that vary, and what their values are.
    pub(crate) varying: Vec<usize>,
    names: Vec<&'a str>,
    pub(crate) kinds: Vec<Kind>,
    /// Outputs of the rows that repeat none before them in inputs and output.
    pub(crate) outputs: Vec<f64>,
    /// One row for each set of inputs: those rows, or the means of those with equal inputs.
    pub(crate) observed: Observed,
    /// At most [`MOST_ROWS`] of them.
    pub(crate) drawn: Observed,
    /// Which of the inputs that vary are coordinates of a sequence.
    coordinate: Vec<bool>,
}

impl<'a> Work<'a> {
    pub(crate) fn new(analyser: Analyser, data: &'a GivenData, all: &Observed) -> Self {
        let seed = |part: u64| derived_seed(analyser.seed, part);
        let kinds =
            |inputs: &[usize]| -> Vec<Kind> { inputs.iter().map(|&input| data.kind(input)).collect() };
        let distinct =
            conditions::distinct(all, &kinds(&(0..all.columns.len()).collect::<Vec<_>>()), seed(6));
        let of = distinct.as_ref().unwrap_or(all);
        let varies = |input: &usize| check_varies(&of.columns[*input]).is_ok();
        let varying: Vec<usize> = (0..of.columns.len()).filter(varies).collect();
        let columns = varying.iter().map(|&input| of.columns[input].clone()).collect();
        let rows = Observed { columns, outputs: of.outputs.clone(), failed: of.failed };
        let kinds = kinds(&varying);
        let units =
            conditions::clusters(&rows, &kinds, seed(7)).filter(|of| check_varies(&of.outputs).is_ok());
        let observed = units.unwrap_or_else(|| rows.clone());
        let drawn = thinned(&observed, seed(0));
        let in_turn: Vec<&[f64]> = varying.iter().map(|&input| &data.columns()[input][..]).collect();
        Self {
            analyser,
            coordinate: coordinates(&in_turn, &drawn.columns, &kinds, seed(8)),
            names: varying.iter().map(|&input| data.names()[input].as_str()).collect(),
            kinds,
            varying,
            outputs: rows.outputs,
            drawn,
            observed,
        }
    }

    /// The outputs that laws are fitted to: at most [`MOST_ROWS`].
    pub(crate) fn fitted(&self) -> Vec<f64> {
        let all = Observed { columns: vec![], outputs: self.outputs.clone(), failed: 0 };
        thinned(&all, self.seed(0)).outputs
    }

    pub(crate) fn seed(&self, part: u64) -> u64 {
        derived_seed(self.analyser.seed, part)
    }

    pub(crate) fn rows(&self) -> Rows {
        Rows { most: self.analyser.dependence_rows, seed: self.seed(3) }
    }

    pub(crate) fn expansion(&self, notes: &mut Notes) -> Option<GivenExpansion> {
        let truncation = affordable(self.names.len(), self.drawn.outputs.len());
        let found = enough(&self.drawn, crate::measure::expansion::Expansion::MIN_OUTPUTS)
            .and_then(|()| check_range("inputs that vary", self.names.len() as u64, 1, MOST_INPUTS as u64))
            .and_then(|()| expansion::of_observed(&self.drawn, truncation));
        let found = notes.unless("expansion", found)?;
        if found.leave_one_out > expansion::MOST_ERROR {
            notes.0.push(format!(
                "polynomial shares: the model leaves {:.0} % of the variance unexplained, its shares say nothing",
                100.0 * found.leave_one_out
            ));
        }
        Some(found)
    }

    /// R² of linear models of values and of ranks, all measures of each input but those at a limit, and the
    /// dependence on those that vary.
    pub(crate) fn inputs(
        &self,
        data: &GivenData,
        expansion: Option<&GivenExpansion>,
        notes: &mut Notes,
    ) -> ([Option<f64>; 2], Vec<InputAnalysis>, Option<Vec<Dependence>>) {
        let (observed, drawn, level) = (&self.observed, &self.drawn, self.analyser.level);
        let [of_values, of_ranks] = [(Of::Values, "regression"), (Of::Ranks, "rank regression")]
            .map(|(of, label)| notes.unless(label, self.regression(of)));
        let first = self.said(self.first(notes), notes);
        let dependence = hsic::of_output(&observed.columns, &self.kinds, &observed.outputs, self.rows());
        let dependence = notes.unless("dependence", dependence);
        let enough_rows = enough(observed, pawn::MIN_ROWS);
        let pawn =
            enough_rows.clone().map(|()| pawn::of_columns(&drawn.columns, &drawn.outputs, self.seed(4)));
        let pawn = notes.unless("PAWN", pawn);
        let delta =
            enough_rows.and_then(|()| delta::of_columns(&drawn.columns, &drawn.outputs, level, self.seed(5)));
        let delta = notes.unless("delta", delta);
        let failure = failure(data, self.rows());
        let halves = halves::of_observed(observed);
        let input = |number: usize| {
            let place = self.varying.iter().position(|&varying| varying == number);
            let numbers = place.filter(|&i| self.kinds[i] == Kind::Numbers);
            let words = place.filter(|&i| self.kinds[i] == Kind::Levels);
            InputAnalysis {
                input: data.names()[number].clone(),
                half: numbers.and_then(|i| halves[i]),
                levels: words.map_or(vec![], |i| {
                    levels::of_labels(data.labels(number), &observed.columns[i], &observed.outputs)
                }),
                standardized: place.and_then(|i| of_values.as_ref()?.1[i]),
                rank_standardized: place.and_then(|i| of_ranks.as_ref()?.1[i]),
                first: place.and_then(|i| first[i]),
                shares: place.and_then(|i| expansion?.shares(i)),
                dependence: place.and_then(|i| Some(dependence.as_ref()?[i])),
                pawn: place.and_then(|i| Some(pawn.as_ref()?[i])),
                delta: place.and_then(|i| Some(delta.as_ref()?[i])),
                limit: None,
                failure: place.and_then(|_| Some(failure.as_ref()?[number])),
            }
        };
        let inputs = (0..data.names().len()).map(input).collect();
        ([of_values.map(|found| found.0), of_ranks.map(|found| found.0)], inputs, dependence)
    }

    /// First-order indices: by levels where these are few, otherwise by ranks.
    fn first(&self, notes: &mut Notes) -> Vec<Option<Estimate>> {
        let Observed { columns, outputs, failed } = &self.observed;
        let level = self.analyser.level;
        let by_levels: Vec<bool> = (columns.iter().zip(&self.kinds))
            .map(|(column, kind)| levels::has_levels(column, *kind == Kind::Levels))
            .collect();
        let by_ranks: Vec<usize> =
            (0..columns.len()).filter(|&i| !by_levels[i] && self.kinds[i] == Kind::Numbers).collect();
        let of_ranks = Observed {
            columns: by_ranks.iter().map(|&i| columns[i].clone()).collect(),
            outputs: outputs.clone(),
            failed: *failed,
        };
        let of_ranks = match by_ranks.is_empty() {
            true => None,
            false if self.coordinate.contains(&true) => {
                notes.0.push(format!("first-order indices: {}", rank::OF_SEQUENCE));
                None
            }
            false => notes.unless("first-order indices", rank::of_observed(&of_ranks, level, self.seed(2))),
        };
        let of_input = |i: usize| match by_ranks.iter().position(|&rank| rank == i) {
            Some(place) => Some(of_ranks.as_ref()?[place]),
            None if by_levels[i] => levels::share(&columns[i], outputs, level).ok(),
            None => None,
        };
        (0..columns.len()).map(of_input).collect()
    }

    /// The indices whose intervals leave anything out, and a note of the others.
    fn said(&self, first: Vec<Option<Estimate>>, notes: &mut Notes) -> Vec<Option<Estimate>> {
        let says = |of: &Option<Estimate>| of.is_some_and(|of| !of.says_nothing());
        let open: Vec<&str> = self
            .names
            .iter()
            .zip(&first)
            .filter(|(_, of)| of.is_some() && !says(of))
            .map(|(name, _)| *name)
            .collect();
        if !open.is_empty() {
            let outputs = &self.observed.outputs;
            let mean = outputs.iter().sum::<f64>() / outputs.len() as f64;
            let squares: Vec<f64> = outputs.iter().map(|y| (y - mean).powi(2)).collect();
            notes.0.push(format!(
                "first-order indices: {} rows, of which {:.0} dominate the variance, leave these open from 0 to \
                 1: \
                 {}",
                outputs.len(),
                effective(&squares),
                listed(&open, 8, |name| (*name).to_owned())
            ));
        }
        first.into_iter().map(|of| of.filter(|_| says(&of))).collect()
    }

    /// R² and the coefficient of each input of numbers. An input of words has a column for each level but
    /// one.
    fn regression(&self, of: Of) -> Result<(f64, Vec<Option<f64>>), SensitivityError> {
        let (mut names, mut columns, mut places) = (vec![], vec![], vec![]);
        for ((name, column), kind) in self.names.iter().zip(&self.observed.columns).zip(&self.kinds) {
            places.push((*kind == Kind::Numbers).then_some(columns.len()));
            match kind {
                Kind::Numbers => columns.push(column.clone()),
                Kind::Levels => {
                    let (codes, count) = levels::codes(column);
                    let is_at = |level| codes.iter().map(|&code| f64::from(code == level)).collect();
                    columns.extend((1..count).map(is_at));
                }
            }
            names.resize(columns.len(), *name);
        }
        let outputs = self.observed.outputs.clone();
        let observed = Observed { columns, outputs, failed: self.observed.failed };
        let found = regression::of_observed(&names, observed, of)?;
        let coefficient = |place: Option<usize>| Some(found.inputs[place?].standardized);
        Ok((found.r_squared, places.into_iter().map(coefficient).collect()))
    }

    /// The pair of numbers of the largest rank correlation.
    pub(crate) fn most_correlated(&self) -> Option<CorrelatedPair> {
        let scores = |(column, kind): (&Vec<f64>, &Kind)| {
            standardized(ranks(column)).filter(|_| *kind == Kind::Numbers)
        };
        let columns: Vec<Option<Vec<f64>>> = self.drawn.columns.iter().zip(&self.kinds).map(scores).collect();
        let mut largest: Option<([usize; 2], f64)> = None;
        for (i, one) in columns.iter().enumerate() {
            for (j, other) in columns.iter().enumerate().skip(i + 1) {
                let Some((one, other)) = one.as_ref().zip(other.as_ref()) else { continue };
                let product: f64 = one.iter().zip(other).map(|(x, y)| x * y).sum();
                let correlation = product / (one.len() as f64 - 1.0);
                if largest.is_none_or(|(_, known)| correlation.abs() > known.abs()) {
                    largest = Some(([i, j], correlation));
                }
            }
        }
        let (pair, rank_correlation) = largest?;
        Some(CorrelatedPair { inputs: pair.map(|i| self.names[i].to_owned()), rank_correlation })
    }

    /// Which inputs matter; `all` are all observed rows.
    pub(crate) fn verdict(
        &self,
        data: &GivenData,
        all: &Observed,
        dependence: Option<&[Dependence]>,
    ) -> Verdict {
        let every = self.every(data);
        let table = Table {
            names: &self.names,
            kinds: &self.kinds,
            units: &self.observed,
            drawn: &self.drawn,
            coordinate: &self.coordinate,
            dependence,
            rows: self.rows(),
            every: every.as_ref(),
            outputs: self.analyser.outputs.max(1),
        };
        let mut verdict = table.verdict();
        let first = self.first(&mut Notes(Vec::new()));
        let place = |input: &str| self.names.iter().position(|name| *name == input);
        verdict.by_share(|input| Some(first[place(input)?]?.value));
        self.note_repeated(&mut verdict, all.outputs.len());
        for (input, column) in all.columns.iter().enumerate() {
            let (name, kind) = (&data.names()[input], data.kind(input));
            // Failed runs have a number, too.
            let number = || conditions::row_number(name, &data.columns()[input]);
            let has_number = kind == Kind::Numbers && self.names.len() > 1;
            let condition = has_number.then(number).flatten();
            let condition = condition.or_else(|| conditions::of_column(Some(name), column, kind));
            let doubt = |reason: &str| Doubt { input: name.clone(), reason: reason.to_owned() };
            if condition.as_ref().is_some_and(|condition| condition.concern == Concern::Constant) {
                verdict.doubtful.push(doubt("it is constant"));
            } else if kind == Kind::Levels && levels::codes(column).1 == column.len() {
                verdict.doubtful.push(doubt("each row has a word of its own"));
            }
            verdict.conditions.extend(condition);
        }
        let of_output = conditions::of_column(None, &all.outputs, Kind::Numbers);
        verdict.conditions.extend(of_output.filter(Condition::is_question));
        verdict.concluded(&self.names, data.names().len())
    }

    /// The inputs that vary in all rows, with 1 for a failed run and 0 for others; none where all have an
    /// output.
    fn every(&self, data: &GivenData) -> Option<Observed> {
        let columns = self.varying.iter().map(|&input| data.columns()[input].clone());
        let failed = || data.outputs().iter().map(|output| f64::from(output.is_none())).collect();
        let rows = || Observed { columns: columns.collect(), outputs: failed(), failed: 0 };
        (self.observed.failed > 0).then(|| thinned(&rows(), self.seed(9)))
    }

    /// Rows that count once, and settings of which the mean output counts.
    fn note_repeated(&self, verdict: &mut Verdict, all: usize) {
        let (distinct, units) = (self.outputs.len(), self.observed.outputs.len());
        if distinct < all {
            let repeated = all - distinct;
            let (repeat, count) = if repeated == 1 {
                ("repeats another", "it counts")
            } else {
                ("repeat others", "they count")
            };
            verdict.note(
                Concern::RepeatedRows,
                format!("{repeated} of {all} rows {repeat} in all inputs and in the output: {count} once"),
            );
        }
        if units < distinct {
            let text = format!(
                "{distinct} rows have {units} different sets of inputs: verdict and measures take the mean \
                 output of each; the law and the failures of a limit are those of all rows"
            );
            verdict.note(Concern::RepeatedRows, text);
        }
    }
}

pub(crate) struct Notes(pub(crate) Vec<String>);

impl Notes {
    /// The result, or a note of why it is left out.
    pub(crate) fn unless<T>(&mut self, label: &str, result: Result<T, SensitivityError>) -> Option<T> {
        result.map_err(|error| self.0.push(format!("{label}: {error}"))).ok()
    }
}

fn enough(observed: &Observed, minimum: usize) -> Result<(), SensitivityError> {
    check_range("observed outputs", observed.outputs.len() as u64, minimum as u64, u64::MAX)
}

/// At most [`MOST_ROWS`] rows.
fn thinned(observed: &Observed, seed: u64) -> Observed {
    let n = observed.outputs.len();
    if n <= MOST_ROWS {
        return observed.clone();
    }
    let mut rows = sample(&mut stream(seed, 0), n, MOST_ROWS).into_vec();
    rows.sort_unstable();
    let select = |values: &[f64]| -> Vec<f64> { rows.iter().map(|&row| values[row]).collect() };
    Observed {
        columns: observed.columns.iter().map(|column| select(column)).collect(),
        outputs: select(&observed.outputs),
        failed: observed.failed,
    }
}

/// Dependence of a failed observation on each input, where at least [`LEAST_FAILING`] failed.
fn failure(data: &GivenData, rows: Rows) -> Option<Vec<Dependence>> {
    let failed: Vec<bool> = data.outputs().iter().map(Option::is_none).collect();
    let count = failed.iter().filter(|failed| **failed).count();
    if count.min(failed.len() - count) < LEAST_FAILING {
        return None;
    }
    let kinds: Vec<Kind> = (0..data.names().len()).map(|input| data.kind(input)).collect();
    hsic::of_event(data.columns(), &kinds, &failed, rows).ok()
}
