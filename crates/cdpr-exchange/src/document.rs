//! A file of another program as a tree of named nodes that remember their place and whether they were read:
//! what was not read is listed.
//!
//! Nodes lie in one list, and paths are made for messages alone: reading takes time in proportion to the
//! file.

pub(crate) mod unread;
pub(crate) mod xml;
pub(crate) mod yaml;

use crate::error::ExchangeError;
use cdpr_robot::Vector3;
use std::borrow::Cow;
use std::cell::Cell;

/// Depth of nodes within nodes that no robot has: deeper ones would exhaust the stack.
const DEEPEST: usize = 64;

/// Elements, attributes and values of a file at most: hundreds of times those of a robot.
const MOST_NODES: usize = 500_000;

/// A file of another program.
#[derive(Debug)]
pub(crate) struct Document {
    /// Name of the file.
    pub(crate) file: String,
    /// All nodes, each after the one around it; the first one is the file itself.
    nodes: Vec<Entry>,
}

/// A node in the list of its document.
#[derive(Debug)]
struct Entry {
    /// Name, `@name` of an attribute, empty in a list.
    name: String,
    parent: usize,
    place: Place,
    /// Text, of nodes without children.
    text: Option<String>,
    children: Vec<usize>,
    read: Cell<bool>,
}

/// Line and column, both from 1.
pub(crate) type Place = (usize, usize);

/// An element or attribute of XML, a value of YAML or JSON.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Node<'a> {
    document: &'a Document,
    id: usize,
}

impl PartialEq for Node<'_> {
    fn eq(&self, other: &Self) -> bool {
        self.id == other.id && std::ptr::eq(self.document, other.document)
    }
}

impl Document {
    fn new(file: &str) -> Self {
        let root = Entry {
            name: String::new(),
            parent: 0,
            place: (1, 1),
            text: None,
            children: Vec::new(),
            read: Cell::new(true),
        };
        Self { file: file.to_owned(), nodes: vec![root] }
    }

    /// Adds a node within another one and returns its number.
    fn push(
        &mut self,
        parent: usize,
        name: &str,
        place: Place,
        text: Option<String>,
    ) -> Result<usize, ExchangeError> {
        let id = self.nodes.len();
        if id > MOST_NODES {
            return Err(self.too_large("elements, attributes and values", MOST_NODES, place));
        }
        let (name, read) = (name.to_owned(), Cell::new(false));
        self.nodes.push(Entry { name, parent, place, text, children: Vec::new(), read });
        self.nodes[parent].children.push(id);
        Ok(id)
    }

    fn too_large(&self, what: &'static str, most: usize, (line, column): Place) -> ExchangeError {
        ExchangeError::TooLarge { file: self.file.clone(), line, column, what, most }
    }

    fn syntax(&self, (line, column): Place, message: String) -> ExchangeError {
        ExchangeError::Syntax { file: self.file.clone(), line, column, message }
    }

    /// The node around the outermost ones, which are the element of XML and the documents of YAML.
    pub(crate) fn all(&self) -> Node<'_> {
        Node { document: self, id: 0 }
    }

    /// The first of the outermost nodes, or the node around them if there are no others, without reading it.
    pub(crate) fn first(&self) -> Node<'_> {
        self.all().children().next().unwrap_or(self.all())
    }

    /// The same, read.
    pub(crate) fn root(&self) -> Node<'_> {
        let root = self.first();
        root.reach();
        root
    }
}

impl<'a> Node<'a> {
    fn entry(&self) -> &'a Entry {
        &self.document.nodes[self.id]
    }

    /// All nodes within it, without reading them.
    pub(crate) fn children(&self) -> impl Iterator<Item = Node<'a>> + use<'a> {
        let document = self.document;
        self.entry().children.iter().map(move |id| Node { document, id: *id })
    }

    /// Name, `@name` of an attribute, empty in a list.
    pub(crate) fn name(&self) -> &'a str {
        &self.entry().name
    }

    /// Name of its file.
    pub(crate) fn file(&self) -> &'a str {
        &self.document.file
    }

    /// Line, from 1.
    pub(crate) fn line(&self) -> usize {
        self.entry().place.0
    }

    /// Names from the root; those that occur several times are numbered from 1.
    pub(crate) fn path(&self) -> String {
        if self.id == 0 {
            return String::new();
        }
        let parent = Node { id: self.entry().parent, ..*self };
        if parent.id == 0 {
            return self.name().to_owned();
        }
        let (name, around) = (self.name(), parent.path());
        let number = parent.children().take_while(|child| child.id <= self.id);
        let number = number.filter(|child| child.name() == name).count();
        let is_only = parent.children().filter(|child| child.name() == name).count() == 1;
        match name {
            "" => format!("{around}[{number}]"),
            _ if !is_only => format!("{around}/{name}[{number}]"),
            _ if around.is_empty() => name.to_owned(),
            _ => format!("{around}/{name}"),
        }
    }

    /// Marks it and the nodes around it as read.
    pub(crate) fn reach(&self) {
        let mut id = self.id;
        while !self.document.nodes[id].read.replace(true) {
            id = self.document.nodes[id].parent;
        }
    }

    /// Whether it has no children.
    pub(crate) fn is_empty(&self) -> bool {
        self.entry().children.is_empty()
    }

    /// The first child of that name.
    pub(crate) fn get(&self, name: &str) -> Option<Node<'a>> {
        let found = self.children().find(|child| child.name() == name);
        found.inspect(|child| child.entry().read.set(true))
    }

    /// All children of that name.
    pub(crate) fn all<'b>(&self, name: &'b str) -> impl Iterator<Item = Node<'a>> + use<'a, 'b> {
        let of_name = self.children().filter(move |child| child.name() == name);
        of_name.inspect(|child| child.entry().read.set(true))
    }

    /// All elements, without attributes.
    pub(crate) fn elements(&self) -> impl Iterator<Item = Node<'a>> + use<'a> {
        let elements = self.children().filter(|child| !child.name().starts_with('@'));
        elements.inspect(|child| child.entry().read.set(true))
    }

    /// Whether a child of that name exists, without reading it.
    pub(crate) fn has(&self, name: &str) -> bool {
        self.children().any(|child| child.name() == name)
    }

    /// The first child of that name, which must exist.
    pub(crate) fn need(&self, name: &str) -> Result<Node<'a>, ExchangeError> {
        self.get(name).ok_or_else(|| self.value_error(Some(name), "missing", "it to be there"))
    }

    /// Its text without space around it; empty for a node without text.
    pub(crate) fn text(&self) -> &'a str {
        self.entry().text.as_deref().unwrap_or_default().trim()
    }

    /// The text of a child; empty if there is no such child.
    pub(crate) fn text_in(&self, name: &str) -> &'a str {
        self.get(name).map_or("", |node| node.text())
    }

    /// Its only number.
    pub(crate) fn number(&self) -> Result<f64, ExchangeError> {
        finite(self.text()).ok_or_else(|| self.error("a finite number"))
    }

    /// The number in a child, if there is such a child.
    pub(crate) fn number_in(&self, name: &str) -> Result<Option<f64>, ExchangeError> {
        self.get(name).map(|node| node.number()).transpose()
    }

    /// All its numbers: words of a text, entries of lists within lists.
    pub(crate) fn numbers(&self) -> Result<Vec<f64>, ExchangeError> {
        let mut numbers = Vec::new();
        self.collect_numbers(&mut numbers)?;
        Ok(numbers)
    }

    fn collect_numbers(&self, numbers: &mut Vec<f64>) -> Result<(), ExchangeError> {
        if self.is_empty() {
            let words = self.text().split([' ', '\t', '\n', '\r', ',']).filter(|word| !word.is_empty());
            for word in words {
                numbers.push(finite(word).ok_or_else(|| self.error("finite numbers"))?);
            }
        }
        self.elements().try_for_each(|child| child.collect_numbers(numbers))
    }

    /// Exactly N numbers.
    pub(crate) fn components<const N: usize>(&self) -> Result<[f64; N], ExchangeError> {
        let numbers = self.numbers()?;
        let given = numbers.len();
        let expected = || self.value_error(None, &format!("a list of {given}"), &format!("{N} numbers"));
        numbers.try_into().map_err(|_| expected())
    }

    /// A point [m] or direction.
    pub(crate) fn vector(&self) -> Result<Vector3<f64>, ExchangeError> {
        self.components::<3>().map(Vector3::from)
    }

    /// The error that this node has another value than what is expected.
    pub(crate) fn error(&self, expected: &str) -> ExchangeError {
        let value = match (self.text(), self.entry().children.len()) {
            ("", 0) => "empty".to_owned(),
            ("", children) => format!("a node with {children} entries"),
            (text, _) => format!("{:?}", short(text)),
        };
        self.value_error(None, &value, expected)
    }

    /// The error that this node, or one of that name within it, is something else than what is expected.
    pub(crate) fn value_error(&self, within: Option<&str>, value: &str, expected: &str) -> ExchangeError {
        let path = self.path();
        let (line, column) = self.entry().place;
        ExchangeError::Value {
            file: self.document.file.clone(),
            line,
            column,
            element: match within {
                None => path,
                Some(name) if path.is_empty() => name.to_owned(),
                Some(name) => format!("{path}/{name}"),
            },
            value: value.to_owned(),
            expected: expected.to_owned(),
        }
    }

    /// Marks it and all that is in it as read.
    pub(crate) fn leave_out(&self) {
        self.entry().read.set(true);
        self.children().for_each(|child| child.leave_out());
    }
}

/// A finite number.
pub(crate) fn finite(text: &str) -> Option<f64> {
    text.parse().ok().filter(|number: &f64| number.is_finite())
}

/// The beginning of a long text.
pub(crate) fn short(text: &str) -> Cow<'_, str> {
    const LONGEST: usize = 80;
    match text.char_indices().nth(LONGEST) {
        Some((end, _)) => format!("{}…", &text[..end]).into(),
        None => text.into(),
    }
}
