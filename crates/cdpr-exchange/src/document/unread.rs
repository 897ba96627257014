//! What was not read of a file: most of it concerns no robot at rest, and all else is questioned.

use crate::document::{Document, Node, short};
use crate::error::ExchangeError;
use std::collections::{HashMap, HashSet};

/// Nodes of one kind that were not read.
#[derive(Debug)]
pub(crate) struct Unread {
    /// Line of the first one.
    pub(crate) line: usize,
    /// Whether they may change the robot.
    pub(crate) matters: bool,
    /// Path of the node around them, without numbers; the names, and the values where they occur once.
    pub(crate) text: String,
}

/// Kinds of nodes that are listed at most, and names in a text.
const MOST: usize = 40;

/// Nodes within nodes of one kind that were not read.
struct Group<'a> {
    within: Node<'a>,
    nodes: Vec<Node<'a>>,
    matters: bool,
    count: usize,
}

/// Groups by the kind of the node around, whether they matter, and their names.
type Found<'a> = HashMap<(usize, bool, Vec<&'a str>), usize>;

impl Document {
    /// What was not read, several nodes within one together, in the order of the file: the outermost ones
    /// alone, and once for nodes that differ in their number alone. `is_harmless` gets the path around a
    /// node, without numbers, and its name.
    ///
    /// # Errors
    /// [`ExchangeError::Value`] for a second node of a name of which one was read.
    pub(crate) fn unread(
        &self,
        is_harmless: impl Fn(&str, &str) -> bool,
    ) -> Result<Vec<Unread>, ExchangeError> {
        // Nodes whose paths without numbers are equal have the same kind.
        let mut kinds: HashMap<(usize, &str), usize> = HashMap::new();
        let mut paths = vec![String::new()];
        let mut found: Found = HashMap::new();
        let mut groups: Vec<Group> = Vec::new();
        let mut open = vec![(Node { document: self, id: 0 }, 0)];
        while let Some((node, kind)) = open.pop() {
            let (read, unread): (Vec<Node>, Vec<Node>) =
                node.children().partition(|child| child.entry().read.get());
            if !unread.is_empty() {
                check_once(&read, &unread)?;
                let (harmless, matters): (Vec<Node>, Vec<Node>) =
                    unread.into_iter().partition(|child| is_harmless(&paths[kind], child.name()));
                for (matters, nodes) in [(true, matters), (false, harmless)] {
                    let Some(first) = nodes.first().copied() else { continue };
                    let names = nodes.iter().map(Node::name).collect();
                    let group = *found.entry((kind, matters, names)).or_insert(groups.len());
                    if group == groups.len() {
                        groups.push(Group { within: node, nodes, matters, count: 0 });
                    }
                    groups[group].count += 1;
                    debug_assert!(first.line() >= groups[group].nodes[0].line());
                }
            }
            for child in read.into_iter().rev() {
                let next = paths.len();
                let kind_of_child = *kinds.entry((kind, child.name())).or_insert(next);
                if kind_of_child == next {
                    paths.push(join(&paths[kind], child.name()));
                }
                open.push((child, kind_of_child));
            }
        }
        let more = groups.len().saturating_sub(MOST);
        let mut listed: Vec<Unread> = groups.iter().take(MOST).map(Group::unread).collect();
        if let (1.., Some(last)) = (more, groups.last()) {
            listed.push(Unread {
                line: last.nodes[0].line(),
                matters: groups[MOST..].iter().any(|group| group.matters),
                text: format!("{more} further kinds of entries"),
            });
        }
        Ok(listed)
    }
}

/// Refuses a second node of a name of which the first one was read: nothing says which one is meant.
fn check_once(read: &[Node], unread: &[Node]) -> Result<(), ExchangeError> {
    let names: HashSet<&str> = read.iter().map(Node::name).filter(|name| !name.is_empty()).collect();
    match unread.iter().find(|node| names.contains(node.name())) {
        Some(second) => Err(second.value_error(None, "there twice", "one")),
        None => Ok(()),
    }
}

/// Longest path that is kept: deeper names are left out.
const LONGEST_PATH: usize = 300;

fn join(path: &str, name: &str) -> String {
    match (path, name) {
        (path, "") => path.to_owned(),
        (path, _) if path.len() > LONGEST_PATH => path.to_owned(),
        ("", name) => short(name).into_owned(),
        (path, name) => format!("{path}/{}", short(name)),
    }
}

impl Group<'_> {
    fn unread(&self) -> Unread {
        let within = self.within.plain_path();
        let said = |node: &Node| {
            let name = match node.name() {
                "" if self.within.id == 0 => "a further document".into(),
                "" => "an entry".into(),
                name => short(name),
            };
            match node.text() {
                text if self.count > 1 || text.is_empty() => name.into_owned(),
                text => format!("{name} {}", short(text)),
            }
        };
        let mut entries: Vec<String> = self.nodes.iter().take(MOST).map(said).collect();
        if self.nodes.len() > MOST {
            entries.push(format!("{} more", self.nodes.len() - MOST));
        }
        let entries = entries.join(", ");
        let text = match (within.as_str(), self.count) {
            ("", _) => entries,
            (within, 1) => format!("{within}: {entries}"),
            (within, count) => format!("{within} ({count} times): {entries}"),
        };
        Unread { line: self.nodes[0].line(), matters: self.matters, text }
    }
}

impl Node<'_> {
    /// Its path without numbers.
    pub(crate) fn plain_path(&self) -> String {
        if self.id == 0 {
            return String::new();
        }
        join(&Node { id: self.entry().parent, ..*self }.plain_path(), self.name())
    }
}
