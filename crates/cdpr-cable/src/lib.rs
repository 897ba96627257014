//! Statics of one sagging elastic cable between two points (Irvine's elastic catenary).
//!
//! Frame: the vertical plane of the cable, exit point B at the origin, anchor point A at `(x, z)`, `z` up,
//! `x >= 0`. Force: `(fx, fz)` [N] is the force applied *to the cable at A*; whatever hangs on the cable
//! receives its opposite.
//!
//! | question | item |
//! |---|---|
//! | Where is A for a force at A? | [`Catenary::end_position`] |
//! | What is the force for an end position and an unstrained length? | [`end_force`] |
//! | What unstrained length gives a wanted tension at A? | [`length_for_tension`] |
//! | What is the least tension at A over a span? | [`least_tension`] |
//! | What follows from any two of length, end, force and tension? | [`Known::solve`] |
//! | What modulus does a load-elongation record give? | [`Record::modulus`] |
//! | What mass per length does a weighing give? | [`linear_density`] |
//! | What are its stiffness, energy and shape? | the other methods of [`Catenary`] |
//! | How do I evaluate it with intervals, dual numbers or lanes? | [`kernel`] |
//!
//! ```
//! use cdpr_cable::{Cable, Vector2, end_force};
//!
//! let cable = Cable::linear(0.9957, 1.28e6); // [N/m], [N]
//! let solution = end_force(&cable, 4.3, Vector2::new(4.1, -1.7))?; // 4.3 m of cable, A 1.7 m below B
//! let catenary = solution.catenary;
//! assert!((catenary.end_position() - Vector2::new(4.1, -1.7)).norm() < 1e-12);
//! println!("tension at A {:.1} N, sag {:.1} mm", catenary.anchor_tension(), 1e3 * catenary.sag());
//! # Ok::<(), cdpr_cable::CableError>(())
//! ```
//!
//! The crate does no input or output, holds no state and knows no robot.

mod cable;
mod catenary;
mod error;
mod guide;
pub mod kernel;
mod law;
mod number;
mod record;
mod solve;
mod weighing;

pub use cable::Cable;
pub use catenary::shape::FromLeavePoint;
pub use catenary::spatial::{HeldSlopes, Property, PropertySlopes, SpatialCable, SpatialResponse};
pub use catenary::{Catenary, LONGEST_TAUT, SLACK_BELOW_OWN_WEIGHTS, is_slack};
pub use error::{CableError, MAX_STRAIN};
pub use guide::{Entry, Guide, Straight};
pub use law::{ElasticLaw, PiecewiseLaw, Segment};
pub use nalgebra::{Matrix2, Matrix3, Vector2, Vector3};
pub use number::{counted, short, shortened};
pub use record::{Phase, Record, RecordError, Sample, SecantModulus, Specimen, TangentModulus};
pub use solve::{
    CableInWind, HeldCable, HeldInWind, InWindSlopes, Known, Solution, WindOverHeight, end_force,
    end_force_near, length_for_tension, spatial_end_force,
};
pub use weighing::{Measured, linear_density};
