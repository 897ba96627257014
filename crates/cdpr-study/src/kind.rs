//! The kinds of files that are read.

use std::fmt;

/// What a file is read as, which limits its size.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum InputKind {
    /// A robot file.
    Robot,
    /// A cable file.
    Cable,
    /// A file of another program, to be imported.
    Foreign,
    /// A study file, in which poses may be listed one by one.
    Study,
    /// An elastic law of cables.
    Law,
    /// Correlated errors of parameters, or an error model.
    Errors,
    /// Measurements for a calibration.
    Measurements,
    /// A load-elongation record.
    Record,
    /// Published moduli.
    Moduli,
    /// Poses, one a line.
    Poses,
    /// Cases of the direct model.
    Cases,
    /// A table or summary in a folder of results.
    Results,
    /// A table to be analysed.
    Table,
    /// A block of observations.
    Block,
}

const MEGABYTE: u64 = 1_000_000;

impl InputKind {
    /// Largest size of such a file \[bytes\]: hundreds of times what has been seen.
    pub fn most_bytes(self) -> u64 {
        MEGABYTE
            * match self {
                Self::Robot | Self::Cable | Self::Foreign | Self::Law | Self::Moduli => 4,
                Self::Study | Self::Poses | Self::Cases | Self::Block | Self::Errors | Self::Measurements => {
                    32
                }
                Self::Record => 64,
                Self::Results | Self::Table => 256,
            }
    }
}

impl InputKind {
    /// Name of the format that such a file states, without its version.
    pub(crate) fn format(self) -> Option<&'static str> {
        match self {
            Self::Robot => Some("cdpr-robot"),
            Self::Cable => Some("cdpr-cable"),
            Self::Study => Some("cdpr-study"),
            Self::Law => Some("cdpr-law"),
            _ => None,
        }
    }
}

impl fmt::Display for InputKind {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Robot => "a robot file",
            Self::Cable => "a cable file",
            Self::Foreign => "a file to import",
            Self::Study => "a study file",
            Self::Law => "a law file",
            Self::Errors => "an error model",
            Self::Measurements => "measurements",
            Self::Record => "a record",
            Self::Moduli => "a file of moduli",
            Self::Poses => "a list of poses",
            Self::Cases => "a file of cases",
            Self::Results => "a file of results",
            Self::Table => "a table",
            Self::Block => "a block",
        })
    }
}
