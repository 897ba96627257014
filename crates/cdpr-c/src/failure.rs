//! Why a call has failed: its status, and the message of the thread.

use cdpr_robot::RobotError;
use cdpr_statics::StaticsError;
use std::cell::RefCell;
use std::ffi::c_char;
use std::fmt::{self, Write};
use std::panic::{AssertUnwindSafe, catch_unwind};

/// How a call has ended.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum CdprStatus {
    /// The results are written.
    Ok = 0,
    /// A pointer is null or not aligned.
    Pointer = 1,
    /// The number of values is not that of the robot's cables or inputs.
    Size = 2,
    /// A value is NaN, infinite or out of its range.
    Invalid = 3,
    /// The text is not a robot, or no robot of the library has this name.
    Robot = 4,
    /// The function does not take this kind of robot.
    Unsupported = 5,
    /// There is no result: the pose is infeasible, a cable is overstrained, or a derivative does not exist.
    NoSolution = 6,
    /// The equilibrium is unstable or is lost on the way to the load.
    Unstable = 7,
    /// The iterations did not converge. A tracker or an observer keeps its last state.
    NotConverged = 8,
    /// A fault of the library. Free the handle of the call, and report the message.
    Panic = 9,
}

/// Why a call has failed.
#[derive(Debug)]
pub(crate) enum Failure {
    /// A pointer is null or not aligned.
    Pointer(&'static str),
    /// Another number of values.
    Size { field: &'static str, given: usize, expected: usize },
    /// A value that is NaN, infinite or out of its range.
    Value { field: &'static str, index: usize, expected: &'static str },
    /// A text that is not valid.
    Text { status: CdprStatus, reason: String },
    /// A robot that a function does not take.
    Unsupported(&'static str),
    /// Steps of a tracker, or samples of an observer, that did not converge.
    NotConverged { iterations: usize },
    /// The models have no result.
    Models(StaticsError),
    /// A panic, which was caught.
    Panic,
}

impl From<StaticsError> for Failure {
    fn from(error: StaticsError) -> Self {
        match error {
            StaticsError::FreeCoordinates { .. } => Self::FEW_CABLES,
            error => Self::Models(error),
        }
    }
}

impl From<RobotError> for Failure {
    fn from(error: RobotError) -> Self {
        Self::Text { status: CdprStatus::Robot, reason: error.to_string() }
    }
}

impl fmt::Display for Failure {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Pointer(field) => write!(f, "{field} is null or not aligned: expected a valid pointer"),
            Self::Size { field, given, expected } => {
                write!(f, "{field} has {given} values: expected {expected}")
            }
            Self::Value { field, index, expected } => {
                write!(f, "value {index} of {field}, from 0, is invalid: expected {expected}")
            }
            Self::Text { reason, .. } => f.write_str(reason),
            Self::Unsupported(robot) => write!(f, "{robot} is not supported by this function"),
            Self::NotConverged { iterations } => write!(
                f,
                "no equilibrium was found within {iterations} iterations of the last one, which is kept: \
                 make smaller steps, or create the handle again"
            ),
            Self::Models(error) => error.fmt(f),
            Self::Panic => f.write_str("the library has panicked: free the handle and report this"),
        }
    }
}

impl Failure {
    /// A function without free coordinates.
    pub(crate) const FEW_CABLES: Self = Self::Unsupported("a robot with fewer cables than free motions");

    fn status(&self) -> CdprStatus {
        match self {
            Self::Pointer(_) => CdprStatus::Pointer,
            Self::Size { .. } => CdprStatus::Size,
            Self::Value { .. } => CdprStatus::Invalid,
            Self::Text { status, .. } => *status,
            Self::Unsupported(_) => CdprStatus::Unsupported,
            Self::NotConverged { .. } => CdprStatus::NotConverged,
            Self::Models(error) => match error.kind() {
                "invalid_robot" => CdprStatus::Robot,
                "invalid_input" => CdprStatus::Invalid,
                "unstable" | "equilibrium_lost" | "branch_ends" => CdprStatus::Unstable,
                "direct_not_converged" | "inverse_not_converged" => CdprStatus::NotConverged,
                _ => CdprStatus::NoSolution,
            },
            Self::Panic => CdprStatus::Panic,
        }
    }

    /// Writes the message of the thread, without allocation, and returns the status.
    pub(crate) fn keep(&self) -> CdprStatus {
        MESSAGE.with_borrow_mut(|message| {
            message.clear();
            // What does not fit is left out.
            let _ = write!(message, "{self}");
        });
        self.status()
    }
}

/// Runs the body of a function of the border; a panic ends here.
pub(crate) fn guarded(body: impl FnOnce() -> Result<(), Failure>) -> CdprStatus {
    let kept = || body().map_or_else(|failure| failure.keep(), |()| CdprStatus::Ok);
    catch_unwind(AssertUnwindSafe(kept)).unwrap_or_else(|_| Failure::Panic.keep())
}

/// The message of the thread's last failure, which ends with a zero; it is empty before the first one.
pub(crate) fn message() -> *const c_char {
    MESSAGE.with_borrow(|message| message.bytes.as_ptr().cast())
}

/// Bytes of a message, with the zero at its end.
const LONGEST: usize = 1024;

struct Message {
    bytes: [u8; LONGEST],
    length: usize,
}

thread_local! {
    static MESSAGE: RefCell<Message> = const { RefCell::new(Message { bytes: [0; LONGEST], length: 0 }) };
}

impl Message {
    fn clear(&mut self) {
        (self.bytes[0], self.length) = (0, 0);
    }
}

impl Write for Message {
    fn write_str(&mut self, text: &str) -> fmt::Result {
        for character in text.chars() {
            let end = self.length + character.len_utf8();
            if end >= LONGEST {
                return Err(fmt::Error);
            }
            character.encode_utf8(&mut self.bytes[self.length..end]);
            (self.bytes[end], self.length) = (0, end);
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    #[allow(clippy::panic)]
    fn a_panic_becomes_a_status_with_a_message() {
        assert_eq!(guarded(|| Ok(())), CdprStatus::Ok);
        assert_eq!(guarded(|| panic!("a fault")), CdprStatus::Panic);
        MESSAGE.with_borrow(|message| assert!(message.bytes.starts_with(b"the library has panicked")));
    }
}
