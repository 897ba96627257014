//! Load-elongation records as files: CSV with the columns `force_n`, `elongation_mm` and `phase` (`loading`
//! or `unloading`), or with semicolons or tabs between the cells and decimal commas. Lines that begin with `#`
//! are comments.

use crate::error::StudyError;
use crate::fs::input::{other_kind, read_text};
use crate::kind::InputKind;
use cdpr_cable::{Phase, Record, RecordError, Sample};
use csv::{ReaderBuilder, StringRecord, Trim};
use std::path::Path;

const COLUMNS: [&str; 3] = ["force_n", "elongation_mm", "phase"];

/// Reads and checks a record.
///
/// # Errors
/// [`StudyError::Read`]; [`StudyError::Record`] names the line.
pub fn open_record(path: &Path) -> Result<Record, StudyError> {
    let text = read_text(path, InputKind::Record)?;
    read_record(&text).map_err(|source| {
        let other = other_kind(path, &text, InputKind::Record);
        other.unwrap_or_else(|| StudyError::Record { path: path.to_owned(), source })
    })
}

/// Reads and checks a record from the text of a file.
///
/// # Errors
/// [`RecordError`] naming the line.
pub fn read_record(text: &str) -> Result<Record, RecordError> {
    let mut samples = Vec::new();
    let mut columns = None;
    let mut separator = b',';
    for (i, text) in text.lines().enumerate() {
        if text.starts_with('#') || text.trim().is_empty() {
            continue;
        }
        if columns.is_none() {
            separator = [b';', b'\t'].into_iter().find(|of| text.contains(char::from(*of))).unwrap_or(b',');
        }
        let row = cells(text, separator);
        match columns {
            None => columns = Some(header(&row, i + 1)?),
            Some(columns) => samples.push(sample(&row, columns, separator != b',', i + 1)?),
        }
    }
    if columns.is_none() {
        return Err(invalid(1, "header", "missing", &COLUMNS.join(",")));
    }
    Record::new(&samples)
}

/// The cells of a line, without the blanks around them. Lines are read one by one, so that the line numbers
/// of errors count comments, too.
fn cells(line: &str, separator: u8) -> StringRecord {
    let mut reader = ReaderBuilder::new()
        .delimiter(separator)
        .has_headers(false)
        .trim(Trim::All)
        .from_reader(line.as_bytes());
    reader.records().find_map(Result::ok).unwrap_or_default()
}

/// Positions of the three columns. Another unit has another name, so that `force_kn` is refused.
fn header(row: &StringRecord, line: usize) -> Result<[usize; 3], RecordError> {
    let mut columns = [0; 3];
    for (position, wanted) in columns.iter_mut().zip(COLUMNS) {
        *position = row.iter().position(|name| name == wanted).ok_or_else(|| {
            let names = row.iter().collect::<Vec<_>>().join(",");
            invalid(line, "header", names, &format!("a column `{wanted}`"))
        })?;
    }
    Ok(columns)
}

fn sample(
    row: &StringRecord,
    columns: [usize; 3],
    has_commas: bool,
    line: usize,
) -> Result<Sample, RecordError> {
    let text = |k: usize| row.get(columns[k]).unwrap_or_default();
    let number = |k: usize| -> Result<f64, RecordError> {
        let decimal = if has_commas { text(k).replacen(',', ".", 1) } else { text(k).to_owned() };
        decimal.parse().map_err(|_| invalid(line, COLUMNS[k], format!("`{}`", text(k)), "a number"))
    };
    let phase = match text(2) {
        "loading" => Phase::Loading,
        "unloading" => Phase::Unloading,
        other => return Err(invalid(line, "phase", format!("`{other}`"), "loading or unloading")),
    };
    Ok(Sample { line, force: number(0)?, elongation: 1e-3 * number(1)?, phase })
}

fn invalid(line: usize, field: &'static str, value: impl ToString, expected: &str) -> RecordError {
    RecordError::Invalid { line, field, value: value.to_string(), expected: expected.to_owned() }
}

#[cfg(test)]
mod tests {
    use super::*;

    const GOOD: &str = "# a comment\nphase,force_n,elongation_mm\nloading,100,0\n\
        loading, 1000, 2\nunloading,100,0.5\nunloading,50,0.2\n";

    #[test]
    fn columns_may_stand_in_any_order_among_comments() {
        let record = read_record(GOOD).unwrap();
        assert_eq!(record.samples(Phase::Loading).len(), 2);
        assert_eq!(
            record.samples(Phase::Unloading)[2],
            Sample { line: 6, force: 50.0, elongation: 2e-4, phase: Phase::Unloading }
        );
    }

    #[test]
    fn a_record_may_have_semicolons_and_decimal_commas() {
        let record =
            read_record(&GOOD.replace(',', ";").replace("0.5", "0,5").replace("0.2", "0,2")).unwrap();
        let plain = read_record(GOOD).unwrap();
        assert_eq!(record.samples(Phase::Unloading), plain.samples(Phase::Unloading));
        assert_eq!(record.samples(Phase::Loading), plain.samples(Phase::Loading));
    }

    #[test]
    fn what_is_wrong_with_a_record_is_named_with_its_line() {
        for (good, bad, words) in [
            (
                "force_n",
                "force_kn",
                "line 2: header is phase,force_kn,elongation_mm: expected a column `force_n`",
            ),
            ("unloading,100,0.5", "unloading,100", "line 5: elongation_mm is ``: expected a number"),
            ("loading, 1000, 2", "loading, 1000, 2 mm", "line 4: elongation_mm is `2 mm`: expected a number"),
            ("loading, 1000, 2", ", 1000, 2", "line 4: phase is ``: expected loading or unloading"),
            ("loading, 1000, 2", "loading, NaN, 2", "line 4: force_n is NaN: expected a finite number"),
            ("loading, 1000, 2", "loading, 50, 2", "line 4: force_n is 50: expected more than 100 of line 3"),
        ] {
            let message = read_record(&GOOD.replace(good, bad)).unwrap_err().to_string();
            assert!(message.starts_with(words), "{message}");
        }
        for (text, words) in [
            ("", "line 1: header is missing"),
            (
                "force_n,elongation_mm,phase\n1,1,loading\n2,2,loading\n",
                "the record ends at line 3 with 0 samples of phase unloading",
            ),
        ] {
            let message = read_record(text).unwrap_err().to_string();
            assert!(message.starts_with(words), "{message}");
        }
    }
}
