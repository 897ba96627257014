//! Analysis of a sampling at several poses: a row for each pose, and a summary of all. Laws, replicates and
//! measures of sensitivity, which a sampling at one pose has, would take longer than the observations and are
//! not computed.

use crate::analysis::extremes::Extremes;
use crate::analysis::verdict::{PartVerdict, number, of_failed};
use crate::error::StudyError;
use crate::file::output::Output;
use crate::model::grid::Grid;
use crate::model::nominal::too_much;
use crate::model::pose_set::PoseSet;
use crate::model::study::{Sampling, Study};
use crate::observe::observation::{Session, Tally};
use cdpr_robot::{Pose, counted, listing};
use cdpr_sensitivity::SampleDesign;
use rayon::prelude::*;
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;

/// [`PoseRow::status`] of a pose at which the nominal robot has feasible tensions.
pub const HELD: &str = "held";

/// A row of `NAME.csv`: position [m], rotation as a unit quaternion, statistics of the output in its unit.
/// Values that do not exist are empty.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[allow(missing_docs)]
pub struct PoseRow {
    /// Name of the sampling at this pose, of its blocks and of its table.
    pub sampling: String,
    #[serde(rename = "x_m")]
    pub x: f64,
    #[serde(rename = "y_m")]
    pub y: f64,
    #[serde(rename = "z_m")]
    pub z: f64,
    pub qw: f64,
    pub qx: f64,
    pub qy: f64,
    pub qz: f64,
    /// [`HELD`], or the kind of failure of the nominal robot.
    pub status: String,
    /// Number of observations, failed ones included; 0 for a pose without feasible tensions.
    pub observations: usize,
    pub failed: usize,
    /// Value of the nominal robot.
    #[serde(rename = "nominal_mm")]
    pub nominal: Option<f64>,
    /// Over the observations; this and the following are empty where fewer than two have succeeded.
    #[serde(rename = "mean_mm")]
    pub mean: Option<f64>,
    /// Standard deviation, with n - 1.
    #[serde(rename = "std_mm")]
    pub std: Option<f64>,
    #[serde(rename = "min_mm")]
    pub min: Option<f64>,
    #[serde(rename = "max_mm")]
    pub max: Option<f64>,
    /// The parameter with the largest t-Student index.
    pub dominant: Option<String>,
    /// That index.
    pub dominant_t: Option<f64>,
    /// Mean output in the upper half of its range minus that in the lower half.
    #[serde(rename = "dominant_effect_mm")]
    pub dominant_effect: Option<f64>,
    /// Why the nominal robot has no feasible tensions there, or which of its tensions are above their limits
    /// or breaking forces, without or with the payload.
    pub reason: Option<String>,
}

/// Summary of all poses of a sampling, serialized into `summary.json`. `NAME.csv` beside it has a row for
/// each pose.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct PosesSummary {
    /// Title.
    pub title: String,
    /// The answer in words.
    pub verdict: PartVerdict,
    /// What is observed.
    #[serde(default, skip_serializing_if = "crate::file::is_default")]
    pub output: Output,
    /// Number of poses.
    pub poses: usize,
    /// The grid of the poses, if they are on one.
    pub grid: Option<Grid>,
    /// Number of poses by status.
    pub status: BTreeMap<String, usize>,
    /// Observations of all poses with feasible tensions, failed ones included.
    pub observations: usize,
    /// Failed observations by kind.
    pub failed: BTreeMap<String, usize>,
    /// Mean of the output in its unit; this and the next are absent if no pose has one.
    #[serde(rename = "mean_mm")]
    pub mean: Option<Extremes>,
    /// Its standard deviation.
    #[serde(rename = "std_mm")]
    pub std: Option<Extremes>,
    /// Number of poses at which tensions of the nominal robot are above their limits or breaking forces.
    #[serde(default, skip_serializing_if = "crate::file::is_default")]
    pub out_of_limits: usize,
    /// Number of poses at which each parameter has the largest t-Student index.
    pub dominant: BTreeMap<String, usize>,
}

/// Poses that are under way at a time: more than threads, for poses with few observations, but few enough for
/// the memory.
const AT_A_TIME: usize = 64;

/// Results of a sampling at several poses.
#[derive(Clone, Debug)]
pub struct PosesResult {
    /// Summary over all poses.
    pub summary: PosesSummary,
    /// A row for each pose, in the order of the poses.
    pub rows: Vec<PoseRow>,
}

/// Makes the missing observations of a sampling at several poses and summarizes them.
///
/// `observe`, such as [`crate::observe`], makes the observations of one pose. A pose at which the nominal
/// robot has no feasible tensions is a row with the reason.
///
/// # Errors
/// Those of `observe`; [`StudyError::Invalid`] for a sampling without several poses.
pub fn observe_poses(
    study: &Study,
    name: &str,
    session: &Session,
    observe: impl Fn(&Sampling) -> Result<Tally, StudyError> + Sync,
) -> Result<PosesResult, StudyError> {
    let (_, spec) = study.entry(name)?;
    let poses = study.poses(name, spec)?;
    let Some(count) = poses.several() else {
        return Err(study.invalid("samplings", name, "the name of a sampling at several poses"));
    };
    let mut summary = PosesSummary {
        title: spec.title.clone(),
        output: study.file.output,
        poses: count,
        grid: match poses {
            PoseSet::Grid(grid) => Some(grid),
            _ => None,
        },
        ..PosesSummary::default()
    };
    let one = |number: usize| {
        let name = poses.name(name, number);
        match study.sampling(&name) {
            Ok(sampling) => {
                let tally = observe(&sampling)?;
                Ok((PoseRow::held(&sampling, &tally), tally.failed))
            }
            Err(StudyError::Nominal { source, .. }) => {
                (session.tick)(spec.observations);
                let pose = study.located(&name)?.pose;
                let row = PoseRow {
                    status: source.kind().to_owned(),
                    reason: Some(source.to_string()),
                    ..PoseRow::at(name, &pose)
                };
                Ok((row, BTreeMap::new()))
            }
            Err(error) => Err(error),
        }
    };
    let mut rows = Vec::with_capacity(count);
    for first in (0..count).step_by(AT_A_TIME) {
        let made: Vec<_> = (first..count.min(first + AT_A_TIME))
            .into_par_iter()
            .map(one)
            .collect::<Result<_, StudyError>>()?;
        for (row, failed) in made {
            summary.add(&row, failed);
            rows.push(row);
        }
    }
    let over = |value: fn(&PoseRow) -> Option<f64>| {
        Extremes::of(rows.iter().filter_map(|row| Some((value(row)?, [row.x, row.y, row.z]))))
    };
    (summary.mean, summary.std) = (over(|row| row.mean), over(|row| row.std));
    summary.verdict.sentences = summary.sentences();
    Ok(PosesResult { summary, rows })
}

impl PosesSummary {
    fn add(&mut self, row: &PoseRow, failed: BTreeMap<String, usize>) {
        *self.status.entry(row.status.clone()).or_default() += 1;
        self.observations += row.observations;
        self.out_of_limits += usize::from(row.status == HELD && row.reason.is_some());
        for (kind, count) in failed {
            *self.failed.entry(kind).or_default() += count;
        }
        if let Some(name) = &row.dominant {
            *self.dominant.entry(name.clone()).or_default() += 1;
        }
    }

    /// Means at the poses, poses that are not held, failed observations, and what dominates.
    fn sentences(&self) -> Vec<String> {
        let (noun, unit, held) = (self.output.noun(), self.output.unit(), self.held());
        let mut sentences = vec![match self.mean {
            Some(Extremes { min, max, .. }) => {
                let [min, max] = [min, max].map(number);
                format!("Mean {noun} {min} to {max} {unit} over {}.", counted(held, "pose"))
            }
            None => format!("No {noun} at any of {}.", counted(self.poses, "pose")),
        }];
        if held < self.poses {
            let kinds = self.status.iter().filter(|(status, _)| *status != HELD);
            let kinds: Vec<String> =
                kinds.map(|(kind, count)| format!("{count} {}", kind.replace('_', " "))).collect();
            let not_held = self.poses - held;
            let before = format!("{not_held} of {} poses are not held: ", self.poses);
            sentences.push(listing(&before, &kinds, "."));
        }
        sentences.extend(of_failed(&self.failed, self.observations));
        let mut dominant: Vec<_> = self.dominant.iter().collect();
        dominant.sort_by_key(|(_, count)| std::cmp::Reverse(**count));
        let dominant: Vec<String> =
            dominant.iter().map(|(name, count)| format!("{name} at {count}")).collect();
        if !dominant.is_empty() {
            sentences.push(listing("Largest t-Student index: ", &dominant, " poses."));
        }
        sentences
    }

    /// Poses at which the nominal robot has feasible tensions.
    pub fn held(&self) -> usize {
        self.status.get(HELD).copied().unwrap_or(0)
    }
}

impl PoseRow {
    /// A pose without any result.
    fn at(sampling: String, pose: &Pose) -> Self {
        let ([x, y, z], [qw, qx, qy, qz]) = (pose.position.into(), pose.quaternion());
        Self { sampling, x, y, z, qw, qx, qy, qz, ..Self::default() }
    }

    fn held(sampling: &Sampling, tally: &Tally) -> Self {
        let found = tally.sums.outputs().summary().ok();
        let range = tally.range().filter(|_| found.is_some());
        // An index needs observations in both halves of every range.
        // It would show what correlated inputs cause, too.
        let independent = sampling.correlation.is_none();
        let effects = tally.sums.effects(sampling.design.inputs()).ok().filter(|_| independent);
        let effects = effects.into_iter().flat_map(|effects| effects.effects);
        let dominant = effects
            .filter(|effect| effect.student > 0.0)
            .reduce(|largest, effect| if effect.student > largest.student { effect } else { largest });
        Self {
            status: HELD.to_owned(),
            observations: sampling.design.points(),
            failed: tally.failed.values().sum(),
            nominal: Some(sampling.nominal_value),
            mean: found.map(|found| found.mean),
            std: found.map(|found| found.std),
            min: range.map(|[min, _]| min),
            max: range.map(|[_, max]| max),
            dominant: dominant.as_ref().map(|effect| effect.input.clone()),
            dominant_t: dominant.as_ref().map(|effect| effect.student),
            dominant_effect: dominant.as_ref().map(|effect| effect.effect),
            reason: Some(too_much(sampling.robot, &sampling.nominal).join("; "))
                .filter(|text| !text.is_empty()),
            ..Self::at(sampling.name.clone(), &sampling.pose)
        }
    }
}
