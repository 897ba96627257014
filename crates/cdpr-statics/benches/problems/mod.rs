//! Robots and settings that the benchmarks share.

#[allow(dead_code)]
#[path = "../../tests/common.rs"]
pub(crate) mod common;

use cdpr_robot::Robot;
pub(crate) use common::caroca;
use criterion::Criterion;
use std::time::Duration;

/// A suspended robot with `n` cables between a ring of exit points and a drum.
pub(crate) fn ring(n: usize) -> Robot {
    Robot { cables: common::ring(n, || 0.0), ..caroca() }
}

pub(crate) fn settings() -> Criterion {
    Criterion::default().warm_up_time(Duration::from_secs(1)).measurement_time(Duration::from_secs(2))
}

/// What `cargo xtask bench` counts the instructions of.
#[inline(never)]
pub(crate) fn in_one_call<T>(task: impl FnOnce() -> T) -> T {
    task()
}
