//! Tables as spreadsheets and scripts write them.

use super::*;
use proptest::prelude::*;

fn table(text: &str) -> Table {
    Table::read(text.as_bytes()).unwrap_or_else(|error| panic!("{text:?}: {error}"))
}

fn numbers(table: &Table) -> Vec<(String, Vec<f64>)> {
    let of = |column: &Column| (column.name.clone(), table.numbers(column).unwrap().to_vec());
    table.columns.iter().map(of).collect()
}

fn message(text: &str) -> String {
    let table = match Table::read(text.as_bytes()) {
        Err(error) => return error.to_string(),
        Ok(table) => table,
    };
    let error = table.columns.iter().find_map(|column| column.cells().err());
    error.map(|error| error.to_string()).unwrap_or_default()
}

#[test]
fn every_separator_and_both_decimal_marks_give_the_same_numbers() {
    let expected = [("x".to_owned(), vec![0.5, -1.25]), ("Y [mm]".to_owned(), vec![2.0, 1200.0])];
    for text in [
        "x,Y [mm]\n0.5,2\n-1.25,1200\n",
        "x;Y [mm]\n0,5;2\n-1,25;1200\n",
        "sep=;\nx;Y [mm]\n0.5;2\n-1.25;1200\n",
        "sep=|\nx|Y [mm]\n0.5|2\n-1.25|1.2e3\n",
        "x\tY [mm]\n0.5\t2\n-1.25\t1200",
        "x Y [mm]\n0.5  2\n  -1.25 1200  \n",
        "x   Y [mm]\n0,5\t2\n\u{2212}1,25 1200\n",
        "# a comment\n\nx,Y [mm]\r\n0.5,2\r\n# another\r\n-1.25,1200\r\n",
        "\"x\",\"Y [mm]\"\n\"0,5\",\"2\"\n\"-1,25\",1200\n",
        "x;Y [mm];\n0.5;2;\n-1.25;1200;\n",
        "x,Y [mm]\r0.5,2\r-1.25,1200\r",
    ] {
        assert_eq!(numbers(&table(text)), expected, "{text:?}");
    }
}

#[test]
fn every_encoding_gives_the_same_texts() {
    let text = "x;note\n0,5;Länge\n";
    let wide = |mark: [u8; 2], unit: fn(u16) -> [u8; 2]| {
        mark.into_iter().chain(text.encode_utf16().flat_map(unit)).collect::<Vec<u8>>()
    };
    let latin = text.chars().map(|letter| u8::try_from(u32::from(letter)).unwrap()).collect();
    for bytes in [
        text.as_bytes().to_vec(),
        [b"\xef\xbb\xbf", text.as_bytes()].concat(),
        wide([0xff, 0xfe], u16::to_le_bytes),
        wide([0xfe, 0xff], u16::to_be_bytes),
        latin,
    ] {
        let found = Table::read(&bytes).unwrap();
        assert_eq!(found.finite(&found.columns[0]), Ok(&[0.5][..]));
        assert_eq!(*found.columns[1].cells().unwrap(), Cells::Text(vec!["Länge".to_owned()]));
    }
    for (bytes, words) in [
        (&b"PK\x03\x04"[..], "a workbook"),
        (b"a,b\n1,\0\n", "no text"),
        (b"\xff\xfea", "UTF-16 with an error"),
    ] {
        let error = Table::read(bytes).unwrap_err().to_string();
        assert!(error.contains(words) && error.ends_with("CSV in UTF-8"), "{error}");
    }
}

#[test]
fn a_column_of_words_is_kept_and_blank_cells_are_counted() {
    let found = table("x,status,y\n1,failed,nan\n,ok,3\n2,3,-inf\n");
    assert_eq!(
        *found.columns[1].cells().unwrap(),
        Cells::Text(vec!["failed".into(), "ok".into(), "3".into()])
    );
    let blanks: Vec<_> = found
        .columns
        .iter()
        .flat_map(|column| &column.blanks)
        .map(|blank| (blank.row, &*blank.text))
        .collect();
    assert_eq!(blanks, [(1, ""), (0, "nan"), (2, "-inf")]);
    assert_eq!(found.lines, [2, 3, 4]);
}

#[test]
fn what_can_be_read_in_two_ways_is_an_error_with_its_line_and_column() {
    let found = table("x,y\n1,ab\n,c\n");
    let errors = [found.finite(&found.columns[0]), found.numbers(&found.columns[1])];
    let expected =
        ["line 3, column x: ``: expected a finite number", "line 2, column y: `ab`: expected a number"];
    assert_eq!(errors.map(|error| error.unwrap_err().to_string()), expected);
    for (text, words) in [
        ("a,b\n1,2\n\n# c\n3,four\n5,6\n", "line 5, column b: `four`: expected a number"),
        (
            "a;b\n1,234;2\n",
            "line 2, column a: `1,234`: expected 1234 or 1.234: a comma of thousands or a dec",
        ),
        ("a,b\n\"1,234.5\",2\n", "line 2, column a: `1,234.5`: expected a number without marks of thousands"),
        ("a;b\n1'234;2\n", "`1'234`: expected a number without marks of thousands"),
        ("a;b\n1.234.567,5;2\n", "expected a number without marks of thousands"),
        ("a;b\n0,5;2\n0.5;3\n", "line 2, column a: `0,5`: expected a decimal point, as elsewhere"),
        ("a;b\n1,234;0.5\n", "`1,234`: expected 1234 or 1.234"),
        (
            "x,y\n0,5,1\n",
            "line 2: 3 cells: expected 2, as many as in line 1; with decimal commas, semicolons",
        ),
        ("x;y\n1\n", "line 2: 1 cell: expected 2"),
        ("a,a\n1,2\n", "line 1: column a is there twice: expected a different name for each column"),
        ("a,b\n1,\"x\n2,3\n", "line 2: a quote \" is not closed"),
    ] {
        let found = message(text);
        assert!(found.contains(words), "{text:?}: {found}");
    }
    // Where the commas are decimal beyond doubt, three digits behind one are no question.
    assert_eq!(numbers(&table("a;b\n1,234;0,5\n2,345;3\n"))[0].1, [1.234, 2.345]);
    assert_eq!(numbers(&table("a;b\n1,234;1\n1234,5;2\n"))[0].1, [1.234, 1234.5]);
}

#[test]
fn the_first_line_has_names_unless_it_has_numbers_as_those_below() {
    let names = |text: &str| table(text).columns.iter().map(|column| column.name.clone()).collect::<Vec<_>>();
    assert_eq!(names("1;2\n3;4\n"), ["column1", "column2"]);
    assert_eq!(names("1,red\n3,blue\n"), ["column1", "column2"]);
    assert_eq!(names("time,1,2\n3,4,5\n"), ["time", "1", "2"]);
    assert_eq!(names(",x\n0,1\n"), ["column1", "x"]);
    assert_eq!(table("x\n").rows(), 0);
    assert_eq!(table("").columns, []);
}

#[test]
fn names_say_quantity_and_unit_in_any_letters() {
    let of = |name: &str| {
        let (quantity, unit) = Column::of_numbers(name.to_owned(), vec![], |_| String::new()).quantity();
        (quantity, unit.map(|unit| (unit.dimension, unit.factor)))
    };
    for name in ["x_mm", "X [mm]", "x (mm)", "x[MM]"] {
        assert_eq!(of(name), ("x".to_owned(), Some((Dimension::Length, 1e-3))), "{name}");
    }
    assert_eq!(of("F_N"), ("f".to_owned(), Some((Dimension::Force, 1.0))));
    assert_eq!(of("Mx [N m]"), ("mx".to_owned(), Some((Dimension::Moment, 1.0))));
    assert_eq!(of("roll [°]").1, of("roll_deg").1);
    assert_eq!(of("t_winch"), ("t_winch".to_owned(), None));
    assert_eq!(of("Time"), ("time".to_owned(), None));
    let aside = |text: &str| table(text).columns.iter().map(Column::is_aside).collect::<Vec<_>>();
    assert_eq!(aside("t [s],t_n,x_m,note,void\n1,2,3,here,\n"), [true, false, false, true, true]);
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 500, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn any_bytes_are_a_table_of_even_columns_or_an_error(bytes in proptest::collection::vec(any::<u8>(), 0..200)) {
        even(&bytes);
    }

    #[test]
    fn any_letters_of_tables_are_a_table_of_even_columns_or_an_error(text in "[-0-9a,;.\" \t\r\n#'()=]{0,80}") {
        even(text.as_bytes());
        even(format!("sep={text}").as_bytes());
    }

    #[test]
    fn numbers_are_read_as_they_are_written(
        rows in proptest::collection::vec(proptest::array::uniform3(-1e6f64..1e6), 1..8),
        separator in prop::sample::select(vec![",", ";", "\t", " "]),
    ) {
        let line = |row: &[f64; 3]| row.map(|value| value.to_string()).join(separator);
        let text = format!("a{separator}b{separator}c\n{}\n", rows.iter().map(line).collect::<Vec<_>>().join("\n"));
        let found = numbers(&table(&text));
        for (k, (_, values)) in found.iter().enumerate() {
            prop_assert_eq!(values, &rows.iter().map(|row| row[k]).collect::<Vec<_>>());
        }
        let german = text.replace([',', ' '], ";").replace('.', ",");
        let found = Table::read(german.as_bytes()).unwrap();
        for (k, column) in found.columns.iter().enumerate() {
            // An error asks where all commas could be of thousands.
            if let Ok(values) = found.numbers(column) {
                prop_assert_eq!(values, &rows.iter().map(|row| row[k]).collect::<Vec<_>>()[..]);
            }
        }
    }
}

fn even(bytes: &[u8]) {
    if let Ok(table) = Table::read(bytes) {
        for column in &table.columns {
            let count = match column.cells() {
                Ok(Cells::Numbers(values)) => values.len(),
                Ok(Cells::Text(texts)) => texts.len(),
                Err(_) => table.rows(),
            };
            assert_eq!(count, table.rows());
        }
    }
}

#[test]
fn a_unit_behind_each_number_belongs_into_the_name_of_the_column() {
    let table =
        Table::read(b"x;load;cable\n1;3.2 mm;4 mm steel\n2;-1,5mm;4 mm steel\n3;2 kN;6 mm fibre\n").unwrap();
    let error = table.columns[1].cells().unwrap_err().to_string();
    assert_eq!(
        error,
        "line 2, column load: `3.2 mm`: expected 3.2, and the unit in the name of the column: load [mm]; \
         line 4 has another unit, `2 kN`: all cells in one unit"
    );
    assert!(matches!(table.columns[2].cells(), Ok(Cells::Text(_))), "a name of a cable");
    let one = Table::read(b"x,y\n1,2\n2,3\n3,4 N\n").unwrap();
    let error = one.columns[1].cells().unwrap_err().to_string();
    assert!(error.starts_with("line 4, column y: `4 N`: expected 4, and the unit in"), "{error}");
}

#[test]
fn signs_and_other_units_behind_and_before_numbers_belong_into_the_name_of_the_column() {
    let error = |cells: [&str; 3]| {
        let text = format!("x;load\n1;{}\n2;{}\n3;{}\n", cells[0], cells[1], cells[2]);
        let table = Table::read(text.as_bytes()).unwrap();
        table.columns[1].cells().err().map(|error| error.to_string())
    };
    let into_name = |cell: &str, value: &str, unit: &str| {
        let place = format!("line 2, column load: `{cell}`");
        Some(format!("{place}: expected {value}, and the unit in the name of the column: load [{unit}]"))
    };
    assert_eq!(error(["$0.5", "$0.7", "$1"]), into_name("$0.5", "0.5", "$"));
    assert_eq!(error(["5 %", "7%", "8 %"]), into_name("5 %", "5", "%"));
    assert_eq!(error(["2 bar", "3 bar", ""]), into_name("2 bar", "2", "bar"));
    let mixed = error(["5 mm", "0.5 cm", "6 mm"]).unwrap();
    assert!(
        mixed.ends_with("load [mm]; line 3 has another unit, `0.5 cm`: all cells in one unit"),
        "{mixed}"
    );
    for labels in [["2a", "2b", "3a"], ["1 left", "1 right", "2 left"], ["4 mm steel", "6 mm", "steel"]] {
        assert_eq!(error(labels), None, "{labels:?} are labels");
    }
}
