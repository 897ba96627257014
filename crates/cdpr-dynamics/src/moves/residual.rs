//! What swings after a move.

use super::{SetPoint, winch_lengths};
use crate::error::DynamicsError;
use crate::simulate::{Change, Event, Settings, WinchLengths, simulate};
use cdpr_robot::Robot;
use cdpr_statics::{DirectProblem, DirectStart, Load, WantedPose, inverse, set_point_lengths};

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

/// Simulates a robot whose winches take in and pay out what set points say, from its own rest at their first pose.
///
/// The robot may differ from the one that the set points are for: its lengths at the first pose are its own, with
/// offsets of its tensions there [N], one for each cable or none; the changes of the lengths are those of the set
/// points. `settings.until` counts from the end of the move.
///
/// # Errors
/// Those of the inverse model at the first and of the direct model at the last pose, and those of [`simulate`].
pub fn residual(
    robot: &Robot,
    load: &Load,
    set_points: &[SetPoint],
    offsets: &[f64],
    settings: &Settings,
) -> Result<Residual, DynamicsError> {
    let table = winch_lengths(set_points)?;
    let (first, last) = (&set_points[0], &set_points[set_points.len() - 1]);
    let held = inverse(robot, &first.pose, load)?;
    let mut lengths = held.lengths;
    if offsets.iter().any(|offset| *offset != 0.0) {
        let wanted = WantedPose::at(&first.pose);
        let without = set_point_lengths(robot, wanted)?;
        let with = set_point_lengths(robot, wanted.tension_offsets(offsets))?;
        lengths
            .iter_mut()
            .zip(with.iter().zip(&without))
            .for_each(|(own, (with, without))| *own += with - without);
    }
    let table = shifted(&table, set_points, &lengths)?;
    let problem = DirectProblem::new(robot, &lengths, load)?;
    let rest = problem.direct(DirectStart::Near(&held.equilibrium))?.equilibrium;
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
        // Set points are at equal times; between two of them the way is nearly straight.
        let place = sample.time / end * count;
        let k = (place as usize).min(set_points.len() - 2);
        let between = |k: usize| set_points[k].pose.position;
        let wanted = between(k).lerp(&between(k + 1), place - k as f64);
        found.deviation = found.deviation.max((sample.pose.position - wanted - off).norm());
    }
    Ok(found)
}

/// The same changes of lengths from other ones [m].
fn shifted(
    table: &WinchLengths,
    set_points: &[SetPoint],
    lengths: &[f64],
) -> Result<WinchLengths, DynamicsError> {
    let times: Vec<f64> = set_points.iter().map(|point| point.time).collect();
    let row = |point: &SetPoint| {
        let changed = point.lengths.iter().zip(lengths).enumerate();
        changed.map(|(i, (length, own))| own + (length - table.at(i, 0.0)[0])).collect()
    };
    WinchLengths::new(&times, &set_points.iter().map(row).collect::<Vec<_>>())
}
