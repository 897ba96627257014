//! The figures: one function each, results in, SVG text out.

pub(crate) mod cycle;
pub(crate) mod heat_map;
pub(crate) mod histogram;
pub(crate) mod motion;
pub(crate) mod path;
pub(crate) mod points;
pub(crate) mod pose_map;
pub(crate) mod response;
pub(crate) mod robot_view;
pub(crate) mod robustness;
pub(crate) mod shares;
pub(crate) mod signed_effects;
pub(crate) mod surface;
