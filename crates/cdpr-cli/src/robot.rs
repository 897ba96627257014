//! Commands about a robot as a whole: its file, its workspace, its calibration, its direct model.

pub(crate) mod calibrate;
pub(crate) mod calibration;
pub(crate) mod check;
pub(crate) mod explore;
pub(crate) mod import;
pub(crate) mod library;
pub(crate) mod robustness;
pub(crate) mod workspace;
