//! Commands about a robot at a pose: its lengths, equilibria, stiffness and derivatives.

pub(crate) mod at_pose;
pub(crate) mod capacity;
pub(crate) mod deflection;
pub(crate) mod derivatives;
pub(crate) mod direct;
pub(crate) mod hysteresis;
pub(crate) mod inverse;
pub(crate) mod modes;
pub(crate) mod path;
pub(crate) mod response;
pub(crate) mod safety;
pub(crate) mod simulate;
pub(crate) mod stiffness;
