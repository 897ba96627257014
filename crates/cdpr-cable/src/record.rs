//! A load-elongation record of a cable: moduli with their uncertainty, and the energy that a loop dissipates.
//!
//! A test bench loads a piece of cable of length `L_c` to some force and unloads it again. With x_p the
//! elongation at p percent of the breaking force, interpolated between the samples of one phase, the secant
//! modulus is Eq. (5) of Baklouti, Caro, Courteille (CableCon 2017), also found in ISO 12076:
//!
//! ```text
//! E_{p-q} = L_c (F_q - F_p) / (S (x_q - x_p))                                            Eq. (5)
//! ```
//!
//! It is a product of powers, so that relative errors add. Both forces are measured with the same absolute
//! error, and so are both elongations. With `ΔF = F_q - F_p` and `Δx = x_q - x_p`
//!
//! ```text
//! standard:  (δE/E)² = 2 (δF/ΔF)² + 2 (δx/Δx)² + (δL/L_c)² + (δS/S)²    independent errors (C32)
//! greatest:   δE/E   = 2 δF/ΔF + 2 δx/Δx + δL/L_c + δS/S                errors that add up (C33)
//! ```
//!
//! The energy dissipated by the loop is the area `∮ F dx` between its branches. A straight line closes a loop
//! that does not close by itself.

mod load_cycle;
mod modulus;
mod sample;
#[cfg(test)]
mod tests;

pub use load_cycle::Record;
pub use modulus::{SecantModulus, Specimen, TangentModulus};
pub use sample::{Phase, RecordError, Sample};
