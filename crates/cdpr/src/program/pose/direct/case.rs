//! A direct problem as the arguments or a file have it.

use crate::program::arguments::poses;
use crate::program::questions;
use cdpr_robot::{Robot, Vector3, Wrench, from_json, plausible};
use cdpr_statics::Load;
use cdpr_study::{InputKind, StudyError, other_kind, read_text};
use serde::Deserialize;
use serde::de::IgnoredAny;
use std::path::Path;

/// A direct problem, also as a file has it. The fields behind `certify` are those of an answer of `inverse`
/// or `deflection`, which are of no importance here.
#[derive(Default, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub(super) struct Case {
    pub(super) lengths: Vec<f64>,
    pub(super) mass: Option<f64>,
    pub(super) force: Option<[f64; 3]>,
    pub(super) moment: Option<[f64; 3]>,
    pub(super) payload: Option<f64>,
    /// Start of the search: position, or position and quaternion, three or seven numbers.
    pub(super) pose: Option<Vec<f64>>,
    /// Where the inverse model has found a rest with free coordinates: the start then.
    found_pose: Option<Vec<f64>>,
    pub(super) certify: bool,
    tensions: IgnoredAny,
    exit_tensions: IgnoredAny,
    cable_forces: IgnoredAny,
    stable: IgnoredAny,
    least_stiffness_n_per_m: IgnoredAny,
    neutral: IgnoredAny,
    report: IgnoredAny,
    out_of_limits: IgnoredAny,
    jump: IgnoredAny,
    questions: IgnoredAny,
    given: IgnoredAny,
    roll_pitch_yaw_deg: IgnoredAny,
    loops: IgnoredAny,
    iterations: IgnoredAny,
    residual: IgnoredAny,
    others: IgnoredAny,
    deflection_mm: IgnoredAny,
    magnitude_mm: IgnoredAny,
    rounding_mm: IgnoredAny,
    rotation_deg: IgnoredAny,
    unloaded: IgnoredAny,
    loaded: IgnoredAny,
    /// Why the inverse model has no lengths.
    pub(super) error: Option<CaseError>,
}

impl Case {
    /// Where the search starts.
    pub(super) fn start(&self) -> Option<&Vec<f64>> {
        self.found_pose.as_ref().or(self.pose.as_ref())
    }

    /// The same with other lengths [m].
    pub(super) fn with_lengths(&self, lengths: Vec<f64>) -> Self {
        Self {
            lengths,
            mass: self.mass,
            force: self.force,
            moment: self.moment,
            payload: self.payload,
            pose: self.pose.clone(),
            ..Self::default()
        }
    }

    /// Asks about lengths, mass, load and start.
    pub(super) fn question(&self, robot: &Robot) {
        questions::about_lengths(robot, &self.lengths);
        // A mass that is not positive is refused.
        let mass = self.mass.filter(|mass| *mass > 0.0);
        questions::ask(mass.and_then(|mass| plausible::mass(robot, "mass", mass)));
        questions::about_load(robot, &self.load());
        if let Some(start) = self.start().and_then(|numbers| poses::stated_pose(numbers).ok()) {
            questions::about_pose(robot, "pose", &start);
        }
    }

    pub(super) fn load(&self) -> Load {
        let vector = |components: Option<[f64; 3]>| components.map_or_else(Vector3::zeros, Vector3::from);
        let wrench = Wrench { force: vector(self.force), moment: vector(self.moment) };
        Load { payload: self.payload.unwrap_or(0.0), wrench }
    }
}

/// Why a case has no lengths.
#[derive(Deserialize)]
pub(super) struct CaseError {
    pub(super) message: String,
}

pub(super) enum Cases {
    One(Box<Case>),
    List(Vec<Case>),
}

/// What a file has.
const CASE: &str = "expected a case of lengths, mass, force, moment, payload, pose and certify, or what `inverse` \
                    or `deflection` prints with --format json";

impl Cases {
    /// The cases of a file; `None` where it is a table.
    pub(super) fn read(path: &Path) -> Result<Option<Self>, StudyError> {
        let text = read_text(path, InputKind::Cases)?;
        let lines: Vec<&str> = text.lines().filter(|line| !line.trim().is_empty()).collect();
        let is_one_a_line = lines.len() > 1 && lines.iter().all(|line| line.trim_end().ends_with('}'));
        let cases = if text.trim_start().starts_with('[') {
            from_json(&text).map(Self::List)
        } else if is_one_a_line && lines.iter().all(|line| line.starts_with('{')) {
            from_json(&format!("[{}]", lines.join(",\n"))).map(Self::List)
        } else {
            from_json(&text).map(|case| Self::One(Box::new(case)))
        };
        let other = other_kind(path, &text, InputKind::Cases);
        if matches!(other, Some(StudyError::OtherKind { found: InputKind::Table, .. })) {
            return Ok(None);
        }
        cases.map(Some).map_err(|mut source| {
            if source.message.contains("unknown field `in_weather`") {
                source.message =
                    format!("`direct` has no weather: without the field `in_weather` it is a case; {CASE}");
            }
            // The list of serde has the fields of answers, too.
            if let Some((unknown, _)) = source.message.split_once("`, expected") {
                source.message = format!("{unknown}`: {CASE}");
            }
            other.unwrap_or_else(|| StudyError::Format { path: path.to_owned(), source })
        })
    }
}
