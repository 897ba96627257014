//! What a run of this program has written is its own, everything else is the user's.

use crate::common::{cdpr_in, data_path, unwrapped};
use std::path::Path;
use std::process::{Command, Output};

const PLACE: &str = "--region=0:0:1,0:0:1,1.75:1.75:1";

fn refused(output: Output, words: &str) {
    let message = unwrapped(output.stderr);
    assert!(output.status.code() == Some(1) && message.contains(words), "{message}");
}

fn done(output: Output) {
    assert!(output.status.success(), "{}", unwrapped(output.stderr));
}

/// Commands that write one file, `FILE`, the ending of its format, and a text by which such files were once
/// recognized.
fn writers() -> Vec<(Vec<String>, &'static str, &'static str)> {
    let (caroca, record) = (data_path("robots/caroca.json"), data_path("cables/caroca-4mm-record.csv"));
    let source = data_path("reference/exchange/caroca.yaml");
    let study = data_path("studies/caroca.json");
    let simulate = format!(
        "calibrate simulate {caroca} --uncertainty {study}:table_3 --poses poses.csv --noise \
         position=1e-4,rotation=1e-4,length=1e-4 --seed 1"
    );
    let plan = format!(
        "calibrate plan {caroca} --poses poses.csv --noise position=1e-4,rotation=1e-4 --number 1 \
         --uncertainty a=0.001"
    );
    let load_cycle = format!("hysteresis {caroca} --pose 0,0,1.75 --payload 50 --law {record} --length 1");
    let modulus = "--breaking-force 10290 --section 1.2566370614e-5 --length 1 --range 5-10";
    [
        (
            format!("robot import {source} --cable steel-4mm --tension-limits 50,10000 --out FILE"),
            "json",
            "cdpr-robot/1",
        ),
        (format!("robot export {caroca} --to mjcf --pose 0,0,1.75 --out FILE"), "xml", "<mujoco"),
        (format!("robot export {caroca} --to moorpy --pose 0,0,1.75 --out FILE"), "txt", "LINE TYPES"),
        (format!("robot export {caroca} --to moordyn --pose 0,0,1.75 --out FILE"), "txt", "rk4 tScheme"),
        (format!("robot export {caroca} --to klipper --pose 0,0,1.75 --out FILE"), "cfg", "[printer]"),
        (format!("robot export {caroca} --to table --region 0,0,1.75 --out FILE"), "csv", "x_mm,y_mm"),
        (format!("cable modulus {record} {modulus} --law FILE"), "json", "cdpr-law/1"),
        (format!("cable modulus {record} {modulus} --figure FILE"), "svg", "<svg"),
        (format!("path {caroca} --poses poses.csv --payload 50 --figure FILE"), "svg", " along a path of "),
        (format!("explore {caroca} --out FILE"), "html", "content=\"cdpr explorer "),
        (format!("{simulate} --out FILE"), "csv", "pose,cable"),
        (format!("{simulate} --out other.csv --truth FILE"), "json", "cdpr-robot/1"),
        (format!("{plan} --out FILE"), "csv", "x_m,y_m,z_m"),
        (format!("{load_cycle} --figure FILE"), "svg", "<svg"),
    ]
    .map(|(command, ending, mark)| (command.split(' ').map(str::to_owned).collect(), ending, mark))
    .into()
}

#[test]
fn a_file_is_replaced_on_request_only_whatever_stands_in_it() {
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(folder.path().join("poses.csv"), "0,0,1.75\n0.1,0,1.75\n").unwrap();
    for (k, (command, ending, mark)) in writers().into_iter().enumerate() {
        let name = format!("file{k}.{ending}");
        let path = folder.path().join(&name);
        let mine = format!("mine, with {mark} in it");
        let run = |more: &[&str]| {
            let arguments: Vec<&str> =
                command.iter().map(|word| if word == "FILE" { &name } else { word.as_str() }).collect();
            cdpr_in(folder.path(), &[&arguments, more].concat())
        };
        std::fs::write(&path, &mine).unwrap();
        refused(run(&[]), "exists already, with another content");
        assert_eq!(std::fs::read_to_string(&path).unwrap(), mine, "{command:?}");
        done(run(&["--overwrite"]));
        let ours = std::fs::read(&path).unwrap();
        // The same content again is no loss.
        done(run(&[]));
        assert!(ours != mine.as_bytes() && std::fs::read(&path).unwrap() == ours, "{command:?}");
    }
}

#[test]
fn a_name_that_says_another_format_is_refused_before_anything_is_computed() {
    let folder = tempfile::tempdir().unwrap();
    let caroca = data_path("robots/caroca.json");
    let more = [
        (format!("robot export {caroca} --to caspr --pose 0,0,1.75 --out FILE"), "json"),
        (format!("study new {caroca} --out FILE"), "json"),
        (format!("calibrate plan {caroca} --poses poses.csv --uncertainty mass=1 --out FILE"), "csv"),
        ("study report results --out FILE".to_owned(), "html"),
    ];
    let split = |(command, ending): (String, _)| (command.split(' ').map(str::to_owned).collect(), ending);
    let known = writers().into_iter().map(|(command, ending, _)| (command, ending));
    for (command, ending) in known.chain(more.map(split)) {
        let command: Vec<String> = command;
        for other in ["pdf", "html", "json", "xlsx", "xml"].into_iter().filter(|other| *other != ending) {
            let name = format!("file.{other}");
            let arguments: Vec<&str> =
                command.iter().map(|word| if word == "FILE" { &name } else { word.as_str() }).collect();
            let output = cdpr_in(folder.path(), &arguments);
            let message = unwrapped(output.stderr);
            assert_eq!(output.status.code(), Some(2), "{arguments:?}: {message}");
            assert!(message.contains("expected a name "), "{arguments:?}: {message}");
        }
    }
    assert_eq!(std::fs::read_dir(folder.path()).unwrap().count(), 0);
}

#[test]
fn a_map_is_replaced_on_request_only_and_robots_have_folders_of_their_own() {
    let folder = tempfile::tempdir().unwrap();
    let run = |robot: &str, more: &[&str]| {
        cdpr_in(folder.path(), &[&["workspace", robot, PLACE, "--with", "layers=0"], more].concat())
    };
    done(run("caroca", &[]));
    done(run("cogiro", &[]));
    let map = folder.path().join("caroca-workspace/workspace.json");
    let before = std::fs::read(&map).unwrap();
    refused(run("caroca", &["--payload", "20"]), "has the results of a workspace already");
    assert_eq!(std::fs::read(&map).unwrap(), before);
    done(run("caroca", &["--payload", "20", "--overwrite"]));
    assert_ne!(std::fs::read(&map).unwrap(), before);
    // A file of the user is not touched even then.
    std::fs::write(folder.path().join("caroca-workspace/deflection_z07.svg"), "mine").unwrap();
    refused(run("caroca", &["--overwrite"]), "deflection_z07.svg was not written by a run");
}

fn add(path: &Path, more: &str) {
    let content = std::fs::read_to_string(path).unwrap();
    std::fs::write(path, content + more).unwrap();
}

#[test]
fn results_that_were_changed_are_refused_by_every_reader_and_kept_by_every_run() {
    let folder = tempfile::tempdir().unwrap();
    let here = folder.path();
    std::fs::copy(data_path("robots/caroca.json"), here.join("caroca.json")).unwrap();
    done(cdpr_in(here, &["study", "new", "caroca.json", "--out", "study.json"]));
    let run = ["study", "run", "study.json", "--out", "out", "--observations", "64", "--table", "csv"];
    done(cdpr_in(here, &run));
    let names = std::fs::read_dir(here.join("out")).unwrap().map(|entry| entry.unwrap().file_name());
    let names: Vec<String> = names.map(|name| name.to_str().unwrap().to_owned()).collect();
    let is_table = |name: &&String| name.ends_with(".csv") && !name.ends_with("_sensitivity.csv");
    let table = names.iter().find(is_table).unwrap();
    let path = here.join("out").join(table);
    let whole = std::fs::read(&path).unwrap();
    add(&path, "\n");
    let words = "is not what the run has written here";
    refused(cdpr_in(here, &["analyse", &format!("out/{table}")]), words);
    refused(cdpr_in(here, &["analyse", path.to_str().unwrap()]), words);
    // A run that would replace it says so before it computes anything.
    refused(cdpr_in(here, &[&run[..], &["--resume"]].concat()), words);
    let changed = [whole.clone(), b"\n".to_vec()].concat();
    assert_eq!(std::fs::read(&path).unwrap(), changed);
    std::fs::write(&path, &whole).unwrap();
    done(cdpr_in(here, &[&run[..], &["--resume"]].concat()));
    let path = here.join("out/summary.json");
    let whole = std::fs::read(&path).unwrap();
    add(&path, "\n");
    refused(cdpr_in(here, &["study", "report", "out"]), words);
    std::fs::write(&path, whole).unwrap();
    done(cdpr_in(here, &["study", "report", "out"]));
    add(&here.join("out/report.html"), "<!-- mine -->");
    refused(cdpr_in(here, &["study", "report", "out"]), words);
}

#[test]
fn the_region_of_another_robot_of_the_same_name_is_refused() {
    let folder = tempfile::tempdir().unwrap();
    let here = folder.path();
    let robot = std::fs::read_to_string(data_path("robots/caroca.json")).unwrap();
    std::fs::write(here.join("robot.json"), &robot).unwrap();
    done(cdpr_in(here, &["study", "new", "robot.json", "--out", "study.json"]));
    done(cdpr_in(here, &["study", "run", "study.json", "--out", "out", "--observations", "64"]));
    let map =
        ["workspace", "robot.json", "--region", "-2:2:3,-1:1:3,1.75", "--with", "boundary", "--out", "map"];
    let map = [&map[..], &["--overwrite"]].concat();
    done(cdpr_in(here, &map));
    let report = ["study", "report", "out", "map", "--out", "with.html"];
    done(cdpr_in(here, &report));
    let heavier = robot.replace("\"mass\": 180", "\"mass\": 150");
    assert_ne!(heavier, robot);
    std::fs::write(here.join("robot.json"), heavier).unwrap();
    done(cdpr_in(here, &map));
    refused(cdpr_in(here, &report), "expected the robot of the study");
    // A map that was changed is no map of a run.
    std::fs::write(here.join("robot.json"), robot).unwrap();
    done(cdpr_in(here, &map));
    add(&here.join("map/boundary.csv"), "1,0,0,0\n");
    refused(cdpr_in(here, &report), "is not what the run has written here");
}

#[test]
fn the_environment_bounds_threads_too() {
    let run = |value: &str| {
        let mut command = Command::new(env!("CARGO_BIN_EXE_cdpr"));
        command.env("RAYON_NUM_THREADS", value).args(["deflection", "caroca", "--pose", "0,0,1.75"]);
        command.args(["--payload", "50"]).output().unwrap()
    };
    for value in ["1000000", "1e9", "-3", "4294967297"] {
        let output = run(value);
        let message = unwrapped(output.stderr);
        assert!(
            output.status.code() == Some(2) && message.contains("expected 1 to 1024 threads"),
            "{message}"
        );
    }
    ["2", "0", "all"].into_iter().for_each(|value| done(run(value)));
}

#[cfg(unix)]
#[test]
fn a_file_beyond_the_limit_of_the_system_is_an_error_and_not_the_end() {
    let folder = tempfile::tempdir().unwrap();
    let robot = data_path("robots/caroca.json");
    let program = env!("CARGO_BIN_EXE_cdpr");
    let script = format!("ulimit -f 4; exec {program} explore {robot} --out page.html");
    let output = Command::new("sh").current_dir(folder.path()).args(["-c", &script]).output().unwrap();
    refused(output, "cannot write page.html");
    assert_eq!(std::fs::read_dir(folder.path()).unwrap().count(), 0);
}
