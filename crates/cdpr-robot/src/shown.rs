//! Texts from files for people: every character is shown, none is obeyed; and lines of an answer, of at most
//! 80 columns.

use std::borrow::Cow;

/// Whether a terminal or a browser obeys a character instead of showing it: control characters, with which
/// escape sequences begin; those that change the direction of writing; invisible ones, which XML may forbid.
fn is_obeyed(c: char) -> bool {
    c.is_control()
        || matches!(c,
            '\u{61c}' | '\u{200b}' | '\u{200e}' | '\u{200f}' | '\u{2028}'..='\u{202e}' | '\u{2060}'..='\u{206f}'
            | '\u{feff}' | '\u{fff9}'..='\u{fffb}' | '\u{fffe}' | '\u{ffff}' | '\u{e0000}'..='\u{e007f}')
}

/// A text on one line: characters that a terminal or a browser would obey are written as JSON escapes them,
/// such as `\u001b`.
///
/// ```
/// assert_eq!(cdpr_robot::shown("\u{1b}[2J a\u{202e}b\n"), "\\u001b[2J a\\u202eb\\u000a");
/// ```
pub fn shown(text: &str) -> Cow<'_, str> {
    escaped(text, is_obeyed)
}

/// The same for a text of several lines or a JSON text, which keeps its meaning: ends of lines and tabs stay.
pub fn shown_lines(text: &str) -> Cow<'_, str> {
    escaped(text, |c| is_obeyed(c) && c != '\n' && c != '\t')
}

fn escaped(text: &str, is_obeyed: impl Fn(char) -> bool) -> Cow<'_, str> {
    if !text.contains(&is_obeyed) {
        return Cow::Borrowed(text);
    }
    let mut shown = String::with_capacity(text.len());
    for c in text.chars() {
        if is_obeyed(c) {
            c.encode_utf16(&mut [0; 2]).iter().for_each(|unit| shown += &format!("\\u{unit:04x}"));
        } else {
            shown.push(c);
        }
    }
    Cow::Owned(shown)
}

/// Columns of a line.
pub const COLUMNS: usize = 80;

/// A line of at most [`COLUMNS`] columns with as many of the items as fit, and the number of the others. The
/// first item is always named.
pub fn listing<T: AsRef<str>>(before: &str, items: &[T], after: &str) -> String {
    let line = |shown: usize| {
        let names: Vec<&str> = items[..shown].iter().map(AsRef::as_ref).collect();
        let more = match items.len() - shown {
            0 => String::new(),
            more => format!(" and {more} more"),
        };
        format!("{before}{}{more}{after}", names.join(", "))
    };
    let fits = |shown: &usize| line(*shown).chars().count() <= COLUMNS;
    line((1..=items.len()).rev().find(fits).unwrap_or(items.len().min(1)))
}

/// The lines of a sentence, broken at blanks so that each has at most [`COLUMNS`] columns. A longer word has
/// a line of its own.
pub fn broken(sentence: &str) -> Vec<String> {
    filled(sentence.split_whitespace(), "", "")
}

/// A message whose lines have at most [`COLUMNS`] columns where its words allow it. What follows of a longer
/// line is indented by two more blanks. A text in backquotes, such as a command, stays on one line where it
/// fits.
pub fn wrapped(message: &str) -> String {
    let lines = message.split('\n').flat_map(|line| {
        if line.chars().count() <= COLUMNS {
            return vec![line.to_owned()];
        }
        let indent = &line[..line.len() - line.trim_start().len()];
        let room = COLUMNS.saturating_sub(indent.len() + 2);
        let words = quoted_whole(line).into_iter().flat_map(|text| {
            let fits = text.chars().count() <= room;
            if fits { vec![text] } else { text.split_whitespace().collect() }
        });
        filled(words, indent, &format!("{indent}  "))
    });
    lines.collect::<Vec<_>>().join("\n")
}

/// The words of a line; those within backquotes are one word.
fn quoted_whole(line: &str) -> Vec<&str> {
    let mut is_quoted = false;
    let blank = |c: char| {
        is_quoted ^= c == '`';
        c == ' ' && !is_quoted
    };
    line.split(blank).filter(|word| !word.is_empty()).collect()
}

/// Lines of words with the indent of the first one and that of those below.
fn filled<'a>(words: impl Iterator<Item = &'a str>, first: &str, below: &str) -> Vec<String> {
    let mut lines: Vec<String> = Vec::new();
    for word in words {
        match lines.last_mut() {
            Some(line) if line.chars().count() + 1 + word.chars().count() <= COLUMNS => {
                line.push(' ');
                line.push_str(word);
            }
            Some(_) => lines.push(format!("{below}{word}")),
            None => lines.push(format!("{first}{word}")),
        }
    }
    lines
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_a_terminal_obeys_is_shown_and_all_else_stays() {
        for text in ["CAROCA", "Élan ρ 中文 – 'a' \"b\" <c> &", "\u{1f916}\u{200d}"] {
            assert_eq!(shown(text), text);
        }
        for (text, expected) in [
            ("a\u{1b}]0;title\u{7}b", "a\\u001b]0;title\\u0007b"),
            ("\u{9b}31m\u{7f}\0", "\\u009b31m\\u007f\\u0000"),
            ("\u{202e}txt.\u{2066}\u{feff}", "\\u202etxt.\\u2066\\ufeff"),
            ("\u{e0041}", "\\udb40\\udc41"),
        ] {
            assert_eq!(shown(text), expected);
            assert_eq!(shown_lines(text), expected);
        }
        assert_eq!((shown("a\nb").as_ref(), shown_lines("a\n\tb").as_ref()), ("a\\u000ab", "a\n\tb"));
    }

    #[test]
    fn messages_are_wrapped_and_commands_stay_whole() {
        let long = "word ".repeat(20);
        let message =
            format!("error: {long}then `cdpr study run --resume`\n    meant? {long}end\nshort  as it is");
        let found = wrapped(&message);
        let lines: Vec<&str> = found.lines().collect();
        assert_eq!(lines.len(), 5, "{found}");
        assert!(lines.iter().all(|line| line.chars().count() <= COLUMNS), "{found}");
        assert!(lines[1].starts_with("  word") && lines[1].ends_with("`cdpr study run --resume`"), "{found}");
        assert!(lines[2].starts_with("    meant?") && lines[3].starts_with("      word"), "{found}");
        assert_eq!(lines[4], "short  as it is");
        let path = "/a".repeat(50);
        assert_eq!(wrapped(&format!("error: {path}: no")), format!("error:\n  {path}:\n  no"));
    }

    #[test]
    fn json_keeps_its_meaning() {
        let name = "\u{1b}\u{9b}\u{202e}\u{e0041}";
        let json = serde_json::to_string(name).unwrap();
        assert_ne!(shown_lines(&json), json);
        assert_eq!(serde_json::from_str::<String>(&shown_lines(&json)).unwrap(), name);
    }

    #[test]
    fn a_listing_names_what_fits_and_counts_the_rest() {
        let names: Vec<String> = (1..=40).map(|i| format!("b{i}.x")).collect();
        let line = listing("Below 1 %: ", &names, ".");
        assert!(line.len() <= COLUMNS && line.starts_with("Below 1 %: b1.x, ") && line.ends_with(" more."));
        assert_eq!(listing("a ", &names[..2], "."), "a b1.x, b2.x.");
        assert_eq!(listing("a ", &["b".repeat(90)], "."), format!("a {}.", "b".repeat(90)));
        assert_eq!(listing::<&str>("none", &[], "."), "none.");
    }

    #[test]
    fn a_long_sentence_has_several_lines() {
        let lines = broken(&"word ".repeat(40));
        assert_eq!(lines.len(), 3);
        assert!(lines.iter().all(|line| line.len() <= COLUMNS));
        assert_eq!(lines.join(" "), "word ".repeat(40).trim_end());
    }
}
