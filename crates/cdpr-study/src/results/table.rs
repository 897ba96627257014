//! Tables of the observations of a sampling. Each observation is a row with the deviation of every parameter
//! from its nominal value, the columns of the output, status and reason.

use crate::error::StudyError;
use crate::fs::owned::ResultsFolder;
use crate::fs::owned::write::ResultFile;
use crate::model::observed::status;
use crate::model::study::Sampling;
use crate::observe::observation::Part;
use cdpr_sensitivity::SampleDesign;
use std::io::Write;

/// Format of a table.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum TableFormat {
    /// `NAME.csv`, for people and all programs.
    Csv,
    /// `NAME.parquet`, for large studies: typed columns, units and provenance inside.
    #[cfg(feature = "parquet")]
    Parquet,
    /// No table.
    None,
}

/// Rows of a table, ready to be written.
pub struct Rows(Content);

enum Content {
    Csv(std::io::Result<Vec<u8>>),
    #[cfg(feature = "parquet")]
    Parquet(Part),
    None,
}

/// A table being written. It takes its name when it is finished.
pub struct ObservationTable(Table);

enum Table {
    Csv(Box<ResultFile>),
    #[cfg(feature = "parquet")]
    Parquet(Box<crate::results::parquet::ParquetTable>),
    None,
}

impl TableFormat {
    /// Ending of the table's name, if there is a table.
    pub(crate) fn ending(self) -> Option<&'static str> {
        match self {
            Self::Csv => Some("csv"),
            #[cfg(feature = "parquet")]
            Self::Parquet => Some("parquet"),
            Self::None => None,
        }
    }

    /// Rows of a part. They are formatted in parallel, because this takes longer than the mechanics.
    pub fn rows(self, part: &Part) -> Rows {
        Rows(match self {
            Self::Csv => Content::Csv(csv_rows(part)),
            #[cfg(feature = "parquet")]
            Self::Parquet => Content::Parquet(part.clone()),
            Self::None => Content::None,
        })
    }
}

impl ObservationTable {
    /// Begins the table of a sampling, and removes one of an earlier run: `d_mass`, ... in SI units, the
    /// columns of the output, `status` and `reason`.
    ///
    /// # Errors
    /// [`StudyError::Write`].
    pub fn new(folder: &ResultsFolder, sampling: &Sampling, format: TableFormat) -> Result<Self, StudyError> {
        for ending in ["csv", "parquet"] {
            folder.remove(&format!("{}.{ending}", sampling.name))?;
        }
        let names = sampling.design.inputs().iter().map(|input| format!("d_{}", input.name));
        match format {
            TableFormat::Csv => {
                let rest = sampling.output().columns().iter().chain(&["status", "reason"]);
                let rest = rest.map(|name| (*name).to_owned());
                let header: Vec<String> = ["index".to_owned()].into_iter().chain(names).chain(rest).collect();
                let mut file = folder.create(&format!("{}.csv", sampling.name))?;
                match file.write_all((header.join(",") + "\n").as_bytes()) {
                    Ok(()) => Ok(Self(Table::Csv(Box::new(file)))),
                    Err(source) => Err(file.unwritten(source)),
                }
            }
            #[cfg(feature = "parquet")]
            TableFormat::Parquet => crate::results::parquet::ParquetTable::new(folder, sampling)
                .map(|table| Self(Table::Parquet(Box::new(table)))),
            TableFormat::None => Ok(Self(Table::None)),
        }
    }

    /// Adds rows of the same format.
    ///
    /// # Errors
    /// [`StudyError::Write`].
    pub fn write(&mut self, rows: Rows) -> Result<(), StudyError> {
        match (&mut self.0, rows.0) {
            (Table::Csv(file), Content::Csv(text)) => {
                let written = text.and_then(|text| file.write_all(&text));
                written.map_err(|source| file.unwritten(source))
            }
            (Table::None, Content::None) => Ok(()),
            #[cfg(feature = "parquet")]
            (Table::Parquet(table), Content::Parquet(part)) => table.write(part),
            (_, _) => {
                debug_assert!(false, "rows of another format");
                Ok(())
            }
        }
    }

    /// Ends the table.
    ///
    /// # Errors
    /// [`StudyError::Write`].
    pub fn finish(self) -> Result<(), StudyError> {
        match self.0 {
            Table::Csv(file) => file.finish().map(|_| ()),
            #[cfg(feature = "parquet")]
            Table::Parquet(table) => table.finish(),
            Table::None => Ok(()),
        }
    }
}

/// Lines of text. Numbers need no quotes; reasons of failures may need them.
fn csv_rows(part: &Part) -> std::io::Result<Vec<u8>> {
    let mut text = Vec::new();
    let inputs = (part.rows.len() / part.outcomes.len().max(1)).max(1);
    for (index, (row, outcome)) in (part.first..).zip(part.rows.chunks_exact(inputs).zip(&part.outcomes)) {
        write!(text, "{index}")?;
        row.iter().try_for_each(|value| write!(text, ",{value}"))?;
        match outcome {
            Ok(measured) => measured.cells().try_for_each(|value| write!(text, ",{value}"))?,
            Err(_) => text.extend(part.output.columns().iter().map(|_| b',')),
        }
        text.push(b',');
        match outcome {
            Ok(_) => text.extend_from_slice(b"ok,\n"),
            Err(_) => {
                let (status, reason) = status(outcome);
                let mut words = csv::Writer::from_writer(&mut text);
                words.write_record([status, reason])?;
                words.flush()?;
            }
        }
    }
    Ok(text)
}
