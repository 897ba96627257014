//! Designs: rows from their indices, replicates, and refused arguments.

use crate::common::{rows, unit};
use cdpr_sensitivity::{Input, Law, RandomDesign, SampleDesign, SensitivityError, SobolDesign};

fn normal() -> Vec<Input> {
    vec![Input::continuous("x", Law::Normal { mean: 0.0, std: 1.0 })]
}

#[test]
fn rows_are_the_same_on_one_thread_and_on_four() {
    let sobol = SobolDesign::scrambled(unit(7), 500, 3).unwrap();
    let random = RandomDesign::new(unit(7), 500, 3).unwrap();
    assert_eq!(rows(&sobol, 1), rows(&sobol, 4));
    assert_eq!(rows(&random, 1), rows(&random, 4));
}

#[test]
fn a_design_from_a_later_index_continues_an_earlier_one() {
    let whole = rows(&SobolDesign::new(unit(4), 0, 100).unwrap(), 1);
    let rest = rows(&SobolDesign::new(unit(4), 60, 40).unwrap(), 1);
    assert_eq!(whole[60..], rest);
}

#[test]
fn replicates_have_the_size_of_the_design_and_numbers_of_their_own() {
    let design = SobolDesign::new(unit(3), 0, 64).unwrap();
    let (one, two) = (design.replicate(1), design.replicate(2));
    assert_eq!((one.points(), one.seed(), two.seed(), design.seed()), (64, Some(1), Some(2), None));
    assert_ne!(rows(&one, 1), rows(&two, 1));
    assert_eq!(rows(&one, 1), rows(&SobolDesign::scrambled(unit(3), 64, 1).unwrap(), 1));
    let random = RandomDesign::new(unit(3), 64, 5).unwrap();
    assert_eq!(rows(&random.replicate(6), 1), rows(&RandomDesign::new(unit(3), 64, 6).unwrap(), 1));
    assert_ne!(rows(&random.replicate(6), 1), rows(&random, 1));
}

#[test]
fn an_input_added_to_a_random_design_leaves_the_others_as_they_were() {
    let (three, four) =
        (RandomDesign::new(unit(3), 20, 1).unwrap(), RandomDesign::new(unit(4), 20, 1).unwrap());
    for (three, four) in rows(&three, 1).iter().zip(rows(&four, 1)) {
        assert_eq!(three[..], four[..3]);
    }
}

#[test]
fn random_rows_have_the_moments_of_independent_uniform_numbers() {
    let count = 20_000;
    let design = RandomDesign::new(unit(2), count, 9).unwrap();
    let mut sums = [0.0; 5];
    let rows = rows(&design, 2);
    for (row, next) in rows.iter().zip(rows.iter().cycle().skip(1)) {
        let [x, y, z] = [row[0], row[1], next[0]].map(|x| (x - 0.5) * 12.0_f64.sqrt());
        for (sum, term) in sums.iter_mut().zip([x, y, x * y, x * z, x * x - 1.0]) {
            *sum += term;
        }
    }
    // Each term has mean 0 and a variance of at most 1: four standard deviations.
    assert!(sums.iter().all(|sum: &f64| sum.abs() < 4.0 * (count as f64).sqrt()), "{sums:?}");
}

#[test]
fn an_unbounded_law_at_the_zero_point_is_an_error_unless_skipped_or_scrambled() {
    let error = SobolDesign::new(normal(), 0, 8).unwrap_err();
    assert_eq!(error, SensitivityError::UnboundedAtZero { name: "x".into() });
    for design in [SobolDesign::new(normal(), 1, 7).unwrap(), SobolDesign::scrambled(normal(), 8, 1).unwrap()]
    {
        assert!(rows(&design, 1).iter().all(|row| row[0].is_finite()));
    }
}

#[test]
fn sizes_and_indices_out_of_range_are_errors() {
    let field = |error| match error {
        SensitivityError::OutOfRange { field, .. } | SensitivityError::LengthMismatch { field, .. } => field,
        other => panic!("{other}"),
    };
    assert_eq!(field(SobolDesign::new(vec![], 0, 8).unwrap_err()), "dimensions");
    assert_eq!(field(SobolDesign::new(unit(1), 0, 0).unwrap_err()), "points");
    assert_eq!(field(SobolDesign::new(unit(1), 2, (1 << 32) - 1).unwrap_err()), "points");
    assert_eq!(field(RandomDesign::new(vec![], 8, 0).unwrap_err()), "inputs");
    assert_eq!(field(RandomDesign::new(unit(1), 0, 0).unwrap_err()), "points");
    let design = SobolDesign::new(unit(1), 1, (1 << 32) - 1).unwrap();
    assert!(design.row((1 << 32) - 2, &mut [0.0]).is_ok());
    assert_eq!(field(design.row((1 << 32) - 1, &mut [0.0]).unwrap_err()), "index");
    assert_eq!(field(design.row(0, &mut [0.0; 2]).unwrap_err()), "row");
}

#[test]
fn an_invalid_input_is_named() {
    let input = Input::continuous("b_3_z", Law::Uniform { min: 1.0, max: 0.0 });
    let error = SobolDesign::new(vec![input.clone()], 0, 8).unwrap_err();
    assert!(error.to_string().starts_with("input `b_3_z`: max = 0"), "{error}");
    assert_eq!(RandomDesign::new(vec![input], 8, 0).unwrap_err(), error);
}

#[test]
fn consecutive_rows_are_those_drawn_one_by_one() {
    let plain = SobolDesign::new(unit(7), 5, 500).unwrap();
    let last = SobolDesign::new(unit(3), u32::MAX - 9, 10).unwrap();
    let scrambled = SobolDesign::scrambled(unit(7), 500, 3).unwrap();
    for (design, first) in [(&plain, 0), (&plain, 123), (&last, 2), (&scrambled, 77)] {
        let width = design.inputs().len();
        let mut together = vec![f64::NAN; (design.points() - first) * width];
        design.rows(first, &mut together).unwrap();
        assert_eq!(rows(design, 1)[first..].concat(), together);
        assert!(design.rows(first + 1, &mut together).is_err());
        assert!(design.rows(first, &mut together[1..]).is_err());
    }
}
