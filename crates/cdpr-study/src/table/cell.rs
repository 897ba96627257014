//! What the text of a cell is: a number, none, or a word.

use crate::table::unit::Unit;

/// What a cell is.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Reading {
    /// A finite number, with its decimal mark if it has one.
    Number { value: f64, mark: Option<char> },
    /// `1,234`: 1.234, or a thousand and more.
    Unclear,
    /// A number with marks of thousands, such as `1,234.5` or `1'234`.
    Thousands,
    /// Empty, or a sign that there is no finite number.
    Blank,
    /// Anything else.
    Word,
}

/// Signs that a cell has no finite number, in small letters.
const NO_NUMBER: [&str; 16] = [
    "nan",
    "-nan",
    "na",
    "n/a",
    "#n/a",
    "null",
    "none",
    "nil",
    "-",
    "--",
    "?",
    "inf",
    "+inf",
    "-inf",
    "infinity",
    "-infinity",
];

/// What the text of a cell is.
pub(super) fn reading(text: &str) -> Reading {
    let text = text.trim();
    if let Some(value) = number(text) {
        return Reading::Number { value, mark: text.contains('.').then_some('.') };
    }
    if text.is_empty() || text.len() < 10 && NO_NUMBER.contains(&text.to_ascii_lowercase().as_str()) {
        return Reading::Blank;
    }
    if !text.starts_with(|letter: char| letter.is_ascii_digit() || "+-.,\u{2212}".contains(letter)) {
        return Reading::Word;
    }
    match number(&text.replacen(',', ".", 1)).filter(|_| !text.ends_with(',')) {
        Some(_) if is_of_thousands(text, ',') => Reading::Unclear,
        Some(value) => Reading::Number { value, mark: Some(',') },
        None => {
            let is_between =
                |letter: char| matches!(letter, ',' | '.' | '\'' | '\u{2019}') || letter.is_whitespace();
            let bare = number(&text.replace(is_between, "")).filter(|_| !text.ends_with(is_between));
            if bare.is_some() { Reading::Thousands } else { Reading::Word }
        }
    }
}

/// The finite number of a text with a decimal point.
fn number(text: &str) -> Option<f64> {
    let number = text.parse::<f64>().or_else(|_| text.replacen('\u{2212}', "-", 1).parse());
    number.ok().filter(|number| number.is_finite())
}

/// The number and the unit of a cell such as `3.2 mm`, `5 %`, `$0.5` or `2 bar`.
pub(super) fn with_unit(text: &str) -> Option<(&str, &str)> {
    let text = text.trim();
    let is_number = |value: &str| matches!(reading(value), Reading::Number { .. } | Reading::Unclear);
    if let Some(sign) = text.chars().next().filter(|sign| CURRENCIES.contains(sign)) {
        let (sign, value) = text.split_at(sign.len_utf8());
        return is_number(value).then(|| (value.trim(), sign));
    }
    let is_of_number = |c: char| c.is_ascii_digit() || "+-.,\u{2212}".contains(c);
    let (value, behind) = text.split_at(text.find(|c| !is_of_number(c))?);
    let unit = behind.trim();
    let is_sign = unit.chars().all(|c| SIGNS.contains(&c) || CURRENCIES.contains(&c));
    let is_word = behind.starts_with(char::is_whitespace) && OTHER_UNITS.contains(&&*unit.to_lowercase());
    (is_number(value) && (Unit::of(unit).is_some() || is_sign || is_word)).then_some((value, unit))
}

const CURRENCIES: [char; 4] = ['$', '\u{20ac}', '\u{a3}', '\u{a5}'];

/// Signs behind numbers.
const SIGNS: [char; 3] = ['%', '\u{2030}', '\u{b0}'];

/// Units of quantities that robots do not have, in small letters: they make no word of a number.
const OTHER_UNITS: [&str; 30] = [
    "pa", "kpa", "mpa", "gpa", "bar", "psi", "hz", "khz", "rpm", "v", "mv", "a", "ma", "w", "kw", "j", "kj",
    "k", "\u{b0}c", "c", "m/s", "mm/s", "n/m", "n/mm", "kg/m", "in", "ft", "lb", "min", "h",
];

/// Whether a number looks as one with marks of thousands: `1,234`, and not `0,234`, `1234,567` or `1,23`.
fn is_of_thousands(text: &str, mark: char) -> bool {
    let digits = text.trim_start_matches(['+', '-', '\u{2212}']);
    let mut groups = digits.split(mark);
    let first = groups.next().unwrap_or_default();
    let is_number = |group: &str| group.bytes().all(|byte| byte.is_ascii_digit());
    (1..=3).contains(&first.len())
        && !first.starts_with('0')
        && is_number(first)
        && groups.all(|group| group.len() == 3 && is_number(group))
}

/// Which decimal marks cells have beyond doubt.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) struct Marks {
    /// A comma, as in `0,5`.
    pub(super) comma: bool,
    /// A point, as in `0.5`.
    pub(super) point: bool,
}

impl Marks {
    /// With those of another cell.
    pub(super) fn with(self, cell: &str) -> Self {
        match reading(cell) {
            Reading::Number { mark: Some(','), .. } => Self { comma: true, ..self },
            Reading::Number { mark: Some(_), .. } => Self { point: true, ..self },
            _ => self,
        }
    }
}

/// The number `1,234` where commas are known to be decimal.
pub(super) fn with_comma(text: &str) -> f64 {
    number(&text.trim().replacen(',', ".", 1)).unwrap_or(f64::NAN)
}
