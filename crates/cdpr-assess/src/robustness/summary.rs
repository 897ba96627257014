//! Counts and spreads of a test's solves, in total and for each start offset.

use super::{Answer, Assignment, Outcome, Published, Refusal, RobustnessResult, Solve, StartOffset};
use cdpr_robot::rounded;
use cdpr_statics::DirectMethod;
use indexmap::IndexMap;
use serde::Serialize;
use std::collections::BTreeMap;

/// Results of several tests; `robustness.json`.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct RobustnessSummary {
    /// Name of the robot.
    pub robot: String,
    /// Version of the program.
    pub version: String,
    /// Results by the protocol's name.
    pub protocols: IndexMap<String, ProtocolSummary>,
}

/// Settings and results of one test.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct ProtocolSummary {
    /// Title.
    pub title: String,
    /// Young's modulus of all cables [Pa] in place of the robot's.
    #[serde(rename = "youngs_modulus_pa")]
    pub youngs_modulus: Option<f64>,
    /// Least coordinates of the poses [m].
    #[serde(rename = "region_low_m")]
    pub region_low: [f64; 3],
    /// Greatest coordinates of the poses [m].
    #[serde(rename = "region_high_m")]
    pub region_high: [f64; 3],
    /// Greatest rotation of the poses [degrees].
    pub region_angle_deg: f64,
    /// Number of poses that were solved.
    pub poses: usize,
    /// How poses and start offsets were combined.
    pub assignment: Assignment,
    /// Seed.
    pub seed: u64,
    /// A pose is found if P is as near as this [m] ...
    #[serde(rename = "found_distance_m")]
    pub found_distance: f64,
    /// ... and the rotation [degrees].
    pub found_angle_deg: f64,
    /// Where the poses come from.
    pub draws: Draws,
    /// All solves.
    pub total: RobustnessRow,
    /// The solves of each start offset.
    pub rows: Vec<RobustnessRow>,
}

/// The poses drawn until enough had a stable equilibrium.
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize)]
pub struct Draws {
    /// Poses drawn.
    pub drawn: usize,
    /// Poses without an answer of the inverse model, by kind of failure.
    pub infeasible: BTreeMap<String, usize>,
    /// Poses from whose equilibrium the direct model moves to another pose.
    pub unstable: usize,
    /// Poses at whose equilibrium the direct model has no answer, by kind of failure.
    pub unanswered: BTreeMap<String, usize>,
}

/// Solves from one start offset, or all of them.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct RobustnessRow {
    /// Distance of the starts [m]; `None` in the total.
    #[serde(rename = "distance_m")]
    pub distance: Option<f64>,
    /// Angle of the starts [degrees]; `None` in the total.
    pub angle_deg: Option<f64>,
    /// Number of solves.
    pub solves: usize,
    /// Those that found the true pose.
    pub true_pose: usize,
    /// Those that found another stable equilibrium.
    pub other_equilibrium: usize,
    /// The others, by kind of failure.
    pub failed: BTreeMap<String, usize>,
    /// Answers of Newton's method.
    pub newton: usize,
    /// Answers of the trust region.
    pub trust_region: usize,
    /// Iterations of the answers.
    pub iterations: Option<Spread>,
    /// Distance of the true poses found from the true ones [m].
    #[serde(rename = "true_pose_distance_m")]
    pub true_pose_distance: Option<Spread>,
    /// Angle between them [degrees].
    pub true_pose_angle_deg: Option<Spread>,
    /// Wall time of a solve [µs], one at a time. The only figures that differ from run to run.
    pub microseconds: Option<Spread>,
    /// Published results of another program.
    pub published: Option<Published>,
}

/// Median and greatest value.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Spread {
    /// Median; of an even number of values the mean of the middle two.
    pub median: f64,
    /// Greatest value.
    pub max: f64,
}

impl ProtocolSummary {
    /// Summarizes a test.
    pub fn new(result: &RobustnessResult) -> Self {
        let protocol = &result.protocol;
        let found = protocol.found_distance;
        let row = |(k, start): (usize, &StartOffset)| RobustnessRow {
            distance: Some(start.distance),
            angle_deg: Some(in_degrees(start.angle)),
            published: start.published,
            ..RobustnessRow::of(result.solves.iter().filter(|solve| solve.start_offset == k), found)
        };
        Self {
            title: protocol.title.to_owned(),
            youngs_modulus: protocol.youngs_modulus,
            region_low: protocol.region.low,
            region_high: protocol.region.high,
            region_angle_deg: in_degrees(protocol.region.max_angle),
            poses: protocol.poses,
            assignment: protocol.assignment,
            seed: protocol.seed,
            found_distance: found,
            found_angle_deg: in_degrees(super::FOUND_ANGLE),
            draws: Draws::of(result),
            total: RobustnessRow::of(result.solves.iter(), found),
            rows: protocol.starts.iter().enumerate().map(row).collect(),
        }
    }
}

impl Draws {
    fn of(result: &RobustnessResult) -> Self {
        let mut draws = Self { drawn: result.drawn, ..Self::default() };
        for refused in &result.refused {
            let counts = match &refused.refusal {
                Refusal::Infeasible(_) => &mut draws.infeasible,
                Refusal::Unanswered(_) => &mut draws.unanswered,
                Refusal::Unstable => {
                    draws.unstable += 1;
                    continue;
                }
            };
            *counts.entry(refused.refusal.name().to_owned()).or_default() += 1;
        }
        draws
    }
}

impl RobustnessRow {
    /// Share of solves that found the true pose; `None` without solves.
    pub fn success(&self) -> Option<f64> {
        (self.solves > 0).then(|| self.true_pose as f64 / self.solves as f64)
    }

    fn of<'a>(solves: impl Iterator<Item = &'a Solve> + Clone, found_distance: f64) -> Self {
        let mut failed = BTreeMap::new();
        for kind in solves.clone().filter_map(Solve::failure) {
            *failed.entry(kind.to_owned()).or_default() += 1;
        }
        let count = |outcome| solves.clone().filter(|solve| solve.outcome(found_distance) == outcome).count();
        let answers = || solves.clone().filter_map(|solve| solve.answer.as_ref().ok());
        let by = |method| answers().filter(|answer| answer.method == method).count();
        let of_true_poses = |value: fn(&Answer) -> f64| {
            let found = solves.clone().filter(|solve| solve.outcome(found_distance) == Outcome::TruePose);
            Spread::of(found.filter_map(|solve| solve.answer.as_ref().ok()).map(value))
        };
        Self {
            distance: None,
            angle_deg: None,
            solves: solves.clone().count(),
            true_pose: count(Outcome::TruePose),
            other_equilibrium: count(Outcome::OtherEquilibrium),
            failed,
            newton: by(DirectMethod::Newton),
            trust_region: by(DirectMethod::TrustRegion),
            iterations: Spread::of(answers().map(|answer| answer.iterations as f64)),
            true_pose_distance: of_true_poses(|answer| answer.distance),
            true_pose_angle_deg: of_true_poses(|answer| answer.angle.to_degrees()),
            microseconds: Spread::of(solves.map(|solve| solve.microseconds)),
            published: None,
        }
    }
}

impl Spread {
    fn of(values: impl Iterator<Item = f64>) -> Option<Self> {
        let mut sorted: Vec<f64> = values.collect();
        sorted.sort_by(f64::total_cmp);
        let max = *sorted.last()?;
        let middle = sorted.len() / 2;
        let median =
            if sorted.len() % 2 == 1 { sorted[middle] } else { 0.5 * (sorted[middle - 1] + sorted[middle]) };
        Some(Self { median, max })
    }
}

/// Degrees from radians, rounded so that 20 degrees stay 20 and not 20.000000000000004.
pub(crate) fn in_degrees(angle: f64) -> f64 {
    rounded(angle.to_degrees(), 9)
}
