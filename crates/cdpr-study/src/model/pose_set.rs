//! Samplings at several poses. Each pose is a sampling of its own, `NAME/0000`, `NAME/0001`, ..., with
//! blocks and a table of its own; [`crate::PosesSummary`] summarizes them.

use crate::error::StudyError;
use crate::file::study_file::{PoseSpec, PosesSpec, SamplingSpec};
use crate::model::grid::Grid;
use crate::model::nominal::NominalAt;
use crate::model::study::{Study, keys};
use cdpr_robot::{Pose, QuaternionError, Vector3, rotation_by_angles, rotation_in_order};

/// The poses of a sampling.
#[derive(Clone, Copy, Debug)]
pub(crate) enum PoseSet<'a> {
    One(&'a PoseSpec),
    List(&'a [PoseSpec]),
    Grid(Grid),
}

impl PoseSet<'_> {
    /// Number of poses; `None` for a sampling at one pose.
    pub(crate) fn several(&self) -> Option<usize> {
        match self {
            Self::One(_) => None,
            Self::List(list) => Some(list.len()),
            Self::Grid(grid) => Some(grid.count()),
        }
    }

    /// Name of the sampling at a pose.
    pub(crate) fn name(&self, sampling: &str, number: usize) -> String {
        match self.several() {
            None => sampling.to_owned(),
            Some(poses) => format!("{sampling}/{number:0width$}", width = digits(poses)),
        }
    }

    /// The pose of that name: its number, from what follows the name of the sampling.
    fn number(&self, suffix: Option<&str>) -> Option<usize> {
        match (self.several(), suffix) {
            (None, None) => Some(0),
            (Some(poses), Some(text)) => {
                let number = text.parse().ok().filter(|number| *number < poses)?;
                (text.len() == digits(poses) && !text.starts_with('+')).then_some(number)
            }
            (_, _) => None,
        }
    }
}

/// Digits of the numbers of poses: four, or as many as the last one has.
fn digits(poses: usize) -> usize {
    poses.saturating_sub(1).to_string().len().max(4)
}

impl SamplingSpec {
    /// Where the nominal robot is in this sampling at one of its poses.
    pub(crate) fn at(&self, pose: Pose) -> NominalAt {
        NominalAt { pose, free: self.free.clone(), lengths: self.lengths.clone() }
    }
}

impl Study {
    /// The names of all samplings at one pose each: `NAME` itself, or `NAME/0000`, `NAME/0001`, ... for one
    /// at several poses.
    pub fn sampling_names(&self) -> impl Iterator<Item = String> {
        self.file.samplings.iter().flat_map(|(name, spec)| {
            // Checked when the study was read.
            let set = self.poses(name, spec).ok();
            let poses = set.map_or(0, |set| set.several().unwrap_or(1));
            (0..poses).filter_map(move |number| Some(set?.name(name, number)))
        })
    }

    /// The poses of a sampling.
    ///
    /// # Errors
    /// [`StudyError::Invalid`] for an empty list or an invalid grid.
    pub(crate) fn poses<'a>(&self, name: &str, spec: &'a SamplingSpec) -> Result<PoseSet<'a>, StudyError> {
        let field = format!("samplings.{name}");
        match (&spec.pose, &spec.poses) {
            (Some(pose), None) => Ok(PoseSet::One(pose)),
            (None, Some(PosesSpec::List(list))) => {
                if list.is_empty() {
                    return Err(self.invalid(&format!("{field}.poses.list"), "empty", "at least one pose"));
                }
                Ok(PoseSet::List(list))
            }
            (None, Some(PosesSpec::Grid(grid))) => {
                let grid = Grid::of(grid).map_err(|(axis, value, expected)| {
                    let axis = axis.map(|axis| format!(".{axis}")).unwrap_or_default();
                    self.invalid(&format!("{field}.poses.grid{axis}"), value, &expected)
                })?;
                match grid.of_free(&spec.free) {
                    Some((one, expected)) => Err(self.invalid(&format!("{field}.free"), one, &expected)),
                    None => Ok(PoseSet::Grid(grid)),
                }
            }
            (pose, _) => {
                let found = if pose.is_some() { "`pose` and `poses`" } else { "missing" };
                Err(self.invalid(&format!("{field}.pose"), found, "either `pose` or `poses`"))
            }
        }
    }

    /// A sampling of the study file with its name.
    pub(crate) fn entry(&self, name: &str) -> Result<(&str, &SamplingSpec), StudyError> {
        match self.file.samplings.get_key_value(name) {
            Some((name, spec)) => Ok((name, spec)),
            None => Err(self.invalid(&format!("samplings.{name}"), "missing", &keys(&self.file.samplings))),
        }
    }

    /// Looks up a sampling in the study file: its name there, its entry, its pose, and the field of the
    /// pose.
    ///
    /// # Errors
    /// [`StudyError::Invalid`] for an unknown name or an invalid pose.
    pub(crate) fn located(&self, name: &str) -> Result<Located<'_>, StudyError> {
        let (entry, suffix) = name.split_once('/').map_or((name, None), |(entry, rest)| (entry, Some(rest)));
        let (entry, spec) = self.entry(entry)?;
        let set = self.poses(entry, spec)?;
        let Some(number) = set.number(suffix) else {
            let last = set.several().map_or(0, |poses| poses - 1);
            let expected = match set.several() {
                Some(_) => format!("one pose: {} to {}", set.name(entry, 0), set.name(entry, last)),
                None => format!("{entry}, which has one pose"),
            };
            return Err(self.invalid(&format!("samplings.{entry}"), name, &expected));
        };
        let (pose, field) = match set {
            PoseSet::One(pose) => {
                (self.pose(&format!("samplings.{entry}.pose"), pose)?, "pose.position".to_owned())
            }
            PoseSet::List(list) => {
                let field = format!("poses.list[{number}]");
                let pose = self.pose(&format!("samplings.{entry}.{field}"), &list[number])?;
                (pose, format!("{field}.position"))
            }
            PoseSet::Grid(grid) => (grid.pose(number), "poses.grid".to_owned()),
        };
        Ok(Located {
            name: set.name(entry, number),
            entry,
            spec,
            pose,
            field: format!("samplings.{entry}.{field}"),
        })
    }

    /// Each pose is valid; whether it has an equilibrium is another question.
    pub(crate) fn check_poses(&self, name: &str, set: &PoseSet) -> Result<(), StudyError> {
        let PoseSet::List(list) = set else { return Ok(()) };
        let field = |number| format!("samplings.{name}.poses.list[{number}]");
        list.iter().enumerate().try_for_each(|(number, pose)| self.pose(&field(number), pose).map(|_| ()))
    }

    pub(crate) fn pose(&self, field: &str, spec: &PoseSpec) -> Result<Pose, StudyError> {
        let wrong = |(of, value, expected): InField| self.invalid(&format!("{field}.{of}"), value, &expected);
        spec.pose().map_err(wrong)
    }
}

/// An invalid value: its field below that of what it is in, the value, and what is expected.
pub type InField = (String, String, String);

impl PoseSpec {
    /// The pose.
    ///
    /// # Errors
    /// Field, value and what is expected.
    pub fn pose(&self) -> Result<Pose, InField> {
        let wrong = |field: &str, value: String, expected: String| (field.to_owned(), value, expected);
        let finite = |numbers: &[f64]| numbers.iter().all(|number| number.is_finite());
        if !finite(&self.position) {
            return Err(wrong("position", format!("{:?}", self.position), "finite numbers [m]".to_owned()));
        }
        let rotation = match self.rpy_deg {
            Some(angles) if self.quaternion == Self::level() && finite(&angles) => rotation_by_angles(angles),
            Some(angles) => {
                let expected = "finite angles [degrees], and no `quaternion` with them".to_owned();
                return Err(wrong("rpy_deg", format!("{angles:?}"), expected));
            }
            None => rotation_in_order(self.quaternion).map_err(|error| {
                let or_angles =
                    if matches!(error, QuaternionError::Order { .. }) { " in `rpy_deg`" } else { "" };
                let value = format!("{}, which {}", error.value(), error.fault());
                wrong("quaternion", value, format!("{}{or_angles}", error.expected()))
            })?,
        };
        Ok(Pose { position: Vector3::from(self.position), rotation })
    }
}

impl PosesSpec {
    /// The poses, at least one.
    ///
    /// # Errors
    /// Field, value and what is expected.
    pub fn poses(&self) -> Result<Vec<Pose>, InField> {
        match self {
            Self::List(list) if list.is_empty() => {
                Err(("list".to_owned(), "empty".to_owned(), "at least one pose".to_owned()))
            }
            Self::List(list) => {
                let of = |k, (field, value, expected)| (format!("list[{k}].{field}"), value, expected);
                list.iter().enumerate().map(|(k, pose)| pose.pose().map_err(|wrong| of(k, wrong))).collect()
            }
            Self::Grid(grid) => match Grid::of(grid) {
                Ok(grid) => Ok(grid.poses()),
                Err((axis, value, expected)) => {
                    let axis = axis.map(|axis| format!(".{axis}")).unwrap_or_default();
                    Err((format!("grid{axis}"), value, expected))
                }
            },
        }
    }
}

/// A sampling at one pose in the study file.
pub(crate) struct Located<'a> {
    /// Its own name.
    pub(crate) name: String,
    /// Name of its entry.
    pub(crate) entry: &'a str,
    pub(crate) spec: &'a SamplingSpec,
    pub(crate) pose: Pose,
    /// Path of the pose.
    pub(crate) field: String,
}
