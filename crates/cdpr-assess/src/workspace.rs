//! Where a robot can work, and how well: tensions, deflection, stiffness, the lowest natural frequency and
//! the tolerance that matters most, pose by pose.
//!
//! A load can come onto the platform in two ways. Where the lengths are kept, as in the paper, the platform
//! yields, and its tensions are what the direct model says. Where the winches hold the pose, the tensions are
//! distributed anew, by the inverse model with the load. A pose may be held in one way and not in the other.

use cdpr_robot::{Coordinate, Parameter, Pose, Robot, Rotation3, Vector3};
use cdpr_statics::{
    Deflection, Derivatives, DirectProblem, Limit, Load, OutOfLimits, StaticsError, deflection_free,
    derivatives_free, held_at, inverse, out_of_limits,
};
use cdpr_study::{ErrorModel, Extremes, Grid, StudyError};
use indexmap::IndexMap;
use rayon::prelude::*;
use serde::Serialize;
use std::collections::BTreeMap;

/// The question about every position of a grid.
#[derive(Clone, Copy, Debug)]
pub struct Workspace<'a> {
    /// The robot.
    pub robot: &'a Robot,
    /// The positions.
    pub grid: Grid,
    /// The orientation at all positions.
    pub rotation: Rotation3<f64>,
    /// The load whose effect is the deflection. Without it only tensions and stiffness are computed.
    pub load: Load,
    /// The uncertain parameters; `None` if no tolerance is wanted.
    pub tolerances: Option<&'a ErrorModel>,
    /// Coordinates that are found at every position, for a robot with fewer cables than free motions: as many
    /// as cables are missing.
    pub free: &'a [Coordinate],
}

/// A position and its results.
#[derive(Clone, Debug, PartialEq)]
pub struct WorkspacePose {
    /// The wanted pose.
    pub pose: Pose,
    /// The result with the lengths kept under the load, or the reason why no tensions hold the platform or
    /// bear the load.
    pub outcome: Result<Held, StaticsError>,
    /// The tensions distributed anew under the load, or the reason why they cannot be; `None` without a load.
    pub anew: Option<Result<Anew, StaticsError>>,
}

/// Tensions within the limits that hold a pose under the load.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Anew {
    /// Least tension at the platform [N].
    pub least_tension: f64,
    /// Greatest tension at the platform [N].
    pub greatest_tension: f64,
}

/// A pose with feasible tensions, on lengths that the load does not change.
#[derive(Clone, Debug, PartialEq)]
pub struct Held {
    /// Least tension at the platform, without and with the load [N].
    pub least_tension: f64,
    /// Greatest tension at the platform, without and with the load [N].
    pub greatest_tension: f64,
    /// Tensions out of limits, without or with the load, the most serious one of each cable.
    pub out_of_limits: Vec<OutOfLimits>,
    /// dp, Eq. (4) [m].
    pub displacement: Vector3<f64>,
    /// Stiffness of the softest motion with the load [N/m], see [`cdpr_statics::Stability`].
    pub least_stiffness: f64,
    /// Lowest natural frequency with the load [Hz]; `None` for a robot that lacks `platform.inertia`.
    pub lowest_frequency: Option<f64>,
    /// Cables (from 0) that are slack with the load.
    pub slack: Vec<usize>,
    /// The tolerance that matters most; `None` if no tolerance is wanted, nothing is uncertain, or |dp| has
    /// no derivative.
    pub dominant: Option<Dominant>,
}

impl WorkspacePose {
    /// Whether a tension there is above its greatest value or breaks the cable.
    fn is_too_much(&self) -> bool {
        self.outcome.as_ref().is_ok_and(|held| held.out_of_limits.iter().any(OutOfLimits::is_too_much))
    }
}

/// The cause behind the largest share of the variance of |dp|, to first order.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Dominant {
    /// Index of the error model's input.
    pub input: usize,
    /// Its share, 0 to 1.
    pub share: f64,
    /// Standard deviation of |dp| from all of them [m].
    pub std: f64,
}

/// The status of a position that is held with all tensions within the limits.
pub const HELD: &str = "held";

/// Computes all positions in parallel, in the order of the grid. `tick` is called after each position; a
/// `stop` that returns true ends the run.
///
/// # Errors
/// [`StudyError::Setting`] for an invalid load, error model or number of free coordinates, and for an error
/// model without a load;
/// [`StudyError::Stopped`]. A pose without feasible tensions is not an error.
pub fn compute_workspace(
    workspace: &Workspace,
    tick: &(dyn Fn() + Sync),
    stop: &(dyn Fn() -> bool + Sync),
) -> Result<Vec<WorkspacePose>, StudyError> {
    let Workspace { robot, rotation, load, tolerances, free, .. } = *workspace;
    if !(load.payload.is_finite() && load.payload >= 0.0) {
        return Err(StudyError::setting("payload", load.payload, "a finite mass, zero or more [kg]"));
    }
    for (field, vector) in [("force", load.wrench.force), ("moment", load.wrench.moment)] {
        if vector.iter().any(|component| !component.is_finite()) {
            let value = format!("{:?}", vector.as_slice());
            return Err(StudyError::setting(field, value, "finite components [N, N m]"));
        }
    }
    if tolerances.is_some() && load == Load::none() {
        return Err(StudyError::setting(
            "load",
            "zero",
            "a load that displaces the platform, because tolerances act on its deflection",
        ));
    }
    let (cables, freedoms) = (robot.cables.len(), robot.freedoms().count());
    let missing = freedoms.saturating_sub(cables);
    if free.len() != missing {
        let names: Vec<_> = free.iter().map(ToString::to_string).collect();
        let expected = format!(
            "{missing} of x, y, z, roll, pitch, yaw, for {cables} cables and {freedoms} free motions"
        );
        return Err(StudyError::setting("free", format!("[{}]", names.join(", ")), expected));
    }
    let parameters = Parameter::of(robot).len();
    if let Some(model) = tolerances.filter(|model| model.parameters() != parameters) {
        let expected = format!("one for the {parameters} parameters of {}", robot.name);
        return Err(StudyError::setting(
            "error model",
            format!("for {} parameters", model.parameters()),
            expected,
        ));
    }
    let one = |level: Pose| {
        if stop() {
            return Err(StudyError::Stopped);
        }
        let pose = Pose { rotation, ..level };
        let outcome = held(workspace, &pose);
        let anew = (load != Load::none()).then(|| {
            let tensions = match free {
                [] => inverse(robot, &pose, &load, None)?.tensions,
                _ => held_at(robot, &pose, &load, free)?.equilibrium.tensions(),
            };
            let [least_tension, greatest_tension] = range(&tensions);
            Ok(Anew { least_tension, greatest_tension })
        });
        tick();
        Ok(WorkspacePose { pose, outcome, anew })
    };
    workspace.grid.poses().into_par_iter().map(one).collect()
}

fn held(workspace: &Workspace, pose: &Pose) -> Result<Held, StaticsError> {
    let Workspace { robot, ref load, tolerances, free, .. } = *workspace;
    let offsets = vec![0.0; robot.cables.len()];
    let deflected = || deflection_free(robot, pose, &offsets, load, free);
    let Some(model) = tolerances else {
        return Ok(Held::new(robot, load, &deflected()?, None));
    };
    match derivatives_free(robot, pose, &offsets, load, free) {
        Ok(found) => Ok(Held::new(robot, load, &found.deflection, Dominant::of(&found, model))),
        // A pose without a derivative is held nevertheless.
        Err(StaticsError::NoDerivative { .. }) => Ok(Held::new(robot, load, &deflected()?, None)),
        Err(error) => Err(error),
    }
}

/// The least and the greatest.
fn range(tensions: &[f64]) -> [f64; 2] {
    tensions.iter().fold([f64::INFINITY, 0.0], |[least, greatest], t| [least.min(*t), greatest.max(*t)])
}

impl Held {
    fn new(robot: &Robot, load: &Load, deflection: &Deflection, dominant: Option<Dominant>) -> Self {
        let Deflection { lengths, unloaded, loaded } = deflection;
        let [least_before, greatest_before] = range(&unloaded.equilibrium.tensions());
        let [least, greatest] = range(&loaded.equilibrium.tensions());
        let frequency = || DirectProblem::new(robot, lengths, load)?.lowest_frequency(&loaded.equilibrium);
        Self {
            least_tension: least.min(least_before),
            greatest_tension: greatest.max(greatest_before),
            out_of_limits: out_of_limits(robot, lengths, &[&unloaded.equilibrium, &loaded.equilibrium]),
            displacement: deflection.displacement(),
            least_stiffness: loaded.stability.least_stiffness(),
            lowest_frequency: frequency().ok(),
            slack: loaded.report.slack.clone(),
            dominant,
        }
    }

    /// Whether all tensions are within the limits of their cables and below the breaking forces.
    pub fn is_within_limits(&self) -> bool {
        self.out_of_limits.iter().all(|found| found.limit == Limit::MaxElsewhere)
    }
}

impl Dominant {
    fn of(found: &Derivatives, model: &ErrorModel) -> Option<Self> {
        let slopes = model.gradient(&found.rms().ok()?);
        let parts = slopes.iter().zip(&model.inputs).map(|(slope, input)| (slope * input.law.std()).powi(2));
        let parts: Vec<f64> = parts.collect();
        let variance: f64 = parts.iter().sum();
        let (input, part) = parts.iter().enumerate().max_by(|a, b| a.1.total_cmp(b.1))?;
        (variance > 0.0).then(|| Self { input, share: part / variance, std: variance.sqrt() })
    }
}

/// A row of `workspace.csv` and `workspace.json`: positions [m], deflection [mm], tensions [N], stiffness
/// [N/m], frequencies [Hz]. Values that do not exist are empty.
#[derive(Clone, Debug, PartialEq, Serialize)]
#[allow(missing_docs)]
pub struct WorkspaceRow {
    pub x: f64,
    pub y: f64,
    pub z: f64,
    /// With the lengths kept: `held`; `beyond_limits` where the load takes a tension out of the limits; else
    /// the kind of failure.
    pub status: &'static str,
    pub least_tension: Option<f64>,
    pub greatest_tension: Option<f64>,
    pub dx_mm: Option<f64>,
    pub dy_mm: Option<f64>,
    pub dz_mm: Option<f64>,
    /// |dp|.
    pub rms_mm: Option<f64>,
    pub least_stiffness: Option<f64>,
    /// Lowest natural frequency with the load.
    pub lowest_frequency_hz: Option<f64>,
    /// Their numbers, from 1, with spaces between.
    pub slack_cables: Option<String>,
    /// Tensions out of limits, in words.
    pub out_of_limits: Option<String>,
    /// The cause with the largest share of the variance of |dp|.
    pub dominant: Option<String>,
    pub dominant_share: Option<f64>,
    /// Standard deviation of |dp| from all tolerances.
    pub std_mm: Option<f64>,
    /// Why the pose is not held.
    pub reason: Option<String>,
    /// `held` where tensions distributed anew hold the pose under the load, else the kind of failure; this
    /// and the following are empty without a load.
    pub anew_status: Option<&'static str>,
    pub anew_least_tension: Option<f64>,
    pub anew_greatest_tension: Option<f64>,
    pub anew_reason: Option<String>,
}

impl WorkspaceRow {
    /// The row of a pose and its result.
    pub fn new(workspace: &Workspace, pose: &WorkspacePose) -> Self {
        let [x, y, z] = pose.pose.position.into();
        let held = pose.outcome.as_ref().ok();
        let loaded = held.filter(|_| workspace.load != Load::none());
        let displacement = loaded.map(|held| 1e3 * held.displacement);
        let dominant = held.and_then(|held| held.dominant);
        let anew = pose.anew.as_ref();
        let tensions = anew.and_then(|anew| anew.as_ref().ok());
        let name = |dominant: Dominant| Some(workspace.tolerances?.inputs.get(dominant.input)?.name.clone());
        Self {
            x,
            y,
            z,
            status: match &pose.outcome {
                Ok(held) if held.is_within_limits() => HELD,
                Ok(_) => "beyond_limits",
                Err(error) => error.kind(),
            },
            least_tension: held.map(|held| held.least_tension),
            greatest_tension: held.map(|held| held.greatest_tension),
            dx_mm: displacement.map(|dp| dp.x),
            dy_mm: displacement.map(|dp| dp.y),
            dz_mm: displacement.map(|dp| dp.z),
            rms_mm: displacement.map(|dp| dp.norm()),
            least_stiffness: held.map(|held| held.least_stiffness),
            lowest_frequency_hz: held.and_then(|held| held.lowest_frequency),
            slack_cables: held
                .map(|held| held.slack.iter().map(|i| (i + 1).to_string()).collect::<Vec<_>>().join(" ")),
            out_of_limits: held.filter(|held| !held.out_of_limits.is_empty()).map(|held| {
                held.out_of_limits.iter().map(ToString::to_string).collect::<Vec<_>>().join("; ")
            }),
            dominant: dominant.and_then(name),
            dominant_share: dominant.map(|dominant| dominant.share),
            std_mm: dominant.map(|dominant| 1e3 * dominant.std),
            reason: pose.outcome.as_ref().err().map(ToString::to_string),
            anew_status: anew.map(|anew| anew.as_ref().map_or_else(StaticsError::kind, |_| HELD)),
            anew_least_tension: tensions.map(|anew| anew.least_tension),
            anew_greatest_tension: tensions.map(|anew| anew.greatest_tension),
            anew_reason: anew.and_then(|anew| anew.as_ref().err().map(ToString::to_string)),
        }
    }
}

/// A workspace with its settings; `workspace.json`.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct WorkspaceSummary {
    /// Name of the robot.
    pub robot: String,
    /// Version of the program.
    pub version: String,
    /// Mass added at the platform's centre of mass [kg].
    pub payload: f64,
    /// Force of the load at P [N].
    pub force: [f64; 3],
    /// Moment of the load about P [N m].
    pub moment: [f64; 3],
    /// Orientation of the platform: w, x, y, z.
    pub quaternion: [f64; 4],
    /// The positions [m].
    pub grid: Grid,
    /// Standard deviation of every cause, in SI units.
    pub uncertainties: IndexMap<String, f64>,
    /// Number of positions by status, with the lengths kept under the load.
    pub status: BTreeMap<&'static str, usize>,
    /// Number of positions by status, with the tensions distributed anew under the load; empty without a
    /// load.
    pub anew_status: BTreeMap<&'static str, usize>,
    /// Number of positions with tensions above a greatest tension or a breaking force.
    pub too_much: usize,
    /// Number of positions at which each cause dominates.
    pub dominant: BTreeMap<String, usize>,
    /// |dp| [mm] over the positions with status `held`. This and the following are absent without such
    /// positions.
    pub rms_mm: Option<Extremes>,
    /// Stiffness of the softest motion [N/m].
    pub least_stiffness: Option<Extremes>,
    /// Lowest natural frequency with the load [Hz]; absent without `platform.inertia`.
    pub lowest_frequency_hz: Option<Extremes>,
    /// Greatest tension [N].
    pub greatest_tension: Option<Extremes>,
    /// Least tension [N].
    pub least_tension: Option<Extremes>,
    /// Greatest tension [N] where tensions are distributed anew, over the positions that they hold.
    pub anew_greatest_tension: Option<Extremes>,
    /// Every position, in the order of the grid.
    pub rows: Vec<WorkspaceRow>,
}

impl WorkspaceSummary {
    /// Whether there is a load besides the platform's own weight.
    pub fn is_loaded(&self) -> bool {
        self.payload != 0.0 || self.force != [0.0; 3] || self.moment != [0.0; 3]
    }

    /// Load and orientation, as in `payload 50 kg, force (0, 100, 0) N`.
    pub fn conditions(&self) -> String {
        let mut words = vec![format!("payload {} kg", self.payload)];
        for (name, vector, unit) in [("force", self.force, "N"), ("moment", self.moment, "N m")] {
            let [x, y, z] = vector;
            if vector != [0.0; 3] {
                words.push(format!("{name} ({x}, {y}, {z}) {unit}"));
            }
        }
        let [qw, qx, qy, qz] = self.quaternion;
        if [qx, qy, qz] != [0.0; 3] {
            words.push(format!("quaternion ({qw:.4}, {qx:.4}, {qy:.4}, {qz:.4})"));
        }
        words.join(", ")
    }

    /// Summarises the poses of a workspace.
    pub fn new(workspace: &Workspace, poses: &[WorkspacePose]) -> Self {
        let rows: Vec<_> = poses.iter().map(|pose| WorkspaceRow::new(workspace, pose)).collect();
        let (mut status, mut anew_status, mut dominant) = (BTreeMap::new(), BTreeMap::new(), BTreeMap::new());
        for row in &rows {
            *status.entry(row.status).or_insert(0) += 1;
            if let Some(anew) = row.anew_status {
                *anew_status.entry(anew).or_insert(0) += 1;
            }
            if let Some(name) = &row.dominant {
                *dominant.entry(name.clone()).or_insert(0) += 1;
            }
        }
        let causes = workspace.tolerances.map(|model| model.inputs.as_slice()).unwrap_or_default();
        Self {
            robot: workspace.robot.name.clone(),
            version: env!("CARGO_PKG_VERSION").to_owned(),
            payload: workspace.load.payload,
            force: workspace.load.wrench.force.into(),
            moment: workspace.load.wrench.moment.into(),
            quaternion: Pose { position: Vector3::zeros(), rotation: workspace.rotation }.quaternion(),
            grid: workspace.grid,
            uncertainties: causes.iter().map(|cause| (cause.name.clone(), cause.law.std())).collect(),
            status,
            anew_status,
            too_much: poses.iter().filter(|pose| pose.is_too_much()).count(),
            dominant,
            rms_mm: held_extremes(&rows, |row| row.rms_mm),
            least_stiffness: held_extremes(&rows, |row| row.least_stiffness),
            lowest_frequency_hz: held_extremes(&rows, |row| row.lowest_frequency_hz),
            greatest_tension: held_extremes(&rows, |row| row.greatest_tension),
            least_tension: held_extremes(&rows, |row| row.least_tension),
            anew_greatest_tension: extremes(rows.iter(), |row| row.anew_greatest_tension),
            rows,
        }
    }
}

fn held_extremes(rows: &[WorkspaceRow], value: impl Fn(&WorkspaceRow) -> Option<f64>) -> Option<Extremes> {
    extremes(rows.iter().filter(|row| row.status == HELD), value)
}

fn extremes<'a>(
    rows: impl Iterator<Item = &'a WorkspaceRow>,
    value: impl Fn(&WorkspaceRow) -> Option<f64>,
) -> Option<Extremes> {
    Extremes::of(rows.filter_map(|row| Some((value(row)?, [row.x, row.y, row.z]))))
}
