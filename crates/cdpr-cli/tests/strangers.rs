//! Careless users and strangers' files: what they hold is shown and not obeyed, and nothing hangs or panics.

use crate::common::{Bench, answered, data_path, text};
use serde_json::json;
use std::fs::File;
use std::process::Command;

fn cdpr() -> Command {
    Command::new(env!("CARGO_BIN_EXE_cdpr"))
}

#[test]
fn a_name_neither_moves_the_cursor_nor_adds_a_line_and_json_keeps_it() {
    let bench = Bench::new("caroca.json", |_| ());
    let name = "\u{1b}[31m\u{202e}CAROCA\nproved: exact";
    bench.change("robot.json", |robot| robot["name"] = json!(name));
    let robot = bench.path("robot.json");
    let inverse = |format: &str| {
        let arguments = ["--pose", "0,0,1.75", "--format", format];
        answered(cdpr().arg("inverse").arg(&robot).args(arguments).output().unwrap())
    };
    let table = inverse("text");
    assert!(table.starts_with("\\u001b[31m\\u202eCAROCA\\u000aproved: exact at (0, 0, 1.75) m\n"), "{table}");
    bench.change("study.json", |study| {
        study["samplings"] = json!({});
        study["comparison"] = json!([]);
        study["surfaces"].as_object_mut().unwrap().values_mut().for_each(|surface| {
            surface["x"]["points"] = json!(3);
            surface["y"]["points"] = json!(3);
        });
    });
    let json = bench.run("out", &["--format", "json"]);
    assert!(json.is_ascii() || !json.contains('\u{202e}'), "{json}");
    assert_eq!(serde_json::from_str::<serde_json::Value>(&json).unwrap()["robot"], json!(name));
}

#[cfg(unix)]
#[test]
fn a_pipe_that_nobody_writes_into_is_refused_at_once() {
    let bench = Bench::new("caroca.json", |_| ());
    let pipe = bench.path("pipe");
    assert!(Command::new("mkfifo").arg(&pipe).status().unwrap().success());
    let robot = data_path("robots/caroca.json");
    for arguments in [
        &["check", "pipe"][..],
        &["study", "run", "pipe"],
        &["direct", &robot, "--from", "pipe"],
        &[
            "modulus",
            "pipe",
            "--breaking-force",
            "1e4",
            "--section",
            "1e-5",
            "--length",
            "1",
            "--range",
            "5-10",
        ],
        &["hysteresis", &robot, "--law", "pipe", "--pose", "0,0,1.75", "--payload", "50"],
        &["calibration", &robot, "--poses", "pipe", "--uncertainty", "a=0.002", "--noise", "lengths=0.001"],
    ] {
        let output = bench.command(env!("CARGO_BIN_EXE_cdpr")).args(arguments).output().unwrap();
        let error = text(output.stderr);
        assert_eq!(output.status.code(), Some(1), "{error}");
        assert!(error.contains("pipe is a pipe: expected a"), "{error}");
    }
}

#[cfg(unix)]
#[test]
fn links_in_a_circle_among_the_blocks_are_not_followed() {
    let bench = Bench::new("caroca.json", |study| {
        study["samplings"].as_object_mut().unwrap().retain(|name, _| name == "mechanical");
        study["samplings"]["mechanical"]["observations"] = json!(50);
        study["replicates"] = json!(0);
        study["surfaces"] = json!({});
        study["comparison"] = json!([]);
    });
    bench.run("out", &[]);
    for name in ["a", "b"] {
        std::os::unix::fs::symlink(bench.path("out/blocks"), bench.path("out/blocks").join(name)).unwrap();
    }
    let refused = bench.refused(&["run", "study.json", "--out", "out"]);
    assert!(refused.contains("holds 1 blocks of this study"), "{refused}");
    bench.run("out", &["--resume"]);
}

#[cfg(unix)]
#[test]
fn paths_that_are_not_utf_8_cause_no_panic() {
    use std::os::unix::ffi::OsStrExt;
    let bench = Bench::new("caroca.json", |study| {
        study["samplings"].as_object_mut().unwrap().retain(|name, _| name == "mechanical");
        study["samplings"]["mechanical"]["observations"] = json!(50);
        study["replicates"] = json!(0);
        study["surfaces"] = json!({});
        study["comparison"] = json!([]);
    });
    let out = std::ffi::OsStr::from_bytes(b"out\xff");
    let run = |arguments: &[&str]| {
        let mut command = bench.study_command(arguments);
        text(command.arg("--out").arg(out).args(["--format", "json"]).output().unwrap().stdout)
    };
    assert!(run(&["run", "study.json", "--shard", "1/1"]).contains("out\u{fffd}"));
    assert!(run(&["run", "study.json", "--resume"]).contains("mechanical"));
    let block = bench.path("").join(out).join("blocks/mechanical/sampling/000000.block");
    std::fs::write(block, "damaged").unwrap();
    let status = bench.study_command(&["status", "--format", "json"]).arg(out).output().unwrap();
    assert!(text(status.stdout).contains("out\u{fffd}/blocks"));
}

#[cfg(target_os = "linux")]
#[test]
fn help_that_cannot_be_printed_is_a_failure() {
    for arguments in [&["--help"][..], &["--version"], &["study", "run", "--help"], &["help", "inverse"]] {
        let full = File::options().write(true).open("/dev/full").unwrap();
        let output = cdpr().args(arguments).stdout(full).output().unwrap();
        assert_eq!(output.status.code(), Some(1), "{arguments:?}");
        assert!(text(output.stderr).contains("cannot write to the standard output"));
    }
}
