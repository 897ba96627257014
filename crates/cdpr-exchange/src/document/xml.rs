//! XML as a tree.
//!
//! The parser compares every attribute with all others of its element and every element with the namespaces
//! around it, and it expands entities: depth, attributes and declarations are bounded before it begins.

use crate::document::{DEEPEST, Document, MOST_NODES, Place};
use crate::error::ExchangeError;
use roxmltree::{ParsingOptions, TextPos};

/// Attributes of one element at most.
const MOST_ATTRIBUTES: usize = 200;

/// Namespaces of a file at most.
const MOST_NAMESPACES: usize = 50;

/// Reads XML.
///
/// # Errors
/// [`ExchangeError::Syntax`], [`ExchangeError::TooLarge`].
pub(crate) fn parse(file: &str, text: &str) -> Result<Document, ExchangeError> {
    let mut document = Document::new(file);
    check_bounds(&document, text)?;
    let options = ParsingOptions { allow_dtd: true, ..ParsingOptions::default() };
    let parsed = roxmltree::Document::parse_with_options(text, options).map_err(|error| {
        let TextPos { row, col } = error.pos();
        let message = error.to_string();
        let message = message.split(" at ").next().unwrap_or_default().to_owned();
        document.syntax((row as usize, col as usize), message)
    })?;
    let mut cursor = Cursor { text, byte: 0, place: (1, 1) };
    add(&mut document, 0, parsed.root_element(), &mut cursor)?;
    Ok(document)
}

fn add(
    document: &mut Document,
    parent: usize,
    element: roxmltree::Node,
    cursor: &mut Cursor,
) -> Result<(), ExchangeError> {
    let place = cursor.place_of(element.range().start);
    let text: String =
        element.children().filter_map(|child| child.text().filter(|_| child.is_text())).collect();
    let id = document.push(parent, element.tag_name().name(), place, Some(text))?;
    for attribute in element.attributes() {
        let (name, place) = (format!("@{}", attribute.name()), cursor.place_of(attribute.range().start));
        document.push(id, &name, place, Some(attribute.value().to_owned()))?;
    }
    let mut children = element.children().filter(roxmltree::Node::is_element);
    children.try_for_each(|child| add(document, id, child, cursor))
}

/// Lines and columns of bytes that are asked for in the order of the text.
struct Cursor<'a> {
    text: &'a str,
    byte: usize,
    place: Place,
}

impl Cursor<'_> {
    fn place_of(&mut self, byte: usize) -> Place {
        for c in self.text[self.byte..byte].chars() {
            let (line, column) = self.place;
            self.place = if c == '\n' { (line + 1, 1) } else { (line, column + 1) };
        }
        self.byte = byte;
        self.place
    }
}

/// Refuses what the parser would need too much time, memory or stack for. What is not well-formed is left to
/// the parser.
fn check_bounds(document: &Document, text: &str) -> Result<(), ExchangeError> {
    let place = |byte: usize| Cursor { text, byte: 0, place: (1, 1) }.place_of(byte);
    if let Some((byte, _)) = text.match_indices("xmlns").nth(MOST_NAMESPACES) {
        return Err(document.too_large("namespaces", MOST_NAMESPACES, place(byte)));
    }
    let (mut at, mut depth, mut nodes) = (0, 0, 0);
    while let Some(found) = text[at..].find('<') {
        let start = at + found;
        let after = |end: &str| text[start..].find(end).map(|found| start + found + end.len());
        let rest = &text[start..];
        let end = if rest.starts_with("<!--") {
            text[start + 4..].find("-->").map(|found| start + 4 + found + 3)
        } else if rest.starts_with("<![CDATA[") {
            after("]]>")
        } else if rest.starts_with("<?") {
            after("?>")
        } else {
            let tag = Tag::of(rest);
            if let (true, Some(declarations)) = (rest.starts_with("<!"), tag.declarations) {
                if text.contains("<!ENTITY") {
                    let message = "a document type with entities of its own: expected none";
                    return Err(document.syntax(place(start), message.to_owned()));
                }
                at = start + declarations;
                continue;
            }
            if rest.starts_with("</") {
                depth -= usize::from(depth > 0);
            } else if !rest.starts_with("<!") {
                nodes += 1 + tag.attributes;
                if tag.attributes > MOST_ATTRIBUTES {
                    let what = "attributes of an element";
                    return Err(document.too_large(what, MOST_ATTRIBUTES, place(start)));
                }
                if nodes > MOST_NODES {
                    return Err(document.too_large("elements and attributes", MOST_NODES, place(start)));
                }
                if depth >= DEEPEST {
                    let message = format!("elements nested more than {DEEPEST} deep");
                    return Err(document.syntax(place(start), message));
                }
                depth += usize::from(!tag.is_empty);
            }
            tag.length.map(|length| start + length)
        };
        let Some(end) = end else { break };
        at = end;
    }
    Ok(())
}

/// A tag, or the declaration of the document's type.
struct Tag {
    /// Bytes from `<` to `>`; `None` where it does not end.
    length: Option<usize>,
    attributes: usize,
    /// Whether it ends with `/>`.
    is_empty: bool,
    /// Bytes from `<` to a `[` in it, after which declarations begin.
    declarations: Option<usize>,
}

impl Tag {
    fn of(text: &str) -> Self {
        let mut tag = Self { length: None, attributes: 0, is_empty: false, declarations: None };
        let mut quote = None;
        let mut before = b' ';
        for (i, byte) in text.bytes().enumerate() {
            match (quote, byte) {
                (Some(open), _) if byte == open => quote = None,
                (Some(_), _) => {}
                (None, b'"' | b'\'') => quote = Some(byte),
                (None, b'=') => tag.attributes += 1,
                (None, b'[') => {
                    tag.declarations = Some(i + 1);
                    return tag;
                }
                (None, b'>') => {
                    tag.is_empty = before == b'/';
                    tag.length = Some(i + 1);
                    return tag;
                }
                (None, _) => {}
            }
            before = byte;
        }
        tag
    }
}
