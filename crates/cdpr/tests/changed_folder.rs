//! Folders of results that were edited, or into which another study is written.

use crate::folder::{bench, report, write};
use serde_json::json;

#[test]
fn a_study_with_a_further_sampling_keeps_the_blocks_of_the_others() {
    let bench = bench();
    bench.run("out", &[]);
    let block = bench.path("out/blocks/mechanical/sampling/000000.block");
    let written = std::fs::metadata(&block).unwrap().modified().unwrap();
    bench.change("study.json", |study| {
        let mut further = study["samplings"]["mechanical"].clone();
        further["error_model"] = json!("further");
        study["error_models"]["further"] = json!({"mass": study["error_models"]["table_4"]["mass"]});
        study["samplings"]["further"] = further;
    });
    bench.run("out", &["--resume"]);
    assert_eq!(std::fs::metadata(&block).unwrap().modified().unwrap(), written);
    bench.run("whole", &[]);
    bench.assert_same("whole", "out");
    // A sampling less, or one that is another, is another study.
    bench.change("study.json", |study| {
        study["samplings"]["mechanical"]["pose"]["position"] = json!([0.0, 0.1, 1.75]);
    });
    assert!(bench.refused(&["run", "study.json", "--out", "out", "--resume"]).contains("out contains study"));
    bench.change("study.json", |study| {
        study["samplings"].as_object_mut().unwrap().remove("mechanical");
    });
    assert!(bench.refused(&["run", "study.json", "--out", "out", "--resume"]).contains("out contains study"));
}

#[test]
fn what_an_earlier_run_has_written_and_this_one_has_not_goes() {
    let bench = bench();
    bench.run("out", &["--table", "csv"]);
    bench.change("study.json", |study| study["surfaces"] = json!({}));
    bench.run("out", &["--resume"]);
    bench.run("whole", &[]);
    bench.assert_same("whole", "out");
    assert!(!bench.path("out/plane").exists());
}

#[test]
fn files_of_different_studies_in_one_folder_are_noticed() {
    let bench = bench();
    bench.run("out", &[]);
    bench.change("study.json", |study| study["payload"] = json!(60.0));
    bench.run("other", &[]);
    let kept = bench.path("kept.json");
    for name in ["summary.json", "study.json"] {
        std::fs::copy(bench.path("out").join(name), &kept).unwrap();
        std::fs::copy(bench.path("other").join(name), bench.path("out").join(name)).unwrap();
        let (code, message) = report(&bench, &["out"]);
        assert!(code == Some(1) && message.contains(&format!("out/{name} is of study ")), "{message}");
        std::fs::copy(&kept, bench.path("out").join(name)).unwrap();
    }
    bench.change("out/robot.json", |robot| robot["platform"]["mass"] = json!(400.0));
    for command in ["merge", "status"] {
        let message = bench.refused(&[command, "out"]);
        assert!(
            message.contains("out/robot.json is not what the run has written here: it was changed"),
            "{message}"
        );
    }
}

#[test]
fn edited_files_of_results_are_noticed_wherever_they_are_read() {
    let bench = bench();
    bench.run("out", &[]);
    assert!(!bench.done(&["status", "out"]).contains("not what"));
    for (name, edit, commands) in [
        ("robot.json", ["\"mass\": ", "\"mass\": 1"], &["report", "merge", "status", "extend"][..]),
        // Neither title nor number enters the hash of the study.
        (
            "study.json",
            ["\"observations\": 20", "\"observations\": 30"],
            &["report", "merge", "status", "extend"],
        ),
        ("study.json", ["\"title\": \"", "\"title\": \"My "], &["report", "merge", "status", "extend"]),
        ("summary.json", ["\"mean\": ", "\"mean\": 1"], &["report"]),
        ("plane.csv", ["held,", "held,1"], &["report"]),
        ("surface_E_rho.csv", [",ok", "1,ok"], &["report"]),
        // A table of observations, which the report does not show.
        ("mechanical.csv", [",ok", "1,ok"], &["report"]),
    ] {
        let path = bench.path("out").join(name);
        let kept = std::fs::read_to_string(&path).unwrap();
        let edited = kept.replacen(edit[0], edit[1], 1);
        assert_ne!(edited, kept);
        write(&path, &edited);
        for command in commands {
            let (code, message) = match *command {
                "report" => report(&bench, &["out"]),
                "extend" => (Some(1), bench.refused(&["extend", "out", "--observations", "40"])),
                command => (Some(1), bench.refused(&[command, "out"])),
            };
            let told = format!("out/{name} is not what the run has written here: it was changed");
            assert!(code == Some(1) && message.contains(&told), "{command}: {message}");
        }
        if commands.len() == 1 {
            let told = format!("not what the run has written: out/{name}");
            assert!(bench.done(&["status", "out"]).contains(&told));
        }
        write(&path, &kept);
    }
    assert_eq!(report(&bench, &["out"]).0, Some(0));
    // The digests are those that b3sum prints, of tables that the program does not read back, too.
    let table = std::fs::read(bench.path("out/mechanical.csv")).unwrap();
    let list = bench.json("out/cdpr-results.json");
    assert_eq!(list["files"]["mechanical.csv"], blake3::hash(&table).to_string());
    write(bench.path("out/mechanical.csv"), "index\n");
    std::fs::remove_file(bench.path("out/mechanical.svg")).unwrap();
    let status: serde_json::Value =
        serde_json::from_str(&bench.done(&["status", "out", "--format", "json"])).unwrap();
    assert_eq!(status["changed"], json!(["out/mechanical.csv", "out/mechanical.svg"]));
    // An edited study goes on if it is run. A table that somebody has edited is not written over: moved away,
    // it is made again, and so is a summary.
    bench.change("out/study.json", |study| study["samplings"]["mechanical"]["title"] = json!("Mine"));
    let resume = ["run", "out/study.json", "--out", "out", "--resume"];
    assert!(bench.refused(&resume).contains("out/mechanical.csv is not what the run has written here"));
    std::fs::remove_file(bench.path("out/mechanical.csv")).unwrap();
    bench.done(&resume);
    write(bench.path("out/summary.json"), "{}");
    assert_eq!(report(&bench, &["out"]).0, Some(1));
    assert!(
        bench.refused(&["merge", "out"]).contains("out/summary.json is not what the run has written here")
    );
    std::fs::remove_file(bench.path("out/summary.json")).unwrap();
    bench.done(&["merge", "out"]);
    assert!(!bench.done(&["status", "out"]).contains("not what"));
}

#[test]
fn what_a_folder_has_and_what_becomes_of_it_is_said_where_another_number_is_requested() {
    let bench = bench();
    bench.run("out", &[]);
    let there = std::fs::read_to_string(bench.path("out/study.json")).unwrap();
    let there: serde_json::Value = serde_json::from_str(&there).unwrap();
    let there = there["samplings"]["mechanical"]["observations"].as_u64().unwrap();
    let resumed = |observations: u64| {
        let observations = observations.to_string();
        let arguments = ["run", "study.json", "--out", "out", "--resume", "--observations", &observations];
        let output = bench.study(&arguments);
        assert!(output.status.success());
        crate::common::unwrapped(output.stderr)
    };
    let fewer = resumed(there - 5);
    let has = format!("note: out has {there} observations of mechanical: ");
    let words = format!("{has}the results are of the first {}, the others are kept", there - 5);
    assert!(fewer.contains(&words), "{fewer}");
    let more = resumed(there + 5);
    assert!(more.contains(&format!("{has}5 more are made")), "{more}");
    let same = resumed(there + 5);
    assert!(!same.contains("observations of mechanical"), "{same}");
}
