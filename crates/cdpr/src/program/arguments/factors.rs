//! Partial factors of a norm: `--with permanent=1.35,variable=1.5,accidental=1,resistance=1.5`.

use crate::program::arguments::{With, number};
use crate::program::error::ProgramError;
use cdpr_assess::{CaseFactors, PartialFactors};

/// Names of `--with` that are partial factors: all of them are given, or none.
pub(crate) const FACTORS: [&str; 4] = ["permanent", "variable", "resistance", "accidental"];

/// The factors, if any are given.
pub(crate) fn factors(with: &With) -> Result<Option<PartialFactors>, ProgramError> {
    let [permanent, variable] = ["permanent", "variable"].map(|name| with.value(name, None, number));
    let resistance = with.value("resistance", None, |text| one_or_two(text, "1.5 or 1.5:1.2"))?;
    let accidental = with.value("accidental", None, |text| one_or_two(text, "1 or 1:0.5"))?;
    let found = match (permanent?, variable?, resistance, accidental) {
        (None, None, None, None) => return Ok(None),
        (Some(permanent), Some(variable), Some([resistance, of_accident]), Some([weights, others])) => {
            PartialFactors {
                persistent: CaseFactors { permanent, variable, resistance },
                accidental: CaseFactors { permanent: weights, variable: others, resistance: of_accident },
            }
        }
        (permanent, variable, resistance, accidental) => {
            let given = [permanent.is_some(), variable.is_some(), resistance.is_some(), accidental.is_some()];
            let missing = FACTORS.iter().zip(given).filter(|(_, given)| !given);
            let missing: Vec<_> = missing.map(|(name, _)| format!("{name}=FACTOR")).collect();
            let expected = format!(
                "--with: expected {}, too, of the norm that you follow; no factor is assumed",
                missing.join(", ")
            );
            return Err(ProgramError::Usage(expected));
        }
    };
    found.check().map_err(|error| ProgramError::Usage(format!("--with: {error}")))?;
    Ok(Some(found))
}

/// `1.5`, for two numbers, or `1.5:1.2`.
fn one_or_two(text: &str, such_as: &str) -> Result<[f64; 2], String> {
    let (one, other) = text.split_once(':').unwrap_or((text, text));
    let both = number(one).ok().zip(number(other).ok()).map(<[f64; 2]>::from);
    both.ok_or_else(|| format!("expected a number or two, such as {such_as}"))
}
