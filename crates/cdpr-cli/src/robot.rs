//! Commands about a robot as a whole: its file, workspace and calibration, and how robustly its equilibria are found.

pub(crate) mod calibration;
pub(crate) mod check;
pub(crate) mod robustness;
pub(crate) mod workspace;
