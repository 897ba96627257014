//! Laws against `scipy`'s, their JSON form, and the steps of an input.

use approx::assert_relative_eq;
use cdpr_evidence::accept;
use cdpr_sensitivity::{Input, Law, SensitivityError, Steps, Support};
use proptest::prelude::*;

#[derive(serde::Deserialize)]
struct Reference {
    laws: Vec<Row>,
}

#[derive(serde::Deserialize)]
struct Row {
    law: Law,
    mean: f64,
    std: f64,
    u: Vec<f64>,
    quantile: Vec<f64>,
    cdf: Vec<f64>,
    ln_pdf: Vec<f64>,
}

fn reference() -> Vec<Row> {
    let path = concat!(env!("CARGO_MANIFEST_DIR"), "/../../data/reference/laws.json");
    serde_json::from_str::<Reference>(&std::fs::read_to_string(path).unwrap()).unwrap().laws
}

#[test]
fn quantile_distribution_density_and_moments_are_those_of_scipy() {
    let rows = reference();
    assert_eq!(rows.len(), 15);
    for row in rows {
        let law = row.law;
        law.validate().unwrap();
        assert_relative_eq!(law.mean(), row.mean, max_relative = 1e-10, epsilon = 1e-12);
        // A difference of moments: the truncated laws lose digits of an error function that has ten.
        assert_relative_eq!(law.std(), row.std, max_relative = 1e-7);
        for (i, &u) in row.u.iter().enumerate() {
            let x = row.quantile[i];
            assert_relative_eq!(law.quantile(u), x, max_relative = 1e-9, epsilon = 1e-12);
            accept("V-STATISTICS-008", (law.cdf(x) / row.cdf[i] - 1.0).abs());
            assert_relative_eq!(law.ln_pdf(x), row.ln_pdf[i], max_relative = 1e-9, epsilon = 1e-9);
        }
    }
}

#[test]
fn the_quantiles_of_0_and_1_are_the_ends_of_the_support() {
    for row in reference() {
        let Support { min, max } = row.law.support();
        assert_eq!((row.law.quantile(0.0), row.law.quantile(1.0)), (min, max), "{:?}", row.law);
        assert!(row.law.quantile(-0.1).is_nan() && row.law.quantile(1.1).is_nan());
        assert_eq!((row.law.cdf(min), row.law.cdf(max)), (0.0, 1.0), "{:?}", row.law);
    }
}

#[test]
fn parameters_out_of_order_are_named() {
    let wrong = [
        (Law::Uniform { min: 1.0, max: 1.0 }, "max"),
        (Law::Uniform { min: f64::NAN, max: 1.0 }, "min"),
        (Law::Uniform { min: -1e308, max: 1e308 }, "max"),
        (Law::Normal { mean: 0.0, std: 0.0 }, "std"),
        (Law::TruncatedNormal { mean: 0.0, std: 1.0, min: 60.0, max: 61.0 }, "std"),
        (Law::Triangular { min: 0.0, mode: 2.0, max: 1.0 }, "mode"),
        (Law::Beta { alpha: 0.0, beta: 1.0, min: 0.0, max: 1.0 }, "alpha"),
        (Law::LogNormal { log_mean: f64::INFINITY, log_std: 1.0 }, "log_mean"),
        (Law::Weibull { shape: 1.0, scale: -1.0 }, "scale"),
        (Law::Gumbel { location: 0.0, scale: 0.0 }, "scale"),
    ];
    for (law, name) in wrong {
        match law.validate() {
            Err(SensitivityError::InvalidParameter { field, .. }) => assert_eq!(field, name, "{law:?}"),
            other => panic!("{law:?}: {other:?}"),
        }
    }
}

#[test]
fn an_input_reads_and_writes_as_json_and_an_unknown_field_is_refused() {
    let text =
        r#"{"name":"modulus","law":{"uniform":{"min":-18.0,"max":18.0}},"steps":{"nearest":{"step":0.05}}}"#;
    let input: Input = serde_json::from_str(text).unwrap();
    assert_eq!(input, Input::stepped("modulus", paper_range(18.0), Steps::Nearest { step: 0.05 }));
    assert_eq!(serde_json::to_string(&input).unwrap(), text);
    for wrong in [
        text.replace("\"name\"", "\"unit\":\"Pa\",\"name\""),
        text.replace("\"min\"", "\"mode\":0.0,\"min\""),
        text.replace("\"step\"", "\"levels\":3,\"step\""),
    ] {
        assert!(serde_json::from_str::<Input>(&wrong).unwrap_err().to_string().contains("unknown field"));
    }
}

fn paper_range(half: f64) -> Law {
    Law::Uniform { min: -half, max: half }
}

#[test]
fn the_ranges_of_the_paper_have_the_levels_that_follow_from_their_steps() {
    // Table 3: E and m, rho, a_i, b_i, tension.
    for (half, step, levels, last) in [
        (18.0, 0.05, 721.0, 18.0),
        (0.01015, 3e-5, 677.0, 338.0 * 3e-5),
        (0.015, 0.0006, 51.0, 0.015),
        (0.03, 0.0012, 51.0, 0.03),
        (15.0, 0.1, 301.0, 15.0),
    ] {
        for steps in [Steps::Nearest { step }, Steps::EqualMass { step }] {
            let input = Input::stepped("x", paper_range(half), steps);
            input.validate().unwrap();
            assert_eq!(input.levels(), Some(levels));
            assert_relative_eq!(input.value(0.0), -last, max_relative = 1e-14);
            assert_relative_eq!(input.value(1.0), last, max_relative = 1e-14);
            assert_eq!(input.value(0.5), 0.0);
        }
    }
}

#[test]
fn rounding_to_the_nearest_level_halves_the_weight_of_the_end_levels_and_equal_mass_does_not() {
    let count = 8000;
    let weights = |steps| {
        let input = Input::stepped("x", paper_range(2.0), steps);
        let mut weights = [0; 5];
        for i in 0..count {
            weights[(input.value((f64::from(i) + 0.5) / f64::from(count)) + 2.0) as usize] += 1;
        }
        weights
    };
    assert_eq!(weights(Steps::Nearest { step: 1.0 }), [1000, 2000, 2000, 2000, 1000]);
    assert_eq!(weights(Steps::EqualMass { step: 1.0 }), [1600; 5]);
}

#[test]
fn steps_that_do_not_suit_the_law_are_an_error_that_names_the_input() {
    let normal = Law::Normal { mean: 0.0, std: 1.0 };
    let error = Input::stepped("mass", normal, Steps::EqualMass { step: 0.1 }).validate().unwrap_err();
    assert_eq!(
        error.to_string(),
        "input `mass`: steps `equal_mass` are defined for a uniform law only: use `nearest`"
    );
    for step in [0.0, -1.0, f64::NAN, 1.1] {
        let error = Input::stepped("mass", paper_range(1.0), Steps::Nearest { step }).validate().unwrap_err();
        assert!(error.to_string().starts_with("input `mass`: step = "), "{error}");
    }
}

proptest! {
    #[test]
    fn stepped_values_are_whole_steps_from_the_middle_and_inside_of_the_range(
        min in -1e3..1e3_f64, range in 0.1..1e3_f64, parts in 2.0..1e4_f64, u in 0.0..=1.0_f64,
    ) {
        let step = range / parts;
        let law = Law::Uniform { min, max: min + range };
        for steps in [Steps::Nearest { step }, Steps::EqualMass { step }] {
            let input = Input::stepped("x", law, steps);
            let value = input.value(u);
            let level = (value - law.middle()) / step;
            let Support { min, max } = law.support();
            prop_assert!((min..=max).contains(&value));
            prop_assert!((level - level.round()).abs() < 1e-6);
        }
    }

    #[test]
    fn the_quantile_ascends_and_the_distribution_takes_it_back(u in 1e-3..0.999_f64, v in 1e-3..0.999_f64) {
        for row in reference() {
            let (x, y) = (row.law.quantile(u), row.law.quantile(v));
            prop_assert!(u == v || (u < v) == (x < y));
            prop_assert!((row.law.cdf(x) - u).abs() < 1e-9);
        }
    }
}

/// A normal law that is much wider than its interval is almost uniform in it, one behind the interval almost
/// exponential; where the ways to compute them meet they agree.
#[test]
fn a_wide_truncated_normal_law_is_uniform() {
    for std in [1e3, 1e5, 1e7, 1e9, 1e14] {
        for (min, max) in [(-1.0, 1.0), (0.0, 1.0), (2.0, 2.5)] {
            let law = Law::TruncatedNormal { mean: 0.0, std, min, max };
            assert_relative_eq!(law.mean(), 0.5 * (min + max), max_relative = 1e-5, epsilon = 1e-9);
            assert_relative_eq!(law.std(), (max - min) / 12_f64.sqrt(), max_relative = 1e-5);
            for u in [0.01, 0.3, 0.9] {
                let x = law.quantile(u);
                assert_relative_eq!(x, min + u * (max - min), max_relative = 1e-5, epsilon = 1e-9);
                assert_relative_eq!(law.cdf(x), u, max_relative = 1e-7);
            }
        }
    }
    for mean in [0.0, -3.0] {
        let of = |width: f64| Law::TruncatedNormal { mean, std: 1.0, min: 1.0, max: 1.0 + width };
        for width in [0.1 / 6.0, 0.1 / 3.0, 0.1 / 2.5, 0.1, 1e-4, 6e-5] {
            let [less, more] = [of(width * (1.0 - 1e-9)), of(width * (1.0 + 1e-9))];
            assert_relative_eq!(less.std() / more.std(), 1.0, max_relative = 1e-6);
            assert_relative_eq!(less.quantile(0.3) - 1.0, more.quantile(0.3) - 1.0, max_relative = 1e-6);
        }
    }
}
