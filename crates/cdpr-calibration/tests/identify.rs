//! What a calibration can tell, against perturbed robots.

use crate::common::caroca;
use cdpr_calibration::{Calibration, Combination, Identifiability, Measurement, ParameterValue};
use cdpr_robot::{Parameter, Pose, Rotation3, Vector3};
use cdpr_statics::{DirectStart, Load, direct, inverse};

const NOISE: Measurement = Measurement::Pose { position: 1e-4, rotation: Some(1e-4) };

/// One standard deviation of each kind of parameter.
fn uncertainties() -> Vec<f64> {
    let one = |parameter: &Parameter| match parameter.group() {
        "mass" => 1.0,
        "linear_density" => 1e-3,
        "youngs_modulus" => 5e9,
        "dt" => 5.0,
        _ => 2e-3,
    };
    Parameter::of(&caroca()).iter().map(one).collect()
}

/// Turned platforms among them: unturned ones do not tell anchor points from exit points.
fn poses() -> Vec<Pose> {
    let grid = |i: usize| [-1.0, 0.0, 1.0][i % 3];
    (0..27)
        .map(|i| {
            let position = Vector3::new(2.0 * grid(i), 1.1 * grid(i / 3), 1.6 + 0.7 * grid(i / 9));
            let turn = 0.1 * Vector3::new(grid(i / 2), grid(i / 5), grid(i / 7));
            Pose { position, rotation: Rotation3::new(turn) }
        })
        .collect()
}

fn calibration(payloads: &[f64], measurements: &[Measurement]) -> Calibration {
    let mut calibration = Calibration::new(&caroca(), &uncertainties()).unwrap();
    for payload in payloads {
        for pose in poses() {
            calibration.add(&pose, &Load::payload(*payload), measurements).unwrap();
        }
    }
    calibration
}

fn print(title: &str, found: &Identifiability) {
    println!(
        "{title}: {} combinations identifiable, {} not",
        found.identifiable.len(),
        found.unidentifiable.len()
    );
    for combination in found
        .identifiable
        .iter()
        .take(2)
        .chain(found.identifiable.iter().rev().take(2))
        .chain(&found.unidentifiable)
    {
        let parts = combination.weights.iter().take(4).map(|of| format!("{:+.2} {}", of.value, of.parameter));
        println!("  {:9.2e}: {}", combination.signal_to_noise, parts.collect::<Vec<_>>().join(" "));
    }
}

#[test]
fn poses_identify_neither_offsets_of_tensions_nor_with_one_payload_the_scale_of_all_forces() {
    let robot = caroca();
    let uncertainties = uncertainties();
    let all = Parameter::of(&caroca());
    for payloads in [&[0.0][..], &[50.0], &[0.0, 50.0]] {
        let found = calibration(payloads, &[NOISE]).identify(0..54);
        print(&format!("poses under {payloads:?} kg"), &found);
        let weights = |combination: &Combination| -> Vec<ParameterValue> {
            combination.weights.iter().copied().filter(|weight| weight.value.abs() > 1e-4).collect()
        };
        let (offsets, scale): (Vec<_>, Vec<_>) = found
            .unidentifiable
            .iter()
            .map(weights)
            .partition(|weights| weights[0].parameter.group() == "dt");
        assert!(offsets.len() == 8 && offsets.iter().all(|weights| weights.len() == 1));
        // One payload acts as a part of the platform's mass; two tell the scale of all weights and forces.
        assert_eq!(scale.len(), 2 - payloads.len());
        for weights in scale {
            let relative = weights.iter().map(|ParameterValue { parameter, value }| {
                let index = all.iter().position(|other| other == parameter).unwrap();
                let known = if *parameter == Parameter::Mass { payloads[0] } else { 0.0 };
                value * uncertainties[index] / (parameter.nominal(&robot) + known)
            });
            let relative: Vec<f64> = relative.collect();
            assert_eq!(relative.len(), 3);
            assert!(relative.iter().all(|r| (r / relative[0] - 1.0).abs() < 1e-5), "{relative:?}");
        }
    }
}

#[test]
fn a_change_along_a_combination_shows_as_its_signal_says() {
    let robot = caroca();
    let load = Load::payload(50.0);
    let calibration = calibration(&[50.0], &[NOISE]);
    let found = calibration.identify(0..27);
    let uncertainties = uncertainties();
    let all = Parameter::of(&caroca());
    for combination in [&found.identifiable[0], &found.identifiable[30], &found.identifiable[45]] {
        let change = 1e-3;
        let mut squares = 0.0;
        for pose in poses() {
            let lengths = inverse(&robot, &pose, &Load::none()).unwrap().lengths;
            let nominal = direct(&robot, &lengths, &load, DirectStart::Pose(&pose)).unwrap().equilibrium;
            let stands = |sign: f64| {
                let mut deviations = vec![0.0; all.len()];
                for ParameterValue { parameter, value } in &combination.weights {
                    let index = all.iter().position(|other| other == parameter).unwrap();
                    deviations[index] = sign * change * value * uncertainties[index];
                }
                let moved = robot.perturbed(&deviations).unwrap().robot;
                direct(&moved, &lengths, &load, DirectStart::Near(&nominal)).unwrap().equilibrium.pose
            };
            squares += (stands(-1.0).motion_to(&stands(1.0)) / (2.0 * change * 1e-4)).norm_squared();
        }
        let signal = squares.sqrt();
        println!("signal over noise {signal} by differences, {} exact", combination.signal_to_noise);
        assert!((signal / combination.signal_to_noise - 1.0).abs() < 1e-3);
    }
}

#[test]
fn measuring_more_leaves_less() {
    let few = calibration(&[50.0], &[NOISE]).identify(0..5);
    let many = calibration(&[50.0], &[NOISE]).identify(0..27);
    let all = calibration(&[50.0], &[NOISE, Measurement::Tensions(5.0)]).identify(0..27);
    print("poses and tensions", &all);
    for ((few, many), all) in few.remaining.iter().zip(&many.remaining).zip(&all.remaining) {
        let [few, many, all] = [few, many, all].map(|parameter| parameter.value);
        assert!(many <= few + 1e-9 && all <= many + 1e-9 && few <= 1.0 + 1e-9);
    }
    // Offsets of set-points change lengths, which are given here.
    assert!(all.unidentifiable.len() == 8 && many.unidentifiable.len() == 9);
    assert!(calibration(&[50.0], &[NOISE]).identify([]).identifiable.is_empty());
}

/// Lengths that are not exact leave more uncertainty the less exact they are, and in the end all of it but
/// for what six coordinates of a pose and eight tensions say besides eight lengths.
#[test]
fn noise_of_lengths_leaves_more() {
    let left = |measurements: &[Measurement]| calibration(&[50.0], measurements).identify(0..27).remaining;
    let mean = |found: &[ParameterValue]| {
        (found.iter().map(|one| one.value.powi(2)).sum::<f64>() / found.len() as f64).sqrt()
    };
    let both = [NOISE, Measurement::Tensions(5.0)];
    for measured in [&both[..1], &both] {
        let mut before = left(measured);
        for noise in [1e-9, 1e-5, 2e-4, 1e-2, 1e3] {
            let after = left(&[measured, &[Measurement::Lengths(noise)]].concat());
            let all = before.iter().zip(&after);
            assert!(all.clone().all(|(before, after)| after.value >= before.value - 1e-9));
            println!("{} with lengths to {noise:e} m: {:.4}", measured.len(), mean(&after));
            if noise == 1e-9 {
                assert!(all.clone().all(|(before, after)| after.value - before.value < 1e-6));
            }
            before = after;
        }
        let nothing = mean(&before) > 0.999;
        assert_eq!(nothing, measured.len() == 1);
    }
}

/// The covariance by differences of the direct model: `S = N² + σ² L Lᵀ`, `C⁻¹ = 1 + Σ U Jᵀ S⁻¹ J U`.
#[test]
fn what_is_left_is_that_of_differences() {
    let (robot, load, sigma) = (caroca(), Load::payload(50.0), 3e-4);
    let uncertainties = uncertainties();
    let count = uncertainties.len();
    let mut information = nalgebra::DMatrix::<f64>::identity(count, count);
    for pose in &poses()[..6] {
        let lengths = inverse(&robot, pose, &Load::none()).unwrap().lengths;
        let nominal = direct(&robot, &lengths, &load, DirectStart::Pose(pose)).unwrap().equilibrium;
        let shown = |robot: &cdpr_robot::Robot, lengths: &[f64]| {
            let at = direct(robot, lengths, &load, DirectStart::Near(&nominal)).unwrap().equilibrium;
            let motion = nominal.pose.motion_to(&at.pose) / 1e-4;
            nalgebra::DVector::from_iterator(
                14,
                motion.iter().copied().chain(at.tensions().iter().map(|tension| tension / 5.0)),
            )
        };
        let central = |of: &dyn Fn(f64) -> nalgebra::DVector<f64>| (of(1e-2) - of(-1e-2)) / 2e-2;
        let parameters: Vec<_> = (0..count)
            .map(|j| {
                central(&|step| {
                    let mut deviations = vec![0.0; count];
                    deviations[j] = step * uncertainties[j];
                    // Set-points are given as lengths.
                    let moved = robot.perturbed(&deviations).unwrap().robot;
                    shown(&moved, &lengths)
                })
            })
            .collect();
        let of_lengths: Vec<_> = (0..8)
            .map(|i| {
                central(&|step| {
                    let mut changed = lengths.clone();
                    changed[i] += step * sigma;
                    shown(&robot, &changed)
                })
            })
            .collect();
        let [shown, moved] = [parameters, of_lengths].map(|of| nalgebra::DMatrix::from_columns(&of));
        let noise = nalgebra::DMatrix::identity(14, 14) + &moved * moved.transpose();
        information += shown.transpose() * noise.cholesky().unwrap().solve(&shown);
    }
    let covariance = information.cholesky().unwrap().inverse();
    let measured = [NOISE, Measurement::Tensions(5.0), Measurement::Lengths(sigma)];
    let found = calibration(&[50.0], &measured).identify(0..6);
    for (j, ParameterValue { parameter, value }) in found.remaining.iter().enumerate() {
        let expected = covariance[(j, j)].sqrt();
        assert!((value / expected - 1.0).abs() < 1e-4, "{parameter}: {value} {expected}");
    }
}

#[test]
fn the_best_poses_identify_more_than_the_first_and_their_information_adds_up() {
    let calibration = calibration(&[50.0], &[NOISE]);
    let bits = |poses: &[usize]| {
        let found = calibration.identify(poses.iter().copied());
        found.identifiable.iter().map(|c| 0.5 * (1.0 + c.signal_to_noise.powi(2)).log2()).sum::<f64>()
    };
    let best = calibration.best_poses(6);
    let numbers: Vec<usize> = best.iter().map(|chosen| chosen.pose).collect();
    let sum: f64 = best.iter().map(|chosen| chosen.information).sum();
    assert!((sum / bits(&numbers) - 1.0).abs() < 1e-6);
    assert!(best.windows(2).all(|pair| pair[1].information <= pair[0].information + 1e-9));
    println!("six best of 27 {numbers:?}: {sum:.1} bit; the first six: {:.1} bit", bits(&[0, 1, 2, 3, 4, 5]));
    assert!(sum > bits(&[0, 1, 2, 3, 4, 5]));
    assert_eq!(calibration.best_poses(100).len(), 27);
}

#[test]
fn measurements_of_any_precision_have_their_information() {
    for noise in [1e-6, 1e-9, 1e-12, 1e-15] {
        let exact = Measurement::Pose { position: noise, rotation: Some(noise) };
        let calibration = calibration(&[50.0], &[exact, Measurement::Tensions(5e4 * noise)]);
        let found = calibration.identify(0..27);
        let values = found.identifiable.iter().map(|combination| combination.signal_to_noise);
        let expected: f64 = values.map(|s| 0.5 * (1.0 + s * s).log2()).sum();
        let chosen = calibration.best_poses(27);
        let sum: f64 = chosen.iter().map(|pose| pose.information).sum();
        println!("noise {noise:e}: {sum:.3} bit of 27 poses, {expected:.3} by singular values");
        assert!((sum / expected - 1.0).abs() < 1e-6, "noise {noise:e}: {sum} bit, expected {expected}");
        // No pose is without information, not even the last one.
        assert!(chosen.iter().all(|pose| pose.information > 0.0), "noise {noise:e}");
    }
}

#[test]
fn invalid_inputs_are_named() {
    let mut wrong = uncertainties();
    wrong[3] = -1.0;
    let text = Calibration::new(&caroca(), &wrong).unwrap_err().to_string();
    assert_eq!(
        text,
        "uncertainties[3] is -1: expected a finite number, zero or more, for each of the 62 parameters"
    );
    let mut calibration = Calibration::new(&caroca(), &uncertainties()).unwrap();
    let pose = Pose::at(0.0, 0.0, 1.75);
    let refused = |noise: f64, calibration: &mut Calibration| {
        calibration.add(&pose, &Load::none(), &[Measurement::Lengths(noise)]).unwrap_err().to_string()
    };
    assert_eq!(
        refused(0.0, &mut calibration),
        "noise is 0: expected a standard deviation from 1e-15 to 1e15, in SI units"
    );
    assert!(refused(1e-3, &mut calibration).starts_with("noise is of length alone: expected position"));
    assert!(calibration.add(&Pose::at(0.0, 0.0, 9.0), &Load::none(), &[NOISE]).is_err());
    assert!(calibration.best_poses(3).is_empty());
}
