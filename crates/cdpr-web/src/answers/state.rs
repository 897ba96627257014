//! A platform in equilibrium, with all that a picture and a table of it need.

use crate::answers::failure::Failure;
use crate::question::PoseGiven;
use cdpr_robot::{Robot, Vector3};
use cdpr_statics::limits::{Limit, OutOfLimits, out_of_limits};
use cdpr_statics::stiffness::{CableShape, Mode};
use cdpr_statics::{DirectProblem, DirectSolution, Load};
use serde::Serialize;

/// Points along the free cable.
const POINTS: usize = 33;

/// Points of a cable on its pulley.
const POINTS_ON_PULLEY: usize = 8;

/// An equilibrium.
#[derive(Serialize)]
pub(crate) struct State {
    pose: PoseGiven,
    /// Angles of R = Rz(yaw) Ry(pitch) Rx(roll): roll, pitch, yaw [°].
    rpy_deg: [f64; 3],
    /// Anchor points in the base frame [m].
    anchors: Vec<[f64; 3]>,
    /// Centre of mass in the base frame [m].
    center_of_mass: [f64; 3],
    cables: Vec<CableState>,
    stable: bool,
    /// Stiffness of the softest motion [N/m].
    least_stiffness: f64,
    softest: Option<Motion>,
    residual: Residuals,
    method: String,
    iterations: usize,
}

/// A cable in equilibrium.
#[derive(Serialize)]
struct CableState {
    /// Coordinates of points from the exit point, over the pulley, to the anchor point [m].
    points: Vec<f64>,
    /// Index of the point where the cable leaves its pulley: the first one of the free cable.
    free: usize,
    /// Coordinates of points around the wheel of its pulley [m]; empty without one.
    wheel: Vec<f64>,
    /// Tension at the platform [N].
    tension: f64,
    /// Tension at the exit point [N].
    exit_tension: f64,
    /// Greatest distance across the chord [m].
    sag: f64,
    /// Whether it carries less than its own weight; a loaded cable that sags is not slack.
    slack: bool,
    /// Unstrained length [m].
    length: f64,
    /// The limit that a tension passes: `below`, `above`, `breaks`.
    limit: Option<&'static str>,
}

/// A motion of the platform of unit size, `|translation|² + ℓ² |rotation|² = 1`.
#[derive(Serialize)]
pub(crate) struct Motion {
    /// Stiffness [N/m].
    stiffness: f64,
    /// Translation of P [m/m].
    translation: [f64; 3],
    /// Rotation vector [rad/m].
    rotation: [f64; 3],
}

/// Residuals of all equations.
#[derive(Serialize)]
struct Residuals {
    /// Closure of the cables [m].
    closure: f64,
    /// Force [N].
    force: f64,
    /// Moment [N m].
    moment: f64,
}

impl From<&Mode> for Motion {
    fn from(Mode { stiffness, translation, rotation }: &Mode) -> Self {
        Self { stiffness: *stiffness, translation: (*translation).into(), rotation: (*rotation).into() }
    }
}

impl State {
    /// The equilibrium of a robot on these lengths under this load.
    pub(crate) fn new(
        robot: &Robot,
        lengths: &[f64],
        load: &Load,
        found: &DirectSolution,
    ) -> Result<Self, Failure> {
        let DirectSolution { equilibrium, report, stability } = found;
        let pose = &equilibrium.pose;
        let problem = DirectProblem::new(robot, lengths, load)?;
        let exit_tensions = equilibrium.exit_tensions(robot, lengths);
        let beyond = out_of_limits(robot, lengths, &[equilibrium]);
        let cable = |i: usize| -> Result<CableState, Failure> {
            let CableShape { points, wheel, sag, .. } =
                problem.shape(equilibrium, i, POINTS_ON_PULLEY, POINTS)?;
            Ok(CableState {
                points: flat(&points),
                free: points.len() - POINTS,
                wheel: flat(&wheel),
                tension: equilibrium.cable_forces[i].norm(),
                exit_tension: exit_tensions[i],
                sag,
                slack: report.slack.contains(&i),
                length: lengths[i],
                limit: beyond.iter().find(|found| found.cable == i).and_then(limit),
            })
        };
        let (roll, pitch, yaw) = pose.rotation.euler_angles();
        Ok(Self {
            pose: pose.into(),
            rpy_deg: [roll, pitch, yaw].map(f64::to_degrees),
            anchors: (0..lengths.len()).map(|i| (pose.position + robot.anchor_arm(pose, i)).into()).collect(),
            center_of_mass: (pose.position + pose.rotation * robot.platform.center_of_mass).into(),
            cables: (0..lengths.len()).map(cable).collect::<Result<_, _>>()?,
            stable: stability.is_stable(),
            least_stiffness: stability.least_stiffness(),
            softest: stability.modes().first().map(Motion::from),
            residual: Residuals {
                closure: report.residual.closure,
                force: report.residual.force,
                moment: report.residual.moment,
            },
            method: report.method.to_string(),
            iterations: report.iterations,
        })
    }
}

fn flat(points: &[Vector3<f64>]) -> Vec<f64> {
    points.iter().flat_map(|point| [point.x, point.y, point.z]).collect()
}

fn limit(found: &OutOfLimits) -> Option<&'static str> {
    match found.limit {
        Limit::BreakingForce | Limit::Strain => Some("breaks"),
        Limit::Max => Some("above"),
        Limit::Min => Some("below"),
        Limit::MaxElsewhere => None,
    }
}
