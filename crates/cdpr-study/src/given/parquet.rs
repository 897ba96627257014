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

#[cfg(test)]
mod tests {
    use super::read;
    use crate::given::columns::GivenTable;
    use parquet::data_type::{ByteArray, ByteArrayType, DoubleType};
    use parquet::file::properties::WriterProperties;
    use parquet::file::writer::SerializedFileWriter;
    use parquet::schema::parser::parse_message_type;
    use std::sync::Arc;

    #[test]
    fn nan_and_absent_values_of_parquet_are_cells_without_a_number() {
        let file = tempfile::NamedTempFile::new().unwrap();
        let schema = "message t { required double x; optional double y; optional binary s (UTF8); }";
        let schema = Arc::new(parse_message_type(schema).unwrap());
        let properties = Arc::new(WriterProperties::builder().build());
        let mut writer = SerializedFileWriter::new(file.reopen().unwrap(), schema, properties).unwrap();
        let mut group = writer.next_row_group().unwrap();
        let mut column = group.next_column().unwrap().unwrap();
        column.typed::<DoubleType>().write_batch(&[1.0, f64::NAN, 3.0], None, None).unwrap();
        column.close().unwrap();
        let mut column = group.next_column().unwrap().unwrap();
        column.typed::<DoubleType>().write_batch(&[4.0, f64::INFINITY], Some(&[1, 1, 0]), None).unwrap();
        column.close().unwrap();
        let mut column = group.next_column().unwrap().unwrap();
        column
            .typed::<ByteArrayType>()
            .write_batch(&[ByteArray::from("ok")], Some(&[1, 0, 0]), None)
            .unwrap();
        column.close().unwrap();
        group.close().unwrap();
        writer.close().unwrap();
        let found = GivenTable::of(file.path(), read(file.path()).unwrap());
        assert_eq!(found.rows, 3);
        let names: Vec<(&str, bool)> =
            found.columns.iter().map(|column| (column.name.as_str(), column.is_words())).collect();
        assert_eq!(names, [("x", false), ("y", false), ("s", true)]);
        assert!(
            found.columns[0].values[1].is_nan() && found.columns[1].values[1..].iter().all(|y| y.is_nan())
        );
        let bad: Vec<_> = found.bad.iter().map(|cell| (cell.row, cell.column.as_str())).collect();
        assert_eq!(bad, [(2, "x"), (2, "y"), (3, "y")]);
    }
}
