//! Moduli, energies and refusals of small records.

use super::{Phase, Record, RecordError, Sample, Specimen, TangentModulus};
use approx::assert_relative_eq;

const SPECIMEN: Specimen = Specimen {
    breaking_force: 10_000.0,
    section: 1e-5,
    length: 2.0,
    force_error: 1.0,
    elongation_error: 3e-5,
    length_error: 0.0,
    section_error: 0.0,
};

fn record(rows: &[(f64, f64, Phase)]) -> Result<Record, RecordError> {
    let samples: Vec<_> = rows
        .iter()
        .enumerate()
        .map(|(i, &(force, mm, phase))| Sample { line: i + 2, force, elongation: 1e-3 * mm, phase })
        .collect();
    Record::new(&samples)
}

use Phase::{Loading, Unloading};

const LOOP: [(f64, f64, Phase); 5] = [
    (100.0, 0.0, Loading),
    (1000.0, 2.0, Loading),
    (2000.0, 3.0, Loading),
    (1000.0, 2.5, Unloading),
    (100.0, 0.5, Unloading),
];

#[test]
fn a_modulus_is_the_secant_of_its_phase() {
    let record = record(&LOOP).unwrap();
    // L ΔF/(S Δx): 2 m x 1000 N/(1e-5 m² x 1 mm), then half the elongation.
    let loading = record.modulus(&SPECIMEN, Loading, 10.0, 20.0).unwrap();
    assert_relative_eq!(loading.modulus, 2e11, max_relative = 1e-12);
    let unloading = record.modulus(&SPECIMEN, Unloading, 10.0, 20.0).unwrap();
    assert_relative_eq!(unloading.modulus, 4e11, max_relative = 1e-12);
    // From half way between two samples.
    let middle = record.modulus(&SPECIMEN, Loading, 5.5, 20.0).unwrap();
    assert_relative_eq!(middle.modulus, 2.0 * 1450.0 / (1e-5 * 2e-3), max_relative = 1e-12);
}

#[test]
fn uncertainties_are_those_of_perturbed_records() {
    // Moving one sample by its error moves the modulus by its share, to first order.
    let specimen = Specimen { length_error: 1e-3, section_error: 1e-8, ..SPECIMEN };
    let modulus = |specimen: &Specimen, rows: &[(f64, f64, Phase)]| {
        record(rows).unwrap().modulus(specimen, Loading, 10.0, 20.0).unwrap().modulus
    };
    let base = modulus(&specimen, &LOOP);
    let h = 1e-3;
    let mut shares = Vec::new();
    for index in [1, 2] {
        let mut rows = LOOP;
        rows[index].1 += h * 0.03;
        shares.push((modulus(&specimen, &rows) - base) / h);
    }
    for (length, section) in [(1e-3, 0.0), (0.0, 1e-8)] {
        let other = Specimen { length: 2.0 + h * length, section: 1e-5 + h * section, ..specimen };
        shares.push((modulus(&other, &LOOP) - base) / h);
    }
    // Both forces: of ΔF = 1000 N.
    shares.extend([base * 1e-3; 2]);
    let found = record(&LOOP).unwrap().modulus(&specimen, Loading, 10.0, 20.0).unwrap();
    let standard = shares.iter().map(|share| share * share).sum::<f64>().sqrt();
    assert_relative_eq!(found.standard, standard, max_relative = 1e-3);
    assert_relative_eq!(found.greatest, shares.iter().map(|share| share.abs()).sum(), max_relative = 1e-3);
}

#[test]
fn the_dissipated_energy_is_the_area_of_the_loop() {
    // Trapezoids under loading, minus those under unloading, minus 100 N over the 0.5 mm that stay.
    let expected = 1e-3 * (550.0 * 2.0 + 1500.0 - 1500.0 * 0.5 - 550.0 * 2.0 - 100.0 * 0.5);
    assert_relative_eq!(record(&LOOP).unwrap().dissipated_energy(), expected, max_relative = 1e-12);
}

#[test]
fn a_turning_point_may_be_given_twice() {
    let mut rows = LOOP.to_vec();
    rows.insert(3, (2000.0, 3.0, Unloading));
    let (twice, once) = (record(&rows).unwrap(), record(&LOOP).unwrap());
    assert_eq!(twice.samples(Unloading).len(), once.samples(Unloading).len());
    assert_eq!(twice.dissipated_energy(), once.dissipated_energy());
}

#[test]
fn a_bad_record_is_refused_with_its_line() {
    let with = |index: usize, row: (f64, f64, Phase)| {
        let mut rows = LOOP;
        rows[index] = row;
        record(&rows).unwrap_err().to_string()
    };
    for (message, words) in [
        (with(1, (f64::NAN, 2.0, Loading)), "line 3: force_n is NaN: expected a finite number"),
        (with(1, (1000.0, f64::INFINITY, Loading)), "line 3: elongation_mm is inf"),
        (with(0, (-1.0, 0.0, Loading)), "line 2: force_n is -1"),
        (with(2, (900.0, 3.0, Loading)), "line 4: force_n is 900: expected more than 1000 of line 3"),
        (with(2, (2000.0, 2.0, Loading)), "line 4: elongation_mm is 2: expected more than 2 of line 3"),
        (with(4, (1500.0, 0.5, Unloading)), "line 6: force_n is 1500: expected less than 1000 of line 5"),
        (with(3, (2500.0, 2.9, Unloading)), "line 5: force_n is 2500: expected less than 2000 of line 4"),
        (with(4, (100.0, 0.5, Loading)), "line 6: phase is loading: expected unloading"),
    ] {
        assert!(message.starts_with(words), "{message}");
    }
    assert_eq!(
        record(&LOOP[..3]).unwrap_err(),
        RecordError::TooShort { line: 4, phase: Unloading, found: 0 }
    );
    assert_eq!(record(&[]).unwrap_err(), RecordError::TooShort { line: 0, phase: Loading, found: 0 });
}

#[test]
fn a_record_in_other_units_is_refused() {
    // Elongations in micrometres: more than the cable is long.
    let micrometres = LOOP.map(|(force, mm, phase)| (force, 1e3 * mm, phase));
    let error = record(&micrometres).unwrap().modulus(&SPECIMEN, Loading, 10.0, 20.0).unwrap_err();
    assert!(matches!(error, RecordError::Invalid { line: 4, field: "elongation_mm", .. }), "{error}");
    // In metres.
    let metres = LOOP.map(|(force, mm, phase)| (force, 1e-3 * mm, phase));
    let error = record(&metres).unwrap().modulus(&SPECIMEN, Loading, 10.0, 20.0).unwrap_err();
    assert!(matches!(error, RecordError::Invalid { field: "modulus", .. }), "{error}");
}

#[test]
fn tangent_moduli_are_those_of_the_pieces_and_their_units_are_checked() {
    let moduli = |phase| record(&LOOP).unwrap().moduli(phase, 2.0, 1e-5).unwrap();
    let close = |found: Vec<TangentModulus>, expected: &[(f64, f64)]| {
        assert_eq!(found.len(), expected.len());
        for (one, other) in found.iter().zip(expected) {
            assert_eq!(one.tension, other.0);
            assert_relative_eq!(one.modulus, other.1, max_relative = 1e-12);
        }
    };
    close(moduli(Loading), &[(0.0, 9e10), (1000.0, 2e11)]);
    close(moduli(Unloading), &[(0.0, 9e10), (1000.0, 4e11)]);
    let micrometres = LOOP.map(|(force, mm, phase)| (force, 1e3 * mm, phase));
    let metres = LOOP.map(|(force, mm, phase)| (force, 1e-3 * mm, phase));
    for (rows, word) in [(micrometres, "elongation_mm"), (metres, "modulus")] {
        let error = record(&rows).unwrap().moduli(Loading, 2.0, 1e-5).unwrap_err();
        assert!(matches!(error, RecordError::Invalid { field, .. } if field == word), "{error}");
    }
    let error = record(&LOOP).unwrap().moduli(Loading, 2.0, 0.0).unwrap_err();
    assert!(matches!(error, RecordError::Setting { field: "section", .. }), "{error}");
}

#[test]
fn a_range_outside_of_the_record_and_an_invalid_specimen_are_refused() {
    let record = record(&LOOP).unwrap();
    let ask = |low, high| record.modulus(&SPECIMEN, Loading, low, high).unwrap_err();
    assert_eq!(
        ask(0.5, 10.0),
        RecordError::OutOfRange { low: 0.5, high: 10.0, phase: Loading, least: 1.0, greatest: 20.0 }
    );
    assert!(matches!(ask(10.0, 30.0), RecordError::OutOfRange { .. }));
    assert!(matches!(ask(10.0, 10.0), RecordError::Setting { field: "range", .. }));
    assert!(matches!(ask(f64::NAN, 10.0), RecordError::Setting { field: "range", .. }));
    let negative = Specimen { length: -1.0, ..SPECIMEN };
    assert!(matches!(
        record.modulus(&negative, Loading, 5.0, 10.0),
        Err(RecordError::Setting { field: "length", .. })
    ));
}
