//! YAML as a tree, and JSON, which is YAML, with commas that trail.

use crate::document::{DEEPEST, Document, Place};
use crate::error::ExchangeError;
use saphyr_parser::{Event, Parser, Span};
use std::collections::HashSet;

/// Reads YAML, each of its documents, or JSON.
///
/// # Errors
/// [`ExchangeError::Syntax`], [`ExchangeError::TooLarge`].
pub(crate) fn parse(file: &str, text: &str) -> Result<Document, ExchangeError> {
    let mut reader = Reader { document: Document::new(file), events: Parser::new_from_str(text), depth: 0 };
    loop {
        let (event, place) = reader.next()?;
        match event {
            Event::StreamStart | Event::DocumentStart(_) | Event::DocumentEnd | Event::Nothing => {}
            Event::StreamEnd => return Ok(reader.document),
            // An empty document, such as one that ends the file.
            Event::Scalar(text, ..) if text.is_empty() || text == "~" => {}
            event => reader.node(0, "", event, place)?,
        }
    }
}

struct Reader<'a> {
    document: Document,
    events: Parser<'a, saphyr_parser::StrInput<'a>>,
    depth: usize,
}

impl<'a> Reader<'a> {
    fn next(&mut self) -> Result<(Event<'a>, Place), ExchangeError> {
        match self.events.next_event() {
            Some(Ok((event, Span { start, .. }))) => Ok((event, (start.line(), start.col() + 1))),
            Some(Err(error)) => {
                let place = (error.marker().line(), error.marker().col() + 1);
                Err(self.document.syntax(place, error.info().to_owned()))
            }
            None => Err(self.document.syntax((1, 1), "the text ends too early".to_owned())),
        }
    }

    fn node(&mut self, parent: usize, name: &str, event: Event<'a>, at: Place) -> Result<(), ExchangeError> {
        if self.depth > DEEPEST {
            return Err(self.document.syntax(at, format!("lists nested more than {DEEPEST} deep")));
        }
        if let Event::Scalar(text, ..) = event {
            return self.document.push(parent, name, at, Some(text.into_owned())).map(drop);
        }
        let id = self.document.push(parent, name, at, None)?;
        self.depth += 1;
        match event {
            Event::SequenceStart(..) => loop {
                match self.next()? {
                    (Event::SequenceEnd, _) => break,
                    (event, at) => self.node(id, "", event, at)?,
                }
            },
            Event::MappingStart(..) => self.mapping(id)?,
            Event::Alias(_) => {
                return Err(self.document.syntax(at, "an alias: expected its value".to_owned()));
            }
            _ => return Err(self.document.syntax(at, "a value is expected here".to_owned())),
        }
        self.depth -= 1;
        Ok(())
    }

    fn mapping(&mut self, id: usize) -> Result<(), ExchangeError> {
        let mut keys = HashSet::new();
        loop {
            let (key, at) = match self.next()? {
                (Event::MappingEnd, _) => return Ok(()),
                (Event::Scalar(key, ..), at) => (key, at),
                (_, at) => return Err(self.document.syntax(at, "a key that is no text".to_owned())),
            };
            if !keys.insert(key.clone()) {
                return Err(self.document.syntax(at, format!("the key `{key}` stands twice")));
            }
            let (event, at) = self.next()?;
            self.node(id, &key, event, at)?;
        }
    }
}
