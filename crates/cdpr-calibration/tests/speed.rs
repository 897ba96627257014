//! Searches as large as a user's, with the time that they take.

use crate::common::{EXTERNAL, cases};
use cdpr_calibration::{
    FitSettings, Noise, SensorError, Simulated, Unknowns, drawn, drawn_errors, fit, simulate,
};
use std::time::Instant;

#[test]
fn fifty_poses_with_up_to_ninety_unknowns_take_few_steps() {
    let errors = [
        (SensorError::LengthOffset, 0.02),
        (SensorError::DrumScale, 0.01),
        (SensorError::TensionBias, 10.0),
        (SensorError::TensionGain, 0.02),
    ];
    let noise = Noise { tension: Some(1.0), ..EXTERNAL };
    for case in cases() {
        let errors = drawn_errors(&case.robot, &errors, 0, 4);
        let rows = simulate(&Simulated {
            errors: &errors,
            ..case.simulated(&drawn(&case.model(), 4), &case.poses(50), noise, 1)
        })
        .unwrap();
        let mut unknowns = Unknowns::of_model(&case.model());
        for (error, _) in &errors {
            unknowns.add(&case.robot, *error, None, 0);
        }
        let clock = Instant::now();
        let found = fit(&case.robot, &rows, &unknowns, &FitSettings::default()).unwrap();
        println!(
            "{}: {} rows, {} unknowns of all rows, {} of single rows, {:.3} s",
            case.name,
            rows.len(),
            unknowns.all.len(),
            rows.len() * case.robot.cables.len(),
            clock.elapsed().as_secs_f64()
        );
        assert!(found.converged() && found.p_value().unwrap() > 1e-3, "{}: {}", case.name, found.steps);
        assert!(found.steps <= 40, "{}: {} steps", case.name, found.steps);
    }
}

#[test]
fn five_hundred_rows_without_poses_take_few_steps() {
    let noise = Noise { length: Some(2e-4), tension: Some(1.0), ..Noise::default() };
    for case in cases().iter().filter(|case| case.name != "GRAB") {
        let rows = simulate(&case.simulated(&drawn(&case.model(), 4), &case.poses(500), noise, 1)).unwrap();
        let clock = Instant::now();
        let found = fit(&case.robot, &rows, &Unknowns::usual(&case.robot), &FitSettings::default()).unwrap();
        println!(
            "{}: {} rows, {} unknowns, {} steps in {:.2} s",
            case.name,
            rows.len(),
            found.estimates.len(),
            found.steps,
            clock.elapsed().as_secs_f64()
        );
        assert!(found.converged() && found.steps <= 10 && found.p_value().unwrap() > 1e-3);
    }
}
