//! Sobol's sequence against `scipy`'s points, and the balance that scrambling keeps.

use cdpr_evidence::accept;
use cdpr_sensitivity::{SensitivityError, Sobol};
use proptest::prelude::*;

#[derive(serde::Deserialize)]
struct Reference {
    points: Vec<Point>,
}

#[derive(serde::Deserialize)]
struct Point {
    dimensions: usize,
    index: u32,
    numerators: Vec<u32>,
}

fn points(sobol: &Sobol, count: u32) -> Vec<Vec<f64>> {
    let point = |index| {
        let mut point = vec![f64::NAN; sobol.dimensions()];
        sobol.point(index, &mut point).unwrap();
        point
    };
    (0..count).map(point).collect()
}

#[test]
fn plain_points_are_those_of_scipy_bit_for_bit() {
    let path = concat!(env!("CARGO_MANIFEST_DIR"), "/../../data/reference/sobol.json");
    let reference: Reference = serde_json::from_str(&std::fs::read_to_string(path).unwrap()).unwrap();
    assert_eq!(reference.points.len(), 28);
    for Point { dimensions, index, numerators } in reference.points {
        let mut point = vec![f64::NAN; dimensions];
        Sobol::new(dimensions).unwrap().point(index, &mut point).unwrap();
        let expected: Vec<f64> = numerators.iter().map(|&k| f64::from(k) / f64::from(1 << 30)).collect();
        let different = point.iter().zip(&expected).filter(|(found, exact)| found != exact).count();
        accept("V-STATISTICS-001", different as f64);
    }
}

#[test]
fn the_last_of_the_points_is_in_the_unit_cube() {
    let mut point = [f64::NAN; 3];
    Sobol::new(3).unwrap().point(u32::MAX, &mut point).unwrap();
    // Gray code of 2^32 - 1 is 2^31: the last direction number alone.
    assert_eq!(point[0], 1.0 / f64::from(1 << 16).powi(2));
    assert!(point.iter().all(|x| (0.0..1.0).contains(x)));
}

#[test]
fn each_interval_of_2_to_the_minus_m_holds_one_of_2_to_the_m_scrambled_points() {
    let m = 10;
    let points = points(&Sobol::scrambled(40, 7).unwrap(), 1 << m);
    for j in 0..40 {
        let mut seen = vec![0; 1 << m];
        for point in &points {
            seen[(point[j] * f64::from(1 << m)) as usize] += 1;
        }
        assert!(seen.iter().all(|&count| count == 1), "dimension {j}");
    }
}

#[test]
fn each_box_of_area_2_to_the_minus_m_in_the_first_plane_holds_one_of_2_to_the_m_scrambled_points() {
    let m = 10;
    let points = points(&Sobol::scrambled(2, 11).unwrap(), 1 << m);
    for split in 0..=m {
        let mut seen = vec![0; 1 << m];
        for point in &points {
            let column = (point[0] * f64::from(1 << split)) as usize;
            let row = (point[1] * f64::from(1 << (m - split))) as usize;
            seen[(column << (m - split)) + row] += 1;
        }
        assert!(seen.iter().all(|&count| count == 1), "2^{split} columns");
    }
}

#[test]
fn a_scrambled_point_is_uniform_over_seeds_and_its_coordinates_are_independent() {
    let count = 4000;
    let mut sums = [0.0; 4];
    let mut point = [0.0; 2];
    for seed in 0..count {
        Sobol::scrambled(2, seed).unwrap().point(0, &mut point).unwrap();
        let [x, y] = point.map(|x| (x - 0.5) * 12.0_f64.sqrt());
        for (sum, term) in sums.iter_mut().zip([x, y, x * y, x * x - 1.0]) {
            *sum += term;
        }
    }
    // Each term has mean 0 and a variance of at most 1: four standard deviations.
    for sum in sums {
        assert!(sum.abs() < 4.0 * (count as f64).sqrt(), "{sums:?}");
    }
}

#[test]
fn scrambling_integrates_a_smooth_function_far_better_than_random_points() {
    // ∫ Π (1 + (x - 1/2) / j) = 1. Standard deviation of a random mean of 1024: about 0.01.
    let error = |seed| {
        let points = points(&Sobol::scrambled(5, seed).unwrap(), 1024);
        let f =
            |x: &Vec<f64>| x.iter().zip(1..).map(|(x, j)| 1.0 + (x - 0.5) / f64::from(j)).product::<f64>();
        points.iter().map(f).sum::<f64>() / 1024.0 - 1.0
    };
    let rms = ((0..32).map(|seed| error(seed).powi(2)).sum::<f64>() / 32.0).sqrt();
    assert!(rms > 0.0 && rms < 3e-4, "{rms}");
}

#[test]
fn a_number_of_dimensions_outside_of_the_table_is_an_error() {
    assert!(Sobol::new(Sobol::MAX_DIMENSIONS).is_ok());
    for value in [0, Sobol::MAX_DIMENSIONS + 1] {
        let error = Sobol::new(value).unwrap_err();
        assert!(matches!(error, SensitivityError::OutOfRange { field: "dimensions", .. }), "{error}");
    }
    let error = Sobol::new(3).unwrap().point(0, &mut [0.0; 2]).unwrap_err();
    assert_eq!(error, SensitivityError::LengthMismatch { field: "point", value: 2, expected: 3 });
}

proptest! {
    #[test]
    fn scrambled_coordinates_are_never_0_or_1(index: u32, seed: u64) {
        let mut point = [f64::NAN; 8];
        Sobol::scrambled(8, seed).unwrap().point(index, &mut point).unwrap();
        prop_assert!(point.iter().all(|&x| x > 0.0 && x < 1.0));
    }
}
