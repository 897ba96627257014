//! Crates depend on each other, and modules import from each other, as docs/ARCHITECTURE.md says.

mod floors;
mod modules;

use floors::Floors;
use modules::{Crate, Module, rust_files};
use std::collections::{BTreeMap, BTreeSet};
use std::path::{Path, PathBuf};

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

/// Folders of sources by name of the crate.
fn sources() -> BTreeMap<String, PathBuf> {
    let metadata = cargo_metadata::MetadataCommand::new().no_deps().exec().unwrap();
    let crates = metadata.packages.iter().filter(|package| package.name.as_str() != "cdpr-tests");
    crates
        .map(|package| (package.name.to_string(), package.manifest_path.parent().unwrap().join("src").into()))
        .collect()
}

/// The floors of each crate: below its name, indented, in the block of modules.
fn documented_floors() -> BTreeMap<String, String> {
    let block =
        ARCHITECTURE.split("\n## Modules\n").nth(1).and_then(|rest| rest.split("```").nth(1)).unwrap();
    // A floor may go on in lines that are indented further.
    let block = block.replace("\n        ", " ");
    let mut floors: BTreeMap<String, String> = BTreeMap::new();
    let mut name = "";
    for line in block.lines().skip(1) {
        if line.starts_with(' ') {
            floors.get_mut(name).unwrap().push_str(&format!("{line}\n"));
        } else {
            name = line;
            floors.insert(name.to_owned(), String::new());
        }
    }
    floors
}

#[test]
fn no_more_than_two_files_of_a_crate_import_from_each_other_in_a_circle() {
    let circles = |(name, folder): (&String, &PathBuf)| {
        let circles = floors::circles(&Crate::read(folder).imports());
        circles.iter().map(|circle| format!("{name} has {circle}\n")).collect::<String>()
    };
    let found: String = sources().iter().map(circles).collect();
    assert!(found.is_empty(), "{found}");
}

#[test]
fn each_module_imports_from_the_floors_below_it_alone() {
    let documented = documented_floors();
    let mut found = String::new();
    for (name, folder) in sources() {
        let sources = Crate::read(&folder);
        let (modules, imports) = (sources.modules(), sources.imports());
        let breaches = match documented.get(&name) {
            Some(list) => Floors::parse(list).breaches(&modules, &imports),
            None => vec!["docs/ARCHITECTURE.md has no list of its modules".to_owned()],
        };
        if !breaches.is_empty() {
            let today = floors::suggestion(&Module::new(), &modules, &imports).replace('\n', "\n    ");
            found += &format!(
                "{name}: {}\nThe imports of today make:\n{name}\n    {today}\n\n",
                breaches.join("\n  ")
            );
        }
    }
    assert!(found.is_empty(), "{found}");
}

#[test]
fn at_most_sixteen_files_stand_side_by_side() {
    let mut files: BTreeMap<PathBuf, usize> = BTreeMap::new();
    for file in sources().values().flat_map(|folder| rust_files(folder)) {
        *files.entry(file.parent().unwrap().to_owned()).or_default() += 1;
    }
    files.retain(|_, count| *count > 16);
    assert!(files.is_empty(), "{files:?}");
}

#[test]
fn each_numerical_library_is_named_by_one_module_of_a_crate() {
    let crates = Path::new(env!("CARGO_MANIFEST_DIR")).join("../crates");
    for (library, modules) in [
        ("clarabel", &["cdpr-tension/src/quadratic_program.rs"][..]),
        (
            "faer",
            &["cdpr-sensitivity/src/measure/least_squares.rs", "cdpr-statics/src/equations/assembled.rs"],
        ),
        ("mpi", &["cdpr-cli/src/study/ranks.rs"]),
        ("pulp", &["cdpr-statics/src/lanes/simd.rs"]),
    ] {
        let mut users = Vec::new();
        for source in rust_files(&crates).into_iter().filter(|path| path.iter().any(|part| part == "src")) {
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

#[test]
fn the_lower_layers_do_no_input_or_output() {
    let crates = Path::new(env!("CARGO_MANIFEST_DIR")).join("../crates");
    for name in ["cdpr-cable", "cdpr-robot", "cdpr-tension", "cdpr-statics", "cdpr-sensitivity"] {
        for path in rust_files(&crates.join(name).join("src")) {
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
