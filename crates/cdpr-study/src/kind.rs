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
    /// What a robot is designed for.
    Design,
    /// An elastic law of cables.
    Law,
    /// Correlated errors of parameters, or an error model.
    Errors,
    /// Measurements for a calibration.
    Measurements,
    /// A load-elongation record.
    Record,
    /// Poses, one a line.
    Poses,
    /// Cases of the direct model.
    Cases,
    /// Events of a motion.
    Events,
    /// A table or summary in a folder of results.
    Results,
    /// A table to be analysed.
    Table,
    /// A block of observations.
    Block,
}

const MEGABYTE: u64 = 1_000_000;

impl InputKind {
    /// Largest size of any file \[bytes\].
    pub(crate) const MOST_BYTES: u64 = 256 * MEGABYTE;

    /// Largest size of such a file \[bytes\]: hundreds of times what has been seen.
    pub fn most_bytes(self) -> u64 {
        MEGABYTE
            * match self {
                Self::Robot | Self::Cable | Self::Foreign | Self::Law => 4,
                Self::Study
                | Self::Design
                | Self::Poses
                | Self::Cases
                | Self::Events
                | Self::Block
                | Self::Errors
                | Self::Measurements => 32,
                Self::Record => 64,
                Self::Results | Self::Table => 256,
            }
    }
}

/// Names of the formats that files state, without their versions.
const FORMATS: [(&str, InputKind); 9] = [
    ("cdpr-robot", InputKind::Robot),
    ("cdpr-cable", InputKind::Cable),
    ("cdpr-study", InputKind::Study),
    ("cdpr-design", InputKind::Design),
    ("cdpr-law", InputKind::Law),
    ("cdpr-errors", InputKind::Errors),
    ("cdpr-measurements", InputKind::Measurements),
    ("cdpr-results", InputKind::Results),
    ("cdpr-workspace", InputKind::Results),
];

impl InputKind {
    /// Whether it may be a table as text.
    pub(crate) fn may_be_table(self) -> bool {
        matches!(self, Self::Table | Self::Poses | Self::Measurements | Self::Record | Self::Foreign)
    }

    /// What a text is, by the format that it states or by how it begins. It need not be without errors.
    pub(crate) fn of_text(text: &str) -> Option<Self> {
        let text = text.trim_start();
        match text.chars().next()? {
            '<' => Some(Self::Foreign),
            '{' | '[' => {
                let value = text.split_once("\"format\"")?.1.trim_start().strip_prefix(':')?.trim_start();
                let format = value.strip_prefix('"')?.split(['/', '"']).next()?;
                FORMATS.iter().find(|(name, _)| *name == format).map(|(_, kind)| *kind)
            }
            _ => {
                let first = text.lines().find(|line| !line.trim().is_empty() && !line.starts_with('#'))?;
                let is_key = |line: &str| line.split_once(':').is_some_and(|(key, _)| is_name(key));
                if is_key(first) {
                    return Some(Self::Foreign);
                }
                (first.contains([',', ';', '\t']) && !text.contains('{')).then_some(Self::Table)
            }
        }
    }
}

/// Whether a text may be a key of YAML.
fn is_name(text: &str) -> bool {
    text.starts_with(char::is_alphabetic) && text.chars().all(|c| c.is_alphanumeric() || "_-".contains(c))
}

impl fmt::Display for InputKind {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Robot => "a robot file",
            Self::Cable => "a cable file",
            Self::Foreign => "a file to import",
            Self::Study => "a study file",
            Self::Design => "a design file",
            Self::Law => "a law file",
            Self::Errors => "an error model",
            Self::Measurements => "measurements",
            Self::Record => "a record",
            Self::Poses => "a list of poses",
            Self::Cases => "a file of cases",
            Self::Events => "a file of events",
            Self::Results => "a file of results",
            Self::Table => "a table",
            Self::Block => "a block",
        })
    }
}

#[cfg(test)]
mod tests {
    use super::InputKind;

    #[test]
    fn a_text_is_known_by_its_format_or_by_how_it_begins() {
        for (text, kind) in [
            ("{\"format\": \"cdpr-study/1\", \"robot\": ,}", Some(InputKind::Study)),
            ("\n{\"title\": 1,\n \"format\" : \"cdpr-errors/1\"}", Some(InputKind::Errors)),
            ("{\"format\": \"other/1\"}", None),
            ("{\"mass\": 3}", None),
            ("// mine, old\n{\"mass\": 3}", None),
            ("<mujoco/>", Some(InputKind::Foreign)),
            ("# a robot\npoints:\n  - {frame: [1, 2]}\n", Some(InputKind::Foreign)),
            ("x,y,z\n0,0,2\n", Some(InputKind::Table)),
            ("# poses\n0;0;2\n", Some(InputKind::Table)),
            ("", None),
        ] {
            assert_eq!(InputKind::of_text(text), kind, "{text}");
        }
    }
}
