//! What a calibration can tell, against perturbed robots.

use crate::common::caroca;
use cdpr_calibration::{
    AtWork, Calibration, CauseValue, Combination, Criterion, Identifiability, Measurement, ParameterValue,
};
use cdpr_robot::{Parameter, Pose, Rotation3, Vector3};
use cdpr_statics::{DirectProblem, DirectStart, Load, WantedPose, deflection, direct, inverse};
use cdpr_study::{ERRORS_FORMAT, ErrorModel, ErrorsFile, error_model};
use nalgebra::DMatrix;

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
        let parts = combination.weights.iter().take(4).map(|of| format!("{:+.2} {}", of.value, of.cause));
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
            let of = |CauseValue { cause, value }: &CauseValue| ParameterValue {
                parameter: cause.parse().unwrap(),
                value: *value,
            };
            combination.weights.iter().map(of).filter(|weight| weight.value.abs() > 1e-4).collect()
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
                for CauseValue { cause, value } in &combination.weights {
                    let index = all.iter().position(|other| other.to_string() == *cause).unwrap();
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

/// Two exit points on a block, and correlated deviations as a fit leaves them.
fn correlated() -> ErrorModel {
    let names = ["b1.x", "b1.z", "b2.x", "b2.z", "a3.y", "mass"];
    let std = [2e-3, 1e-3, 2e-3, 3e-3, 1e-3, 1.0];
    let correlation = |i: usize, j: usize| if i == j { 1.0 } else { 0.8 - 0.1 * (i + j) as f64 / 2.0 };
    let row = |i: usize| (0..6).map(|j| std[i] * std[j] * correlation(i, j)).collect();
    let file = ErrorsFile {
        format: ERRORS_FORMAT.to_owned(),
        parameters: names.map(str::to_owned).to_vec(),
        mean: vec![0.0; 6],
        covariance: (0..6).map(row).collect(),
    };
    error_model(&file.entries().unwrap(), &caroca()).unwrap()
}

/// `C = (Σ⁻¹ + Σ Jᵀ N⁻² J)⁻¹` of the parameters themselves, and `t C tᵀ` where the robot works.
#[test]
fn correlations_of_what_is_known_before_count() {
    let (robot, load, model) = (caroca(), Load::payload(50.0), correlated());
    let all = Parameter::of(&robot);
    let mut map = DMatrix::<f64>::zeros(all.len(), model.inputs.len());
    for term in &model.terms {
        map[(term.parameter, term.input)] += term.factor * model.inputs[term.input].std();
    }
    let whole = &map * map.transpose();
    let some: Vec<usize> = (0..all.len()).filter(|p| whole[(*p, *p)] > 0.0).collect();
    let prior = DMatrix::from_fn(some.len(), some.len(), |i, j| whole[(some[i], some[j])]);
    assert!((prior[(0, 0)] - 1e0).abs() < 1e-9 && some.len() == 6);
    let slopes = |at: &Pose| {
        let held = deflection(&robot, WantedPose::at(at), &load).unwrap();
        let problem = DirectProblem::new(&robot, &held.lengths, &load).unwrap();
        let pose = problem.derivatives(&held.loaded.equilibrium).unwrap().pose;
        DMatrix::from_fn(6, some.len(), |row, j| pose[(row, some[j])])
    };
    let work = Pose::at(0.5, 0.2, 1.8);
    let t = slopes(&work).rows(0, 3).into_owned();
    for (noise, measured) in [(1e-4, &poses()[..2]), (1e-3, &poses()[3..8]), (10.0, &poses()[..1])] {
        let mut calibration = Calibration::of_model(&robot, &model).unwrap();
        calibration.add_work(&work, &load, AtWork::Position).unwrap();
        let mut information = prior.clone().try_inverse().unwrap();
        for pose in measured {
            let at = Measurement::Pose { position: noise, rotation: Some(noise) };
            calibration.add(pose, &load, &[at]).unwrap();
            let slopes = slopes(pose) / noise;
            information += slopes.transpose() * slopes;
        }
        let left = information.try_inverse().unwrap();
        let quality = calibration.quality(&(0..measured.len()).collect::<Vec<_>>());
        let expected = ((&t * &left * t.transpose()).trace() / 3.0).sqrt();
        let at_work = quality.mean_at_work.unwrap();
        println!("noise {noise}: {at_work} m at work, {expected} m");
        assert!((at_work / expected - 1.0).abs() < 1e-6, "{at_work} {expected}");
        let found = calibration.identify(0..measured.len());
        assert_eq!(found.identifiable.len() + found.unidentifiable.len(), model.inputs.len());
        let mut squares: f64 = 0.0;
        for (k, of) in found.remaining.iter().enumerate() {
            let expected = (left[(k, k)] / prior[(k, k)]).sqrt();
            assert!((of.value / expected - 1.0).abs() < 1e-6, "{}: {} {expected}", of.parameter, of.value);
            squares += expected * expected / 6.0;
        }
        assert!((quality.parameters / squares.sqrt() - 1.0).abs() < 1e-6);
        // The best pose for the parameters is the one that leaves least of them.
        let best = calibration.plan(1, Criterion::Parameters, 1);
        let all = (0..measured.len()).map(|pose| calibration.quality(&[pose]).parameters);
        assert!((best.quality.parameters / all.fold(f64::INFINITY, f64::min) - 1.0).abs() < 1e-9);
    }
}

/// The plans are searched for each number of poses; sets that grow need more.
#[test]
fn the_number_of_poses_that_is_needed_is_the_least_whose_plan_suffices() {
    let mut calibration = calibration(&[50.0], &[NOISE]);
    for x in [-1.0, 0.0, 1.0] {
        calibration.add_work(&Pose::at(x, 0.3, 1.7), &Load::payload(50.0), AtWork::Position).unwrap();
    }
    for criterion in [Criterion::Information, Criterion::MeanAtWork, Criterion::WorstAtWork] {
        let plans: Vec<_> = (1..=9).map(|count| calibration.plan(count, criterion, 1)).collect();
        let left: Vec<f64> = plans.iter().map(|plan| plan.quality.at_work(criterion).unwrap()).collect();
        let worst = criterion == Criterion::WorstAtWork;
        assert_eq!(left[3] == plans[3].quality.worst_at_work.unwrap(), worst);
        for wanted in left.iter().map(|left| left * (1.0 + 1e-9)).chain([0.0]) {
            let expected = left.iter().position(|left| *left <= wanted).map(|k| k + 1);
            let reaches = |of: &cdpr_calibration::Quality| of.at_work(criterion).unwrap() <= wanted;
            assert_eq!(calibration.needed(9, criterion, reaches), expected, "{criterion:?} {left:?}");
        }
        // No plan is worse than the outermost poses.
        let corners = plans.iter().map(|plan| plan.corners.at_work(criterion).unwrap());
        let is_worse = corners.zip(&left).any(|(corners, left)| corners < *left);
        assert!(!is_worse || criterion == Criterion::Information, "{criterion:?}");
    }
}
