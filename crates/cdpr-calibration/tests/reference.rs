//! The fit against SciPy's.

use cdpr_calibration::{FitSettings, Unknowns, fit, read_measurements};
use cdpr_evidence::accept;
use cdpr_robot::Robot;
use cdpr_study::open_errors;
use serde_json::Value;
use std::path::Path;

#[test]
fn scipy_finds_the_same_robot() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("../..");
    let text = std::fs::read_to_string(root.join("data/reference/calibration.json")).unwrap();
    let reference: Value = serde_json::from_str(&text).unwrap();
    let path = |field: &str| root.join(reference[field].as_str().unwrap());
    let robot = Robot::from_json(&std::fs::read_to_string(path("robot")).unwrap()).unwrap();
    let model = open_errors(&path("model"), &robot).unwrap();
    let std = reference["noise"].as_f64().unwrap();
    let noise = ["position", "rotation"].map(|name| (name.to_owned(), std));
    let measured =
        read_measurements(reference["measurements"].as_str().unwrap().as_bytes(), &robot, &noise).unwrap();
    let found = fit(&robot, &measured.rows, &Unknowns::of_model(&model), &FitSettings::default()).unwrap();
    let mut worst: (f64, f64) = (0.0, 0.0);
    for estimate in &found.estimates {
        let of = &reference["parameters"][&estimate.name];
        let (value, std) = (of["deviation"].as_f64().unwrap(), of["std"].as_f64().unwrap());
        worst.0 = worst.0.max((estimate.value - value).abs() / std);
        worst.1 = worst.1.max((estimate.std.unwrap() / std - 1.0).abs());
    }
    accept("V-CALIBRATION-001", worst.0);
    accept("V-CALIBRATION-002", worst.1);
    let chi_square = reference["chi_square"].as_f64().unwrap();
    assert!((found.chi_square / chi_square - 1.0).abs() < 1e-9);
}
