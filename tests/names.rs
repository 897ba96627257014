//! The names at the root of `cdpr-statics` are few, and none is too general without the name of a module.

use syn::{Item, UseTree, Visibility};

const LIB: &str = include_str!("../crates/cdpr-statics/src/lib.rs");

/// The names that a tree of imports ends with.
fn names(tree: &UseTree) -> Vec<String> {
    match tree {
        UseTree::Path(path) => names(&path.tree),
        UseTree::Name(name) => vec![name.ident.to_string()],
        UseTree::Rename(renamed) => vec![renamed.rename.to_string()],
        UseTree::Group(group) => group.items.iter().flat_map(names).collect(),
        UseTree::Glob(_) => panic!("the root names what it has"),
    }
}

fn is_public(visibility: &Visibility) -> bool {
    matches!(visibility, Visibility::Public(_))
}

#[test]
fn the_root_of_the_statics_has_few_names_and_none_that_is_too_general() {
    let of_item = |item: Item| match item {
        Item::Use(import) if is_public(&import.vis) => names(&import.tree),
        Item::Mod(module) if is_public(&module.vis) => vec![module.ident.to_string()],
        Item::Use(_) | Item::Mod(_) => Vec::new(),
        _ => panic!("the root imports and declares modules only"),
    };
    let root: Vec<_> = syn::parse_file(LIB).unwrap().items.into_iter().flat_map(of_item).collect();
    println!("{} names: {root:?}", root.len());
    assert!(root.len() < 60, "{}", root.len());
    for general in ["Blocked", "Blocking", "Found", "Greatest", "Limit", "Loss", "Mode", "Path", "Report"] {
        assert!(!root.iter().any(|name| name == general), "{general}");
    }
    for general in ["Setting", "Start", "Starts"] {
        assert!(!root.iter().any(|name| name == general), "{general}");
    }
}
