//! Every operation on the disk fails once, or the process ends before or after it: the program says so,
//! nothing of the user is lost, nothing is mixed, and the command that goes on ends with the bytes of one
//! without a fault. The seam is `crates/cdpr-study/src/fs/disk.rs`.

use crate::common::{Bench, Files, data_path, unwrapped};
use serde_json::{Value, json};
use std::path::Path;
use std::process::Output;

/// Exit code of a process that a fault has ended.
const DIED: i32 = 86;

/// The last files of a run: beside one of them, all others are whole and of the same run.
const CONCLUSIONS: [&str; 2] = ["summary.json", "workspace.json"];

/// A small study: a sampling at one pose, one at a list of one, with tables, and a surface.
fn bench() -> Bench {
    Bench::new("caroca-poses.json", |study| {
        let model = study["error_models"]["table_4"].as_object_mut().unwrap();
        model.retain(|name, _| ["mass", "youngs_modulus"].contains(&name.as_str()));
        let pose = json!({"position": [0.0, 0.0, 1.75]});
        let plane = &mut study["samplings"]["plane"];
        plane["observations"] = json!(3);
        let mut alone = plane.clone();
        plane["poses"] = json!({"list": [pose]});
        alone.as_object_mut().unwrap().remove("poses");
        alone["pose"] = pose.clone();
        study["samplings"]["alone"] = alone;
        (study["replicates"], study["bootstrap_resamples"]) = (json!(0), json!(1));
        let axis =
            |parameter: &str, to: f64| json!({"parameter": parameter, "min": -to, "max": to, "points": 2});
        let (x, y) = (axis("mass", 1.0), axis("linear_density", 0.01));
        study["surfaces"] = json!({"sheet": {"title": "Sheet", "pose": pose, "x": x, "y": y}});
    })
}

/// A command in the folder `out` of a bench, and the one that goes on after a fault in it.
struct Trial<'a> {
    bench: &'a Bench,
    command: &'a [&'a str],
    again: &'a [&'a str],
    /// Whether unfinished files of a killed process may stay: others may be writing beside it, or the folder
    /// is no folder of results.
    leaves_unfinished: bool,
}

impl<'a> Trial<'a> {
    fn new(bench: &'a Bench, command: &'a [&'a str], again: &'a [&'a str]) -> Self {
        Self { bench, command, again, leaves_unfinished: false }
    }

    fn leaving_unfinished(self) -> Self {
        Self { leaves_unfinished: true, ..self }
    }

    fn run(&self, arguments: &[&str], fault: &str) -> Output {
        let mut command = self.bench.command(env!("CARGO_BIN_EXE_cdpr"));
        command.args(arguments).env("CDPR_TEST_FAULT", fault).output().unwrap()
    }

    fn done(&self, arguments: &[&str], what: &str) {
        let output = self.run(arguments, "");
        assert!(output.status.success(), "{what}: {arguments:?}: {}", unwrapped(output.stderr));
    }

    /// Lets each operation of the command fail in turn; returns how many there are.
    fn at_every_operation(&self) -> usize {
        let out = self.bench.path("out");
        let given = files(&out);
        let before = without_times(given.clone());
        let mine: Vec<_> = before.iter().filter(|(_, content)| *content == b"mine").collect();
        self.done(self.command, "without a fault");
        let after = without_times(files(&out));
        for number in 0.. {
            // The program does not tell errors of the system apart.
            let error = ["EIO", "ENOSPC"][number % 2];
            let mut operation = String::new();
            for fault in [error, "before", "after"] {
                // What a process leaves after an operation is what it leaves before the next one.
                if fault == "after" && !["rename", "unlink"].contains(&operation.as_str()) {
                    continue;
                }
                if out.exists() {
                    std::fs::remove_dir_all(&out).unwrap();
                }
                put(&given, &out);
                let ended = self.run(self.command, &format!("{number} {fault}"));
                let message = unwrapped(ended.stderr);
                let Some(what) = message.lines().find(|line| line.starts_with("fault: ")) else {
                    assert!(ended.status.success() && fault == error, "{number} {fault}: {message}");
                    assert!(unlike(&after, &without_times(files(&out))).is_none());
                    return number;
                };
                operation = what.split(' ').nth(4).unwrap().to_owned();
                let told = if fault == error { (1, "error: ") } else { (DIED, "") };
                assert!(ended.status.code() == Some(told.0) && message.contains(told.1), "{message}");
                let left = without_times(files(&out));
                for (name, content) in &mine {
                    assert_eq!(left.get(*name), Some(*content), "{what}");
                }
                if let Some(name) = CONCLUSIONS.iter().find(|name| left.contains_key(**name)) {
                    let is_of = |whole: &&Files| whole.get(*name) == left.get(*name);
                    let wholes: Vec<_> = [&after, &before].into_iter().filter(is_of).collect();
                    assert!(!wholes.is_empty(), "{what}: {name} of no run");
                    let unlike: Vec<_> = wholes.iter().map(|whole| unlike(whole, &left)).collect();
                    assert!(unlike.contains(&None), "{what}: {unlike:?} beside {name}");
                }
                let resumed = self.run(self.again, "");
                let message = unwrapped(resumed.stderr);
                if message.contains("--overwrite what is there") {
                    self.done(self.command, what);
                } else if message.contains("File exists") {
                    // A template is not written over.
                    assert!(unlike(&after, &left).is_none(), "{what}");
                } else {
                    assert!(resumed.status.success(), "{what}: {message}");
                }
                let mut resumed = without_times(files(&out));
                if self.leaves_unfinished {
                    resumed.retain(|name, _| !name.ends_with(".tmp"));
                }
                assert_eq!(resumed.keys().collect::<Vec<_>>(), after.keys().collect::<Vec<_>>(), "{what}");
                assert_eq!(list(&resumed), list(&after), "{what}");
                let unlike = unlike(&after, &resumed);
                assert!(unlike.is_none(), "{what}: {unlike:?}");
            }
        }
        unreachable!("the numbers do not end")
    }
}

/// All files below a folder.
fn files(out: &Path) -> Files {
    let (mut folders, mut files) = (vec![out.to_owned()], Files::new());
    while let Some(folder) = folders.pop() {
        for path in std::fs::read_dir(&folder).into_iter().flatten().map(|entry| entry.unwrap().path()) {
            if path.is_dir() {
                folders.push(path);
            } else {
                let name = path.strip_prefix(out).unwrap().to_str().unwrap().to_owned();
                files.insert(name, std::fs::read(&path).unwrap());
            }
        }
    }
    files
}

/// The files without the times in them, each of them whole.
fn without_times(mut files: Files) -> Files {
    for (name, end) in [("timings.json", "}"), ("report.html", "</html>")] {
        files.entry(name.to_owned()).and_modify(|content| {
            assert!(content.trim_ascii_end().ends_with(end.as_bytes()), "{name} is not whole");
            *content = b"with times".to_vec();
        });
    }
    files.entry("robustness.json".to_owned()).and_modify(|content| {
        let mut summary = serde_json::from_slice(content).unwrap();
        remove_times(&mut summary);
        *content = summary.to_string().into_bytes();
    });
    files.entry("cdpr-results.json".to_owned()).and_modify(|content| {
        let mut list: Value = serde_json::from_slice(content).unwrap();
        let timed = |name: &str| ["robustness.json", "solves.csv"].contains(&name);
        let digests = list["files"].as_object_mut().unwrap().iter_mut();
        digests.filter(|(name, _)| timed(name)).for_each(|(_, digest)| *digest = json!("of times"));
        *content = list.to_string().into_bytes();
    });
    // The last column is the wall time.
    files.entry("solves.csv".to_owned()).and_modify(|content| {
        let table = String::from_utf8(std::mem::take(content)).unwrap();
        let lines = table.lines().map(|line| line.rsplit_once(',').unwrap().0);
        *content = lines.collect::<Vec<_>>().join("\n").into_bytes();
    });
    files
}

fn remove_times(value: &mut Value) {
    if let Some(map) = value.as_object_mut() {
        map.remove("microseconds");
        map.values_mut().for_each(remove_times);
    }
    value.as_array_mut().into_iter().flatten().for_each(remove_times);
}

fn put(files: &Files, out: &Path) {
    for (name, content) in files {
        let path = out.join(name);
        std::fs::create_dir_all(path.parent().unwrap()).unwrap();
        std::fs::write(path, content).unwrap();
    }
}

/// A file in which the results differ; the list of files and the report may differ where a run was ended.
fn unlike<'a>(one: &'a Files, other: &'a Files) -> Option<&'a String> {
    let is_result = |name: &&String| {
        let apart = ["cdpr-results.json", "cdpr-results.lock", "report.html", "timings.json"];
        !apart.contains(&name.as_str()) && !name.ends_with(".tmp")
    };
    one.keys().chain(other.keys()).filter(is_result).find(|name| one.get(*name) != other.get(*name))
}

fn list(files: &Files) -> Option<&str> {
    files.get("cdpr-results.json").map(|list| std::str::from_utf8(list).unwrap())
}

const RUN: [&str; 7] = ["study", "run", "study.json", "--out", "out", "--table", "csv"];
const RESUME: [&str; 8] = ["study", "run", "study.json", "--out", "out", "--table", "csv", "--resume"];

/// A bench with results, and files of the user among them.
fn with_results() -> Bench {
    let bench = bench();
    bench.done(&RUN[1..]);
    for name in ["mine.csv", "plane/2024.csv", "blocks/mine.txt", "blocks/alone/mine.block"] {
        put(&[(name.to_owned(), b"mine".to_vec())].into(), &bench.path("out"));
    }
    bench
}

#[test]
fn a_first_run_that_fails_or_dies_at_any_operation_is_told_and_resumed_to_the_same_bytes() {
    let bench = bench();
    let operations = Trial::new(&bench, &RUN, &RESUME).at_every_operation();
    assert!(operations > 100, "{operations}");
}

#[test]
fn a_run_that_overwrites_another_and_fails_or_dies_at_any_operation_loses_and_mixes_nothing() {
    let bench = with_results();
    bench.change("study.json", |study| study["payload"] = json!(60.0));
    let command = [&RUN[..], &["--overwrite"]].concat();
    let operations = Trial::new(&bench, &command, &RESUME).at_every_operation();
    assert!(operations > 100, "{operations}");
}

#[test]
fn a_larger_study_that_fails_or_dies_at_any_operation_goes_on_with_the_blocks_of_the_smaller() {
    let bench = with_results();
    bench.change("study.json", |study| {
        study["samplings"]["plane"]["observations"] = json!(4);
        study["samplings"]["further"] = study["samplings"]["alone"].clone();
    });
    let operations = Trial::new(&bench, &RESUME, &RESUME).at_every_operation();
    assert!(operations > 100, "{operations}");
}

#[test]
fn a_shard_and_a_merge_that_fail_or_die_at_any_operation_are_done_again_to_the_same_bytes() {
    let bench = bench();
    let shard = |shard| [&RUN[..5], &["--shard", shard]].concat();
    let first = shard("1/2");
    let operations = Trial::new(&bench, &first, &first).leaving_unfinished().at_every_operation();
    assert!(operations > 25, "{operations}");
    let second = shard("2/2");
    let operations = Trial::new(&bench, &second, &second).leaving_unfinished().at_every_operation();
    assert!(operations > 5, "{operations}");
    let merge = ["study", "merge", "out", "--table", "csv"];
    let operations = Trial::new(&bench, &merge, &merge).at_every_operation();
    assert!(operations > 60, "{operations}");
}

#[test]
fn an_extension_that_fails_or_dies_at_any_operation_is_done_again_to_the_same_bytes() {
    let bench = with_results();
    let extend = ["study", "extend", "out", "--observations", "5", "--table", "csv"];
    let operations = Trial::new(&bench, &extend, &extend).at_every_operation();
    assert!(operations > 80, "{operations}");
}

#[test]
fn a_report_that_fails_or_dies_at_any_operation_is_written_again() {
    let bench = with_results();
    for command in [&["study", "report", "out"][..], &["study", "report", "out", "--out", "out/mine.html"]] {
        let operations = Trial::new(&bench, command, command).leaving_unfinished().at_every_operation();
        assert!(operations > 4, "{operations}");
    }
}

#[test]
fn a_workspace_that_fails_or_dies_at_any_operation_is_made_again_to_the_same_bytes() {
    let bench = bench();
    let workspace = ["workspace", "robot.json", "--region=0:0.1:2,0:0.1:2,1.75:1.75:1", "--out", "out"];
    let loaded = [&workspace[..], &["--payload", "50"]].concat();
    let again = [&loaded[..], &["--overwrite"]].concat();
    let operations = Trial::new(&bench, &loaded, &again).at_every_operation();
    assert!(operations > 25, "{operations}");
    // Over the maps of the load.
    let workspace = [&workspace[..], &["--overwrite"]].concat();
    put(&[("mine.csv".to_owned(), b"mine".to_vec())].into(), &bench.path("out"));
    let operations = Trial::new(&bench, &workspace, &workspace).at_every_operation();
    assert!(operations > 25, "{operations}");
}

#[test]
fn a_template_a_law_and_a_figure_are_whole_or_absent() {
    let bench = bench();
    let record = data_path("cables/caroca-4mm-record.csv");
    let new = ["study", "new", "robot.json", "--out", "out/new.json"];
    let modulus = [
        "cable",
        "modulus",
        &record,
        "--breaking-force",
        "10290",
        "--section",
        "1.2566370614e-5",
        "--length",
    ];
    let law = [&modulus[..], &["1", "--range", "5-10", "--law", "out/law.json"]].concat();
    put(&[("mine.csv".to_owned(), b"mine".to_vec())].into(), &bench.path("out"));
    for command in [&new[..], &law] {
        let operations = Trial::new(&bench, command, command).leaving_unfinished().at_every_operation();
        assert!(operations > 4, "{operations}");
    }
}
