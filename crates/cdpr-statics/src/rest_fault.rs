//! Why a solution of the balance with free coordinates is refused.

use crate::out_of_limits::{Limit, OutOfLimits};
use cdpr_robot::{decimal, visible};
use std::fmt;

/// What is wrong about lengths and free coordinates with which a platform might rest.
#[derive(Clone, Debug, PartialEq)]
pub enum RestFault {
    /// A tension is below its least or above its greatest value.
    Limit(OutOfLimits),
    /// A cable or an anchor point is below the ground.
    BelowGround {
        /// Index of the cable, from 0.
        cable: usize,
        /// Whether it is the anchor point; else the lowest point of the cable.
        is_anchor: bool,
        /// Height of this point [m].
        height: f64,
        /// Height of the ground [m].
        ground: f64,
        /// The limit of a tension that is passed, too: another height of the ground alone is then no remedy.
        also: Option<OutOfLimits>,
    },
    /// A cable is paid out so far that it is a loop.
    Loop {
        /// Index of the cable, from 0.
        cable: usize,
        /// Its unstrained length over the distance of its points.
        chords: f64,
        /// The greatest value allowed.
        most: f64,
    },
    /// The platform is turned over.
    TurnedOver {
        /// Angle from the given pose [rad].
        angle: f64,
        /// Whether it stays there: its pitch is beyond a right angle, so that roll and yaw are not the given
        /// ones.
        is_stable: bool,
    },
    /// A cable would have to push, if all were straight.
    Pushing {
        /// Index of the cable, from 0.
        cable: usize,
        /// The force [N].
        force: f64,
    },
    /// A wrench is left that nothing balances.
    Residual {
        /// Norm of the residual force [N].
        force: f64,
        /// Norm of the residual moment [N m].
        moment: f64,
    },
}

impl RestFault {
    /// Its kind, from the nearest to a rest to the farthest.
    pub(crate) fn order(&self) -> u8 {
        match self {
            Self::Limit(_) => 0,
            Self::BelowGround { .. } => 1,
            Self::Loop { .. } => 2,
            Self::TurnedOver { .. } => 3,
            Self::Pushing { .. } => 4,
            Self::Residual { .. } => 5,
        }
    }

    /// How much is wrong, among faults of one kind but residuals.
    pub(crate) fn extent(&self) -> f64 {
        match self {
            Self::Limit(passed) => (passed.tension / passed.value).ln().abs(),
            Self::BelowGround { height, ground, .. } => ground - height,
            Self::Loop { chords, .. } => *chords,
            Self::TurnedOver { angle, .. } => *angle,
            Self::Pushing { force, .. } => *force,
            Self::Residual { .. } => 0.0,
        }
    }
}

/// A tension and the limit that it passes.
fn beyond(OutOfLimits { cable, end, tension, limit, value }: &OutOfLimits) -> String {
    let side = if matches!(limit, Limit::Min) { "below" } else { "above" };
    let end = if end.is_anchor() { "" } else { " at its exit point" };
    format!("cable {} at {} N{end}, {side} its limit of {value} N", cable + 1, visible(*tension, 3))
}

impl fmt::Display for RestFault {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let number = |cable: &usize| cable + 1;
        match self {
            Self::Limit(passed) => write!(
                f,
                "taut solutions exist only with {}; change the pose, the load or tension_limits",
                beyond(passed)
            ),
            Self::BelowGround { cable, is_anchor, height, ground, also } => {
                let what = if *is_anchor { "the anchor point" } else { "the lowest point" };
                let (cable, height) = (number(cable), visible(*height, 3));
                write!(
                    f,
                    "only with {what} of cable {cable} at z = {height} m, below the ground at {ground} m"
                )?;
                match also {
                    None => write!(f, "; change the pose or ground_z"),
                    Some(passed) => write!(
                        f,
                        ", and with {}; change the pose, or both ground_z and tension_limits",
                        beyond(passed)
                    ),
                }
            }
            Self::Loop { cable, chords, most } => write!(
                f,
                "only with cable {} as a loop of {} chords, where {most} are allowed; change the pose, or \
                 name other coordinates as free",
                number(cable),
                decimal(*chords, 1)
            ),
            Self::TurnedOver { angle, is_stable } => write!(
                f,
                "only with the platform turned over by {} degrees, {}; change the pose",
                decimal(angle.to_degrees(), 0),
                if *is_stable { "at other angles than those given" } else { "where it does not stay" }
            ),
            Self::Pushing { cable, force } => write!(
                f,
                "cable {} would have to push with {} N; change the pose, or name other coordinates as free",
                number(cable),
                visible(*force, 3)
            ),
            Self::Residual { force, moment } => write!(
                f,
                "the best leave {} N and {} N m; change the pose or name other coordinates as free",
                visible(*force, 3),
                visible(*moment, 3)
            ),
        }
    }
}
