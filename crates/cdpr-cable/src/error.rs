//! Why a question about a cable has no answer.

use crate::number::{counted, short};

/// Why a cable could not be computed.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum CableError {
    /// An input is invalid.
    #[error("{field} is {}: expected {expected}", short(*value))]
    InvalidInput {
        /// Name of the input.
        field: &'static str,
        /// The value that was given, in the unit named in `expected`.
        value: f64,
        /// What would be right.
        expected: &'static str,
    },
    /// The anchor point lies within the wheel of a pulley, or where the cable would lean back over it.
    #[error(
        "its anchor point is {} m from the swivel axis of its pulley: expected a distance at which the cable \
         can leave the pulley away from the axis, more than the diameter of the wheel beyond it",
        short(*distance)
    )]
    AtPulley {
        /// Distance of the anchor point from the swivel axis [m].
        distance: f64,
    },
    /// The weight of the cable alone demands more tension over this span than is asked for.
    #[error(
        "a tension of {} N at the anchor point is too small: over this span the weight of the cable \
         alone demands {} N; raise the tension",
        short(*tension),
        short(*least)
    )]
    TensionTooSmall {
        /// The tension asked for [N].
        tension: f64,
        /// The least tension at the anchor point that any unstrained length gives [N].
        least: f64,
    },
    /// The cable is strained beyond [`crate::MAX_STRAIN`].
    #[error(
        "a tension of {} N strains the cable by {:.1} %, beyond the {:.0} % up to which the models are \
         valid: it is too short or too soft for this",
        short(*tension), 100.0 * strain, 100.0 * MAX_STRAIN
    )]
    Overstrained {
        /// The greater of its end tensions [N].
        tension: f64,
        /// Its strain there.
        strain: f64,
    },
    /// The iteration ended without reaching rounding accuracy.
    #[error(
        "no equilibrium of the cable was found in {}: the closure residual at its end is {} m",
        counted(*iterations, "iteration"),
        short(*residual)
    )]
    NotConverged {
        /// Iterations made.
        iterations: usize,
        /// Distance between the wanted end position and the best one found [m].
        residual: f64,
    },
}

/// Strain beyond which no model answers: the laws are those of small strains, and steel and fibre ropes break
/// at less.
pub const MAX_STRAIN: f64 = 0.1;

/// Magnitudes above this are refused, so that no product of four of them overflows.
const LARGEST: f64 = 1e30;

/// Lengths, stiffnesses and tensions below this are refused, so that no quotient of such products overflows.
pub(crate) const SMALLEST: f64 = 1e-30;

pub(crate) fn check(
    field: &'static str,
    value: f64,
    admissible: bool,
    expected: &'static str,
) -> Result<(), CableError> {
    if admissible && value.abs() <= LARGEST {
        Ok(())
    } else {
        Err(CableError::InvalidInput { field, value, expected })
    }
}

pub(crate) fn check_length(unstrained_length: f64) -> Result<(), CableError> {
    let admissible = unstrained_length >= SMALLEST;
    check("unstrained_length", unstrained_length, admissible, "an unstrained length from 1e-30 to 1e30 [m]")
}
