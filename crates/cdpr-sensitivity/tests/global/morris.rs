//! Elementary effects: exact values, SALib's, failures, steps and unbounded inputs.

use super::functions;
use crate::common::{rows, uniform, unit};
use approx::{assert_abs_diff_eq, assert_relative_eq};
use cdpr_evidence::accept;
use cdpr_sensitivity::{
    Input, Law, MorrisDesign, MorrisEffect, SampleDesign, SensitivityError, Steps, morris_effects, observe,
};

#[derive(serde::Deserialize)]
struct Reference {
    morris: ReferenceEffects,
}

#[derive(serde::Deserialize)]
struct ReferenceEffects {
    levels: Vec<[u32; 3]>,
    mean: Vec<f64>,
    mean_absolute: Vec<f64>,
    std: Vec<f64>,
}

fn effects(design: &MorrisDesign, model: impl Fn(&[f64]) -> f64 + Sync) -> Vec<MorrisEffect> {
    morris_effects(design, &observe(design, |x| Some(model(x))).unwrap(), 0.95).unwrap()
}

#[test]
fn effects_of_trajectories_are_those_of_salib() {
    let text = include_str!("../../../../data/reference/indices.json");
    let reference = serde_json::from_str::<Reference>(text).unwrap().morris;
    let units = rows(&MorrisDesign::trajectories(unit(3), 6, 4, 1).unwrap(), 1);
    for (unit, levels) in units.iter().zip(&reference.levels) {
        unit.iter().zip(levels).for_each(|(u, &level)| assert_eq!(*u, f64::from(level) / 3.0));
    }
    let function = functions::ishigami();
    let design = MorrisDesign::trajectories(function.inputs, 6, 4, 1).unwrap();
    for (i, effect) in effects(&design, function.model).iter().enumerate() {
        // Differences of outputs of the order 10.
        accept("V-STATISTICS-004", (effect.mean - reference.mean[i]).abs());
        accept("V-STATISTICS-004", (effect.mean_absolute.value - reference.mean_absolute[i]).abs());
        accept("V-STATISTICS-004", (effect.std - reference.std[i]).abs());
    }
}

#[test]
fn each_row_of_a_trajectory_moves_one_input_by_half_the_levels() {
    for (levels, jump) in [(2, 1.0), (4, 2.0 / 3.0), (6, 0.6)] {
        let design = MorrisDesign::trajectories(unit(5), 40, levels, 3).unwrap();
        for block in rows(&design, 1).chunks(6) {
            let mut moved = [0; 5];
            for pair in block.windows(2) {
                for input in 0..5 {
                    let change = pair[1][input] - pair[0][input];
                    if change != 0.0 {
                        assert_abs_diff_eq!(change.abs(), jump, epsilon = 1e-15);
                        moved[input] += 1;
                    }
                }
            }
            assert_eq!(moved, [1; 5]);
        }
    }
}

#[test]
fn a_linear_model_has_its_slopes_times_the_ranges_and_no_spread() {
    let slopes = [5.0, -3.0, 0.0];
    let model = |x: &[f64]| x.iter().zip(slopes).map(|(x, b)| b * x).sum();
    let inputs = uniform(3, -1.0, 3.0);
    for design in [
        MorrisDesign::trajectories(inputs.clone(), 10, 4, 1).unwrap(),
        MorrisDesign::radial(inputs, 10, 1).unwrap(),
    ] {
        for (effect, b) in effects(&design, model).iter().zip(slopes) {
            // A radial step may be small: a thousandth loses three digits.
            assert_abs_diff_eq!(effect.mean, 4.0 * b, epsilon = 1e-11);
            assert_abs_diff_eq!(effect.mean_absolute.value, 4.0 * b.abs(), epsilon = 1e-11);
            assert_abs_diff_eq!(effect.std, 0.0, epsilon = 1e-11);
        }
    }
}

#[test]
fn intervals_of_95_percent_hold_the_exact_mean_in_95_of_100_studies() {
    // On four levels |4 x - 2| is 2, 2/3, 2/3, 2, of mean 4/3, and each step changes it by 4/3 over 2/3.
    let a = [0.0, 1.0, 4.5, 9.0, 99.0];
    let factor = |a: f64| (4.0 / 3.0 + a) / (1.0 + a);
    let all: f64 = a.iter().map(|&a| factor(a)).product();
    let mut held = [0; 5];
    for seed in 0..100 {
        let function = functions::sobol_g();
        let design = MorrisDesign::trajectories(function.inputs, 100, 4, seed).unwrap();
        for ((held, effect), a) in held.iter_mut().zip(effects(&design, function.model)).zip(a) {
            let exact = 2.0 / (1.0 + a) * all / factor(a);
            let interval = effect.mean_absolute;
            *held += usize::from(interval.low <= exact && exact <= interval.high);
            assert!(effect.mean.abs() < interval.value);
        }
    }
    // Three deviations of 2.2 below 95, and the mean of all at 93.
    assert!(held.iter().sum::<usize>() >= 465 && held.iter().all(|&held| held >= 88), "{held:?}");
}

#[test]
fn the_groups_of_morris_function_are_told_apart() {
    let function = functions::morris();
    for design in [
        MorrisDesign::trajectories(function.inputs.clone(), 40, 4, 2).unwrap(),
        MorrisDesign::radial(function.inputs.clone(), 40, 2).unwrap(),
    ] {
        let found = effects(&design, &function.model);
        // Morris 1991, figure 1: inputs 8 to 10 act linearly, 1 to 7 with others or curved, 11 to 20 hardly.
        for (i, effect) in found.iter().enumerate() {
            let (strength, spread) = (effect.mean_absolute.value, effect.std);
            match i + 1 {
                1..=7 => assert!(strength > 15.0 && spread > 15.0, "{effect:?}"),
                8..=10 => assert!(strength > 30.0 && spread < 10.0, "{effect:?}"),
                _ => assert!(strength < 10.0 && spread < 10.0, "{effect:?}"),
            }
        }
    }
}

#[test]
fn a_failed_observation_takes_its_effects_with_it() {
    let radial = MorrisDesign::radial(unit(3), 8, 1).unwrap();
    let mut outputs = observe(&radial, |x| Some(x[0])).unwrap();
    // The centre of block 0, and x2 of block 1.
    (outputs[0], outputs[6]) = (None, None);
    let found = morris_effects(&radial, &outputs, 0.9).unwrap();
    let counts: Vec<_> = found.iter().map(|effect| (effect.effects, effect.failed)).collect();
    assert_eq!(counts, [(7, 1), (6, 2), (7, 1)]);
    assert_relative_eq!(found[0].mean, 1.0, epsilon = 1e-12);

    // An inner point of a trajectory is the end of two effects.
    let walk = MorrisDesign::trajectories(unit(3), 8, 4, 1).unwrap();
    let mut outputs = observe(&walk, |x| Some(x[0])).unwrap();
    outputs[1] = None;
    let found = morris_effects(&walk, &outputs, 0.9).unwrap();
    assert_eq!(found.iter().map(|effect| effect.failed).sum::<usize>(), 2);
    assert_eq!(found.iter().map(|effect| effect.effects).sum::<usize>(), 22);

    let few: Vec<_> = outputs.iter().enumerate().map(|(i, y)| if i < 4 { *y } else { None }).collect();
    let error = morris_effects(&walk, &few, 0.9).unwrap_err();
    assert!(error.to_string().contains("elementary effects = "), "{error}");
}

#[test]
fn the_effect_of_a_stepped_input_is_over_what_its_value_has_moved() {
    // Two of eight points in one level of three do not move it: they have no effect, and no infinite one.
    let law = Law::Uniform { min: 0.0, max: 1.0 };
    let input = Input::stepped("x", law, Steps::Nearest { step: 0.5 });
    let design = MorrisDesign::radial(vec![input], 64, 1).unwrap();
    let found = effects(&design, |x| 3.0 * x[0]);
    assert!(found[0].effects < 64 && found[0].failed == 0, "{found:?}");
    assert_relative_eq!(found[0].mean, 3.0, epsilon = 1e-12);
    assert_abs_diff_eq!(found[0].std, 0.0, epsilon = 1e-12);
}

#[test]
fn unbounded_inputs_have_radial_points_or_trajectories_on_the_middles_of_parts() {
    let law = Law::Normal { mean: 2.0, std: 0.1 };
    let normal = vec![Input::continuous("x", law)];
    let walk = MorrisDesign::trajectories([normal.clone(), unit(1)].concat(), 64, 4, 1).unwrap();
    let levels = [0.125, 0.375, 0.625, 0.875].map(|u| law.quantile(u));
    for row in rows(&walk, 1) {
        assert!(levels.iter().any(|level| (row[0] - level).abs() < 1e-12), "{row:?}");
        assert!([0.0, 1.0 / 3.0, 2.0 / 3.0, 1.0].iter().any(|level| (row[1] - level).abs() < 1e-12));
    }
    // Per probability, a linear effect is the difference of quantiles half a probability apart, times two.
    let found = effects(&walk, |x| x[0] + x[1]);
    let steps = [levels[2] - levels[0], levels[3] - levels[1]];
    assert!((steps[0] - steps[1]).abs() < 1e-9);
    assert_relative_eq!(found[0].mean, 2.0 * steps[0], max_relative = 1e-6);
    assert_relative_eq!(found[1].mean, 1.0, epsilon = 1e-12);
    let found = effects(&MorrisDesign::radial(normal, 64, 1).unwrap(), |x| x[0]);
    assert!(found[0].mean > 0.25 && found[0].mean.is_finite());
}

#[test]
fn replicates_rows_and_refusals() {
    let walk = MorrisDesign::trajectories(unit(3), 4, 4, 1).unwrap();
    let radial = MorrisDesign::radial(unit(3), 4, 1).unwrap();
    for design in [walk, radial] {
        assert_eq!((design.seed(), design.points(), design.blocks()), (Some(1), 16, 4));
        assert_ne!(rows(&design, 1), rows(&design.replicate(2), 1));
        assert_eq!(rows(&design, 1), rows(&design.replicate(2).replicate(1), 1));
    }
    let field = |error| match error {
        SensitivityError::OutOfRange { field, .. } | SensitivityError::InvalidParameter { field, .. } => {
            field
        }
        other => panic!("{other}"),
    };
    assert_eq!(field(MorrisDesign::trajectories(unit(3), 4, 3, 1).unwrap_err()), "levels");
    assert_eq!(field(MorrisDesign::trajectories(unit(3), 4, 0, 1).unwrap_err()), "levels");
    assert_eq!(field(MorrisDesign::trajectories(unit(3), 1, 4, 1).unwrap_err()), "trajectories");
    assert_eq!(field(MorrisDesign::trajectories(vec![], 4, 4, 1).unwrap_err()), "inputs");
    assert_eq!(field(MorrisDesign::radial(unit(3), 1, 1).unwrap_err()), "blocks");
}

#[test]
fn a_constant_output_has_no_effects_and_a_value_that_is_not_finite_is_an_error() {
    let design = MorrisDesign::radial(unit(2), 4, 1).unwrap();
    for effect in effects(&design, |_| 1.5) {
        assert_eq!((effect.mean, effect.mean_absolute.high, effect.std), (0.0, 0.0, 0.0));
    }
    let mut outputs = vec![Some(0.0); 12];
    outputs[7] = Some(f64::NAN);
    let error = morris_effects(&design, &outputs, 0.9).unwrap_err();
    assert!(matches!(error, SensitivityError::NotFinite { field: "outputs", index: 7, .. }));
}

#[test]
fn the_interval_of_a_mean_that_rests_on_few_effects_is_not_called_reliable() {
    // The last input acts where all others are large: one effect in sixty is not zero.
    let rare = |x: &[f64]| if x[..4].iter().all(|x| *x > 0.64) { x[4] } else { 0.0 };
    let found = |blocks, seed| {
        effects(&MorrisDesign::trajectories(unit(5), blocks, 4, seed).unwrap(), |x| rare(x) + 0.1 * x[0])
    };
    // On four levels each of the four is large half the time: 4 of 64 effects are 1.
    let (mut flagged, mut false_alarms) = (0, 0);
    for seed in 0..100 {
        let effects = found(64, seed);
        flagged += u32::from(!effects[4].reliable);
        false_alarms += u32::from(!effects[0].reliable);
    }
    // Binomial: fewer than 5 of 64 with 1/16, less those without any, 0.61.
    assert!((45..80).contains(&flagged) && false_alarms < 5, "{flagged} {false_alarms}");
    assert!(found(16, 1).iter().all(|effect| !effect.reliable));
    // Inputs without any effect, and linear ones.
    let linear = effects(&MorrisDesign::radial(unit(3), 32, 1).unwrap(), |x| x[0] - x[1]);
    assert!(linear.iter().all(|effect| effect.reliable));
}
