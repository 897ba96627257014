//! Tables as CSV: with commas, semicolons or tabs, with or without a line of names.

use crate::error::StudyError;
use crate::given::columns::{GivenTable, invalid};
use std::path::Path;

/// The table of a text. A first line of numbers is a row; the columns then are `column1`, `column2` ...
pub(super) fn read(path: &Path, text: &str) -> Result<GivenTable, StudyError> {
    let first = text.lines().next().unwrap_or_default();
    let count = |separator: &char| first.matches(*separator).count();
    let separator = [',', ';', '\t'].into_iter().rev().max_by_key(count).unwrap_or(',');
    let mut reader = csv::ReaderBuilder::new();
    let mut records =
        reader.delimiter(separator as u8).has_headers(false).comment(Some(b'#')).from_reader(text.as_bytes());
    let mut names: Option<Vec<String>> = None;
    let mut cells: Vec<Vec<String>> = Vec::new();
    for record in records.records() {
        let record = record
            .map_err(|error| invalid(path, "table", &error.to_string(), "as many cells in each line"))?;
        if names.is_none() {
            cells = vec![Vec::new(); record.len()];
            let numbers = record.iter().all(|cell| cell.trim().parse::<f64>().is_ok());
            names = Some(if numbers {
                vec![String::new(); record.len()]
            } else {
                record.iter().map(|cell| cell.trim().to_owned()).collect()
            });
            if !numbers {
                continue;
            }
        }
        cells.iter_mut().zip(&record).for_each(|(column, cell)| column.push(cell.to_owned()));
    }
    GivenTable::of_texts(path, names.unwrap_or_default(), &cells)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn table(text: &str) -> GivenTable {
        read("table.csv".as_ref(), text).unwrap()
    }

    #[test]
    fn names_and_separators_are_recognised() {
        let with_names = table("a;b\n1;2\n3;4\n");
        assert_eq!(with_names.columns, [("a".to_owned(), vec![1.0, 3.0]), ("b".to_owned(), vec![2.0, 4.0])]);
        let without = table("1\t2\n3\t4\n");
        assert_eq!(without.columns[1], ("column2".to_owned(), vec![2.0, 4.0]));
    }

    #[test]
    fn cells_without_a_number_are_named_and_columns_of_words_left_out() {
        let found = table("x,y,status\n1,nan,failed\n2,3,ok\n,4,ok\n");
        assert_eq!(found.texts, ["status"]);
        let bad: Vec<_> = found.bad.iter().map(|cell| (cell.row, cell.column.as_str())).collect();
        assert_eq!(bad, [(1, "y"), (3, "x")]);
        assert_eq!(found.bad[0].text, "nan");
    }

    #[test]
    fn a_short_line_and_equal_names_are_errors() {
        for (text, words) in [("a,b\n1\n", "1 fields"), ("a,a\n1,2\n", "a different name for each column")] {
            let error = read("table.csv".as_ref(), text).unwrap_err().to_string();
            assert!(error.contains(words), "{error}");
        }
    }
}
