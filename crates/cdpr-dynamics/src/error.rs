//! Why there is no answer.

use cdpr_robot::RobotError;
use cdpr_statics::StaticsError;

/// An error of this crate.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum DynamicsError {
    /// The state is no equilibrium, or the static models refuse it.
    #[error(transparent)]
    Statics(#[from] StaticsError),
    /// The robot is invalid.
    #[error(transparent)]
    Robot(#[from] RobotError),
    /// What is asked for is not possible.
    #[error("{field} is {value}: expected {expected}")]
    Invalid {
        /// Name of the input.
        field: &'static str,
        /// Its value.
        value: String,
        /// Values that are valid.
        expected: String,
    },
    /// Text that is no list of events.
    #[error("events: {0}")]
    Events(cdpr_robot::JsonError),
    /// An event that is not possible.
    #[error("event {}{}{field} is {value}: expected {expected}", index + 1, if field.is_empty() { "" } else { ", " })]
    Event {
        /// Its number, from 0.
        index: usize,
        /// Name of the field; empty for the whole event.
        field: String,
        /// Its value.
        value: String,
        /// Values that are valid.
        expected: String,
    },
    /// A motion whose steps become too short.
    #[error(
        "the motion cannot be followed beyond {time:.6} s: no step of time is short enough for its error; \
         try fewer elements of a higher degree, more damping, or a greater tolerance"
    )]
    Stalled {
        /// When [s].
        time: f64,
    },
    /// A motion that was computed, and that no robot has.
    #[error("the motion that was computed is not to be trusted: {what}")]
    Implausible {
        /// What is wrong with it.
        what: String,
    },
    /// A move that no tensions within the limits can accelerate.
    #[error(
        "the move is too fast at {time:.4} s, at ({:.4}, {:.4}, {:.4}) m{}: {source}; give it more seconds",
        position[0], position[1], position[2],
        cable.map_or_else(String::new, |cable| format!(", for cable {}", cable + 1))
    )]
    TooFast {
        /// When [s].
        time: f64,
        /// Where P is [m].
        position: [f64; 3],
        /// The cable, from 0, that rests on a limit first; `None` where none does.
        cable: Option<usize>,
        /// What the motion lacks there.
        source: Box<StaticsError>,
    },
    /// Lengths that cannot change from one set point to the next without a jump.
    #[error(
        "the lengths of the move jump at {time:.4} s, at ({:.4}, {:.4}, {:.4}) m, as the best tensions do; \
         take another way, other limits or another choice of tensions",
        position[0], position[1], position[2]
    )]
    Jump {
        /// When [s].
        time: f64,
        /// Where P is [m].
        position: [f64; 3],
    },
    /// A cable with mass that nothing stretches.
    #[error(
        "cable {} hangs without tension at a point, where a cable has no natural frequency; \
         change the pose or the lengths",
        cable + 1
    )]
    Folded {
        /// Its number, from 0.
        cable: usize,
    },
    /// Nothing damps the platform at a natural frequency.
    #[error(
        "{frequency} Hz is a natural frequency, at which nothing limits the motion; {}",
        if *frequency == 0.0 { "take frequencies above 0 Hz" } else { "give damping" }
    )]
    Resonance {
        /// The frequency [Hz].
        frequency: f64,
    },
    /// The equilibrium is not stable once the cables have mass, or a matrix cannot be factored.
    #[error("the platform has no natural frequencies here: {what}")]
    NotStable {
        /// What was found.
        what: String,
    },
}

impl From<DynamicsError> for StaticsError {
    fn from(error: DynamicsError) -> Self {
        let text = error.to_string();
        let invalid = |field: &str, value: String, expected: String| Self::Invalid {
            field: field.to_owned(),
            value,
            expected,
        };
        match error {
            DynamicsError::Statics(error) => error,
            DynamicsError::Robot(error) => error.into(),
            DynamicsError::Invalid { field, value, expected } => invalid(field, value, expected),
            DynamicsError::Resonance { frequency } => {
                let expected = match frequency {
                    0.0 => "above 0 Hz, where nothing limits the motion",
                    _ => "no natural frequency, or damping",
                };
                invalid("frequency", format!("{frequency} Hz"), expected.to_owned())
            }
            DynamicsError::Events(_) | DynamicsError::Event { .. } => {
                invalid("events", text, "events of this robot".to_owned())
            }
            DynamicsError::TooFast { source, .. } => *source,
            DynamicsError::Jump { .. } => invalid("move", text, "lengths without jumps".to_owned()),
            DynamicsError::Stalled { .. } | DynamicsError::Implausible { .. } => {
                invalid("motion", text, "one that can be followed".to_owned())
            }
            DynamicsError::Folded { .. } | DynamicsError::NotStable { .. } => {
                invalid("equilibrium", text, "one with natural motions".to_owned())
            }
        }
    }
}

/// Refuses numbers that are not finite and above zero.
pub(crate) fn positive(field: &'static str, value: f64, expected: &str) -> Result<(), DynamicsError> {
    if value.is_finite() && value > 0.0 {
        return Ok(());
    }
    Err(DynamicsError::Invalid { field, value: format!("{value:?}"), expected: expected.to_owned() })
}
