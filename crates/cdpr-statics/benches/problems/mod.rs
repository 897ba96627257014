//! Robots and settings that the benchmarks share.

use cdpr_robot::{Robot, RobotCable, Vector3};
use criterion::Criterion;
use std::time::Duration;

pub(crate) fn caroca() -> Robot {
    Robot::from_json(include_str!("../../../../data/robots/caroca.json")).unwrap()
}

/// A suspended robot with `n` cables between a ring of exit points and a drum.
pub(crate) fn ring(n: usize) -> Robot {
    let mut robot = caroca();
    let properties = robot.cables[0].properties.clone();
    let cable = |i: usize| {
        let around = std::f64::consts::TAU * i as f64 / n as f64;
        let (anchor, height) = if i.is_multiple_of(2) { (around + 0.5, 0.3) } else { (around - 0.5, -0.3) };
        RobotCable {
            exit_point: Vector3::new(5.0 * around.cos(), 5.0 * around.sin(), 4.0),
            anchor_point: Vector3::new(0.5 * anchor.cos(), 0.5 * anchor.sin(), height),
            properties: properties.clone(),
        }
    };
    robot.cables = (0..n).map(cable).collect();
    robot
}

pub(crate) fn settings() -> Criterion {
    Criterion::default().warm_up_time(Duration::from_secs(1)).measurement_time(Duration::from_secs(2))
}

/// What `cargo xtask bench` counts the instructions of.
#[inline(never)]
pub(crate) fn counted<T>(task: impl FnOnce() -> T) -> T {
    task()
}
