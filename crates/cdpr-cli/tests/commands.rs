//! Every command has an example in docs/COMMANDS.md; `book.rs` runs them.

use crate::common::{answered, cdpr};

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
