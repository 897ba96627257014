//! Every example of docs/COMMANDS.md runs, and every command has one.

#![allow(clippy::unwrap_used, clippy::panic, clippy::print_stdout)]

use std::path::Path;
use std::process::Command;
use tempfile::TempDir;

const DOCUMENT: &str = include_str!("../../../docs/COMMANDS.md");

fn examples() -> Vec<&'static str> {
    let blocks = DOCUMENT.split("```sh\n").skip(1).map(|rest| rest.split("```").next().unwrap());
    blocks.flat_map(str::lines).collect()
}

#[test]
fn every_example_does_all_that_was_asked_for() {
    let folder = TempDir::new().unwrap();
    let data = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../data");
    for kind in ["robots", "studies"] {
        let to = folder.path().join("data").join(kind);
        std::fs::create_dir_all(&to).unwrap();
        for entry in std::fs::read_dir(data.join(kind)).unwrap().map(Result::unwrap) {
            std::fs::copy(entry.path(), to.join(entry.file_name())).unwrap();
        }
    }
    assert!(examples().len() > 10);
    for example in examples() {
        let mut words = example.split_whitespace();
        assert_eq!(words.next(), Some("cdpr"), "{example}");
        let output =
            Command::new(env!("CARGO_BIN_EXE_cdpr")).current_dir(folder.path()).args(words).output().unwrap();
        assert!(output.status.success(), "{example}: {}", String::from_utf8_lossy(&output.stderr));
        assert!(!output.stdout.is_empty(), "{example}");
    }
}

#[test]
fn every_command_has_an_example() {
    let help = Command::new(env!("CARGO_BIN_EXE_cdpr")).arg("--help").output().unwrap();
    let help = String::from_utf8(help.stdout).unwrap();
    let commands = help.split("Commands:\n").nth(1).unwrap().split("\n\n").next().unwrap();
    for command in commands.lines().map(|line| line.split_whitespace().next().unwrap()) {
        let has_one = examples().iter().any(|line| line.starts_with(&format!("cdpr {command} ")));
        assert!(has_one || command == "help", "docs/COMMANDS.md has no example of `{command}`");
    }
}
