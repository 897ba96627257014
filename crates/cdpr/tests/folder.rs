//! A folder of results has one owner: nothing that a run has not written is removed or replaced, no link is
//! followed, and two processes never write at once.

use crate::common::{Bench, Files, assert_same_files, cdpr_in, data_path, text, unwrapped};
use cdpr_study::{Existing, Study, begin};
use serde_json::json;
use std::path::Path;
use std::process::Stdio;

/// Two samplings of a few observations, one of them at two poses, and a surface.
pub(crate) fn bench() -> Bench {
    Bench::new("caroca.json", |study| {
        study["replicates"] = json!(0);
        study.as_object_mut().unwrap().remove("sensitivity");
        study["samplings"].as_object_mut().unwrap().retain(|name, _| name == "mechanical");
        study["samplings"]["mechanical"]["observations"] = json!(20);
        let mut plane = study["samplings"]["mechanical"].clone();
        let pose = plane.as_object_mut().unwrap().remove("pose").unwrap();
        plane["poses"] = json!({"list": [pose, {"position": [0.1, 0.0, 1.75]}]});
        study["samplings"]["plane"] = plane;
        study["surfaces"].as_object_mut().unwrap().retain(|name, _| name == "surface_E_rho");
        for axis in ["x", "y"] {
            study["surfaces"]["surface_E_rho"][axis]["points"] = json!(2);
        }
    })
}

/// `cdpr study report ...`: the exit code and the standard error.
pub(crate) fn report(bench: &Bench, arguments: &[&str]) -> (Option<i32>, String) {
    let output = cdpr_in(&bench.path("."), &[&["study", "report"], arguments].concat());
    (output.status.code(), unwrapped(output.stderr))
}

pub(crate) fn write(path: impl AsRef<Path>, content: &str) {
    std::fs::create_dir_all(path.as_ref().parent().unwrap()).unwrap();
    std::fs::write(path, content).unwrap();
}

const OVERWRITE: [&str; 5] = ["run", "study.json", "--out", "out", "--overwrite"];

#[test]
fn a_strangers_folder_names_no_file_outside_of_it() {
    let bench = bench();
    bench.run("out", &["--table", "csv"]);
    let victims = ["victim/0000.csv", "victim/2024.csv", "victim.csv"].map(|name| bench.path(name));
    victims.iter().for_each(|path| write(path, "mine"));
    let safe = || victims.iter().all(|path| std::fs::read(path).unwrap() == b"mine");
    // A study whose sampling is called as a folder outside.
    bench.change("out/study.json", |study| {
        let plane = study["samplings"]["plane"].clone();
        study["samplings"] = json!({"../victim": plane});
    });
    bench.done(&OVERWRITE);
    assert!(safe());
    // A list of files outside.
    for name in ["../victim/2024.csv", "../victim.csv", "plane/../../victim.csv", "/victim.csv"] {
        bench.change("out/cdpr-results.json", |list| list["files"] = json!({name: null}));
        for option in ["--overwrite", "--resume"] {
            let message = bench.refused(&["run", "study.json", "--out", "out", option]);
            assert!(message.contains(&format!("cdpr-results.json: files is {name}: expected")), "{message}");
        }
        assert!(safe() && bench.path("out/mechanical.csv").exists());
    }
}

#[cfg(unix)]
#[test]
fn links_in_a_folder_of_results_are_not_followed() {
    use std::os::unix::fs::symlink;
    for link in ["blocks", "blocks/mechanical", "blocks/mechanical/sampling", "plane", "mechanical.csv"] {
        let bench = bench();
        bench.run("out", &["--table", "csv"]);
        // What the link stands for lies outside, and the link in its place.
        let (inside, outside) = (bench.path("out").join(link), bench.path("outside"));
        std::fs::rename(&inside, &outside).unwrap();
        symlink(&outside, &inside).unwrap();
        if outside.is_dir() {
            write(outside.join(".cdpr-mine12.tmp"), "mine");
            write(outside.join("2024.csv"), "mine");
        }
        let before = everything(&outside);
        for options in
            [&["--overwrite"][..], &["--resume"], &["--resume", "--observations", "30"], &["--shard", "1/1"]]
        {
            let output = bench.study(&[&OVERWRITE[..4], options, &["--table", "csv"]].concat());
            assert_eq!(everything(&outside), before, "{link} {options:?}");
            assert!(std::fs::symlink_metadata(&inside).unwrap().is_symlink(), "{link} {options:?}");
            let message = unwrapped(output.stderr);
            // Only what needs nothing behind the link ends well.
            let named = message.contains(&format!("out/{link} is a link"));
            assert!(output.status.success() || named, "{link} {options:?}: {message}");
        }
    }
    // A circle has no end.
    let bench = bench();
    bench.run("out", &[]);
    symlink("..", bench.path("out/blocks/circle")).unwrap();
    symlink(".", bench.path("out/blocks/mechanical/self")).unwrap();
    bench.run("out", &["--resume"]);
    bench.run("out", &["--overwrite"]);
}

/// All files below a folder, or a file alone.
fn everything(path: &Path) -> Vec<(String, Vec<u8>)> {
    if path.is_file() {
        return vec![(String::new(), std::fs::read(path).unwrap())];
    }
    let mut all = Vec::new();
    for entry in std::fs::read_dir(path).unwrap().map(|entry| entry.unwrap().path()) {
        let name = entry.file_name().unwrap().to_str().unwrap().to_owned();
        all.extend(everything(&entry).into_iter().map(|(rest, bytes)| (format!("{name}/{rest}"), bytes)));
    }
    all.sort();
    all
}

#[test]
fn a_users_own_files_are_not_written_over_by_a_first_run_and_named() {
    let bench = bench();
    for name in [
        "study.json",
        "robot.json",
        "summary.json",
        "timings.json",
        "report.html",
        "mechanical.csv",
        "mechanical.parquet",
        "mechanical_effects.svg",
        "plane.csv",
        "plane_mean.svg",
        "surface_E_rho.svg",
        "robot.svg",
    ] {
        let own = bench.path(&format!("own-{name}/{name}"));
        write(&own, "mine");
        let out = own.parent().unwrap().to_str().unwrap().to_owned();
        for option in ["--resume", "--overwrite", "--shard=1/1", "--table=csv"] {
            let message = bench.refused(&["run", "study.json", "--out", &out, option]);
            assert!(message.contains(&format!("{name} was not written by a run")), "{message}");
        }
        assert_eq!(everything(Path::new(&out)), [(format!("{name}/"), b"mine".to_vec())]);
    }
    let robot = data_path("robots/caroca.json");
    let workspace = ["workspace", &robot, "--region=0:0:1,0:0:1,1.75:1.75:1"];
    for name in ["workspace.csv", "workspace.json", "deflection.svg", "deflection_z00.svg"] {
        let own = bench.path(&format!("own-{name}/{name}"));
        write(&own, "mine");
        let out = own.parent().unwrap().to_str().unwrap().to_owned();
        let output = cdpr_in(&bench.path("."), &[&workspace[..], &["--out", &out]].concat());
        let message = unwrapped(output.stderr);
        assert!(output.status.code() == Some(1) && message.contains("was not written by a run"), "{message}");
        assert_eq!(everything(Path::new(&out)), [(format!("{name}/"), b"mine".to_vec())]);
    }
}

#[test]
fn a_users_own_files_among_tables_and_blocks_survive_every_run() {
    let bench = bench();
    bench.run("out", &["--table", "csv"]);
    let own =
        ["plane/2024.csv", "plane/0007.csv", "blocks/notes.block", "blocks/mechanical/sampling/old.block"];
    let own = own.map(|name| bench.path("out").join(name));
    own.iter().for_each(|path| write(path, "mine"));
    for options in [&["--overwrite"][..], &["--resume"], &["--overwrite", "--table", "csv"]] {
        bench.run("out", options);
        assert!(own.iter().all(|path| std::fs::read(path).unwrap() == b"mine"), "{options:?}");
    }
    // One that a table would need is named.
    std::fs::remove_file(bench.path("out/plane/0001.csv")).unwrap();
    bench.run("out", &["--overwrite"]);
    write(bench.path("out/plane/0001.csv"), "mine");
    let message = bench.refused(&["run", "study.json", "--out", "out", "--resume", "--table", "csv"]);
    assert!(message.contains("out/plane/0001.csv was not written by a run"), "{message}");
}

#[test]
fn a_report_shows_the_region_of_a_workspace_of_its_robot() {
    let bench = bench();
    bench.run("out", &[]);
    let map = |robot: &str, place: &str, more: &[&str]| {
        let output = cdpr_in(
            &bench.path("."),
            &[&["workspace", robot, place, "--out", "map", "--overwrite"], more].concat(),
        );
        // CoGiRo holds less than half of these positions.
        assert!(matches!(output.status.code(), Some(0 | 3)), "{}", unwrapped(output.stderr));
    };
    let region = || {
        let asked = report(&bench, &["out", "map", "--out", "report.html", "--overwrite"]);
        assert_eq!(asked, (Some(0), String::new()));
        let page = std::fs::read_to_string(bench.path("report.html")).unwrap();
        let data = page.split_once(r#"id="data">"#).unwrap().1.split_once("</script>").unwrap().0;
        serde_json::from_str::<serde_json::Value>(data).unwrap()["region"].clone()
    };
    let count = |value: &serde_json::Value| value.as_array().unwrap().len();
    map("robot.json", "--region=::7,::7,1.75", &["--with", "boundary"]);
    let plane = region();
    assert!(count(&plane["lines"]) == 1 && count(&plane["lines"][0]) > 50, "{plane}");
    let corners = plane["points"].as_array().unwrap();
    assert!(corners.iter().all(|point| point[2] == 1.75 && point[0].as_f64().unwrap().abs() < 3.6));
    map("robot.json", "--region=-3.4:3.4:5,-1.9:1.9:4,0.5:2.5:3", &["--with", "boundary"]);
    let space = region();
    assert!(count(&space["triangles"]) > 100 && count(&space["lines"]) == 0, "{space}");
    let last = count(&space["points"]) as u64;
    let triangles =
        space["triangles"].as_array().unwrap().iter().flat_map(|corners| corners.as_array().unwrap());
    assert!(triangles.clone().all(|corner| corner.as_u64().unwrap() < last));

    map("robot.json", "--region=::3,::3,1.75", &[]);
    let asked = |folder: &str| report(&bench, &["out", folder, "--out", "report.html"]);
    let (code, message) = asked("map");
    assert!(
        code == Some(1) && message.contains("workspace.json: boundary is null: expected that of"),
        "{message}"
    );
    map("cogiro", "--region=::5,::5,1.5", &["--with", "boundary"]);
    let (code, message) = asked("map");
    assert!(code == Some(1) && message.contains("the robot of the workspace is CoGiRo"), "{message}");
    assert_eq!(asked("out").0, Some(1));
}

#[test]
fn a_report_is_written_over_nothing_but_the_same_report() {
    let bench = bench();
    bench.run("out", &[]);
    write(bench.path("mine.html"), "<!DOCTYPE html><title>mine</title>");
    let before = bench.files("out");
    let whole = std::fs::read(bench.path("out/report.html")).unwrap();
    for name in ["study.json", "robot.json", "summary.json", "mechanical.csv", "mechanical.svg"] {
        let (code, message) = report(&bench, &["out", "--out", &format!("out/{name}")]);
        // Its name says another format than that of a report.
        assert!(code == Some(2) && message.contains("expected a name that ends in .html"), "{message}");
    }
    let (code, message) = report(&bench, &["out", "--out", "mine.html"]);
    assert!(
        code == Some(1) && message.contains("mine.html exists already, with another content"),
        "{message}"
    );
    assert_eq!(bench.files("out"), before);
    for _ in 0..2 {
        assert_eq!(report(&bench, &["out", "--out", "again.html"]), (Some(0), String::new()));
        assert_eq!(report(&bench, &["out"]), (Some(0), String::new()));
    }
    assert!(std::fs::read(bench.path("again.html")).unwrap() == whole);
    assert!(std::fs::read(bench.path("out/report.html")).unwrap() == whole);
    // The hash of the study stands in it.
    let hash = bench.json("out/summary.json")["hash"].as_str().unwrap().to_owned();
    assert_eq!(bench.json("out/cdpr-results.json")["study"], hash);
    assert!(hash.len() == 32 && text(whole).contains(&hash));
}

#[test]
fn while_one_process_writes_every_other_is_refused() {
    let bench = bench();
    bench.run("out", &[]);
    let before = bench.files("out");
    let study = Study::open(&bench.path("out/study.json")).unwrap();
    let blocks = begin(&bench.path("out"), &study, Existing::GoOn).unwrap();
    for arguments in [
        &["run", "study.json", "--out", "out"][..],
        &["run", "study.json", "--out", "out", "--resume"],
        &["run", "study.json", "--out", "out", "--overwrite"],
        &["extend", "out", "--observations", "40"],
        &["merge", "out"],
    ] {
        let message = bench.refused(arguments);
        assert_eq!(
            message,
            "error: out is in use: another process writes into it; wait for its end, or choose another folder\n"
        );
    }
    assert!(report(&bench, &["out"]).1.contains("out is in use"));
    assert!(report(&bench, &["out", "--out", "elsewhere.html"]).1.contains("out is in use"));
    // How far it is can be asked for at any time.
    bench.done(&["status", "out"]);
    // Shards of the same study share the folder, and nobody else.
    blocks.share().unwrap();
    bench.run("out", &["--shard", "1/2"]);
    assert!(bench.refused(&["merge", "out"]).contains("out is in use"));
    bench.change("study.json", |study| study["payload"] = json!(51.0));
    let message = bench.refused(&["run", "study.json", "--out", "out", "--shard", "1/2"]);
    assert!(message.contains("out is in use"), "{message}");
    drop(blocks);
    assert_eq!(bench.files("out"), before);
}

#[test]
fn of_processes_that_race_for_a_folder_the_results_are_of_one() {
    let bench = bench();
    bench.change("study.json", |study| study["bootstrap_resamples"] = json!(200));
    let mut other = bench.json("study.json");
    other["payload"] = json!(60.0);
    write(bench.path("other.json"), &other.to_string());
    bench.run("first", &[]);
    bench.done(&["run", "other.json", "--out", "second"]);
    let references = ["first", "second"].map(|out| bench.files(out));
    let is_one_of = |found: &Files, all: &[Files]| all.iter().any(|reference| reference == found);
    let race = |commands: [&[&str]; 2]| {
        let children = commands.map(|arguments| {
            let mut command = bench.study_command(arguments);
            command.stdout(Stdio::null()).stderr(Stdio::piped()).spawn().unwrap()
        });
        children.map(|child| {
            let output = child.wait_with_output().unwrap();
            let message = unwrapped(output.stderr);
            assert!(output.status.success() || output.status.code() == Some(1), "{message}");
            assert!(
                output.status.success() || message.contains("is in use") || message.contains("out holds"),
                "{message}"
            );
            output.status.success()
        })
    };
    for round in 0..10 {
        let ended = race([&["run", "study.json", "--out", "out"], &["run", "other.json", "--out", "out"]]);
        assert!(ended.iter().filter(|ended| **ended).count() == 1, "round {round}: {ended:?}");
        let expected = &references[usize::from(ended[1])];
        assert_same_files(expected, &bench.files("out"));
        let ended = race([
            &["run", "study.json", "--out", "out", "--overwrite"],
            &["run", "other.json", "--out", "out", "--overwrite"],
        ]);
        assert!(ended.contains(&true), "round {round}");
        assert!(is_one_of(&bench.files("out"), &references), "round {round}");
        std::fs::remove_dir_all(bench.path("out")).unwrap();
    }
    let sizes = ["30", "40"];
    let extended = sizes.map(|size| {
        bench.run(size, &["--observations", size]);
        bench.files(size)
    });
    for round in 0..5 {
        bench.run("out", &[]);
        let ended =
            race(sizes.map(|size| ["extend", "out", "--observations", size]).each_ref().map(|all| &all[..]));
        assert!(ended.contains(&true), "round {round}");
        assert!(is_one_of(&bench.files("out"), &extended), "round {round}");
        std::fs::remove_dir_all(bench.path("out")).unwrap();
    }
}

#[cfg(unix)]
#[test]
fn pipes_in_a_folder_of_results_are_not_waited_for() {
    let bench = bench();
    let names =
        ["study.json", "robot.json", "summary.json", "cdpr-results.json", "cdpr-results.lock", "plane.csv"];
    for name in names.into_iter().chain(["blocks/mechanical/sampling/000000.block"]) {
        bench.run("out", &["--overwrite"]);
        let path = bench.path("out").join(name);
        let kept = std::fs::read(&path).unwrap();
        std::fs::remove_file(&path).unwrap();
        assert!(bench.command("mkfifo").arg(&path).status().unwrap().success());
        for arguments in [
            &["study", "run", "study.json", "--out", "out", "--resume"][..],
            &["study", "run", "study.json", "--out", "out", "--overwrite"],
            &["study", "merge", "out"],
            &["study", "status", "out"],
            &["study", "report", "out"],
        ] {
            let mut command = bench.command("timeout");
            let output = command.arg("20").arg(env!("CARGO_BIN_EXE_cdpr")).args(arguments).output().unwrap();
            assert_eq!(output.status.code().filter(|code| *code > 1), None, "{name}: {arguments:?}");
        }
        std::fs::remove_file(&path).unwrap();
        std::fs::write(&path, kept).unwrap();
    }
}

#[test]
fn results_of_another_kind_are_not_written_into_a_folder() {
    let bench = bench();
    bench.run("out", &[]);
    let before = bench.files("out");
    let robot = data_path("robots/caroca.json");
    let workspace =
        cdpr_in(&bench.path("."), &["workspace", &robot, "--region=0:0:1,0:0:1,1.75:1.75:1", "--out", "out"]);
    let message = unwrapped(workspace.stderr);
    assert!(
        message.contains("out contains the results of a study: expected those of a workspace"),
        "{message}"
    );
    assert_eq!(bench.files("out"), before);
}
