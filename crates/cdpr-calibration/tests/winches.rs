//! What is left of a position where the errors of the winches are sought with the robot.

use crate::common::{Case, EXTERNAL, cases};
use cdpr_calibration::{
    Calibrated, Campaign, FitSettings, Measurements, Noise, Quantity, Row, SensorError, Simulated, Unknowns,
    carry_out, drawn, drawn_errors, simulate,
};
use cdpr_robot::{Axis, Pose};
use cdpr_statics::{DirectProblem, DirectStart, Load};
use std::collections::BTreeMap;

/// A campaign of a drawn robot whose winches have drawn errors; `seed` draws them, and the noise.
fn rows(case: &Case, errors: &[(SensorError, f64)], noise: Noise, seed: u64) -> Vec<Row> {
    let errors = drawn_errors(&case.robot, errors, 0, seed);
    let truth = drawn(&case.model(), seed);
    simulate(&Simulated { errors: &errors, ..case.simulated(&truth, &case.poses(30), noise, seed) }).unwrap()
}

fn calibrated(case: &Case, rows: Vec<Row>, errors: &[(SensorError, Option<f64>)]) -> Calibrated {
    let model = case.model();
    let mut unknowns = Unknowns::of_model(&model);
    errors.iter().for_each(|(error, std)| unknowns.add(&case.robot, *error, *std, 0));
    let campaign = Campaign {
        robot: &case.robot,
        prior: Some(&model),
        unknowns: &unknowns,
        measured: &Measurements { rows, noise_is_stated: true, markers: 0, names: BTreeMap::new() },
        name: "measured.csv",
        settings: FitSettings::default(),
        folds: 0,
    };
    carry_out(&campaign, None, |_, _, _| String::new()).unwrap()
}

#[test]
fn positions_by_readings_of_calibrated_winches_are_as_exact_as_the_summary_says() {
    let drawn_with = [(SensorError::LengthOffset, 0.02), (SensorError::DrumScale, 2e-3)];
    let exact = Noise { position: Some(1e-9), rotation: Some(1e-9), length: Some(1e-9), ..EXTERNAL };
    for case in cases().iter().filter(|case| ["CAROCA", "IPAnema"].contains(&case.name)) {
        let (mut squares, mut count) = (0.0, 0.0);
        for seed in 1..=4 {
            let made = calibrated(
                case,
                rows(case, &drawn_with, EXTERNAL, seed),
                &drawn_with.map(|(error, _)| (error, None)),
            );
            let std = made.summary.position_std_after.unwrap();
            let number = |name: String| made.summary.sensors[&name].after;
            for row in rows(case, &drawn_with, exact, seed) {
                let length = |(i, read): (usize, &f64)| {
                    (read - number(format!("length_offset{}", i + 1)))
                        / (1.0 + number(format!("drum_scale{}", i + 1)))
                };
                let lengths: Vec<f64> =
                    row.lengths.as_ref().unwrap().iter().enumerate().map(length).collect();
                let at = Axis::ALL.map(|axis| row.value(Quantity::Position(axis)).unwrap());
                let near = Pose { rotation: row.rotation.unwrap(), ..Pose::at(at[0], at[1], at[2]) };
                let problem = DirectProblem::new(&made.robot, &lengths, &Load::none()).unwrap();
                let found = problem.direct(DirectStart::Pose(&near)).unwrap().equilibrium.pose;
                squares += (found.position - near.position).norm_squared() / (std * std);
                count += 3.0;
            }
        }
        let ratio = (squares / count).sqrt();
        assert!((0.6..1.6).contains(&ratio), "{}: {ratio}", case.name);
    }
}

#[test]
fn offsets_that_are_known_leave_the_accuracy_as_it_is_and_unknown_ones_lessen_it() {
    let case = &cases()[0];
    let rows = rows(case, &[], EXTERNAL, 1);
    let std = |errors: &[(SensorError, Option<f64>)]| {
        calibrated(case, rows.clone(), errors).summary.position_std_after.unwrap()
    };
    let without = std(&[]);
    let known = std(&[(SensorError::LengthOffset, Some(1e-9)), (SensorError::DrumScale, Some(1e-9))]);
    assert!((known / without - 1.0).abs() < 1e-3, "{known} {without}");
    let unknown = std(&[(SensorError::LengthOffset, None)]);
    assert!(unknown > 1.001 * without, "{unknown} {without}");
    let summary = calibrated(case, rows.clone(), &[(SensorError::LengthOffset, None)]).summary;
    assert!(summary.position_std_before.is_none() && summary.workspace.is_some());
}
