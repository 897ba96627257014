//! The floors of a crate, as docs/ARCHITECTURE.md lists them, and the imports that break their order.

use super::modules::{Imports, Module};
use std::collections::{BTreeMap, BTreeSet};

/// Which modules import from which.
type Graph = BTreeMap<Module, BTreeSet<Module>>;

/// Number of the floor of each entry, from the top of its folder. The file that has the name of a folder
/// stands in it as `FOLDER::`.
pub(crate) struct Floors {
    floors: BTreeMap<Module, usize>,
    /// Two files of one floor that may import from each other. Longer circles break the order.
    pairs: BTreeSet<(Module, Module)>,
}

impl Floors {
    /// Reads floors, one a line or between `|`.
    pub(crate) fn parse(text: &str) -> Self {
        let (mut floors, mut pairs) = (BTreeMap::new(), BTreeSet::new());
        // Folders that are open, with the number of the floor within each; above the first floor stands the
        // folder's own file.
        let mut folder = Module::new();
        let mut numbers = vec![1];
        let mut last = Module::new();
        let text = text.replace('\n', " | ").replace('{', " { ").replace('}', " } ");
        for word in text.split_whitespace() {
            match word {
                "|" => *numbers.last_mut().unwrap() += 1,
                "{" => {
                    folder.clone_from(&last);
                    numbers.push(1);
                }
                "}" => {
                    folder.pop();
                    numbers.pop();
                }
                _ => {
                    let entries: Vec<_> = word.split("<->").map(|name| entry(&folder, name)).collect();
                    if let [one, other] = &entries[..] {
                        pairs.insert((one.clone(), other.clone()));
                        pairs.insert((other.clone(), one.clone()));
                    }
                    last.clone_from(&entries[0]);
                    floors.extend(entries.into_iter().map(|entry| (entry, numbers[numbers.len() - 1])));
                }
            }
        }
        Self { floors, pairs }
    }

    /// Modules that the list lacks, entries that do not exist, and imports that do not lead to a floor below.
    pub(crate) fn breaches(&self, modules: &BTreeSet<Module>, imports: &Imports) -> Vec<String> {
        let listed = |module: &&Module| module.is_empty() || self.floors.contains_key(*module);
        let missing = modules.iter().filter(|module| !listed(module));
        let mut breaches: Vec<_> =
            missing.map(|module| format!("{} stands on no floor", name(module))).collect();
        let exists = |entry: &Module| modules.contains(&file_of(entry));
        let extra = self.floors.keys().filter(|entry| !exists(entry));
        breaches.extend(extra.map(|entry| format!("{} is no module", name(entry))));
        for ((from, to), names) in imports {
            let (one, other) = apart(from, to);
            let floor = |entry: &Module| self.floors.get(entry).copied().unwrap_or(0);
            let is_pair = self.pairs.contains(&(one.clone(), other.clone()));
            if floor(&one) >= floor(&other) && !is_pair {
                breaches.push(format!("not below: {}", arrow(from, to, names)));
            }
        }
        breaches
    }
}

/// The floors that follow from the imports, as the list writes them; entries of a circle share a floor.
pub(crate) fn suggestion(folder: &Module, modules: &BTreeSet<Module>, imports: &Imports) -> String {
    let mut graph = Graph::new();
    let (own, own_name) = (entry(folder, ""), folder.last().map_or("lib", String::as_str));
    let is_inside = |module: &&Module| module.len() > folder.len() && module.starts_with(folder);
    for module in modules.iter().filter(is_inside) {
        graph.entry(module[..=folder.len()].to_vec()).or_default();
    }
    graph.entry(own.clone()).or_default();
    for (from, to) in imports.keys().filter(|(from, to)| from.starts_with(folder) && to.starts_with(folder)) {
        let (one, other) = apart(from, to);
        if one.len() == own.len() && one != other {
            graph.entry(one).or_default().insert(other);
        }
    }
    let mut floors: Vec<Vec<String>> = Vec::new();
    let mut groups = groups(&graph);
    let mut placed = BTreeSet::new();
    while !groups.is_empty() {
        let rests = |group: &BTreeSet<Module>| {
            let below = group.iter().flat_map(|module| &graph[module]);
            below.into_iter().all(|module| placed.contains(module) || group.contains(module))
        };
        let (floor, above): (Vec<_>, Vec<_>) = groups.into_iter().partition(rests);
        groups = above;
        placed.extend(floor.iter().flatten().cloned());
        let word = |module: &Module| match module.last() {
            Some(name) if !name.is_empty() => match suggestion(module, modules, imports).as_str() {
                "" => name.clone(),
                inside => format!("{name} {{{inside}}}"),
            },
            _ => own_name.to_owned(),
        };
        floors
            .push(floor.iter().map(|group| group.iter().map(word).collect::<Vec<_>>().join("<->")).collect());
    }
    // The file of a folder stands above it unless the list names it.
    if !graph.values().any(|below| below.contains(&own)) {
        floors.iter_mut().for_each(|floor| floor.retain(|entry| entry != own_name));
    }
    let lines: Vec<_> =
        floors.iter().rev().map(|floor| floor.join(" ")).filter(|line| !line.is_empty()).collect();
    lines.join(if folder.is_empty() { "\n" } else { " | " })
}

/// Sets of modules that reach each other.
fn groups(graph: &Graph) -> Vec<BTreeSet<Module>> {
    let reached = |start: &Module| {
        let (mut reached, mut open) = (BTreeSet::new(), vec![start]);
        while let Some(module) = open.pop() {
            open.extend(graph[module].iter().filter(|next| reached.insert((*next).clone())));
        }
        reached
    };
    let reach: BTreeMap<_, _> = graph.keys().map(|module| (module, reached(module))).collect();
    let mut groups = BTreeSet::new();
    for (module, below) in &reach {
        let back = below.iter().filter(|other| reach[other].contains(*module)).cloned();
        groups.insert(back.chain([(*module).clone()]).collect());
    }
    groups.into_iter().collect()
}

/// Where two modules part: their entries of the last folder that both stand in.
fn apart(one: &Module, other: &Module) -> (Module, Module) {
    let common = one.iter().zip(other).take_while(|(a, b)| a == b).count();
    let entry_of = |module: &Module| match module.get(..=common) {
        Some(entry) => entry.to_vec(),
        None => entry(module, ""),
    };
    (entry_of(one), entry_of(other))
}

/// An entry of a folder; a folder's own file is the one without a name.
fn entry(folder: &Module, name: &str) -> Module {
    let is_own = folder.last().map_or("lib", String::as_str) == name;
    folder.iter().cloned().chain([if is_own { String::new() } else { name.to_owned() }]).collect()
}

fn file_of(entry: &Module) -> Module {
    entry.iter().filter(|name| !name.is_empty()).cloned().collect()
}

fn arrow(from: &Module, to: &Module, names: &BTreeSet<String>) -> String {
    let names: Vec<_> = names.iter().map(String::as_str).collect();
    format!("{} -> {}: {}", name(from), name(to), names.join(", "))
}

fn name(module: &Module) -> String {
    if module.is_empty() { "lib".to_owned() } else { file_of(module).join("/") }
}
