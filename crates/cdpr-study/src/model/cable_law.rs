//! The elastic law of a cable as a file, `cdpr-law/1` (JSON, SI units): moduli over tension while it is
//! loaded and unloaded.

use crate::error::StudyError;
use crate::file::cable_law::{CableLaw, LAW_FORMAT, LawFile, UnloadingCurve};
use crate::fs::input::{from_text, read_text};
use crate::kind::InputKind;
use cdpr_cable::{CableError, Phase, PiecewiseLaw, Record, RecordError, TangentModulus};
use cdpr_robot::{CableProperties, LawSegment, Robot, RobotCable, Segment};
use cdpr_statics::hysteresis::{HysteresisLaw, Unloading};
use std::path::Path;

impl CableLaw {
    /// The law of a record of a specimen of this length [m] and section [m²].
    ///
    /// # Errors
    /// As [`Record::moduli`].
    pub fn of_record(record: &Record, length: f64, section: f64) -> Result<Self, RecordError> {
        let segments = |phase| -> Result<Vec<LawSegment>, RecordError> {
            let pieces = record.moduli(phase, length, section)?.into_iter();
            Ok(pieces.map(|TangentModulus { tension, modulus }| LawSegment { tension, modulus }).collect())
        };
        let [_, turning_tension] = record.forces(Phase::Loading);
        let unloading = UnloadingCurve { turning_tension, segments: segments(Phase::Unloading)? };
        Ok(Self { section, loading: segments(Phase::Loading)?, unloading: Some(unloading) })
    }

    /// The first invalid value: field, value, and what is expected.
    pub(crate) fn invalid(&self) -> Option<(String, String, &'static str)> {
        let positive = |field: String, value: f64, expected| {
            let sound = value.is_finite() && value > 0.0;
            (!sound).then(|| (field, value.to_string(), expected))
        };
        let of_curve = |curve: &str, segments: &[LawSegment]| {
            if segments.is_empty() {
                return Some((curve.to_owned(), "empty".to_owned(), "one segment at least"));
            }
            segments.iter().enumerate().find_map(|(k, LawSegment { tension, modulus })| {
                let begins = if k == 0 { *tension == 0.0 } else { *tension > segments[k - 1].tension };
                if !(begins && tension.is_finite()) {
                    let expected = "tensions that grow from 0 [N], where each segment begins";
                    return Some((format!("{curve}[{k}].tension"), tension.to_string(), expected));
                }
                positive(format!("{curve}[{k}].modulus"), *modulus, "a finite, positive modulus [Pa]")
            })
        };
        positive("section".to_owned(), self.section, "a finite, positive section [m²]")
            .or_else(|| of_curve("loading", &self.loading))
            .or_else(|| {
                let UnloadingCurve { turning_tension, segments } = self.unloading.as_ref()?;
                let field = "unloading.turning_tension".to_owned();
                positive(field, *turning_tension, "a finite, positive tension [N]")
                    .or_else(|| of_curve("unloading.segments", segments))
            })
    }

    /// Both curves of a cable, in proportion to its modulus.
    ///
    /// # Errors
    /// [`CableError::InvalidInput`] for invalid tensions or moduli, and for moduli out of proportion to the
    /// cable's.
    pub fn curves(&self, cable: &CableProperties, from: Unloading) -> Result<HysteresisLaw, CableError> {
        let Self { section, loading, unloading } = self;
        let scale = cable.section / section;
        let curve = |segments: &[LawSegment]| {
            let mut segments = LawSegment::in_proportion(segments, cable.youngs_modulus);
            segments.iter_mut().for_each(|segment| segment.tension *= scale);
            PiecewiseLaw::new(0.0, &segments)
        };
        let loading = curve(loading)?;
        Ok(match unloading {
            None => HysteresisLaw::elastic(loading),
            Some(UnloadingCurve { turning_tension, segments }) => HysteresisLaw {
                loading,
                unloading: curve(segments)?,
                turning_tension: scale * turning_tension,
                unloading_from: from,
            },
        })
    }
}

/// The laws of the robot's own cables, by which they lose no energy; `None` where no cable has one.
///
/// # Errors
/// Those of [`PiecewiseLaw::new`].
pub fn elastic_laws(robot: &Robot) -> Result<Option<Vec<HysteresisLaw>>, CableError> {
    if robot.is_linear() {
        return Ok(None);
    }
    let linear = PiecewiseLaw::new(0.0, &[Segment { tension: 0.0, ratio: 1.0 }])?;
    let law = |cable: &RobotCable| cable.properties.law.clone().unwrap_or_else(|| linear.clone());
    Ok(Some(robot.cables.iter().map(|cable| HysteresisLaw::elastic(law(cable))).collect()))
}

/// Reads and checks a law file.
///
/// # Errors
/// [`StudyError::Read`], and as [`read_law`].
pub fn open_law(path: &Path) -> Result<CableLaw, StudyError> {
    read_law(&read_text(path, InputKind::Law)?, path)
}

/// Reads and checks a law from the text of a law file; `path` names it in errors.
///
/// # Errors
/// [`StudyError::Format`]; [`StudyError::Invalid`] for an invalid law.
pub fn read_law(text: &str, path: &Path) -> Result<CableLaw, StudyError> {
    let file: LawFile = from_text(text, path, InputKind::Law)?;
    let wrong = if file.format == LAW_FORMAT {
        file.law.invalid().map(|(field, value, expected)| (format!("law.{field}"), value, expected))
    } else {
        Some(("format".to_owned(), file.format, LAW_FORMAT))
    };
    match wrong {
        None => Ok(file.law),
        Some((field, value, expected)) => {
            let expected = expected.to_owned();
            Err(StudyError::Invalid { path: path.to_owned(), field, value, expected }.placed(text))
        }
    }
}
