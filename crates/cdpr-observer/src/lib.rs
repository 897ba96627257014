//! What lengths and measured tensions of a robot say about its load and its cables, one sample after the
//! other.
//!
//! | question | item |
//! |---|---|
//! | how heavy is the load, where is its centre, how stiff are the cables? | [`LoadObserver::estimate`] |
//! | which wrench do the measured tensions hold besides the platform's weight? | [`Observed::wrench`] |
//! | is a cable slack or broken, or do the readings contradict the model? | [`Observed::alarm`] |
//!
//! The crate does no input or output and holds no global state. A sample allocates nothing.
#![warn(missing_docs)]

mod alarm;
mod observer;
mod rest;
mod setting;
mod whitened;

pub use alarm::{Alarm, CableState};
pub use observer::{Estimate, LoadObserver, Observed};
pub use setting::ObserverSetting;
