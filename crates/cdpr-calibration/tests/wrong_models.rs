//! Models that leave something out: chi-square says that they do, patterns of residuals say what.

use crate::common::{Case, EXTERNAL, cases};
use cdpr_calibration::{
    Fit, FitSettings, Noise, Quantity, Row, Simulated, Trend, Unknowns, drawn, fit, simulate,
};
use cdpr_robot::{Axis, Parameter, Robot};
use cdpr_statics::Load;
use cdpr_study::ErrorModel;

fn campaign(case: &Case, deviations: &[f64], noise: Noise, load: Load) -> Vec<Row> {
    simulate(&Simulated { load, ..case.simulated(deviations, &case.poses(40), noise, 5) }).unwrap()
}

/// A fit whose chi-square no right model makes, with what its residuals follow.
fn noticed(name: &str, case: &Case, robot: &Robot, model: &ErrorModel, rows: &[Row]) -> (Fit, Vec<Trend>) {
    let found = fit(robot, rows, &Unknowns::of_model(model), &FitSettings::default()).unwrap();
    let trends = found.trends();
    println!(
        "{name}, {}: chi-square {:.3e} with {} degrees of freedom; {} trends, the clearest {:?}; splits {:?}",
        case.name,
        found.chi_square,
        found.degrees_of_freedom,
        trends.len(),
        trends.first().map(|of| (of.column.clone(), of.against, of.correlation)),
        found.splits().first().map(|split| split.ratio.clone())
    );
    assert!(found.p_value().unwrap() < 1e-9, "{name}, {}: {}", case.name, found.chi_square);
    (found, trends)
}

/// A robot whose file has all that the truth has.
#[test]
fn right_models_raise_no_alarm() {
    for case in cases() {
        let rows = campaign(&case, &drawn(&case.model(), 5), EXTERNAL, Load::none());
        let unknowns = Unknowns::of_model(&case.model());
        let found = fit(&case.robot, &rows, &unknowns, &FitSettings::default()).unwrap();
        assert!(found.p_value().unwrap() > 1e-4, "{}: {}", case.name, found.chi_square);
        assert!(found.trends().is_empty(), "{}: {:?}", case.name, found.trends());
    }
}

#[test]
fn pulleys_that_the_model_leaves_out_show_against_place() {
    for case in cases().iter().filter(|case| matches!(case.name, "IPAnema" | "GRAB")) {
        let truth = drawn(&case.model(), 5);
        let rows = simulate(&case.simulated(&truth, &case.poses(60), EXTERNAL, 5)).unwrap();
        let mut without = case.robot.clone();
        without.cables.iter_mut().for_each(|cable| cable.pulley = None);
        let of = |p: &Parameter| if matches!(p.group(), "a" | "b") { 2e-3 } else { 0.0 };
        let stds: Vec<f64> = Parameter::of(&without).iter().map(of).collect();
        let model = ErrorModel::normal(&without, &stds);
        let (_, trends) = noticed("pulleys left out", case, &without, &model, &rows);
        assert!(trends.iter().any(|trend| trend.against == "place"), "{}", case.name);
    }
}

/// Loading with one modulus, unloading with another: what a cable with hysteresis does between two loads.
#[test]
fn one_modulus_for_a_cable_with_hysteresis_shows_in_consecutive_rows() {
    let noise = Noise { displacement: Some(1e-5), ..EXTERNAL };
    for case in cases().iter().filter(|case| matches!(case.name, "CAROCA" | "CoGiRo" | "IPAnema")) {
        let truth = drawn(&case.model(), 5);
        let modulus = Parameter::of(&case.robot).iter().position(|p| *p == Parameter::YoungsModulus).unwrap();
        let stiffer = |share: f64| {
            let mut deviations = truth.clone();
            deviations[modulus] += share * Parameter::YoungsModulus.nominal(&case.robot);
            campaign(case, &deviations, noise, Load::payload(50.0))
        };
        // Half of the poses is visited with growing, half with falling load.
        let (loading, unloading) = (stiffer(-0.05), stiffer(0.05));
        let rows: Vec<Row> = loading[..20].iter().chain(&unloading[20..]).cloned().collect();
        let (found, _) = noticed("one modulus", case, &case.robot, &case.model(), &rows);
        // By Gauss and Newton alone it takes 200 steps with CAROCA, and 95 with CoGiRo.
        println!("{} steps, {:.1e} std away", found.steps, found.distance);
        assert!(found.steps <= 60, "{}: {} steps", case.name, found.steps);
        // Means of consecutive rows do not average out.
        let splits = found.splits();
        let greatest = splits.iter().filter_map(|split| split.ratio.get("displacement").copied());
        let greatest = greatest.fold(0.0, f64::max);
        println!("variance of means of displacements over that of independent rows: {greatest:.1}");
        assert!(greatest > 2.0, "{}: {greatest}", case.name);
    }
}

#[test]
fn a_coordinate_with_the_wrong_sign_is_named() {
    for case in cases() {
        let right = campaign(&case, &drawn(&case.model(), 5), EXTERNAL, Load::none());
        for axis in [Axis::Y, Axis::Z] {
            let mut rows = right.clone();
            flip(&mut rows, Quantity::Position(axis));
            let unknowns = Unknowns::of_model(&case.model());
            let error = fit(&case.robot, &rows, &unknowns, &FitSettings::default()).unwrap_err().to_string();
            let words = format!("column {axis}_m: expected the other sign");
            assert!(error.starts_with(&words), "{}: {error}", case.name);
        }
    }
}

/// Neighbours whose lengths differ little, behind long leads and over pulleys.
#[test]
fn two_lengths_that_are_swapped_are_named_behind_leads_and_pulleys() {
    for case in cases() {
        let mut case = case.within(0.5 * case.half);
        case.robot.cables.iter_mut().enumerate().for_each(|(i, cable)| cable.lead = 2.0 + 0.5 * i as f64);
        let of = |p: &Parameter| if matches!(p.group(), "a" | "b") { 2e-3 } else { 0.0 };
        case.stds = Parameter::of(&case.robot).iter().map(of).collect();
        let poses = case.poses(12);
        let deviations = vec![0.0; case.stds.len()];
        let rows = simulate(&case.simulated(&deviations, &poses, EXTERNAL, 5)).unwrap();
        for [i, j] in [[0, 1], [1, 2], [2, 3]] {
            let mut rows = rows.clone();
            rows.iter_mut().flat_map(|row| &mut row.lengths).for_each(|lengths| lengths.swap(i, j));
            let unknowns = Unknowns::of_model(&case.model());
            let found = fit(&case.robot, &rows, &unknowns, &FitSettings::default());
            let error = found.map_or_else(|error| error.to_string(), |_| "none".to_owned());
            let words = format!("column l{}_m and l{}_m: expected them the other way round", i + 1, j + 1);
            assert!(error.starts_with(&words), "{} {i} {j}: {error}", case.name);
        }
    }
}

/// Cables of FAST sag by more than its rotations change their lengths.
#[test]
fn positions_in_another_unit_and_inverse_rotations_are_named() {
    for case in cases() {
        let deviations = vec![0.0; case.stds.len()];
        let rows = simulate(&case.simulated(&deviations, &case.poses(12), EXTERNAL, 5)).unwrap();
        let unknowns = Unknowns::of_model(&case.model());
        let refused = |rows: &[Row]| {
            let found =
                fit(&case.robot, rows, &unknowns, &FitSettings { starts: 1, ..FitSettings::default() });
            found.map_or_else(|error| error.to_string(), |_| "none".to_owned())
        };
        for (factor, words) in [(1e-3, "expected 1000 times"), (1e3, "expected the values divided by 1000")] {
            let mut rows = rows.clone();
            for reading in rows.iter_mut().flat_map(|row| &mut row.readings) {
                if matches!(reading.quantity, Quantity::Position(_)) {
                    reading.value *= factor;
                }
            }
            let error = refused(&rows);
            assert!(error.contains(words), "{} {factor}: {error}", case.name);
        }
        let mut turned = rows.clone();
        turned.iter_mut().for_each(|row| row.rotation = row.rotation.map(|of| of.inverse()));
        let error = refused(&turned);
        assert!(case.name == "FAST" || error.contains("the inverse rotation"), "{}: {error}", case.name);
    }
}

#[test]
fn lengths_without_the_leads_of_the_robot_are_named() {
    for case in cases().iter().filter(|case| case.name != "FAST") {
        let mut case = case.within(0.5 * case.half);
        case.robot.cables.iter_mut().enumerate().for_each(|(i, cable)| cable.lead = 4.0 + 0.5 * i as f64);
        let of = |p: &Parameter| if matches!(p.group(), "a" | "b") { 2e-3 } else { 0.0 };
        case.stds = Parameter::of(&case.robot).iter().map(of).collect();
        let (poses, deviations) = (case.poses(12), vec![0.0; case.stds.len()]);
        let mut rows = simulate(&case.simulated(&deviations, &poses, EXTERNAL, 5)).unwrap();
        let unknowns = Unknowns::of_model(&case.model());
        let fitted = |rows: &[Row]| fit(&case.robot, rows, &unknowns, &FitSettings::default());
        assert!(fitted(&rows).is_ok(), "{}", case.name);
        for lengths in rows.iter_mut().flat_map(|row| &mut row.lengths) {
            lengths.iter_mut().zip(&case.robot.cables).for_each(|(length, cable)| *length -= cable.lead);
        }
        let error = fitted(&rows).map_or_else(|error| error.to_string(), |_| "none".to_owned());
        let words = "column l1_m to l";
        assert!(
            error.starts_with(words) && error.contains("the lead of each cable"),
            "{}: {error}",
            case.name
        );
    }
}

fn flip(rows: &mut [Row], quantity: Quantity) {
    for reading in rows.iter_mut().flat_map(|row| &mut row.readings) {
        if reading.quantity == quantity {
            reading.value = -reading.value;
        }
    }
}

#[test]
fn a_displacement_with_the_wrong_sign_shows_in_its_own_column() {
    let noise = Noise { displacement: Some(1e-5), ..EXTERNAL };
    for case in cases().iter().filter(|case| matches!(case.name, "CAROCA" | "CoGiRo" | "FAST")) {
        let load = Load::payload(if case.name == "FAST" { 2000.0 } else { 50.0 });
        let mut rows = campaign(case, &drawn(&case.model(), 5), noise, load);
        rows.truncate(16);
        let quantity = Quantity::Displacement(Axis::Z);
        flip(&mut rows, quantity);
        let (found, _) = noticed("wrong sign", case, &case.robot, &case.model(), &rows);
        let of_column = found.outliers().iter().take(16).filter(|of| of.quantity == quantity).count();
        println!("{of_column} of the 16 farthest numbers are of this column");
        assert!(of_column >= 12, "{}: {of_column}", case.name);
    }
}
