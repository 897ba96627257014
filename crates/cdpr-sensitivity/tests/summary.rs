//! Moments, quantiles and histograms against values computed by hand and by `numpy`.

use approx::assert_relative_eq;
use cdpr_sensitivity::{Bins, Moments, Sample, SensitivityError};

#[test]
fn failed_observations_are_counted_and_take_part_in_nothing_else() {
    let sample = Sample::new(&[Some(3.0), None, Some(1.0), None, Some(2.0), None]).unwrap();
    let summary = sample.summary();
    assert_eq!((summary.count, summary.failed), (3, 3));
    assert_eq!((summary.mean, summary.std, summary.min, summary.max), (2.0, 1.0, 1.0, 3.0));
}

#[test]
fn a_large_offset_costs_the_standard_deviation_no_digits() {
    let values: Vec<f64> = (0..1000).map(|i| 1e9 + f64::from(i % 10)).collect();
    let summary = Sample::of_values(&values).unwrap().summary();
    assert_eq!(summary.mean, 1e9 + 4.5);
    assert_relative_eq!(summary.std, (8.25_f64 * 1000.0 / 999.0).sqrt(), max_relative = 1e-14);
}

#[test]
fn the_order_of_the_observations_does_not_change_a_bit() {
    let values: Vec<f64> = (0..999).map(|i| (f64::from(i) * 0.7).sin() * 1e3 + 0.1).collect();
    let reversed: Vec<f64> = values.iter().rev().copied().collect();
    assert_eq!(
        Sample::of_values(&values).unwrap().summary(),
        Sample::of_values(&reversed).unwrap().summary()
    );
}

#[test]
fn quantiles_interpolate_as_those_of_numpy_do() {
    // numpy.quantile([1, 2, 4, 8, 16], p)
    let sample = Sample::of_values(&[16.0, 1.0, 8.0, 2.0, 4.0]).unwrap();
    for (p, expected) in
        [(0.0, 1.0), (0.1, 1.4), (0.25, 2.0), (0.5, 4.0), (0.6, 5.6), (0.95, 14.4), (1.0, 16.0)]
    {
        assert_relative_eq!(sample.quantile(p).unwrap(), expected, max_relative = 1e-14);
    }
    assert!(sample.quantile(1.01).is_err() && sample.quantile(f64::NAN).is_err());
}

#[test]
fn a_histogram_holds_each_value_once_and_its_edges_belong_to_the_bin_above() {
    let sample = Sample::of_values(&[0.0, 1.0, 1.0, 2.0, 3.5, 4.0]).unwrap();
    let histogram = sample.histogram(Bins::Count(4)).unwrap();
    assert_eq!(histogram.edges, [0.0, 1.0, 2.0, 3.0, 4.0]);
    assert_eq!(histogram.counts, [1, 2, 1, 2]);
    for bins in [0, 7] {
        let error = sample.histogram(Bins::Count(bins)).unwrap_err();
        assert!(matches!(error, SensitivityError::OutOfRange { field: "bins", .. }));
    }
}

#[test]
fn freedman_and_diaconis_take_ten_bins_for_a_thousand_evenly_spaced_values() {
    // Width 2 · 0.5 · 1000^(-1/3) of a range of 1.
    let values: Vec<f64> = (0..1000).map(|i| f64::from(i) / 999.0).collect();
    let histogram = Sample::of_values(&values).unwrap().histogram(Bins::FreedmanDiaconis).unwrap();
    assert_eq!((histogram.counts.len(), histogram.edges.len()), (10, 11));
    assert_eq!(histogram.counts.iter().sum::<usize>(), 1000);
}

#[test]
fn samples_without_spread_or_with_a_far_outlier_still_have_a_histogram() {
    let constant = Sample::of_values(&[2.0; 5]).unwrap().histogram(Bins::FreedmanDiaconis).unwrap();
    assert_eq!((constant.edges, constant.counts), (vec![2.0, 2.0], vec![5]));
    let outlier = Sample::of_values(&[1.0, 2.0, 3.0, 4.0, 1e12]).unwrap();
    assert_eq!(outlier.histogram(Bins::FreedmanDiaconis).unwrap().counts, [4, 0, 0, 0, 1]);
}

#[test]
fn a_value_that_is_not_finite_or_too_few_values_are_errors() {
    let error = Sample::new(&[Some(1.0), None, Some(f64::INFINITY)]).unwrap_err();
    assert_eq!(error, SensitivityError::NotFinite { field: "outputs", index: 2, value: f64::INFINITY });
    let error = Sample::new(&[Some(1.0), None]).unwrap_err();
    assert!(matches!(error, SensitivityError::OutOfRange { value: 1, minimum: 2, .. }), "{error}");
}

#[test]
fn moments_of_a_stream_are_those_of_the_sample() {
    let outputs: Vec<Option<f64>> =
        (0..1000).map(|i| (i % 7 != 3).then(|| 1e6 + (f64::from(i) * 0.7).sin())).collect();
    let expected = Sample::new(&outputs).unwrap().summary();
    let mut merged = Moments::default();
    for block in outputs.chunks(64) {
        let mut moments = Moments::default();
        block.iter().for_each(|output| moments.add(*output));
        merged.merge(&moments);
    }
    merged.merge(&Moments::default());
    let summary = merged.summary().unwrap();
    assert_eq!((summary.count, summary.failed), (expected.count, expected.failed));
    assert_eq!((summary.min, summary.max), (expected.min, expected.max));
    assert_relative_eq!(summary.mean, expected.mean, max_relative = 1e-15);
    assert_relative_eq!(summary.std, expected.std, max_relative = 1e-10);
    let mut one = Moments::default();
    one.add(Some(1.0));
    assert!(matches!(one.summary(), Err(SensitivityError::OutOfRange { value: 1, .. })));
}
