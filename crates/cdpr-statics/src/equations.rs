//! The equations of an equilibrium, from one cable in space to the derivatives of the whole.

mod assembled;
mod balance;
mod cable;
mod cable_derivatives;
mod fixed_ends;
mod linearization;
mod motions;
mod partials;
mod rounding;
mod shape;
mod spanned;

pub(crate) use assembled::{NEAR_VERTICAL, State, closure_row, jacobian, residual, skew};
pub(crate) use balance::{Balance, add_stiffness};
pub(crate) use cable::{CablePlane, LinearizedCable, Span, between};
pub(crate) use cable_derivatives::{CableDerivatives, CableInput, wrench};
pub(crate) use fixed_ends::{ABOVE_LEAST, Bounds, Ends};
pub use linearization::Linearization;
pub(crate) use motions::{Motions, Pins, cables_at, is_definite, per_length};
pub use partials::Inputs;
pub(crate) use partials::{Partials, Reading, each_effect_on_weight, read, solve, tensions};
pub(crate) use rounding::{FORCES, forces};
pub use shape::CableShape;
pub(crate) use spanned::{LinearizedInSpace, SpannedCable, end, guided_place, in_its_plane, to_base};
