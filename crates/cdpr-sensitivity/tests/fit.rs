//! Fits against `scipy`, and p-values that hold for fitted parameters.

use crate::common::rows;
use approx::assert_relative_eq;
use cdpr_evidence::accept;
use cdpr_sensitivity::{
    BestFit, Bootstrap, Evidence, Family, Fit, Input, Law, RandomDesign, Sample, SensitivityError, fit,
    fit_all,
};
use proptest::prelude::*;
use std::f64::consts::{E, PI, SQRT_2};

#[derive(serde::Deserialize)]
struct Reference {
    samples: Vec<ReferenceSample>,
}

#[derive(serde::Deserialize)]
struct ReferenceSample {
    name: String,
    values: Vec<f64>,
    fits: Vec<ReferenceFit>,
}

#[derive(serde::Deserialize)]
struct ReferenceFit {
    family: Family,
    law: serde_json::Value,
    log_likelihood: f64,
    ks_distance: f64,
}

const FEW: Bootstrap = Bootstrap { resamples: 19, seed: 1 };

fn draw(law: Law, count: usize, seed: u64) -> Sample {
    let design = RandomDesign::new(vec![Input::continuous("x", law)], count, seed).unwrap();
    Sample::of_values(&rows(&design, 1).concat()).unwrap()
}

fn reference() -> Vec<ReferenceSample> {
    let path = concat!(env!("CARGO_MANIFEST_DIR"), "/../../data/reference/fits.json");
    serde_json::from_str::<Reference>(&std::fs::read_to_string(path).unwrap()).unwrap().samples
}

#[test]
fn parameters_likelihoods_and_distances_are_those_of_scipy() {
    let samples = reference();
    assert_eq!(samples.len(), 5);
    for ReferenceSample { values, fits, .. } in samples {
        let sample = Sample::of_values(&values).unwrap();
        let n = values.len() as f64;
        assert_eq!(fits.len(), 7);
        for expected in fits {
            let found = fit(&sample, expected.family, FEW).unwrap();
            let law = serde_json::to_value(found.law).unwrap();
            let (family, parameters) = expected.law.as_object().unwrap().iter().next().unwrap();
            for (field, value) in parameters.as_object().unwrap() {
                let (found, value) = (law[family][field].as_f64().unwrap(), value.as_f64().unwrap());
                accept("V-STATISTICS-006", (found - value).abs() / (1.0 + value.abs()));
            }
            let log_likelihood = expected.log_likelihood;
            accept("V-STATISTICS-007", (found.log_likelihood / log_likelihood - 1.0).abs());
            assert_relative_eq!(found.ks_distance, expected.ks_distance, max_relative = 1e-6);
            assert_relative_eq!(found.aic, 4.0 - 2.0 * log_likelihood, max_relative = 1e-9, epsilon = 1e-8);
            assert_relative_eq!(
                found.bic,
                2.0 * n.ln() - 2.0 * log_likelihood,
                max_relative = 1e-9,
                epsilon = 1e-8
            );
        }
    }
}

#[test]
fn fit_all_sorts_by_akaike_and_agrees_with_the_single_fits() {
    for ReferenceSample { name, values, .. } in reference() {
        let sample = Sample::of_values(&values).unwrap();
        let fits = fit_all(&sample, FEW).unwrap();
        assert_eq!(fits.len(), 7);
        assert!(fits.is_sorted_by(|one, other| one.aic <= other.aic));
        for all in &fits {
            let single = fit(&sample, all.family, FEW).unwrap();
            assert_eq!(*all, Fit { probability: all.probability, ..single });
        }
        match name.as_str() {
            "quasi_uniform" => assert_eq!(fits[0].family, Family::Uniform),
            "normal" => assert_eq!(fits[0].family, Family::Normal),
            "skewed" => assert_eq!(fits[0].family, Family::Weibull),
            "heavy_tails" => assert_eq!(fits[0].family, Family::Laplace),
            _ => {}
        }
    }
}

#[test]
fn each_family_is_found_again_in_a_large_sample_of_its_own() {
    let laws = [
        (Family::Uniform, Law::Uniform { min: 1.12, max: 1.63 }),
        (Family::Normal, Law::Normal { mean: 1.33, std: 0.018 }),
        (Family::Logistic, Law::Logistic { location: 1.33, scale: 0.02 }),
        (Family::Laplace, Law::Laplace { location: 1.33, scale: 0.02 }),
        (Family::Gumbel, Law::Gumbel { location: -1.33, scale: 0.2 }),
        (Family::LogNormal, Law::LogNormal { log_mean: 0.3, log_std: 0.5 }),
        (Family::Weibull, Law::Weibull { shape: 1.5, scale: 1.4 }),
    ];
    for (family, law) in laws {
        let fits = fit_all(&draw(law, 4000, 17), Bootstrap { resamples: 99, seed: 4 }).unwrap();
        assert_eq!(fits[0].family, family);
        assert!(fits[0].p_value > 0.01, "{:?}", fits[0]);
        assert_relative_eq!(fits[0].law.mean(), law.mean(), max_relative = 0.05);
        assert_relative_eq!(fits[0].law.std(), law.std(), max_relative = 0.05);
        // Four thousand values tell all other families apart, but not a narrow normal law from a lognormal
        // one.
        for other in &fits[1..] {
            let neighbour = family == Family::Normal && other.family == Family::LogNormal;
            assert!(other.p_value < 0.05 || neighbour, "{family:?} {other:?}");
        }
    }
}

#[test]
fn p_values_of_a_true_family_are_uniform_although_its_parameters_are_fitted() {
    for (family, law) in [
        (Family::Normal, Law::Normal { mean: 1.34, std: 0.14 }),
        (Family::Uniform, Law::Uniform { min: 1.12, max: 1.63 }),
        (Family::Weibull, Law::Weibull { shape: 9.0, scale: 1.4 }),
    ] {
        let studies = 400;
        let p_value = |study| {
            let bootstrap = Bootstrap { resamples: 99, seed: study + 1000 };
            fit(&draw(law, 40, study), family, bootstrap).unwrap().p_value
        };
        let p_values: Vec<f64> = (0..studies).map(p_value).collect();
        // Four standard deviations of a count of 400. The p-values of the law as if it were known would lie
        // above one half nearly always.
        for level in [0.1, 0.5, 0.9] {
            let share = p_values.iter().filter(|&&p| p <= level).count() as f64 / studies as f64;
            let deviation = (level * (1.0 - level) / studies as f64).sqrt();
            assert!((share - level).abs() < 4.0 * deviation, "{family:?}: {share} of p-values up to {level}");
        }
    }
}

#[test]
fn p_values_depend_on_the_seed_and_not_on_the_number_of_threads() {
    let sample = Sample::of_values(&[0.9, 1.0, 1.2, 1.7, 2.1]).unwrap();
    let run = |threads, seed| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        pool.install(|| fit_all(&sample, Bootstrap { resamples: 50, seed }).unwrap())
    };
    assert_eq!(run(1, 5), run(4, 5));
    assert_ne!(run(1, 5), run(1, 6));
}

#[test]
fn values_of_either_sign_are_fitted_without_the_families_of_positive_values() {
    let sample = Sample::of_values(&[-1.0, 0.5, 2.0, 3.0, 0.1]).unwrap();
    let families: Vec<Family> = fit_all(&sample, FEW).unwrap().iter().map(|fit| fit.family).collect();
    assert_eq!(families.len(), 5);
    assert!(!families.contains(&Family::LogNormal) && !families.contains(&Family::Weibull));
    let error = fit(&sample, Family::Weibull, FEW).unwrap_err();
    assert_eq!(error, SensitivityError::NotPositive { family: Family::Weibull, minimum: -1.0 });
}

#[test]
fn constant_and_tiny_samples_and_no_resamples_are_errors() {
    let error = fit_all(&Sample::of_values(&[1.5; 8]).unwrap(), FEW).unwrap_err();
    assert_eq!(error, SensitivityError::ConstantSample { value: 1.5, count: 8 });
    let error = fit_all(&Sample::of_values(&[1.0, 2.0]).unwrap(), FEW).unwrap_err();
    assert!(matches!(error, SensitivityError::OutOfRange { value: 2, minimum: 3, .. }));
    let none = Bootstrap { resamples: 0, seed: 0 };
    let error = fit_all(&Sample::of_values(&[1.0, 2.0, 3.0]).unwrap(), none).unwrap_err();
    assert!(matches!(error, SensitivityError::OutOfRange { field: "resamples", .. }));
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(200))]

    #[test]
    fn fits_follow_a_change_of_unit_and_origin(
        values in prop::collection::vec(-1.0..1.0_f64, 3..40), unit in 1e-6..1e6_f64,
        origin in -10.0..10.0_f64,
    ) {
        let sample = Sample::of_values(&values).unwrap();
        prop_assume!(sample.sorted()[0] + 1e-3 < sample.sorted()[values.len() - 1]);
        let moved: Vec<f64> = values.iter().map(|value| unit * (value + origin)).collect();
        let moved = Sample::of_values(&moved).unwrap();
        for family in [Family::Uniform, Family::Normal, Family::Logistic, Family::Laplace, Family::Gumbel] {
            let (one, other) = (fit(&sample, family, FEW).unwrap(), fit(&moved, family, FEW).unwrap());
            let mean = unit * (one.law.mean() + origin);
            assert_relative_eq!(other.law.mean(), mean, max_relative = 1e-6, epsilon = 1e-6 * unit);
            assert_relative_eq!(other.law.std(), unit * one.law.std(), max_relative = 1e-6);
            assert_relative_eq!(other.ks_distance, one.ks_distance, epsilon = 1e-6);
        }
    }

    #[test]
    fn the_likelihood_has_a_maximum_however_far_the_outliers(
        values in prop::collection::vec(-300.0..300.0_f64, 3..40),
    ) {
        // Powers of ten from -13 to 13, of either sign.
        let values: Vec<f64> = values.iter().map(|x| (x.abs() / 10.0 - 17.0).exp().copysign(*x)).collect();
        let sample = Sample::of_values(&values).unwrap();
        for fit in fit_all(&sample, FEW).unwrap() {
            prop_assert!(fit.law.validate().is_ok() && fit.log_likelihood.is_finite(), "{fit:?}");
        }
    }
}

/// Numbers of samples whose law is decided on, decided on wrongly, and rejected.
fn choices(family: Family, law: Law, n: usize, samples: u64) -> [usize; 3] {
    let mut counts = [0; 3];
    for seed in 0..samples {
        let fits = fit_all(&draw(law, n, 5000 + seed), Bootstrap { resamples: 39, seed }).unwrap();
        let best = BestFit::of(&fits).unwrap();
        counts[0] += usize::from(best.evidence == Evidence::Decided);
        counts[1] += usize::from(best.evidence == Evidence::Decided && best.family != family);
        counts[2] += usize::from(best.evidence == Evidence::Rejected);
    }
    counts
}

#[test]
fn at_most_one_sample_in_twenty_is_decided_on_wrongly_and_large_ones_are_decided_on() {
    let (location, scale) = (0.0, 1.0);
    // The least share of 200 values that is decided on; those of neighbours are not.
    for (family, law, least) in [
        (Family::Uniform, Law::Uniform { min: 0.0, max: 1.0 }, 80),
        (Family::Normal, Law::Normal { mean: 0.0, std: 1.0 }, 10),
        (Family::Normal, Law::Normal { mean: 5.0, std: 1.0 }, 0),
        (Family::Logistic, Law::Logistic { location, scale }, 0),
        (Family::Laplace, Law::Laplace { location, scale }, 40),
        (Family::Gumbel, Law::Gumbel { location, scale }, 70),
        (Family::LogNormal, Law::LogNormal { log_mean: 0.0, log_std: 1.0 }, 70),
        (Family::Weibull, Law::Weibull { shape: 1.0, scale: 1.0 }, 70),
        (Family::Weibull, Law::Weibull { shape: 3.0, scale: 1.0 }, 0),
    ] {
        for n in [20, 50, 200] {
            let [decided, wrong, rejected] = choices(family, law, n, 100);
            // 5 expected at most; 12 is three standard deviations above. A true law has p <= 0.05 as rarely.
            assert!(wrong <= 11 && rejected <= 11, "{law:?} {n}: {decided} {wrong} {rejected}");
            assert!(n < 200 || decided - wrong >= least, "{law:?}: {decided} {wrong}");
        }
    }
}

#[test]
fn logistic_values_are_not_called_normal() {
    let logistic = Law::Logistic { location: 3.0, scale: 0.5 };
    for n in [50, 200] {
        let [_, wrong, _] = choices(Family::Logistic, logistic, n, 400);
        // Less than 5 %.
        assert!(wrong < 20, "{n}: {wrong} of 400");
    }
}

#[test]
fn a_sample_of_no_law_that_was_tried_says_so() {
    let few = Bootstrap { resamples: 199, seed: 1 };
    let halves = |values: Sample| -> Vec<f64> {
        values.sorted().iter().enumerate().map(|(i, x)| if i % 2 == 0 { *x } else { x + 10.0 }).collect()
    };
    let bimodal = Sample::of_values(&halves(draw(Law::Normal { mean: 0.0, std: 1.0 }, 400, 1))).unwrap();
    let arcs = draw(Law::Beta { alpha: 0.3, beta: 0.3, min: 0.0, max: 1.0 }, 400, 2);
    for sample in [bimodal, arcs] {
        let best = BestFit::of(&fit_all(&sample, few).unwrap()).unwrap();
        assert_eq!((best.evidence, best.p_is_bound), (Evidence::Rejected, true), "{best:?}");
        let said = format!("{}: best of those tried, and rejected (p <= 0.005)", best.family);
        assert_eq!(best.to_string(), said);
    }
}

#[test]
fn values_on_few_levels_or_with_an_atom_have_no_continuous_law() {
    let normal = draw(Law::Normal { mean: 0.0, std: 1.0 }, 200, 3);
    let map = |change: fn(f64) -> f64| -> Vec<f64> { normal.sorted().iter().map(|x| change(*x)).collect() };
    for (values, times) in [
        (map(|x| f64::from(x > 0.0)), 80..121),
        (map(f64::round), 60..100),
        (map(|x| x.max(-1.0)), 20..45),
        (vec![1.0, 1.0, 2.0, 2.0], 2..3),
    ] {
        let error = fit_all(&Sample::of_values(&values).unwrap(), FEW).unwrap_err();
        let SensitivityError::Discrete { times: found, count, .. } = error else { panic!("{error}") };
        assert!(times.contains(&found) && count == values.len(), "{error}");
    }
    // Rounding that leaves the law as it is.
    let rounded = Sample::of_values(&map(|x| (20.0 * x).round() / 20.0)).unwrap();
    let best = BestFit::of(&fit_all(&rounded, FEW).unwrap()).unwrap();
    assert_ne!(best.evidence, Evidence::Rejected, "{best}");
}

#[test]
fn probabilities_sum_to_one_and_that_of_a_law_of_fitted_ends_is_exact() {
    let sample = Sample::of_values(&[-1.0, -0.5, 0.25, 0.5, 1.0]).unwrap();
    let fits = fit_all(&sample, FEW).unwrap();
    let total: f64 = fits.iter().map(|fit| fit.probability).sum();
    assert_relative_eq!(total, 1.0, epsilon = 1e-12);
    let of = |family| fits.iter().find(|fit| fit.family == family).unwrap();
    let (uniform, normal) = (of(Family::Uniform), of(Family::Normal));
    // ∫∫ of the normal likelihood over location and scale is Γ((n - 1) / 2) / (2 √n π^((n-1)/2) S^((n-1)/2))
    // with S the sum of squares. Laplace's approximation is 2 √2 π³ / 5 (5 / (2 π e))^(5/2) of it.
    let squares: f64 = 2.5625 - 5.0 * 0.05_f64.powi(2);
    let exact = 1.0 / (2.0 * 5.0_f64.sqrt() * (PI * squares).powi(2));
    let laplace = 2.0 * SQRT_2 * PI.powi(3) / 5.0 * (5.0 / (2.0 * PI * E)).powf(2.5);
    let ratio = (2.0_f64.powi(-4) / 20.0) / (laplace * exact);
    assert_relative_eq!(uniform.probability / normal.probability, ratio, max_relative = 1e-12);
    assert_eq!(BestFit::of(&[]), None);
    // A law that was tried alone is not decided on.
    let alone = fit(&sample, Family::Normal, FEW).unwrap();
    assert_eq!(BestFit::of(&[alone]).unwrap().evidence, Evidence::Undecided);
    // Nor is one that ten samples of a bootstrap cannot reject.
    let uniform = draw(Law::Uniform { min: 0.0, max: 1.0 }, 400, 1);
    let evidence = |resamples| {
        let fits = fit_all(&uniform, Bootstrap { resamples, seed: 1 }).unwrap();
        BestFit::of(&fits).unwrap().evidence
    };
    assert_eq!((evidence(10), evidence(99)), (Evidence::Undecided, Evidence::Decided));
}
