//! The cases of folders: a stranger's, one with the user's own files, one that was edited, one that several
//! processes want.

use super::case::{Case, MINE, split};
use std::fs;
use std::io;
use std::path::Path;
use std::process::{Command, Stdio};

/// A folder of results, of which each case gets a copy.
const DONE: &str = "done";

/// Makes a folder of results, and files of the user beside it.
pub(super) fn prepare(folder: &Path, program: &Path) -> io::Result<()> {
    let mut command = Command::new(program);
    command.args(split("study run study.json --table csv --out")).arg(DONE).current_dir(folder);
    if !command.stdout(Stdio::null()).status()?.success() {
        return Err(io::Error::other("the study of the attack cannot be run"));
    }
    fs::create_dir(folder.join("victim"))?;
    ["victim/2024.csv", "victim/0000.csv"].iter().try_for_each(|name| fs::write(folder.join(name), MINE))
}

/// All cases.
pub(super) fn all() -> Vec<Case> {
    let mut cases = Vec::new();
    let mut push = |what: &str, change: &str, command: &str, may_succeed: bool| {
        let shell = Some(format!("cp -r {DONE} out; {change}"));
        cases.push(Case {
            what: what.to_owned(),
            shell,
            arguments: split(command),
            may_succeed,
            ..Case::default()
        });
    };
    const RUN: &str = "study run study.json --table csv --out out";
    let writers =
        ["--overwrite", "--resume", "--shard 1/1"].map(|option| format!("{RUN} {option}")).into_iter();
    let writers: Vec<_> = writers
        .chain(["study merge out", "study extend out --observations 40", "report out"].map(str::to_owned))
        .collect();
    for (what, change) in [
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
    ] {
        writers.iter().for_each(|command| push(what, change, command, true));
    }
    for name in
        ["../victim.csv", "../victim/2024.csv", "/etc/passwd.csv", "a/../../victim.csv", "blocks/0000.csv"]
    {
        let list =
            format!("{{\"format\":\"cdpr-results/1\",\"of\":\"study\",\"files\":{{\"{name}\":null}}}}");
        let change = format!("echo '{list}' >out/cdpr-results.json");
        writers.iter().for_each(|command| push("a list of files outside", &change, command, false));
    }
    for name in [
        "study.json",
        "robot.json",
        "summary.json",
        "timings.json",
        "cdpr-results.json",
        "cdpr-results.lock",
        "mechanical.csv",
        "surface_E_rho.csv",
        "blocks/mechanical/sampling/000000.block",
    ] {
        for (what, made) in [("a pipe", "mkfifo"), ("a device that never ends", "ln -s /dev/zero")] {
            let change = format!("rm out/{name}; {made} out/{name}");
            for command in [&writers[1], &writers[3], &writers[5], "study status out"] {
                push(&format!("{name} is {what}"), &change, command, true);
            }
        }
    }
    for (name, edit) in [
        ("robot.json", "s/\"mass\": /&1/"),
        ("study.json", "s/\"observations\": 20/\"observations\": 10/"),
        ("study.json", "s/\"payload\": 50/\"payload\": 5/"),
        ("summary.json", "0,/\"mean\": /s//&1/"),
        ("surface_E_rho.csv", "s/0,/1,/"),
    ] {
        let change = format!("sed -i '{edit}' out/{name}");
        push(&format!("{name} was edited"), &change, "report out", false);
        if ["robot.json", "study.json"].contains(&name) {
            push(&format!("{name} was edited"), &change, "study merge out", false);
            push(&format!("{name} was edited"), &change, "study status out", false);
        }
    }
    for name in
        ["study.json", "robot.json", "summary.json", "mechanical.csv", "mechanical.svg", "cdpr-results.json"]
    {
        push("a report over another file", ":", &format!("report out --out out/{name}"), false);
        push("a report over another file", ":", &format!("report out --out {DONE}/{name}"), false);
    }
    let mut push = |what: &str, shell: &str, around: &'static str, command: &str, may_succeed: bool| {
        let (what, shell) = (what.to_owned(), Some(shell.to_owned()));
        cases.push(Case { what, shell, around, arguments: split(command), may_succeed, ..Case::default() });
    };
    for name in
        ["report.html", "summary.json", "mechanical.csv", "mechanical_effects.svg", "robot.svg", "study.json"]
    {
        let own = format!("mkdir out; printf mine >out/{name}");
        for option in ["", " --overwrite", " --resume", " --shard 1/1"] {
            push("the user's own file", &own, "", &format!("{RUN}{option}"), false);
        }
    }
    for name in ["workspace.csv", "workspace.json", "deflection.svg"] {
        let own = format!("mkdir out; printf mine >out/{name}");
        push(
            "the user's own file",
            &own,
            "",
            "workspace robot.json --box=0:0:1,0:0:1,1.75:1.75:1 --out out",
            false,
        );
    }
    // The bytes of a path are no text.
    for command in [
        "study run study.json --out out/\u{fffd} --shard 1/1 --format json",
        "study run study.json --out out/\u{fffd}",
        "workspace robot.json --box=0:0:1,0:0:1,1.75:1.75:1 --out out/\u{fffd} --format json",
        "study new --robot robot.json --out out/\u{fffd}.json",
        "study run study.json --out out\u{fffd}/\u{fffd}/\u{fffd}",
    ] {
        let last = command.contains("/\u{fffd}/");
        push(
            "a path that is not UTF-8",
            "mkdir out",
            "",
            if last { "check \u{fffd}" } else { command },
            !last,
        );
    }
    for command in [
        "study status \u{fffd}",
        "report \u{fffd} --format json",
        "inverse robot.json --pose \u{fffd}",
        "\u{fffd}",
    ] {
        push("a path that is not UTF-8", ":", "", command, false);
    }
    for command in
        ["--help", "--version", "study run --help", "check robot.json", "inverse robot.json --pose 0,0,1.75"]
    {
        push("a full disk behind the standard output", ":", "exec \"$0\" \"$@\" >/dev/full", command, false);
    }
    let both = "\"$0\" \"$@\" & \"$0\" \"$@\"; code=$?; wait; exit $code";
    for command in [&writers[0], &writers[1], &writers[3], &writers[4], &writers[5]] {
        push("two at once", &format!("cp -r {DONE} out"), both, command, true);
    }
    push("two at once", "mkdir out", both, RUN, true);
    let ended = "\"$0\" \"$@\" & sleep 0.5; kill -TERM $!; wait $!";
    push("the end of a job", ":", ended, &format!("{RUN} --observations 10000000"), false);
    cases
}
