//! Tables as Parquet.

use crate::error::StudyError;
use crate::fs::input::open;
use crate::kind::InputKind;
use crate::table::{Column, Table};
use parquet::file::reader::{FileReader, SerializedFileReader};
use parquet::record::Field;
use std::io::{Error, ErrorKind};
use std::path::Path;

/// The table of a file.
pub(super) fn read(path: &Path) -> Result<Table, StudyError> {
    let unread = |error: parquet::errors::ParquetError| StudyError::Read {
        path: path.to_owned(),
        source: Error::new(ErrorKind::InvalidData, error),
    };
    let reader = SerializedFileReader::new(open(path, InputKind::Table)?).map_err(unread)?;
    let mut columns: Vec<(String, Vec<f64>, Vec<String>)> = Vec::new();
    let mut rows = 0;
    for row in reader.get_row_iter(None).map_err(unread)? {
        let row = row.map_err(unread)?;
        for (number, (name, field)) in row.get_column_iter().enumerate() {
            if rows == 0 {
                columns.push((name.clone(), vec![], vec![]));
            }
            let (_, values, texts) = &mut columns[number];
            let value = number_of(field).filter(|value| value.is_finite());
            values.push(value.unwrap_or(f64::NAN));
            if value.is_none() {
                texts.push(if *field == Field::Null { String::new() } else { field.to_string() });
            }
        }
        rows += 1;
    }
    let column = |(name, values, texts): (String, Vec<f64>, Vec<String>)| {
        if texts.len() == rows && texts.iter().any(|text| !text.is_empty()) {
            return Column::of_texts(name, texts);
        }
        // Texts are kept for cells without a number only.
        let places: Vec<usize> = (0..rows).filter(|&row| values[row].is_nan()).collect();
        let text = |row: usize| {
            places.binary_search(&row).ok().and_then(|k| texts.get(k).cloned()).unwrap_or_default()
        };
        Column::of_numbers(name, values, text)
    };
    let columns = columns.into_iter().map(column).collect();
    Ok(Table { columns, lines: (1..=rows).collect(), header: None })
}

fn number_of(field: &Field) -> Option<f64> {
    Some(match *field {
        Field::Bool(value) => f64::from(u8::from(value)),
        Field::Byte(value) => value.into(),
        Field::Short(value) => value.into(),
        Field::Int(value) => value.into(),
        Field::Long(value) => value as f64,
        Field::UByte(value) => value.into(),
        Field::UShort(value) => value.into(),
        Field::UInt(value) => value.into(),
        Field::ULong(value) => value as f64,
        Field::Float(value) => value.into(),
        Field::Double(value) => value,
        _ => return None,
    })
}
