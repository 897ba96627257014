//! Robots and settings that the benchmarks share.

#[allow(dead_code)]
#[path = "../../tests/common.rs"]
mod common;

use cdpr_robot::{Pulley, Robot, Vector3};
pub(crate) use common::caroca;
use criterion::Criterion;
use std::time::Duration;

/// A suspended robot with `n` cables between a ring of exit points and a drum.
pub(crate) fn ring(n: usize) -> Robot {
    Robot { cables: common::ring(n, || 0.0), ..caroca() }
}

/// CAROCA with pulleys of 45 mm, which its cables enter along `axis`, and leads of 3 m.
pub(crate) fn led(axis: Vector3<f64>) -> Robot {
    let mut robot = caroca();
    for cable in &mut robot.cables {
        (cable.pulley, cable.lead) = (Some(Pulley { radius: 0.045, axis }), 3.0);
    }
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
