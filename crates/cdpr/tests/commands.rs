//! Every command has an example with its answer in docs/COMMANDS.md, and its options in docs/options.md.
//! `transcripts.rs` compares the answers, and `book.rs` runs the other examples.

use crate::common::{answered, cdpr, unwrapped};
use std::path::{Path, PathBuf};

const DOCUMENT: &str = include_str!("../../../docs/COMMANDS.md");

const OPTIONS: &str = include_str!("../../../docs/options.md");

/// Commands of a page with the first line of what they print.
fn shown(page: &'static str) -> Vec<(&'static str, &'static str)> {
    let blocks = page.split("```console\n").skip(1).map(|rest| rest.split("```").next().unwrap());
    let pairs = |block: &'static str| block.lines().zip(block.lines().skip(1).chain([""]));
    let commands = blocks.flat_map(pairs).filter_map(|(line, next)| Some((line.strip_prefix("$ ")?, next)));
    commands.collect()
}

/// The words of every command, as the help of the program lists them.
fn commands() -> Vec<String> {
    let help = answered(cdpr(&["--help"]));
    let groups = help.split("Options:").next().unwrap();
    let lines = groups.lines().filter(|line| line.starts_with("  ") && !line.starts_with("  Example"));
    let words = lines.filter_map(|line| line.trim_start().split("  ").next());
    words
        .filter(|words| words.chars().all(|c| c.is_ascii_lowercase() || c == ' '))
        .map(str::to_owned)
        .collect()
}

#[test]
fn every_command_has_an_example_with_its_answer_and_its_options() {
    let commands = commands();
    assert!(commands.len() > 30, "{commands:?}");
    let (examples, options) = (shown(DOCUMENT), shown(OPTIONS));
    for command in commands {
        let answer = examples.iter().find(|(line, _)| line.starts_with(&format!("cdpr {command} ")));
        let (_, answer) = answer.unwrap_or_else(|| panic!("docs/COMMANDS.md has no answer of `{command}`"));
        assert!(
            !answer.is_empty() && !answer.starts_with("$ "),
            "docs/COMMANDS.md: `{command}` says nothing"
        );
        let has_help = options.iter().any(|(line, _)| *line == format!("cdpr {command} -h"));
        assert!(has_help, "docs/options.md has no help of `{command}`");
    }
}

#[test]
fn old_and_similar_names_are_answered_by_the_command_that_is_meant() {
    for (typed, meant) in [
        (&["check", "cogiro"][..], "cdpr robot check"),
        (&["robots"], "cdpr robot list"),
        (&["calibration", "plan"], "cdpr calibrate"),
        (&["report", "out"], "cdpr study report"),
        (&["catenary"], "cdpr cable catenary"),
        (&["linear-density"], "cdpr cable density"),
        (&["robustness"], "cargo xtask robustness"),
        (&["study", "throughput"], "cargo xtask throughput"),
        (&["study", "check", "study.json"], "cdpr robot check"),
        (&["robot", "deflection"], "cdpr deflection"),
    ] {
        let output = cdpr(typed);
        let said = unwrapped(output.stderr);
        assert_eq!(output.status.code(), Some(2), "{typed:?}: {said}");
        assert!(said.contains(&format!("the command is `{meant}`")), "{typed:?}: {said}");
    }
    assert_eq!(cdpr(&["analyze", "--help"]).status.code(), Some(0));
}

#[test]
fn the_version_names_the_program_and_a_manual_page_describes_each_command() {
    let version = answered(cdpr(&["--version"]));
    assert!(version.starts_with("cdpr ") && !version.contains("cli"), "{version}");
    let page = answered(cdpr(&["man", "study", "run"]));
    assert!(page.contains(".TH cdpr-study-run") && page.contains("observations"), "{page}");
    let folder = tempfile::TempDir::new().unwrap();
    answered(cdpr(&["man", "--out", folder.path().to_str().unwrap()]));
    for name in commands() {
        let file = format!("cdpr-{}.1", name.replace(' ', "-"));
        assert!(folder.path().join(&file).is_file(), "{file}");
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
    let commands = commands();
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("../..");
    let pages = files(&root.join("docs"), ".md").into_iter().chain([root.join("README.md")]);
    let pages = pages.chain(files(&root.join("data"), "README.md"));
    let mut named = 0;
    for page in pages {
        let text = std::fs::read_to_string(&page).unwrap();
        for command in text.split("`cdpr ").skip(1) {
            let is_of_word = |c: char| c.is_ascii_lowercase() || c == '-';
            let word = &command[..command.find(|c| !is_of_word(c)).unwrap_or(command.len())];
            let is_named = |name: &String| name.split(' ').next() == Some(word);
            let is_known = word.is_empty() || word.starts_with('-') || commands.iter().any(is_named);
            assert!(is_known, "{}: `cdpr {word}`", page.display());
            named += 1;
        }
    }
    assert!(named > 100, "{named}");
}
