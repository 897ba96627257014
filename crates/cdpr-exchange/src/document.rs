//! A file of another program as a tree of named nodes that remember their place and whether they were read:
//! what was not read is listed.

pub(crate) mod xml;
pub(crate) mod yaml;

use crate::error::ExchangeError;
use cdpr_robot::Vector3;
use std::cell::Cell;
use std::collections::HashMap;
use std::fmt;

/// Depth of elements within elements that no robot has: deeper ones would exhaust the stack.
const DEEPEST: usize = 64;

/// A file of another program.
#[derive(Debug)]
pub(crate) struct Document {
    /// Name of the file.
    pub(crate) file: String,
    /// The outermost node.
    pub(crate) root: Node,
}

/// An element or attribute of XML, a value of YAML or JSON.
#[derive(Debug)]
pub(crate) struct Node {
    /// Name of the file.
    file: String,
    /// Name, `@name` of an attribute, empty in a list.
    pub(crate) name: String,
    /// Names from the root.
    pub(crate) path: String,
    /// Line, from 1.
    pub(crate) line: usize,
    /// Column in that line, from 1.
    column: usize,
    /// Text, of nodes without children.
    text: Option<String>,
    children: Vec<Node>,
    read: Cell<bool>,
}

/// Nodes within one node that were not read.
#[derive(Debug)]
pub(crate) struct Unread {
    /// Path of the node around them, without numbers.
    within: String,
    /// Line of the first one.
    pub(crate) line: usize,
    /// How many nodes around have such.
    count: usize,
    names: Vec<String>,
    /// Names and values.
    entries: Vec<String>,
}

impl fmt::Display for Unread {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self.count {
            1 => write!(f, "{}: {}", self.within, self.entries.join(", ")),
            count => write!(f, "{} ({count} times): {}", self.within, self.names.join(", ")),
        }
    }
}

/// A path without the numbers of entries.
fn without_numbers(path: &str) -> String {
    let mut inside = false;
    path.chars()
        .filter(|c| {
            inside = *c == '[' || (inside && *c != ']');
            !inside && *c != ']'
        })
        .collect()
}

impl Document {
    /// What was not read, a node or several within one, in the order of the file: the outermost ones alone,
    /// and once for nodes that differ in their number alone.
    pub(crate) fn unread(&self) -> Vec<Unread> {
        let mut groups: Vec<Unread> = Vec::new();
        self.root.collect_unread(&mut groups);
        groups
    }
}

impl Node {
    pub(crate) fn new(file: &str, name: &str, (line, column): (usize, usize)) -> Self {
        Self {
            file: file.to_owned(),
            name: name.to_owned(),
            path: name.to_owned(),
            line,
            column,
            text: None,
            children: Vec::new(),
            read: Cell::new(false),
        }
    }

    pub(crate) fn with_text(mut self, text: impl Into<String>) -> Self {
        self.text = Some(text.into());
        self
    }

    pub(crate) fn push(&mut self, child: Node) {
        self.children.push(child);
    }

    /// Gives all nodes within this one their paths; those of the same name are numbered from 1.
    pub(crate) fn name_paths(&mut self) {
        let mut of_name: HashMap<String, usize> = HashMap::new();
        self.children.iter().for_each(|child| *of_name.entry(child.name.clone()).or_default() += 1);
        let mut before: HashMap<String, usize> = HashMap::new();
        for child in &mut self.children {
            let number = before.entry(child.name.clone()).or_default();
            *number += 1;
            child.path = match child.name.as_str() {
                "" => format!("{}[{number}]", self.path),
                name if self.path.is_empty() && of_name[name] == 1 => name.to_owned(),
                name if of_name[name] > 1 => format!("{}/{name}[{number}]", self.path),
                name => format!("{}/{name}", self.path),
            };
            child.name_paths();
        }
    }

    /// The first child of that name.
    pub(crate) fn get(&self, name: &str) -> Option<&Node> {
        let found = self.children.iter().find(|child| child.name == name);
        found.inspect(|child| child.read.set(true))
    }

    /// All children of that name.
    pub(crate) fn all<'a>(&'a self, name: &'a str) -> impl Iterator<Item = &'a Node> {
        self.children.iter().filter(move |child| child.name == name).inspect(|child| child.read.set(true))
    }

    /// All elements, without attributes.
    pub(crate) fn elements(&self) -> impl Iterator<Item = &Node> {
        self.children
            .iter()
            .filter(|child| !child.name.starts_with('@'))
            .inspect(|child| child.read.set(true))
    }

    /// Whether a child of that name exists, without reading it.
    pub(crate) fn has(&self, name: &str) -> bool {
        self.children.iter().any(|child| child.name == name)
    }

    /// The first child of that name, which must exist.
    pub(crate) fn need(&self, name: &str) -> Result<&Node, ExchangeError> {
        self.get(name).ok_or_else(|| {
            let element = format!("{}/{name}", self.path);
            self.error_at(element, "missing".to_owned(), "it to be there".to_owned())
        })
    }

    /// Its text without space around it; empty for a node without text.
    pub(crate) fn text(&self) -> &str {
        self.text.as_deref().unwrap_or_default().trim()
    }

    /// Its only number.
    pub(crate) fn number(&self) -> Result<f64, ExchangeError> {
        let number = self.text().parse().ok().filter(|number: &f64| number.is_finite());
        number.ok_or_else(|| self.error("a finite number"))
    }

    /// The number in a child, if there is such a child.
    pub(crate) fn number_in(&self, name: &str) -> Result<Option<f64>, ExchangeError> {
        self.get(name).map(Node::number).transpose()
    }

    /// All its numbers: words of a text, entries of lists within lists.
    pub(crate) fn numbers(&self) -> Result<Vec<f64>, ExchangeError> {
        if self.children.is_empty() {
            let words = self.text().split([' ', '\t', '\n', '\r', ',']).filter(|word| !word.is_empty());
            let number = |word: &str| word.parse().ok().filter(|number: &f64| number.is_finite());
            let numbers: Option<Vec<f64>> = words.map(number).collect();
            return numbers.ok_or_else(|| self.error("finite numbers"));
        }
        let inner: Result<Vec<_>, _> = self.elements().map(Node::numbers).collect();
        Ok(inner?.concat())
    }

    /// Exactly N numbers.
    pub(crate) fn components<const N: usize>(&self) -> Result<[f64; N], ExchangeError> {
        let numbers = self.numbers()?;
        let given = numbers.len();
        numbers.try_into().map_err(|_| {
            let value = format!("a list of {given}");
            self.error_at(self.path.clone(), value, format!("{N} numbers"))
        })
    }

    /// A point [m] or direction.
    pub(crate) fn vector(&self) -> Result<Vector3<f64>, ExchangeError> {
        self.components::<3>().map(Vector3::from)
    }

    /// The error that this node has another value than what is expected.
    pub(crate) fn error(&self, expected: &str) -> ExchangeError {
        let value = match (self.text(), self.children.len()) {
            ("", 0) => "empty".to_owned(),
            ("", children) => format!("a node with {children} entries"),
            (text, _) => format!("{text:?}"),
        };
        self.error_at(self.path.clone(), value, expected.to_owned())
    }

    /// The error of an element in or below this node.
    pub(crate) fn error_at(&self, element: String, value: String, expected: String) -> ExchangeError {
        let Self { file, line, column, .. } = self;
        ExchangeError::Value { file: file.clone(), line: *line, column: *column, element, value, expected }
    }

    /// Marks it and all that is in it as read.
    pub(crate) fn leave_out(&self) {
        self.read.set(true);
        self.children.iter().for_each(Node::leave_out);
    }

    /// Collects what was not read of the children of this node, which was read.
    fn collect_unread(&self, groups: &mut Vec<Unread>) {
        let unread: Vec<&Node> = self.children.iter().filter(|child| !child.read.get()).collect();
        if let Some(first) = unread.first() {
            let said = |node: &&Node| match node.text() {
                "" => node.name.clone(),
                text => format!("{} {text}", node.name),
            };
            let within = without_numbers(&self.path);
            let names: Vec<String> = unread.iter().map(|node| node.name.clone()).collect();
            match groups.iter_mut().find(|group| group.within == within && group.names == names) {
                Some(group) => group.count += 1,
                None => groups.push(Unread {
                    within,
                    line: first.line,
                    count: 1,
                    entries: unread.iter().map(said).collect(),
                    names,
                }),
            }
        }
        let read = self.children.iter().filter(|child| child.read.get());
        read.for_each(|child| child.collect_unread(groups));
    }
}
