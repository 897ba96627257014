//! What swings after a move.

use super::{Move, SetPoint};
use crate::error::{DynamicsError, positive};
use crate::simulate::{Change, Discretization, Event, Settings, WinchLengths, simulate};
use cdpr_robot::{Robot, Vector3};
use cdpr_statics::{DirectProblem, DirectStart, InversePath, Load, WantedPose, set_point_lengths};

/// The motion of a platform after the end of a move.
#[derive(Clone, Debug, PartialEq)]
pub struct Residual {
    /// Greatest distance of P from its rest [m].
    pub amplitude: f64,
    /// Greatest rotation from its rest [rad].
    pub rotation: f64,
    /// Greatest difference of the position to a coarser computation [m], also on the way.
    pub difference: f64,
    /// Greatest distance of P from the wanted pose on the way [m], without that at the begin.
    pub deviation: f64,
    /// Indices of cables that lost their tension, from 0.
    pub slack: Vec<usize>,
}

impl Move<'_> {
    /// How [`residual`] simulates the move and this long after it [s], two periods of the slowest motion that
    /// swings if left out, and no less than half a second. The cables have the damping `damping` [s].
    ///
    /// It is fast, and exact to some micrometres for cables that stay taut: two discretizations are compared.
    ///
    /// # Errors
    /// [`DynamicsError::Invalid`] for a time that is not above zero; without one those of [`Move::excited`].
    pub fn watched(&self, seconds: Option<f64>, damping: f64) -> Result<Settings, DynamicsError> {
        const DISCRETIZATION: Discretization = Discretization { elements: 2, degree: 5 };
        const LEAST: f64 = 0.5;
        /// Samples each second, at least [Hz].
        const RATE: f64 = 200.0;
        let seconds = match seconds {
            Some(seconds) => {
                positive("residual", seconds, "a time after the move [s] above zero")?;
                seconds
            }
            None => self.excited(damping)?.iter().map(|one| 2.0 / one.frequency).fold(LEAST, f64::max),
        };
        let discretization = Some(DISCRETIZATION);
        let rate = self.rate.max(RATE);
        Ok(Settings { rate, damping, discretization, tolerance: 1e-6, ..Settings::until(seconds) })
    }
}

/// Simulates a robot that makes a move, and goes on until `settings.until` after its end [s].
///
/// The robot may differ from the one that the set points are for. Its lengths are its own ones at rest at
/// each pose, as in studies, and the feed-forward of the set points; `offsets` of its tensions at the first
/// pose [N], one for each cable or none, shift the lengths by as much as they do there.
///
/// # Errors
/// Those of the inverse model at the poses and of the direct model at the last one, and those of
/// [`simulate`].
pub fn residual(
    robot: &Robot,
    load: &Load,
    set_points: &[SetPoint],
    offsets: &[f64],
    settings: &Settings,
) -> Result<Residual, DynamicsError> {
    let table = own_lengths(robot, load, set_points, offsets)?;
    let (first, last) = (&set_points[0], &set_points[set_points.len() - 1]);
    let lengths: Vec<f64> = (0..table.cables()).map(|i| table.at(i, 0.0)[0]).collect();
    let problem = DirectProblem::new(robot, &lengths, load)?;
    let rest = problem.direct(DirectStart::Pose(&first.pose))?.equilibrium;
    let events = [Event { time: 0.0, change: Change::Lengths(table.clone()) }];
    let end = table.duration();
    let settings = Settings { until: end + settings.until, ..*settings };
    let series = simulate(&problem, &rest, &events, &settings)?;
    let lengths: Vec<f64> = (0..table.cables()).map(|i| table.at(i, end)[0]).collect();
    let at_end = DirectProblem::new(robot, &lengths, load)?.direct(DirectStart::Pose(&last.pose))?;
    let at_end = at_end.equilibrium.pose;
    let off = rest.pose.position - first.pose.position;
    let mut found = Residual {
        amplitude: 0.0,
        rotation: 0.0,
        difference: series.difference.position,
        deviation: 0.0,
        slack: (0..lengths.len()).filter(|i| series.slack[*i]).collect(),
    };
    let count = (set_points.len() - 1) as f64;
    for sample in &series.samples {
        if sample.time >= end {
            let motion = at_end.motion_to(&sample.pose);
            found.amplitude = found.amplitude.max(motion.fixed_rows::<3>(0).norm());
            found.rotation = found.rotation.max(motion.fixed_rows::<3>(3).norm());
            continue;
        }
        let wanted = wanted(set_points, sample.time / end * count);
        found.deviation = found.deviation.max((sample.pose.position - wanted - off).norm());
    }
    Ok(found)
}

/// The wanted position at a place between set points, which are at equal times [m]: that of a cubic through
/// the four around it.
fn wanted(set_points: &[SetPoint], place: f64) -> Vector3<f64> {
    let at = |k: usize| set_points[k].pose.position;
    let count = set_points.len();
    if count < 4 {
        let k = (place as usize).min(count - 2);
        return at(k).lerp(&at(k + 1), place - k as f64);
    }
    let first = (place as usize).clamp(1, count - 3) - 1;
    let s = place - first as f64;
    let weights = [
        (1.0 - s) * (2.0 - s) * (3.0 - s) / 6.0,
        s * (2.0 - s) * (3.0 - s) / 2.0,
        s * (s - 1.0) * (3.0 - s) / 2.0,
        s * (s - 1.0) * (s - 2.0) / 6.0,
    ];
    weights.iter().zip(first..).fold(Vector3::zeros(), |sum, (weight, k)| sum + at(k) * *weight)
}

/// The lengths of a robot at the poses of set points, with their feed-forward.
fn own_lengths(
    robot: &Robot,
    load: &Load,
    set_points: &[SetPoint],
    offsets: &[f64],
) -> Result<WinchLengths, DynamicsError> {
    let times: Vec<f64> = set_points.iter().map(|point| point.time).collect();
    let mut shift = vec![0.0; robot.cables.len()];
    if let Some(first) = set_points.first().filter(|_| offsets.iter().any(|offset| *offset != 0.0)) {
        let wanted = WantedPose::at(&first.pose);
        let without = set_point_lengths(robot, wanted)?;
        let with = set_point_lengths(robot, wanted.tension_offsets(offsets))?;
        shift = with.iter().zip(&without).map(|(with, without)| with - without).collect();
    }
    let mut path = InversePath::new(robot);
    let mut row = |point: &SetPoint| -> Result<Vec<f64>, DynamicsError> {
        let still = path.solve(point.pose, load)?.solution.lengths;
        let more = point.feed_forward.iter().zip(&shift);
        Ok(still.iter().zip(more).map(|(still, (more, shift))| still + more + shift).collect())
    };
    WinchLengths::new(&times, &set_points.iter().map(&mut row).collect::<Result<Vec<_>, _>>()?)
}
