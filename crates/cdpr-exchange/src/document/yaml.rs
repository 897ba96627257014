//! YAML as a tree, and JSON, which is YAML, with commas that trail.

use crate::document::{DEEPEST, Document, Node};
use crate::error::ExchangeError;
use saphyr_parser::{Event, Marker, Parser, ScanError};

/// Reads YAML or JSON.
///
/// # Errors
/// [`ExchangeError::Syntax`].
pub(crate) fn parse(file: &str, text: &str) -> Result<Document, ExchangeError> {
    let mut reader = Reader { file, events: Parser::new_from_str(text), depth: 0 };
    let mut root = loop {
        let (event, place) = reader.next()?;
        match event {
            Event::StreamStart | Event::DocumentStart(_) | Event::Nothing => {}
            Event::StreamEnd => break Node::new(file, "", place),
            event => break reader.node("", event, place)?,
        }
    };
    root.name_paths();
    Ok(Document { file: file.to_owned(), root })
}

struct Reader<'a> {
    file: &'a str,
    events: Parser<'a, saphyr_parser::StrInput<'a>>,
    depth: usize,
}

impl<'a> Reader<'a> {
    fn next(&mut self) -> Result<(Event<'a>, (usize, usize)), ExchangeError> {
        match self.events.next_event() {
            Some(Ok((event, span))) => Ok((event, place(&span.start))),
            Some(Err(error)) => Err(self.syntax(place(error.marker()), message(&error))),
            None => Err(self.syntax((1, 1), "the text ends too early".to_owned())),
        }
    }

    fn node(&mut self, name: &str, event: Event<'a>, at: (usize, usize)) -> Result<Node, ExchangeError> {
        let mut node = Node::new(self.file, name, at);
        if self.depth > DEEPEST {
            return Err(self.syntax(at, format!("lists nested more than {DEEPEST} deep")));
        }
        self.depth += 1;
        match event {
            Event::Scalar(text, ..) => node = node.with_text(text),
            Event::SequenceStart(..) => loop {
                match self.next()? {
                    (Event::SequenceEnd, _) => break,
                    (event, at) => node.push(self.node("", event, at)?),
                }
            },
            Event::MappingStart(..) => loop {
                let (key, at) = match self.next()? {
                    (Event::MappingEnd, _) => break,
                    (Event::Scalar(key, ..), at) => (key, at),
                    (_, at) => return Err(self.syntax(at, "a key that is no text".to_owned())),
                };
                if node.has(&key) {
                    return Err(self.syntax(at, format!("the key `{key}` stands twice")));
                }
                let (event, at) = self.next()?;
                node.push(self.node(&key, event, at)?);
            },
            Event::Alias(_) => return Err(self.syntax(at, "an alias: expected its value".to_owned())),
            _ => return Err(self.syntax(at, "a value is expected here".to_owned())),
        }
        self.depth -= 1;
        Ok(node)
    }

    fn syntax(&self, (line, column): (usize, usize), message: String) -> ExchangeError {
        ExchangeError::Syntax { file: self.file.to_owned(), line, column, message }
    }
}

/// Line and column, both from 1.
fn place(marker: &Marker) -> (usize, usize) {
    (marker.line(), marker.col() + 1)
}

fn message(error: &ScanError) -> String {
    error.info().to_owned()
}
