//! Exceptions: the classes of `cdpr.errors`, with the sentences of the libraries.

use cdpr_assess::AssessError;
use cdpr_cable::CableError;
use cdpr_calibration::CalibrationError;
use cdpr_dynamics::DynamicsError;
use cdpr_exchange::ExchangeError;
use cdpr_robot::RobotError;
use cdpr_sensitivity::SensitivityError;
use cdpr_statics::StaticsError;
use cdpr_study::StudyError;
use pyo3::prelude::*;
use pyo3::types::PyType;

/// An error that becomes an exception.
pub(crate) enum Raised {
    /// `InputError`: an invalid value.
    Input(String),
    /// `FileError`: a file or folder that cannot be read, written or used.
    File(String),
    /// `NoSolutionError`: a question without an answer.
    NoSolution {
        /// The kind of failure, as in tables of studies: `infeasible_tension`, ...
        kind: &'static str,
        message: String,
    },
    /// `FaultError`: a fault of the program, whatever the input.
    Fault(String),
    /// An exception of Python itself.
    Python(PyErr),
}

pub(crate) type Answer<T> = Result<T, Raised>;

impl From<Raised> for PyErr {
    fn from(raised: Raised) -> Self {
        Python::attach(|py| {
            let made = match raised {
                Raised::Input(message) => {
                    class(py, "InputError").map(|class| Self::from_type(class, message))
                }
                Raised::File(message) => class(py, "FileError").map(|class| Self::from_type(class, message)),
                Raised::NoSolution { kind, message } => {
                    class(py, "NoSolutionError").map(|class| Self::from_type(class, (message, kind)))
                }
                Raised::Fault(message) => {
                    let message = format!("a fault of cdpr, which should be reported: {message}");
                    class(py, "FaultError").map(|class| Self::from_type(class, message))
                }
                Raised::Python(error) => Ok(error),
            };
            made.unwrap_or_else(|error| error)
        })
    }
}

/// A class of `cdpr.errors`.
fn class<'py>(py: Python<'py>, name: &str) -> PyResult<Bound<'py, PyType>> {
    Ok(py.import("cdpr.errors")?.getattr(name)?.cast_into()?)
}

impl From<PyErr> for Raised {
    fn from(error: PyErr) -> Self {
        Self::Python(error)
    }
}

impl From<RobotError> for Raised {
    fn from(error: RobotError) -> Self {
        Self::Input(error.to_string())
    }
}

/// A reason why a case has no answer.
pub(crate) trait Failure: ToString {
    /// The kind of failure, as in tables of studies.
    fn kind(&self) -> &'static str;
}

impl Failure for CableError {
    fn kind(&self) -> &'static str {
        match self {
            Self::InvalidInput { .. } => "invalid_input",
            Self::AtPulley { .. } => "cable_at_its_pulley",
            Self::TensionTooSmall { .. } => "tension_too_small",
            Self::Overstrained { .. } => "cable_overstrained",
            Self::NotConverged { .. } => "cable",
        }
    }
}

impl Failure for StaticsError {
    fn kind(&self) -> &'static str {
        self.kind()
    }
}

impl From<&CableError> for Raised {
    fn from(error: &CableError) -> Self {
        let message = error.to_string();
        match error {
            CableError::InvalidInput { .. } => Self::Input(message),
            _ => Self::NoSolution { kind: error.kind(), message },
        }
    }
}

impl From<StaticsError> for Raised {
    fn from(error: StaticsError) -> Self {
        Self::from(&error)
    }
}

impl From<&StaticsError> for Raised {
    fn from(error: &StaticsError) -> Self {
        let message = error.to_string();
        match error {
            StaticsError::Robot(_)
            | StaticsError::Invalid { .. }
            | StaticsError::Cable { source: CableError::InvalidInput { .. }, .. } => Self::Input(message),
            _ => Self::NoSolution { kind: error.kind(), message },
        }
    }
}

impl From<DynamicsError> for Raised {
    fn from(error: DynamicsError) -> Self {
        let message = error.to_string();
        let kind = match error {
            DynamicsError::Statics(error) => return error.into(),
            DynamicsError::Stalled { .. } => "stalled",
            DynamicsError::Implausible { .. } => "implausible",
            DynamicsError::Folded { .. } => "folded",
            DynamicsError::NotStable { .. } => "not_stable",
            DynamicsError::TooFast { .. } => "too_fast",
            DynamicsError::Jump { .. } => "jump",
            _ => return Self::Input(message),
        };
        Self::NoSolution { kind, message }
    }
}

impl From<SensitivityError> for Raised {
    fn from(error: SensitivityError) -> Self {
        let message = error.to_string();
        match error {
            SensitivityError::NotConverged { .. } => Self::NoSolution { kind: "not_converged", message },
            _ => Self::Input(message),
        }
    }
}

impl From<CalibrationError> for Raised {
    fn from(error: CalibrationError) -> Self {
        match error {
            CalibrationError::Study(error) => error.into(),
            CalibrationError::Statics(error) => error.into(),
            error @ CalibrationError::Row { .. } => {
                Self::NoSolution { kind: error.kind(), message: error.to_string() }
            }
            error => Self::Input(error.to_string()),
        }
    }
}

impl From<AssessError> for Raised {
    fn from(error: AssessError) -> Self {
        match error {
            AssessError::Study(error) => error.into(),
            AssessError::Unobservable { .. } => {
                Self::NoSolution { kind: "unobservable", message: error.to_string() }
            }
            error => Self::Input(error.to_string()),
        }
    }
}

impl From<ExchangeError> for Raised {
    fn from(error: ExchangeError) -> Self {
        match error {
            ExchangeError::Pose(error) => error.into(),
            error => Self::Input(error.to_string()),
        }
    }
}

impl From<StudyError> for Raised {
    fn from(error: StudyError) -> Self {
        let help = match &error {
            StudyError::FileExists { .. } => "; overwrite=True replaces it",
            StudyError::ResultsExist { .. } => "; overwrite=True replaces them",
            StudyError::ForeignFolder { .. } => ", or overwrite=True",
            StudyError::FolderInUse { .. } => ": resume=True goes on with them, overwrite=True begins again",
            StudyError::MissingBlocks { .. } => ": run the rest with resume=True",
            StudyError::NotAnalysed { .. } => ": analyse it with resume=True",
            _ => "",
        };
        let message = format!("{error}{help}");
        match kind(&error) {
            Some(kind) => Self::NoSolution { kind, message },
            None if is_of_files(&error) => Self::File(message),
            None => Self::Input(message),
        }
    }
}

/// The kind of failure, if the error is a question without an answer.
fn kind(error: &StudyError) -> Option<&'static str> {
    match error {
        StudyError::At { source, .. } => kind(source),
        StudyError::Nominal { source, .. } => match Raised::from(source.as_ref()) {
            Raised::NoSolution { kind, .. } => Some(kind),
            _ => None,
        },
        _ => None,
    }
}

fn is_of_files(error: &StudyError) -> bool {
    matches!(
        error,
        StudyError::Read { .. }
            | StudyError::NotRegular { .. }
            | StudyError::NoFolder { .. }
            | StudyError::OtherKind { .. }
            | StudyError::TooLarge { .. }
            | StudyError::Write { .. }
            | StudyError::FolderInUse { .. }
            | StudyError::ForeignFolder { .. }
            | StudyError::ForeignBlock { .. }
            | StudyError::DamagedBlock { .. }
            | StudyError::MissingBlocks { .. }
            | StudyError::NoResults { .. }
            | StudyError::FileExists { .. }
            | StudyError::ResultsExist { .. }
            | StudyError::Changed { .. }
            | StudyError::FolderBusy { .. }
            | StudyError::OtherResults { .. }
            | StudyError::Link { .. }
            | StudyError::NotOwned { .. }
            | StudyError::Mixed { .. }
            | StudyError::NotAnalysed { .. }
    )
}
