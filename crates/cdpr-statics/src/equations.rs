//! The equations of an equilibrium, from one cable in space to the derivatives of the whole.

mod assembled;
mod balance;
mod partials;
mod rounding;
mod span;
mod tangent;

pub(crate) use assembled::{Factored, NEAR_VERTICAL, State, Strung, cross, jacobian, residual};
pub(crate) use balance::Balance;
pub use partials::Inputs;
pub(crate) use partials::{LinearCable, Partials, Reading, solve, tensions, wrench};
pub(crate) use span::Span;
pub use tangent::Tangent;
