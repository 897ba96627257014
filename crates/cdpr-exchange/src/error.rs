//! Why a file of another program was not imported, or a robot not exported.

use cdpr_robot::RobotError;
use cdpr_statics::StaticsError;
use cdpr_study::TableError;
use std::fmt;

/// Why a file of another program was not imported, or a robot not exported.
#[derive(Debug, thiserror::Error)]
pub enum ExchangeError {
    /// The text is not of its language.
    #[error("{file}, line {line}, column {column}: {message}")]
    Syntax {
        /// The file.
        file: String,
        /// Line, from 1.
        line: usize,
        /// Column in that line, from 1.
        column: usize,
        /// What the reader of XML or YAML says.
        message: String,
    },
    /// A file is larger than that of any robot.
    #[error("{file}, line {line}, column {column}: more than {most} {what}: expected the file of a robot")]
    TooLarge {
        /// The file.
        file: String,
        /// Line, from 1.
        line: usize,
        /// Column in that line, from 1.
        column: usize,
        /// What it has too many of.
        what: &'static str,
        /// How many of them are read at most.
        most: usize,
    },
    /// A value is missing or invalid, or has no counterpart in a robot file.
    #[error("{file}, line {line}, column {column}: {element} is {value}: expected {expected}")]
    Value {
        /// The file.
        file: String,
        /// Line, from 1.
        line: usize,
        /// Column in that line, from 1.
        column: usize,
        /// Path of the element, such as `cables/cable_set/cable_ideal[2]/@name`.
        element: String,
        /// What stands there.
        value: String,
        /// What would be right.
        expected: String,
    },
    /// A file that is not a table, or a cell that is not a number.
    #[error("{file}, {source}")]
    Table {
        /// The file.
        file: String,
        /// What is wrong, with its line.
        source: TableError,
    },
    /// A cable set of CASPR cannot be imported; the file has others.
    #[error("{source}; this is the cable set {set}, the file also has {}", .others.join(", "))]
    CableSet {
        /// What is wrong in this set.
        source: Box<ExchangeError>,
        /// Its name.
        set: String,
        /// Names of the other sets.
        others: Vec<String>,
    },
    /// The format of a file is not known.
    #[error("{file}: {found}: expected {FORMATS}")]
    Unknown {
        /// The file.
        file: String,
        /// What it begins with.
        found: String,
    },
    /// Files do not make a robot together.
    #[error("{given}: expected {expected}")]
    Together {
        /// The files.
        given: String,
        /// What would be right.
        expected: String,
    },
    /// The files lack what a robot needs.
    #[error("the files do not have {}", list(.0))]
    Lacking(Vec<Lacking>),
    /// What was read is no robot.
    #[error("the files make no robot: {0}")]
    Robot(RobotError),
    /// A robot with something for which the other format has no place.
    #[error("{field} is {value}: the format has no place for it, expected {expected}; {}", instead(takers))]
    NoPlace {
        /// Path of the field in the robot file.
        field: String,
        /// Its value.
        value: String,
        /// What the format has a place for.
        expected: &'static str,
        /// Names of the formats that take this robot at its pose.
        takers: Vec<&'static str>,
    },
    /// The coordinates of a table make no grid, or too large a one.
    #[error("{field} is {value}: expected {expected}")]
    Grid {
        /// What is wrong: `coordinates along x`, or `positions`.
        field: String,
        /// Its value.
        value: String,
        /// What would be right.
        expected: String,
    },
    /// A robot has no lengths at a position of a table.
    #[error("at ({}, {}, {}) m: {reason}", .position[0], .position[1], .position[2])]
    Position {
        /// The position [m].
        position: [f64; 3],
        /// Why it has none.
        reason: String,
    },
    /// The pose of the exported file is not held.
    #[error(transparent)]
    Pose(#[from] StaticsError),
}

impl ExchangeError {
    /// A field for which a format has no place. [`crate::export`] adds the formats that take the robot.
    pub(crate) fn no_place(field: impl Into<String>, value: impl ToString, expected: &'static str) -> Self {
        Self::NoPlace { field: field.into(), value: value.to_string(), expected, takers: Vec::new() }
    }
}

/// Which formats take a robot that another one refuses.
pub fn instead(takers: &[&str]) -> String {
    match takers {
        [] => "no other format takes this robot at this pose".to_owned(),
        [one] => format!("{one} takes this robot at this pose"),
        [others @ .., last] => format!("{} and {last} take this robot at this pose", others.join(", ")),
    }
}

/// The formats that are read.
pub const FORMATS: &str = "the bodies and cables of CASPR (XML), a .wcrfx file of WireX (XML), a model of \
                           MuJoCo (XML), a robot of oKermorgant's cdpr (YAML, or the SDF made of it), one of \
                           IRMA (JSON), a system of MoorPy or MoorDyn, or a table of points (CSV)";

/// What a robot needs and files of other programs may lack.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Lacking {
    /// Section, density and modulus of the cables.
    Cable,
    /// Mass of the platform.
    Mass,
    /// Limits of tension.
    TensionLimits,
}

impl fmt::Display for Lacking {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Cable => "section, density and modulus of the cables",
            Self::Mass => "the mass of the platform",
            Self::TensionLimits => "limits of tension",
        })
    }
}

fn list(lacking: &[Lacking]) -> String {
    lacking.iter().map(ToString::to_string).collect::<Vec<_>>().join(", nor ")
}
