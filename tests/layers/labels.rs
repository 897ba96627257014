//! Labels of equations in comments: `(C16)`, or `(Sa1)` with two letters.

/// The labels that a source defines: at the ends of lines in blocks of `text` in its documentation.
pub(crate) fn defined(source: &str) -> Vec<&str> {
    let mut is_text = false;
    source
        .lines()
        .filter_map(|line| {
            let line = documentation(line);
            if line.is_none_or(|line| line.starts_with("```")) {
                is_text = !is_text && line == Some("```text");
            }
            let (_, label) = line?.strip_suffix(')')?.rsplit_once(" (")?;
            (is_text && is_label(label)).then_some(label)
        })
        .collect()
}

/// The labels in the comments of a source, definitions included.
pub(crate) fn cited(source: &str) -> impl Iterator<Item = &str> {
    source.lines().filter_map(|line| line.find("//").map(|at| &line[at..])).flat_map(labels)
}

/// The text of a line of documentation.
fn documentation(line: &str) -> Option<&str> {
    let line = line.trim();
    line.strip_prefix("//!").or_else(|| line.strip_prefix("///")).map(str::trim)
}

/// The labels in a comment. What follows a name is its argument, as in `ε(T0)`.
fn labels(comment: &str) -> impl Iterator<Item = &str> {
    comment.match_indices('(').filter_map(move |(at, _)| {
        let is_argument = comment[..at].ends_with(|sign: char| sign.is_alphanumeric() || sign == '\'');
        let (label, _) = comment[at + 1..].split_once(')')?;
        (!is_argument && is_label(label)).then_some(label)
    })
}

/// Whether a word is a capital letter, perhaps a small one, and a number.
fn is_label(word: &str) -> bool {
    let letters = word.bytes().take_while(u8::is_ascii_alphabetic).count();
    let (prefix, number) = word.split_at(letters);
    let is_prefix = match prefix.as_bytes() {
        [capital] => capital.is_ascii_uppercase(),
        [capital, small] => capital.is_ascii_uppercase() && small.is_ascii_lowercase(),
        _ => false,
    };
    is_prefix && !number.is_empty() && number.bytes().all(|sign| sign.is_ascii_digit())
}
