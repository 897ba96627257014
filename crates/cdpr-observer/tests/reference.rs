//! The recursive estimate is that of batch least squares, computed by a program that shares no code.

use crate::common::robot;
use cdpr_observer::{LoadObserver, ObserverSetting};
use cdpr_robot::{Pose, Rotation3, Vector3};
use serde_json::Value;

fn list(value: &Value) -> Vec<f64> {
    value.as_array().unwrap().iter().map(|of| of.as_f64().unwrap()).collect()
}

fn lists(value: &Value) -> Vec<Vec<f64>> {
    value.as_array().unwrap().iter().map(list).collect()
}

#[test]
fn the_recursive_estimate_is_that_of_batch_least_squares() {
    let file: Value = serde_json::from_str(include_str!("../../../data/reference/observer.json")).unwrap();
    let mut caroca = robot("caroca");
    caroca.cables.iter_mut().for_each(|cable| cable.properties.linear_density = 0.0);
    let [x, y, z, a, b, c] = <[f64; 6]>::try_from(list(&file["start"])).unwrap();
    let start = Pose { position: Vector3::new(x, y, z), rotation: Rotation3::new(Vector3::new(a, b, c)) };
    let (lengths, tensions, prior) =
        (lists(&file["lengths"]), lists(&file["tensions"]), list(&file["prior"]));
    let std = file["tension_std"].as_f64().unwrap();
    let setting = ObserverSetting {
        length_std: file["length_std"].as_f64().unwrap(),
        modulus_std: prior[4],
        ..ObserverSetting::new(8, std, prior[0], prior[1] / prior[0])
    };
    let mut observer = LoadObserver::new(&caroca, &lengths[0], &start, setting).unwrap();
    let unknowns = |observer: &LoadObserver| {
        let estimate = observer.estimate();
        let moment = estimate.center.map(|center| center.map_or(f64::NAN, |of| of * estimate.payload));
        [estimate.payload, moment[0], moment[1], moment[2], estimate.modulus]
    };
    // One sample: the digits of its own least squares.
    let observed = observer.update(&lengths[0], &tensions[0]).unwrap();
    let first = &file["first"];
    let chi_square = first["chi_square"].as_f64().unwrap();
    assert!((observed.consistency - chi_square).abs() < 1e-7 * chi_square, "{}", observed.consistency);
    let (expected, covariance) = (list(&first["unknowns"]), lists(&first["covariance"]));
    for k in [0, 4] {
        assert!((unknowns(&observer)[k] - expected[k]).abs() < 1e-7 * prior[k]);
    }
    for (i, row) in covariance.iter().enumerate() {
        for (j, value) in row.iter().enumerate() {
            let found = observer.covariance()[(i, j)];
            assert!((found - value).abs() < 1e-7 * prior[i] * prior[j], "{i} {j}: {found} {value}");
        }
    }
    // All samples: but for the second order of the steps, which is far below the standard deviations.
    for (lengths, tensions) in lengths.iter().zip(&tensions).skip(1) {
        assert!(observer.update(lengths, tensions).unwrap().converged);
    }
    let batch = &file["batch"];
    let (expected, covariance) = (list(&batch["unknowns"]), lists(&batch["covariance"]));
    for k in 0..5 {
        let (found, std) = (unknowns(&observer)[k], covariance[k][k].sqrt());
        println!("{k}: {found} {} ± {std}", expected[k]);
        assert!((found - expected[k]).abs() < 0.05 * std, "{k}: {found} {} ± {std}", expected[k]);
        assert!((observer.covariance()[(k, k)].sqrt() / std - 1.0).abs() < 0.01, "{k}");
    }
}
