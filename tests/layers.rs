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
fn each_numerical_library_is_named_by_one_module_of_a_crate() {
    let crates = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("../crates");
    for (library, modules) in [
        ("clarabel", &["cdpr-tension/src/quadratic_program.rs"][..]),
        ("faer", &["cdpr-sensitivity/src/least_squares.rs", "cdpr-statics/src/equations/assembled.rs"]),
        ("mpi", &["cdpr-cli/src/study/ranks.rs"]),
        ("pulp", &["cdpr-statics/src/lanes/simd.rs"]),
    ] {
        let mut users = Vec::new();
        for source in rust_files(&crates) {
            let text = std::fs::read_to_string(&source).unwrap();
            let code = text.lines().filter(|line| !line.trim_start().starts_with("//"));
            if code.into_iter().any(|line| line.contains(&format!("{library}::"))) {
                users.push(source.strip_prefix(&crates).unwrap().display().to_string());
            }
        }
        users.sort();
        assert_eq!(users, modules, "{library}");
    }
}

/// All Rust files under `src` of the crates in a folder.
fn rust_files(crates: &std::path::Path) -> Vec<std::path::PathBuf> {
    let mut folders: Vec<_> =
        std::fs::read_dir(crates).unwrap().map(|entry| entry.unwrap().path().join("src")).collect();
    let mut files = Vec::new();
    while let Some(folder) = folders.pop() {
        for entry in std::fs::read_dir(folder).unwrap() {
            let path = entry.unwrap().path();
            if path.is_dir() {
                folders.push(path);
            } else if path.extension().is_some_and(|extension| extension == "rs") {
                files.push(path);
            }
        }
    }
    files
}

#[test]
fn the_lower_layers_do_no_input_or_output() {
    for name in ["cdpr-cable", "cdpr-robot", "cdpr-tension", "cdpr-statics", "cdpr-sensitivity"] {
        let crates = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("../crates");
        let folder = crates.join(name);
        for path in rust_files(&crates).into_iter().filter(|path| path.starts_with(&folder)) {
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
