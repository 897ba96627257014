//! Tables that somebody has.

use cdpr_study::{Analyser, TableRequest, analyse_table, open_table};
use std::f64::consts::PI;
use std::path::Path;

#[test]
fn columns_that_are_a_vector_have_an_index_for_each_input() {
    let path = Path::new(concat!(env!("CARGO_MANIFEST_DIR"), "/../../data/tables/ishigami.csv"));
    let table = open_table(path, None).unwrap();
    let of = |inputs: &[&str], vector: &[&str]| {
        let names = |names: &[&str]| names.iter().map(ToString::to_string).collect();
        let analyser = Analyser::new(1);
        let (inputs, vector) = (names(inputs), names(vector));
        analyse_table(&table, &TableRequest { inputs, outputs: vec![], limits: vec![], vector, analyser })
    };
    let found = of(&["x1", "x2", "x3"], &["y", "x4"]).unwrap().vector.unwrap();
    assert_eq!(found.columns, ["y", "x4"]);
    // The means are half of the first-order index, of 13.8 of the variance 13.8 + π²/3.
    for (input, share) in [("x1", 0.314), ("x2", 0.442), ("x3", 0.0)] {
        let exact = 0.5 * share * 13.8 / (13.8 + PI * PI / 3.0);
        let of = found.bures[input];
        assert!(of.means.low < exact && exact < of.means.high && of.means.width() < 0.2, "{input} {of:?}");
        assert!(of.index.value > of.means.value - 0.02, "{input} {of:?}");
    }
    // The other columns are inputs.
    let others = of(&[], &["y", "x4"]).unwrap();
    assert_eq!(others.inputs, ["x1", "x2", "x3"]);
    let error = of(&[], &["z"]).unwrap_err().to_string();
    assert!(error.contains("vector is z: expected a column of numbers"), "{error}");
    assert!(of(&["y"], &["y"]).is_err() && of(&[], &[]).unwrap().vector.is_none());
}

#[test]
fn a_folder_with_several_tables_says_how_one_of_them_is_named() {
    let folder = tempfile::tempdir().unwrap();
    for name in ["all.csv", "modulus_mass.csv"] {
        std::fs::write(folder.path().join(name), "x,y\n1,2\n3,4\n").unwrap();
    }
    let error = open_table(folder.path(), None).unwrap_err().to_string();
    let first = folder.path().join("all.csv");
    let expected = format!("one of them by its file, such as {}: all, modulus_mass", first.display());
    assert!(error.ends_with(&expected), "{error}");
    assert!(open_table(&first, None).is_ok());
}
