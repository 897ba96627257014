//! Samplings at several poses: each equals a sampling at that pose alone, and a pose that is not held is a
//! row with its reason.

use crate::common::{Bench, unwrapped};
use serde_json::{Value, json};

/// CAROCA over a plane of 5 x 3 positions, of which the outer ones are not held.
fn plane(change: impl FnOnce(&mut Value)) -> Bench {
    Bench::new("caroca-poses.json", |study| {
        let sampling = &mut study["samplings"]["plane"];
        sampling["observations"] = json!(40);
        sampling["poses"]["grid"]["x"]["points"] = json!(5);
        sampling["poses"]["grid"]["y"]["points"] = json!(3);
        change(study);
    })
}

/// Rows of a table by the names of its columns.
fn rows(bench: &Bench, file: &str) -> Vec<serde_json::Map<String, Value>> {
    let text = std::fs::read_to_string(bench.path(file)).unwrap();
    let mut lines = text.lines();
    let header: Vec<&str> = lines.next().unwrap().split(',').collect();
    // Reasons may hold commas: they come last.
    let row = |line: &str| {
        let cells = line.splitn(header.len(), ',').map(|cell| json!(cell));
        header.iter().map(|name| (*name).to_owned()).zip(cells).collect()
    };
    lines.map(row).collect()
}

/// The sampling of the plane at one pose.
fn alone(study: &Value, position: [f64; 3]) -> Value {
    let mut alone = study["samplings"]["plane"].clone();
    alone.as_object_mut().unwrap().remove("poses");
    alone["pose"] = json!({"position": position});
    alone
}

/// The sampling of the plane over two layers of a box.
fn layered(study: &Value) -> Value {
    let mut layered = study["samplings"]["plane"].clone();
    layered["poses"]["grid"] = json!({
        "x": {"min": -1.0, "max": 1.0, "points": 2}, "y": {"min": -0.5, "max": 0.5, "points": 2},
        "z": {"min": 1.5, "max": 2.0, "points": 2}
    });
    layered
}

#[test]
fn a_plane_of_poses_has_a_row_each_maps_and_reasons_where_nothing_holds_it() {
    let bench = plane(|_| ());
    let text = bench.run("out", &[]);
    let rows = rows(&bench, "out/plane.csv");
    assert_eq!(rows.len(), 15);
    let held: Vec<_> = rows.iter().filter(|row| row["status"] == "held").collect();
    assert_eq!(held.len(), 3, "the middle of each of three columns: {text}");
    for row in rows.iter().filter(|row| row["status"] != "held") {
        assert_eq!((&row["status"], &row["observations"]), (&json!("infeasible_tension"), &json!("0")));
        assert!(row["mean_mm"] == "" && row["reason"].as_str().unwrap().len() > 20, "{row:?}");
    }
    let summary = &bench.json("out/summary.json")["studies"]["plane"];
    assert_eq!(summary["status"], json!({"held": 3, "infeasible_tension": 12}));
    assert_eq!((&summary["poses"], &summary["observations"]), (&json!(15), &json!(120)));
    let least =
        held.iter().map(|row| row["mean_mm"].as_str().unwrap().parse().unwrap()).fold(f64::MAX, f64::min);
    assert_eq!(summary["mean_mm"]["min"], json!(least));
    for map in ["mean", "std", "dominant"] {
        let svg = std::fs::read_to_string(bench.path(&format!("out/plane_{map}.svg"))).unwrap();
        // Twelve cells that are not held, and the grey of the key is a line.
        assert_eq!(svg.matches("fill=\"#B0B0B0\"").count(), 12, "{map}");
        assert!(svg.contains("at z = 1.75 m") && svg.contains("3 of 15 poses"), "{map}");
    }
    assert!(!bench.path("out/plane").exists(), "no table of observations unless it is asked for");
    let report = std::fs::read_to_string(bench.path("out/report.html")).unwrap();
    assert!(
        report.contains("Over the workspace")
            && report.contains("holds 3 of 15 poses; not held: 12 infeasible tension")
    );
    assert!(text.contains("12 of 15 poses are not held: 12 infeasible tension."), "{text}");
}

#[test]
fn what_is_said_of_a_pose_is_what_a_sampling_at_it_alone_says() {
    let bench = plane(|study| {
        let alone = alone(study, [-1.75, 0.0, 1.75]);
        study["samplings"]["alone"] = alone;
    });
    bench.run("out", &["--table", "csv"]);
    let row = &rows(&bench, "out/plane.csv")[4];
    assert_eq!(
        (&row["sampling"], &row["x_m"], &row["y_m"]),
        (&json!("plane/0004"), &json!("-1.75"), &json!("0.0"))
    );
    let alone = &bench.json("out/summary.json")["studies"]["alone"];
    let number = |column: &str| row[column].as_str().unwrap().parse::<f64>().unwrap();
    for name in ["mean", "std", "min", "max", "nominal"] {
        assert_eq!(json!(number(&format!("{name}_mm"))), alone["magnitude_mm"][name], "{name}");
    }
    let effects = alone["t_student"].as_object().unwrap();
    let largest = effects.values().map(|t| t.as_f64().unwrap()).fold(0.0, f64::max);
    assert_eq!(number("dominant_t"), largest);
    assert_eq!(effects[row["dominant"].as_str().unwrap()], json!(largest));
    let [one, other] =
        ["alone.csv", "plane/0004.csv"].map(|file| std::fs::read(bench.path("out").join(file)).unwrap());
    assert!(one == other, "the tables differ");
}

#[test]
fn threads_shards_and_a_resumed_run_make_no_difference() {
    let bench = plane(|study| {
        study["samplings"]["plane"]["observations"] = json!(300);
        study["samplings"]["plane"]["poses"]["grid"]["y"]["points"] = json!(7);
    });
    bench.run("whole", &["--threads", "1"]);
    let held = bench.json("whole/summary.json")["studies"]["plane"]["status"]["held"].as_u64().unwrap();
    bench.run("threads", &["--threads", "4"]);
    bench.assert_same("whole", "threads");
    for shard in ["2/3", "3/3"] {
        bench.run("shards", &["--shard", shard]);
    }
    let status: Value =
        serde_json::from_slice(&bench.study(&["status", "shards", "--format", "json"]).stdout).unwrap();
    assert_eq!(status["complete"], false);
    let plane = &status["samplings"]["plane"];
    assert_eq!(plane["poses_not_held"], 35 - held);
    let sampling = &plane["designs"]["sampling"];
    let counts = ["blocks_done", "blocks_missing", "observations"].map(|key| sampling[key].as_u64().unwrap());
    assert_eq!(counts[0] + counts[1], held);
    assert!(counts[0] > 0 && counts[1] > 0 && counts[2] == 300 * held, "{sampling}");
    let message = bench.refused(&["merge", "shards"]);
    assert!(
        message.contains(&format!("of {held} blocks, the first one shards/blocks/plane/00")),
        "{message}"
    );
    bench.run("shards", &["--shard", "1/3"]);
    bench.done(&["merge", "shards"]);
    bench.assert_same("whole", "shards");
    let block = bench.path("whole/blocks/plane/0017/sampling/000000.block");
    std::fs::remove_file(block).unwrap();
    bench.run("whole", &["--resume"]);
    bench.assert_same("whole", "shards");
    bench.done(&["extend", "whole", "--observations", "301"]);
    bench.run("larger", &["--observations", "301"]);
    bench.assert_same("whole", "larger");
}

#[test]
fn a_list_of_poses_has_a_table_and_no_map_and_a_box_a_map_a_layer() {
    let bench = plane(|study| {
        study["samplings"]["box"] = layered(study);
        let turned = json!({"position": [0, 0, 1.75], "quaternion": [0.9998, 0, 0, 0.02]});
        let yaw = 2.0 * 0.02_f64.atan2(0.9998).to_degrees();
        let by_angles = json!({"position": [0, 0, 1.75], "rpy_deg": [0, 0, yaw]});
        study["samplings"]["plane"]["poses"] =
            json!({"list": [{"position": [0, 0, 1.75]}, turned, {"position": [0, 0, 9]}, by_angles]});
    });
    let text = bench.run("out", &[]);
    let found = rows(&bench, "out/plane.csv");
    assert_eq!(found.iter().filter(|row| row["status"] == "held").count(), 3);
    assert_ne!(found[0]["mean_mm"], found[1]["mean_mm"]);
    // A rotation by angles is that of its quaternion.
    let [one, other] = [1, 3].map(|row| found[row]["mean_mm"].as_str().unwrap().parse::<f64>().unwrap());
    assert!((one / other - 1.0).abs() < 1e-9, "{one} mm, {other} mm");
    assert!(text.contains("note: no map of plane: its poses are on no plane or box"), "{text}");
    let svg = std::fs::read_to_string(bench.path("out/box_mean_z01.svg")).unwrap();
    assert!(svg.contains("at z = 2 m") && svg.contains("4 of 4 poses"));
    assert!(bench.path("out/box_dominant_z00.svg").exists());
}

#[test]
fn a_study_in_which_no_pose_is_held_says_so_and_ends_well() {
    let bench = plane(|study| {
        study["samplings"]["plane"]["poses"]["grid"]["z"] = json!({"min": 9.0, "max": 9.0, "points": 1});
    });
    let text = bench.run("out", &[]);
    assert!(text.contains("15 of 15 poses are not held: 15 infeasible tension."), "{text}");
    assert!(text.contains("note: no figure plane_mean: nothing to draw"), "{text}");
    assert_eq!(bench.json("out/summary.json")["studies"]["plane"]["mean_mm"], Value::Null);
    let report = std::fs::read_to_string(bench.path("out/report.html")).unwrap();
    assert!(report.contains("The robot cannot be drawn") && report.contains("holds 0 of 15 poses"));
}

#[test]
fn invalid_poses_are_refused_with_file_and_line() {
    type Spoil = fn(&mut Value);
    let cases: [(Spoil, &str); 13] = [
        (
            |s| s["poses"]["grid"]["x"]["points"] = json!(0),
            "samplings.plane.poses.grid.x is -3.5:3.5:0: expected min:max:points in [m]",
        ),
        (|s| s["poses"]["grid"]["y"]["max"] = json!(-9), "samplings.plane.poses.grid.y is -2:-9:3: expected"),
        (
            |s| s["poses"]["grid"]["x"]["points"] = json!(5_000_000),
            "samplings.plane.poses.grid is 5000000 x 3 x 1: expected at most 4000000 positions",
        ),
        (
            |s| s["poses"] = json!({"list": []}),
            "samplings.plane.poses.list is empty: expected at least one pose",
        ),
        (
            |s| {
                s["poses"] = json!({"list": [
                    {"position": [0, 0, 1.75]}, {"position": [0, 0, 1], "quaternion": [0, 0, 0, 0]}
                ]});
            },
            "samplings.plane.poses.list[1].quaternion is 0,0,0,0, which is zero or not finite: expected one",
        ),
        (
            |s| s["poses"] = json!({"list": [{"position": [0, 0, 1], "quaternion": [1, 0, 0, 1]}]}),
            "samplings.plane.poses.list[0].quaternion is 1,0,0,1, which has the length 1.4142: expected the \
             length 1, such as 0.707107,0,0,0.707107",
        ),
        (
            |s| s["poses"] = json!({"list": [{"position": [0, 0, 1], "quaternion": [0, 0, 0.1, 0.995]}]}),
            "expected qw,qx,qy,qz, which would be 0.995,0,0,0.1; or, if the platform is turned so far, its",
        ),
        (
            |s| {
                let both =
                    json!({"position": [0, 0, 1], "quaternion": [0.6, 0, 0, 0.8], "rpy_deg": [0, 0, 9]});
                s["poses"] = json!({"list": [both]});
            },
            "samplings.plane.poses.list[0].rpy_deg is [0.0, 0.0, 9.0]: expected finite angles [degrees], and no",
        ),
        (
            |s| s["poses"] = json!({"lists": []}),
            "samplings.plane.poses: unknown variant `lists`, expected `list` or `grid`",
        ),
        (
            |s| s["pose"] = json!({"position": [0, 0, 1.75]}),
            "samplings.plane.pose is `pose` and `poses`: expected either",
        ),
        (
            |s| drop(s.as_object_mut().unwrap().remove("poses")),
            "samplings.plane.pose is missing: expected either `pose` or `poses`",
        ),
        (
            |s| s["error_model"] = json!("table_5"),
            "samplings.plane.error_model is table_5: expected one of table_4",
        ),
        (|s| s["observations"] = json!(2), "samplings.plane.observations is 2: expected at least 3"),
    ];
    for (spoil, expected) in cases {
        let bench = plane(|study| spoil(&mut study["samplings"]["plane"]));
        let message = bench.refused(&["run", "study.json"]);
        assert!(
            message.contains(expected) && message.contains("(line ") | message.contains(" line "),
            "{message}"
        );
        assert!(!bench.path("results").exists());
    }
    let bench = plane(|study| study["samplings"] = json!({"blocks": study["samplings"]["plane"]}));
    let message = bench.refused(&["run", "study.json"]);
    assert!(message.contains("samplings is blocks: expected another name"), "{message}");
}

#[test]
fn a_study_of_other_names_overwrites_every_file_of_a_run_and_nothing_else() {
    let bench = plane(|study| {
        study["samplings"]["box"] = layered(study);
        let alone = alone(study, [0.0, 0.0, 1.75]);
        study["samplings"]["alone"] = alone;
        study["replicates"] = json!(2);
        study["sensitivity"] = json!({
            "observations": 40, "saltelli_blocks": 16, "morris_blocks": 4, "derivative_points": 4,
            "expansion": {"max_degree": 1, "norm": 1.0, "interactions": 1}
        });
        let axis =
            |parameter: &str, max: f64| json!({"parameter": parameter, "min": -max, "max": max, "points": 2});
        let (x, y) = (axis("mass", 18.0), axis("youngs_modulus", 2e9));
        study["surfaces"] =
            json!({"sheet": {"title": "Sheet", "pose": {"position": [0.0, 0.0, 1.75]}, "x": x, "y": y}});
    });
    bench.run("out", &["--table", "csv"]);
    let written = bench.files("out");
    for name in [
        "alone_sensitivity.csv",
        "alone_effects.svg",
        "anchor_points.svg",
        "box_std_z01.svg",
        "plane/0007.csv",
        "sheet.svg",
    ] {
        assert!(written.contains_key(name), "{name} is not in {:?}", written.keys());
    }
    std::fs::write(bench.path("out/plane/notes.csv"), "mine").unwrap();
    std::fs::write(bench.path("out/alone_notes.svg"), "mine").unwrap();
    let mut study = bench.json("study.json");
    study["samplings"] = json!({"other": study["samplings"]["alone"]});
    study["surfaces"] = json!({});
    std::fs::write(bench.path("study.json"), study.to_string()).unwrap();
    bench.run("out", &["--overwrite"]);
    for file in ["out/plane/notes.csv", "out/alone_notes.svg"] {
        assert_eq!(std::fs::read(bench.path(file)).unwrap(), b"mine", "{file}");
        std::fs::remove_file(bench.path(file)).unwrap();
    }
    bench.run("fresh", &[]);
    bench.assert_same("fresh", "out");
}

#[test]
fn names_whose_files_would_be_those_of_another_part_are_refused() {
    for (taken, writer) in [
        ("alone_sensitivity", "samplings.alone"),
        ("alone_effects", "samplings.alone"),
        ("plane_mean", "samplings.plane"),
        ("plane_dominant_z01", "samplings.plane"),
        ("robot", "the study as a whole"),
        ("anchor_points", "the study as a whole"),
        ("exit_points", "the study as a whole"),
    ] {
        for kind in ["samplings", "surfaces"] {
            let bench = plane(|study| {
                let alone = alone(study, [0.0, 0.0, 1.75]);
                let axis = json!({"parameter": "mass", "min": -1.0, "max": 1.0, "points": 2});
                let sheet = json!({"title": "Sheet", "pose": alone["pose"], "x": axis, "y": axis});
                study["samplings"]["alone"] = alone.clone();
                study["surfaces"] = json!({});
                study[kind][taken] = if kind == "samplings" { alone } else { sheet };
            });
            let message = bench.refused(&["run", "study.json"]);
            let expected =
                format!("error: study.json: {kind}.{taken} is {taken}: expected another name: {writer} ");
            assert!(message.starts_with(&expected) && message.contains("(line "), "{message}");
            assert!(!bench.path("results").exists());
        }
    }
    // Nothing else is called as maps of a sampling at one pose, or effects of one at several.
    plane(|study| study["samplings"]["plane_effects"] = study["samplings"]["plane"].clone()).run("out", &[]);
}

#[test]
fn where_one_pose_is_wanted_several_are_refused_with_their_names() {
    let bench = plane(|_| ());
    let of = |name| {
        bench.study(&[
            "tolerances",
            "study.json",
            "--limit",
            "deflection_mm<2",
            "--observations",
            "40",
            "--sampling",
            name,
        ])
    };
    assert!(of("plane/0007").status.success(), "{}", unwrapped(of("plane/0007").stderr));
    for (name, expected) in [
        ("plane", "samplings.plane is plane: expected one pose: plane/0000 to plane/0014"),
        ("plane/15", "samplings.plane is plane/15: expected one pose"),
        ("plane/0015", "samplings.plane is plane/0015: expected one pose"),
        ("plan", "samplings.plan is missing: expected one of plane"),
    ] {
        let message = unwrapped(of(name).stderr);
        assert!(message.contains(expected), "{message}");
    }
}
