//! Analysis of observations: statistics, laws, effects, the verdict.

pub(crate) mod extremes;
pub(crate) mod keys;
pub(crate) mod linear_law;
pub(crate) mod measures;
pub(crate) mod methods;
pub(crate) mod part;
pub(crate) mod poses;
pub(crate) mod sampling;
pub(crate) mod sensitivity;
pub(crate) mod summary;
pub(crate) mod surface;
pub(crate) mod values;
pub(crate) mod verdict;
