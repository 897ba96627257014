//! Long commands in a terminal of their own: they show how long they take, and end when it is closed.

use crate::common::{Bench, cdpr_in, data_path, text, unwrapped};
use serde_json::json;
use std::io::{BufReader, Bytes, Read};
use std::path::Path;
use std::process::{Child, ChildStdout, Command, Stdio};
use std::time::{Duration, Instant};

/// What a command may take that is about to begin or to end: far more than it takes.
const PATIENCE: Duration = Duration::from_secs(60);

/// Waits until something holds.
fn eventually(holds: impl Fn() -> bool) -> bool {
    let clock = Instant::now();
    while !holds() {
        if clock.elapsed() > PATIENCE {
            return false;
        }
        std::thread::sleep(Duration::from_millis(10));
    }
    true
}

/// A terminal with `cdpr ...` in it, where signals do what they do by default, whoever runs the tests.
struct Terminal {
    script: Child,
    bytes: Bytes<BufReader<ChildStdout>>,
    seen: String,
    /// The process of `cdpr`.
    process: u32,
}

impl Terminal {
    fn open(folder: &Path, command: &str) -> Self {
        let program = env!("CARGO_BIN_EXE_cdpr");
        let signals = "--default-signal=HUP,INT,TERM";
        let command = format!("echo process $$; exec env {signals} {program} {command}");
        let mut script = Command::new("script");
        script.args(["--quiet", "--flush", "--return", "--command", &command, "/dev/null"]);
        script.env("SHELL", "/bin/sh").current_dir(folder);
        let mut script = script.stdin(Stdio::null()).stdout(Stdio::piped()).spawn().unwrap();
        let bytes = BufReader::new(script.stdout.take().unwrap()).bytes();
        let mut terminal = Self { script, bytes, seen: String::new(), process: 0 };
        terminal.read_until("\n");
        terminal.process = terminal.seen.trim().strip_prefix("process ").unwrap().parse().unwrap();
        terminal
    }

    /// Reads what is shown up to these words.
    fn read_until(&mut self, words: &str) {
        while !self.seen.contains(words) {
            self.seen.push(char::from(self.bytes.next().unwrap().unwrap()));
        }
    }

    /// Whether the process computes: one that ended may wait to be looked at.
    fn is_running(&self) -> bool {
        let state = std::fs::read_to_string(format!("/proc/{}/stat", self.process)).unwrap_or_default();
        state.rsplit_once(") ").is_some_and(|(_, rest)| !rest.starts_with(['Z', 'X']))
    }

    /// Closes the terminal and waits for the end of the process.
    fn close(mut self) {
        self.script.kill().unwrap();
        self.script.wait().unwrap();
        let has_ended = eventually(|| !self.is_running());
        if !has_ended {
            signal("KILL", self.process);
        }
        assert!(has_ended, "it outlives its terminal; it showed {}", self.seen);
    }
}

fn signal(name: &str, process: u32) {
    // The process may have ended.
    let _ = Command::new("kill").args([&format!("-{name}"), &process.to_string()]).output();
}

/// CAROCA and a study of many blocks, of few inputs: their rows are made fast.
fn bench(observations: usize) -> Bench {
    Bench::new("caroca.json", |study| {
        for model in study["error_models"].as_object_mut().unwrap().values_mut() {
            let model = model.as_object_mut().unwrap();
            model.retain(|name, _| ["mass", "youngs_modulus", "cog"].contains(&name.as_str()));
        }
        study["samplings"].as_object_mut().unwrap().retain(|name, _| name == "mechanical");
        study["samplings"]["mechanical"]["observations"] = json!(observations);
        study["replicates"] = json!(2);
        study.as_object_mut().unwrap().remove("surfaces");
    })
}

/// Whether a run has blocks on disk.
fn has_blocks(out: &Path) -> bool {
    let mut folders = vec![out.join("blocks")];
    while let Some(folder) = folders.pop() {
        for path in std::fs::read_dir(folder).into_iter().flatten().map(|entry| entry.unwrap().path()) {
            match path.is_dir() {
                true => folders.push(path),
                false => return true,
            }
        }
    }
    false
}

#[test]
fn a_long_search_shows_its_time_after_a_second_and_ends_with_its_terminal() {
    let study = data_path("studies/caroca.json");
    let of = "--sampling mechanical --limit 'deflection_mm<1.4' --observations 16777216";
    let mut terminal = Terminal::open(Path::new("."), &format!("study tolerances {study} {of}"));
    terminal.read_until("looking for the tolerances, 1 s");
    assert!(terminal.is_running());
    terminal.close();
}

#[test]
fn a_map_ends_with_its_terminal_and_leaves_no_half_result() {
    let folder = tempfile::tempdir().unwrap();
    let command = "workspace caroca --region ::150,::150,::100 --payload 50 --with capacity --out map";
    let mut terminal = Terminal::open(folder.path(), command);
    terminal.read_until(" poses, ");
    terminal.close();
    assert!(!folder.path().join("map/workspace.json").exists());
}

/// The message of a run has no terminal any more, and must not keep it from ending.
#[test]
fn a_run_ends_with_its_terminal_and_keeps_its_blocks() {
    let bench = bench(2_000_000);
    let out = bench.path("out");
    let folder = out.parent().unwrap().to_owned();
    let terminal = Terminal::open(&folder, "study run study.json --out out --threads 2");
    assert!(eventually(|| has_blocks(&out)));
    assert!(terminal.is_running());
    terminal.close();
    assert!(has_blocks(&out) && !out.join("summary.json").exists());
}

/// As `nohup` starts it.
#[test]
fn a_run_that_is_to_outlive_its_terminal_ends_by_itself() {
    let bench = bench(40_000);
    let ignoring = "trap '' HUP; exec \"$0\" study run study.json --out out --threads 1";
    let mut command = bench.command("bash");
    let command = command.args(["-c", ignoring, env!("CARGO_BIN_EXE_cdpr")]);
    let child = command.stdout(Stdio::null()).stderr(Stdio::piped()).spawn().unwrap();
    let (out, process) = (bench.path("out"), child.id());
    assert!(eventually(|| has_blocks(&out)));
    signal("HUP", process);
    let output = child.wait_with_output().unwrap();
    assert_eq!(output.status.code(), Some(0), "{}", unwrapped(output.stderr));
    assert!(out.join("summary.json").exists());
}

/// A reader has the sentence first and a table of few columns; programs have all columns, the sentence apart.
#[test]
fn many_poses_are_a_sentence_and_a_short_table_in_a_terminal_and_all_columns_in_a_pipe_and_a_file() {
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(folder.path().join("poses.csv"), "x,y,z\n0,0,2\n0,0,50\n0,0,40\n").unwrap();
    let sentence = "1 of 3 poses held; 2 without feasible tensions, first at line 3.";
    let load = ["--payload", "10"];
    for (command, load) in [
        ("inverse", &[][..]),
        ("deflection", &load),
        ("stiffness", &[]),
        ("modes", &[]),
        ("path", &load),
        ("capacity", &[]),
        ("safety", &[]),
        ("derivatives", &load),
    ] {
        let call = [&[command, "caroca", "--poses", "poses.csv"], load].concat();
        let mut terminal = Terminal::open(folder.path(), &call.join(" "));
        terminal.read_until("--format csv.");
        // What the terminal was sent as bytes is text again.
        let seen: Vec<u8> = terminal.seen.chars().map(|byte| byte as u8).collect();
        let seen = String::from_utf8(seen).unwrap();
        terminal.close();
        assert!(seen.contains(sentence) && seen.contains("line 3: at position (0, 0, 50) m: "), "{seen}");
        assert!(!seen.contains("x_m,"), "{seen}");
        for line in seen.lines() {
            // What is behind the bar of progress, which the terminal has cleared.
            let line = line.rsplit('\u{1b}').next().unwrap();
            let line = line.strip_prefix("[1A").unwrap_or(line);
            // A note may be behind a bar that is seen already.
            let behind = line.find('░').and_then(|_| line.find("note: "));
            let line = behind.map_or(line, |at| &line[at..]);
            assert!(line.trim_end().chars().count() <= 80, "{command}: {line}");
        }
        let piped = cdpr_in(folder.path(), &call);
        assert!(text(piped.stdout).starts_with("x_m,y_m,z_m,qw,qx,qy,qz,status,"), "{command}");
        assert!(unwrapped(piped.stderr).contains(sentence), "{command}");
        let quiet = cdpr_in(folder.path(), &[&call[..], &["-q"]].concat());
        assert!(!unwrapped(quiet.stderr).contains("poses held"), "{command}");
        let filed = cdpr_in(folder.path(), &[&call[..], &["--out", "all.csv", "--overwrite"]].concat());
        assert!(text(filed.stdout).replace('\n', " ").starts_with(sentence), "{command}");
        let all = std::fs::read_to_string(folder.path().join("all.csv")).unwrap();
        assert!(all.starts_with("x_m,y_m,z_m,") && all.lines().count() == 4, "{command}: {all}");
    }
}
