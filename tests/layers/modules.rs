//! The modules of a crate and the imports between them.
//!
//! An import points to the file that defines the item, through any number of re-exports. Tests are left out,
//! and so are re-exports of what the file itself does not use.

use proc_macro2::{Delimiter, TokenStream, TokenTree};
use std::collections::{BTreeMap, BTreeSet};
use std::path::{Path, PathBuf};

/// Path of a module below the root of its crate, which has an empty one.
pub(crate) type Module = Vec<String>;

/// The names that a module imports from another one, by module.
pub(crate) type Imports = BTreeMap<(Module, Module), BTreeSet<String>>;

/// The names in a file.
#[derive(Default)]
struct Source {
    items: BTreeSet<String>,
    children: BTreeSet<String>,
    uses: Vec<Use>,
    /// Paths of the code outside `use`, from two segments on, and single names.
    paths: BTreeSet<Vec<String>>,
}

/// One name of a `use`, `*` for all.
struct Use {
    path: Vec<String>,
    alias: String,
    is_public: bool,
}

pub(crate) struct Crate {
    sources: BTreeMap<Module, Source>,
}

impl Crate {
    /// Reads all files under `src` but those of tests.
    pub(crate) fn read(src: &Path) -> Self {
        let mut sources = BTreeMap::new();
        for file in rust_files(src) {
            let text = std::fs::read_to_string(&file).unwrap();
            let tokens = text.parse().unwrap_or_else(|error| panic!("{}: {error}", file.display()));
            let mut source = Source::default();
            if source.scan(tokens, true) {
                sources.insert(module(file.strip_prefix(src).unwrap()), source);
            }
        }
        // A file is a module if its parent declares it outside tests.
        let declared = |module: &Module| {
            module.split_last().is_none_or(|(name, parent)| {
                sources.get(parent).is_some_and(|s: &Source| s.children.contains(name))
            })
        };
        let modules: Vec<_> = sources.keys().filter(|module| declared(module)).cloned().collect();
        sources.retain(|module, _| modules.contains(module));
        Self { sources }
    }

    pub(crate) fn modules(&self) -> BTreeSet<Module> {
        self.sources.keys().cloned().collect()
    }

    pub(crate) fn imports(&self) -> Imports {
        let mut imports = Imports::new();
        for (module, source) in &self.sources {
            let used = source.uses.iter().filter(|import| !import.is_public || source.names(&import.alias));
            for path in
                used.map(|import| &import.path).chain(source.paths.iter().filter(|path| path.len() > 1))
            {
                if let Some(target) = self.definition(module, path, 0).filter(|target| target != module) {
                    let name = path.last().cloned().unwrap_or_default();
                    imports.entry((module.clone(), target)).or_default().insert(name);
                }
            }
        }
        imports
    }

    /// The module that defines what a path of `module` leads to, if it is of this crate.
    fn definition(&self, module: &Module, path: &[String], depth: usize) -> Option<Module> {
        let (first, rest) = path.split_first()?;
        let (mut at, rest) = match first.as_str() {
            "crate" => (Module::new(), rest),
            "self" => (module.clone(), rest),
            "super" => {
                let ups = path.iter().take_while(|segment| *segment == "super").count();
                (module[..module.len().checked_sub(ups)?].to_vec(), &path[ups..])
            }
            // A name that the file imports, or a child of the module.
            name => {
                let source = &self.sources[module];
                let import = source.uses.iter().find(|import| import.alias == name && import.path[0] != name);
                match import {
                    Some(import) if name.starts_with(char::is_uppercase) => {
                        return self.definition(module, &import.path, depth + 1);
                    }
                    Some(import) if !rest.is_empty() => {
                        (self.module_of(module, &import.path, depth + 1)?, rest)
                    }
                    _ if source.children.contains(name) => (module.clone(), path),
                    _ => return None,
                }
            }
        };
        for (i, name) in rest.iter().enumerate() {
            let source = self.sources.get(&at)?;
            let is_last = i + 1 == rest.len();
            if source.items.contains(name) && (is_last || !source.children.contains(name)) {
                return Some(at);
            }
            let found = |import: &&Use| import.alias == *name || import.alias == "*";
            // The path may lead through a re-export; `depth` ends a search in a circle of globs.
            if depth < 8 && (is_last || !source.children.contains(name)) {
                for import in source.uses.iter().filter(found) {
                    let mut through = import.path.clone();
                    if import.alias == "*" {
                        through.push(name.clone());
                    } else if through == [name.clone()] {
                        continue;
                    }
                    let target = self.definition(&at, &through, depth + 1);
                    let is_defined = |target: &Module| {
                        import.alias != "*"
                            || self.sources.get(target).is_some_and(|s| s.items.contains(name))
                    };
                    if let Some(target) = target.filter(is_defined) {
                        return Some(target);
                    }
                }
            }
            if !source.children.contains(name) {
                return Some(at);
            }
            at.push(name.clone());
        }
        // The import of a whole module counts where a path begins with its name.
        None
    }

    /// The module that a path leads to.
    fn module_of(&self, module: &Module, path: &[String], depth: usize) -> Option<Module> {
        let mut longer = path.to_vec();
        longer.push(String::new());
        let target = self.definition(module, &longer, depth)?;
        self.sources.contains_key(&target).then_some(target)
    }
}

impl Source {
    /// Reads the tokens of a file or of a group within it; returns `false` if the file is a test.
    fn scan(&mut self, tokens: TokenStream, is_top: bool) -> bool {
        let tokens: Vec<_> = tokens.into_iter().collect();
        let (mut i, mut is_public) = (0, false);
        while i < tokens.len() {
            match &tokens[i] {
                TokenTree::Punct(punct) if punct.as_char() == '#' => {
                    let is_inner = is_punct(tokens.get(i + 1), '!');
                    i += 1 + usize::from(is_inner);
                    let attribute =
                        tokens.get(i).map(ToString::to_string).unwrap_or_default().replace(' ', "");
                    i += 1;
                    if ["[cfg(test)]", "[cfg(doctest)]"].contains(&attribute.as_str()) {
                        if is_inner {
                            return false;
                        }
                        // The item, with its other attributes: to its semicolon or its body.
                        while !is_punct(tokens.get(i), ';') && !is_group(tokens.get(i), Delimiter::Brace) {
                            i += 1;
                        }
                        i += 1;
                    }
                    continue;
                }
                TokenTree::Group(group) => {
                    self.scan(group.stream(), false);
                }
                TokenTree::Ident(word) => {
                    let word = word.to_string();
                    let next = tokens.get(i + 1).and_then(ident);
                    match (word.as_str(), next) {
                        ("use", _) => {
                            let end =
                                i + 1 + tokens[i + 1..].iter().position(|t| is_punct(Some(t), ';')).unwrap();
                            self.import(&tokens[i + 1..end], &[], is_public);
                            i = end;
                        }
                        ("pub", _) => {
                            is_public = true;
                            i += 1 + usize::from(is_group(tokens.get(i + 1), Delimiter::Parenthesis));
                            continue;
                        }
                        ("mod", Some(name)) if is_top && is_punct(tokens.get(i + 2), ';') => {
                            self.children.insert(name);
                            i += 2;
                        }
                        (
                            "fn" | "struct" | "enum" | "union" | "trait" | "type" | "const" | "static"
                            | "mod",
                            Some(name),
                        ) if is_top => {
                            self.items.insert(name);
                        }
                        ("macro_rules", _) => {
                            self.items.extend(tokens.get(i + 2).and_then(ident));
                        }
                        _ => i = self.path(&tokens, i),
                    }
                }
                _ => {}
            }
            is_public = false;
            i += 1;
        }
        true
    }

    /// Reads the path that begins at a word; returns the index of its last segment.
    fn path(&mut self, tokens: &[TokenTree], mut i: usize) -> usize {
        let mut path = vec![tokens[i].to_string()];
        while is_punct(tokens.get(i + 1), ':') && is_punct(tokens.get(i + 2), ':') {
            let Some(name) = tokens.get(i + 3).and_then(ident) else { break };
            path.push(name);
            i += 3;
        }
        self.paths.insert(path);
        i
    }

    /// Reads the names of a `use` below a prefix.
    fn import(&mut self, tokens: &[TokenTree], prefix: &[String], is_public: bool) {
        for tree in tokens.split(|token| is_punct(Some(token), ',')) {
            let (mut path, mut alias) = (prefix.to_vec(), None);
            for (i, token) in tree.iter().enumerate() {
                match token {
                    TokenTree::Group(group) => {
                        let inner: Vec<_> = group.stream().into_iter().collect();
                        self.import(&inner, &path, is_public);
                        alias = Some(String::new());
                    }
                    TokenTree::Ident(word) if word == "as" => {
                        alias = tree.get(i + 1).map(ToString::to_string);
                        break;
                    }
                    TokenTree::Ident(word) if word == "self" && !path.is_empty() => {}
                    TokenTree::Ident(word) => path.push(word.to_string()),
                    TokenTree::Punct(punct) if punct.as_char() == '*' => alias = Some("*".to_owned()),
                    _ => {}
                }
            }
            let alias = alias.or_else(|| path.last().cloned()).unwrap_or_default();
            if !alias.is_empty() {
                self.uses.push(Use { path, alias, is_public });
            }
        }
    }

    /// Whether the code of the file, but for its imports, begins a path with a name.
    fn names(&self, name: &str) -> bool {
        self.paths.iter().any(|path| path[0] == name)
    }
}

fn ident(token: &TokenTree) -> Option<String> {
    match token {
        TokenTree::Ident(word) => Some(word.to_string()),
        _ => None,
    }
}

fn is_punct(token: Option<&TokenTree>, sign: char) -> bool {
    matches!(token, Some(TokenTree::Punct(punct)) if punct.as_char() == sign)
}

fn is_group(token: Option<&TokenTree>, delimiter: Delimiter) -> bool {
    matches!(token, Some(TokenTree::Group(group)) if group.delimiter() == delimiter)
}

/// `direct/newton.rs` is `direct::newton`; `lib.rs` and `main.rs` are the root.
fn module(file: &Path) -> Module {
    let module: Module =
        file.with_extension("").iter().map(|name| name.to_string_lossy().into_owned()).collect();
    if ["lib", "main"].contains(&module[0].as_str()) { Module::new() } else { module }
}

/// All Rust files of a folder and of those within it, sorted.
pub(crate) fn rust_files(folder: &Path) -> Vec<PathBuf> {
    let (mut folders, mut files) = (vec![folder.to_owned()], Vec::new());
    while let Some(folder) = folders.pop() {
        for path in std::fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path()) {
            if path.is_dir() {
                folders.push(path);
            } else if path.extension().is_some_and(|extension| extension == "rs") {
                files.push(path);
            }
        }
    }
    files.sort();
    files
}
