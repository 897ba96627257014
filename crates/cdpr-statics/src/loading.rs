//! Equilibria while the load or the lengths change.

mod deflection;
mod follow;
mod friction;
mod hysteresis;
mod modes;
mod small_motions;
mod stiffness;
mod weather;
mod wind;

pub use deflection::{Deflection, deflection, deflection_from, set_point_lengths};
pub(crate) use deflection::{SetPointLengths, lengths_at_rest};
pub use follow::follow;
pub use friction::{
    Estimate, FrictionFit, PulleyFriction, PulleyState, WinchReading, fit_friction, fit_friction_model,
};
pub use hysteresis::{
    CycleStep, HysteresisLaw, LoadCycle, LoadHistory, Unloading, load_cycle, load_cycle_over_pulleys,
};
pub use modes::{CableFrequency, NaturalMode, PoseModes, modes_at};
pub use small_motions::{CableAtRest, SmallMotions};
pub use stiffness::{PoseStiffness, stiffness_at};
pub(crate) use weather::CableInWeather;
pub use weather::{Weather, in_weather, rest_in_weather};
pub(crate) use wind::{BlownCable, DRAG_PER_DIAMETER};
pub use wind::{RestInWeather, Wind, WindProfile};
