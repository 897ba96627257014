//! Synthetic campaigns whose truth is known.

use crate::common::{Case, EXTERNAL, cases};
use cdpr_calibration::{
    Fit, FitSettings, Noise, Quantity, RobustLoss, Row, SensorError, Unknowns, fit, simulate,
};
use cdpr_evidence::accept;
use cdpr_robot::{Axis, CableEnd, Parameter};
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;
use rand_distr::StandardNormal;
use std::time::Instant;

/// Deviations drawn from the tolerances.
fn truth(case: &Case, seed: u64) -> Vec<f64> {
    let mut random = ChaCha8Rng::seed_from_u64(seed);
    case.stds.iter().map(|std| std * random.sample::<f64, _>(StandardNormal)).collect()
}

fn campaign(case: &Case, deviations: &[f64], poses: usize, noise: Noise, seed: u64) -> Vec<Row> {
    simulate(&case.simulated(deviations, &case.poses(poses), noise, seed)).unwrap()
}

/// Campaigns with each robot: all of the record by `CDPR_CAMPAIGNS=200`.
fn campaigns(few: u64) -> u64 {
    std::env::var("CDPR_CAMPAIGNS").map_or(few, |count| count.parse().unwrap())
}

/// Whether each identifiable parameter lies in its 95 % region.
fn covered(fit: &Fit, truth: &[f64]) -> Vec<bool> {
    let parameters = Parameter::of(&fit.robot);
    let inside = |estimate: &cdpr_calibration::Estimate| {
        let index = parameters.iter().position(|p| p.to_string() == estimate.name)?;
        Some((estimate.value - truth[index]).abs() <= 1.959_964 * estimate.std?)
    };
    fit.estimates.iter().filter(|estimate| estimate.is_identifiable()).filter_map(inside).collect()
}

/// Share of `count` trials that 95 % may miss: four standard deviations, as if each campaign with its many
/// parameters were one trial of a few.
fn tolerance(campaigns: u64) -> f64 {
    4.0 * (0.95 * 0.05 / (3.0 * campaigns as f64)).sqrt()
}

#[test]
fn the_truth_lies_in_the_stated_regions_as_often_as_stated() {
    let campaigns = campaigns(8);
    for case in cases() {
        let (mut inside, mut all, mut chi, mut degrees, mut stuck) = (0, 0, 0.0, 0, 0);
        let mut seconds = 0.0;
        let mut near = 0;
        for seed in 0..campaigns {
            let truth = truth(&case, 100 + seed);
            let rows = campaign(&case, &truth, 30, EXTERNAL, seed);
            let unknowns = Unknowns::of_model(&case.model());
            let clock = Instant::now();
            let found = fit(&case.robot, &rows, &unknowns, &FitSettings::default()).unwrap();
            seconds += clock.elapsed().as_secs_f64();
            stuck += usize::from(!found.converged());
            near = near.max(found.steps);
            let covered = covered(&found, &truth);
            inside += covered.iter().filter(|inside| **inside).count();
            all += covered.len();
            chi += found.chi_square;
            degrees += found.degrees_of_freedom;
        }
        let (share, ratio) = (inside as f64 / all as f64, chi / degrees as f64);
        println!(
            "{}: {campaigns} campaigns, {:.2} % of {all} in their regions, chi-square per degree {ratio:.4}, \
             {stuck} not converged, {near} steps at most, {:.3} s a campaign",
            case.name,
            100.0 * share,
            seconds / campaigns as f64
        );
        accept("V-CALIBRATION-003", (share - 0.95).abs() / tolerance(campaigns));
        let spread = (2.0 / degrees as f64).sqrt();
        assert!((ratio - 1.0).abs() < 4.0 * spread, "{}: {ratio}", case.name);
        assert!(stuck as f64 <= 0.05 * campaigns as f64, "{}: {stuck}", case.name);
    }
}

/// How a campaign is made worse than its model.
#[derive(Clone, Copy, Debug)]
enum Trouble {
    /// 5 % of the numbers are off by up to 50 standard deviations; the loss is Cauchy's.
    Outliers,
    /// Winches count from elsewhere (20 mm): the offsets are sought, too.
    Biases,
    /// The truth is 3 tolerances off in every parameter, which have no prior.
    FarStart,
}

#[test]
fn campaigns_with_outliers_biases_and_far_starts_converge_or_say_that_they_have_not() {
    let campaigns = campaigns(2);
    for case in cases() {
        for trouble in [Trouble::Outliers, Trouble::Biases, Trouble::FarStart] {
            let (mut inside, mut all, mut converged, mut steps) = (0, 0, 0, 0);
            let (mut chi, mut degrees) = (0.0, 0);
            let mut reasons: Vec<String> = Vec::new();
            for seed in 0..campaigns {
                let mut random = ChaCha8Rng::seed_from_u64(1000 + seed);
                let mut truth = truth(&case, 300 + seed);
                if matches!(trouble, Trouble::FarStart) {
                    let sign = |t: &f64| 3.0 * f64::signum(*t);
                    truth = truth.iter().zip(&case.stds).map(|(t, std)| sign(t) * std).collect();
                }
                let mut rows = campaign(&case, &truth, 40, EXTERNAL, seed);
                let mut unknowns = Unknowns::of_model(&case.model());
                let mut settings = FitSettings::default();
                match trouble {
                    Trouble::Outliers => {
                        settings.loss = RobustLoss::Cauchy;
                        for reading in rows.iter_mut().flat_map(|row| &mut row.readings) {
                            let is_off = random.random_range(0.0..1.0) < 0.05;
                            if is_off && !matches!(reading.quantity, Quantity::Rotation(_)) {
                                reading.value += reading.std * random.random_range(-50.0..50.0);
                            }
                        }
                    }
                    Trouble::Biases => {
                        let n = case.robot.cables.len();
                        let offset: Vec<f64> = (0..n).map(|_| random.random_range(-0.02..0.02)).collect();
                        for row in &mut rows {
                            let lengths = row.lengths.as_mut().unwrap().iter_mut();
                            lengths.zip(&offset).for_each(|(length, offset)| *length += offset);
                        }
                        unknowns.add(&case.robot, SensorError::LengthOffset, None, 0);
                    }
                    Trouble::FarStart => {
                        let parameters = Parameter::of(&case.robot);
                        let names = parameters.iter().zip(&case.stds).filter(|(_, std)| **std > 0.0);
                        let names: Vec<String> = names.map(|(p, _)| p.to_string()).collect();
                        let names: Vec<&str> = names.iter().map(String::as_str).collect();
                        unknowns = Unknowns::free(&case.robot, &names).unwrap();
                    }
                }
                match fit(&case.robot, &rows, &unknowns, &settings) {
                    Ok(found) => {
                        converged += u64::from(found.converged());
                        steps = steps.max(found.steps);
                        if !found.converged() {
                            reasons.push(format!("{:.0e} std away", found.distance));
                        } else {
                            let covered = covered(&found, &truth);
                            chi += found.chi_square;
                            degrees += found.degrees_of_freedom;
                            inside += covered.iter().filter(|inside| **inside).count();
                            all += covered.len();
                        }
                    }
                    Err(error) => reasons.push(error.to_string()),
                }
            }
            println!(
                "{}, {trouble:?}: {converged} of {campaigns} converged, {:.2} % of {all} in their regions, \
                 chi-square per degree {:.3}, {steps} steps at most; {reasons:?}",
                case.name,
                100.0 * inside as f64 / all as f64,
                chi / degrees as f64
            );
            // All end, most at a minimum.
            assert_eq!(converged as usize + reasons.len(), campaigns as usize);
            assert!(2 * converged >= campaigns, "{}, {trouble:?}: {reasons:?}", case.name);
        }
    }
}

#[test]
fn outliers_are_named_and_hardly_count_under_a_robust_loss() {
    let case = &cases()[0];
    let truth = truth(case, 7);
    let mut rows = campaign(case, &truth, 30, EXTERNAL, 7);
    let clean = fit(&case.robot, &rows, &Unknowns::of_model(&case.model()), &FitSettings::default()).unwrap();
    // 5 % of the numbers are off by 10 mm.
    for row in [3, 11, 17, 26] {
        rows[row].readings[row % 3].value += 0.01;
    }
    let unknowns = Unknowns::of_model(&case.model());
    let with = |loss| {
        let settings = FitSettings { loss, ..FitSettings::default() };
        fit(&case.robot, &rows, &unknowns, &settings).unwrap()
    };
    let (squares, cauchy) = (with(RobustLoss::Squares), with(RobustLoss::Cauchy));
    let lines: Vec<usize> = cauchy.outliers().iter().map(|outlier| outlier.line).collect();
    assert_eq!(
        {
            let mut l = lines[..4].to_vec();
            l.sort_unstable();
            l
        },
        [4, 12, 18, 27],
        "{lines:?}"
    );
    let off = |fit: &Fit| {
        let pairs = fit.estimates.iter().zip(&clean.estimates);
        pairs.map(|(a, b)| ((a.value - b.value) / b.std.unwrap()).powi(2)).sum::<f64>().sqrt()
    };
    println!("moved by outliers: squares {:.2}, Cauchy {:.2} std", off(&squares), off(&cauchy));
    assert!(squares.p_value().unwrap() < 1e-9);
    assert!(off(&cauchy) < 0.2 * off(&squares), "{} {}", off(&cauchy), off(&squares));
}

#[test]
fn offsets_of_winches_and_load_cells_are_found_without_any_pose() {
    let case = &cases()[1];
    let truth = vec![0.0; case.stds.len()];
    let noise = Noise { length: Some(2e-4), tension: Some(1.0), ..Noise::default() };
    let mut rows = campaign(case, &truth, 60, noise, 3);
    let (offsets, biases) =
        ([8e-3, -5e-3, 3e-3, 0.0, 6e-3, -2e-3, 4e-3, -7e-3], [15.0, -8.0, 0.0, 5.0, 9.0, -20.0, 3.0, 7.0]);
    for row in &mut rows {
        row.lengths.as_mut().unwrap().iter_mut().zip(offsets).for_each(|(length, offset)| *length += offset);
        for reading in &mut row.readings {
            if let Quantity::Tension(i, CableEnd::Anchor) = reading.quantity {
                reading.value += biases[i];
            }
        }
    }
    let mut unknowns = Unknowns::free(&case.robot, &["mass"]).unwrap();
    unknowns.add(&case.robot, SensorError::LengthOffset, None, 0);
    unknowns.add(&case.robot, SensorError::TensionBias, None, 0);
    let clock = Instant::now();
    let found = fit(&case.robot, &rows, &unknowns, &FitSettings::default()).unwrap();
    println!("{} rows, {} steps in {:.2} s", rows.len(), found.steps, clock.elapsed().as_secs_f64());
    assert!(found.converged() && found.p_value().unwrap() > 1e-3, "{}", found.chi_square);
    for (k, wanted) in offsets.iter().chain(&biases).enumerate() {
        let of = &found.estimates[k + 1];
        let std = of.std.unwrap();
        assert!((of.value - wanted).abs() < 4.5 * std, "{} {} {wanted} {std}", of.name, of.value);
    }
}

#[test]
fn a_tracker_anywhere_is_found_with_the_robot() {
    let case = &cases()[0];
    let truth = truth(case, 21);
    let mut rows = campaign(case, &truth, 30, EXTERNAL, 21);
    let turn = cdpr_robot::Rotation3::from_euler_angles(0.4, -0.9, 2.0);
    let origin = cdpr_robot::Vector3::new(7.0, -3.0, 1.0);
    for row in &mut rows {
        let at = Axis::ALL.map(|axis| row.value(Quantity::Position(axis)).unwrap());
        let seen = turn * cdpr_robot::Vector3::from(at) + origin;
        for reading in &mut row.readings {
            if let Quantity::Position(axis) = reading.quantity {
                reading.value = seen[axis as usize];
            }
        }
        row.rotation = row.rotation.map(|rotation| turn * rotation);
    }
    let mut unknowns = Unknowns::of_model(&case.model());
    unknowns.add(&case.robot, SensorError::Frame, None, 0);
    let found = fit(&case.robot, &rows, &unknowns, &FitSettings::default()).unwrap();
    assert!(found.converged() && found.p_value().unwrap() > 1e-3, "{}", found.chi_square);
    assert!((found.origin - origin).norm() < 0.02, "{}", found.origin);
    assert!(found.frame.angle_to(&turn) < 5e-3);
}

#[test]
fn the_same_numbers_come_from_any_number_of_threads() {
    let case = &cases()[0];
    let rows = campaign(case, &truth(case, 9), 40, EXTERNAL, 9);
    let unknowns = Unknowns::of_model(&case.model());
    let with = |threads| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        pool.install(|| fit(&case.robot, &rows, &unknowns, &FitSettings::default()).unwrap())
    };
    let (one, three) = (with(1), with(3));
    assert_eq!(one.estimates, three.estimates);
    assert_eq!(one.covariance, three.covariance);
}
