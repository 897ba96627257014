//! Tables as Parquet hold what the CSV holds, and say what they are of.

#![allow(clippy::unwrap_used, clippy::panic)]

use cdpr_study::{
    IfExists, ObservationTable, ResultsFolder, ResultsOf, Session, Study, TableFormat, observe_into,
};
use parquet::file::reader::{FileReader, SerializedFileReader};
use parquet::record::Field;
use std::path::Path;

fn write(folder: &Path, format: TableFormat, observations: usize) {
    let path = concat!(env!("CARGO_MANIFEST_DIR"), "/../../data/studies/caroca.json");
    let mut study = Study::open(path.as_ref()).unwrap();
    study.set_observations(observations).unwrap();
    // Some robots are not held within this limit; the nominal robot's largest tension is 1311 N.
    study.robot.tension_limits.max = 1450.0;
    let sampling = study.sampling("geometrical_asymmetric").unwrap();
    let writes = |name: &str| name.starts_with("geometrical");
    let folder = ResultsFolder::begin(folder, ResultsOf::Study, IfExists::Refuse, writes).unwrap();
    let mut table = ObservationTable::new(&folder, &sampling, format).unwrap();
    let rows = |part: &_| format.rows(part);
    observe_into(&sampling, &Session::in_memory(), rows, |rows| table.write(rows)).unwrap();
    table.finish().unwrap();
}

#[test]
fn parquet_reads_back_as_the_numbers_and_words_of_the_csv() {
    // A table takes the place of one in another format.
    let [csv_folder, folder] = [(); 2].map(|()| tempfile::tempdir().unwrap());
    // More than a row group.
    write(csv_folder.path(), TableFormat::Csv, 66_000);
    write(folder.path(), TableFormat::Parquet, 66_000);
    let file = std::fs::File::open(folder.path().join("geometrical_asymmetric.parquet")).unwrap();
    let reader = SerializedFileReader::new(file).unwrap();
    assert_eq!(reader.metadata().num_row_groups(), 2);
    let mut csv = csv::Reader::from_path(csv_folder.path().join("geometrical_asymmetric.csv")).unwrap();
    let names: Vec<String> = csv.headers().unwrap().iter().map(str::to_owned).collect();
    let mut rows = reader.get_row_iter(None).unwrap();
    let (mut count, mut failed) = (0, 0);
    for record in csv.records() {
        let (record, row) = (record.unwrap(), rows.next().unwrap().unwrap());
        for ((name, cell), (column, field)) in names.iter().zip(&record).zip(row.get_column_iter()) {
            assert_eq!(name, column);
            let same = match field {
                Field::Double(value) => cell.parse::<f64>().unwrap().to_bits() == value.to_bits(),
                Field::Long(value) => cell == value.to_string(),
                Field::Str(value) => cell == value,
                Field::Null => cell.is_empty(),
                other => panic!("{name}: {other}"),
            };
            assert!(same, "row {count}, {name}: {cell}, {field}");
        }
        failed += usize::from(record.get(names.len() - 2) != Some("ok"));
        count += 1;
    }
    assert!(rows.next().is_none());
    assert_eq!(count, 66_000);
    assert!(failed > 0 && failed < count, "{failed} failed");
}

#[test]
fn a_parquet_table_says_what_it_is_of_and_in_which_units() {
    let folder = tempfile::tempdir().unwrap();
    write(folder.path(), TableFormat::Parquet, 10);
    let file = std::fs::File::open(folder.path().join("geometrical_asymmetric.parquet")).unwrap();
    let reader = SerializedFileReader::new(file).unwrap();
    let metadata = reader.metadata().file_metadata().key_value_metadata().unwrap();
    let of = |key: &str| metadata.iter().find(|pair| pair.key == key).unwrap().value.clone().unwrap();
    assert_eq!(
        (of("robot").as_str(), of("sampling").as_str(), of("seed").as_str()),
        ("CAROCA", "geometrical_asymmetric", "2017")
    );
    assert_eq!(of("study"), "Static deflection of CAROCA under 50 kg");
    assert_eq!((of("version").as_str(), of("hash").len()), (env!("CARGO_PKG_VERSION"), 32));
    let units: serde_json::Value = serde_json::from_str(&of("units")).unwrap();
    assert_eq!(
        (&units["d_youngs_modulus"], &units["d_b8.z"], &units["magnitude_mm"]),
        (&"Pa".into(), &"m".into(), &"mm".into())
    );
}
