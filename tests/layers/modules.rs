//! The modules of a crate and the imports between them.
//!
//! An import points to the file that defines the item, through any number of re-exports. Tests are left out,
//! and so are re-exports of what the file itself does not use.

use std::collections::{BTreeMap, BTreeSet};
use std::path::{Path, PathBuf};
use syn::visit_mut::{self, VisitMut};
use syn::{
    Attribute, Ident, Item, ItemConst, ItemEnum, ItemImpl, ItemMod, ItemStatic, ItemStruct, ItemTrait,
    ItemType, ItemUse, UseTree, Visibility,
};

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
    /// Paths of the code outside `use`, single names included.
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
    /// Reads the files under `src` that are declared outside tests.
    pub(crate) fn read(src: &Path) -> Self {
        let mut sources = BTreeMap::new();
        let name = |file: &PathBuf| module(file.strip_prefix(src).unwrap());
        // A folder's own file comes before those in it, and a program of a library holds no modules.
        let is_library = src.join("lib.rs").exists();
        let files = rust_files(src).into_iter().filter(|file| !is_library || *file != src.join("main.rs"));
        for (module, file) in files.map(|file| (name(&file), file)).collect::<BTreeMap<_, _>>() {
            let declared = module.split_last().is_none_or(|(name, parent)| {
                sources.get(parent).is_some_and(|parent: &Source| parent.children.contains(name))
            });
            let mut code = syn::parse_file(&std::fs::read_to_string(&file).unwrap()).unwrap();
            if declared && !is_test(&code.attrs) {
                let mut source = Source::default();
                source.visit_file_mut(&mut code);
                sources.insert(module, source);
            }
        }
        Self { sources }
    }

    pub(crate) fn modules(&self) -> BTreeSet<Module> {
        self.sources.keys().cloned().collect()
    }

    pub(crate) fn imports(&self) -> Imports {
        let mut imports = Imports::new();
        for (module, source) in &self.sources {
            let names = |name: &String| source.paths.iter().any(|path| path[0] == *name);
            let used = source.uses.iter().filter(|import| !import.is_public || names(&import.alias));
            let paths = source.paths.iter().filter(|path| path.len() > 1);
            for path in used.map(|import| &import.path).chain(paths) {
                if let Some(target) = self.definition(module, path, 0).filter(|target| target != module) {
                    imports.entry((module.clone(), target)).or_default().extend(path.last().cloned());
                }
            }
        }
        imports
    }

    /// The module that defines what a path of a module leads to; `None` for a module itself and for what is
    /// not of this crate.
    fn definition(&self, module: &Module, path: &[String], depth: usize) -> Option<Module> {
        let mut at = module.clone();
        for (i, name) in path.iter().enumerate() {
            match name.as_str() {
                "crate" => at.clear(),
                "self" => {}
                "super" => drop(at.pop()?),
                _ => {
                    let (source, rest) = (self.sources.get(&at)?, &path[i + 1..]);
                    let is_child = source.children.contains(name);
                    if is_child && !rest.is_empty() {
                        at.push(name.clone());
                        continue;
                    }
                    // `depth` ends a search in a circle of re-exports.
                    let through = |import: &Use| -> Option<Module> {
                        let is_glob = import.alias == "*";
                        let last = is_glob.then_some(name);
                        let path: Vec<_> = import.path.iter().chain(last).chain(rest).cloned().collect();
                        let found = (import.alias == *name || is_glob) && depth < 8;
                        let target = found.then(|| self.definition(&at, &path, depth + 1))??;
                        (!is_glob || self.sources.get(&target)?.items.contains(name)).then_some(target)
                    };
                    let is_item = source.items.contains(name);
                    let found = (!is_item).then(|| source.uses.iter().find_map(through)).flatten();
                    return found.or((is_item || i > 0 && !is_child).then_some(at));
                }
            }
        }
        None
    }
}

impl VisitMut for Source {
    fn visit_file_mut(&mut self, file: &mut syn::File) {
        for item in &file.items {
            match (item, about(item)) {
                (_, (attributes, _)) if is_test(attributes) => {}
                (Item::Mod(ItemMod { content: None, ident, .. }), _) => {
                    self.children.extend([ident.to_string()]);
                }
                (_, (_, name)) => self.items.extend(name.map(ToString::to_string)),
            }
        }
        visit_mut::visit_file_mut(self, file);
    }

    fn visit_item_mut(&mut self, item: &mut Item) {
        match item {
            item if is_test(about(item).0) => {}
            Item::Use(ItemUse { tree, vis, .. }) => {
                self.import(tree, &[], !matches!(vis, Visibility::Inherited));
            }
            item => visit_mut::visit_item_mut(self, item),
        }
    }

    fn visit_path_mut(&mut self, path: &mut syn::Path) {
        self.paths.insert(path.segments.iter().map(|segment| segment.ident.to_string()).collect());
        visit_mut::visit_path_mut(self, path);
    }

    fn visit_macro_mut(&mut self, call: &mut syn::Macro) {
        self.visit_path_mut(&mut call.path);
        let text = call.tokens.to_string().replace(" :: ", "::");
        let words = text.split(|sign: char| !sign.is_alphanumeric() && !"_:".contains(sign));
        self.paths.extend(words.map(|word| word.split("::").map(str::to_owned).collect()));
    }
}

impl Source {
    /// Reads the names of a `use` below a prefix.
    fn import(&mut self, tree: &UseTree, prefix: &[String], is_public: bool) {
        let (name, alias) = match tree {
            UseTree::Group(group) => {
                return group.items.iter().for_each(|tree| self.import(tree, prefix, is_public));
            }
            UseTree::Path(path) => {
                return self.import(&path.tree, &[prefix, &[path.ident.to_string()]].concat(), is_public);
            }
            UseTree::Glob(_) => (None, "*".to_owned()),
            UseTree::Name(name) if name.ident == "self" => (None, prefix[prefix.len() - 1].clone()),
            UseTree::Name(name) => (Some(name.ident.to_string()), name.ident.to_string()),
            UseTree::Rename(name) => (Some(name.ident.to_string()), name.rename.to_string()),
        };
        self.uses.push(Use { path: prefix.iter().cloned().chain(name).collect(), alias, is_public });
    }
}

/// Attributes and name of an item.
fn about(item: &Item) -> (&[Attribute], Option<&Ident>) {
    match item {
        Item::Const(ItemConst { attrs, ident, .. })
        | Item::Enum(ItemEnum { attrs, ident, .. })
        | Item::Mod(ItemMod { attrs, ident, .. })
        | Item::Static(ItemStatic { attrs, ident, .. })
        | Item::Struct(ItemStruct { attrs, ident, .. })
        | Item::Trait(ItemTrait { attrs, ident, .. })
        | Item::Type(ItemType { attrs, ident, .. }) => (attrs, Some(ident)),
        Item::Fn(item) => (&item.attrs, Some(&item.sig.ident)),
        Item::Macro(item) => (&item.attrs, item.ident.as_ref()),
        Item::Impl(ItemImpl { attrs, .. }) | Item::Use(ItemUse { attrs, .. }) => (attrs, None),
        _ => (&[], None),
    }
}

fn is_test(attributes: &[Attribute]) -> bool {
    let is = |attribute: &Attribute, condition| {
        attribute.path().is_ident("cfg")
            && attribute.parse_args::<Ident>().is_ok_and(|name| name == condition)
    };
    attributes.iter().any(|attribute| is(attribute, "test") || is(attribute, "doctest"))
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
