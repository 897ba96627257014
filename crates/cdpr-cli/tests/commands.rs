//! Every command has an example in docs/COMMANDS.md; `book.rs` runs them.

use crate::common::{answered, cdpr};
use std::path::{Path, PathBuf};

const DOCUMENT: &str = include_str!("../../../docs/COMMANDS.md");

fn examples() -> Vec<&'static str> {
    let blocks = DOCUMENT.split("```sh\n").skip(1).map(|rest| rest.split("```").next().unwrap());
    blocks.flat_map(str::lines).collect()
}

#[test]
fn every_command_has_an_example() {
    let help = answered(cdpr(&["--help"]));
    let commands = help.split("Commands:\n").nth(1).unwrap().split("\n\n").next().unwrap();
    for command in commands.lines().map(|line| line.split_whitespace().next().unwrap()) {
        let has_one = examples().iter().any(|line| line.starts_with(&format!("cdpr {command} ")));
        assert!(has_one || command == "help", "docs/COMMANDS.md has no example of `{command}`");
    }
}

/// The files of a folder, those of the folders in it too, whose names end so.
fn files(folder: &Path, ending: &str) -> Vec<PathBuf> {
    let entries = std::fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path());
    let of = |path: PathBuf| match path.is_dir() {
        true => files(&path, ending),
        false => Some(path).filter(|path| path.to_string_lossy().ends_with(ending)).into_iter().collect(),
    };
    entries.flat_map(of).collect()
}

#[test]
fn no_page_names_a_command_that_does_not_exist() {
    let help = answered(cdpr(&["--help"]));
    let commands = help.split("Commands:\n").nth(1).unwrap().split("\n\n").next().unwrap();
    let commands: Vec<_> = commands.lines().map(|line| line.split_whitespace().next().unwrap()).collect();
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("../..");
    let pages = files(&root.join("docs"), ".md").into_iter().chain([root.join("README.md")]);
    let pages = pages.chain(files(&root.join("data"), "README.md"));
    let mut named = 0;
    for page in pages {
        let text = std::fs::read_to_string(&page).unwrap();
        for command in text.split("`cdpr ").skip(1) {
            let is_of_word = |c: char| c.is_ascii_lowercase() || c == '-';
            let word = &command[..command.find(|c| !is_of_word(c)).unwrap_or(command.len())];
            let is_known = word.is_empty() || word.starts_with('-') || commands.contains(&word);
            assert!(is_known, "{}: `cdpr {word}`", page.display());
            named += 1;
        }
    }
    assert!(named > 100, "{named}");
}
