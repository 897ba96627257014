//! Tables of measurements, and what is sought in them: noise that depends on other noise, groups, bounds.

use crate::common::{Case, EXTERNAL, caroca, cases};
use cdpr_calibration::{
    CalibrationSummary, Campaign, Fit, FitSettings, FitStatus, Measurements, Noise, Quantity, Row, Unknowns,
    carry_out, cross_validated, drawn, fit, read_measurements, simulate, write_measurements,
};
use cdpr_robot::{Axis, Parameter, Robot};
use cdpr_study::error_model;
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;
use rand_distr::StandardNormal;
use std::collections::BTreeMap;

fn campaign(case: &Case, poses: usize, noise: Noise, seed: u64) -> Vec<Row> {
    simulate(&case.simulated(&drawn(&case.model(), seed), &case.poses(poses), noise, seed)).unwrap()
}

fn fitted(case: &Case, rows: &[Row]) -> Fit {
    fit(&case.robot, rows, &Unknowns::of_model(&case.model()), &FitSettings::default()).unwrap()
}

/// Noise of x and y with the correlation 0.98, whose difference is therefore known far better.
#[test]
fn covariances_of_noise_count() {
    const CORRELATION: f64 = 0.98;
    let case = &cases()[0];
    let quiet = Noise { position: Some(1e-9), rotation: Some(1e-4), length: None, ..Noise::default() };
    let mut rows = campaign(case, 60, quiet, 5);
    let mut random = ChaCha8Rng::seed_from_u64(5);
    for row in &mut rows {
        let [u, v]: [f64; 2] = [0; 2].map(|_| random.sample(StandardNormal));
        let noise = [u, CORRELATION * u + (1.0 - CORRELATION.powi(2)).sqrt() * v, 0.0];
        for reading in &mut row.readings {
            if let Quantity::Position(axis) = reading.quantity {
                reading.value += 1e-3 * noise[axis.index()];
                reading.std = if axis == Axis::Z { 1e-4 } else { 1e-3 };
            }
        }
    }
    let without = fitted(case, &rows);
    let [x, y] = [Axis::X, Axis::Y].map(Quantity::Position);
    rows.iter_mut().for_each(|row| row.covariances = vec![(y, x, CORRELATION * 1e-6)]);
    let with = fitted(case, &rows);
    let ratio = with.chi_square / with.degrees_of_freedom as f64;
    let std = |fit: &Fit| fit.estimates.iter().map(|of| of.std.unwrap().ln()).sum::<f64>();
    println!(
        "chi-square per degree {ratio:.3} with covariances, {:.3} without; stds smaller by {:.3}",
        without.chi_square / without.degrees_of_freedom as f64,
        ((std(&with) - std(&without)) / with.estimates.len() as f64).exp()
    );
    // z has no noise: its 60 numbers, a sixth of all, add nothing.
    let degrees = with.degrees_of_freedom as f64;
    assert!(ratio < 1.0 && ratio > 1.0 - 60.0 / degrees - 4.0 * (2.0 / degrees).sqrt(), "{ratio}");
    assert!(std(&with) < std(&without));
    // What is printed of a number is its own residual, not that of a combination.
    let of = |fit: &Fit| fit.before.iter().map(|of| of.difference).collect::<Vec<_>>();
    assert_eq!(of(&with), of(&without));
}

fn read(text: &str, noise: &[(&str, f64)]) -> Measurements {
    let noise: Vec<_> = noise.iter().map(|(name, std)| ((*name).to_owned(), *std)).collect();
    read_measurements(text.as_bytes(), &caroca(), &noise).unwrap()
}

#[test]
fn covariances_are_read_by_row_and_for_all_rows() {
    let noise = [("position", 1e-4), ("rotation", 1e-4)];
    let all = [&noise[..], &[("cov_x_m_y_m", 5e-9)]].concat();
    let stated = read("x_m,y_m,z_m\n1,2,1\n1,1,2\n", &all);
    let by_row = read("x_mm,y_m,z_m,cov_y_mm_x_m\n1000,2,1,5e-6\n1000,1,2,5e-6\n", &noise);
    let [x, y] = [Axis::X, Axis::Y].map(Quantity::Position);
    for (one, other) in stated.rows.iter().zip(&by_row.rows) {
        assert_eq!(one.covariances, [(x, y, 5e-9)]);
        assert_eq!(other.covariances, [(x, y, 5e-9)]);
    }
    let json = r#"{"format": "cdpr-measurements/1", "noise": {"position": 1e-4, "cov_x_m_y_m": -5e-9},
        "rows": [{"x_m": 1, "y_m": 2, "z_m": null}]}"#;
    let found = read(json, &[]);
    assert_eq!(found.rows[0].covariances, [(x, y, -5e-9)]);
    assert_eq!(found.rows[0].readings.len(), 2);
    let turned = "qw,qx,qy,qz,std_rx_rad,cov_rx_rad_ry_rad\n1,0,0,0,2e-4,1e-8\n";
    let found = read(turned, &noise);
    assert_eq!(found.rows[0].readings.iter().map(|of| of.std).collect::<Vec<_>>(), [2e-4, 1e-4, 1e-4]);
    assert_eq!(found.rows[0].covariances.len(), 1);
    let plain = read("x_mm,y_m,z_m\n1000.5,2,\n,1,2\n", &noise);
    for text in [
        "X [mm];Y [m];Z (m);note\n1000,5;2;;moved\n;1;2;\n",
        "sep=\t\nt\tx_mm\ty_m\tz_m\r\n0\t1000.5\t2\t\r\n1\t\t1\t2\r\n",
    ] {
        for (one, other) in plain.rows.iter().zip(&read(text, &noise).rows) {
            assert_eq!(one.readings, other.readings, "{text}");
        }
    }
    for (text, words) in [
        ("x_m,y_m,cov_x_m_y_m\n1,2,2e-8\n", "line 2: the covariances make no positive definite matrix"),
        ("x_m,y_m,cov_x_m_why\n1,2,0\n", "column cov_x_m_why: expected a name"),
        ("x_m,y_m,rx_rad\n1,2,0\n", "column rx_rad: expected qw, qx, qy, qz"),
        ("x_m,y_m\n1,two\n2,3\n4,5\n", "line 2, column y_m: `two`: expected a number"),
        ("x_m,y_m\n1,nan\n", "line 2, column y_m: `nan`: expected a finite number, or an empty cell"),
        ("x_m,speed_m_s\n1,2\n", "column speed_m_s: expected a name"),
        ("x_m,l1_m,l2_m\n1,2,2\n", "column l3_m is missing: expected lengths of all cables"),
        (
            "x_m,std_x_m\n1,-1\n",
            "line 2, column std_x_m: -1: expected a standard deviation from 1e-15 to 1e15",
        ),
    ] {
        let noise: Vec<_> = noise.iter().map(|(name, std)| ((*name).to_owned(), *std)).collect();
        let error = read_measurements(text.as_bytes(), &caroca(), &noise).unwrap_err().to_string();
        assert!(error.contains(words), "`{words}` is not in: {error}");
    }
}

/// CAROCA as a model of a hundredth of its size, with a hundred thousandth of its mass.
fn small() -> Robot {
    let mut robot = caroca();
    for cable in &mut robot.cables {
        cable.exit_point *= 0.01;
        cable.anchor_point *= 0.01;
    }
    robot.platform.mass *= 1e-5;
    robot
}

/// What has no noise counts as exact for the robot, not for a robot of metres and kilonewtons.
#[test]
fn columns_without_noise_are_exact_on_the_scale_of_the_robot() {
    let stds = |robot: &Robot, text: &str| {
        let noise = [("rotation".to_owned(), 1e-4)];
        let rows = read_measurements(text.as_bytes(), robot, &noise).unwrap().rows;
        rows[0].readings.iter().map(|reading| reading.std).collect::<Vec<_>>()
    };
    let [x, tension] = stds(&caroca(), "x_m,t1_kn,roll_deg\n1,0.9,0\n1,-1.1,0\n")[..2] else { panic!() };
    assert!((0.5e-6..2e-6).contains(&x) && (0.5e-3..2e-3).contains(&tension), "{x} m, {tension} N");
    let [x, tension] = stds(&small(), "x_mm,t1_n,roll_deg\n10,8e-3,0\n10,9e-3,0\n")[..2] else { panic!() };
    assert!(x < 2e-8 && tension < 2e-8, "{x} m, {tension} N");
    // Slack cables leave the weight as a scale.
    let slack = stds(&small(), "t1_n,roll_deg\n0,0\n")[0];
    assert!((1e-10..1e-7).contains(&slack), "{slack} N");
}

#[test]
fn the_names_of_the_columns_state_the_order_of_a_quaternion() {
    let turned = read("z_m,qw,qx,qy,qz\n1,0.0871557,0,0,0.9961947\n", &[("rotation", 1e-4)]);
    let angle = turned.rows[0].rotation.unwrap().angle();
    assert!((angle.to_degrees() - 170.0).abs() < 1e-4, "{angle}");
}

#[test]
fn pulleys_in_a_block_have_one_radius_and_one_uncertainty() {
    let case = &cases()[2];
    let model = case.model();
    let rows = campaign(case, 30, EXTERNAL, 8);
    let mut unknowns = Unknowns::of_model(&model);
    let before = unknowns.all.len();
    unknowns.share(&case.robot, "r1+r2+r3+r4").unwrap();
    unknowns.share(&case.robot, "r5+r6+r7+r8").unwrap();
    assert_eq!(unknowns.all.len(), before - 6);
    let found = fit(&case.robot, &rows, &unknowns, &FitSettings::default()).unwrap();
    let parameters = Parameter::of(&case.robot);
    let at = |name: &str| parameters.iter().position(|p| p.to_string() == name).unwrap();
    let covariance = found.parameter_covariance();
    let deviation = |name| found.deviations[at(name)];
    assert!(deviation("r1") != 0.0 && (deviation("r1") - deviation("r4")).abs() < 1e-15);
    assert!((deviation("r1") - deviation("r5")).abs() > 1e-9);
    let (one, other) = (at("r1"), at("r4"));
    let variance = covariance[(one, one)];
    assert!((covariance[(one, other)] / variance - 1.0).abs() < 1e-9);

    // The posterior has this variance alone: the prior of the other pulleys of the block is used up.
    let folder = tempfile::tempdir().unwrap();
    let out = folder.path().join("out");
    let campaign = cdpr_calibration::Campaign {
        robot: &case.robot,
        prior: Some(&model),
        unknowns: &unknowns,
        measured: &Measurements { rows, noise_is_stated: true, markers: 0, names: BTreeMap::new() },
        name: "measurements.csv",
        settings: FitSettings::default(),
        folds: 0,
    };
    carry_out(&campaign, Some((&out, cdpr_study::IfExists::Refuse)), |_, _, _| String::new()).unwrap();
    let posterior: serde_json::Value =
        serde_json::from_str(&std::fs::read_to_string(out.join("posterior.json")).unwrap()).unwrap();
    let names: Vec<&str> =
        posterior["parameters"].as_array().unwrap().iter().map(|name| name.as_str().unwrap()).collect();
    let k = names.iter().position(|name| *name == "r4").unwrap();
    let left = posterior["covariance"][k][k].as_f64().unwrap();
    assert!((left / variance - 1.0).abs() < 1e-9, "{left} {variance}");

    let poses = std::fs::read_to_string(out.join("poses.csv")).unwrap();
    assert_eq!(poses.lines().count(), 31);
    let first: Vec<f64> =
        poses.lines().nth(1).unwrap().split(',').map(|cell| cell.parse().unwrap()).collect();
    assert_eq!(first[1..4], *found.poses[0].position.as_slice());
    let error = unknowns.share(&case.robot, "r1+lead").unwrap_err().to_string();
    assert_eq!(
        error,
        "share is r1+lead: expected parameters that are sought, or groups of them: r, or r1+r2"
    );
}

/// A robot that is 5 kg heavier than its file, with a mass that may deviate by 1 kg.
#[test]
fn bounds_hold_and_are_named() {
    let case = &cases()[0];
    let mut truth = vec![0.0; case.stds.len()];
    let robot: &Robot = &case.robot;
    let mass = Parameter::of(robot).iter().position(|p| *p == Parameter::Mass).unwrap();
    truth[mass] = 5.0;
    let noise = Noise { tension: Some(1.0), ..EXTERNAL };
    let rows = simulate(&case.simulated(&truth, &case.poses(20), noise, 1)).unwrap();
    let with = |bounds: Option<[f64; 2]>| {
        let mut unknowns = Unknowns::free(robot, &["mass"]).unwrap();
        bounds.iter().for_each(|bounds| unknowns.bound(robot, "mass", *bounds).unwrap());
        fit(robot, &rows, &unknowns, &FitSettings::default()).unwrap()
    };
    let (free, bound) = (with(None), with(Some([-1.0, 1.0])));
    let of = &free.estimates[0];
    assert!((of.value - 5.0).abs() < 4.0 * of.std.unwrap(), "{}", of.value);
    assert_eq!(bound.estimates[0].value, 1.0);
    assert!(bound.chi_square > 2.0 * free.chi_square);
    // It counts as known there.
    assert_eq!(bound.estimates[0].std, Some(0.0));
    assert_eq!(bound.covariance[(0, 0)], 0.0);
    assert!(bound.estimates[0].is_identifiable());
    // A start outside of the bounds is moved into them.
    let inside = with(Some([4.0, 6.0]));
    assert!((inside.estimates[0].value - of.value).abs() < 1e-6);
    let mut unknowns = Unknowns::free(robot, &["mass"]).unwrap();
    let wrong = unknowns.bound(robot, "mass", [1.0, -1.0]).unwrap_err().to_string();
    assert_eq!(wrong, "bounds of mass is 1:-1: expected least:greatest");
    let wrong = unknowns.bound(robot, "r", [-1.0, 1.0]).unwrap_err().to_string();
    assert_eq!(wrong, "bounds is r: expected the name of something that is sought");
}

#[test]
fn a_row_is_predicted_by_the_others_alone() {
    let case = &cases()[1];
    let mut rows = campaign(case, 20, EXTERNAL, 2);
    let unknowns = Unknowns::of_model(&case.model());
    let settings = FitSettings::default();
    let clean = cross_validated(&case.robot, &rows, &unknowns, &settings, 20).unwrap();
    // Six numbers of each row, each predicted once.
    assert_eq!(clean.len(), 20 * 6);
    rows[7].readings[0].value += 1e-3;
    let with = cross_validated(&case.robot, &rows, &unknowns, &settings, 20).unwrap();
    let of = |all: &[cdpr_calibration::Difference]| {
        let is = |of: &&cdpr_calibration::Difference| {
            of.row == 0 && of.line == 8 && of.quantity == Quantity::Position(Axis::X)
        };
        all.iter().find(is).unwrap().difference
    };
    // The millimetre appears whole in the row that has it, as if it were not in the fit.
    assert!((of(&with) - of(&clean) - 1e-3).abs() < 1e-12, "{} {}", of(&with), of(&clean));
}

#[test]
fn starts_from_elsewhere_end_at_the_same_robot() {
    let case = &cases()[1];
    let rows = campaign(case, 20, EXTERNAL, 3);
    let unknowns = Unknowns::of_model(&case.model());
    let with = |starts| {
        let settings = FitSettings { starts, ..FitSettings::default() };
        fit(&case.robot, &rows, &unknowns, &settings).unwrap()
    };
    let (one, four) = (with(1), with(4));
    assert_eq!((one.starts, four.starts), ([1, 1], [4, 4]));
    assert_eq!((one.status, four.status), (FitStatus::OneStart, FitStatus::Converged));
    for (one, other) in one.estimates.iter().zip(&four.estimates) {
        assert!((one.value - other.value).abs() < 1e-4 * one.std.unwrap());
    }
}

#[test]
fn only_identifiable_parameters_move_and_the_others_keep_their_laws() {
    let case = &cases()[1];
    let rows = campaign(case, 20, EXTERNAL, 4);
    let unknowns = Unknowns::of_model(&case.model());
    let settings = FitSettings { only_identifiable: true, ..FitSettings::default() };
    let found = fit(&case.robot, &rows, &unknowns, &settings).unwrap();
    assert!(found.unidentifiable.is_empty() && found.estimates.len() < unknowns.all.len());
    let parameters = Parameter::of(&case.robot);
    for (index, parameter) in parameters.iter().enumerate() {
        let is_sought = found.estimates.iter().any(|of| of.name == parameter.to_string());
        assert_eq!(found.deviations[index] != 0.0, is_sought, "{parameter}");
    }
    // Each of them is told by the data alone.
    assert!(found.estimates.iter().all(cdpr_calibration::Estimate::is_identifiable));
}

#[test]
fn cables_without_a_column_of_their_own_count_as_not_measured_and_are_named() {
    let missing = |header: &str| {
        let cells = vec!["1"; header.split(',').count()].join(",");
        let read = read_measurements(format!("{header}\n{cells}\n").as_bytes(), &caroca(), &[]);
        let columns = read.unwrap().not_measured(&caroca());
        columns.iter().map(Quantity::to_string).collect::<Vec<_>>().join(",")
    };
    assert_eq!(missing("t1_n,t2_n,t4_n,t5_n,t6_n,t7_n,t8_n"), "t3_n");
    assert_eq!(
        missing("t1_winch_n,t2_winch_n,t3_winch_n,t4_winch_n,t5_winch_n,t6_winch_n"),
        "t7_winch_n,t8_winch_n"
    );
    assert_eq!(missing("t1_n,t2_n,t3_n,t4_n,t5_n,t6_n,t7_n,t8_n,x_m"), "");
    assert_eq!(missing("x_m,y_m,z_m"), "");
    let lengths = read_measurements(b"l1_m,l2_m,l4_m\n1,1,1\n", &caroca(), &[]).unwrap_err().to_string();
    assert_eq!(lengths, "column l3_m is missing: expected lengths of all cables, or of none");
}

/// Masses are known to whole kilograms: what is drawn, and the prior, have these steps.
#[test]
fn steps_of_deviations_are_those_of_the_study() {
    let robot = caroca();
    let text =
        r#"{"mass": {"law": {"normal": {"mean": 0, "std": 0.5}}, "steps": {"nearest": {"step": 1.0}}}}"#;
    let model = error_model(&serde_json::from_str(text).unwrap(), &robot).unwrap();
    let mass = |seed| drawn(&model, seed).into_iter().fold(0.0, |sum: f64, of| sum + of.abs());
    let all: Vec<f64> = (0..20).map(mass).collect();
    assert!(all.iter().all(|of| of.fract() == 0.0) && all.contains(&1.0) && all.contains(&0.0), "{all:?}");
    let std = model.inputs[0].std();
    assert!((std / 0.5 - 1.0).abs() > 0.1, "{std}");
    let unknown = &Unknowns::of_model(&model).all[0];
    let [mean, of_prior] = unknown.prior.unwrap();
    assert!(unknown.scale == std && of_prior == std && mean.abs() < 1e-15, "{unknown:?}");
}

/// Priors count where noise is not stated: it is what the residuals show.
#[test]
fn noise_that_is_not_stated_is_estimated_before_anything_is_judged() {
    let case = &cases()[0];
    let model = case.model();
    let noise = Noise { position: Some(1e-4), rotation: Some(1e-4), length: None, ..Noise::default() };
    let rows = campaign(case, 14, noise, 3);
    let (header, lines) = write_measurements(&rows);
    let lines: Vec<String> = lines.iter().map(|line| line.join(",")).collect();
    let text = format!("{}\n{}\n", header.join(","), lines.join("\n"));
    let fitted = |noise: &[(&str, f64)]| {
        let measured = read(&text, noise);
        let unknowns = Unknowns::of_model(&model);
        let campaign = Campaign {
            robot: &case.robot,
            prior: Some(&model),
            unknowns: &unknowns,
            measured: &measured,
            name: "measured.csv",
            settings: FitSettings::default(),
            folds: 0,
        };
        carry_out(&campaign, None, |_, _, _| String::new()).unwrap().summary
    };
    let count = |of: &CalibrationSummary| of.parameters.values().filter(|of| of.identifiable).count();
    let stated = fitted(&[("position", 1e-4), ("rotation", 1e-4)]);
    let estimated = fitted(&[]);
    println!("{} {} {}", count(&stated), count(&estimated), estimated.noise_scale);
    assert!(count(&estimated).abs_diff(count(&stated)) <= 4);
    assert!((estimated.chi_square / estimated.degrees_of_freedom as f64 - 1.0).abs() < 0.1);
    assert!(estimated.noise_scale > 10.0);
    for (name, of) in &estimated.parameters {
        assert!(of.std.unwrap() <= 1.1 * of.prior_std.unwrap(), "{name}: {of:?}");
        assert!(of.moved_by_prior_std.unwrap().abs() < 4.0, "{name}: {of:?}");
    }
}
