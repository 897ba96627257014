//! Load-elongation records as files: tables with a force, an elongation and a phase (`loading` or
//! `unloading`), such as `force_n`, `elongation_mm`, `phase`. Further columns are of no importance.

use crate::error::StudyError;
use crate::fs::input::{check_table, read_bytes};
use crate::kind::InputKind;
use crate::table::{Column, Dimension, Table, TableError};
use cdpr_cable::{Phase, Record, RecordError, Sample};
use std::path::Path;

/// What is wrong with the text of a record.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum RecordTextError {
    /// It is no table, or a cell is no number.
    #[error(transparent)]
    Table(#[from] TableError),
    /// Its columns or samples make no record.
    #[error(transparent)]
    Record(#[from] RecordError),
}

/// Reads and checks a record.
///
/// # Errors
/// [`StudyError::Read`]; [`StudyError::OtherKind`] for a file of another kind; [`StudyError::Table`] and
/// [`StudyError::Record`] name the line.
pub fn open_record(path: &Path) -> Result<Record, StudyError> {
    let bytes = read_bytes(path, InputKind::Record)?;
    check_table(path, &bytes, InputKind::Record)?;
    let path = || path.to_owned();
    read_record(&bytes).map_err(|error| match error {
        RecordTextError::Table(source) => StudyError::Table { path: path(), source },
        RecordTextError::Record(source) => StudyError::Record { path: path(), source },
    })
}

/// Reads and checks a record from the content of a file.
///
/// # Errors
/// [`RecordTextError`] naming the line.
pub fn read_record(bytes: &[u8]) -> Result<Record, RecordTextError> {
    let table = Table::read(bytes)?;
    let (force, to_newtons) = numbers(&table, "force_n", Dimension::Force)?;
    let (elongation, to_metres) = numbers(&table, "elongation_mm", Dimension::Length)?;
    let phases = column(&table, "phase")?;
    let samples = (0..table.rows()).map(|row| {
        let phase = match phases.text(row).as_str() {
            "loading" => Phase::Loading,
            "unloading" => Phase::Unloading,
            _ => return Err(table.cell_error(row, phases, "loading or unloading").into()),
        };
        Ok(Sample {
            line: table.lines[row],
            force: force[row] * to_newtons,
            elongation: elongation[row] * to_metres,
            phase,
        })
    });
    Ok(Record::new(&samples.collect::<Result<Vec<_>, RecordTextError>>()?)?)
}

/// The finite numbers of the column that is called so, or has another unit, and the factor to SI units.
fn numbers<'a>(
    table: &'a Table,
    name: &'static str,
    dimension: Dimension,
) -> Result<(&'a [f64], f64), RecordTextError> {
    let found = column(table, name)?;
    let (_, unit) = found.quantity();
    let factor = unit.filter(|unit| unit.dimension == dimension).map(|unit| unit.factor);
    Ok((table.finite(found)?, factor.ok_or_else(|| missing(table, name))?))
}

/// The column of a quantity, which another unit may follow than in this name.
fn column<'a>(table: &'a Table, name: &'static str) -> Result<&'a Column, RecordTextError> {
    let quantity = name.split('_').next().unwrap_or(name);
    let found = table.columns.iter().find(|column| column.quantity().0 == quantity);
    found.ok_or_else(|| missing(table, name))
}

fn missing(table: &Table, name: &'static str) -> RecordTextError {
    let names: Vec<&str> = table.columns.iter().map(|column| column.name.as_str()).collect();
    let value = if names.is_empty() { "missing".to_owned() } else { names.join(",") };
    let expected = format!("a column `{name}`");
    RecordError::Invalid { line: table.header.unwrap_or(1), field: "header", value, expected }.into()
}

#[cfg(test)]
mod tests {
    use super::*;

    const GOOD: &str = "# a comment\nphase,force_n,elongation_mm\nloading,100,0\n\
        loading, 1000, 2\nunloading,100,0.5\nunloading,50,0.2\n";

    #[test]
    fn columns_may_stand_in_any_order_among_comments() {
        let record = read_record(GOOD.as_bytes()).unwrap();
        assert_eq!(record.samples(Phase::Loading).len(), 2);
        assert_eq!(
            record.samples(Phase::Unloading)[2],
            Sample { line: 6, force: 50.0, elongation: 2e-4, phase: Phase::Unloading }
        );
    }

    #[test]
    fn a_record_may_have_semicolons_and_decimal_commas() {
        let record =
            read_record(GOOD.replace(',', ";").replace("0.5", "0,5").replace("0.2", "0,2").as_bytes())
                .unwrap();
        let plain = read_record(GOOD.as_bytes()).unwrap();
        assert_eq!(record.samples(Phase::Unloading), plain.samples(Phase::Unloading));
        assert_eq!(record.samples(Phase::Loading), plain.samples(Phase::Loading));
    }

    #[test]
    fn the_unit_is_that_of_the_name_and_further_columns_are_of_no_importance() {
        let plain = read_record(GOOD.as_bytes()).unwrap();
        let other = "Force [kN];elongation_m;t_s;phase\r\n0,1;0;0;loading\r\n1;0,002;1;loading\r\n\
            0,1;0,0005;2;unloading\r\n0,05;0,0002;3;unloading\r\n";
        let wide: Vec<u8> =
            [0xff, 0xfe].into_iter().chain(other.encode_utf16().flat_map(u16::to_le_bytes)).collect();
        for text in [other.as_bytes(), &wide] {
            let record = read_record(text).unwrap();
            for phase in [Phase::Loading, Phase::Unloading] {
                for (one, other) in record.samples(phase).iter().zip(plain.samples(phase)) {
                    assert!((one.force - other.force).abs() < 1e-9, "{one:?}");
                    assert!((one.elongation - other.elongation).abs() < 1e-15, "{one:?}");
                }
            }
        }
    }

    #[test]
    fn what_is_wrong_with_a_record_is_named_with_its_line() {
        for (good, bad, words) in [
            (
                "force_n",
                "force_kg",
                "line 2: header is phase,force_kg,elongation_mm: expected a column `force_n`",
            ),
            ("unloading,100,0.5", "unloading,100", "line 5: 2 cells: expected 3, as many as in line 2"),
            (
                "loading, 1000, 2",
                "loading, 1000, 2 mm",
                "line 4, column elongation_mm: `2 mm`: expected 2, and the unit in the name",
            ),
            ("loading, 1000, 2", ", 1000, 2", "line 4, column phase: ``: expected loading or unloading"),
            (
                "loading, 1000, 2",
                "loading, NaN, 2",
                "line 4, column force_n: `NaN`: expected a finite number",
            ),
            ("loading, 1000, 2", "loading, 50, 2", "line 4: force_n is 50: expected more than 100 of line 3"),
        ] {
            let message = read_record(GOOD.replace(good, bad).as_bytes()).unwrap_err().to_string();
            assert!(message.starts_with(words), "{message}");
        }
        for (text, words) in [
            ("", "line 1: header is missing: expected a column `force_n`"),
            (
                "force_n,elongation_mm,phase\n1,1,loading\n2,2,loading\n",
                "the record ends at line 3 with 0 samples of phase unloading",
            ),
        ] {
            let message = read_record(text.as_bytes()).unwrap_err().to_string();
            assert!(message.starts_with(words), "{message}");
        }
    }
}
