//! Manifests say what registries show, and files that name the version, the repository and the authors agree.

use cargo_metadata::{MetadataCommand, Package};
use std::path::{Component, Path, PathBuf};
use std::process::Command;

/// Slugs of crates.io that these crates use.
const CATEGORIES: [&str; 7] = [
    "command-line-utilities",
    "mathematics",
    "science",
    "science::robotics",
    "simulation",
    "visualization",
    "wasm",
];

fn packages() -> Vec<Package> {
    MetadataCommand::new().no_deps().exec().unwrap().packages
}

/// What a manifest lacks for crates.io.
fn lacks(package: &Package) -> Vec<String> {
    let mut lacks = Vec::new();
    let mut demand = |holds: bool, what: &str| {
        if !holds {
            lacks.push(format!("{}: {what}", package.name));
        }
    };
    let is_page = |page: &Option<String>| page.as_ref().is_some_and(|page| page.starts_with("https://"));
    let description = package.description.as_deref().unwrap_or_default();
    demand((20..=150).contains(&description.len()), "a description of 20 to 150 characters");
    demand(!description.ends_with('.'), "a description without a period");
    demand(package.license.as_deref() == Some("MIT OR Apache-2.0"), "license.workspace");
    demand(!package.authors.is_empty(), "authors.workspace");
    demand(is_page(&package.repository), "repository.workspace");
    demand(is_page(&package.homepage), "homepage.workspace");
    let documentation = format!("https://docs.rs/{}", package.name);
    demand(package.documentation.as_ref() == Some(&documentation), "documentation on docs.rs");
    let folder = package.manifest_path.parent().unwrap();
    demand(package.readme.as_ref().is_some_and(|readme| folder.join(readme).is_file()), "a readme");
    let is_keyword = |word: &String| {
        word.len() <= 20 && word.chars().all(|c| c.is_ascii_lowercase() || c.is_ascii_digit() || c == '-')
    };
    demand((1..=5).contains(&package.keywords.len()), "one to five keywords");
    demand(package.keywords.iter().all(is_keyword), "keywords of at most 20 small letters");
    let is_known = |category: &String| CATEGORIES.contains(&category.as_str());
    let categories = &package.categories;
    demand(!categories.is_empty() && categories.iter().all(is_known), "categories of crates.io");
    demand(package.rust_version.is_some(), "rust-version.workspace");
    // A registry cannot resolve a path alone; packages are without the dependencies of tests.
    for used in &package.dependencies {
        let is_of_tests = used.kind == cargo_metadata::DependencyKind::Development;
        let version = used.req.to_string();
        demand(used.path.is_none() || is_of_tests || version != "*", &format!("a version of {}", used.name));
    }
    lacks
}

#[test]
fn what_is_published_has_a_complete_manifest() {
    let published: Vec<Package> =
        packages().into_iter().filter(|package| package.publish.is_none()).collect();
    let lacks: Vec<String> = published.iter().flat_map(lacks).collect();
    assert!(lacks.is_empty(), "{lacks:#?}");
    let names: Vec<&str> = published.iter().map(|package| package.name.as_str()).collect();
    assert!(names.contains(&"cdpr") && !names.contains(&"xtask") && names.len() >= 14, "{names:?}");
}

#[test]
fn an_incomplete_manifest_is_found() {
    let mut package = packages().into_iter().find(|package| package.name.as_str() == "cdpr-cable").unwrap();
    (package.repository, package.description) = (None, Some("Cables.".to_owned()));
    package.keywords.extend((0..5).map(|k| format!("word-{k}")));
    package.categories.push("ropes".to_owned());
    let found = lacks(&package);
    assert_eq!(found.len(), 5, "{found:#?}");
    assert!(found.iter().all(|lack| lack.starts_with("cdpr-cable: ")), "{found:#?}");
}

#[test]
fn all_files_name_the_same_version_repository_and_authors() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).parent().unwrap();
    let packages = packages();
    let package = packages.iter().find(|package| package.name.as_str() == "cdpr").unwrap();
    let [version, repository] = [package.version.to_string(), package.repository.clone().unwrap()];
    let author = package.authors[0].split(" <").next().unwrap();
    let family = author.rsplit(' ').next().unwrap();
    for (file, texts) in [
        ("CITATION.cff", [format!("version: {version}\n"), repository.clone(), family.to_owned()]),
        ("crates/cdpr-python/pyproject.toml", [author.to_owned(), repository.clone(), String::new()]),
        ("recipe/recipe.yaml", [format!("version: \"{version}\""), repository.clone(), String::new()]),
        ("docs/joss/paper.md", [author.to_owned(), String::new(), String::new()]),
        ("docs/book.toml", [repository.clone(), String::new(), String::new()]),
        ("README.md", [repository.clone(), String::new(), String::new()]),
    ] {
        let text = std::fs::read_to_string(root.join(file)).unwrap();
        for expected in texts {
            assert!(text.contains(&expected), "{file} has no `{expected}`: run cargo xtask release");
        }
    }
    assert!(packages.iter().all(|of| of.version == package.version), "one version for all crates");
}

/// Files that a source names by their place: in `include_str!`, `include_bytes!` and `#[path]`.
fn named_files(source: &str) -> impl Iterator<Item = &str> {
    let begins = ["include_str!(\"", "include_bytes!(\"", "#[path = \""];
    let rests = begins.into_iter().flat_map(|begin| source.split(begin).skip(1));
    rests.filter_map(|rest| rest.split('"').next())
}

/// A path without `..`; `None` outside of the folder that it begins in.
fn plain(path: &Path) -> Option<PathBuf> {
    path.components().try_fold(PathBuf::new(), |mut plain, part| {
        match part {
            Component::ParentDir => plain.pop().then_some(())?,
            part => plain.push(part),
        }
        Some(plain)
    })
}

#[test]
fn packed_sources_name_files_of_their_package_alone() {
    let mut lacks = Vec::new();
    for package in packages().into_iter().filter(|package| package.publish.is_none()) {
        let mut list = Command::new(env!("CARGO"));
        list.args([
            "package",
            "--list",
            "--allow-dirty",
            "--locked",
            "--exclude-lockfile",
            "--manifest-path",
        ]);
        let list = String::from_utf8(list.arg(&package.manifest_path).output().unwrap().stdout).unwrap();
        let files: Vec<&Path> = list.lines().map(Path::new).collect();
        assert!(files.contains(&Path::new("src/lib.rs")), "{}: {list}", package.name);
        for file in files.iter().filter(|file| file.extension().is_some_and(|end| end == "rs")) {
            let text =
                std::fs::read_to_string(package.manifest_path.with_file_name("").as_std_path().join(file))
                    .unwrap();
            for named in named_files(&text) {
                let path = plain(&file.parent().unwrap().join(named));
                if !path.as_deref().is_some_and(|path| files.contains(&path)) {
                    lacks.push(format!("{}: {} names {named}", package.name, file.display()));
                }
            }
        }
    }
    assert!(lacks.is_empty(), "{lacks:#?}");
    assert_eq!(plain(Path::new("src/a/../../../data/b.json")), None);
    assert_eq!(plain(Path::new("src/a/../b.txt")), Some(PathBuf::from("src/b.txt")));
}
