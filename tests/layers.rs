//! The layers that docs/ARCHITECTURE.md draws are those that cargo builds.

#![allow(clippy::unwrap_used, clippy::panic, clippy::print_stdout)]

use std::collections::{BTreeMap, BTreeSet};

const ARCHITECTURE: &str = include_str!("../docs/ARCHITECTURE.md");

/// Rows `| crate | may use | ...` of the table of layers.
fn documented() -> BTreeMap<String, BTreeSet<String>> {
    let names = |cell: &str| -> BTreeSet<String> {
        cell.split(',')
            .map(|name| name.trim().trim_matches('`').to_owned())
            .filter(|name| name.starts_with("cdpr-"))
            .collect()
    };
    ARCHITECTURE
        .lines()
        .filter_map(|line| {
            let mut cells = line.strip_prefix("| `")?.split('|');
            let name = cells.next()?.trim().trim_matches('`').to_owned();
            Some((name, names(cells.next()?)))
        })
        .filter(|(name, _)| name.starts_with("cdpr-") || name == "xtask")
        .collect()
}

#[test]
fn each_crate_uses_exactly_the_layers_that_are_documented() {
    let metadata = cargo_metadata::MetadataCommand::new().no_deps().exec().unwrap();
    let built: BTreeMap<String, BTreeSet<String>> = metadata
        .packages
        .iter()
        .filter(|package| package.name.as_str() != "cdpr-tests")
        .map(|package| {
            let layers = package
                .dependencies
                .iter()
                .filter(|dependency| dependency.kind == cargo_metadata::DependencyKind::Normal)
                .map(|dependency| dependency.name.clone())
                .filter(|name| name.starts_with("cdpr-"))
                .collect();
            (package.name.to_string(), layers)
        })
        .collect();
    assert_eq!(documented(), built);
}

#[test]
fn no_layer_uses_one_above_it() {
    let documented = documented();
    let mut below = BTreeSet::new();
    while below.len() < documented.len() {
        let next: Vec<_> = documented
            .iter()
            .filter(|(name, uses)| !below.contains(*name) && uses.iter().all(|layer| below.contains(layer)))
            .map(|(name, _)| name.clone())
            .collect();
        assert!(!next.is_empty(), "a cycle among the layers above {below:?}");
        below.extend(next);
    }
}

#[test]
fn each_solver_library_is_named_by_one_crate_alone() {
    let metadata = cargo_metadata::MetadataCommand::new().no_deps().exec().unwrap();
    for (library, user) in
        [("clarabel", "cdpr-tension"), ("faer", "cdpr-statics"), ("plotters", "cdpr-report")]
    {
        let users: Vec<_> = metadata
            .packages
            .iter()
            .filter(|package| package.dependencies.iter().any(|dependency| dependency.name == library))
            .map(|package| package.name.to_string())
            .collect();
        assert_eq!(users, [user], "{library}");
    }
}

#[test]
fn the_lower_layers_do_no_input_or_output() {
    for name in ["cdpr-cable", "cdpr-robot", "cdpr-tension", "cdpr-statics", "cdpr-sensitivity"] {
        let folder =
            std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("../crates").join(name).join("src");
        for entry in std::fs::read_dir(folder).unwrap() {
            let path = entry.unwrap().path();
            let text = std::fs::read_to_string(&path).unwrap();
            let code = text.lines().filter(|line| !line.trim_start().starts_with("//"));
            let text: String = code.collect::<Vec<_>>().join("\n");
            for word in
                ["std::fs", "std::net", "std::process", "std::env", "static mut", "println!", "eprintln!"]
            {
                assert!(!text.contains(word), "{} contains {word}", path.display());
            }
        }
    }
}
