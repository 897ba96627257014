//! Text to lines of cells: which separator it has, comments, quotes.

use crate::table::cell::{Reading, reading};
use crate::table::error::TableError;
use csv::{ReaderBuilder, StringRecord};
use std::borrow::Cow;

/// A line with its cells.
pub(super) struct Line {
    /// Its number, from 1.
    pub(super) number: usize,
    pub(super) cells: StringRecord,
}

/// What stands between two cells.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Separator {
    Letter(u8),
    Blanks,
}

/// Number of lines by which the separator is told.
const LOOKED_AT: usize = 20;

/// Splits a text into lines of the same width. Empty lines and comments count as lines, and are no rows.
pub(super) fn split(text: &str) -> Result<Vec<Line>, TableError> {
    let (stated, skipped) = match stated(text) {
        Some(letter) => (Some(Separator::Letter(letter)), text.find('\n').unwrap_or(text.len())),
        None => (None, 0),
    };
    let body = &text[skipped..];
    let separator = stated.unwrap_or_else(|| separator(body));
    let (letter, body) = match separator {
        Separator::Letter(letter) => (letter, Cow::Borrowed(body)),
        Separator::Blanks => (b' ', Cow::Owned(single_blanks(body))),
    };
    let mut reader = ReaderBuilder::new();
    let mut reader = reader
        .delimiter(letter)
        .has_headers(false)
        .flexible(true)
        .comment(Some(b'#'))
        .from_reader(body.as_bytes());
    let mut lines: Vec<Line> = Vec::new();
    let mut cells = StringRecord::new();
    let mut number = 1 + text[..skipped].matches('\n').count();
    let mut start = 0;
    // Neither the text nor its cells can fail: a record is read, or the end is reached.
    while reader.read_record(&mut cells).unwrap_or(false) {
        let end = reader.position().byte() as usize;
        let before = no_rows(&body[start..end]);
        let record = &body[start + before..end];
        number += body[start..start + before].matches('\n').count();
        if record.matches('"').count() % 2 == 1 && cells.iter().any(|cell| cell.contains('\n')) {
            return Err(TableError::Quote { line: number });
        }
        if !cells.iter().all(|cell| cell.trim().is_empty()) {
            lines.push(Line { number, cells: cells.clone() });
        }
        number += record.matches('\n').count();
        start = end;
    }
    level(&mut lines, letter)?;
    Ok(lines)
}

/// Length of the empty lines and comments at the beginning of a text.
fn no_rows(text: &str) -> usize {
    let is_none = |line: &&str| line.trim_end_matches('\n').is_empty() || line.starts_with('#');
    text.split_inclusive('\n').take_while(is_none).map(str::len).sum()
}

/// The separator that a first line `sep=;` states.
fn stated(text: &str) -> Option<u8> {
    let line = text.lines().next()?.trim_end_matches([' ', '\n']).trim_matches('"');
    match line.get(..4)?.eq_ignore_ascii_case("sep=").then(|| &line.as_bytes()[4..])? {
        [letter] if letter.is_ascii() && !matches!(letter, b'"' | b'#') => Some(*letter),
        _ => None,
    }
}

/// The separator by the first lines. Semicolons and tabs go before commas, which may be decimal.
fn separator(text: &str) -> Separator {
    let lines: Vec<&str> = text
        .lines()
        .map(str::trim_end)
        .filter(|line| !line.trim_start().is_empty() && !line.starts_with('#'))
        .take(LOOKED_AT)
        .collect();
    let Some((first, rest)) = lines.split_first() else { return Separator::Letter(b',') };
    let counts = |letter: char| (outside(first, letter), rest.iter().all(|line| outside(line, letter) > 0));
    for letter in [';', '\t'] {
        if matches!(counts(letter), (1.., true)) {
            return Separator::Letter(letter as u8);
        }
    }
    let parts = |line: &str| single_blanks(line).split(' ').count();
    let is_even = parts(first) > 1 && rest.iter().all(|line| parts(line) == parts(first));
    let is_number = |part| matches!(reading(part), Reading::Number { .. } | Reading::Unclear);
    let has_numbers = lines.last().is_some_and(|line| line.split_whitespace().all(is_number));
    if is_even && (outside(first, ',') == 0 || has_numbers) {
        return Separator::Blanks;
    }
    let most = [',', ';', '\t'].into_iter().rev().max_by_key(|letter| outside(first, *letter));
    Separator::Letter(most.unwrap_or(',') as u8)
}

/// How often a letter stands outside of quotes.
fn outside(line: &str, letter: char) -> usize {
    let parts = line.split('"').enumerate().filter(|(k, _)| k % 2 == 0);
    parts.map(|(_, part)| part.matches(letter).count()).sum()
}

/// A blank that does not separate, before a unit in brackets.
pub(super) const KEPT: char = '\u{a0}';

/// The text with one blank for several, outside of quotes, and none at the ends of lines.
fn single_blanks(text: &str) -> String {
    let mut found = String::with_capacity(text.len());
    let (mut is_quoted, mut is_pending) = (false, false);
    for letter in text.chars() {
        match letter {
            ' ' | '\t' if !is_quoted => is_pending = true,
            _ => {
                let is_new = found.is_empty() || found.ends_with('\n');
                if is_pending && !is_new && letter != '\n' {
                    found.push(if matches!(letter, '[' | '(') { KEPT } else { ' ' });
                }
                is_pending = false;
                is_quoted ^= letter == '"';
                found.push(letter);
            }
        }
    }
    found
}

/// Gives each line as many cells as the first one has, as long as only empty cells are too many.
fn level(lines: &mut [Line], letter: u8) -> Result<(), TableError> {
    let Some((first, rest)) = lines.split_first_mut() else { return Ok(()) };
    let width = first.cells.len();
    for line in rest {
        let found = line.cells.len();
        let is_void = line.cells.iter().skip(width).all(|cell| cell.trim().is_empty());
        if found > width && is_void {
            line.cells.truncate(width);
        } else if found != width {
            let commas = letter == b',' && found > width;
            let (line, first) = (line.number, first.number);
            return Err(TableError::Width { line, found, expected: width, first, commas });
        }
    }
    Ok(())
}
