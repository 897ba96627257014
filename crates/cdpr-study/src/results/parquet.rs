//! Tables of observations as Parquet: the columns of the CSV with types, units and provenance in the file's
//! metadata.

use crate::error::StudyError;
use crate::fs::owned::ResultsFolder;
use crate::fs::owned::write::ResultFile;
use crate::model::observed::{Observed, status};
use crate::model::study::Sampling;
use crate::observe::observation::Part;
use cdpr_sensitivity::SampleDesign;
use parquet::basic::{ConvertedType, Repetition, Type as PhysicalType};
use parquet::data_type::{ByteArray, ByteArrayType, DataType, DoubleType, Int64Type};
use parquet::errors::{ParquetError, Result};
use parquet::file::metadata::KeyValue;
use parquet::file::properties::WriterProperties;
use parquet::file::writer::{SerializedFileWriter, SerializedRowGroupWriter};
use parquet::schema::types::{Type, TypePtr};
use std::path::PathBuf;
use std::sync::Arc;

/// Rows of a row group, which is held in memory: those of four blocks.
const GROUP: usize = 1 << 16;

/// `NAME.parquet`, being written.
pub(crate) struct ParquetTable {
    path: PathBuf,
    writer: SerializedFileWriter<ResultFile>,
    inputs: usize,
    /// Rows of the next group.
    parts: Vec<Part>,
}

impl ParquetTable {
    pub(crate) fn new(folder: &ResultsFolder, sampling: &Sampling) -> std::result::Result<Self, StudyError> {
        let name = format!("{}.parquet", sampling.name);
        let path = folder.path().join(&name);
        let hash = sampling.study.hash()?;
        let file = folder.create(&name)?;
        let begin = || {
            let properties =
                WriterProperties::builder().set_key_value_metadata(Some(provenance(sampling, hash))).build();
            SerializedFileWriter::new(file, schema(sampling)?, Arc::new(properties))
        };
        match begin() {
            Ok(writer) => {
                Ok(Self { path, writer, inputs: sampling.design.inputs().len(), parts: Vec::new() })
            }
            Err(error) => Err(unwritten(path, error)),
        }
    }

    pub(crate) fn write(&mut self, part: Part) -> std::result::Result<(), StudyError> {
        self.parts.push(part);
        if self.parts.iter().map(|part| part.outcomes.len()).sum::<usize>() < GROUP {
            return Ok(());
        }
        self.write_group()
    }

    pub(crate) fn finish(mut self) -> std::result::Result<(), StudyError> {
        if !self.parts.is_empty() {
            self.write_group()?;
        }
        match self.writer.into_inner() {
            Ok(file) => file.finish().map(|_| ()),
            Err(error) => Err(unwritten(self.path, error)),
        }
    }

    fn write_group(&mut self) -> std::result::Result<(), StudyError> {
        let parts = std::mem::take(&mut self.parts);
        let mut write = || {
            let mut group = self.writer.next_row_group()?;
            write_columns(&mut group, &parts, self.inputs)?;
            group.close()
        };
        write().map(|_| ()).map_err(|error| unwritten(self.path.clone(), error))
    }
}

fn unwritten(path: PathBuf, error: ParquetError) -> StudyError {
    StudyError::Write { path, source: std::io::Error::other(error) }
}

/// The columns of the CSV.
fn schema(sampling: &Sampling) -> Result<TypePtr> {
    let column = |name: &str, kind, repetition, converted| {
        let column = Type::primitive_type_builder(name, kind).with_repetition(repetition);
        column.with_converted_type(converted).build().map(Arc::new)
    };
    let number = |name: &str, repetition| column(name, PhysicalType::DOUBLE, repetition, ConvertedType::NONE);
    let text = |name, repetition| column(name, PhysicalType::BYTE_ARRAY, repetition, ConvertedType::UTF8);
    let mut columns = vec![column("index", PhysicalType::INT64, Repetition::REQUIRED, ConvertedType::NONE)?];
    for input in sampling.design.inputs() {
        columns.push(number(&format!("d_{}", input.name), Repetition::REQUIRED)?);
    }
    for name in sampling.output().columns() {
        columns.push(number(name, Repetition::OPTIONAL)?);
    }
    columns.push(text("status", Repetition::REQUIRED)?);
    columns.push(text("reason", Repetition::OPTIONAL)?);
    Type::group_type_builder("observations").with_fields(columns).build().map(Arc::new)
}

/// The study of the table, and the unit of each column that has one.
fn provenance(sampling: &Sampling, hash: String) -> Vec<KeyValue> {
    let output = sampling.output();
    let inputs = sampling.design.inputs().iter().enumerate();
    let inputs = inputs
        .filter_map(|(number, input)| Some((format!("d_{}", input.name), sampling.errors.unit(number)?)));
    let units = inputs
        .chain(output.columns().iter().map(|name| ((*name).to_owned(), output.unit())))
        .map(|(column, unit)| (column, unit.into()));
    let units: serde_json::Map<String, serde_json::Value> = units.collect();
    let seed = sampling.study.file.seed.to_string();
    [
        ("robot", sampling.robot.name.clone()),
        ("study", sampling.study.file.name.clone()),
        ("sampling", sampling.name.clone()),
        ("seed", seed),
        ("version", env!("CARGO_PKG_VERSION").to_owned()),
        ("hash", hash),
        ("units", serde_json::Value::Object(units).to_string()),
    ]
    .map(|(key, value)| KeyValue::new(key.to_owned(), value))
    .into()
}

/// Column by column, as Parquet stores them.
fn write_columns(
    group: &mut SerializedRowGroupWriter<'_, ResultFile>,
    parts: &[Part],
    inputs: usize,
) -> Result<()> {
    let outcomes = || parts.iter().flat_map(|part| &part.outcomes);
    let indices: Vec<i64> = parts
        .iter()
        .flat_map(|part| part.first..part.first + part.outcomes.len())
        .map(|index| index as i64)
        .collect();
    write_column::<Int64Type>(group, &indices, None)?;
    for input in 0..inputs {
        let values: Vec<f64> =
            parts.iter().flat_map(|part| part.rows.chunks_exact(inputs).map(|row| row[input])).collect();
        write_column::<DoubleType>(group, &values, None)?;
    }
    // A level of 0 is an absent value: that of an observation that failed.
    let levels: Vec<i16> = outcomes().map(|outcome| outcome.is_ok().into()).collect();
    for column in 0..parts.first().map_or(0, |part| part.output.columns().len()) {
        let cell = |outcome: &Observed| outcome.as_ref().ok()?.cells().nth(column);
        let values: Vec<f64> = outcomes().filter_map(cell).collect();
        write_column::<DoubleType>(group, &values, Some(&levels))?;
    }
    let kinds: Vec<ByteArray> = outcomes().map(|outcome| status(outcome).0.into()).collect();
    write_column::<ByteArrayType>(group, &kinds, None)?;
    let levels: Vec<i16> = outcomes().map(|outcome| outcome.is_err().into()).collect();
    let reasons = outcomes().filter(|outcome| outcome.is_err());
    let reasons: Vec<ByteArray> = reasons.map(|outcome| status(outcome).1.into()).collect();
    write_column::<ByteArrayType>(group, &reasons, Some(&levels))
}

/// The next column: its values that are there, and for each row whether it has one, unless all have.
fn write_column<T: DataType>(
    group: &mut SerializedRowGroupWriter<'_, ResultFile>,
    values: &[T::T],
    levels: Option<&[i16]>,
) -> Result<()> {
    let missing = || ParquetError::General("more columns than the schema has".to_owned());
    let mut column = group.next_column()?.ok_or_else(missing)?;
    column.typed::<T>().write_batch(values, levels, None)?;
    column.close()
}
