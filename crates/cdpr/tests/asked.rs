//! Questions about answers, endings of refused runs, and messages that are the same in print and in JSON.

use crate::common::{Bench, cdpr, cdpr_in, data_path, json_file, text, unwrapped};
use serde_json::{Value, json};
use std::process::Output;

/// The words of the questions of a command, and its exit code.
fn questions(output: &Output) -> (String, Option<i32>) {
    let said = unwrapped(output.stderr.clone());
    (said, output.status.code())
}

/// Unstrained lengths with which a robot holds a pose, as they are typed.
fn lengths(robot: &str, pose: &str) -> String {
    let output = cdpr(&["inverse", robot, "--pose", pose, "--format", "json"]);
    let answer: Value = serde_json::from_slice(&output.stdout).unwrap();
    let all = answer["lengths"].as_array().unwrap();
    all.iter().map(ToString::to_string).collect::<Vec<_>>().join(",")
}

#[test]
fn lengths_of_another_robot_are_questioned_where_the_platform_rests() {
    let own = lengths("caroca", "0,0,1.75");
    assert_eq!(cdpr(&["direct", "caroca", "--lengths", &own]).status.code(), Some(0));
    let other = lengths("cogiro", "0,0,2.7");
    let output = cdpr(&["direct", "caroca", "--lengths", &other, "--format", "json"]);
    let answer: Value = serde_json::from_slice(&output.stdout).unwrap();
    let [question] = &answer["questions"].as_array().unwrap()[..] else { panic!("{answer}") };
    let (said, code) = questions(&output);
    assert_eq!(code, Some(3));
    // What JSON says is what is printed.
    for part in ["quantity", "value", "why", "meant"] {
        assert!(said.contains(question[part].as_str().unwrap()), "{part}: {said}");
    }
    assert!(said.contains("the equilibrium is at z = -4.7") && said.contains("below the floor"), "{said}");
    // Each case of a file is named.
    let folder = tempfile::TempDir::new().unwrap();
    let numbers = |list: &str| -> Value { serde_json::from_str(&format!("[{list}]")).unwrap() };
    let cases = json!([{"lengths": numbers(&own)}, {"lengths": numbers(&other)}]);
    std::fs::write(folder.path().join("cases.json"), cases.to_string()).unwrap();
    let (said, code) = questions(&cdpr_in(folder.path(), &["direct", "caroca", "--from", "cases.json"]));
    assert!(said.contains("the equilibrium of case 2 is") && code == Some(3), "{said}");
}

#[test]
fn a_rest_that_is_one_of_many_is_no_answer() {
    let output = cdpr(&["inverse", "four-cables", "--pose", "0,0,2", "--free", "x,y"]);
    let (said, code) = questions(&output);
    assert!(said.contains("the rest is not unique: cable ") && code == Some(1), "{said}");
    assert!(output.stdout.is_empty());
}

#[test]
fn a_refused_run_leaves_no_folder() {
    let folder = tempfile::TempDir::new().unwrap();
    let refused = |arguments: &[&str], words: &str| {
        let (said, code) = questions(&cdpr_in(folder.path(), arguments));
        assert!(said.contains(words) && code != Some(0), "{said}");
        let left: Vec<_> =
            std::fs::read_dir(folder.path()).unwrap().map(|entry| entry.unwrap().path()).collect();
        assert!(left.is_empty(), "{arguments:?}: {left:?}");
    };
    refused(
        &["workspace", "four-cables", "--region", "z=2", "--free", "x,y"],
        "free is x: expected coordinates",
    );
    refused(&["workspace", "four-cables", "--region", "z=2", "--free", "roll"], "free is [roll]");
    // Missing free coordinates are missing at every pose: no table of refusals is printed.
    let poses = tempfile::NamedTempFile::new().unwrap();
    std::fs::write(poses.path(), "x,y,z\n0.5,0.3,2\n0.4,0.2,2\n").unwrap();
    let poses = poses.path().to_str().unwrap();
    let noise = ["--noise", "position=1e-3,rotation=1e-3", "--uncertainty", "a=0.002"];
    for (arguments, rest) in [
        (&["path", "four-cables", "--poses", poses, "--payload", "5"][..], &[][..]),
        (&["stiffness", "four-cables", "--poses", poses], &[]),
        (&["calibrate", "plan", "four-cables", "--poses", poses], &noise),
    ] {
        let output = cdpr_in(folder.path(), &[arguments, rest].concat());
        let (message, code) = questions(&output);
        assert_eq!(code, Some(1), "{arguments:?}: {message}");
        assert!(output.stdout.is_empty() && message.contains("leave 2 coordinates"), "{message}");
    }
    // A folder that was there stays.
    std::fs::create_dir(folder.path().join("mine")).unwrap();
    let out = ["workspace", "four-cables", "--region", "z=2", "--free", "roll", "--out", "mine"];
    let (_, code) = questions(&cdpr_in(folder.path(), &out));
    assert!(code == Some(2) && folder.path().join("mine").is_dir());
}

#[test]
fn quaternions_in_the_other_order_are_questioned_where_a_file_names_its_columns() {
    let folder = tempfile::TempDir::new().unwrap();
    let asked = |names: &str, numbers: &str| {
        std::fs::write(folder.path().join("poses.csv"), format!("x_m,y_m,z_m,{names}\n{numbers}\n")).unwrap();
        questions(&cdpr_in(folder.path(), &["inverse", "caroca", "--poses", "poses.csv"]))
    };
    let (said, code) = asked("qw,qx,qy,qz", "0,0,1.75,0,0,0.087,0.996");
    assert!(said.contains("line 2: qw,qx,qy,qz is 0,0,0.087018,0.996207") && code == Some(3), "{said}");
    assert_eq!(asked("qx,qy,qz,qw", "0,0,1.75,0,0,0.087,0.996").1, Some(0));
}

#[test]
fn angles_of_more_than_a_turn_are_questioned() {
    let (said, code) = questions(&cdpr(&["inverse", "caroca", "--pose", "0,0,1.75", "--rpy", "0,0,100000"]));
    assert!(
        said.contains("--rpy is 0, 0, 1.000e5 degrees") && said.contains("-80 degrees are the same"),
        "{said}"
    );
    assert_eq!(code, Some(3));
    assert_eq!(cdpr(&["inverse", "caroca", "--pose", "0,0,1.75", "--rpy", "0,0,-10"]).status.code(), Some(0));
}

#[test]
fn what_cannot_be_right_is_refused_before_it_is_computed() {
    let folder = tempfile::TempDir::new().unwrap();
    let move_along = ["path", "cogiro", "--poses", "poses.csv", "--with"];
    let plan = ["calibrate", "plan", "cogiro", "--region=-1:1:9,-1:1:9,1:2:9"];
    let known = ["--uncertainty", "a=0.002", "--noise", "position=1e-4", "--with", "criterion=mean-position"];
    for (arguments, words) in [
        (vec!["inverse", "cogiro", "--pose", "0,0,2", "--out", "none/a.csv"], "there is no folder none"),
        (vec!["inverse", "cogiro", "--pose", "0,0,2", "--out", "."], "expected the name of a file"),
        (
            vec!["workspace", "cogiro", "--region", "::99,::99,2", "--figure", "map.svg"],
            "name of a map: deflection",
        ),
        (vec!["workspace", "cogiro", "--region", "::99,0,2", "--with", "boundary"], "a plane or a box"),
        ([&move_along[..], &["seconds=2,robots=9"]].concat(), "expected --uncertainty, too"),
        ([&plan[..], &known].concat(), "expected --work, too"),
    ] {
        let (said, code) = questions(&cdpr_in(folder.path(), &arguments));
        assert!(said.contains(words) && code == Some(2), "{arguments:?}: {said}");
    }
}

#[test]
fn the_question_that_was_asked_is_answered_first() {
    let first = |arguments: &[&str]| {
        let output = cdpr(arguments);
        let printed = text(output.stdout).replace('\n', " ");
        assert!(output.status.code().is_some_and(|code| code != 1), "{printed}");
        printed.split(". ").next().unwrap().to_owned()
    };
    let at = ["cogiro", "--pose", "0,0,2"];
    let first_of = |command: &str, more: &[&str]| first(&[&[command], &at[..], more].concat());
    assert!(first_of("capacity", &["--with", "tilt=2"]).contains("may tilt by"));
    let uncertain = first_of("derivatives", &["--payload", "5", "--uncertainty", "a=0.002"]);
    assert!(uncertain.contains("with a standard deviation of"), "{uncertain}");
    let table = data_path("tables/ishigami.csv");
    let limited = first(&["analyse", &table, "--limit", "y<5"]);
    assert!(limited.contains("y: limit < 5: "), "{limited}");
}

#[test]
fn a_pose_of_a_study_in_millimetres_says_what_was_meant() {
    let bench = Bench::new("caroca.json", |study| {
        for (_, sampling) in study["samplings"].as_object_mut().unwrap() {
            sampling["pose"]["position"] = json!([0, 0, 1750]);
        }
    });
    let (said, code) = questions(&cdpr_in(&bench.path(""), &["study", "run", "study.json", "--out", "out"]));
    assert!(said.contains("(meant? (0, 0, 1.75) m, if it is in mm)") && code == Some(1), "{said}");
}

#[test]
fn the_first_study_of_a_robot_with_few_cables_is_held_in_every_observation() {
    let folder = tempfile::TempDir::new().unwrap();
    for robot in ["four-cables", "irma4u", "grab"] {
        let file = format!("{robot}.json");
        let new = cdpr_in(folder.path(), &["study", "new", robot, "--out", &file]);
        assert!(new.status.success(), "{}", unwrapped(new.stderr));
        let study = json_file(folder.path().join(&file));
        let is_said = study["source"].as_str().unwrap().contains("times smaller than usual");
        assert_eq!(is_said, robot != "grab", "{study}");
        let run = cdpr_in(folder.path(), &["study", "run", &file, "--out", robot]);
        assert_eq!(run.status.code(), Some(0), "{}", unwrapped(run.stderr));
        let summary = json_file(folder.path().join(robot).join("summary.json"));
        assert_eq!(summary["samplings"]["all"]["failed"].as_u64().unwrap_or(0), 0, "{robot}: {summary}");
        assert!(!text(run.stdout).contains("failed:"), "{robot}");
    }
}

#[test]
fn a_platform_that_falls_ends_a_simulation_as_it_ends_a_deflection() {
    let robot = data_path("reference/robots/suspended.json");
    let folder = tempfile::TempDir::new().unwrap();
    std::fs::write(
        folder.path().join("pose.csv"),
        "x_m,y_m,z_m,roll_deg,pitch_deg,yaw_deg\n.6,-.4,1.6,3,-4,6\n",
    )
    .unwrap();
    let model = json!({"mass": {"law": {"normal": {"mean": 0, "std": 1e-6}}}});
    std::fs::write(folder.path().join("model.json"), model.to_string()).unwrap();
    let load = ["--moment", "400,-300,100", "--payload", "2"];
    let deflection = [&["deflection", &robot, "--pose", ".6,-.4,1.6", "--rpy", "3,-4,6"][..], &load].concat();
    let output = cdpr(&deflection);
    assert!(
        text(output.stdout.clone()).contains("the platform falls from") && output.status.code() == Some(3)
    );
    let simulation = [
        &["calibrate", "simulate", &robot, "--poses", "pose.csv", "--uncertainty", "model.json"][..],
        &["--noise", "position=1e-4", "--seed", "1", "--out", "out.csv"],
        &load,
    ];
    let (said, code) = questions(&cdpr_in(folder.path(), &simulation.concat()));
    assert!(said.contains("the platform falls from") && code == Some(3), "{said}");
}

#[test]
fn answers_of_the_inverse_model_are_cases_with_their_load() {
    let folder = tempfile::TempDir::new().unwrap();
    std::fs::write(folder.path().join("poses.csv"), "x_m,y_m,z_m,note\n0.1,0,2,a\n").unwrap();
    let rests = |robot: &str, more: &[&str], wanted: [f64; 3]| {
        let first = ["inverse", robot, "--format", "json", "--out", "answer.json", "--overwrite"];
        let output = cdpr_in(folder.path(), &[&first[..], more].concat());
        assert!(output.status.success(), "{}", unwrapped(output.stderr));
        let output = cdpr_in(folder.path(), &["direct", robot, "--from", "answer.json", "--format", "json"]);
        assert!(output.status.success(), "{}", unwrapped(output.stderr));
        let found: Value = serde_json::from_slice(&output.stdout).unwrap();
        let position = &found.get(0).unwrap_or(&found)["position"];
        for (i, wanted) in wanted.iter().enumerate() {
            assert!((position[i].as_f64().unwrap() - wanted).abs() < 1e-9, "{position}");
        }
    };
    let load = ["--payload", "300", "--force", "50,-20,10", "--moment", "5,0,0"];
    rests("cogiro", &[&["--pose", "0,0,2"], &load[..]].concat(), [0.0, 0.0, 2.0]);
    rests("cogiro", &[&["--poses", "poses.csv"], &load[..]].concat(), [0.1, 0.0, 2.0]);
    let free = ["--pose", "0.5,0.3,2", "--free", "roll,pitch", "--payload", "5"];
    rests("four-cables", &free, [0.5, 0.3, 2.0]);
}

#[test]
fn a_hoist_hangs_at_the_length_of_its_cable() {
    let folder = tempfile::TempDir::new().unwrap();
    let cable = json!({"exit_point": [0, 0, 4], "anchor_point": [0, 0, 0]});
    let robot = json!({
        "format": "cdpr-robot/1", "name": "hoist", "gravity": 9.81,
        "platform": {"mass": 5, "center_of_mass": [0, 0, 0], "point": true},
        "cable": {"section": 1.6e-5, "linear_density": 0.16, "youngs_modulus": 9e10},
        "tension_limits": {"min": 1, "max": 3000}, "ground_z": -100, "cables": [cable],
    });
    std::fs::write(folder.path().join("hoist.json"), robot.to_string()).unwrap();
    let hoist = ["hoist.json", "--lengths", "90", "--format", "json"];
    let output = cdpr_in(folder.path(), &[&["direct"], &hoist[..]].concat());
    assert!(output.status.success(), "{}", unwrapped(output.stderr));
    let found: Value = serde_json::from_slice(&output.stdout).unwrap();
    // A hanging bar is stretched by its load and by half of its own weight.
    let stretch = 9.81 * (5.0 + 0.5 * 0.16 * 90.0) * 90.0 / (1.6e-5 * 9e10);
    let z = found["position"][2].as_f64().unwrap();
    assert!((z - (4.0 - 90.0 - stretch)).abs() < 1e-9, "{z}");
    let refused = cdpr_in(folder.path(), &["inverse", "hoist.json", "--pose", "0,0,2"]);
    let said = unwrapped(refused.stderr);
    assert!(said.contains("1 cable for 3 free motions leave 2 coordinates"), "{said}");
}

#[test]
fn what_was_not_tried_is_no_part_of_an_answer() {
    let tilt = |with: &str| text(cdpr(&["capacity", "cogiro", "--pose", "0,0,2", "--with", with]).stdout);
    // Towards 45 degrees the platform tilts by 63 degrees.
    let tried = "may tilt by 90 degrees, the most that is tried, in 4 directions.";
    assert!(tilt("tilt=4").replace('\n', " ").contains(tried));
    assert!(tilt("tilt=8").replace('\n', " ").contains("towards 45.0 degrees, the worst of 8 directions."));
    let plan = ["calibrate", "plan", "caroca", "--region=-2:2:3,-1:1:3,1:2.5:2", "--number", "1"];
    let known = ["--uncertainty", "a=0.002", "--noise", "position=1e-4,rotation=1e-4"];
    let work = ["--with", "criterion=mean-position", "--work=-30:0:2,0,1.75"];
    let output = text(cdpr(&[&plan[..], &known, &work].concat()).stdout);
    assert!(output.contains("1 pose of CAROCA leaves"), "{output}");
    assert!(output.contains("1 position of --work left out: not held"), "{output}");
    let weighed = text(cdpr(&["cable", "density", "--mass", "0.203", "--length", "2"]).stdout);
    assert_eq!(weighed, "0.101500 kg/m\n");
}

#[test]
fn the_refusal_of_few_cables_names_every_command_that_finds_coordinates() {
    let refused = unwrapped(cdpr(&["stiffness", "four-cables", "--pose", "0.5,0.3,2"]).stderr);
    let help = text(cdpr(&["--help"]).stdout);
    let names = help.lines().filter_map(|line| line.strip_prefix("  ")?.split_once("  "));
    let mut count = 0;
    for (name, _) in names.filter(|(name, _)| name.starts_with(char::is_lowercase)) {
        let words: Vec<&str> = name.split(' ').chain(["--help"]).collect();
        if !text(cdpr(&words).stdout).contains("--free <") {
            continue;
        }
        let noun = match words[0] {
            "workspace" => "workspaces",
            "calibrate" => "calibrations",
            "study" => "studies",
            name => name,
        };
        assert!(
            refused.contains(&format!("{noun},")) || refused.contains(&format!("{noun} ")),
            "{name}: {refused}"
        );
        count += 1;
    }
    assert!(count > 10, "{count}");
}
