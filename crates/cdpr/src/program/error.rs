//! Every error of the program, and its exit code.

use cdpr_assess::AssessError;
use cdpr_cable::{CableError, RecordError};
use cdpr_calibration::CalibrationError;
use cdpr_dynamics::DynamicsError;
use cdpr_exchange::{ExchangeError, Lacking};
use cdpr_report::ReportError;
use cdpr_robot::{JsonError, QuaternionError, Robot, counted};
use cdpr_statics::StaticsError;
use cdpr_study::{InputKind, ROBOT_NAME, STUDY_NAME, StudyError};
use std::path::{Path, PathBuf};

/// Why a command did not do what it was asked for.
#[derive(Debug, thiserror::Error)]
pub(crate) enum ProgramError {
    /// Arguments are wrong together, which clap cannot find: it judges them one by one.
    #[error("{0}\n\nFor more information, try '--help'.")]
    Usage(String),
    #[error(transparent)]
    Cable(#[from] CableError),
    #[error(transparent)]
    Record(#[from] RecordError),
    #[error("{}", asked_for(.0))]
    Exchange(#[from] ExchangeError),
    #[error(transparent)]
    Dynamics(#[from] DynamicsError),
    #[error(transparent)]
    Statics(#[from] StaticsError),
    #[error("{}", with_options(.0))]
    Study(#[from] StudyError),
    #[error(transparent)]
    Assess(AssessError),
    #[error(transparent)]
    Calibration(CalibrationError),
    #[error(transparent)]
    Report(#[from] ReportError),
    /// A file was read, and what it says is wrong.
    #[error("{path}: {source}")]
    InFile { path: PathBuf, source: Box<ProgramError> },
    #[error(transparent)]
    Format(#[from] JsonError),
    #[error("cable {cable}: {source}")]
    OfCable { cable: usize, source: CableError },
    #[error(
        "the cables of the robot differ in their section: expected --section, that of the record's specimen"
    )]
    DifferentSections,
    #[error(
        "no cable of the robot has a law: expected --law, a `law` in the robot file, or --with friction=MU for \
         pulleys"
    )]
    NoLaw,
    /// A command without `--free`, and a robot that needs it.
    #[error(
        "{} for {} leave {} of the pose that cannot be chosen, and this command chooses all: expected \
         {freedoms} cables or more; {instead}",
        counted(*cables, "cable"), counted(*freedoms, "free motion"),
        counted(freedoms.saturating_sub(*cables), "coordinate")
    )]
    TooFewCables { cables: usize, freedoms: usize, instead: String },
    /// A list of poses or wrenches.
    #[error("{option} {path}, {reason}")]
    List { option: &'static str, path: PathBuf, reason: String },
    #[error("the robot holds none of the candidate poses: {reasons}")]
    NoPoseHeld { reasons: String },
    #[error("cannot start {threads} threads: {source}")]
    Threads { threads: u16, source: rayon::ThreadPoolBuildError },
    #[error(
        "{processes} processes run this study together, and each would make the whole of it: expected one, or \
         several with --shard"
    )]
    Together { processes: usize },
    #[error("cannot ask the system to report files that are too large: {0}")]
    FileLimit(std::io::Error),
    #[error("cannot wait for Ctrl-C: {0}")]
    Signals(#[from] ctrlc::Error),
    #[error("cannot open {path} in a browser: {reason}; it is written, and any browser opens it")]
    Browser { path: PathBuf, reason: String },
    #[error("cannot write {path}: {source}")]
    Unwritten { path: PathBuf, source: std::io::Error },
    #[error("cannot write JSON: {0}")]
    Json(#[from] serde_json::Error),
}

impl From<AssessError> for ProgramError {
    fn from(error: AssessError) -> Self {
        match error {
            AssessError::Study(error) => Self::Study(error),
            error => Self::Assess(error),
        }
    }
}

impl From<CalibrationError> for ProgramError {
    fn from(error: CalibrationError) -> Self {
        match error {
            CalibrationError::Study(error) => Self::Study(error),
            CalibrationError::Statics(error) => Self::Statics(error),
            error => Self::Calibration(error),
        }
    }
}

impl ProgramError {
    /// The error with the file that it is about.
    pub(crate) fn in_file<E: Into<Self>>(path: &Path) -> impl Fn(E) -> Self {
        |source| Self::InFile { path: path.to_owned(), source: Box::new(source.into()) }
    }

    /// Refuses a robot with fewer cables than free motions, and says what takes it instead.
    pub(crate) fn unless_chosen(robot: &Robot, instead: impl FnOnce() -> String) -> Result<(), Self> {
        let (cables, freedoms) = (robot.cables.len(), robot.freedoms().count());
        let refusal = |instead| Err(Self::TooFewCables { cables, freedoms, instead });
        if cables < freedoms { refusal(instead()) } else { Ok(()) }
    }

    /// The error of writing to a path.
    pub(crate) fn unwritten(path: &Path) -> impl Fn(std::io::Error) -> Self {
        |source| Self::Unwritten { path: path.to_owned(), source }
    }

    /// 2 for wrong arguments, 3 for a platform that falls before the whole load is on it, which is an answer;
    /// 1 for everything else.
    pub(crate) fn exit_code(&self) -> u8 {
        match self {
            Self::Statics(StaticsError::BranchEnds(_)) => 3,
            Self::Calibration(CalibrationError::Row { source, .. })
                if matches!(**source, StaticsError::BranchEnds(_)) =>
            {
                3
            }
            Self::InFile { source, .. } => source.exit_code(),
            Self::Usage(_) => 2,
            Self::Study(error) if error.is_argument() => 2,
            Self::Exchange(ExchangeError::Lacking(_)) => 2,
            _ => 1,
        }
    }
}

/// The sentence of the library with the options that give what files of another program lack.
fn asked_for(error: &ExchangeError) -> String {
    let ExchangeError::Lacking(lacking) = error else {
        let help = match error {
            ExchangeError::CableSet { .. } => ": `FILE:SET` chooses one",
            _ => "",
        };
        return format!("{error}{help}");
    };
    let options = lacking.iter().map(|lacking| match lacking {
        Lacking::Cable => "--cable NAME or FILE (`cdpr robot list` lists the names)",
        Lacking::Mass => "--mass KG",
        Lacking::TensionLimits => "--tension-limits MIN,MAX",
    });
    format!("{error}: expected {}", options.collect::<Vec<_>>().join(", "))
}

/// The sentence of the library with the options of the program that it is about, or that help.
fn with_options(error: &StudyError) -> String {
    let help = match error {
        StudyError::Setting { field, .. } => {
            return match field.as_str() {
                "observations" | "shard" => format!("--{error}"),
                // The position of a template.
                "position" => format!("--pose: {error}"),
                _ => error.to_string(),
            };
        }
        StudyError::OtherKind { found: InputKind::Robot, kind: InputKind::Study, .. } => {
            ": `cdpr study new` writes a study of it"
        }
        StudyError::OtherKind { found: InputKind::Robot, .. } => ": `cdpr robot check` takes it",
        StudyError::OtherKind { found: InputKind::Study, .. } => {
            ": `cdpr study run` takes it, and the robot file is the one that its field `robot` names"
        }
        StudyError::OtherKind { found: InputKind::Law, .. } => {
            ": `cdpr hysteresis --law` takes it; its list `loading` is the `segments` of a cable's `law`"
        }
        StudyError::OtherKind { found: InputKind::Cable, .. } => ": `cdpr robot import --cable` takes it",
        StudyError::OtherKind { found: InputKind::Errors, .. } => {
            ": `--uncertainty` takes it, and so do the `error_models` of a study, {\"file\": ...}"
        }
        StudyError::OtherKind { found: InputKind::Measurements, .. } => ": `cdpr calibrate fit` takes it",
        StudyError::OtherKind { found: InputKind::Results, .. } => ": `cdpr study report` takes its folder",
        StudyError::OtherKind { found: InputKind::Foreign, .. } => {
            ": `cdpr robot import` makes a robot file of it"
        }
        StudyError::OtherKind { found: InputKind::Table, kind: InputKind::Robot, .. } => {
            ": `cdpr robot import` makes a robot file of a table of points"
        }
        StudyError::OtherKind { found: InputKind::Table, .. } => ": `cdpr analyse` takes it",
        StudyError::NoSuchName { .. } => "; `cdpr robot list` lists them all",
        StudyError::FileExists { .. } => "; --overwrite replaces it",
        StudyError::ResultsExist { .. } => "; --overwrite replaces them",
        StudyError::ForeignFolder { .. } => ", or --overwrite what is there",
        StudyError::FolderInUse { .. } => ": --resume goes on with them, --overwrite begins again",
        StudyError::MissingBlocks { .. } => ": run the rest with --resume or --shard",
        StudyError::NotAnalysed { .. } => {
            ": analyse it with cdpr study merge, or cdpr study run --resume where blocks are missing"
        }
        StudyError::Changed { path } if path.ends_with(STUDY_NAME) => {
            ": put it back, or go on with what it says now: cdpr study run --resume"
        }
        StudyError::Changed { path } if path.ends_with(ROBOT_NAME) => {
            ": put it back, or give this robot a folder of its own"
        }
        StudyError::Changed { .. } => {
            ": move it away; then `cdpr study merge` makes it again for a study, and --overwrite for other commands"
        }
        _ => "",
    };
    format!("{error}{help}")
}

/// A pose as it is typed.
pub(crate) const POSE: &str = "expected x,y,z [m] or x,y,z,qw,qx,qy,qz";

/// Why numbers are no pose.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub(crate) enum PoseError {
    #[error("{0}")]
    Number(String),
    #[error("{}: {POSE}", counted(*.0, "number"))]
    Count(usize),
    #[error(
        "6 numbers: expected x,y,z [m]; angles go apart, `--rpy {},{},{}` [degrees], or below the names \
         roll_deg,pitch_deg,yaw_deg in a file",
        .0[0], .0[1], .0[2]
    )]
    Angles([f64; 3]),
    #[error(transparent)]
    Quaternion(#[from] QuaternionError),
}
