//! A published table of moduli, compared with those that follow from a record.

use crate::error::ProgramError;
use crate::output::table;
use cdpr_robot::{from_json, shown};
use cdpr_study::{InputKind, other_kind, read_text};
use serde::{Deserialize, Serialize};
use serde_json::Number;
use std::path::Path;

/// A table of moduli over ranges of load, as it was published.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct Published {
    /// Where it was published.
    pub(super) source: String,
    /// Breaking force [N].
    pub(super) breaking_force: f64,
    /// Section [m²].
    pub(super) section: f64,
    /// Ranges of load in percent of the breaking force.
    pub(super) ranges: Vec<(f64, f64)>,
    /// Moduli while loading [GPa], with the published digits.
    loading_gpa: Vec<Number>,
    /// Moduli while unloading [GPa].
    unloading_gpa: Vec<Number>,
}

/// An entry of the table beside the modulus that follows from the record.
#[derive(Serialize)]
pub(super) struct Entry {
    from_percent: f64,
    to_percent: f64,
    phase: &'static str,
    published_gpa: f64,
    computed_gpa: f64,
    /// Whether the computed modulus rounds to the published one.
    consistent: bool,
}

/// Error of a modulus that comes from the digits of the record [GPa].
const ROUNDING: f64 = 1e-6;

impl Published {
    pub(super) fn open(path: &Path) -> Result<Self, ProgramError> {
        let text = read_text(path, InputKind::Moduli)?;
        let found: Self =
            from_json(&text).map_err(|error| match other_kind(path, &text, InputKind::Moduli) {
                Some(other) => other.into(),
                None => ProgramError::in_file(path)(error),
            })?;
        let expected = found.ranges.len();
        for (field, moduli) in [("loading_gpa", &found.loading_gpa), ("unloading_gpa", &found.unloading_gpa)]
        {
            let given = moduli.len();
            if given != expected {
                return Err(ProgramError::in_file(path)(ProgramError::Moduli { field, given, expected }));
            }
        }
        Ok(found)
    }

    /// Compares every entry with the moduli [GPa] found for its range, while loading and unloading.
    pub(super) fn beside(&self, found: impl Iterator<Item = [f64; 2]>) -> Vec<Entry> {
        let of_range = |(k, (&(from_percent, to_percent), computed)): (usize, (&(f64, f64), [f64; 2]))| {
            let published = [("loading", &self.loading_gpa[k]), ("unloading", &self.unloading_gpa[k])];
            published.into_iter().zip(computed).map(move |((phase, published), computed_gpa)| {
                let published_gpa = published.as_f64().unwrap_or(f64::NAN);
                let off = (computed_gpa - published_gpa).abs();
                let consistent = off <= half_a_digit(published) + ROUNDING;
                Entry { from_percent, to_percent, phase, published_gpa, computed_gpa, consistent }
            })
        };
        self.ranges.iter().zip(found).enumerate().flat_map(of_range).collect()
    }
}

/// A range of load in words.
pub(super) fn percent(from: f64, to: f64) -> String {
    format!("{from} to {to}")
}

/// Half of the last printed digit: 0.05 for 83.2, 0.5 for 115.
fn half_a_digit(number: &Number) -> f64 {
    let text = number.to_string();
    let decimals = text.split_once('.').map_or(0, |(_, decimals)| decimals.len());
    0.5 * 10f64.powi(-(decimals as i32))
}

pub(super) fn print(published: &Published, entries: &[Entry]) {
    println!("\n{}\n", shown(&published.source));
    let mut rows = table(&["range [%]", "phase", "published [GPa]", "from the record", "consistent"]);
    for entry in entries {
        rows.add_row([
            percent(entry.from_percent, entry.to_percent),
            entry.phase.to_owned(),
            entry.published_gpa.to_string(),
            format!("{:.2}", entry.computed_gpa),
            if entry.consistent { "yes" } else { "no" }.to_owned(),
        ]);
    }
    println!("{rows}\nconsistent: rounds to the published figure");
    for Entry { from_percent, to_percent, phase, published_gpa, computed_gpa, .. } in
        entries.iter().filter(|entry| !entry.consistent)
    {
        println!(
            "E_{from_percent}-{to_percent} while {phase}: {published_gpa} GPa is published, \
             {computed_gpa:.1} GPa follows from the others, {:+.1} %",
            100.0 * (computed_gpa / published_gpa - 1.0)
        );
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_last_digit_is_that_of_the_text() {
        for (text, half) in [("83.2", 0.05), ("115", 0.5), ("84.64", 0.005)] {
            let number: Number = serde_json::from_str(text).unwrap();
            assert!((half_a_digit(&number) - half).abs() < 1e-15, "{text}");
        }
    }
}
