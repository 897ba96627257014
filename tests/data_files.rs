//! Data files are valid, have a source, and match the paper; schemas in the docs are those of the code.

use cdpr_robot::{Pose, Robot};
use cdpr_study::Study;
use std::path::{Path, PathBuf};

fn root() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("..")
}

fn files(folder: &str) -> Vec<PathBuf> {
    let entries = std::fs::read_dir(root().join(folder)).unwrap();
    entries
        .map(|entry| entry.unwrap().path())
        .filter(|path| path.extension().is_some_and(|e| e == "json"))
        .collect()
}

#[test]
fn every_robot_file_is_a_robot_with_a_source() {
    let files = files("data/robots");
    assert!(files.len() >= 2);
    for path in files {
        let robot = Robot::from_json(&std::fs::read_to_string(&path).unwrap()).unwrap();
        assert!(robot.source.is_some(), "{}", path.display());
    }
}

#[test]
fn every_study_file_is_a_study_with_a_source() {
    let files = files("data/studies");
    assert!(!files.is_empty());
    for path in files {
        assert!(Study::open(&path).unwrap().file.source.is_some(), "{}", path.display());
    }
}

#[test]
fn the_schemas_in_the_docs_are_those_of_the_code() {
    for (file, schema) in [
        ("cdpr-robot-1", cdpr_robot::json_schema()),
        ("cdpr-study-1", cdpr_study::json_schema()),
        ("cdpr-law-1", cdpr_study::law_schema()),
    ] {
        let path = root().join(format!("docs/schemas/{file}.schema.json"));
        assert_eq!(std::fs::read_to_string(path).unwrap(), schema, "run: cargo xtask schemas");
    }
}

#[test]
fn the_caroca_file_holds_table_1_of_the_paper() {
    let robot =
        Robot::from_json(&std::fs::read_to_string(root().join("data/robots/caroca.json")).unwrap()).unwrap();
    // Every exit point is a corner of the frame at 3.5 m, every anchor point a corner of the platform, each
    // of those once.
    for cable in &robot.cables {
        assert_eq!(cable.exit_point.abs().as_slice(), [3.5, 2.0, 3.5]);
        assert_eq!(cable.anchor_point.abs().as_slice(), [0.2, 0.15, 0.125]);
    }
    // Table 1 has B1 = B3, B2 = B4, B5 = B7, B6 = B8.
    for i in [0, 1, 4, 5] {
        assert_eq!(robot.cables[i].exit_point, robot.cables[i + 2].exit_point);
    }
    assert_eq!((robot.platform.mass, robot.cables[0].properties.linear_density), (180.0, 0.1015));
    assert!(robot.span(&Pose::at(0.0, 0.0, 1.75), 0).norm() > 4.0);
}
