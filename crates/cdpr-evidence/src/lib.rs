//! The evidence: what the program is compared with, how well the two agree, and what is accepted.
//!
//! Each comparison is a *case* of `data/evidence/cases.json`. A test makes the comparison and hands its
//! figure to [`accept`], which fails where the figure is not accepted. With the variable [`FOLDER`] set, it
//! also writes the figure to a file there: `cargo xtask evidence` makes the tables of `docs/trust.md` of
//! these files.

#![allow(clippy::panic, clippy::print_stdout)]

use serde::{Deserialize, Serialize};
use std::fs;
use std::path::{Path, PathBuf};

/// Variable of the environment that names the folder for the figures.
pub const FOLDER: &str = "CDPR_EVIDENCE";

const CASES: &str = include_str!("../../../data/evidence/cases.json");

/// How independent the reference of a case is.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Level {
    /// Exact values: arithmetic of 20 to 40 digits, or a law that has to hold.
    Analytic,
    /// A program that shares no code with this one, or what others have published.
    Independent,
    /// Measurements of a robot or a cable.
    Experiment,
}

/// What is accepted of a figure.
#[derive(Clone, Copy, Debug, PartialEq, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Acceptance {
    /// At most this.
    AtMost(f64),
    /// At least this.
    AtLeast(f64),
}

impl Acceptance {
    /// Whether a figure is accepted.
    pub fn accepts(self, figure: f64) -> bool {
        match self {
            Self::AtMost(bound) => figure <= bound,
            Self::AtLeast(bound) => figure >= bound,
        }
    }

    /// The worse one of two figures.
    fn worse(self, figures: [f64; 2]) -> f64 {
        match self {
            Self::AtMost(_) => figures[0].max(figures[1]),
            Self::AtLeast(_) => figures[0].min(figures[1]),
        }
    }
}

/// A comparison.
#[derive(Clone, Debug, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Case {
    /// Identifier, such as `V-CABLE-003`.
    pub id: String,
    /// How independent the reference is.
    pub level: Level,
    /// What is compared, with the robots.
    pub what: String,
    /// With what: source, program, file.
    pub reference: String,
    /// The figure, in words.
    pub metric: String,
    /// Its unit; empty for a number.
    #[serde(default)]
    pub unit: String,
    /// What is accepted.
    pub accepted: Acceptance,
    /// Whether the figure is a result in all its digits, such as a difference from an experiment; other
    /// figures are errors near rounding, of which the order counts.
    #[serde(default)]
    pub digits: bool,
    /// The test that makes the comparison: a crate and the name of the test.
    pub test: [String; 2],
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Cases {
    cases: Vec<Case>,
}

/// The figure of a case.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Found {
    /// The figure.
    pub found: f64,
}

/// All cases.
///
/// # Errors
/// The message of serde for a file that is not of the format.
pub fn cases() -> Result<Vec<Case>, String> {
    serde_json::from_str(CASES).map(|Cases { cases }| cases).map_err(|error| error.to_string())
}

/// The file of the figure of a case in a folder.
pub fn file(folder: &Path, id: &str) -> PathBuf {
    folder.join(format!("{id}.json"))
}

/// Reads the figure of a case.
///
/// # Errors
/// What is wrong with the file.
pub fn read(folder: &Path, id: &str) -> Result<f64, String> {
    let path = file(folder, id);
    let text = fs::read_to_string(&path).map_err(|error| format!("{}: {error}", path.display()))?;
    let found: Found = serde_json::from_str(&text).map_err(|error| format!("{}: {error}", path.display()))?;
    Ok(found.found)
}

/// Writes the figure of a case, with two digits: what follows them may differ with the vector unit.
///
/// # Errors
/// What the system says.
pub fn write(folder: &Path, id: &str, figure: f64) -> Result<(), String> {
    let found = Found { found: format!("{figure:.1e}").parse().unwrap_or(figure) };
    let text = serde_json::to_string(&found).map_err(|error| error.to_string())? + "\n";
    let written = fs::create_dir_all(folder).and_then(|()| fs::write(file(folder, id), text));
    written.map_err(|error| format!("{}: {error}", folder.display()))
}

/// States the figure of a case, the worst one of several calls.
///
/// # Panics
/// Where the figure is not accepted, or no case has this identifier: tests call it.
#[track_caller]
pub fn accept(id: &str, figure: f64) {
    let cases = cases().unwrap_or_else(|error| panic!("data/evidence/cases.json: {error}"));
    let case = cases.iter().find(|case| case.id == id);
    let Some(case) = case else { panic!("data/evidence/cases.json has no case {id}") };
    println!("{id}: {} {figure:.2e} {}", case.metric, case.unit);
    if let Some(folder) = std::env::var_os(FOLDER).map(PathBuf::from) {
        let before = read(&folder, id).unwrap_or(figure);
        let written = write(&folder, id, case.accepted.worse([before, figure]));
        written.unwrap_or_else(|error| panic!("{error}"));
    }
    let Case { metric, unit, accepted, .. } = case;
    assert!(accepted.accepts(figure), "{id}: {metric} is {figure:e} {unit}: accepted is {accepted:?}");
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::collections::BTreeSet;

    #[test]
    fn each_case_has_its_own_identifier_of_the_form_that_is_documented() {
        let cases = cases().unwrap();
        let ids: BTreeSet<&str> = cases.iter().map(|case| case.id.as_str()).collect();
        assert_eq!(ids.len(), cases.len());
        for id in ids {
            let parts: Vec<&str> = id.split('-').collect();
            let number =
                parts.get(2).is_some_and(|number| number.len() == 3 && number.parse::<u16>().is_ok());
            assert!(parts.len() == 3 && parts[0] == "V" && number, "{id}");
        }
    }

    #[test]
    fn a_figure_beyond_its_bound_or_undefined_is_not_accepted() {
        let most = Acceptance::AtMost(1e-9);
        assert!(most.accepts(1e-9) && !most.accepts(1.1e-9) && !most.accepts(f64::NAN));
        let least = Acceptance::AtLeast(0.999);
        assert!(least.accepts(1.0) && !least.accepts(0.99) && !least.accepts(f64::NAN));
        assert_eq!((most.worse([1.0, 2.0]), least.worse([1.0, 2.0])), (2.0, 1.0));
    }

    #[test]
    #[should_panic(expected = "has no case V-NONE-001")]
    fn a_case_that_is_not_listed_is_refused() {
        accept("V-NONE-001", 0.0);
    }
}
