//! What is refused, with what would be right.

use crate::common::{Case, EXTERNAL, cases};
use crate::minimum::router;
use cdpr_calibration::{
    FitSettings, Measurement, Noise, Row, SensorError, Unknowns, cross_validated, drawn, fit,
    read_measurements, simulate,
};

fn named(noise: &[(&str, f64)]) -> Vec<(String, f64)> {
    noise.iter().map(|(name, value)| ((*name).to_owned(), *value)).collect()
}

fn campaign(case: &Case) -> Vec<Row> {
    simulate(&case.simulated(&drawn(&case.model(), 3), &case.poses(12), EXTERNAL, 3)).unwrap()
}

#[test]
fn one_quantity_with_two_names_is_refused() {
    let robot = router();
    let table = "x_m,y_m,l1_m,l2_m,l3_m,l4_m\n1,1,1.5,2.3,1.4,2.2\n";
    let read = |text: &str, noise: &[(&str, f64)]| {
        read_measurements(text.as_bytes(), &robot, &named(noise))
            .map(|_| ())
            .map_err(|error| error.to_string())
    };
    for noise in [
        [("cov_x_m_y_m", 5e-9), ("cov_y_m_x_m", -5e-9)],
        [("cov_x_m_y_m", 5e-9), ("cov_y_mm_x_mm", 5e-3)],
        [("length", 1e-4), ("lengths", 2e-4)],
        [("tension", 1.0), ("tensions", 2.0)],
        [("position", 1e-4), ("position", 2e-4)],
    ] {
        let position: &[(&str, f64)] = if noise[0].0 == "position" { &[] } else { &[("position", 1e-4)] };
        let error = read(table, &[position, &noise].concat()).unwrap_err();
        assert!(error.contains("once"), "{noise:?}: {error}");
    }
    let itself = read(table, &[("position", 1e-4), ("cov_x_m_x_m", 5e-9)]).unwrap_err();
    assert!(itself.contains("two different quantities"), "{itself}");
    for (header, cells) in [
        ("x_m,y_m,cov_x_m_y_m,cov_y_m_x_m,", "1,1,5e-9,-5e-9,"),
        ("x_m,y_m,x_mm,", "1,1,1000,"),
        ("x_m,y_m,X_M,", "1,1,1,"),
        ("x_m,y_m,std_x_m,std_x_mm,", "1,1,1e-4,0.2,"),
    ] {
        let text = format!("{header}l1_m,l2_m,l3_m,l4_m,l01_m\n{cells}1.5,2.3,1.4,2.2,1.5\n");
        let error = read(&text, &[("position", 1e-4)]).unwrap_err();
        assert!(error.contains("each quantity once"), "{header}: {error}");
    }
    // What the options say goes before what the file says, by whatever name.
    let text = r#"{"format": "cdpr-measurements/1", "noise": {"lengths": 1e-4, "cov_y_m_x_m": 1e-9,
        "position": 1e-4}, "rows": [{"x_m": 1, "y_m": 1, "l1_m": 1.5, "l2_m": 2.3, "l3_m": 1.4, "l4_m": 2.2}]}"#;
    let noise = named(&[("length", 3e-4), ("cov_x_m_y_m", 2e-9)]);
    let rows = read_measurements(text.as_bytes(), &robot, &noise).unwrap().rows;
    assert_eq!((rows[0].length_std[0], rows[0].covariances.len(), rows[0].covariances[0].2), (3e-4, 1, 2e-9));
}

#[test]
fn an_error_of_sensors_is_sought_once() {
    let case = &cases()[0];
    let mut unknowns = Unknowns::of_model(&case.model());
    unknowns.add(&case.robot, SensorError::LengthOffset, None, 0);
    unknowns.add(&case.robot, SensorError::LengthOffset, Some(0.01), 0);
    let error =
        fit(&case.robot, &campaign(case), &unknowns, &FitSettings::default()).unwrap_err().to_string();
    assert!(error.contains("length_offset: expected each once"), "{error}");
}

#[test]
fn numbers_without_sense_are_refused_by_name() {
    let case = &cases()[0];
    let rows = campaign(case);
    let unknowns = Unknowns::of_model(&case.model());
    for std in [1e-160, 0.0, -1.0, f64::NAN, f64::INFINITY, 1e160] {
        for name in Noise::NAMES {
            let error = Noise::named(&named(&[(name, std)])).unwrap_err().to_string();
            assert!(error.starts_with(&format!("noise {name} is ")), "{error}");
        }
        assert!(Measurement::named(&case.robot, &named(&[("position", std), ("rotation", 1e-4)])).is_err());
        let mut wrong = rows.clone();
        wrong[4].readings[0].std = std;
        let error = fit(&case.robot, &wrong, &unknowns, &FitSettings::default()).unwrap_err().to_string();
        assert!(error.starts_with("std_x_m of line 5 is "), "{error}");
        if std != 0.0 {
            let mut wrong = rows.clone();
            wrong[4].length_std[1] = std;
            assert!(fit(&case.robot, &wrong, &unknowns, &FitSettings::default()).is_err());
        }
        let mut sought = Unknowns::free(&case.robot, &["mass"]).unwrap();
        sought.add(&case.robot, SensorError::LengthOffset, Some(std), 0);
        let error = fit(&case.robot, &rows, &sought, &FitSettings::default()).unwrap_err().to_string();
        assert!(error.starts_with("prior of length_offset1 is "), "{error}");
    }
    for starts in [0, FitSettings::MOST_STARTS + 1, 1_000_000_000, usize::MAX] {
        let settings = FitSettings { starts, ..FitSettings::default() };
        let error = fit(&case.robot, &rows, &unknowns, &settings).unwrap_err().to_string();
        assert_eq!(error, format!("starts is {starts}: expected 1 to 1000"));
    }
    for folds in [0, 1, 13, usize::MAX] {
        let with = cross_validated(&case.robot, &rows, &unknowns, &FitSettings::default(), folds);
        assert!(with.unwrap_err().to_string().starts_with(&format!("folds is {folds}: expected 2 to 12")));
    }
    let mut bounded = unknowns.clone();
    bounded.bound(&case.robot, "mass", [-2.0, -1.0]).unwrap();
    assert!(bounded.bound(&case.robot, "mass", [1.0, 2.0]).is_err());
}

#[test]
fn lengths_alone_are_refused_with_what_would_help() {
    let robot = router();
    let text = include_str!("../../../data/reference/router/lengths-only.csv");
    for noise in [&[("length", 2e-4)][..], &[]] {
        let rows = read_measurements(text.as_bytes(), &robot, &named(noise)).unwrap().rows;
        let unknowns = Unknowns::free(&robot, &["b1.x"]).unwrap();
        let error = fit(&robot, &rows, &unknowns, &FitSettings::default()).unwrap_err().to_string();
        assert!(
            error.contains("more poses of this kind cannot help; expected tensions or the pose"),
            "{error}"
        );
    }
}
