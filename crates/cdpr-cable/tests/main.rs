//! The cable against references, differences and invariants.

#![allow(clippy::unwrap_used, clippy::panic, clippy::print_stdout)]

mod code_aster;
mod common;
mod dual;
mod guide_terms;
mod guided;
mod held;
mod in_wind;
mod longest_taut;
mod piecewise;
mod properties;
mod reference;
mod sap2000;
mod spatial;
