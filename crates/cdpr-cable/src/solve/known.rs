//! The equilibrium of a cable from two known quantities.

use crate::cable::Cable;
use crate::catenary::Catenary;
use crate::error::CableError;
use crate::solve::end_force::{Solution, end_force};
use crate::solve::length_for_tension::length_for_tension;
use nalgebra::Vector2;

/// Two known quantities of a cable in equilibrium: its length, end position, end force or tension.
///
/// `S` stands for a scalar and `V` for a vector of the cable's plane: one cable has numbers, a batch of
/// cables arrays.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Known<S = f64, V = Vector2<f64>> {
    /// The force at the end is to be found.
    LengthAndEnd {
        /// Unstrained length L [m].
        length: S,
        /// Position (x, z) of A [m].
        end: V,
    },
    /// The end position is to be found.
    LengthAndForce {
        /// Unstrained length L [m].
        length: S,
        /// Force (fx, fz) on the cable at A [N].
        force: V,
    },
    /// The unstrained length is to be found.
    EndAndTension {
        /// Position (x, z) of A [m].
        end: V,
        /// Tension at A [N].
        tension: S,
    },
}

impl<S, V> Known<S, V> {
    /// Sorts given quantities into their case.
    ///
    /// `None` unless they are length and end, length and force, or end and tension.
    pub fn from_given(
        length: Option<S>,
        end: Option<V>,
        force: Option<V>,
        tension: Option<S>,
    ) -> Option<Self> {
        match (length, end, force, tension) {
            (Some(length), Some(end), None, None) => Some(Self::LengthAndEnd { length, end }),
            (Some(length), None, Some(force), None) => Some(Self::LengthAndForce { length, force }),
            (None, Some(end), None, Some(tension)) => Some(Self::EndAndTension { end, tension }),
            _ => None,
        }
    }

    /// The same case with other scalars and vectors, such as one cable of a batch.
    pub fn map<T, W>(&self, scalar: impl Fn(&S) -> T, vector: impl Fn(&V) -> W) -> Known<T, W> {
        match self {
            Self::LengthAndEnd { length, end } => {
                Known::LengthAndEnd { length: scalar(length), end: vector(end) }
            }
            Self::LengthAndForce { length, force } => {
                Known::LengthAndForce { length: scalar(length), force: vector(force) }
            }
            Self::EndAndTension { end, tension } => {
                Known::EndAndTension { end: vector(end), tension: scalar(tension) }
            }
        }
    }
}

impl Known {
    /// The equilibrium of a cable with these known quantities.
    ///
    /// # Errors
    /// Those of [`end_force`], [`Catenary::new`] and [`length_for_tension`];
    /// [`CableError::Overstrained`] beyond [`crate::MAX_STRAIN`].
    pub fn solve<'a>(&self, cable: &Cable<'a>) -> Result<Solution<'a>, CableError> {
        let solution = match *self {
            Self::LengthAndEnd { length, end } => end_force(cable, length, end)?,
            Self::LengthAndForce { length, force } => {
                let catenary = Catenary::new(*cable, length, force)?;
                Solution { catenary, end: catenary.end_position(), iterations: 0, residual: 0.0 }
            }
            Self::EndAndTension { end, tension } => length_for_tension(cable, end, tension)?,
        };
        let tension = solution.catenary.anchor_tension().max(solution.catenary.exit_tension());
        match cable.overstrain(tension) {
            Some(strain) => Err(CableError::Overstrained { tension, strain }),
            None => Ok(solution),
        }
    }
}
