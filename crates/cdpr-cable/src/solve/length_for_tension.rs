//! The unstrained length that gives a wanted tension at the anchor point.
//!
//! Over a given span the tension at A falls as cable is paid out, passes a minimum, and rises again with the
//! weight of the cable that hangs below. The answer is the shorter of the two cables, found by its chord
//! force: see [`HeldCable`].

use crate::cable::Cable;
use crate::error::CableError;
use crate::guide::in_plane;
use crate::solve::end_force::{Solution, check_end, check_plane};
use crate::solve::held::HeldCable;
use nalgebra::Vector2;

/// The cable from the origin to `end = (x, z)` [m], `x >= 0`, with the tension `tension` [N] at A.
///
/// # Errors
/// [`CableError::InvalidInput`] for an invalid value; [`CableError::TensionTooSmall`], with the least
/// tension, where the weight of the cable alone demands more.
pub fn length_for_tension<'a>(
    cable: &Cable<'a>,
    end: Vector2<f64>,
    tension: f64,
) -> Result<Solution<'a>, CableError> {
    check_end(end)?;
    check_plane(cable)?;
    let (held, steps) = HeldCable::counted(cable, in_plane(end.into()), tension)?;
    Ok(Solution::of(held.catenary, end, steps))
}
