//! The reference pages of the book: their commands run. Tutorials and guides are in `transcripts`.

use std::path::{Path, PathBuf};
use std::process::Command;

fn root() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../..").canonicalize().unwrap()
}

/// Chapters in the order of the table of contents, with their texts.
fn chapters() -> Vec<(String, String)> {
    let docs = root().join("docs");
    let summary = std::fs::read_to_string(docs.join("SUMMARY.md")).unwrap();
    let read = |name: &str| {
        let text = std::fs::read_to_string(docs.join(name));
        (name.to_owned(), text.unwrap_or_else(|error| panic!("docs/{name}: {error}")))
    };
    links(&summary).iter().map(|name| read(name)).collect()
}

/// Targets of links within the repository, without the place in the page.
fn links(text: &str) -> Vec<String> {
    let targets = text.split("](").skip(1).filter_map(|rest| rest.split(')').next());
    let targets = targets.filter(|target| !target.starts_with("http") && !target.starts_with('#'));
    targets.map(|target| target.split('#').next().unwrap().to_owned()).collect()
}

/// Lines of `sh` blocks that call the program.
fn commands(text: &str) -> Vec<String> {
    let blocks = text.split("```sh\n").skip(1).filter_map(|rest| rest.split("```").next());
    let lines =
        blocks.flat_map(|block| block.replace("\\\n", " ").lines().map(str::to_owned).collect::<Vec<_>>());
    lines.filter(|line| line.starts_with("cdpr ")).collect()
}

#[test]
#[cfg(unix)]
fn the_commands_of_the_book_run() {
    let folder = tempfile::TempDir::new().unwrap();
    std::os::unix::fs::symlink(root().join("data"), folder.path().join("data")).unwrap();
    let program = Path::new(env!("CARGO_BIN_EXE_cdpr"));
    let path = format!("{}:{}", program.parent().unwrap().display(), std::env::var("PATH").unwrap());
    let mut count = 0;
    for (name, text) in chapters() {
        for line in commands(&text) {
            let output =
                Command::new("sh").args(["-c", &line]).env("PATH", &path).current_dir(folder.path()).output();
            let output = output.unwrap();
            let message = String::from_utf8_lossy(&output.stderr);
            assert!(output.status.success(), "docs/{name}: {line}: {message}");
            assert!(!output.stdout.is_empty(), "docs/{name}: {line} prints nothing");
            count += 1;
        }
    }
    assert!(count >= 10, "{count}");
}
