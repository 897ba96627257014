//! A load-elongation record of a cable: moduli over ranges of load with their uncertainty, and the energy
//! that a loop dissipates.
//!
//! A test bench loads a piece of cable of length `L_c` to some force and unloads it again. With x_p the
//! elongation at p percent of the breaking force, interpolated between the samples of one phase, the secant
//! modulus is
//!
//! ```text
//! E_{p-q} = L_c (F_q - F_p) / (S (x_q - x_p))                                                     (5)
//! ```
//!
//! (ISO 12076; Eq. (5) of Baklouti, Caro, Courteille 2017). It is a product of powers, so that relative
//! errors add: both forces and both elongations are measured with the same absolute error, and with `ΔF = F_q
//! - F_p`, `Δx = x_q - x_p`
//!
//! ```text
//! standard:  (δE/E)² = 2 (δF/ΔF)² + 2 (δx/Δx)² + (δL/L_c)² + (δS/S)²       independent errors
//! greatest:   δE/E   = 2 δF/ΔF + 2 δx/Δx + δL/L_c + δS/S                   all of them against us
//! ```
//!
//! The energy dissipated by the loop is the area `∮ F dx` between its branches, closed by a straight line
//! where it does not close by itself.

mod load_cycle;
mod modulus;
mod sample;
#[cfg(test)]
mod tests;

pub use load_cycle::Record;
pub use modulus::{SecantModulus, Specimen, TangentModulus};
pub use sample::{Phase, RecordError, Sample};
