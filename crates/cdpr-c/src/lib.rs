//! `libcdpr`: the models of [`cdpr_statics`] for C and C++, for a controller of a cable-driven parallel
//! robot.
//!
//! `include/cdpr.h` declares the functions of [`border`], and `docs/c.md` explains them. The digits are those
//! of the Rust interface. Every function checks its pointers, sizes and values, returns a [`CdprStatus`] and
//! writes residuals; no panic leaves it.

pub mod border;
mod data;
mod failure;
mod follow;
mod observer;
mod pose;
mod robot;

pub use data::{CdprCables, CdprDerivatives, CdprLoad, CdprMotion, CdprPose, CdprReport, CdprStiffness};
pub use failure::CdprStatus;
pub use follow::{CdprPath, CdprTracker};
pub use observer::{CdprAlarm, CdprObserved, CdprObserver, CdprObserverSetting};
pub use robot::CdprRobot;
