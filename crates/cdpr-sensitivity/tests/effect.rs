//! Effects of inputs: exact answers, failed observations, and why t does not show significance on Sobol'
//! points.

use crate::common::rows;
use approx::assert_relative_eq;
use cdpr_sensitivity::{
    EffectSums, IndependentSample, Input, Law, RandomDesign, Replicate, SampleDesign, SensitivityError,
    SobolDesign, Steps, effect_intervals, observe, student_effects,
};

const SLOPES: [f64; 6] = [3.0, -1.0, 0.5, 0.0, 2.0, -0.25];

fn inputs(count: usize) -> Vec<Input> {
    // Ranges of different lengths, off the origin.
    let law = |i: usize| Law::Uniform { min: i as f64 - 1.0, max: 2.0 * i as f64 + 1.0 };
    (0..count).map(|i| Input::continuous(format!("x{i}"), law(i))).collect()
}

fn outputs(design: &impl SampleDesign, model: impl Fn(&[f64]) -> Option<f64> + Sync) -> Vec<Option<f64>> {
    observe(design, model).unwrap()
}

fn linear(row: &[f64]) -> Option<f64> {
    Some(row.iter().zip(SLOPES).map(|(x, slope)| slope * x).sum())
}

#[test]
fn the_effect_of_a_linear_input_is_its_slope_times_half_its_range() {
    let design = SobolDesign::new(inputs(6), 0, 2048).unwrap();
    let effects = student_effects(&design, &outputs(&design, linear)).unwrap().effects;
    for (i, effect) in effects.iter().enumerate() {
        let exact = SLOPES[i] * (i as f64 + 2.0) / 2.0;
        // Four digits of the largest effect, 6.
        assert!((effect.effect - exact).abs() < 6e-3, "{} {} {exact}", effect.input, effect.effect);
        // Point u = 1/2 lies on the middle of all inputs.
        assert_eq!((effect.above, effect.below, effect.on_middle), (1023, 1024, 1));
        assert_relative_eq!(
            effect.mean_above - effect.mean_below,
            effect.effect,
            max_relative = 1e-9,
            epsilon = 1e-12
        );
    }
}

#[test]
fn the_index_is_the_difference_of_means_over_its_standard_error() {
    // Four observations of one input at u = 0, 1/2, 3/4, 1/4: x = -1, 0, 0.5, -0.5.
    let input = Input::continuous("x", Law::Uniform { min: -1.0, max: 1.0 });
    let design = SobolDesign::new(vec![input], 0, 4).unwrap();
    let report = student_effects(&design, &[Some(1.0), Some(10.0), Some(7.0), Some(2.0)]).unwrap();
    let effect = &report.effects[0];
    assert_eq!((effect.above, effect.below, effect.on_middle), (1, 2, 1));
    assert_eq!((effect.mean_above, effect.mean_below, effect.effect), (7.0, 1.5, 5.5));
    // Mean 5, squares 16 + 25 + 4 + 9 = 54: V_g² = 18.
    assert_relative_eq!(effect.student, 5.5 / (18.0_f64 / 2.0 + 18.0).sqrt(), max_relative = 1e-14);
}

#[test]
fn the_index_is_tied_to_that_of_the_pooled_variance() {
    let design = RandomDesign::new(inputs(2), 300, 8).unwrap();
    let outputs = outputs(&design, |row| Some(row[0] + (3.0 * row[1]).sin()));
    let effect = &student_effects(&design, &outputs).unwrap().effects[0];
    let mut squares = 0.0;
    for (row, output) in rows(&design, 1).iter().zip(&outputs) {
        let mean = if row[0] > 0.0 { effect.mean_above } else { effect.mean_below };
        squares += (output.unwrap() - mean).powi(2);
    }
    let n = 300.0;
    let pooled = squares / (n - 2.0) * (1.0 / effect.above as f64 + 1.0 / effect.below as f64);
    let t = effect.student;
    assert_relative_eq!(
        (effect.effect / pooled.sqrt()).powi(2),
        t * t * (n - 2.0) / (n - 1.0 - t * t),
        max_relative = 1e-10
    );
}

#[test]
fn inert_inputs_look_less_than_random_on_sobol_points_so_that_students_significance_does_not_hold() {
    // 16 inputs with an effect, 46 without any, 2000 points, as in the study that found it.
    let model =
        |row: &[f64]| Some(row[..16].iter().enumerate().map(|(i, x)| x * (1.0 + i as f64 / 16.0)).sum());
    let unit = Law::Uniform { min: -1.0, max: 1.0 };
    let inputs: Vec<Input> = (0..62).map(|i| Input::continuous(format!("x{i}"), unit)).collect();
    fn inert(design: &impl IndependentSample, outputs: &[Option<f64>]) -> f64 {
        let effects = student_effects(design, outputs).unwrap().effects;
        effects[16..].iter().map(|effect| effect.student).sum::<f64>() / 46.0
    }
    let sobol = SobolDesign::new(inputs.clone(), 0, 2000).unwrap();
    let on_sobol = inert(&sobol, &outputs(&sobol, model));
    let on_random = (0..10).map(|seed| {
        let random = RandomDesign::new(inputs.clone(), 2000, seed).unwrap();
        inert(&random, &outputs(&random, model))
    });
    let on_random = on_random.sum::<f64>() / 10.0;
    // Mean |t| of independent samples: √(2/π) = 0.798, here over 460 values of standard deviation 0.6.
    assert!((on_random - 0.798).abs() < 0.12, "{on_random}");
    assert!(on_sobol < 0.25, "{on_sobol}");
    println!("mean t of inert inputs: {on_sobol:.3} on Sobol points, {on_random:.3} on random ones");
}

#[test]
fn failed_observations_are_counted_on_their_side_and_take_part_in_no_mean() {
    let design = SobolDesign::new(inputs(2), 1, 255).unwrap();
    let whole = outputs(&design, linear);
    // Every observation in the upper eighth of x0 fails.
    let partial = outputs(&design, |row| if row[0] > 0.75 { None } else { linear(row) });
    let report = student_effects(&design, &partial).unwrap();
    let effect = &report.effects[0];
    assert_eq!(report.outputs.failed, 31);
    assert_eq!((effect.failed_above, effect.failed_below, effect.above, effect.below), (31, 0, 96, 127));
    assert_eq!(report.effects[1].failed_above + report.effects[1].failed_below, 31);
    let all = student_effects(&design, &whole).unwrap();
    assert_relative_eq!(effect.mean_below, all.effects[0].mean_below, max_relative = 1e-12);
    assert!(effect.mean_above < all.effects[0].mean_above);
}

#[test]
fn stepped_values_on_the_very_middle_belong_to_neither_half() {
    let law = Law::Uniform { min: -1.0, max: 1.0 };
    let input = Input::stepped("x", law, Steps::EqualMass { step: 0.5 });
    let design = SobolDesign::scrambled(vec![input], 1000, 1).unwrap();
    let effect = &student_effects(&design, &outputs(&design, |row| Some(row[0]))).unwrap().effects[0];
    // One level of five.
    assert!(effect.on_middle.abs_diff(200) <= 2, "{effect:?}");
    assert_eq!(effect.above + effect.below + effect.on_middle, 1000);
}

#[test]
fn an_output_that_never_changes_shows_no_effect() {
    let design = SobolDesign::new(inputs(2), 0, 16).unwrap();
    for effect in student_effects(&design, &[Some(1.3); 16]).unwrap().effects {
        assert_eq!((effect.effect, effect.student), (0.0, 0.0));
    }
}

#[test]
fn intervals_cover_the_exact_effects_as_often_as_they_say() {
    // y = x0 + x1² of uniform inputs on [-1, 1]: effects 1 and 0; x2 is inert. 64 points each, 5 replicates,
    // 300 studies.
    let unit = Law::Uniform { min: -1.0, max: 1.0 };
    let inputs: Vec<Input> = (0..3).map(|i| Input::continuous(format!("x{i}"), unit)).collect();
    let model = |row: &[f64]| Some(row[0] + row[1] * row[1] + 0.5 * row[0] * row[1] * row[2]);
    fn covered<D: IndependentSample>(
        design: &D,
        study: u64,
        model: impl Fn(&[f64]) -> Option<f64> + Sync,
    ) -> [bool; 3] {
        let replicate = |r| {
            let design = design.replicate(1000 * study + r);
            Replicate { outputs: outputs(&design, &model), design }
        };
        let replicates: Vec<_> = (0..5).map(replicate).collect();
        let intervals = effect_intervals(&replicates, 0.9).unwrap();
        let cover = |i: usize, exact: f64| intervals[i].low <= exact && exact <= intervals[i].high;
        [cover(0, 1.0), cover(1, 0.0), cover(2, 0.0)]
    }
    let sobol = SobolDesign::new(inputs.clone(), 0, 64).unwrap();
    let random = RandomDesign::new(inputs, 64, 0).unwrap();
    let mut counts = [0; 6];
    for study in 0..300 {
        let cover = [covered(&sobol, study, model), covered(&random, study, model)].concat();
        for (count, covered) in counts.iter_mut().zip(cover) {
            *count += i32::from(covered);
        }
    }
    // 270 expected, with a standard deviation of 5.2; the rest is for effects that are not exactly normal.
    assert!(counts.iter().all(|count| (count - 270_i32).abs() < 25), "{counts:?}");
}

#[test]
fn two_replicates_give_the_interval_of_one_degree_of_freedom() {
    let input = Input::continuous("x", Law::Uniform { min: 0.0, max: 1.0 });
    let design = SobolDesign::new(vec![input], 0, 8).unwrap();
    let replicate = |seed| {
        let design = design.replicate(seed);
        Replicate { outputs: outputs(&design, |row| Some(row[0] * row[0])), design }
    };
    let replicates = [replicate(1), replicate(2)];
    let effect = |replicate: &Replicate<SobolDesign>| {
        student_effects(&replicate.design, &replicate.outputs).unwrap().effects[0].effect
    };
    let (one, two) = (effect(&replicates[0]), effect(&replicates[1]));
    let interval = &effect_intervals(&replicates, 0.95).unwrap()[0];
    assert_relative_eq!(interval.effect, 0.5 * (one + two), max_relative = 1e-12);
    assert_relative_eq!(interval.standard_error, 0.5 * (one - two).abs(), max_relative = 1e-9);
    // t_(1, 0.975) = 12.7062047364
    assert_relative_eq!(
        interval.high - interval.effect,
        12.7062047364 * interval.standard_error,
        max_relative = 1e-9
    );
    assert_relative_eq!(
        interval.effect - interval.low,
        12.7062047364 * interval.standard_error,
        max_relative = 1e-9
    );
}

#[test]
fn outputs_of_another_design_and_invalid_replicates_are_errors() {
    let design = SobolDesign::new(inputs(1), 0, 8).unwrap();
    let error = student_effects(&design, &[Some(1.0); 7]).unwrap_err();
    assert_eq!(error, SensitivityError::LengthMismatch { field: "outputs", value: 7, expected: 8 });
    let mut outputs = vec![None; 8];
    (outputs[0], outputs[3]) = (Some(1.0), Some(2.0));
    let error = student_effects(&design, &outputs).unwrap_err();
    assert_eq!(error, SensitivityError::EmptyHalf { input: "x0".into(), above: 0, below: 2 });

    let of =
        |design: SobolDesign| Replicate { design, outputs: (0..8).map(|i| Some(f64::from(i))).collect() };
    let index = |replicates: &[_]| match effect_intervals(replicates, 0.95).unwrap_err() {
        SensitivityError::NotAReplicate { index, .. } => index,
        other => panic!("{other}"),
    };
    let first = of(design.replicate(1));
    assert_eq!(index(&[first.clone(), of(design.clone())]), 1);
    assert_eq!(index(&[first.clone(), first.clone()]), 1);
    let other = SobolDesign::scrambled(inputs(2), 8, 3).unwrap();
    assert_eq!(index(&[first.clone(), of(design.replicate(2)), of(other)]), 2);
    assert!(effect_intervals(std::slice::from_ref(&first), 0.95).is_err());
    assert!(effect_intervals(&[first, of(design.replicate(2))], 1.0).is_err());
}

#[test]
fn sums_of_blocks_merge_into_the_effects_of_all() {
    let design = SobolDesign::new(inputs(6), 1, 1000).unwrap();
    let rows = rows(&design, 1);
    let partial = outputs(&design, |row| linear(row).filter(|y| (y * 7.0).fract().abs() > 0.1));
    let mut whole = EffectSums::new(design.inputs(), 5.0);
    for (rows, outputs) in rows.chunks(96).zip(partial.chunks(96)) {
        let mut sums = EffectSums::new(design.inputs(), 5.0);
        rows.iter().zip(outputs).for_each(|(row, output)| sums.add(row, *output));
        whole.merge(&sums);
    }
    let (merged, expected) =
        (whole.effects(design.inputs()).unwrap(), student_effects(&design, &partial).unwrap());
    assert_eq!(
        (merged.outputs.count, merged.outputs.failed),
        (expected.outputs.count, expected.outputs.failed)
    );
    assert!(merged.outputs.failed > 0);
    for (merged, expected) in merged.effects.iter().zip(&expected.effects) {
        assert_eq!((merged.above, merged.failed_below), (expected.above, expected.failed_below));
        assert_relative_eq!(merged.effect, expected.effect, max_relative = 1e-11, epsilon = 1e-12);
        assert_relative_eq!(merged.student, expected.student, max_relative = 1e-11, epsilon = 1e-12);
    }
}
