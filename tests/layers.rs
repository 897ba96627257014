//! Crates depend on each other, and modules import from each other, as docs/ARCHITECTURE.md says. Each label
//! is that of one equation. Files and functions are short; names and words have one meaning and one spelling.

mod floors;
mod labels;
mod modules;
mod sizes;
mod words;

use cargo_metadata::{DependencyKind, MetadataCommand, Package};
use floors::Floors;
use modules::{Crate, Module, rust_files};
use std::collections::{BTreeMap, BTreeSet};
use std::path::{Path, PathBuf};

const ARCHITECTURE: &str = include_str!("../docs/ARCHITECTURE.md");

/// Whether a crate is one of this workspace.
fn is_ours(name: &str) -> bool {
    name == "cdpr" || name.starts_with("cdpr-")
}

/// Rows `| crate | may use | ...` of the table of layers.
fn documented() -> BTreeMap<String, BTreeSet<String>> {
    let names = |cell: &str| -> BTreeSet<String> {
        let names = cell.split(',').map(|name| name.trim().trim_matches('`').to_owned());
        names.filter(|name| is_ours(name)).collect()
    };
    ARCHITECTURE
        .lines()
        .filter_map(|line| {
            let mut cells = line.strip_prefix("| `")?.split('|');
            let name = cells.next()?.trim().trim_matches('`').to_owned();
            Some((name, names(cells.next()?)))
        })
        .filter(|(name, _)| is_ours(name) || name == "xtask")
        .collect()
}

/// All packages but those of these tests and of the fuzz targets.
fn packages() -> impl Iterator<Item = Package> {
    let metadata = MetadataCommand::new().no_deps().exec().unwrap();
    metadata
        .packages
        .into_iter()
        .filter(|package| !["cdpr-tests", "cdpr-fuzz"].contains(&package.name.as_str()))
}

#[test]
fn each_crate_uses_exactly_the_layers_that_are_documented() {
    let layers = |package: Package| {
        let used = package.dependencies.into_iter().filter(|used| used.kind == DependencyKind::Normal);
        used.map(|used| used.name).filter(|name| is_ours(name)).collect()
    };
    let built = packages().map(|package| (package.name.to_string(), layers(package))).collect();
    assert_eq!(documented(), built);
}

/// Folders of sources by name of the crate.
fn sources() -> BTreeMap<String, PathBuf> {
    let source = |package: &Package| package.manifest_path.parent().unwrap().join("src").into();
    packages().map(|package| (package.name.to_string(), source(&package))).collect()
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

/// The lines of a file that are not comments.
fn code(file: &Path) -> String {
    let text = std::fs::read_to_string(file).unwrap();
    text.lines().filter(|line| !line.trim_start().starts_with("//")).map(|line| format!("{line}\n")).collect()
}

#[test]
fn each_numerical_library_is_named_by_one_module_of_a_crate() {
    let crates = Path::new(env!("CARGO_MANIFEST_DIR")).join("../crates");
    for (library, modules) in [
        ("clarabel", &["cdpr-tension/src/program.rs"][..]),
        (
            "faer",
            &[
                "cdpr-calibration/src/solve.rs",
                "cdpr-dynamics/src/dense.rs",
                "cdpr-sensitivity/src/measure/linear_algebra.rs",
                "cdpr-statics/src/dense.rs",
            ],
        ),
        ("pulp", &["cdpr-number/src/lanes.rs"]),
    ] {
        let mut users = Vec::new();
        for source in rust_files(&crates).into_iter().filter(|path| path.iter().any(|part| part == "src")) {
            if code(&source).contains(&format!("{library}::")) {
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
    for name in [
        "cdpr-number",
        "cdpr-cable",
        "cdpr-robot",
        "cdpr-tension",
        "cdpr-statics",
        "cdpr-exchange",
        "cdpr-observer",
        "cdpr-sensitivity",
    ] {
        for path in rust_files(&crates.join(name).join("src")) {
            let code = code(&path);
            for word in
                ["std::fs", "std::net", "std::process", "std::env", "static mut", "println!", "eprintln!"]
            {
                assert!(!code.contains(word), "{} contains {word}", path.display());
            }
        }
    }
}

/// The sources and examples of all crates.
fn texts() -> BTreeMap<PathBuf, String> {
    let crates = Path::new(env!("CARGO_MANIFEST_DIR")).join("../crates");
    rust_files(&crates)
        .into_iter()
        .map(|path| (path.strip_prefix(&crates).unwrap().to_owned(), path))
        .filter(|(name, _)| name.iter().any(|part| part == "src" || part == "examples"))
        .map(|(name, path)| (name, std::fs::read_to_string(path).unwrap()))
        .collect()
}

#[test]
fn equation_labels_are_unique() {
    let texts = texts();
    let mut files: BTreeMap<&str, Vec<&PathBuf>> = BTreeMap::new();
    for (file, text) in &texts {
        for label in labels::defined(text) {
            files.entry(label).or_default().push(file);
        }
    }
    files.retain(|_, files| files.len() > 1);
    assert!(files.is_empty(), "defined twice: {files:?}");
}

#[test]
fn cited_labels_exist() {
    let texts = texts();
    let defined: BTreeSet<&str> = texts.values().flat_map(|text| labels::defined(text)).collect();
    assert!(defined.contains("C1"));
    let cited = texts.iter().flat_map(|(file, text)| labels::cited(text).map(move |label| (label, file)));
    let unknown: BTreeSet<_> = cited.filter(|(label, _)| !defined.contains(label)).collect();
    assert!(unknown.is_empty(), "defined nowhere: {unknown:?}");
}

/// Files of all crates and of these tests with one of these endings, by their paths from the root.
fn covered(endings: &[&str]) -> BTreeMap<PathBuf, String> {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("..");
    let is_skipped = |name: &str| ["node_modules", "target"].contains(&name);
    let (mut folders, mut files) =
        (["crates", "docs", "tests", "xtask"].map(|folder| root.join(folder)).to_vec(), BTreeMap::new());
    while let Some(folder) = folders.pop() {
        for path in std::fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path()) {
            let name = path.file_name().unwrap().to_str().unwrap();
            if path.is_dir() && !is_skipped(name) && !name.starts_with('.') {
                folders.push(path);
            } else if path.extension().is_some_and(|end| endings.contains(&end.to_str().unwrap())) {
                let text = std::fs::read_to_string(&path).unwrap();
                files.insert(path.strip_prefix(&root).unwrap().to_owned(), text);
            }
        }
    }
    files
}

#[test]
fn files_and_functions_are_short_and_functions_have_few_parameters() {
    let excesses = covered(&["rs"]).into_iter().flat_map(|(file, text)| {
        sizes::excesses(&text).into_iter().map(move |what| format!("{}: {what}", file.display()))
    });
    let excesses: Vec<_> = excesses.collect();
    assert!(excesses.is_empty(), "{}", excesses.join("\n"));
}

#[test]
fn the_name_of_a_public_type_is_unique_in_its_crate() {
    let mut files: BTreeMap<(PathBuf, String), Vec<PathBuf>> = BTreeMap::new();
    for (file, text) in covered(&["rs"]) {
        let Some((folder, _)) = file.to_str().unwrap().split_once("/src/") else { continue };
        for name in words::public_types(&text) {
            files.entry((folder.into(), name)).or_default().push(file.clone());
        }
    }
    files.retain(|_, files| files.len() > 1);
    assert!(files.is_empty(), "{files:#?}");
}

#[test]
fn a_word_has_one_spelling() {
    let mut found = Vec::new();
    for (file, text) in covered(&["md", "py", "pyi", "rs", "toml"]) {
        found.extend(
            words::other_spellings(&text).into_iter().map(|word| format!("{}: {word}", file.display())),
        );
    }
    assert!(found.is_empty(), "expected -ize: {found:#?}");
}

#[test]
fn pages_have_no_old_words() {
    let mut found = Vec::new();
    for (file, text) in covered(&["md"]) {
        // Pages that are made of the documentation of sources, and answers of the program, are not looked at.
        let is_made = ["docs/api/", "docs/fields.md"].iter().any(|path| file.starts_with(path));
        if !is_made {
            let prose: String = text.split("```").step_by(2).collect();
            found.extend(
                words::old_words(&prose).into_iter().map(|word| format!("{}: {word}", file.display())),
            );
        }
    }
    assert!(found.is_empty(), "tests/layers/words.rs has other words: {found:#?}");
}
