//! The analysis of a table: which columns are inputs and outputs, which rows count, what each output says.

use crate::error::StudyError;
use crate::given::columns::{BadCell, GivenTable};
use cdpr_sensitivity::{
    Analyser, Analysis, GivenData, Limit, SensitivityError, WassersteinBures, wasserstein_bures,
};
use indexmap::IndexMap;
use serde::Serialize;
use std::collections::HashSet;

/// What is asked of a table.
#[derive(Clone, Debug)]
pub struct TableRequest {
    /// Columns of inputs, `NAME*` for all that begin so; if empty, those `d_..` of a study, else all others.
    pub inputs: Vec<String>,
    /// Columns of outputs; if empty, those with a limit, else the last column of numbers.
    pub outputs: Vec<String>,
    /// Limits of outputs by their columns.
    pub limits: Vec<(String, Limit)>,
    /// Columns that are the components of one vector, in a common unit; none for no vector.
    pub vector: Vec<String>,
    /// Level, seed and rows of the estimators.
    pub analyser: Analyser,
}

/// What a table says.
#[derive(Clone, Debug, Serialize)]
pub struct TableAnalysis {
    /// The file.
    pub table: String,
    /// Number of rows.
    pub rows: usize,
    /// Number of rows that are left out because an input has no value.
    pub left_out: usize,
    /// Number of cells without a number in the columns that are analysed.
    pub bad_cells: usize,
    /// The first of these, by row.
    pub first_bad_cells: Vec<BadCell>,
    /// Names of the inputs.
    pub inputs: Vec<String>,
    /// Columns that are neither input nor output.
    pub unused: Vec<String>,
    /// What may not be meant: columns that were taken for inputs and look like outputs.
    pub questions: Vec<String>,
    /// What each output says.
    pub outputs: IndexMap<String, Analysis>,
    /// What the vector says.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub vector: Option<VectorAnalysis>,
}

impl TableAnalysis {
    /// Whether there is something to look at before the numbers are used.
    pub fn has_questions(&self) -> bool {
        !self.questions.is_empty() || self.outputs.values().any(|analysis| analysis.verdict.has_questions())
    }
}

/// How much each input moves the law of a vector.
#[derive(Clone, Debug, Serialize)]
pub struct VectorAnalysis {
    /// Its columns.
    pub columns: Vec<String>,
    /// Index of Wasserstein and Bures by input; inputs of words have none.
    pub bures: IndexMap<String, WassersteinBures>,
}

/// Number of bad cells that are named.
const NAMED: usize = 10;

/// Columns that are analysed, by their numbers.
struct Chosen {
    inputs: Vec<usize>,
    outputs: Vec<usize>,
    /// Of the vector.
    components: Vec<usize>,
    questions: Vec<String>,
}

impl Chosen {
    fn of(table: &GivenTable, request: &TableRequest) -> Result<Self, StudyError> {
        let limited: Vec<String> = request.limits.iter().map(|(name, _)| name.clone()).collect();
        let mut outputs = table.named("output", &request.outputs)?;
        for column in table.named("limit", &limited)? {
            if !outputs.contains(&column) {
                outputs.push(column);
            }
        }
        // A column that nobody names and that cannot be read may be the output, or an input.
        let guessed = outputs.is_empty();
        table.readable(|_| guessed || request.inputs.is_empty())?;
        if guessed {
            outputs.extend(table.usual_output());
        }
        let components = table.named("vector", &request.vector)?;
        let depends = |column: &usize| outputs.contains(column) || components.contains(column);
        let inputs = match request.inputs.is_empty() {
            true => table.usual_inputs(&[&outputs[..], &components].concat()),
            false => table.named("input", &request.inputs)?,
        };
        let name = |&column: &usize| table.columns[column].name.as_str();
        if let Some(both) = inputs.iter().find(|column| depends(column)) {
            return Err(table.invalid("input", name(both), "a column that is no output"));
        }
        let source = Analyser::check_inputs(inputs.len().max(1));
        source.map_err(|source| table.statistics(outputs.first().map_or("inputs", name), source))?;
        let Some(&output) = outputs.first().filter(|_| !inputs.is_empty()) else {
            return Err(table.invalid("columns of numbers", &table.columns.len().to_string(), "2 or more"));
        };
        let like = if request.inputs.is_empty() { table.like_outputs(&inputs, output) } else { vec![] };
        let mut questions = vec![];
        if !like.is_empty() {
            let one = like.len() == 1;
            questions.push(format!(
                "{} {} and {} of {}: name the outputs, or the inputs",
                like.join(", "),
                if one { "looks like an output" } else { "look like outputs" },
                if one { "is taken for an input" } else { "are taken for inputs" },
                name(&output)
            ));
        }
        let of_words = |(name, has): &(String, String)| {
            format!(
                "column {name} is taken for words and not analysed: {has}; expected numbers, or words, alone"
            )
        };
        let is_used = |name: &String| inputs.iter().any(|&of| table.columns[of].name == *name);
        let unused = table.mixed.iter().filter(|(name, _)| !is_used(name) && request.inputs.is_empty());
        questions.extend(unused.map(of_words));
        Ok(Self { inputs, outputs, components, questions })
    }
}

/// Analyses a table.
///
/// Rows in which an input has no finite number, and no word, are left out. A row in which an output is not a
/// finite number counts as a failed observation of this output.
///
/// # Errors
/// [`StudyError::Invalid`] for a name that no column has, an output of words, an input that is an output, no
/// input or no output; [`StudyError::Statistics`] with the column for outputs that are constant or too few,
/// and with those of a vector that has no index, such as one at rows of a sequence.
pub fn analyse_table(table: &GivenTable, request: &TableRequest) -> Result<TableAnalysis, StudyError> {
    let chosen = Chosen::of(table, request)?;
    let Chosen { inputs, outputs, components, .. } = &chosen;
    let name = |&column: &usize| table.columns[column].name.clone();
    let values = |column: usize| &table.columns[column].values;
    let complete: Vec<usize> =
        (0..table.rows).filter(|&row| inputs.iter().all(|&column| !values(column)[row].is_nan())).collect();
    let columns: Vec<Vec<f64>> =
        inputs.iter().map(|&column| complete.iter().map(|&row| values(column)[row]).collect()).collect();
    let names: Vec<String> = inputs.iter().map(name).collect();
    let of_output = |&output: &usize| {
        let column = name(&output);
        let statistics = |source: SensitivityError| table.statistics(&column, source);
        let found = complete.iter().map(|&row| Some(values(output)[row]).filter(|value| !value.is_nan()));
        let mut data = GivenData::new(names.clone(), columns.clone(), found.collect()).map_err(statistics)?;
        for (place, &input) in inputs.iter().enumerate().filter(|(_, of)| table.columns[**of].is_words()) {
            data = data.with_levels(place, table.columns[input].labels.clone()).map_err(statistics)?;
        }
        let limit = request.limits.iter().find(|(name, _)| *name == column).map(|(_, limit)| *limit);
        let analyser = Analyser { limit, outputs: outputs.len(), ..request.analyser };
        let analysis = analyser.analyse(&data).map_err(statistics)?;
        Ok((column.clone(), analysis))
    };
    let chosen_names: HashSet<&str> =
        inputs.iter().chain(outputs).chain(components).map(|&of| table.columns[of].name.as_str()).collect();
    let used = |column: &String| chosen_names.contains(column.as_str());
    let bad: Vec<&BadCell> = table.bad.iter().filter(|cell| used(&cell.column)).collect();
    let all = table.columns.iter().map(|column| &column.name).chain(&table.empty);
    Ok(TableAnalysis {
        table: table.path.to_string_lossy().into_owned(),
        rows: table.rows,
        left_out: table.rows - complete.len(),
        bad_cells: bad.len(),
        first_bad_cells: bad.into_iter().take(NAMED).cloned().collect(),
        unused: all.filter(|name| !used(name)).cloned().collect(),
        outputs: outputs.iter().map(of_output).collect::<Result<_, StudyError>>()?,
        vector: of_vector(table, &chosen, (&columns, &complete), request.analyser)?,
        inputs: names,
        questions: chosen.questions,
    })
}

/// How much each input of numbers moves the law of the vector, if there is one.
fn of_vector(
    table: &GivenTable,
    chosen: &Chosen,
    (columns, rows): (&[Vec<f64>], &[usize]),
    Analyser { level, seed, .. }: Analyser,
) -> Result<Option<VectorAnalysis>, StudyError> {
    if chosen.components.is_empty() {
        return Ok(None);
    }
    let names: Vec<String> = chosen.components.iter().map(|&of| table.columns[of].name.clone()).collect();
    let of_row = |&row: &usize| -> Option<Vec<f64>> {
        let value = |&of: &usize| Some(table.columns[of].values[row]).filter(|value| !value.is_nan());
        chosen.components.iter().map(value).collect()
    };
    let vectors: Vec<_> = rows.iter().map(of_row).collect();
    let numbers = || chosen.inputs.iter().zip(columns).filter(|(of, _)| !table.columns[**of].is_words());
    let columns: Vec<Vec<f64>> = numbers().map(|(_, values)| values.clone()).collect();
    let found = wasserstein_bures(&columns, &vectors, level, seed);
    let found = found.map_err(|source| table.statistics(&names.join(", "), source))?;
    let bures = numbers().map(|(&of, _)| table.columns[of].name.clone()).zip(found).collect();
    Ok(Some(VectorAnalysis { columns: names, bures }))
}
