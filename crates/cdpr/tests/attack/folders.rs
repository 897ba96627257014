//! The cases of folders: a stranger's, one with the user's own files, one that was edited, one that several
//! processes want.

use super::PROGRAM;
use super::case::{Case, MINE, split};
use std::fs;
use std::io;
use std::path::Path;
use std::process::{Command, Stdio};

/// A folder of results, of which each case gets a copy.
const DONE: &str = "done";

/// Makes a folder of results, and files of the user beside it.
pub(super) fn prepare(folder: &Path) -> io::Result<()> {
    let mut command = Command::new(PROGRAM);
    command.args(split("study run study.json --table csv --out")).arg(DONE).current_dir(folder);
    if !command.stdout(Stdio::null()).status()?.success() {
        return Err(io::Error::other("the study of the attack cannot be run"));
    }
    fs::create_dir(folder.join("victim"))?;
    ["victim/2024.csv", "victim/0000.csv"].iter().try_for_each(|name| fs::write(folder.join(name), MINE))
}

/// A run with a folder of results of its own.
const RUN: &str = "study run study.json --table csv --out out";

/// All cases.
pub(super) fn all() -> Vec<Case> {
    [links(), lists_of_files_outside(), blocking_files(), edited_files(), reports_over_files()]
        .into_iter()
        .chain([files_of_the_user(), paths_that_are_no_text(), disturbed_runs()])
        .flatten()
        .collect()
}

/// A command around the program, after a preparation in the shell.
fn case(what: &str, shell: String, around: &'static str, command: &str, may_succeed: bool) -> Case {
    let (what, shell) = (what.to_owned(), Some(shell));
    Case { what, shell, around, arguments: split(command), may_succeed, ..Case::default() }
}

/// A command on a copy of the folder of results after a change.
fn changed(what: &str, change: &str, command: &str, may_succeed: bool) -> Case {
    case(what, format!("cp -r {DONE} out; {change}"), "", command, may_succeed)
}

/// Commands that write into a folder of results.
fn writers() -> Vec<String> {
    let options = ["--overwrite", "--resume", "--shard 1/1"].map(|option| format!("{RUN} {option}"));
    let others =
        ["study merge out", "study extend out --observations 40", "study report out"].map(str::to_owned);
    options.into_iter().chain(others).collect()
}

/// Links and other strange things in a folder of results.
fn links() -> Vec<Case> {
    let changes = [
        ("blocks is a link", "rm -r out/blocks; ln -s .. out/blocks"),
        ("the folder of a sampling is a link", "ln -s ../victim out/mechanical"),
        ("a link among the blocks", "ln -s ../../../../victim out/blocks/mechanical/sampling/more"),
        (
            "blocks of a sampling are a link",
            "rm -r out/blocks/mechanical; ln -s ../../victim out/blocks/mechanical",
        ),
        ("links in a circle", "ln -s .. out/blocks/circle; ln -s . out/blocks/mechanical/self"),
        ("a link in a circle", "rm out/mechanical.csv; ln -s mechanical.csv out/mechanical.csv"),
        ("a table is a link", "rm out/mechanical.csv; ln -s ../victim.csv out/mechanical.csv"),
        ("the list is a link", "mv out/cdpr-results.json list; ln -s ../list out/cdpr-results.json"),
        ("the lock is a link", "rm out/cdpr-results.lock; ln -s ../victim.csv out/cdpr-results.lock"),
        ("a sampling named as a folder outside", "sed -i 's|\"mechanical\"|\"../victim\"|' out/study.json"),
        (
            "own files among the results",
            "mkdir out/mechanical; printf mine >out/mechanical/2024.csv; \
            printf mine >out/mine.svg; printf mine >out/blocks/mechanical/sampling/000009.block",
        ),
    ];
    let writers = writers();
    let each =
        changes.iter().flat_map(|(what, change)| writers.iter().map(|by| changed(what, change, by, true)));
    each.collect()
}

/// Lists of results that name files elsewhere.
fn lists_of_files_outside() -> Vec<Case> {
    let names =
        ["../victim.csv", "../victim/2024.csv", "/etc/passwd.csv", "a/../../victim.csv", "blocks/0000.csv"];
    let of_name = |name: &str| {
        let list =
            format!("{{\"format\":\"cdpr-results/1\",\"of\":\"study\",\"files\":{{\"{name}\":null}}}}");
        let change = format!("echo '{list}' >out/cdpr-results.json");
        writers().iter().map(|by| changed("a list of files outside", &change, by, false)).collect::<Vec<_>>()
    };
    names.into_iter().flat_map(of_name).collect()
}

/// Files that never end, or whose reader waits.
fn blocking_files() -> Vec<Case> {
    let names = [
        "study.json",
        "robot.json",
        "summary.json",
        "timings.json",
        "cdpr-results.json",
        "cdpr-results.lock",
        "mechanical.csv",
        "surface_E_rho.csv",
        "blocks/mechanical/sampling/000000.block",
    ];
    let writers = writers();
    let commands = [&writers[1], &writers[3], &writers[5], "study status out"];
    let mut cases = Vec::new();
    for name in names {
        for (what, made) in [("a pipe", "mkfifo"), ("a device that never ends", "ln -s /dev/zero")] {
            let (what, change) = (format!("{name} is {what}"), format!("rm out/{name}; {made} out/{name}"));
            cases.extend(commands.map(|command| changed(&what, &change, command, true)));
        }
    }
    cases
}

/// Results that were edited.
fn edited_files() -> Vec<Case> {
    let mut cases = Vec::new();
    for (name, edit) in [
        ("robot.json", "s/\"mass\": /&1/"),
        ("study.json", "s/\"observations\": 20/\"observations\": 10/"),
        ("study.json", "s/\"payload\": 50/\"payload\": 5/"),
        ("summary.json", "0,/\"mean\": /s//&1/"),
        ("surface_E_rho.csv", "s/0,/1,/"),
    ] {
        let (what, change) = (format!("{name} was edited"), format!("sed -i '{edit}' out/{name}"));
        cases.push(changed(&what, &change, "study report out", false));
        if ["robot.json", "study.json"].contains(&name) {
            cases.push(changed(&what, &change, "study merge out", false));
            cases.push(changed(&what, &change, "study status out", false));
        }
    }
    cases
}

fn reports_over_files() -> Vec<Case> {
    let names =
        ["study.json", "robot.json", "summary.json", "mechanical.csv", "mechanical.svg", "cdpr-results.json"];
    let over = |folder: &str, name: &str| {
        changed("a report over another file", ":", &format!("study report out --out {folder}/{name}"), false)
    };
    names.iter().flat_map(|name| ["out", DONE].map(|folder| over(folder, name))).collect()
}

/// Names of results that the user has taken already.
fn files_of_the_user() -> Vec<Case> {
    let own = |name: &str| format!("mkdir out; printf mine >out/{name}");
    let mut cases = Vec::new();
    for name in
        ["report.html", "summary.json", "mechanical.csv", "mechanical_effects.svg", "robot.svg", "study.json"]
    {
        for option in ["", " --overwrite", " --resume", " --shard 1/1"] {
            cases.push(case("the user's own file", own(name), "", &format!("{RUN}{option}"), false));
        }
    }
    for name in ["workspace.csv", "workspace.json", "deflection.svg"] {
        let command = "workspace robot.json --region=0:0:1,0:0:1,1.75:1.75:1 --out out";
        cases.push(case("the user's own file", own(name), "", command, false));
    }
    cases
}

/// Paths whose bytes are no text.
fn paths_that_are_no_text() -> Vec<Case> {
    let what = "a path that is not UTF-8";
    let made = [
        "study run study.json --out out/\u{fffd} --shard 1/1 --format json",
        "study run study.json --out out/\u{fffd}",
        "workspace robot.json --region=0:0:1,0:0:1,1.75:1.75:1 --out out/\u{fffd} --format json",
        "study new robot.json --out out/\u{fffd}.json",
        "study run study.json --out out\u{fffd}/\u{fffd}/\u{fffd}",
    ];
    let made = made.map(|command| {
        let last = command.contains("/\u{fffd}/");
        case(what, "mkdir out".to_owned(), "", if last { "check \u{fffd}" } else { command }, !last)
    });
    let read = [
        "study status \u{fffd}",
        "report \u{fffd} --format json",
        "inverse robot.json --pose \u{fffd}",
        "\u{fffd}",
    ];
    let read = read.map(|command| case(what, ":".to_owned(), "", command, false));
    made.into_iter().chain(read).collect()
}

/// A full disk, two runs at once, and a run that is ended.
fn disturbed_runs() -> Vec<Case> {
    let printed = [
        "--help",
        "--version",
        "study run --help",
        "robot check robot.json",
        "inverse robot.json --pose 0,0,1.75",
    ];
    let full = "exec \"$0\" \"$@\" >/dev/full";
    let mut cases: Vec<Case> = printed
        .map(|command| case("a full disk behind the standard output", ":".to_owned(), full, command, false))
        .into();
    let both = "\"$0\" \"$@\" & \"$0\" \"$@\"; code=$?; wait; exit $code";
    let writers = writers();
    for command in [&writers[0], &writers[1], &writers[3], &writers[4], &writers[5]] {
        cases.push(case("two at once", format!("cp -r {DONE} out"), both, command, true));
    }
    cases.push(case("two at once", "mkdir out".to_owned(), both, RUN, true));
    let ended = "\"$0\" \"$@\" & sleep 0.5; kill -TERM $!; wait $!";
    let long = format!("{RUN} --observations 10000000");
    cases.push(case("the end of a job", ":".to_owned(), ended, &long, false));
    cases
}
