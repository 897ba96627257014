//! Studies in blocks on disk: an interrupted, damaged or shared run ends with the results of one that is not.

use crate::common::{Bench, assert_same_files, cdpr, data, unwrapped};
use serde_json::{Value, json};
use std::path::PathBuf;
use std::process::{Command, Stdio};
use std::time::{Duration, Instant};

/// Observations of a block.
const BLOCK: usize = 16_384;

/// CAROCA and a study of two samplings, of several blocks each.
fn bench(observations: usize) -> Bench {
    Bench::new("caroca.json", |study| {
        study["replicates"] = json!(2);
        // Few inputs: scrambled rows of many would take longer than the mechanics.
        for model in study["error_models"].as_object_mut().unwrap().values_mut() {
            let model = model.as_object_mut().unwrap();
            model.retain(|name, _| ["mass", "youngs_modulus", "cog"].contains(&name.as_str()));
        }
        study["samplings"].as_object_mut().unwrap().remove("geometrical");
        study["surfaces"].as_object_mut().unwrap().remove("surface_rho_m");
        study["surfaces"]["surface_E_rho"]["x"]["points"] = json!(5);
        study["surfaces"]["surface_E_rho"]["y"]["points"] = json!(4);
        for sampling in study["samplings"].as_object_mut().unwrap().values_mut() {
            sampling["observations"] = json!(observations);
        }
    })
}

/// The same with measures of sensitivity: Morris's design in a block, Saltelli's in two.
fn bench_with_measures(observations: usize) -> Bench {
    let bench = bench(observations);
    bench.change("study.json", |study| {
        study["sensitivity"] = json!({
            "observations": 200, "saltelli_blocks": 2400, "bootstrap_resamples": 20, "morris_blocks": 16,
            "derivative_points": 8, "expansion": {"max_degree": 2, "norm": 1.0, "interactions": 2}
        });
    });
    bench
}

/// Checks that two folders hold the same results, tables and figures among them; blocks may differ.
fn assert_same(bench: &Bench, one: &str, other: &str) {
    let [one, other] = [one, other].map(|out| bench.results(out));
    for name in ["mechanical.csv", "mechanical.svg", "surface_E_rho.csv"] {
        assert!(one.contains_key(name), "{name}");
    }
    assert_same_files(&one, &other);
}

/// Blocks on disk.
fn block_files(bench: &Bench, out: &str) -> Vec<PathBuf> {
    let mut folders = vec![bench.path(out).join("blocks")];
    let mut blocks = Vec::new();
    while let Some(folder) = folders.pop() {
        for entry in std::fs::read_dir(folder).into_iter().flatten() {
            let path = entry.unwrap().path();
            if path.is_dir() { folders.push(path) } else { blocks.push(path) }
        }
    }
    blocks.sort();
    blocks
}

/// Pseudo-random numbers in 0 .. 1, the same in every run of the test (Marsaglia's xorshift).
struct Random(u64);

impl Random {
    fn next(&mut self) -> f64 {
        self.0 ^= self.0 << 13;
        self.0 ^= self.0 >> 7;
        self.0 ^= self.0 << 17;
        (self.0 >> 11) as f64 / (1_u64 << 53) as f64
    }
}

#[test]
fn a_study_killed_at_ten_random_moments_and_resumed_equals_one_that_was_not() {
    let bench = bench_with_measures(BLOCK + 1000);
    let clock = Instant::now();
    bench.run("whole", &["--threads", "2"]);
    let whole = clock.elapsed();
    let mut random = Random(2017);
    let (mut kills, mut finished) = (0, 0);
    let mut arguments = vec!["run", "study.json", "--out", "killed", "--threads", "1"];
    while kills < 10 {
        let mut child =
            bench.study_command(&arguments).stdout(Stdio::null()).stderr(Stdio::piped()).spawn().unwrap();
        // Early moments hit the blocks, late ones the analysis and what it writes.
        std::thread::sleep(Duration::from_secs_f64(1.2 * random.next() * whole.as_secs_f64()));
        child.kill().unwrap();
        let output = child.wait_with_output().unwrap();
        match output.status.code() {
            None => kills += 1,
            Some(code) => {
                assert_eq!(code, 0, "{}", unwrapped(output.stderr));
                finished += 1;
            }
        }
        if arguments.len() == 6 {
            arguments.push("--resume");
        }
    }
    println!("{kills} killed, {finished} finished before, {whole:.1?} a whole run");
    bench.run("killed", &["--resume", "--threads", "1"]);
    assert_same(&bench, "whole", "killed");
    // Of each sampling its own design, two replicates, Saltelli's and Morris's.
    assert_eq!(block_files(&bench, "whole").len(), 2 * (2 + 2 * 2 + 2 + 1));
    assert_eq!(
        block_files(&bench, "killed").len(),
        block_files(&bench, "whole").len(),
        "nothing unfinished is left"
    );
}

#[test]
fn three_shards_merged_equal_one_run_and_are_not_analysed_before_all_are_there() {
    let bench = bench_with_measures(BLOCK + 1000);
    bench.run("whole", &[]);
    let merge = ["merge", "shards"];
    // Two at once, in a folder that neither has made.
    let begin = |shard| {
        let mut command = bench.study_command(&["run", "study.json", "--out", "shards", "--shard", shard]);
        command.stdout(Stdio::null()).spawn().unwrap()
    };
    let children = ["3/3", "1/3"].map(begin);
    for mut child in children {
        assert!(child.wait().unwrap().success());
    }
    let message = bench.refused(&merge);
    assert!(
        message.starts_with("error: shards lacks 6 of 18 blocks, the first one shards/blocks/"),
        "{message}"
    );
    assert!(!bench.path("shards/summary.json").exists());
    let output = bench.study(&["status", "shards", "--format", "json"]);
    let status: Value = serde_json::from_slice(&output.stdout).unwrap();
    assert_eq!(status["complete"], false);
    let count = |key: &str| -> u64 {
        let samplings = status["samplings"].as_object().unwrap().values();
        let designs = samplings.flat_map(|sampling| sampling["designs"].as_object().unwrap().values());
        designs.map(|design| design[key].as_u64().unwrap()).sum()
    };
    assert_eq!((count("blocks_done"), count("blocks_missing")), (12, 6));
    // The last third, as a job array of Slurm has it.
    let mut command = bench.study_command(&["run", "study.json", "--out", "shards", "--shard", "auto/3"]);
    assert!(command.env("SLURM_ARRAY_TASK_ID", "2").output().unwrap().status.success());
    assert!(bench.done(&["status", "shards"]).contains("observations: cdpr study merge analyses it."));
    bench.done(&merge);
    assert!(bench.done(&["status", "shards"]).starts_with("Complete and analysed, "));
    assert_same(&bench, "whole", "shards");
    // A task that a scheduler runs again leaves what has been analysed as it is.
    bench.run("shards", &["--shard", "2/3"]);
    assert_same(&bench, "whole", "shards");
    // One that makes a block does not: the summary may be of another.
    std::fs::remove_file(&block_files(&bench, "shards")[0]).unwrap();
    for shard in ["1/3", "2/3", "3/3"] {
        bench.run("shards", &["--shard", shard]);
    }
    assert!(!bench.path("shards/summary.json").exists());
    let report = cdpr(&["study", "report", bench.path("shards").to_str().unwrap()]);
    assert_eq!(report.status.code(), Some(1));
    let message = unwrapped(report.stderr);
    assert!(message.contains("has no summary.json: analyse it with cdpr study merge"), "{message}");
    bench.done(&merge);
    assert_same(&bench, "whole", "shards");
}

#[test]
fn a_study_extended_twice_equals_one_run_of_its_last_size_and_keeps_its_blocks() {
    let bench = bench(500);
    bench.run("extended", &[]);
    bench.done(&["extend", "extended", "--observations", "16800"]);
    let first = bench.path("extended/blocks/mechanical/sampling/000000.block");
    let written = std::fs::metadata(&first).unwrap().modified().unwrap();
    bench.done(&["extend", "extended", "--observations", "17000", "--threads", "1"]);
    assert_eq!(std::fs::metadata(&first).unwrap().modified().unwrap(), written, "a full block is left alone");
    bench.run("whole", &["--observations", "17000"]);
    assert_same(&bench, "whole", "extended");
    let message = bench.misused(&["extend", "extended", "--observations", "16999"]);
    assert!(message.contains("--observations is 16999: expected at least 17000"), "{message}");
}

#[test]
fn damaged_blocks_are_named_and_made_again() {
    let bench = bench(300);
    bench.run("whole", &[]);
    bench.run("out", &[]);
    let blocks = block_files(&bench, "out");
    let mut bytes = std::fs::read(&blocks[0]).unwrap();
    let middle = bytes.len() / 2;
    bytes[middle] ^= 1;
    std::fs::write(&blocks[0], &bytes).unwrap();
    std::fs::write(&blocks[1], &bytes[..middle]).unwrap();
    std::fs::write(&blocks[2], b"").unwrap();
    let message = bench.refused(&["merge", "out"]);
    assert!(message.contains("out lacks 3 of 6 blocks"), "{message}");
    let status = bench.done(&["status", "out"]);
    assert_eq!(status.matches("damaged, will be made again").count(), 3, "{status}");
    let warnings = unwrapped(bench.study(&["run", "study.json", "--out", "out", "--resume"]).stderr);
    for block in &blocks[..3] {
        let name = block.strip_prefix(bench.path("")).unwrap().display().to_string();
        assert!(warnings.contains(&format!("warning: {name} is damaged: ")), "{warnings}");
    }
    assert_eq!(warnings.lines().count(), 3, "{warnings}");
    assert_same(&bench, "whole", "out");
}

#[test]
fn blocks_of_another_study_are_refused_with_both_hashes() {
    let bench = bench(300);
    bench.run("out", &[]);
    let blocks = block_files(&bench, "out");
    bench.change("study.json", |study| {
        study["payload"] = json!(51.0);
        study["name"] = json!("Another payload");
    });
    let run = ["run", "study.json", "--out", "out"];
    for options in [&[][..], &["--resume"], &["--shard", "1/2"]] {
        let message = bench.refused(&[&run[..], options].concat());
        assert!(
            message.starts_with("error: out contains study ") && message.contains("--overwrite"),
            "{message}"
        );
        let hashes: Vec<_> = message
            .split([' ', ','])
            .filter(|word| word.len() == 32 && word.chars().all(|c| c.is_ascii_hexdigit()))
            .collect();
        assert!(hashes.len() == 2 && hashes[0] != hashes[1], "{message}");
    }
    bench.run("other", &[]);
    std::fs::copy(&blocks[0], &block_files(&bench, "other")[0]).unwrap();
    let message = bench.refused(&["run", "study.json", "--out", "other", "--resume"]);
    assert!(message.contains("000000.block is of study ") && message.contains("expected"), "{message}");
    // Nor is a block read in the place of another.
    std::fs::copy(&block_files(&bench, "other")[2], &block_files(&bench, "other")[0]).unwrap();
    let message = bench.refused(&["merge", "other"]);
    assert!(message.contains("is of design sampling: expected replicate-1"), "{message}");
    // With `--overwrite` it begins again.
    bench.run("out", &["--overwrite"]);
    assert!(bench.path("out/summary.json").exists());
}

#[test]
fn titles_and_numbers_of_observations_make_no_other_study() {
    let bench = bench(300);
    bench.run("out", &[]);
    bench.change("study.json", |study| {
        study["name"] = json!("Another name");
        study["samplings"]["mechanical"]["title"] = json!("Another title");
        study["bootstrap_resamples"] = json!(3);
    });
    // Without a table: that of the larger run would not be of this one.
    bench.run("out", &["--resume", "--observations", "200", "--table", "none"]);
    assert!(!bench.path("out/mechanical.csv").exists());
    bench.run("out", &["--resume", "--observations", "200"]);
    bench.run("whole", &["--observations", "200"]);
    assert_same(&bench, "whole", "out");
}

#[test]
fn a_folder_in_use_is_refused_and_nothing_of_it_touched() {
    let bench = bench(300);
    bench.run("out", &[]);
    let before = bench.results("out");
    let message = bench.refused(&["run", "study.json", "--out", "out"]);
    assert_eq!(
        message,
        "error: out contains 6 blocks of this study: --resume goes on with them, --overwrite begins again\n"
    );
    assert_eq!(bench.results("out"), before);
    // A study file that no run has written, the very one to run among them.
    let message = bench.refused(&["run", "study.json", "--out", "."]);
    assert!(message.contains("robot.json was not written by a run"), "{message}");
    // One that a run has written goes on in its own folder.
    bench.done(&["run", "out/study.json", "--out", "out", "--resume"]);
    assert_eq!(bench.results("out"), before);
}

#[test]
fn files_that_no_run_has_written_stay_whatever_folder_they_are_in() {
    let bench = bench(300);
    let mine = |out: &str| {
        std::fs::create_dir_all(bench.path(out).join("blocks/mechanical")).unwrap();
        ["blocks/data.txt", "blocks/mechanical/data.txt"].map(|file| {
            let path = bench.path(out).join(file);
            std::fs::write(&path, "mine").unwrap();
            path
        })
    };
    let files = mine("out");
    for options in [&["--overwrite"][..], &["--overwrite"], &["--resume"]] {
        bench.run("out", options);
        assert!(files.iter().all(|file| std::fs::read(file).unwrap() == b"mine"), "{options:?}");
    }
    // A folder called `blocks` makes no results of a study that stands beside it.
    mine("other");
    std::fs::copy(bench.path("study.json"), bench.path("other/study.json")).unwrap();
    std::fs::copy(bench.path("robot.json"), bench.path("other/robot.json")).unwrap();
    let before = bench.results("other");
    for options in [&[][..], &["--overwrite"], &["--resume"], &["--shard", "1/1"]] {
        let message = bench.refused(&[&["run", "other/study.json", "--out", "other"], options].concat());
        assert!(message.contains("other/robot.json was not written by a run"), "{message}");
    }
    assert_eq!(bench.results("other"), before);
}

#[test]
fn a_folder_whose_blocks_are_gone_is_known_and_run_again() {
    let bench = bench(300);
    bench.run("whole", &[]);
    bench.run("out", &[]);
    for option in ["--resume", "--overwrite"] {
        std::fs::remove_dir_all(bench.path("out/blocks")).unwrap();
        bench.run("out", &[option]);
        assert_same(&bench, "whole", "out");
    }
}

#[test]
fn invalid_shards_and_folders_without_a_study_are_refused() {
    let bench = bench(300);
    for shard in ["0/4", "5/4", "x", "auto"] {
        let message = bench.misused(&["run", "study.json", "--shard", shard]);
        assert!(message.starts_with(&format!("error: --shard is {shard}: expected i/n")), "{message}");
    }
    assert!(!bench.path("results").exists());
    for command in
        [&["merge", "nowhere"][..], &["status", "nowhere"], &["extend", "nowhere", "--observations", "9"]]
    {
        let message = bench.refused(command);
        assert!(message.starts_with("error: cannot read nowhere/study.json: No such file"), "{message}");
    }
}

#[test]
fn a_new_study_of_ones_own_robot_runs_as_it_is() {
    let bench = bench(300);
    std::fs::create_dir(bench.path("mine")).unwrap();
    std::fs::write(bench.path("mine/robot-1.json"), std::fs::read(data("robots/cogiro.json")).unwrap())
        .unwrap();
    let new = ["new", "mine/robot-1.json", "--out", "mine/study-1.json"];
    let notes = bench.done(&new);
    assert!(notes.contains("error_models") && notes.contains("cdpr study run FILE"), "{notes}");
    bench.done(&["run", "mine/study-1.json", "--out", "out", "--observations", "64"]);
    assert!(bench.path("out/all_sensitivity.svg").exists());
    let message = bench.refused(&new);
    assert!(message.starts_with("error: cannot write mine/study-1.json: File exists"), "{message}");
    let message = bench.misused(&["new", "mine/robot-1.json", "--pose", "0,0,99"]);
    assert!(message.starts_with("error: --pose: position is [0.0, 0.0, 99.0]: expected a"), "{message}");
}

/// Signals a child as Ctrl-C does, or lets a shell limit its files.
#[cfg(unix)]
mod unix {
    use super::*;

    #[test]
    fn an_interrupted_run_says_how_to_go_on_and_exits_with_130() {
        let bench = bench(400_000);
        let out = "my results";
        let arguments =
            ["run", "study.json", "--out", out, "--table", "none", "--threads", "2", "--format", "json"];
        let child =
            bench.study_command(&arguments).stderr(Stdio::piped()).stdout(Stdio::null()).spawn().unwrap();
        let clock = Instant::now();
        while block_files(&bench, out).is_empty() && clock.elapsed() < Duration::from_secs(60) {
            std::thread::sleep(Duration::from_millis(5));
        }
        assert!(Command::new("kill").args(["-INT", &child.id().to_string()]).status().unwrap().success());
        let output = child.wait_with_output().unwrap();
        assert_eq!(output.status.code(), Some(130));
        let text = unwrapped(output.stderr);
        let (_, command) =
            text.split_once("interrupted: what is done is in my results; go on with: cdpr ").unwrap();
        let expected =
            [&["run", "my results/study.json"][..], &arguments[2..4], &["--resume"], &arguments[4..]];
        let words = ["study"].into_iter().chain(expected.into_iter().flatten().copied());
        assert_eq!(shlex::split(command).unwrap(), words.collect::<Vec<_>>(), "{text}");
        assert!(!block_files(&bench, out).is_empty());
    }

    #[test]
    fn a_disk_that_is_full_is_named_and_the_blocks_before_it_are_kept() {
        let bench = bench(2 * BLOCK);
        bench.run("whole", &[]);
        // Files of at most 2 MB: the table does not fit, blocks do.
        let limited = "trap '' XFSZ; ulimit -f 2000; exec \"$0\" study run study.json --out out --threads 1";
        let mut command = bench.command("bash");
        let output = command.args(["-c", limited, env!("CARGO_BIN_EXE_cdpr")]).output().unwrap();
        let text = unwrapped(output.stderr);
        assert_eq!(output.status.code(), Some(1), "{text}");
        assert!(text.starts_with("error: cannot write out/mechanical.csv: File too large"), "{text}");
        assert!(!bench.path("out/mechanical.csv").exists(), "half a table looks like a whole one");
        assert_eq!(block_files(&bench, "out").len(), 1);
        bench.run("out", &["--resume"]);
        assert_same(&bench, "whole", "out");
    }
}
