//! Arguments that several commands share, and parsers of those that are more than a number or a path.
//!
//! A parser says what is wrong with the text; clap adds the argument and the value.

pub(crate) mod endings;
mod factors;
mod figure;
mod limit;
pub(crate) mod poses;
mod printing;
mod region;
mod robot;
mod together;
mod uncertainty;
mod weather;
mod with;

pub(crate) use factors::{FACTORS, factors};
pub(crate) use figure::{FigureArgument, figure, write_figures};
pub(crate) use limit::{POSITION, limit, upper};
pub(crate) use printing::{Format, Overwrite, Printing, print_record};
pub(crate) use region::{Region, region};
pub(crate) use robot::{FreeArguments, LoadArguments, Preference, RobotArgument};
pub(crate) use together::check_together;
pub(crate) use uncertainty::UncertaintyArgument;
pub(crate) use weather::{WEATHER, WindArgument, any_weather, note_pulleys, towards};
pub(crate) use with::{NO_DRAG, With, with};

use crate::program::error::ProgramError;
use cdpr_robot::counted;
use cdpr_study::Unit;
use std::borrow::Cow;
use std::path::{Path, PathBuf};

/// How many threads compute.
#[derive(clap::Args)]
pub(crate) struct Threads {
    /// Threads; all cores if left out. The numbers do not depend on it.
    #[arg(long, value_parser = clap::value_parser!(u16).range(1..=MOST_THREADS))]
    pub(crate) threads: Option<u16>,
}

/// Greatest number of threads.
const MOST_THREADS: i64 = 1024;

/// Variable of the environment with the number of threads where `--threads` is left out.
pub(crate) const THREAD_VARIABLE: &str = "RAYON_NUM_THREADS";

/// Checks the number of threads of the environment. Without a number, all cores compute.
pub(crate) fn check_thread_variable(value: Option<&str>) -> Result<(), ProgramError> {
    match value.map(|text| (text, text.trim().parse::<f64>())) {
        Some((text, Ok(threads))) if !(0.0..=MOST_THREADS as f64).contains(&threads) => {
            let expected = format!(
                "{THREAD_VARIABLE} is {text}: expected 1 to {MOST_THREADS} threads, or 0 for all cores"
            );
            Err(ProgramError::Usage(expected))
        }
        _ => Ok(()),
    }
}

impl Threads {
    /// Starts the threads that were asked for; all cores by default.
    pub(crate) fn start(&self) -> Result<(), ProgramError> {
        let Some(threads) = self.threads else { return Ok(()) };
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads.into()).build_global();
        pool.map_err(|source| ProgramError::Threads { threads, source })
    }
}

/// A name for results of a robot in the current folder: that of its file, and what they are of. A robot on
/// the standard input is `robot`.
pub(crate) fn named_after(robot: &Path, of: &str) -> PathBuf {
    let stem = robot.file_stem().filter(|stem| *stem != "-");
    let stem = stem.map_or_else(|| "robot".into(), |stem| stem.to_string_lossy());
    PathBuf::from(format!("{stem}-{of}"))
}

/// A count between two bounds, both of them allowed.
pub(crate) fn count<const LEAST: usize, const MOST: usize>(text: &str) -> Result<usize, String> {
    let count = text.trim().parse().ok().filter(|count| (LEAST..=MOST).contains(count));
    // Zeros beyond nine digits are not counted by eye.
    let most = if MOST < 10_000_000_000 { MOST.to_string() } else { format!("{MOST:e}") };
    count.ok_or_else(|| format!("expected a count, {LEAST} to {most}"))
}

/// A seed of random numbers.
pub(crate) fn seed(text: &str) -> Result<u64, String> {
    text.trim().parse().map_err(|_| "expected a seed, a whole number, 0 to 1.8e19".to_owned())
}

/// A finite number.
pub(crate) fn number(text: &str) -> Result<f64, String> {
    let text = text.trim();
    let finite = |text: &str| text.parse().ok().filter(|number: &f64| number.is_finite());
    let hint = || match finite(&text.replacen(',', ".", 1)) {
        Some(meant) => format!(": expected a decimal point, {meant}"),
        None => {
            let end = text.trim_end_matches(|c: char| c.is_alphabetic() || c == ' ').len();
            let (value, unit) = text.split_at(end);
            match (finite(value), Unit::of(unit)) {
                (Some(meant), Some(Unit { factor: 1.0, .. })) => {
                    format!(": expected {meant}, without a unit")
                }
                (Some(_), _) => ": expected a number alone, in the unit that `--help` states".to_owned(),
                (None, _) => String::new(),
            }
        }
    };
    finite(text).ok_or_else(|| format!("`{text}` is not a finite number{}", hint()))
}

/// The parts of a list: between semicolons, commas or blanks. Behind semicolons and blanks commas are
/// decimal.
pub(crate) fn parts(text: &str) -> Vec<Cow<'_, str>> {
    let is_apart = |part: &str| !part.starts_with(',') && !part.ends_with(',');
    let decimal = |part: &str| match part.matches(',').count() {
        1 => part.replace(',', ".").into(),
        _ => part.to_owned().into(),
    };
    let mut words = text.split_whitespace();
    if text.contains(';') {
        text.split(';').map(decimal).collect()
    } else if text.split_whitespace().count() > 1 && words.all(is_apart) {
        text.split_whitespace().map(decimal).collect()
    } else {
        text.split(',').map(Cow::from).collect()
    }
}

/// Finite numbers separated by commas, semicolons or blanks.
pub(crate) fn numbers(text: &str) -> Result<Vec<f64>, String> {
    parts(text).iter().map(|part| number(part)).collect()
}

/// Unstrained lengths of the cables.
#[derive(Clone)]
pub(crate) enum Lengths {
    /// One for each cable [m].
    Listed(Vec<f64>),
    /// A table of them, over time or one set on each line.
    Table(PathBuf),
}

impl Lengths {
    /// The lengths, where they do not change over time.
    pub(crate) fn listed(&self) -> Result<&[f64], ProgramError> {
        match self {
            Self::Listed(lengths) => Ok(lengths),
            Self::Table(file) => Err(ProgramError::Usage(format!(
                "--lengths {}: expected l1,..,ln [m]; `direct` takes a table of them, `simulate` one over time",
                file.display()
            ))),
        }
    }
}

/// `1.2,1.3`, or the name of a file.
pub(crate) fn lengths(text: &str) -> Result<Lengths, String> {
    match numbers(text) {
        Ok(lengths) => Ok(Lengths::Listed(lengths)),
        Err(_) if text == "-" || Path::new(text).exists() || text.ends_with(".csv") => {
            Ok(Lengths::Table(PathBuf::from(text)))
        }
        Err(reason) => Err(reason),
    }
}

/// N finite numbers separated by commas.
pub(crate) fn components<const N: usize>(text: &str) -> Result<[f64; N], String> {
    numbers(text)?
        .try_into()
        .map_err(|given: Vec<f64>| format!("{}: expected {N}", counted(given.len(), "number")))
}

/// A mass, zero or more [kg].
pub(crate) fn mass(text: &str) -> Result<f64, String> {
    let mass = number(text)?;
    if mass >= 0.0 { Ok(mass) } else { Err("expected a mass, zero or more [kg]".to_owned()) }
}

/// A mass above zero, whose effect is observed [kg].
pub(crate) fn payload(text: &str) -> Result<f64, String> {
    let mass = number(text)?;
    if mass > 0.0 { Ok(mass) } else { Err("expected a mass above zero [kg]".to_owned()) }
}

/// Numbers by their names.
#[derive(Clone, Debug)]
pub(crate) struct Named(pub(crate) Vec<(String, f64)>);

impl Named {
    /// The numbers of these names, where they are given; any other name is refused.
    pub(crate) fn all<const N: usize>(
        &self,
        option: &str,
        names: [&str; N],
    ) -> Result<[Option<f64>; N], ProgramError> {
        if let Some((name, _)) = self.0.iter().find(|(name, _)| !names.contains(&name.as_str())) {
            let expected = names.join(", ");
            return Err(ProgramError::Usage(format!("{option} {name}: expected names out of {expected}")));
        }
        Ok(names.map(|name| self.0.iter().find(|(own, _)| own == name).map(|(_, value)| *value)))
    }
}

/// `name=number`, separated by commas.
pub(crate) fn named(text: &str) -> Result<Named, String> {
    let one = |text: &str| -> Result<(String, f64), String> {
        let (name, value) = text.split_once('=').ok_or_else(|| format!("`{text}`: expected name=number"))?;
        Ok((name.trim().to_owned(), number(value)?))
    };
    let named: Vec<(String, f64)> = parts(text).iter().map(|text| one(text)).collect::<Result<_, _>>()?;
    let again =
        |(i, (name, _)): &(usize, &(String, f64))| named[..*i].iter().any(|(before, _)| before == name);
    match named.iter().enumerate().find(again) {
        Some((_, (name, _))) => Err(format!("`{name}` is given twice: expected each name once")),
        None => Ok(Named(named)),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_list_has_each_name_once() {
        let Named(named) = named("a=0.1, mass=2").unwrap();
        assert_eq!(named, [("a".to_owned(), 0.1), ("mass".to_owned(), 2.0)]);
        assert!(
            super::named("a").is_err() && super::named("a=b").is_err() && super::named("a=1,a=1").is_err()
        );
    }
}
