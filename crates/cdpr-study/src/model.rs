//! A study that has been checked: its parts, ready to be observed.

pub(crate) mod cable_law;
pub(crate) mod designs;
pub(crate) mod doubts;
pub(crate) mod error_model;
pub(crate) mod errors;
pub(crate) mod grid;
pub(crate) mod hash;
pub(crate) mod nominal;
pub(crate) mod observed;
pub(crate) mod observer;
pub(crate) mod open;
pub(crate) mod operating_point;
pub(crate) mod pose_set;
pub(crate) mod prepare;
pub(crate) mod related;
pub(crate) mod study;
