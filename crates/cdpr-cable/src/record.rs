//! A load-elongation record of a cable: moduli over ranges of load with their uncertainty, and the energy that a loop dissipates.
//!
//! A test bench loads a piece of cable of length `L_c` to some force and unloads it again. With x_p the elongation at p percent of
//! the breaking force, interpolated between the samples of one phase, the secant modulus is
//!
//! ```text
//! E_{p-q} = L_c (F_q - F_p) / (S (x_q - x_p))                                                     (5)
//! ```
//!
//! (ISO 12076; Eq. (5) of Baklouti, Caro, Courteille 2017). It is a product of powers, so that relative errors add: both forces and
//! both elongations are measured with the same absolute error, and with `ΔF = F_q - F_p`, `Δx = x_q - x_p`
//!
//! ```text
//! standard:  (δE/E)² = 2 (δF/ΔF)² + 2 (δx/Δx)² + (δL/L_c)² + (δS/S)²       independent errors
//! greatest:   δE/E   = 2 δF/ΔF + 2 δx/Δx + δL/L_c + δS/S                   all of them against us
//! ```
//!
//! The energy dissipated by the loop is the area `∮ F dx` between its branches, closed by a straight line where it does not close
//! by itself.

/// Whether a cable is being loaded or unloaded.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Phase {
    /// The force grows.
    Loading,
    /// The force falls.
    Unloading,
}

impl Phase {
    /// `loading` or `unloading`.
    pub fn name(self) -> &'static str {
        match self {
            Self::Loading => "loading",
            Self::Unloading => "unloading",
        }
    }
}

/// One line of a record.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Sample {
    /// Line of the file that it comes from, for messages.
    pub line: usize,
    /// Force [N].
    pub force: f64,
    /// Elongation [m].
    pub elongation: f64,
    /// Phase of the test.
    pub phase: Phase,
}

/// Why a record, or a question about it, was refused.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum RecordError {
    /// A value that a record cannot have.
    #[error("line {line}: {field} is {value}: expected {expected}")]
    Invalid {
        /// Line of the file.
        line: usize,
        /// Column of the file, or what follows from it.
        field: &'static str,
        /// What was given.
        value: String,
        /// What would be right.
        expected: String,
    },
    /// A phase without enough samples.
    #[error(
        "the record ends at line {line} with {found} samples of phase {}: expected 2 at least",
        phase.name()
    )]
    TooShort {
        /// Last line of the record.
        line: usize,
        /// The phase.
        phase: Phase,
        /// Its samples.
        found: usize,
    },
    /// A setting that no analysis can have.
    #[error("{field} is {value}: expected {expected}")]
    Setting {
        /// The setting.
        field: &'static str,
        /// What was given.
        value: f64,
        /// What would be right.
        expected: &'static str,
    },
    /// A range of load that the record does not hold.
    #[error(
        "the range {low} to {high} % of the breaking force is not in the record: while {} it runs from {least:.3} to {greatest:.3} %",
        phase.name()
    )]
    OutOfRange {
        /// Lower end of the range [%].
        low: f64,
        /// Upper end [%].
        high: f64,
        /// The phase.
        phase: Phase,
        /// Least load of the record in this phase [%].
        least: f64,
        /// Greatest load [%].
        greatest: f64,
    },
}

/// A loop: loading up to a turning point, then unloading from it.
#[derive(Clone, Debug, PartialEq)]
pub struct Record {
    loading: Vec<Sample>,
    /// Begins at the turning point.
    unloading: Vec<Sample>,
}

/// The piece of cable that was tested, and how exactly all was measured: absolute errors.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Specimen {
    /// Breaking force [N], of which ranges are percentages.
    pub breaking_force: f64,
    /// Section S [m²].
    pub section: f64,
    /// Length L_c between the clamps before loading [m].
    pub length: f64,
    /// Error of each force [N].
    pub force_error: f64,
    /// Error of each elongation [m].
    pub elongation_error: f64,
    /// Error of the length [m].
    pub length_error: f64,
    /// Error of the section [m²].
    pub section_error: f64,
}

/// A secant modulus with its uncertainty.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SecantModulus {
    /// E_{p-q} [Pa].
    pub modulus: f64,
    /// Uncertainty from independent errors [Pa].
    pub standard: f64,
    /// Uncertainty where all errors add up [Pa].
    pub greatest: f64,
}

/// Strains and moduli beyond these are those of another unit.
const MAX_STRAIN: f64 = 0.1;
const MODULI: std::ops::RangeInclusive<f64> = 1e9..=1e12;

impl Record {
    /// A record from its samples, in the order of the test: loading first, then unloading; in both, force and elongation move one way
    /// only, and unloading begins at or below the end of loading.
    ///
    /// # Errors
    /// [`RecordError::Invalid`] names the line; [`RecordError::TooShort`] a phase with fewer than two samples.
    pub fn new(samples: &[Sample]) -> Result<Self, RecordError> {
        for sample in samples {
            let fields = [("force_n", sample.force), ("elongation_mm", 1e3 * sample.elongation)];
            for (field, value) in fields {
                if !value.is_finite() {
                    return Err(sample.invalid(field, value, "a finite number"));
                }
            }
            if sample.force < 0.0 {
                return Err(sample.invalid("force_n", sample.force, "a force that pulls, zero or more [N]"));
            }
        }
        let loaded = samples.iter().take_while(|sample| sample.phase == Phase::Loading).count();
        let (loading, unloading) = samples.split_at(loaded);
        if let Some(late) = unloading.iter().find(|sample| sample.phase == Phase::Loading) {
            return Err(late.invalid("phase", "loading", "unloading up to the end: one loop a record"));
        }
        let line = samples.last().map_or(0, |sample| sample.line);
        for (phase, found) in [(Phase::Loading, loading.len()), (Phase::Unloading, unloading.len())] {
            if found < 2 {
                return Err(RecordError::TooShort { line, phase, found });
            }
        }
        let (turning, first) = (loading[loading.len() - 1], unloading[0]);
        let mut branch = Vec::with_capacity(unloading.len() + 1);
        // The turning point may be given once or twice.
        if (first.force, first.elongation) != (turning.force, turning.elongation) {
            branch.push(Sample { phase: Phase::Unloading, ..turning });
        }
        branch.extend_from_slice(unloading);
        monotone(loading, 1.0)?;
        monotone(&branch, -1.0)?;
        Ok(Self { loading: loading.to_vec(), unloading: branch })
    }

    /// Samples of a phase, in the order of the test; those of unloading begin with the last one of loading.
    pub fn samples(&self, phase: Phase) -> &[Sample] {
        match phase {
            Phase::Loading => &self.loading,
            Phase::Unloading => &self.unloading,
        }
    }

    /// Elongation [m] at a force [N], interpolated; `None` outside the record.
    pub fn elongation(&self, phase: Phase, force: f64) -> Option<f64> {
        self.samples(phase).windows(2).find_map(|pair| {
            let [(f0, x0), (f1, x1)] = [0, 1].map(|k| (pair[k].force, pair[k].elongation));
            // Percentages of the breaking force are rounded.
            let slack = 1e-9 * f0.max(f1);
            let within = f0.min(f1) - slack <= force && force <= f0.max(f1) + slack;
            within.then(|| x0 + (x1 - x0) * (force - f0) / (f1 - f0))
        })
    }

    /// E_{p-q} while loading or unloading, from `low` to `high` percent of the breaking force, Eq. (5).
    ///
    /// # Errors
    /// [`RecordError::Setting`] for a specimen or range that is none, [`RecordError::OutOfRange`]; [`RecordError::Invalid`] where
    /// strain or modulus are those of no cable, as with other units.
    pub fn modulus(
        &self,
        specimen: &Specimen,
        phase: Phase,
        low: f64,
        high: f64,
    ) -> Result<SecantModulus, RecordError> {
        specimen.validate()?;
        setting("range", low, low >= 0.0, "a lower end of zero or more [%]")?;
        setting("range", high, high > low, "an upper end above the lower one [%]")?;
        self.check_strain(specimen.length)?;
        let [least, greatest] = self.forces(phase).map(|force| 100.0 * force / specimen.breaking_force);
        let force = |percent: f64| 0.01 * percent * specimen.breaking_force;
        let (Some(x_low), Some(x_high)) =
            (self.elongation(phase, force(low)), self.elongation(phase, force(high)))
        else {
            return Err(RecordError::OutOfRange { low, high, phase, least, greatest });
        };
        let (df, dx) = (force(high) - force(low), x_high - x_low);
        let modulus = specimen.length * df / (specimen.section * dx);
        self.samples(phase)[0].check_modulus(modulus, &format!("between {low} and {high} %"))?;
        let (of_force, of_elongation) = (specimen.force_error / df, specimen.elongation_error / dx);
        let once = [specimen.length_error / specimen.length, specimen.section_error / specimen.section];
        let squares = 2.0 * (of_force * of_force + of_elongation * of_elongation)
            + once.iter().map(|error| error * error).sum::<f64>();
        let sum = 2.0 * (of_force + of_elongation) + once.iter().sum::<f64>();
        Ok(SecantModulus { modulus, standard: modulus * squares.sqrt(), greatest: modulus * sum })
    }

    /// Least and greatest force of a phase [N].
    pub fn forces(&self, phase: Phase) -> [f64; 2] {
        let samples = self.samples(phase);
        let (first, last) = (samples[0].force, samples[samples.len() - 1].force);
        [first.min(last), first.max(last)]
    }

    /// Energy dissipated by the loop [J]: the area between loading and unloading, closed by a straight line.
    pub fn dissipated_energy(&self) -> f64 {
        let around = || self.loading.iter().chain(&self.unloading);
        let closed = around().zip(around().skip(1).chain(self.loading.first()));
        closed.map(|(a, b)| 0.5 * (a.force + b.force) * (b.elongation - a.elongation)).sum()
    }

    /// The tangent modulus [Pa] of each piece between two samples of a phase, with the tension at which it begins [N], in ascending order,
    /// for a specimen of this length [m] and section [m²]. The first piece goes on down to zero.
    ///
    /// # Errors
    /// [`RecordError::Setting`] for a length or section that is none; [`RecordError::Invalid`] where strain or modulus of the whole
    /// phase are those of no cable, as with other units.
    pub fn moduli(&self, phase: Phase, length: f64, section: f64) -> Result<Vec<(f64, f64)>, RecordError> {
        check_specimen(length, section)?;
        self.check_strain(length)?;
        let modulus = |one: &Sample, other: &Sample| {
            length * (other.force - one.force) / (section * (other.elongation - one.elongation))
        };
        let samples = self.samples(phase);
        let (first, last) = (&samples[0], &samples[samples.len() - 1]);
        first.check_modulus(modulus(first, last), "over the whole phase")?;
        let mut pieces: Vec<_> = samples
            .windows(2)
            .map(|pair| (pair[0].force.min(pair[1].force), modulus(&pair[0], &pair[1])))
            .collect();
        pieces.sort_by(|one, other| one.0.total_cmp(&other.0));
        pieces[0].0 = 0.0;
        Ok(pieces)
    }

    /// Strain at the turning point, whose excess is the sign of another unit.
    fn check_strain(&self, length: f64) -> Result<(), RecordError> {
        let (first, turning) = (self.loading[0], self.unloading[0]);
        let strain = (turning.elongation - first.elongation) / length;
        if strain > MAX_STRAIN {
            return Err(turning.invalid(
                "elongation_mm",
                format!(
                    "{} more than at the start, {:.3} of the length",
                    1e3 * (turning.elongation - first.elongation),
                    strain
                ),
                "a strain up to 0.1: elongations in mm, the length in m",
            ));
        }
        Ok(())
    }
}

impl Specimen {
    fn validate(&self) -> Result<(), RecordError> {
        setting("breaking force", self.breaking_force, self.breaking_force > 0.0, "a positive force [N]")?;
        check_specimen(self.length, self.section)?;
        for (field, value) in [
            ("force error", self.force_error),
            ("elongation error", self.elongation_error),
            ("length error", self.length_error),
            ("section error", self.section_error),
        ] {
            setting(field, value, value >= 0.0, "a finite error, zero or more")?;
        }
        Ok(())
    }
}

fn check_specimen(length: f64, section: f64) -> Result<(), RecordError> {
    setting("section", section, section > 0.0, "a positive section [m²]")?;
    setting("length", length, length > 0.0, "a positive length [m]")
}

impl Sample {
    /// A modulus that no cable has is the sign of another unit.
    fn check_modulus(&self, modulus: f64, of: &str) -> Result<(), RecordError> {
        if MODULI.contains(&modulus) {
            return Ok(());
        }
        let expected =
            "a modulus from 1e9 to 1e12 Pa: forces in N, elongations in mm, length in m, section in m²";
        Err(self.invalid("modulus", format!("{modulus:e} Pa {of}"), expected))
    }

    fn invalid(&self, field: &'static str, value: impl ToString, expected: &str) -> RecordError {
        RecordError::Invalid {
            line: self.line,
            field,
            value: value.to_string(),
            expected: expected.to_owned(),
        }
    }
}

fn setting(
    field: &'static str,
    value: f64,
    admissible: bool,
    expected: &'static str,
) -> Result<(), RecordError> {
    if value.is_finite() && admissible {
        Ok(())
    } else {
        Err(RecordError::Setting { field, value, expected })
    }
}

/// Checks that force and elongation grow (`sign` = 1) or fall (-1) with every sample.
fn monotone(samples: &[Sample], sign: f64) -> Result<(), RecordError> {
    let way = if sign > 0.0 { "more" } else { "less" };
    for pair in samples.windows(2) {
        let [before, now] = [pair[0], pair[1]];
        let fields = [
            ("force_n", now.force, before.force),
            ("elongation_mm", 1e3 * now.elongation, 1e3 * before.elongation),
        ];
        for (field, value, previous) in fields {
            if sign * (value - previous) <= 0.0 {
                let expected = format!(
                    "{way} than {previous} of line {} while {}; smooth a noisy record, or thin it out",
                    before.line,
                    now.phase.name()
                );
                return Err(now.invalid(field, value, &expected));
            }
        }
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;
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
        for place in [1, 2] {
            let mut rows = LOOP;
            rows[place].1 += h * 0.03;
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
        assert_relative_eq!(
            found.greatest,
            shares.iter().map(|share| share.abs()).sum(),
            max_relative = 1e-3
        );
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
        let with = |place: usize, row: (f64, f64, Phase)| {
            let mut rows = LOOP;
            rows[place] = row;
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
    fn units_that_are_not_those_of_the_columns_are_noticed() {
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
    fn tangents_are_those_of_the_pieces_whose_units_are_looked_at() {
        let moduli = |phase| record(&LOOP).unwrap().moduli(phase, 2.0, 1e-5).unwrap();
        let close = |found: Vec<(f64, f64)>, expected: &[(f64, f64)]| {
            assert_eq!(found.len(), expected.len());
            for (one, other) in found.iter().zip(expected) {
                assert_eq!(one.0, other.0);
                assert_relative_eq!(one.1, other.1, max_relative = 1e-12);
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
    fn a_question_that_the_record_does_not_answer_is_refused() {
        let record = record(&LOOP).unwrap();
        let ask = |low, high| record.modulus(&SPECIMEN, Loading, low, high).unwrap_err();
        assert_eq!(
            ask(0.5, 10.0),
            RecordError::OutOfRange { low: 0.5, high: 10.0, phase: Loading, least: 1.0, greatest: 20.0 }
        );
        assert!(matches!(ask(10.0, 30.0), RecordError::OutOfRange { .. }));
        assert!(matches!(ask(10.0, 10.0), RecordError::Setting { field: "range", .. }));
        assert!(matches!(ask(f64::NAN, 10.0), RecordError::Setting { field: "range", .. }));
        let none = Specimen { length: -1.0, ..SPECIMEN };
        assert!(matches!(
            record.modulus(&none, Loading, 5.0, 10.0),
            Err(RecordError::Setting { field: "length", .. })
        ));
    }
}
