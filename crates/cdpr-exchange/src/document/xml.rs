//! XML as a tree.

use crate::document::{DEEPEST, Document, Node};
use crate::error::ExchangeError;
use roxmltree::{ParsingOptions, TextPos};

/// Reads XML.
///
/// # Errors
/// [`ExchangeError::Syntax`].
pub(crate) fn parse(file: &str, text: &str) -> Result<Document, ExchangeError> {
    let options = ParsingOptions { allow_dtd: true, ..ParsingOptions::default() };
    let document = roxmltree::Document::parse_with_options(text, options).map_err(|error| {
        let TextPos { row, col } = error.pos();
        let message = error.to_string();
        let message = message.split(" at ").next().unwrap_or_default().to_owned();
        ExchangeError::Syntax { file: file.to_owned(), line: row as usize, column: col as usize, message }
    })?;
    let mut root = tree(file, &document, document.root_element(), 0)?;
    root.name_paths();
    Ok(Document { file: file.to_owned(), root })
}

fn tree(
    file: &str,
    document: &roxmltree::Document,
    element: roxmltree::Node,
    depth: usize,
) -> Result<Node, ExchangeError> {
    let place = |byte: usize| {
        let TextPos { row, col } = document.text_pos_at(byte);
        (row as usize, col as usize)
    };
    let at = place(element.range().start);
    if depth > DEEPEST {
        let message = format!("elements nested more than {DEEPEST} deep");
        return Err(ExchangeError::Syntax { file: file.to_owned(), line: at.0, column: at.1, message });
    }
    let mut node = Node::new(file, element.tag_name().name(), at);
    for attribute in element.attributes() {
        let name = format!("@{}", attribute.name());
        node.push(Node::new(file, &name, place(attribute.range().start)).with_text(attribute.value()));
    }
    let text: String =
        element.children().filter_map(|child| child.text().filter(|_| child.is_text())).collect();
    node = node.with_text(text);
    for child in element.children().filter(roxmltree::Node::is_element) {
        node.push(tree(file, document, child, depth + 1)?);
    }
    Ok(node)
}
