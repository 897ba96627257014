//! A study shared by processes, and by the scripts for clusters has the files of one run.

#![cfg(unix)]

use crate::common::{Bench, data, unwrapped};
use serde_json::json;
use std::os::unix::fs::PermissionsExt;
use std::process::Command;

/// Two samplings of blocks enough for seven, one of them at several poses.
fn bench(observations: usize) -> Bench {
    Bench::new("caroca-poses.json", |study| {
        // Few inputs: rows of many would take longer than the mechanics.
        let model = study["error_models"]["table_4"].as_object_mut().unwrap();
        model.retain(|name, _| ["mass", "youngs_modulus"].contains(&name.as_str()));
        let sampling = &mut study["samplings"]["plane"];
        sampling["observations"] = json!(observations);
        sampling["poses"]["grid"]["x"]["points"] = json!(5);
        sampling["poses"]["grid"]["y"]["points"] = json!(3);
        let mut alone = sampling.clone();
        alone.as_object_mut().unwrap().remove("poses");
        alone["pose"] = json!({"position": [0.0, 0.0, 1.75]});
        study["samplings"]["alone"] = alone;
        study["replicates"] = json!(2);
    })
}

/// Puts programs of the test into a folder: `cdpr` itself, and a script in place of a scheduler's.
fn put_programs(bench: &Bench, name: &str, text: &str) {
    let folder = bench.path("bin");
    std::fs::create_dir(&folder).unwrap();
    std::os::unix::fs::symlink(env!("CARGO_BIN_EXE_cdpr"), folder.join("cdpr")).unwrap();
    std::fs::write(folder.join(name), text).unwrap();
    std::fs::set_permissions(folder.join(name), PermissionsExt::from_mode(0o755)).unwrap();
}

/// A script of `data`, for which these programs come first.
fn script(bench: &Bench, file: &str) -> Command {
    let mut command = bench.command(data(file).to_str().unwrap());
    command.env("PATH", format!("{}:{}", bench.path("bin").display(), std::env::var("PATH").unwrap()));
    command
}

#[test]
fn seven_tasks_of_a_slurm_array_of_which_one_is_repeated_make_what_one_run_makes() {
    let bench = bench(20_000);
    bench.run("whole", &["--table", "none"]);
    put_programs(&bench, "srun", "#!/bin/sh\nexec \"$@\"\n");
    // Task `id` of `--array=FIRST-LAST`.
    let task = |id: usize, [first, last]: [usize; 2]| {
        let mut command = script(&bench, "cluster/slurm.sh");
        command.args(["7", "study.json", "shared", "--observations", "20000"]);
        command.env("SLURM_CPUS_PER_TASK", "1");
        for (end, value) in [("ID", id), ("MIN", first), ("MAX", last), ("COUNT", last - first + 1)] {
            command.env(format!("SLURM_ARRAY_TASK_{end}"), value.to_string());
        }
        command.output().unwrap()
    };
    std::thread::scope(|scope| {
        let tasks = [7, 6, 5, 4, 2, 1].map(|id| scope.spawn(move || task(id, [1, 7])));
        for task in tasks {
            assert!(task.join().unwrap().status.success());
        }
    });
    assert!(bench.refused(&["merge", "shared"]).contains("shared lacks"));
    assert!(task(3, [3, 3]).status.success());
    let beyond = task(8, [8, 8]);
    assert_eq!(beyond.status.code(), Some(2));
    let text = unwrapped(beyond.stderr);
    assert!(text.starts_with("error: SLURM_ARRAY_TASK_ID is `8`: expected a task from 1 to 7"), "{text}");
    bench.done(&["merge", "shared", "--table", "none"]);
    bench.assert_same("whole", "shared");
}

#[test]
fn seven_tasks_of_hyperqueue_make_what_one_run_makes_and_a_failed_one_ends_the_script() {
    // What `hq submit --array 1-n ... -- COMMAND` does, all tasks at once.
    const HQ: &str = r#"#!/bin/bash
while [ "$1" != -- ]; do [ "$1" = --array ] && last=${2#1-}; shift; done
shift
for id in $(seq "$last"); do HQ_TASK_ID=$id "$@" > /dev/null & pids+=($!); done
for pid in "${pids[@]}"; do wait "$pid" || failed=1; done
exit "${failed:-0}"
"#;
    let bench = bench(20_000);
    bench.run("whole", &["--table", "none"]);
    put_programs(&bench, "hq", HQ);
    let submitted = |study: &str| {
        script(&bench, "cluster/hyperqueue.sh").args(["7", "1", study, "shared"]).output().unwrap()
    };
    let failed = submitted("nowhere.json");
    assert_eq!(failed.status.code(), Some(1));
    assert!(!bench.path("shared").exists());
    let output = submitted("study.json");
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    bench.assert_same("whole", "shared");
}

#[test]
fn processes_of_a_launcher_without_shards_are_refused() {
    let bench = bench(100);
    let mut command = bench.command(env!("CARGO_BIN_EXE_cdpr"));
    let output =
        command.env("OMPI_COMM_WORLD_SIZE", "4").args(["study", "run", "study.json"]).output().unwrap();
    assert_eq!(output.status.code(), Some(1));
    let text = unwrapped(output.stderr);
    assert!(
        text.starts_with("error: 4 processes run this study together, and each would make the whole of it"),
        "{text}"
    );
    assert!(!bench.path("results").exists());
}
