//! The analysis of a table: which columns are inputs and outputs, which rows count, what each output says.

use crate::error::StudyError;
use crate::given::columns::{BadCell, GivenTable};
use cdpr_sensitivity::{
    Analyser, Analysis, GivenData, Limit, SensitivityError, WassersteinBures, wasserstein_bures,
};
use indexmap::IndexMap;
use serde::Serialize;

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
    /// Number of rows that are left out because an input has no number.
    pub left_out: usize,
    /// Number of cells without a number in the columns that are analysed.
    pub bad_cells: usize,
    /// The first of these, by row.
    pub first_bad_cells: Vec<BadCell>,
    /// Names of the inputs.
    pub inputs: Vec<String>,
    /// Columns that are neither input nor output.
    pub unused: Vec<String>,
    /// What each output says.
    pub outputs: IndexMap<String, Analysis>,
    /// What the vector says.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub vector: Option<VectorAnalysis>,
}

/// How much each input moves the law of a vector.
#[derive(Clone, Debug, Serialize)]
pub struct VectorAnalysis {
    /// Its columns.
    pub columns: Vec<String>,
    /// Index of Wasserstein and Bures by input.
    pub bures: IndexMap<String, WassersteinBures>,
}

/// Number of bad cells that are named.
const NAMED: usize = 10;

/// Analyses a table.
///
/// Rows in which an input is not a finite number are left out. A row in which an output is not a finite
/// number counts as a failed observation of this output.
///
/// # Errors
/// [`StudyError::Invalid`] for a name that no column of numbers has, an input that is an output, no input or
/// no output; [`StudyError::Statistics`] with the column for outputs that are constant or too few, and with
/// those of a vector that has no index, such as one at rows of a sequence.
pub fn analyse_table(table: &GivenTable, request: &TableRequest) -> Result<TableAnalysis, StudyError> {
    let limited: Vec<String> = request.limits.iter().map(|(name, _)| name.clone()).collect();
    let mut outputs = table.named("output", &request.outputs)?;
    for column in table.named("limit", &limited)? {
        if !outputs.contains(&column) {
            outputs.push(column);
        }
    }
    if outputs.is_empty() {
        outputs.extend(table.usual_output());
    }
    let components = table.named("vector", &request.vector)?;
    let depends = |column: &usize| outputs.contains(column) || components.contains(column);
    let inputs = match request.inputs.is_empty() {
        true => table.usual_inputs(&[&outputs[..], &components].concat()),
        false => table.named("input", &request.inputs)?,
    };
    let name = |&column: &usize| table.columns[column].0.clone();
    if let Some(both) = inputs.iter().find(|column| depends(column)) {
        return Err(table.invalid("input", &name(both), "a column that is no output"));
    }
    if inputs.is_empty() || outputs.is_empty() {
        return Err(table.invalid("columns of numbers", &table.columns.len().to_string(), "2 or more"));
    }
    let values = |column: usize| &table.columns[column].1;
    let complete: Vec<usize> =
        (0..table.rows).filter(|&row| inputs.iter().all(|&column| !values(column)[row].is_nan())).collect();
    let columns: Vec<Vec<f64>> =
        inputs.iter().map(|&column| complete.iter().map(|&row| values(column)[row]).collect()).collect();
    let names: Vec<String> = inputs.iter().map(name).collect();
    let of_output = |&output: &usize| {
        let column = name(&output);
        let statistics = |source: SensitivityError| StudyError::Statistics {
            path: table.path.clone(),
            field: column.clone(),
            source,
        };
        let found = complete.iter().map(|&row| Some(values(output)[row]).filter(|value| !value.is_nan()));
        let data = GivenData::new(names.clone(), columns.clone(), found.collect()).map_err(statistics)?;
        let limit = request.limits.iter().find(|(name, _)| *name == column).map(|(_, limit)| *limit);
        let analysis = Analyser { limit, ..request.analyser }.analyse(&data).map_err(statistics)?;
        Ok((column.clone(), analysis))
    };
    let vector = (!components.is_empty()).then(|| {
        let names_of_vector: Vec<String> = components.iter().map(name).collect();
        let of_row = |&row: &usize| -> Option<Vec<f64>> {
            components
                .iter()
                .map(|&column| Some(values(column)[row]).filter(|value| !value.is_nan()))
                .collect()
        };
        let vectors: Vec<_> = complete.iter().map(of_row).collect();
        let Analyser { level, seed, .. } = request.analyser;
        let found = wasserstein_bures(&columns, &vectors, level, seed).map_err(|source| {
            StudyError::Statistics { path: table.path.clone(), field: names_of_vector.join(", "), source }
        })?;
        let bures = names.iter().cloned().zip(found).collect();
        Ok::<_, StudyError>(VectorAnalysis { columns: names_of_vector, bures })
    });
    let used =
        |column: &String| inputs.iter().chain(&outputs).chain(&components).any(|used| name(used) == *column);
    let bad: Vec<&BadCell> = table.bad.iter().filter(|cell| used(&cell.column)).collect();
    Ok(TableAnalysis {
        table: table.path.to_string_lossy().into_owned(),
        rows: table.rows,
        left_out: table.rows - complete.len(),
        bad_cells: bad.len(),
        first_bad_cells: bad.into_iter().take(NAMED).cloned().collect(),
        unused: table
            .columns
            .iter()
            .map(|(name, _)| name)
            .chain(&table.texts)
            .filter(|name| !used(name))
            .cloned()
            .collect(),
        outputs: outputs.iter().map(of_output).collect::<Result<_, StudyError>>()?,
        vector: vector.transpose()?,
        inputs: names,
    })
}
