//! Analysis of observations: statistics, laws, effects, comparison with published figures.

pub(crate) mod comparison;
pub(crate) mod extremes;
pub(crate) mod keys;
pub(crate) mod measures;
pub(crate) mod methods;
pub(crate) mod part;
pub(crate) mod poses;
pub(crate) mod sampling;
pub(crate) mod sensitivity;
pub(crate) mod summary;
pub(crate) mod surface;
