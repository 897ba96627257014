//! Secant and tangent moduli of a record.

use crate::error::MAX_STRAIN;
use crate::number::short;
use crate::record::load_cycle::Record;
use crate::record::sample::{Phase, RecordError, Sample};

/// The piece of cable that was tested, with the absolute errors of all measurements.
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
    /// Modulus E_{p-q} [Pa].
    pub modulus: f64,
    /// Uncertainty from independent errors [Pa], (C32).
    pub standard: f64,
    /// Uncertainty where all errors add up [Pa], (C33).
    pub greatest: f64,
}

/// The modulus of a piece of a record between two samples.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TangentModulus {
    /// Tension at which the piece begins [N].
    pub tension: f64,
    /// Tangent modulus from there on [Pa].
    pub modulus: f64,
}

/// Moduli of cables [Pa].
const MODULI: std::ops::RangeInclusive<f64> = 1e9..=1e12;

impl Record {
    /// Secant modulus E_{p-q} of a phase, from `low` to `high` percent of the breaking force, Eq. (5).
    ///
    /// # Errors
    /// [`RecordError::Setting`] for an invalid specimen or range; [`RecordError::OutOfRange`];
    /// [`RecordError::Invalid`] where strain or modulus are so far from those of cables that the units must
    /// be wrong.
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
        // Eq. (5)
        let modulus = specimen.length * df / (specimen.section * dx);
        self.samples(phase)[0].check_modulus(modulus, &format!("between {low} and {high} %"))?;
        let (of_force, of_elongation) = (specimen.force_error / df, specimen.elongation_error / dx);
        let once = [specimen.length_error / specimen.length, specimen.section_error / specimen.section];
        let squares = 2.0 * (of_force * of_force + of_elongation * of_elongation)
            + once.iter().map(|error| error * error).sum::<f64>();
        let sum = 2.0 * (of_force + of_elongation) + once.iter().sum::<f64>();
        Ok(SecantModulus { modulus, standard: modulus * squares.sqrt(), greatest: modulus * sum })
    }

    /// Tangent modulus of each piece between two samples of a phase, in ascending order of tension.
    ///
    /// The specimen has this length [m] and section [m²]. The first piece goes on down to zero tension.
    ///
    /// # Errors
    /// [`RecordError::Setting`] for an invalid length or section; [`RecordError::Invalid`] where strain or
    /// modulus of the whole phase are so far from those of cables that the units must be wrong.
    pub fn moduli(
        &self,
        phase: Phase,
        length: f64,
        section: f64,
    ) -> Result<Vec<TangentModulus>, RecordError> {
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
            .map(|pair| TangentModulus {
                tension: pair[0].force.min(pair[1].force),
                modulus: modulus(&pair[0], &pair[1]),
            })
            .collect();
        pieces.sort_by(|one, other| one.tension.total_cmp(&other.tension));
        pieces[0].tension = 0.0;
        Ok(pieces)
    }

    /// Checks the strain at the turning point, which is too large where units are wrong.
    fn check_strain(&self, length: f64) -> Result<(), RecordError> {
        let [first, turning] = [Phase::Loading, Phase::Unloading].map(|phase| self.samples(phase)[0]);
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
    /// Checks a modulus, which is far from that of a cable where units are wrong.
    fn check_modulus(&self, modulus: f64, of: &str) -> Result<(), RecordError> {
        if MODULI.contains(&modulus) {
            return Ok(());
        }
        let expected =
            "a modulus from 1e9 to 1e12 Pa: forces in N, elongations in mm, length in m, section in m²";
        Err(self.invalid("modulus", format!("{} Pa {of}", short(modulus)), expected))
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
