//! Numbers that are probably not what was meant: each is questioned, the right field first, and the answer is
//! computed all the same.

use crate::common::{Bench, cdpr, data, json_file, unwrapped};
use serde_json::{Value, json};
use std::process::Output;

/// The questions of a command, and its exit code.
fn questions(output: &Output) -> (Vec<String>, Option<i32>) {
    let said = unwrapped(output.stderr.clone());
    let mut lines = said.lines().peekable();
    let mut found = Vec::new();
    while let Some(line) = lines.next() {
        if let Some(question) = line.strip_prefix("question: ") {
            found.push(format!("{question} {}", lines.next().unwrap_or_default().trim()));
        }
    }
    (found, output.status.code())
}

/// A command that asks exactly these questions, in words that each begin and contain, and answers.
fn asks(command: &str, expected: &[(&str, &str)]) {
    let output = cdpr(&command.split(' ').collect::<Vec<_>>());
    let (found, code) = questions(&output);
    assert_eq!(found.len(), expected.len(), "{command}: {found:?}");
    for (found, (begin, within)) in found.iter().zip(expected) {
        assert!(found.starts_with(begin) && found.contains(within), "{command}: {found}");
    }
    assert_eq!(code, Some(3), "{command}: {}", unwrapped(output.stderr));
    assert!(!output.stdout.is_empty(), "{command}");
}

#[test]
fn typed_numbers_in_another_unit_are_questioned_and_taken() {
    let folder = tempfile::TempDir::new().unwrap();
    let out = |name: &str| format!("--out {}", folder.path().join(name).display());
    let map = |where_: &str, name: &str| format!("workspace caroca --region=::3,::3,{where_} {}", out(name));
    asks(
        &map("1200", "mm"),
        &[
            ("a corner of the map is (-3.5, -2, 1200) m", "(-3.5, -2, 1.2) m, if it is in mm"),
            ("the map is empty", ""),
        ],
    );
    asks(&map("12", "high"), &[("the map is empty: none of 9 positions is held", "")]);
    asks(
        &format!("{} --payload 50", map("1.75 --uncertainty a=1,b=3,youngs_modulus=20", "gpa")),
        &[
            ("std of youngs_modulus is 20 Pa", "2.000e10 Pa, if 20 is in GPa"),
            ("std of a is 1 m", "0.001 m, if 1 is in mm"),
            ("std of b is 3 m", "0.003 m, if 3 is in mm"),
        ],
    );
    let summary: Value = json_file(folder.path().join("gpa/workspace.json"));
    assert!(summary["status"]["held"].as_u64() > Some(0), "{summary}");
    asks(
        "derivatives caroca --pose 0,0,1.75 --payload 50 --uncertainty mass=180",
        &[("std of mass is 180 kg", "0.18 kg, if 180 is in g")],
    );
}

#[test]
fn a_position_far_away_is_the_first_thing_that_is_said() {
    let output = cdpr(&["inverse", "caroca", "--pose", "0,0,1200"]);
    let (found, code) = questions(&output);
    assert!(code == Some(1) && found.len() == 1, "{found:?}");
    assert!(
        found[0].starts_with("--pose is (0, 0, 1200) m") && found[0].contains("(0, 0, 1.2) m, if"),
        "{found:?}"
    );
    assert!(unwrapped(output.stderr).starts_with("question: "));
}

#[test]
fn a_pose_in_the_ground_is_questioned_alone_and_in_a_list() {
    let bench = Bench::new("caroca.json", |_| ());
    bench.change("robot.json", |robot| robot["ground_z"] = json!(1.0));
    std::fs::write(bench.path("poses.csv"), "0,0,1.75\n0,0,0.9\n0,0,0.5\n").unwrap();
    let (robot, poses) = (bench.path("robot.json"), bench.path("poses.csv"));
    let [robot, poses] = [robot.to_str().unwrap(), poses.to_str().unwrap()];
    asks(
        &format!("inverse {robot} --pose 0,0,0.9"),
        &[("--pose is at z = 0.9 m", "below the ground, ground_z = 1 m")],
    );
    let output = cdpr(&["inverse", robot, "--poses", poses]);
    let (found, code) = questions(&output);
    assert!(code == Some(3) && found.len() == 1, "{found:?}");
    assert!(found[0].contains("is at z = 0.9 m, and of another pose"), "{found:?}");
    let high = cdpr(&["inverse", robot, "--pose", "0,0,1.75"]);
    assert_eq!(questions(&high), (vec![], Some(0)));
}

#[test]
fn loads_lengths_and_cables_are_questioned() {
    let first = |command: &str, begin: &str, within: &str| {
        let output = cdpr(&command.split(' ').collect::<Vec<_>>());
        let (found, code) = questions(&output);
        assert!(
            found.len() == 1 && found[0].starts_with(begin) && found[0].contains(within),
            "{command}: {found:?}"
        );
        assert!(matches!(code, Some(1 | 3)), "{command}: {code:?}");
    };
    let at = "inverse caroca --pose 0,0,1.75";
    first(&format!("{at} --payload 50000"), "payload is 50000 kg", "50 kg, if 50000 is in g");
    first(&format!("{at} --force 0,0,-100000"), "force is 1.000e5 N", "100 N, if");
    first(&format!("{at} --moment 0,90000,0"), "moment is 90000 N m", "90 N m, if 90000 is in N mm");
    first(
        "direct caroca --lengths 4440,4540,4360,4260,4260,4360,4540,4440",
        "length 1 is 4440 m",
        "4.44 m, if",
    );
    first(
        "direct caroca --lengths 0.5,0.5,0.5,0.5,0.5,0.5,0.5,0.5",
        "length 1 is 0.5 m",
        "with length 2, 0.5 m, 5.528 m too short",
    );
    let lengths = "4.44,4.54,4.36,4.26,4.26,4.36,4.54,4.44";
    first(&format!("direct caroca --lengths {lengths} --mass 180000"), "mass is 1.800e5 kg", "180 kg, if");
    first("cable density --mass 203 --length 2", "linear_density is 101.5 kg/m", "0.1015 kg/m, if");
    let cable = "cable catenary weight=0.9957,stiffness";
    first(
        &format!("{cable}=1280 --length 4.3 --end 4.1,-1.7"),
        "stiffness is 1280 N",
        "1.280e6 N, if 1280 is in kN",
    );
    first(&format!("{cable}=1.28e6 --length 4300 --end 4.1,-1.7"), "length is 4300 m", "4.3 m, if");
    first(
        "hysteresis caroca-law --pose 0,0,1750 --payload 50",
        "--pose is (0, 0, 1750) m",
        "(0, 0, 1.75) m, if it is in mm",
    );
    first(
        "inverse caroca --pose 0,0,1.75 --tension-reference 500000",
        "tension_reference is 5.000e5 N",
        "500 N, if",
    );
    first(
        "calibrate identify caroca --region=-1:1:3,-1:1:3,1:2:2 --uncertainty a=0.002 --noise position=0.1,rotation=1e-3",
        "noise of position is 0.1 m",
        "1.000e-4 m, if 0.1 is in mm",
    );
}

#[test]
fn lengths_without_their_leads_are_questioned() {
    let bench = Bench::new("caroca.json", |_| ());
    let lead = |robot: &mut Value, lead: f64| {
        robot["cables"].as_array_mut().unwrap().iter_mut().for_each(|cable| cable["lead"] = json!(lead));
    };
    bench.change("robot.json", |robot| lead(robot, 4.0));
    let robot = bench.path("robot.json");
    let lengths = "4.44,4.54,4.36,4.26,4.26,4.36,4.54,4.44";
    let output = cdpr(&["direct", robot.to_str().unwrap(), "--lengths", lengths]);
    let (found, _) = questions(&output);
    assert!(found.len() == 1 && found[0].contains("a length has its lead in it"), "{found:?}");
}

/// Findings of `check` about CAROCA, or another robot, with a change, warnings only.
fn warned(robot: &str, change: impl Fn(&mut Value)) -> Vec<String> {
    let folder = tempfile::TempDir::new().unwrap();
    let mut content = json_file(data(&format!("robots/{robot}.json")));
    change(&mut content);
    let path = folder.path().join("robot.json");
    std::fs::write(&path, content.to_string()).unwrap();
    let output = cdpr(&["robot", "check", path.to_str().unwrap(), "--format", "json"]);
    let findings: Vec<Value> = serde_json::from_slice(&output.stdout).unwrap();
    let warnings = findings.iter().filter(|finding| finding["severity"] == "warning");
    warnings.map(|finding| format!("{} {} {}", finding["field"], finding["why"], finding["remedy"])).collect()
}

#[test]
fn a_robot_file_is_questioned_for_the_field_that_is_wrong_and_for_no_other() {
    type Change = fn(&mut Value);
    fn each(robot: &mut Value, change: impl Fn(&mut Value)) {
        robot["cables"].as_array_mut().unwrap().iter_mut().for_each(change);
    }
    fn inertia(robot: &mut Value, factor: f64) {
        for row in robot["platform"]["inertia"].as_array_mut().unwrap() {
            row.as_array_mut()
                .unwrap()
                .iter_mut()
                .for_each(|entry| *entry = json!(factor * entry.as_f64().unwrap()));
        }
    }
    let cases: [(Change, &str, &str); 10] = [
        (
            |robot| inertia(robot, 1e9),
            "\"platform.inertia\"",
            "36.6 kg m\u{b2}, if 3.660e10 is in g mm\u{b2}",
        ),
        (
            |robot| inertia(robot, 1e6),
            "\"platform.inertia\"",
            "36.6 kg m\u{b2}, if 3.660e7 is in kg mm\u{b2}\"",
        ),
        (
            |robot| inertia(robot, 1e3),
            "\"platform.inertia\"",
            "36.6 kg m\u{b2}, if 36600 is in g m\u{b2} (from g mm\u{b2} multiply by 1e-9",
        ),
        (|robot| inertia(robot, 1e100), "\"platform.inertia\"", "radius of gyration"),
        (
            |robot| each(robot, |cable| cable["lead"] = json!(3000.0)),
            "\"cables[0].lead\"",
            "3 m, if 3000 is in mm",
        ),
        (
            |robot| each(robot, |cable| cable["pulley"] = json!({"radius": 40.0, "axis": [0, 0, 1]})),
            "\"cables[0].pulley.radius\"",
            "0.04 m, if 40 is in mm",
        ),
        (|robot| robot["cable"]["diameter"] = json!(3.0), "\"cable.diameter\"", "0.003 m, if 3 is in mm"),
        (
            |robot| {
                let cable = robot["cable"].as_object_mut().unwrap();
                cable.remove("section");
                cable.insert("diameter".to_owned(), json!(3.0));
            },
            "\"cable.diameter\"",
            "0.003 m, if 3 is in mm",
        ),
        (
            |robot| {
                let cable = robot["cable"].as_object_mut().unwrap();
                cable.remove("section");
                cable.insert("linear_density".to_owned(), json!(0.06134));
            },
            "\"cable.section\"",
            "4881 kg/m\u{b3}",
        ),
        (
            |robot| {
                let z = robot["cables"][2]["exit_point"][2].as_f64().unwrap();
                robot["cables"][2]["exit_point"][2] = json!(-z);
            },
            "\"cables[2].exit_point\"",
            "z = 5.3976",
        ),
    ];
    for (change, field, words) in cases {
        let found = warned("cogiro", change);
        assert!(
            found.len() == 1 && found[0].starts_with(field) && found[0].contains(words),
            "{field}: {found:?}"
        );
    }
}

#[test]
fn cables_whose_anchor_points_are_exchanged_are_questioned() {
    let exchanged = |i: usize, j: usize| {
        warned("cogiro", |robot| {
            let anchor = |i: usize| robot["cables"][i]["anchor_point"].clone();
            let (first, second) = (anchor(i), anchor(j));
            robot["cables"][i]["anchor_point"] = second;
            robot["cables"][j]["anchor_point"] = first;
        })
    };
    // Where cables then touch.
    let touching = exchanged(0, 4);
    assert!(
        touching.iter().any(|found| found.contains("the other way round, the robot holds a pose")),
        "{touching:?}"
    );
    // Of two cables with which the robot holds as much.
    let other = exchanged(0, 2);
    assert!(
        other.iter().any(|found| found.contains("the other way round, the layout is symmetric")),
        "{other:?}"
    );
}

#[test]
fn a_robot_that_is_in_doubt_is_questioned_by_every_command_and_in_its_json() {
    let bench = Bench::new("caroca.json", |_| ());
    bench.change("robot.json", |robot| robot["cable"]["diameter"] = json!(4.0));
    let robot = bench.path("robot.json");
    let robot = robot.to_str().unwrap();
    for command in ["inverse", "stiffness", "capacity"] {
        let output = cdpr(&[command, robot, "--pose", "0,0,1.75", "--format", "json"]);
        assert_eq!(output.status.code(), Some(3));
        let answer: Value = serde_json::from_slice(&output.stdout).unwrap();
        let asked = answer["questions"].as_array().unwrap();
        assert!(asked.len() == 1 && asked[0]["quantity"] == "cable.diameter", "{command}: {asked:?}");
        assert_eq!(asked[0]["meant"], "0.004 m, if 4 is in mm");
        let place = asked[0]["place"].as_str().unwrap();
        assert!(place.starts_with(robot) && place.contains("robot.json, line "), "{place}");
        assert!(unwrapped(output.stderr).contains(&format!("    in {place}\n")));
    }
}

#[test]
fn laws_of_a_study_are_questioned_and_the_study_runs() {
    let few = |change: &dyn Fn(&mut Value)| {
        let bench = Bench::new("caroca.json", |study| {
            study["samplings"].as_object_mut().unwrap().retain(|name, _| name == "mechanical");
            study["samplings"]["mechanical"]["observations"] = json!(64);
            study["replicates"] = json!(0);
            study["surfaces"] = json!({});
            study.as_object_mut().unwrap().remove("sensitivity");
            change(&mut study["error_models"]["table_3"]);
        });
        let output = bench.study(&["run", "study.json", "--out", "out"]);
        assert!(bench.path("out/summary.json").exists(), "{}", unwrapped(output.stderr));
        questions(&output)
    };
    let normal = |mean: f64, std: f64| json!({"law": {"normal": {"mean": mean, "std": std}}});
    assert_eq!(few(&|_| ()), (vec![], Some(0)));
    for (entry, law, begin, within) in [
        ("mass", normal(175.0, 0.2), "mean of mass in table_3 is 175 kg", "deviations count from 180 kg"),
        (
            "youngs_modulus",
            normal(0.0, 20.0),
            "std of youngs_modulus in table_3 is 20 Pa",
            "2.000e10 Pa, if 20 is in GPa",
        ),
    ] {
        let (found, code) = few(&|model| model[entry] = law.clone());
        assert!(code == Some(3) && found.len() == 1, "{found:?}");
        assert!(found[0].starts_with(begin) && found[0].contains(within), "{found:?}");
    }
    let (found, code) = few(&|model| model["b"] = normal(0.0, 10.0));
    assert!(code == Some(3) && found[0].starts_with("std of b in table_3 is 10 m"), "{found:?}");
    assert!(found.len() == 2 && found[1].starts_with("mechanical is the result of "), "{found:?}");
    assert!(found[1].contains(" of 64 failed ("), "{found:?}");
}

#[test]
fn nothing_in_the_library_and_no_study_is_questioned() {
    let quiet = |command: &[&str]| {
        let output = cdpr(command);
        assert_eq!(
            questions(&output),
            (vec![], Some(0)),
            "{command:?}: {}",
            unwrapped(output.stderr.clone())
        );
    };
    let library: Value =
        serde_json::from_slice(&cdpr(&["robot", "list", "--format", "json"]).stdout).unwrap();
    let entries = library.as_array().unwrap().iter();
    let list: Vec<&Value> = entries.filter(|entry| entry["kind"] == "robot").collect();
    assert_eq!(list.len(), 20);
    let folder = tempfile::TempDir::new().unwrap();
    let page = |name: &str| folder.path().join(format!("{name}.html")).to_str().unwrap().to_owned();
    for robot in list {
        quiet(&["robot", "show", robot["name"].as_str().unwrap()]);
    }
    for entry in std::fs::read_dir(data("studies")).unwrap() {
        let path = entry.unwrap().path();
        let name = path.file_stem().unwrap().to_str().unwrap().to_owned();
        quiet(&["explore", path.to_str().unwrap(), "--out", &page(&name)]);
    }
}
